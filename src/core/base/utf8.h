/* Checks, truncates and sanitizes UTF-8 text. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_UTF8_H
#define WT_CORE_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

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

#endif
