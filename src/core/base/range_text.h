/* Formats a range of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_RANGE_TEXT_H
#define WT_CORE_BASE_RANGE_TEXT_H

/* Returns the number of digits, at least `least`, with which two numbers differ in print. */
int range_digits(double low, double high, int least);

/* Text of a range, such as "0.79 to 0.812", returned by value for use in a format. */
typedef struct range_text {
    char text[64];
} range_text;
range_text format_range(double low, double high, int least);

#endif
