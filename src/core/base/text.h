/* Text in the C locale, so that printf and strtod use a decimal point in any program, and checks of
 * UTF-8. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_TEXT_H
#define WT_CORE_BASE_TEXT_H

#include "weartrack/core.h"

#include <locale.h>
#include <stdarg.h>
#include <stdio.h>

/* Switches the locale of the calling thread. Returns the argument for clocale_leave. Calls nest. */
locale_t clocale_enter(void);
void clocale_leave(locale_t previous);

/* snprintf and vsnprintf in the C locale, for every text with a decimal fraction. */
int clocale_print(char *buffer, size_t size, const char *format, ...) WT_PRINTF(3, 4);
int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
    WT_PRINTF(3, 0);
/* Appends to a text; what does not fit is truncated. */
void clocale_append(char *text, size_t size, const char *format, ...) WT_PRINTF(3, 4);

/* Returns the length in bytes (1 to 4) of the well-formed character at `text`, 0 if there is none
 * within `length` bytes. Overlong forms and surrogates are not well-formed. */
size_t utf8_character_length(const char *text, size_t length);
/* Returns the offset of the first byte that is not well-formed UTF-8, `length` if there is none. */
size_t utf8_valid_length(const char *text, size_t length);
/* Returns the largest number of bytes <= limit that does not split a character. */
size_t utf8_truncated_length(const char *text, size_t length, size_t limit);
/* Copies as many whole characters as fit and adds a terminating zero; size > 0. */
void utf8_copy(char *to, size_t size, const char *text);
/* Sanitizes text for one line of a terminal or a page: control characters become blanks, bytes that
 * are not UTF-8 become '?'. */
void utf8_sanitize(char *text);
/* Writes a text in quotes with the JSON escapes. A byte that is not UTF-8 becomes U+FFFD. */
void json_write_text(FILE *out, const char *text);

/* ---- misspelled words ------------------------------------------------------------------------ */

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
