/* A text that grows, and the ways of writing into it: HTML, gnuplot scripts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_REPORT_TEXT_H
#define WT_REPORT_REPORT_TEXT_H

#include "report/language.h"

#include <stdarg.h>

/* Zero-initialised it is empty. A write that finds no memory sets `failed` and later writes do
 * nothing, so that one check at the end is enough. */
typedef struct text_buffer {
    char *bytes; /* NULL while empty, else zero-terminated */
    size_t length, capacity;
    bool failed;
    const language *language; /* of what is said in it; NULL: English */
} text_buffer;

void text_free(text_buffer *text);                /* empty again */
const char *text_string(const text_buffer *text); /* "" while empty; borrowed */
/* Frees a text that was written into `whole`, which has failed if that has. */
void text_done(text_buffer *part, text_buffer *whole);
void text_bytes(text_buffer *text, const char *bytes, size_t length);
void text_add(text_buffer *text, const char *string);
void text_format(text_buffer *text, const char *format, ...) WT_PRINTF(2, 3);
void text_vformat(text_buffer *text, const char *format, va_list arguments) WT_PRINTF(2, 0);

/* A name, of one that has more bytes than so many the end, behind dots: it tells files apart. */
void text_name(text_buffer *text, const char *name, size_t most);

/* The same with a text in the language, whose English form it is. */
void text_append_phrase(text_buffer *text, const char *english);
void text_append_translated(text_buffer *text, const char *english, ...) WT_PRINTF(2, 3);

/* Markup; the arguments, all of them %s, are escaped for HTML element content and quoted
 * attributes. What is not UTF-8 or not allowed in XML becomes U+FFFD. */
void text_html(text_buffer *text, const char *markup, ...) WT_PRINTF(2, 3);
/* A link that holds what it leads to: "data:", type of media, the bytes. For a quoted attribute. */
void text_data_link(text_buffer *text, const char *media, const char *bytes, size_t length);
/* A gnuplot string that means this text, whatever it holds; control characters become blanks, what
 * is not UTF-8 or not allowed in XML becomes U+FFFD. */
void text_quoted(text_buffer *text, const char *string);
/* The same as the label of a tic, which gnuplot takes for a format. */
void text_tic(text_buffer *text, const char *string);
/* A comment of one line for a gnuplot script, "# " and line break included. */
void text_comment(text_buffer *text, const char *string);

#endif
