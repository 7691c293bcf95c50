/* The table of facts that a reader fills for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FACTS_H
#define WT_READ_FACTS_H

#include "weartrack/data.h"

/* An empty table of (item, value, unit, source), all text. */
wt_status facts_new(wt_table **facts, wt_error *err);
/* Adds a row. */
wt_status facts_add(wt_table *facts, const char *item, const char *value, const char *unit,
                    const char *source, wt_error *err);
/* NaN is "unknown". */
wt_status facts_number(wt_table *facts, const char *item, double value, const char *unit,
                       const char *source, wt_error *err);
wt_status facts_count(wt_table *facts, const char *item, size_t value, const char *source,
                      wt_error *err);

#endif
