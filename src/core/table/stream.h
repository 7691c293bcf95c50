/* Common rules of the writer and the reader of the text stream; see weartrack-stream(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_STREAM_H
#define WT_CORE_TABLE_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Unit of a text column in the header line. */
#define STREAM_TEXT_UNIT "text"

/* Writes a text as one cell: "-" for an empty text, with escapes for control characters, bytes that
 * are not UTF-8, and a "#" or a single "-" at the start. */
void stream_write_text(FILE *out, const char *text);
/* Decodes a cell in place and adds a terminating zero. False for an invalid escape. */
bool stream_unescape(char *text, size_t length);

#endif
