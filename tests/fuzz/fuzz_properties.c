/* Fuzz target: any bytes as Java .properties. Every parsed key is found again.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/jpk/jpk.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    property_list p = {0};
    if (properties_parse(&p, data, size, NULL) == WT_OK) {
        for (size_t i = 0; i < p.n; i++) {
            const char *value = properties_get(&p, p.items[i].key);
            if (value == NULL || strcmp(value, p.items[i].value) != 0)
                abort();
        }
    }
    properties_clear(&p);
    return 0;
}
