/* Formats values with an SI prefix for people to read. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "weartrack/core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Range of the SI prefixes of a unit, as powers of 1000. */
typedef struct prefix_range {
    const char *unit;
    const char *text;
    int low, high;
} prefix_range;

/* Finds the prefixes of the first factor of the unit, unless it is raised to a power. */
static prefix_range find_prefix_range(const char *unit)
{
    static const prefix_range known[] = {
        {"Pa", "Pa", -8, 8}, {"Hz", "Hz", -8, 8}, {"N", "N", -8, 8},
        {"m", "m", -8, 1},   {"V", "V", -8, 8},   {"J", "J", -8, 8},
        {"W", "W", -8, 8},   {"s", "s", -8, 0},   {"byte", "B", 0, 8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const size_t n = strlen(known[i].unit);
        if (strncmp(unit, known[i].unit, n) == 0 && (unit[n] == '\0' || strchr("/ .", unit[n])))
            return known[i];
    }
    return (prefix_range){"", "", 0, 0};
}

static int floor_divide_by_three(int exponent)
{
    return exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
}

/* Formats the significant digits of value / 10^shift: plain for short numbers, otherwise with an
 * exponent. */
static void format_scaled_number(double value, int digits, int shift, char *buffer, size_t size)
{
    char scientific[48], shifted[64];
    (void)snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
    char *const e = strchr(scientific, 'e');
    const int exponent = atoi(e + 1) - shift;
    *e = '\0';
    if (exponent < -3 || exponent > 5) {
        (void)snprintf(buffer, size, "%se%d", scientific, exponent);
        return;
    }
    (void)snprintf(shifted, sizeof shifted, "%se%d", scientific, exponent);
    const int decimals = digits - 1 - exponent;
    (void)snprintf(buffer, size, "%.*f", decimals > 0 ? decimals : 0, strtod(shifted, NULL));
}

size_t wt_format_si(double value, const char *unit, int digits, char *buffer, size_t size)
{
    static const char *const names[] = {"y", "z", "a", "f", "p", "n", "\xC2\xB5", "m", "",
                                        "k", "M", "G", "T", "P", "E", "Z",        "Y"};
    char number[64];
    int step = 0;
    prefix_range prefix = find_prefix_range(unit);
    const bool celsius = strcmp(unit, "degC") == 0 || strcmp(unit, "\xC2\xB0"
                                                                   "C") == 0;
    if (celsius) {
        value -= WT_ZERO_CELSIUS;
        unit = "\xC2\xB0"
               "C";
    }
    digits = digits < 1 ? 1 : digits > 17 ? 17 : digits;
    const locale_t previous = clocale_enter();
    if (!isfinite(value)) {
        (void)wt_number_format(value, number);
    } else {
        if (value != 0.0 && prefix.unit[0] != '\0') {
            /* The exponent is that after rounding: 999.96 kPa is 1.00 MPa. */
            char scientific[48];
            (void)snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
            step = floor_divide_by_three(atoi(strchr(scientific, 'e') + 1));
            step = step < prefix.low ? prefix.low : step > prefix.high ? prefix.high : step;
        }
        format_scaled_number(value, digits, 3 * step, number, sizeof number);
    }
    const bool bare = unit[0] == '\0' || strcmp(unit, "1") == 0;
    const int needed =
        snprintf(buffer, size, "%s%s%s%s%s", number, bare ? "" : " ", names[step + 8], prefix.text,
                 bare ? "" : unit + strlen(prefix.unit));
    clocale_leave(previous);
    return needed > 0 ? (size_t)needed : 0;
}
