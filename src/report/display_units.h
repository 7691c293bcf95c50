/* Lab units: SI values are turned into what a lab reads (nm, nN, MPa, °C) here and nowhere else.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_DISPLAY_UNITS_H
#define WT_REPORT_DISPLAY_UNITS_H

#include "report/language.h"

/* lab value = SI value * factor + offset */
typedef struct lab_unit {
    double factor, offset;
    char label[40]; /* "MPa", "" for a number */
} lab_unit;

/* The unit in which a value of that size [`unit`, SI; NULL = that of the quantity] reads best; a
 * magnitude that is 0 or not finite gives the smallest usual one. A temperature is in °C, a
 * difference of temperatures in K. */
lab_unit lab_unit_for(wt_quantity quantity, const char *unit, double magnitude);
double lab_value(const lab_unit *lab, double value);

/* A value [`unit`, NULL = that of the quantity] with its lab unit, up to 3 digits: "1.15 µm". */
typedef struct display_value_text {
    char words[800];
} display_value_text;
display_value_text format_display_value(const language *l, wt_quantity quantity, const char *unit,
                                        double value);
/* "12.3 ± 0.4 MPa" with the standard error, the value alone without one. */
display_value_text format_display_estimate(const language *l, const wt_estimate *estimate);

#define VALUE(l, quantity, unit, value) format_display_value(l, quantity, unit, value).words
#define ESTIMATE(l, estimate) format_display_estimate(l, estimate).words

#endif
