/* Formats numbers for display, independent of the locale, in UTF-8.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_NUMBER_FORMAT_H
#define WT_REPORT_NUMBER_FORMAT_H

#include <stdbool.h>

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
