/* Declares the reader of a ZIP archive whose entries are files of force curves, such as a map.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_COLLECTION_H
#define WT_READ_COLLECTION_H

#include "read/force_assembler.h"
#include "read/reader.h"

/* The reader of such an archive. unpack.c selects it after it has examined the content. It is not
 * in the list of readers, because it needs that list to read the entries. */
extern const file_reader reader_collection;

/* Visits one entry. The visitor sets the flag to end the iteration. */
typedef wt_status collection_visitor(wt_input *entry, void *user, bool *is_done, wt_error *err);
/* Calls `look` for each entry in sorted order, until `look` ends the iteration or fails. An entry
 * that cannot be unpacked is skipped. */
wt_status collection_visit(wt_input *input, collection_visitor *look, void *user,
                           wt_error *err) WT_NODISCARD;

typedef wt_status collection_opener(const wt_formats *formats, wt_input *entry,
                                    const wt_read_options *options, wt_log *log,
                                    wt_force_source **source, wt_error *err);
/* Sets the function that opens the curves of an entry. Call it before the first curve is read. */
void collection_set_opener(wt_force_source *source, const wt_formats *formats,
                           collection_opener *open);

#endif
