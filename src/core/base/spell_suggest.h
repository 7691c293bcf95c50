/* The name that was meant. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_SPELL_SUGGEST_H
#define WT_CORE_BASE_SPELL_SUGGEST_H

#include <stddef.h>

/* How many letters apart two words are: one is put in, left out, changed, or swapped with its
 * neighbour (optimal string alignment); capitals are small letters. SIZE_MAX for words of more than
 * 63 bytes. */
size_t nearest_distance(const char *a, size_t n_a, const char *b, size_t n_b);

/* A search among names for the one that is nearest to a word. */
typedef struct spell_suggestion {
    const char *word;
    size_t length;
    const char *name; /* borrowed; NULL: none is near, or two are as near */
    size_t name_length, distance;
} spell_suggestion;
spell_suggestion nearest_to(const char *word, size_t length);
/* One name more. Near is what is one letter apart for every three of the word. */
void spell_suggestion_try(spell_suggestion *nearest, const char *name, size_t length);

#endif
