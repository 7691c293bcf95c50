/* Rules that the writer and the reader of the text stream share; see weartrack-stream(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_STREAM_H
#define WT_CORE_TABLE_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What stands between square brackets behind the name of a text column. */
#define STREAM_TEXT_UNIT "text"

/* Writes text as one cell: "-" for the empty text, escapes for what would break the line, for what
 * is not UTF-8 and, at the start of a cell, for '-' alone and '#'. */
void stream_put_text(FILE *out, const char *text);
/* Undoes it in place and ends the text with a zero. False if an escape is not one of ours. */
bool stream_unescape(char *text, size_t length);

#endif
