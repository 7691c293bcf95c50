/* Any bytes as Java .properties: what was parsed can be found again.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/properties.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_properties p = {0};
    if (wt_properties_parse(&p, data, size, NULL) == WT_OK) {
        for (size_t i = 0; i < p.n; i++) {
            const char *value = wt_properties_get(&p, p.items[i].key);
            if (value == NULL || strcmp(value, p.items[i].value) != 0)
                abort();
        }
    }
    wt_properties_clear(&p);
    return 0;
}
