/* Display units: the only conversion of SI values to the units shown (nm, nN, MPa, °C).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_DISPLAY_UNITS_H
#define WT_REPORT_DISPLAY_UNITS_H

#include "weartrack/core.h"

/* displayed value = SI value * factor + offset */
typedef struct display_unit {
    double factor, offset;
    char label[40]; /* "MPa", "" for a number */
} display_unit;

/* Returns the display unit for a magnitude in the SI unit `unit` (NULL = that of the quantity). A
 * magnitude of 0 or not finite gives the smallest usual unit. Temperatures are in °C, temperature
 * differences in K. */
display_unit select_display_unit(wt_quantity quantity, const char *unit, double magnitude);
double to_display_value(const display_unit *lab, double value);

/* Formats a value in the SI unit `unit` (NULL = that of the quantity) with its display unit, up to
 * 3 digits: "1.15 µm". */
typedef struct display_value_text {
    char chars[800];
} display_value_text;
display_value_text format_display_value(wt_quantity quantity, const char *unit, double value);
/* Formats "12.3 ± 0.4 MPa" with the standard error, or the value alone without one. */
display_value_text format_display_estimate(const wt_estimate *estimate);

#define VALUE(quantity, unit, value) format_display_value(quantity, unit, value).chars
#define ESTIMATE(estimate) format_display_estimate(estimate).chars

#endif
