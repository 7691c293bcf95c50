/* The set of formats as the other files of this room see it.
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

#endif
