/* The set of formats as the other files of this room see it, and how a file finds its reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FORMATS_H
#define WT_READ_FORMATS_H

#include "read/reader.h"

/* The i-th reader of a set, in the order of wt_formats_get; borrowed. */
const file_reader *formats_reader(const wt_formats *formats, size_t i);
/* Takes the description, also on failure; one of the same id is replaced, with a note. */
wt_status formats_add_text(wt_formats *formats, struct text_description *description, wt_log *log,
                           const char *path, wt_error *err);
/* A set of this one alone, taken also on failure. */
wt_status formats_of(struct text_description *description, const char *path, wt_formats **formats,
                     wt_error *err);
/* The reader of that id, or NULL. */
const file_reader *formats_find_reader(const wt_formats *formats, const char *id);

/* detect.c: the reader that the bytes belong to as they are: the one of that format, or with NULL
 * the one that recognises them. `kinds` limits the question (0 = any); what is recognised but has
 * none of them is WT_E_EMPTY and says so. */
wt_status detect_reader(const wt_formats *formats, wt_input *input, const char *format,
                        unsigned kinds, const file_reader **reader, wt_error *err);

/* content.c: the same of what is packed in the input, which *content is then; the input keeps it.
 * It is the input itself if nothing is packed there. */
wt_status find_reader(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      unsigned kinds, const file_reader **reader, wt_input **content,
                      wt_error *err);

/* start.c: what each kind of reading begins with: `given` or the defaults, checked, the reader and
 * what it is to read. */
typedef struct reading {
    wt_read_options options;
    const file_reader *reader;
    wt_input *content;
} reading;
wt_status read_start(const wt_formats *formats, wt_input *input, const wt_read_options *given,
                     unsigned kind, reading *begun, wt_error *err);
/* And ends with: the name of the file in the error, if there is one; memory that failed a library.
 */
wt_status read_end(wt_input *input, wt_status status, wt_error *err);

#endif
