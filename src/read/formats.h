/* Declares the set of formats for the files of this folder, and how the reader of a file is found.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_FORMATS_H
#define WT_READ_FORMATS_H

#include "read/reader.h"

/* Returns the i-th reader of a set, in the order of wt_formats_get; borrowed. */
const file_reader *formats_reader(const wt_formats *formats, size_t i);
/* Creates a set with this description alone. Ownership passes to the function, also on failure. */
wt_status formats_from_description(struct text_description *description, const char *path,
                                   wt_formats **formats, wt_error *err);
/* Returns the reader with this id, or NULL. */
const file_reader *formats_find_reader(const wt_formats *formats, const char *id);

/* True for a reader that recognises text. It is queried only if no reader recognises a
 * signature. */
static inline bool reader_is_text(const file_reader *reader)
{
    return reader->description != NULL && reader->runs == NULL;
}

/* detect.c: unpacks the input and finds the reader of its content. *content is the unpacked input,
 * which `input` owns. It is `input` itself if nothing is packed. */
wt_status find_reader(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      unsigned kinds, const file_reader **reader, wt_input **content,
                      wt_error *err);

#endif
