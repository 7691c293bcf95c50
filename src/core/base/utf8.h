/* UTF-8 well-formedness. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_UTF8_H
#define WT_CORE_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* Length in bytes (1 to 4) of the well-formed character at `text`, 0 if the at most `length` bytes
 * there do not begin with one. Overlong forms and surrogates are not well-formed. */
size_t utf8_character(const char *text, size_t length);
/* Offset of the first byte that is not well-formed UTF-8; `length` if all of it is. */
size_t utf8_check(const char *text, size_t length);
/* Largest number of bytes <= limit at which `text` may be cut without splitting a character. */
size_t utf8_cut(const char *text, size_t length, size_t limit);
/* Copies what of a text has room, in whole characters, and ends it. size > 0. */
void utf8_copy(char *to, size_t size, const char *text);
/* Makes text fit for one line of a terminal or a page: control characters become a blank, bytes
 * that are not UTF-8 become '?'. */
void utf8_tidy(char *text);

#endif
