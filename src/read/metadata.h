/* The table of facts that a reader fills for `info`. The first failure stays in the writer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_METADATA_H
#define WT_READ_METADATA_H

#include "core/table/table_writer.h"

/* Adds a row; the value is printed. */
void facts_add(table_writer *facts, const char *item, const char *unit, const char *source,
               const char *format, ...) WT_PRINTF(5, 6);
/* NaN is "unknown". */
void facts_number(table_writer *facts, const char *item, double value, const char *unit,
                  const char *source);

#endif
