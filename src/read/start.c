/* What each reading begins with: the options, checked, and the reader that the file belongs to.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/formats.h"

#include <math.h>

wt_read_options wt_read_defaults(void)
{
    return (wt_read_options){
        .format = NULL,
        .want = WT_Q_ALL,
        .segments = WT_SEGMENT_ALL,
        .spring_constant = (double)NAN,
        .sensitivity = (double)NAN,
        .temperature = (double)NAN,
        .units = NULL,
        .n_units = 0,
    };
}

/* A value that replaces the file's must be a positive number. */
static wt_status check_options(const wt_read_options *options, wt_error *err)
{
    if (!isnan(options->spring_constant) &&
        !(isfinite(options->spring_constant) && options->spring_constant > 0))
        return wt_fail(err, WT_E_RANGE, "the spring constant %g N/m is not positive",
                       options->spring_constant);
    if (!isnan(options->sensitivity) &&
        !(isfinite(options->sensitivity) && options->sensitivity > 0))
        return wt_fail(err, WT_E_RANGE, "the sensitivity %g m/V is not positive",
                       options->sensitivity);
    return WT_OK;
}

wt_status read_start(const wt_formats *formats, wt_input *input, const wt_read_options *given,
                     unsigned kind, wt_read_options *options, const file_reader **reader,
                     wt_error *err)
{
    *options = given != NULL ? *given : wt_read_defaults();
    wt_status status = check_options(options, err);
    if (status != WT_OK)
        return status;
    return find_reader(formats, input, options->format, kind, reader, err);
}
