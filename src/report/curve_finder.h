/* Samples of a curve in the table "curves", found by the row of the curve in its group.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_CURVE_FINDER_H
#define WT_REPORT_CURVE_FINDER_H

#include "report/report_tables.h"

/* Range of rows of one curve. */
typedef struct curve_block {
    size_t from, to;
} curve_block;

typedef struct curve_finder {
    const table_view *view; /* view of the table "curves"; borrowed */
    curve_block *blocks;    /* [n] */
    size_t n,
        next; /* next: index after the last match, as both tables usually have the same order */
} curve_finder;

/* Kinds of curves in their order on the sheets. */
typedef enum curve_kind {
    CURVE_REFUSED,
    CURVE_DOUBTFUL,
    CURVE_WIDE,
    CURVE_ACCEPTED,
    CURVE_KINDS
} curve_kind;

/* Returns the kind of a row from its verdict. */
curve_kind row_curve_kind(const table_view *rows, size_t row);

/* Checks that the result has samples of curves. WT_E_EMPTY explains how to produce them. */
wt_status check_curve_samples(const figure_tables *tables, wt_error *err) WT_NODISCARD;

/* Initialises a finder with a view. Call curve_finder_clear also after a failure. */
void curve_finder_init(curve_finder *finder);
/* Returns the samples of the curve of a row, NULL if it has none. */
const curve_block *curve_finder_next(curve_finder *finder, const table_view *rows, size_t row);
void curve_finder_clear(curve_finder *finder);

#endif
