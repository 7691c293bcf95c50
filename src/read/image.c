/* Images, through the reader that the file belongs to.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/shortage.h"
#include "read/formats.h"

wt_status wt_images_read(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                         wt_parselog *log, wt_image **images, size_t *n, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_status status =
        read_start(formats, input, options, WT_KIND_IMAGE, &o, &reader, &content, err);
    if (status == WT_OK)
        status = reader->read_images(reader, content, &o, log, images, n, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}
