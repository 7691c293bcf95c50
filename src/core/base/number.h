/* The number at the start of a text. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_NUMBER_H
#define WT_CORE_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* Length of the longest number at the start of `text`, 0 if there is none. An "e" that no digit
 * follows belongs to what comes after ("5eV"). */
size_t number_prefix(const char *text, size_t length, char decimal);
/* A text that is one finite number, with a decimal point; NaN if it is not, or NULL. */
double number_of(const char *text);
/* Reads what wt_number_format writes: also "nan", "inf" and "-inf". */
bool number_read(const char *text, size_t length, double *value);
/* A value to so many decimals, which below 0 are tens, hundreds ...: there it is rounded to them,
 * else as it is, for the text to round. */
double number_to_tens(double value, int decimals);
/* A probability in a sentence: "0.02", "below 0.001" where more digits tell nobody more. */
typedef struct probability_text {
    char text[16];
} probability_text;
probability_text number_chance(double chance);

#endif
