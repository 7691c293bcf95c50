/* Closed list of quantities with their units, examples and limits. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/quantity.h"

#include <math.h>
#include <string.h>

_Static_assert(WT_Q_COUNT <= 64, "wt_quantity_set has one bit per quantity");

static const struct {
    const char *id, *unit;
} quantities[] = {
#define QUANTITY_ROW(name, id, unit, text) {id, unit},
    WT_QUANTITY_LIST(QUANTITY_ROW)
#undef QUANTITY_ROW
};

static size_t quantity_row(wt_quantity quantity)
{
    return (size_t)quantity < (size_t)WT_Q_COUNT ? (size_t)quantity : (size_t)WT_Q_NONE;
}

const char *wt_quantity_id(wt_quantity quantity)
{
    return quantities[quantity_row(quantity)].id;
}

const char *wt_quantity_unit(wt_quantity quantity)
{
    return quantities[quantity_row(quantity)].unit;
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

typedef struct unit_info {
    const char *unit, *example;
    double most;
} unit_info;

static const unit_info *find_unit_info(wt_quantity quantity)
{
    static const unit_info by_unit[] = {{"1", "0.5", 1e30},
                                        {"s", "10s", 1e30},
                                        {"m", "250nm", 1e6},
                                        {"V", "1.5V", 1e6},
                                        {"N", "20nN", 1e9},
                                        {"rad", "35deg", 1e6},
                                        {"Hz", "10Hz", 1e30},
                                        {"rad/s", "63rad/s", 1e30},
                                        {"Pa", "0.4MPa", 1e15},
                                        {"1/Pa", "0.5MPa^-1", 1e6},
                                        {"rad/m", "1e6rad/m", 1e15},
                                        {"m^4", "1e-30m^4", 1e12},
                                        {"m^3", "1e-24m^3", 1e12},
                                        {"m/s", "1mm/s", 1e9},
                                        {"N/m", "0.3N/m", 1e9},
                                        {"m/V", "50nm/V", 1e3},
                                        {"m^2/N", "1e-4mm^3/(N m)", 1e3},
                                        {"J/m^3", "1e5J/m^3", 1e30},
                                        {"W/m^3", "1e9W/m^3", 1e30},
                                        {"1/s", "0.1s^-1", 1e30},
                                        {"byte", "1000byte", 1e30},
                                        {"K", "20degC", 1e5},
                                        {"m.Hz^-0.5", "1e-12m/sqrt(Hz)", 1},
                                        {"m^2/Hz", "1e-26m^2/Hz", 1},
                                        {"V^2/Hz", "1e-10V^2/Hz", 1e6},
                                        {"V.Hz^-0.5", "1e-5V/sqrt(Hz)", 1e3},
                                        {"kg/m^3", "1100kg/m^3", 1e6},
                                        {"1/K", "2e-4K^-1", 1e3},
                                        {"m^2", "2e-9m^2", 1e12},
                                        {"kg", "3mg", 1e9},
                                        {"J/(m^3 K)", "2.2e6J/(m^3 K)", 1e12},
                                        {"m^2/s", "1e-7m^2/s", 1e6},
                                        {"N m", "5N mm", 1e9},
                                        {"J/mol", "80kJ/mol", 1e12}};
    size_t i = 0;
    while (strcmp(by_unit[i].unit, wt_quantity_unit(quantity)) != 0)
        i++;
    return &by_unit[i];
}

const char *quantity_example(wt_quantity quantity)
{
    return quantity == WT_Q_TEMPERATURE_DIFFERENCE ? "5K" : find_unit_info(quantity)->example;
}

/* No polymer survives a higher temperature, and no instrument of this field reaches it. The limit
 * does not hold for temperature differences, which are also constants of laws. */
static const double hottest = 2000; /* [K] */

double quantity_plausible_maximum(wt_quantity quantity)
{
    return quantity == WT_Q_TEMPERATURE ? hottest : find_unit_info(quantity)->most;
}

bool quantity_is_plausible(wt_quantity quantity, double value)
{
    return fabs(value) <= quantity_plausible_maximum(quantity);
}

wt_status quantity_implausible_error(wt_quantity quantity, const char *found, wt_error *err)
{
    const unit_info *w = find_unit_info(quantity);
    (void)wt_fail(err, WT_E_RANGE, "beyond anything that there is");
    const bool bare = strcmp(w->unit, "1") == 0;
    wt_error_expected(err, "at most %g%s%s", quantity_plausible_maximum(quantity), bare ? "" : " ",
                      bare ? "" : w->unit);
    wt_error_found(err, "%s", found);
    return WT_E_RANGE;
}
