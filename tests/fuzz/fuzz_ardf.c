/* Any bytes as a force map of Asylum Research. Its check sums are made to agree, else they would
 * stop nearly every change. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_all.h"
#include "writers/ardf_writer.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    if (copy == NULL)
        abort();
    if (size > 0)
        memcpy(copy, data, size);
    ardf_writer_mend(copy, size);
    read_all(&reader_ardf, copy, size);
    free(copy);
    return 0;
}
