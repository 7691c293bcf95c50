/* Tables of the text stream, weartrack-stream(5), as far as the study asks for them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_STREAM_H
#define STUDY_STREAM_H

typedef struct stream stream;

/* NULL if the file is not there or memory runs out. */
stream *stream_read(const char *path);
void stream_free(stream *s);

/* What stands after `KEY:` in a table, up to the end of the line; NULL if it is not there. */
const char *stream_key(const stream *s, const char *table, const char *key);
/* The number there, or the one after ATTRIBUTE=; nan if it is not there. */
double stream_number(const stream *s, const char *table, const char *key, const char *attribute);
int stream_rows(const stream *s, const char *table);
/* The number in a column; nan if there is no such table, column or row. */
double stream_cell(const stream *s, const char *table, const char *column, int row);
/* Does this stand there? */
int stream_is(const stream *s, const char *table, const char *column, int row, const char *text);

#endif
