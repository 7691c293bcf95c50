/* Table of the most common units, which avoids loading the UDUNITS-2 database.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/unit_known.h"

#include "core/base/array.h"
#include "weartrack/core.h"

#include <string.h>

static const builtin_unit builtin_table[] = {
    {"mm", "m", 1e-3, 0},
    {"um", "m", 1e-6, 0},
    {"\xC2\xB5m", "m", 1e-6, 0},
    {"\xCE\xBCm", "m", 1e-6, 0},
    {"nm", "m", 1e-9, 0},
    {"pm", "m", 1e-12, 0},
    {"mN", "N", 1e-3, 0},
    {"uN", "N", 1e-6, 0},
    {"\xC2\xB5N", "N", 1e-6, 0},
    {"nN", "N", 1e-9, 0},
    {"pN", "N", 1e-12, 0},
    {"mN/m", "N/m", 1e-3, 0},
    {"nN/nm", "N/m", 1, 0},
    {"mV", "V", 1e-3, 0},
    {"nm/V", "m/V", 1e-9, 0},
    {"um/V", "m/V", 1e-6, 0},
    {"ms", "s", 1e-3, 0},
    {"us", "s", 1e-6, 0},
    {"min", "s", 60, 0},
    {"kHz", "Hz", 1e3, 0},
    {"kHz", "1/s", 1e3, 0},
    {"Hz", "1/s", 1, 0},
    {"1/s", "Hz", 1, 0},
    {"kPa", "Pa", 1e3, 0},
    {"MPa", "Pa", 1e6, 0},
    {"GPa", "Pa", 1e9, 0},
    {"Pa", "J/m^3", 1, 0},
    {"J/m^3", "Pa", 1, 0},
    {"kPa", "J/m^3", 1e3, 0},
    {"MPa", "J/m^3", 1e6, 0},
    {"GPa", "J/m^3", 1e9, 0},
    {"1/MPa", "1/Pa", 1e-6, 0},
    {"1/MPa", "m^2/N", 1e-6, 0},
    {"1/Pa", "m^2/N", 1, 0},
    {"m^2/N", "1/Pa", 1, 0},
    {"mm^3/(N m)", "1/Pa", 1e-9, 0},
    {"degC", "K", 1, 273.15},
    {"\xC2\xB0"
     "C",
     "K", 1, 273.15},
    {"%", "1", 1e-2, 0},
    {"percent", "1", 1e-2, 0},
    {"deg", "rad", 0.017453292519943295, 0},
    {"\xC2\xB0", "rad", 0.017453292519943295, 0},
    {"mm/s", "m/s", 1e-3, 0},
    {"um/s", "m/s", 1e-6, 0},
    {"nm/s", "m/s", 1e-9, 0},
    {"1/m", "1/m", 1, 0},
    {"mm^3/(N m)", "m^2/N", 1e-9, 0},
};

const builtin_unit *builtin_units(size_t *n)
{
    *n = COUNT_OF(builtin_table);
    return builtin_table;
}

bool builtin_unit_exists(const char *text)
{
    for (size_t i = 0; i < (size_t)WT_Q_COUNT; i++)
        if (strcmp(text, wt_quantity_unit((wt_quantity)i)) == 0)
            return true;
    for (size_t i = 0; i < COUNT_OF(builtin_table); i++)
        if (strcmp(text, builtin_table[i].text) == 0)
            return true;
    return false;
}

bool builtin_unit_find(const char *text, const char *si, double *factor, double *offset)
{
    static const builtin_unit itself = {.factor = 1.0};
    const builtin_unit *found = strcmp(text, si) == 0 ? &itself : NULL;
    for (size_t i = 0; found == NULL && i < COUNT_OF(builtin_table); i++)
        if (strcmp(text, builtin_table[i].text) == 0 && strcmp(si, builtin_table[i].si) == 0)
            found = &builtin_table[i];
    if (found == NULL)
        return false;
    *factor = found->factor;
    *offset = found->offset;
    return true;
}
