/* Display units: the only conversion of SI values to the units shown (nm, nN, MPa, °C), and
 * the formats of numbers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_DISPLAY_UNITS_H
#define WT_REPORT_DISPLAY_UNITS_H

#include "core/table/result_rows_parts.h"
#include "weartrack/core.h"
#include <stdbool.h>

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
    char chars[1200];
} display_value_text;
display_value_text format_display_value(wt_quantity quantity, const char *unit, double value);
/* Formats "12.3 MPa (95 %: 11.5 to 13.1)" as the rows of a page have it, or the value alone
 * without an interval. */
display_value_text format_display_row(row_number number);
display_value_text format_display_estimate(const wt_estimate *estimate);

#define VALUE(quantity, unit, value) format_display_value(quantity, unit, value).chars
#define ESTIMATE(estimate) format_display_estimate(estimate).chars

/* A formatted number, returned by value for use within one expression: text_format(text, "%s",
 * NUMBER(x, 3)). */
typedef struct number_text {
    char chars[352]; /* at most 309 digits before the decimal mark */
} number_text;

/* Rounds to `significant` digits (but never left of the decimal point): "12.3", "−0.0046", 1.2e-7
 * as "1.2×10⁻⁷". "not known" for NaN, "∞". `trimmed` removes zeros at the end of the decimals. */
number_text number_rounded(double value, int significant, bool trimmed);
number_text number_fixed(double value, int decimals);   /* with a fixed number of decimals */
number_text number_literal(double value);               /* for gnuplot, 10 digits */
double number_to_digits(double value, int significant); /* rounds to significant digits */

#define NUMBER(value, significant) number_rounded(value, significant, false).chars
#define SHORT_NUMBER(value, significant) number_rounded(value, significant, true).chars
#define FIXED(value, decimals) number_fixed(value, decimals).chars
#define LITERAL(value) number_literal(value).chars

#endif
