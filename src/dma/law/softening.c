/* Check of a table of strain softening (Payne effect).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/param.h"
#include "weartrack/dma.h"

#include <math.h>

/* No filled rubber softens by more than a hundred times (Payne): what is beyond is a modulus in
 * another unit. */
static const double least_factor = 1e-3, most_factor = 1e3;

wt_status wt_softening_check(const wt_softening *table, wt_error *err)
{
    if (table == NULL || table->n == 0 || table->strain == NULL || table->storage == NULL ||
        table->loss == NULL)
        return wt_fail(err, WT_E_ARG, "a softening needs a table of strain, f and g");
    for (size_t k = 0; k < table->n; k++) {
        const double strain = table->strain[k], f = table->storage[k], g = table->loss[k];
        wt_status status = WT_OK;
        if (!(strain > (k ? table->strain[k - 1] : 0)) || !isfinite(strain))
            status = range_error("strain of a softening", strain, "finite, > 0 and rising", err);
        else if (!(f >= least_factor && f <= most_factor))
            status = range_error("f of a softening", f, "from 1e-3 to 1e3", err);
        else if (!(g >= least_factor && g <= most_factor))
            status = range_error("g of a softening", g, "from 1e-3 to 1e3", err);
        if (status != WT_OK) {
            wt_error_place(err, "point %zu of %zu", k + 1, table->n);
            return status;
        }
    }
    return WT_OK;
}
