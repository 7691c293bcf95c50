/* Lab units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/units.h"

#include <math.h>
#include <string.h>

typedef struct lab_choice {
    const char *unit; /* SI */
    double factor;
    const char *label;
} lab_choice;

/* Smallest first for each SI unit. */
static const lab_choice choices[] = {
    {"m", 1e9, "nm"},
    {"m", 1e6, "µm"},
    {"m", 1e3, "mm"},
    {"m", 1, "m"},
    {"N", 1e12, "pN"},
    {"N", 1e9, "nN"},
    {"N", 1e6, "µN"},
    {"N", 1e3, "mN"},
    {"N", 1, "N"},
    {"Pa", 1, "Pa"},
    {"Pa", 1e-3, "kPa"},
    {"Pa", 1e-6, "MPa"},
    {"Pa", 1e-9, "GPa"},
    {"s", 1e9, "ns"},
    {"s", 1e6, "µs"},
    {"s", 1e3, "ms"},
    {"s", 1, "s"},
    {"m/s", 1e9, "nm/s"},
    {"m/s", 1e6, "µm/s"},
    {"m/s", 1e3, "mm/s"},
    {"m/s", 1, "m/s"},
    {"m/V", 1e9, "nm/V"},
    {"m/V", 1e6, "µm/V"},
    {"W/m^2", 1, "W/m²"},
    {"W/m^2", 1e-3, "kW/m²"},
    {"W/m^2", 1e-6, "MW/m²"},
    {"W/m^3", 1, "W/m³"},
    {"W/m^3", 1e-3, "kW/m³"},
    {"W/m^3", 1e-6, "MW/m³"},
    {"W/m^3", 1e-9, "GW/m³"},
    {"J/m^3", 1, "J/m³"},
    {"J/m^3", 1e-3, "kJ/m³"},
    {"J/m^3", 1e-6, "MJ/m³"},
    {"J/m^3", 1e-9, "GJ/m³"},
    {"J/mol", 1, "J/mol"},
    {"J/mol", 1e-3, "kJ/mol"},
    {"m^2/N", 1e9, "mm³/(N·m)"},
    {"byte", 1, "byte"},
    {"1", 1, ""},
    {"", 1, ""},
};

/* "m^4" as "m⁴", "m.Hz^-0.5" as it is but for whole exponents. */
static void pretty(const char *unit, char *label, size_t size)
{
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    size_t n = 0;
    for (const char *s = unit; *s != '\0'; s++) {
        char one[2] = {*s, '\0'};
        const char *part = one;
        if (s[0] == '^' && s[1] >= '0' && s[1] <= '9' && !(s[2] >= '0' && s[2] <= '9') &&
            s[2] != '.') {
            part = digit[s[1] - '0'];
            s++;
        } else if (s[0] == '.')
            part = "·";
        size_t length = strlen(part);
        if (n + length + 1 > size)
            break;
        memcpy(label + n, part, length);
        n += length;
    }
    label[n] = '\0';
}

lab_unit lab_unit_for(wt_quantity quantity, const char *unit, double magnitude)
{
    if (unit == NULL)
        unit = wt_quantity_unit(quantity);
    lab_unit lab = {.factor = 1, .offset = 0, .label = ""};
    if (quantity == WT_Q_TEMPERATURE && strcmp(unit, "K") == 0) {
        lab.offset = -WT_ZERO_CELSIUS;
        (void)strcpy(lab.label, "°C");
        return lab;
    }
    const lab_choice *best = NULL;
    for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
        if (strcmp(choices[i].unit, unit) != 0)
            continue;
        // A thousandth of slack: 1 µm that rounding made 0.99999 µm is still 1 µm.
        if (best == NULL || (isfinite(magnitude) && fabs(magnitude) * choices[i].factor >= 0.999))
            best = &choices[i];
    }
    if (best == NULL) {
        pretty(unit, lab.label, sizeof lab.label);
        return lab;
    }
    lab.factor = best->factor;
    (void)snprintf(lab.label, sizeof lab.label, "%s", best->label);
    return lab;
}

double lab_value(const lab_unit *lab, double value)
{
    return value * lab->factor + lab->offset;
}
