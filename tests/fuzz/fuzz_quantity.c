/* Fuzz target: any text as a unit, a quantity, a quantity with an error or a list; the first
 * byte selects the kind. Accepted values are finite and possible.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/quantity.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool good)
{
    if (!good)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
        return 0;
    const wt_quantity quantity = (wt_quantity)(data[0] % (unsigned)WT_Q_COUNT);
    char *const text = strndup((const char *)data + 1, size - 1);
    double factor = 0, offset = 0, value = 0, *list = NULL;
    size_t n = 0;
    wt_estimate estimate;
    wt_error err = WT_ERROR_INIT;
    check(text != NULL);
    if (wt_unit_to_si(text, quantity, &factor, &offset, &err) == WT_OK)
        check(isfinite(factor) && factor > 0 && isfinite(offset));
    if (wt_quantity_parse(text, quantity, &value, &err) == WT_OK)
        check(quantity_is_plausible(quantity, value));
    if (wt_estimate_parse(text, quantity, &estimate, &err) == WT_OK)
        check(quantity_is_plausible(quantity, estimate.value) && estimate.standard_error >= 0 &&
              isfinite(estimate.standard_error));
    if (wt_list_parse(text, quantity, &list, &n, &err) == WT_OK)
        for (size_t i = 0; i < n; i++)
            check(quantity_is_plausible(quantity, list[i]) && (i == 0 || list[i] > list[i - 1]));
    free(list);
    free(text);
    return 0;
}
