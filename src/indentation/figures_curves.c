/* Sheet of selected force curves, rejected ones first.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/curve_panel.h"

/* Largest number of curves on one sheet; separate sheets and the page show the rest. */
enum { SHEET_CURVES = 12, SHEET_COLUMNS = 3 };

/* Returns the largest number of title lines in one row of panels. */
static size_t max_title_lines(const figure_drawing *d, const curve_list *list, size_t first,
                              size_t n)
{
    size_t most = 0;
    for (size_t i = first; i < first + n && i < list->n; i++) {
        const size_t lines = curve_panel_line_count(d, &list->curves[i]);
        most = lines > most ? lines : most;
    }
    return most;
}

static void draw_sheet(figure_drawing *d, const curve_list *list)
{
    const size_t n = list->n < SHEET_CURVES ? list->n : SHEET_CURVES,
                 columns = n < SHEET_COLUMNS ? n : SHEET_COLUMNS,
                 rows = (n + columns - 1) / columns;
    d->width = 0.75 * (double)columns;
    d->height = 0.85 * (double)rows;
    text_format(&d->script, "set lmargin 9\nset rmargin 2\nset multiplot layout %zu,%zu\n", rows,
                columns);
    for (size_t i = 0; i < n; i++) {
        if (i % columns == 0)
            text_format(&d->script, "set tmargin %zu\n", max_title_lines(d, list, i, columns) + 1);
        draw_curve_panel(d, &list->curves[i]);
    }
    text_add(&d->script, "unset multiplot\n");
    text_format(&d->caption, " %s %zu of %zu curves.", curve_panel_legend, n, list->n_rows);
    if (n < list->n)
        text_add(&d->caption, " weartrack report --sheets draws the others.");
}

static void draw_curves(figure_drawing *d)
{
    curve_list list;
    curve_list_init(d->tables, &list);
    if (list.n > 0)
        draw_sheet(d, &list);
    curve_list_clear(&list);
}

const figure_description figures_curves[] = {
    {.name = "curves",
     .title = "Force curves to look at",
     .table = &curves_schema,
     .caption_text =
         "Force against displacement of single curves, refused ones first, then doubtful ones; "
         "counted from the contact point where there is one.",
     .empty_reason = "no curve has samples",
     .draw = draw_curves},
    {.name = NULL},
};
