/* Parses numbers in a text and formats probabilities. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_NUMBER_H
#define WT_CORE_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Text of a range, such as "0.79 to 0.812", returned by value for use in a format. */
typedef struct range_text {
    char text[64];
} range_text;

/* Returns the length of the longest number at the start of `text`, 0 if there is none. An "e"
 * without a digit after it belongs to the following text ("5eV"). */
size_t number_prefix_length(const char *text, size_t length, char decimal);
/* Parses a text that is one finite number with a decimal point; NaN for NULL or another text. */
double parse_number_or_nan(const char *text);
/* Parses the output of wt_number_format, which includes "nan", "inf" and "-inf". */
bool parse_stored_number(const char *text, size_t length, double *value);
/* Rounds a value to 10^-decimals if `decimals` is negative. Otherwise the value is returned
 * unchanged, because printf rounds it. */
double round_to_power_of_ten(double value, int decimals);
double round_to_digits(double value, int digits); /* to significant digits */
/* Converts a bound of a share to per cent and rounds it up to a tenth. */
double round_up_percent(double share);
/* True for equal numbers, and if both are NaN. */
bool is_same_number(double a, double b);
/* Text of a probability, such as "0.02"; small values are "below 0.001". */
typedef struct probability_text {
    char text[16];
} probability_text;
probability_text format_probability(double chance);
/* Text of a share in per cent, with two digits at least and all before the point: "0.75 %", "12 %",
 * "140 %". */
typedef struct percent_text {
    char text[24];
} percent_text;
percent_text format_percent(double share);
/* Formats two numbers with the digits, at least `least`, with which they differ in print. */
range_text format_range(double low, double high, int least);

#endif
