/* Declares the set of formats for the files of this folder, and how the reader of a file is found.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_FORMATS_H
#define WT_READ_FORMATS_H

#include "read/reader.h"

/* Returns the i-th reader of a set, in the order of wt_formats_get; borrowed. */
const file_reader *formats_reader(const wt_formats *formats, size_t i);
/* Adds a description and takes ownership of it, also on failure. A description with the same id is
 * replaced, with a note in the log. */
wt_status formats_add_description(wt_formats *formats, struct text_description *description,
                                  wt_log *log, const char *path, wt_error *err);
/* Creates a set with this description alone. Ownership passes to the function, also on failure. */
wt_status formats_from_description(struct text_description *description, const char *path,
                                   wt_formats **formats, wt_error *err);
/* Returns the reader with this id, or NULL. */
const file_reader *formats_find_reader(const wt_formats *formats, const char *id);

/* detect.c: finds the reader of the bytes as they are: the reader of `format`, or with NULL the one
 * that recognises them. `kinds` limits the search (0: any). A recognised file without any of these
 * kinds is WT_E_EMPTY. */
wt_status detect_reader(const wt_formats *formats, wt_input *input, const char *format,
                        unsigned kinds, const file_reader **reader, wt_error *err);

/* unpack.c: unpacks the input and finds the reader of its content. *content is the unpacked input,
 * which `input` owns. It is `input` itself if nothing is packed. */
wt_status find_reader(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      unsigned kinds, const file_reader **reader, wt_input **content,
                      wt_error *err);

/* reader_select.c: begins every kind of read. It checks `given` (NULL: the defaults), and finds the
 * reader and the unpacked content. */
typedef struct read_request {
    wt_read_options options;
    const file_reader *reader;
    wt_input *content;
} read_request;
wt_status read_start(const wt_formats *formats, wt_input *input, const wt_read_options *given,
                     unsigned kind, read_request *request, wt_error *err);
/* Ends every kind of read: adds the file name to an error and reports a resource error of a
 * library. */
wt_status read_end(wt_input *input, wt_status status, wt_error *err);

#endif
