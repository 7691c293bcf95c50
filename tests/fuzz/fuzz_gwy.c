/* Fuzz target: a Gwyddion file, once as a user's file and once as a conversion by the program,
 * where masks mark missing heights.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_all.h"

#include "read/images.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0;
    read_all(&reader_gwy, data, size);
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (gwy_read(input, true, NULL, &images, &n, NULL) != WT_OK)
        n = 0;
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
    wt_input_close(input);
    return 0;
}
