/* Any bytes as a file of one binary reader, reader_READER_ID: images, force curves, facts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read_all.h"

#define JOIN(a, b) a##b
#define READER_OF(id) JOIN(reader_, id)

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_all(&READER_OF(READER_ID), data, size);
    return 0;
}
