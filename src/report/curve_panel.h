/* One force curve as a panel: samples, fit, name and verdict.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_CURVE_PANEL_H
#define WT_REPORT_CURVE_PANEL_H

#include "report/drawing.h"

/* Range of rows of one curve in the table "curves". */
typedef struct curve_block {
    size_t from, to;
} curve_block;

/* Kinds of curves in their order on the figure. */
typedef enum curve_kind {
    CURVE_REFUSED,
    CURVE_DOUBTFUL,
    CURVE_WIDE,
    CURVE_ACCEPTED,
    CURVE_KINDS
} curve_kind;

/* A curve with samples and its row. */
typedef struct listed_curve {
    curve_block block;
    curve_kind kind;
    const table_view *rows; /* rows of its group; borrowed */
    size_t row;
} listed_curve;

typedef struct curve_list {
    listed_curve *curves; /* [n]; owned */
    size_t n, of_kind[CURVE_KINDS];
    size_t n_rows; /* number of all curves, also without samples */
} curve_list;

/* Lists all curves with samples: rejected ones first, then doubtful and wide ones, each kind in the
 * order of the table. Call curve_list_clear also after a failure. */
void curve_list_init(const figure_tables *tables, curve_list *list);
void curve_list_clear(curve_list *list);

/* Returns the number of lines of the heading of a curve. */
size_t curve_panel_line_count(const figure_drawing *d, const listed_curve *curve);
/* Draws a curve of d->table, the table "curves", as one plot of a multiplot. It draws nothing if no
 * sample has displacement and force. */
void draw_curve_panel(figure_drawing *d, const listed_curve *curve);

/* Legend of points and lines for a caption. */
extern const char curve_panel_legend[];

#endif
