/* Fuzz target of reader_READER_ID, whose checksums are corrected first; otherwise they would
 * stop nearly every changed input.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_all.h"
#include "writers/ardf_writer.h"
#include "writers/ibw_writer.h"

#include <string.h>

#define JOIN_NOW(a, b) a##b
#define JOIN(a, b) JOIN_NOW(a, b)

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    if (copy == NULL)
        abort();
    if (size > 0)
        memcpy(copy, data, size);
    JOIN(READER_ID, _writer_fix_checksums)(copy, size);
    read_all(&JOIN(reader_, READER_ID), copy, size);
    free(copy);
    return 0;
}
