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

#endif
