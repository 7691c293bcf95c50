/* A ZIP archive of files of force curves: one measurement, a map say, as its entries hold it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_COLLECTION_H
#define WT_READ_COLLECTION_H

#include "read/force_assembler.h"
#include "read/reader.h"

/* What the archive is read by, once content.c has found out that it is one: no reader of the set,
 * for it needs the set for the entries. */
extern const file_reader reader_collection;

/* Reads an entry of those bytes; *taken tells whether the asking has come to an end. */
typedef wt_status collection_look(wt_input *entry, void *user, bool *taken, wt_error *err);
/* Shows the entries one after the other, as they are sorted, until one is taken. */
wt_status collection_each(wt_input *input, collection_look *look, void *user,
                          wt_error *err) WT_NODISCARD;

typedef wt_status collection_open(const wt_formats *formats, wt_input *entry,
                                  const wt_read_options *options, wt_log *log,
                                  wt_force_source **source, wt_error *err);
/* How the curves of an entry are opened; before the first curve. */
void collection_use(wt_force_source *source, const wt_formats *formats, collection_open *open);

#endif
