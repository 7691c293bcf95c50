/* The sheet of force curves to look at, refused ones first.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/curve_finder.h"
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* More are for the page to go through them. */
enum { SHEET_CURVES = 12, SHEET_COLUMNS = 3, SHEET_WORDS = 20 };

/* A curve on the sheet. */
typedef struct sheet_curve {
    curve_block block;
    const char *verdict;
} sheet_curve;

typedef struct sheet {
    sheet_curve curve[SHEET_CURVES];
    size_t n, n_all;
} sheet;

static bool is_usable(const char *verdict)
{
    return strcmp(verdict, "accepted") == 0 || strcmp(verdict, "doubtful") == 0;
}

static bool has_numbers(const table_view *curves, curve_block b)
{
    for (size_t i = b.from; i < b.to; i++)
        if (isfinite(curves_get(curves, i, CURVES_DISPLACEMENT)) &&
            isfinite(curves_get(curves, i, CURVES_FORCE)))
            return true;
    return false;
}

/* Takes the curves that are usable, or those that are not, as long as there is room. */
static wt_status take_curves(const bound_tables *tables, bool usable, sheet *to, wt_error *err)
{
    curve_finder finder = {.view = &tables->curves};
    const wt_status status = curve_finder_make(&finder, err);
    to->n_all = finder.n;
    for (size_t i = 0; status == WT_OK && i < tables->n_indentation; i++) {
        const table_view *rows = &tables->indentation[i];
        for (size_t row = 0; row < rows->n_rows && to->n < SHEET_CURVES; row++) {
            const char *verdict = indentation_text(rows, row, INDENTATION_VERDICT);
            const curve_block *found =
                is_usable(verdict) == usable ? curve_finder_next(&finder, rows, row) : NULL;
            if (found != NULL && has_numbers(&tables->curves, *found))
                to->curve[to->n++] = (sheet_curve){*found, verdict};
        }
    }
    curve_finder_clear(&finder);
    return status;
}

/* The samples of one segment of a curve, with the fit of the approach. */
static int curve_section(figure_drawing *d, curve_block b, const char *segment)
{
    static const char *const columns[] = {"displacement", "force", "fitted_force", NULL};
    static const char *const units[] = {"m", "N", "N", NULL};
    enum { COLUMNS = 3 };
    double *values = malloc((b.to - b.from) * COLUMNS * sizeof *values);
    size_t n = 0;
    if (values == NULL) {
        d->status = wt_fail(d->err, WT_E_MEMORY, "out of memory");
        return NO_SECTION;
    }
    for (size_t i = b.from; i < b.to; i++) {
        if (strcmp(curves_text(d->table, i, CURVES_SEGMENT), segment) != 0)
            continue;
        values[COLUMNS * n] = curves_get(d->table, i, CURVES_DISPLACEMENT);
        values[COLUMNS * n + 1] = curves_get(d->table, i, CURVES_FORCE);
        values[COLUMNS * n++ + 2] = curves_get(d->table, i, CURVES_FITTED_FORCE);
    }
    const int section = drawing_numbers(d, segment, columns, units, values, n);
    free(values);
    return section;
}

/* "...end-of-name:17, poor_fit" */
static void add_heading(figure_drawing *d, const sheet_curve *c)
{
    growing_text words = {0};
    const char *file = curves_text(d->table, c->block.from, CURVES_FILE);
    const char *name = strrchr(file, '/') != NULL ? strrchr(file, '/') + 1 : file;
    const size_t length = strlen(name);
    text_format(&words, "%s%s:%.0f, %s", length > SHEET_WORDS ? "..." : "",
                length > SHEET_WORDS ? name + length - SHEET_WORDS : name,
                curves_get(d->table, c->block.from, CURVES_CURVE), c->verdict);
    plot_heading(d, text_string(&words));
    text_done(&words, &d->script);
}

/* A fit says where it is. */
static bool has_contact(const figure_drawing *d, curve_block b)
{
    for (size_t i = b.from; i < b.to; i++)
        if (isfinite(curves_get(d->table, i, CURVES_FITTED_FORCE)))
            return true;
    return false;
}

static void draw_curve(figure_drawing *d, const sheet_curve *c)
{
    const int approach = curve_section(d, c->block, "approach"),
              retract = curve_section(d, c->block, "retract");
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    span_add_section(&x, d, approach, 0, false);
    span_add_section(&x, d, retract, 0, false);
    span_add_section(&y, d, approach, 1, false);
    span_add_section(&y, d, retract, 1, false);
    if (d->status != WT_OK || span_empty(&x) || span_empty(&y))
        return;
    axis_linear(d, "x", "Displacement", &curves_schema.columns[CURVES_DISPLACEMENT], x);
    axis_linear(d, "y", "Force", &curves_schema.columns[CURVES_FORCE], y);
    add_heading(d, c);
    text_add(&d->script, "unset arrow\n");
    if (has_contact(d, c->block))
        text_add(&d->script, "set arrow from 0, graph 0 to 0, graph 1 nohead ls 12 back\n");
    plot_item(d, retract, "($1*x_unit):($2*y_unit) with lines ls 45 notitle");
    plot_item(d, approach, "($1*x_unit):($2*y_unit) with points ls 41 ps 0.35 notitle");
    plot_item(d, approach, "($1*x_unit):($3*y_unit) with lines ls 11 notitle");
    plot_end(d);
}

static void draw_curves(figure_drawing *d)
{
    sheet s = {.n = 0};
    d->status = take_curves(d->tables, false, &s, d->err);
    if (d->status == WT_OK)
        d->status = take_curves(d->tables, true, &s, d->err);
    if (d->status != WT_OK || s.n == 0)
        return;
    const size_t columns = s.n < SHEET_COLUMNS ? s.n : SHEET_COLUMNS,
                 rows = (s.n + columns - 1) / columns;
    d->width = 0.75 * (double)columns;
    d->height = 0.75 * (double)rows;
    text_format(&d->script, "set multiplot layout %zu,%zu\n", rows, columns);
    for (size_t i = 0; i < s.n; i++) {
        draw_curve(d, &s.curve[i]);
    }
    text_add(&d->script, "unset multiplot\n");
    text_format(&d->caption, " %zu of %zu curves.", s.n, s.n_all);
}

const figure_description figures_curves[] = {
    {.name = "curves",
     .title = "Force curves to look at",
     .table = &curves_schema,
     .words = "Force against displacement of single curves, those that were refused first; counted "
              "from the contact point (vertical line) where there is one. Points: approach; black "
              "line: fit; grey line: retract.",
     .nothing = "no curve has samples",
     .draw = draw_curves},
    {.name = NULL},
};
