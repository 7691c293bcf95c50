/* Display units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/display_units.h"

#include "core/base/number.h"
#include "report/number_format.h"

#include <math.h>
#include <string.h>

typedef struct display_unit_series {
    const char *unit; /* SI */
    int power;        /* exponent of ten of the first label; each next one is less by three */
    const char *labels[5];
} display_unit_series;

/* Series of units, smallest first. */
static const display_unit_series choices[] = {
    {"m", 9, {"nm", "µm", "mm", "m"}},
    {"N", 12, {"pN", "nN", "µN", "mN", "N"}},
    {"Pa", 0, {"Pa", "kPa", "MPa", "GPa"}},
    {"s", 9, {"ns", "µs", "ms", "s"}},
    {"m/s", 9, {"nm/s", "µm/s", "mm/s", "m/s"}},
    {"m/V", 9, {"nm/V", "µm/V"}},
    {"W/m^2", 0, {"W/m²", "kW/m²", "MW/m²"}},
    {"W/m^3", 0, {"W/m³", "kW/m³", "MW/m³", "GW/m³"}},
    {"J/m^3", 0, {"J/m³", "kJ/m³", "MJ/m³", "GJ/m³"}},
    {"J/mol", 0, {"J/mol", "kJ/mol"}},
    {"m^2/N", 9, {"mm³/(N·m)"}},
    {"m^4", 0, {"m⁴"}},
    {"byte", 0, {"byte"}},
    {"1", 0, {""}},
    {"", 0, {""}},
};

display_unit select_display_unit(wt_quantity quantity, const char *unit, double magnitude)
{
    if (unit == NULL)
        unit = wt_quantity_unit(quantity);
    display_unit lab = {.factor = 1, .offset = 0, .label = ""};
    if (quantity == WT_Q_TEMPERATURE && strcmp(unit, "K") == 0) {
        lab.offset = -WT_ZERO_CELSIUS;
        (void)strcpy(lab.label, "°C");
        return lab;
    }
    if (strcmp(unit, "rad") == 0) {
        lab.factor = 180 / M_PI;
        (void)strcpy(lab.label, "°");
        return lab;
    }
    const display_unit_series *choice = choices, *end = choices + sizeof choices / sizeof *choices;
    while (choice < end && strcmp(choice->unit, unit) != 0)
        choice++;
    if (choice == end)
        (void)snprintf(lab.label, sizeof lab.label, "%s", unit);
    for (int i = 0; choice < end && i < 5 && choice->labels[i] != NULL; i++) {
        double factor = pow(10, choice->power - 3 * i);
        // A tolerance of a thousandth: 0.99999 µm by rounding is still 1 µm.
        if (i > 0 && !(isfinite(magnitude) && fabs(magnitude) * factor >= 0.999))
            continue;
        lab.factor = factor;
        (void)snprintf(lab.label, sizeof lab.label, "%s", choice->labels[i]);
    }
    return lab;
}

double to_display_value(const display_unit *lab, double value)
{
    return value * lab->factor + lab->offset;
}

display_value_text format_display_value(wt_quantity quantity, const char *unit, double value)
{
    display_unit lab = select_display_unit(quantity, unit, value);
    bool bare = !isfinite(value) || lab.label[0] == '\0';
    display_value_text text;
    (void)snprintf(text.chars, sizeof text.chars, "%s%s%s",
                   SHORT_NUMBER(to_display_value(&lab, value), 3), bare ? "" : " ",
                   bare ? "" : lab.label);
    return text;
}

display_value_text format_display_estimate(const wt_estimate *estimate)
{
    display_unit lab = select_display_unit(WT_Q_NONE, estimate->unit, estimate->value);
    double error = fabs(estimate->standard_error) * lab.factor;
    if (!(error > 0) || !isfinite(estimate->value)) {
        display_value_text value = format_display_value(WT_Q_NONE, estimate->unit, estimate->value),
                           text;
        if (!isnan(error) || !isfinite(estimate->value))
            return value;
        (void)snprintf(text.chars, sizeof text.chars, "%.700s (error not known)", value.chars);
        return text;
    }
    const int decimals = (int)fmin(9, 1 - floor(log10(error)));
    display_value_text text;
    (void)snprintf(
        text.chars, sizeof text.chars, "%s ± %s%s%s",
        FIXED(round_to_power_of_ten(to_display_value(&lab, estimate->value), decimals), decimals),
        FIXED(round_to_power_of_ten(error, decimals), decimals), lab.label[0] != '\0' ? " " : "",
        lab.label);
    return text;
}
