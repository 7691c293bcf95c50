/* Any bytes as a Nanosurf file: images, force curves, facts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read_all.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void read_images(const uint8_t *data, size_t size, const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (reader_nid.read_images(&reader_nid, input, options, NULL, &images, &n, NULL) == WT_OK)
        for (size_t i = 0; i < n; i++)
            wt_image_clear(&images[i]);
    free(images);
    wt_input_close(input);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_read_options options = wt_read_defaults();
    detect(&reader_nid, data, size);
    read_images(data, size, &options);
    read_curves(&reader_nid, data, size, &options);
    options.spring_constant = 0.3;
    options.want = WT_Q_BIT(WT_Q_FORCE);
    read_curves(&reader_nid, data, size, &options);
    describe(&reader_nid, data, size, &options);
    return 0;
}
