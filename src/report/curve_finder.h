/* The samples of a curve in the table "curves", by the row of the curve in its group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_CURVE_FINDER_H
#define WT_REPORT_CURVE_FINDER_H

#include "report/report_tables.h"

/* The rows of one curve. */
typedef struct curve_block {
    size_t from, to;
} curve_block;

typedef struct curve_finder {
    const table_view *view; /* of the table "curves"; borrowed */
    curve_block *blocks;    /* [n] */
    size_t n, next; /* the one behind the last that was found, for both stand in one order */
} curve_finder;

/* In the order in which they are looked at. */
typedef enum curve_kind { CURVE_REFUSED, CURVE_DOUBTFUL, CURVE_ACCEPTED, CURVE_KINDS } curve_kind;

/* By its verdict. */
curve_kind curve_kind_of(const table_view *rows, size_t row);

/* Whether there are curves to look at; WT_E_EMPTY says how they are made. */
wt_status curves_check(const figure_tables *tables, wt_error *err) WT_NODISCARD;

/* With a view. curve_finder_clear also after a failure. */
wt_status curve_finder_make(curve_finder *finder, wt_error *err) WT_NODISCARD;
/* NULL if the curve has no samples. */
const curve_block *curve_finder_next(curve_finder *finder, const table_view *rows, size_t row);
void curve_finder_clear(curve_finder *finder);

#endif
