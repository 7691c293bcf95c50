/* DMA sweeps, through the reader that the file belongs to.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/shortage.h"
#include "read/formats.h"

wt_status wt_sweep_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_sweep *sweep, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_status status =
        read_start(formats, input, options, WT_KIND_SWEEP, &o, &reader, &content, err);
    if (status == WT_OK)
        status = reader->read_sweep(reader, content, &o, log, sweep, err);
    status = shortage_end(status, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}
