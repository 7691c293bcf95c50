/* The list of facts that a reader fills for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FACTS_H
#define WT_READ_FACTS_H

#include "weartrack/data.h"

/* A table of (item, value, unit, source), all text. */
typedef struct fact_list {
    wt_table *table;
    wt_status status; /* the first failure; what comes after it is left out */
    wt_error *err;
} fact_list;

/* An empty one. */
wt_status facts_new(fact_list *facts, wt_error *err);
/* Adds a row; the value is printed. */
void facts_add(fact_list *facts, const char *item, const char *unit, const char *source,
               const char *format, ...) WT_PRINTF(5, 6);
/* NaN is "unknown". */
void facts_number(fact_list *facts, const char *item, double value, const char *unit,
                  const char *source);
void facts_count(fact_list *facts, const char *item, size_t value, const char *source);

#endif
