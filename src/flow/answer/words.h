/* Numbers and reasons in the sentences of an answer. Internal to flow. SPDX-License-Identifier:
 * GPL-3.0-or-later
 */
#ifndef WEARTRACK_FLOW_WORDS_H
#define WEARTRACK_FLOW_WORDS_H

#include "data/tables/tables.h"

/* Indentation and DMA further apart than this factor do not describe one rubber: strain and the
 * equivalent frequency do not explain it. */
#define ANSWER_DMA_FACTOR 3.0

/* "1.15 um" in a buffer of its own, for use in a format. */
typedef struct number_words {
    char text[96];
} number_words;

number_words words_of(double value, const char *unit);
number_words words_of_value(wt_estimate estimate);    /* without its errors */
number_words words_of_estimate(wt_estimate estimate); /* +- the standard error where it is known */
number_words words_of_celsius(double kelvin);
/* "3 poor fit, 1 saturated" of the rejected curves; how many there are. */
size_t words_of_rejected(const table_view *indentation, char *text, size_t size);

#endif
