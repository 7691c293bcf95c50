/* The set of formats as the other files of this room see it, and the table of facts that a reader
 * fills for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FORMATS_H
#define WT_READ_FORMATS_H

#include "read/reader.h"

/* The i-th reader of a set, in the order of wt_formats_get; borrowed. */
const file_reader *formats_reader(const wt_formats *formats, size_t i);

/* Which reader the input belongs to: options->format if it is set, else detection. `kinds` limits
 * the question (0 = any); what is recognised but has none of them is WT_E_UNSUPPORTED and says so.
 */
wt_status find_reader(const wt_formats *formats, wt_input *input, const char *format,
                      unsigned kinds, const file_reader **reader, wt_error *err);

/* Adds a row (item, value, unit, source) to the table of wt_describe. */
wt_status facts_add(wt_table *facts, const char *item, const char *value, const char *unit,
                    const char *source, wt_error *err);
wt_status facts_number(wt_table *facts, const char *item, double value, const char *unit,
                       const char *source, wt_error *err);
wt_status facts_count(wt_table *facts, const char *item, size_t value, const char *source,
                      wt_error *err);

#endif
