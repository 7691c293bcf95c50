/* Force curves, through the reader that the file belongs to.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/shortage.h"
#include "read/force_source.h"
#include "read/formats.h"

wt_status wt_force_open(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_force_source **source, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_status status =
        read_start(formats, input, options, WT_KIND_FORCE, &o, &reader, &content, err);
    if (status == WT_OK)
        status = force_open(reader->force, reader, content, &o, log, source, err);
    const wt_status end = shortage_end(status, err);
    if (status == WT_OK && end != WT_OK) {
        wt_force_close(*source);
        *source = NULL;
    }
    status = end;
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}
