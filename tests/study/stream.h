/* Tables of the text stream, weartrack-stream(5), as far as the study needs them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_STREAM_H
#define STUDY_STREAM_H

typedef struct stream stream;

/* NULL if the file does not exist or memory runs out. */
stream *stream_read(const char *path);
void stream_free(stream *s);

/* Text after `KEY:` in a table, up to the line end; NULL if there is none. */
const char *stream_key(const stream *s, const char *table, const char *key);
/* Number there, or the one after ATTRIBUTE=; nan if there is none. */
double stream_number(const stream *s, const char *table, const char *key, const char *attribute);
int stream_rows(const stream *s, const char *table);
/* Number in a column; nan without such a table, column or row. */
double stream_cell(const stream *s, const char *table, const char *column, int row);
/* True if the table has this text. */
int stream_is(const stream *s, const char *table, const char *column, int row, const char *text);

#endif
