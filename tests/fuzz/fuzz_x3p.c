/* Fuzz target: any bytes as an X3P file. A ZIP archive is used unchanged, other bytes as a list
 * of entries (pack_list.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack_list.h"
#include "read_all.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size >= 2 && memcmp(data, "PK", 2) == 0) {
        read_all(&reader_x3p, data, size);
        return 0;
    }
    size_t length = 0;
    uint8_t *archive = pack_list(data, size, &length);
    read_all(&reader_x3p, archive, length);
    free(archive);
    return 0;
}
