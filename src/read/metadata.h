/* Declares the table of metadata that a reader fills for `info`. The writer keeps the first
 * failure. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_METADATA_H
#define WT_READ_METADATA_H

#include "core/table/table_writer.h"

/* Adds a row; the value is formatted as with printf. */
void metadata_add(table_writer *metadata, const char *item, const char *unit, const char *source,
                  const char *format, ...) WT_PRINTF(5, 6);
/* Adds a row with the text of a key of the file, unless it is NULL or empty. */
void metadata_add_text(table_writer *metadata, const char *item, const char *key, const char *text);
/* Adds a row with a number; NaN is written as "unknown". */
void metadata_add_number(table_writer *metadata, const char *item, double value, const char *unit,
                         const char *source);

#endif
