/* Growing text buffer with functions that append HTML, gnuplot text and typography.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_REPORT_TEXT_H
#define WT_REPORT_REPORT_TEXT_H

#include "weartrack/core.h"

#include <stdarg.h>

/* A text buffer; zero-initialised it is empty. */
typedef struct text_buffer {
    char *bytes; /* NULL while empty, else zero-terminated */
    size_t length, capacity;
} text_buffer;

void text_free(text_buffer *text);                /* empty again */
const char *text_string(const text_buffer *text); /* "" while empty; borrowed */
void text_bytes(text_buffer *text, const char *bytes, size_t length);
void text_add(text_buffer *text, const char *string);
void text_format(text_buffer *text, const char *format, ...) WT_PRINTF(2, 3);
void text_vformat(text_buffer *text, const char *format, va_list arguments) WT_PRINTF(2, 0);

/* Appends a file name. If it is longer than `most` bytes, only its end, which distinguishes files,
 * after dots. */
void text_file_name(text_buffer *text, const char *name, size_t most);

/* Appends markup. All arguments are %s and are escaped for HTML content and quoted attributes.
 * Characters that are not UTF-8 or not allowed in XML become U+FFFD. */
void text_html(text_buffer *text, const char *markup, ...) WT_PRINTF(2, 3);
/* Appends a data URL with media type and bytes, for a quoted attribute. */
void text_data_link(text_buffer *text, const char *media, const char *bytes, size_t length);
/* Appends a JSON string without '<' and other markup. Invalid UTF-8 becomes U+FFFD. */
void text_json(text_buffer *text, const char *string);
/* Appends a JSON list of n strings. */
void text_json_list(text_buffer *text, const char *const *strings, size_t n);
/* Words of the verdict of a curve (a wt_curve_verdict). */
const char *verdict_text(int verdict);
/* Appends a JSON object with the words of each verdict without a usable modulus. */
void append_verdict_text(text_buffer *to);
/* Appends a text as a gnuplot string. Control characters become blanks; characters that are not
 * UTF-8 or not allowed in XML become U+FFFD. */
void text_quoted(text_buffer *text, const char *string);
/* Appends a gnuplot string for a tic label, which gnuplot reads as a format. */
void text_tic_label(text_buffer *text, const char *string);
/* Appends a comment line for a gnuplot script, with "# " and line break. */
void text_comment(text_buffer *text, const char *string);

/* Appends an ASCII text as escaped HTML with the signs of the page: "−2.9 °C" for "-2.9 degC",
 * "µm" for "um", "m³" for "m^3", "8.9×10⁻¹³" for "8.9e-13". Other text is not changed. */
void text_typographic(text_buffer *text, const char *ascii);
/* Variant that begins with a capital letter. */
void text_sentence(text_buffer *text, const char *ascii);

#endif
