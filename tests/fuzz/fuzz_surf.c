/* Fuzz target: any bytes as a compressed Digital Surf file, before Gwyddion reads the unpacked
 * data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_all.h"

#include "read/gwyddion/gwyddion.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MOST = 1 << 20 };
    wt_input *input = NULL, *plain = NULL;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (surf_unpack(input, MOST, NULL, &plain, NULL) != WT_OK && plain != NULL)
        abort();
    wt_input_close(plain);
    wt_input_close(input);
    return 0;
}
