/* Two ends of a range as text. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_RANGE_TEXT_H
#define WT_CORE_BASE_RANGE_TEXT_H

/* Digits, so many at least, that tell two numbers apart. */
int range_digits(double low, double high, int least);

/* "0.79 to 0.812": plain numbers with those digits, for use in a format. */
typedef struct range_text {
    char text[64];
} range_text;
range_text format_range(double low, double high, int least);

#endif
