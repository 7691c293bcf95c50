/* The closed list of quantities. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/base.h"

#include <string.h>

_Static_assert(WT_Q_COUNT < 64, "wt_quantity_set has one bit per quantity");

static const struct {
    const char *id, *unit;
} quantities[] = {
#define QUANTITY_ROW(name, id, unit, text) {id, unit},
    WT_QUANTITY_LIST(QUANTITY_ROW)
#undef QUANTITY_ROW
};

static size_t row(wt_quantity quantity)
{
    return (size_t)quantity < (size_t)WT_Q_COUNT ? (size_t)quantity : (size_t)WT_Q_NONE;
}

const char *wt_quantity_id(wt_quantity quantity)
{
    return quantities[row(quantity)].id;
}

const char *wt_quantity_unit(wt_quantity quantity)
{
    return quantities[row(quantity)].unit;
}

bool wt_quantity_find(const char *id, wt_quantity *quantity)
{
    for (size_t i = 0; i < (size_t)WT_Q_COUNT; i++) {
        if (strcmp(quantities[i].id, id) == 0) {
            *quantity = (wt_quantity)i;
            return true;
        }
    }
    return false;
}
