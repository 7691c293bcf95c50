/* One force curve as a panel: its samples, its fit, and above it which curve it is and its verdict.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_CURVE_PANEL_H
#define WT_REPORT_CURVE_PANEL_H

#include "report/curve_finder.h"
#include "report/drawing.h"

/* A curve with samples, and its row. */
typedef struct listed_curve {
    curve_block block;
    curve_kind kind;
    const table_view *rows; /* of its group; borrowed */
    size_t row;
} listed_curve;

typedef struct curve_list {
    listed_curve *curves; /* [n]; owned */
    size_t n, of_kind[CURVE_KINDS];
    size_t n_rows; /* curves in all, those without samples too */
} curve_list;

/* All curves that have samples: refused ones first, then doubtful ones, each kind in the order of
 * the table. curve_list_clear also after a failure. */
wt_status curve_list_make(const figure_tables *tables, curve_list *list,
                          wt_error *err) WT_NODISCARD;
void curve_list_clear(curve_list *list);

/* Lines of words above the panel of a curve. */
size_t curve_panel_lines(const figure_drawing *d, const listed_curve *curve);
/* Draws a curve of d->table, the table "curves", as one plot of a multiplot. Nothing if no sample
 * has both numbers. */
void curve_panel(figure_drawing *d, const listed_curve *curve);

/* What its points and lines are, for a caption. */
extern const char curve_panel_words[];

#endif
