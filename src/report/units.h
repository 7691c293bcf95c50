/* Lab units: SI values are turned into what a lab reads (nm, nN, MPa, °C) here and nowhere else.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_UNITS_H
#define WT_REPORT_UNITS_H

#include "weartrack/base.h"

/* lab value = SI value * factor + offset */
typedef struct lab_unit {
    double factor, offset;
    char label[40]; /* "MPa", "" for a number */
} lab_unit;

/* The unit in which a value of that size [SI] reads best; a magnitude that is 0 or not finite gives
 * the smallest usual one. `name` of the column or key tells a temperature (°C) from a difference of
 * temperatures (K). */
lab_unit lab_unit_for(const char *unit, const char *name, double magnitude);
double lab_value(const lab_unit *lab, double value);

#endif
