/* Suggests the name that a misspelled word probably means. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_BASE_SPELL_SUGGEST_H
#define WT_CORE_BASE_SPELL_SUGGEST_H

#include <stddef.h>

/* Returns the optimal string alignment distance of two words: the number of inserted, deleted,
 * changed or swapped letters, ignoring case. SIZE_MAX for words of more than 63 bytes. */
size_t spelling_distance(const char *a, size_t n_a, const char *b, size_t n_b);

/* Search for the name with the smallest distance to a word. */
typedef struct spell_suggestion {
    const char *word;
    size_t length;
    const char *name; /* borrowed; NULL if no name is similar, or if two are equally similar */
    size_t name_length, distance;
} spell_suggestion;
spell_suggestion spell_suggestion_begin(const char *word, size_t length);
/* Compares a further name. A similar name has at most one difference for every three letters. */
void spell_suggestion_try(spell_suggestion *nearest, const char *name, size_t length);
/* Returns what to do instead of an option or case element of an earlier version that left; NULL for
 * any other name. CHANGELOG.md has the reasons. */
const char *removed_name_advice(const char *name, size_t length);

#endif
