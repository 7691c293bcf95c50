/* Draws one force curve as a panel.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/curve_panel.h"

#include "core/base/text.h"
#include "report/report_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Characters of 8 points per line, and lines for a reason of at most 159 characters. A heading of
 * the last column begins 181 points from the edge of the sheet; a letter is 4 points wide in the
 * mean. */
enum { LINE_LENGTH = 40, VERDICT_LINES = 2, REASON_LINES = 6 };

const char curve_panel_legend[] =
    "Points: approach; black line: fit; grey line: retract; vertical line: contact point.";

/* ---- samples by row -------------------------------------------------------------------------- */

typedef struct curve_finder {
    const table_view *view; /* view of the table "curves"; borrowed */
    curve_block *blocks;    /* [n] */
    size_t n,
        next; /* next: index after the last match, as both tables usually have the same order */
} curve_finder;

static curve_kind row_curve_kind(const table_view *rows, size_t row)
{
    const wt_curve_verdict verdict =
        (wt_curve_verdict)indentation_enum(rows, row, INDENTATION_VERDICT);
    return verdict == WT_CURVE_ACCEPTED   ? CURVE_ACCEPTED
           : verdict == WT_CURVE_WIDE     ? CURVE_WIDE
           : verdict == WT_CURVE_DOUBTFUL ? CURVE_DOUBTFUL
                                          : CURVE_REFUSED;
}

static void find_blocks(curve_finder *finder)
{
    const table_view *view = finder->view;
    size_t last = 0;
    finder->n = finder->next = 0;
    finder->blocks = wt_alloc(view->n_rows, sizeof *finder->blocks);
    for (size_t i = 0; i < view->n_rows; i++) {
        const size_t number = wt_table_block(view->table, i);
        if (finder->n == 0 || number != last)
            finder->blocks[finder->n++].from = i;
        finder->blocks[finder->n - 1].to = i + 1;
        last = number;
    }
}

static bool block_matches_row(const table_view *curves, curve_block b, const table_view *rows,
                              size_t row)
{
    const double a = curves_get(curves, b.from, CURVES_CURVE),
                 other = indentation_get(rows, row, INDENTATION_CURVE);
    return !(a < other) && !(a > other) &&
           strcmp(curves_text(curves, b.from, CURVES_FILE),
                  indentation_text(rows, row, INDENTATION_FILE)) == 0 &&
           strcmp(curves_text(curves, b.from, CURVES_GROUP), rows->suffix) == 0;
}

/* Returns the samples of the curve of a row, NULL if it has none. */
static const curve_block *find_curve(curve_finder *finder, const table_view *rows, size_t row)
{
    for (size_t tried = 0; tried < finder->n; tried++) {
        const size_t k = (finder->next + tried) % finder->n;
        if (!block_matches_row(finder->view, finder->blocks[k], rows, row))
            continue;
        finder->next = k + 1;
        return &finder->blocks[k];
    }
    return NULL;
}

/* ---- list ------------------------------------------------------------------------------------ */

static bool has_finite_samples(const table_view *curves, curve_block b)
{
    for (size_t i = b.from; i < b.to; i++)
        if (isfinite(curves_get(curves, i, CURVES_DISPLACEMENT)) &&
            isfinite(curves_get(curves, i, CURVES_FORCE)))
            return true;
    return false;
}

/* Sorts by kind; the order within a kind is kept. */
static void sort_by_kind(listed_curve *to, const curve_list *list)
{
    size_t at[CURVE_KINDS] = {0};
    for (int k = 1; k < CURVE_KINDS; k++)
        at[k] = at[k - 1] + list->of_kind[k - 1];
    for (size_t i = 0; i < list->n; i++)
        to[at[list->curves[i].kind]++] = list->curves[i];
}

void curve_list_init(const figure_tables *tables, curve_list *list)
{
    curve_finder finder = {.view = &tables->curves};
    *list = (curve_list){.n = 0};
    find_blocks(&finder);
    listed_curve *found = wt_alloc(finder.n, sizeof *found);
    listed_curve *sorted = wt_alloc(finder.n, sizeof *sorted);
    list->curves = found;
    for (size_t i = 0; i < tables->n_indentation; i++) {
        const table_view *rows = &tables->indentation[i];
        list->n_rows += rows->n_rows;
        for (size_t row = 0; row < rows->n_rows && list->n < finder.n; row++) {
            const curve_block *b = find_curve(&finder, rows, row);
            if (b == NULL || !has_finite_samples(&tables->curves, *b))
                continue;
            const curve_kind kind = row_curve_kind(rows, row);
            found[list->n++] = (listed_curve){*b, kind, rows, row};
            list->of_kind[kind]++;
        }
    }
    sort_by_kind(sorted, list);
    list->curves = sorted;
    free(found);
    free(finder.blocks);
}

void curve_list_clear(curve_list *list)
{
    free(list->curves);
    *list = (curve_list){.n = 0};
}

/* ---- heading --------------------------------------------------------------------------------- */

/* Adds a text in at most `most` lines, broken at blanks. A text that is too long ends in dots.
 * Returns the number of lines. */
static size_t add_wrapped_lines(text_buffer *to, const char *text, size_t most)
{
    size_t n = 0;
    while (*text != '\0' && n < most) {
        size_t left = strlen(text), length = left;
        if (left > LINE_LENGTH) {
            length = utf8_truncated_length(text, left, LINE_LENGTH);
            const char *blank = memrchr(text, ' ', length + 1);
            if (blank != NULL && n + 1 < most)
                length = (size_t)(blank - text);
        }
        text_add(to, n++ > 0 ? "\n" : "");
        text_bytes(to, text, length);
        text += length + strspn(text + length, " ");
    }
    text_add(to, *text != '\0' ? "..." : "");
    return n;
}

static void add_curve_name(text_buffer *to, const char *file, double curve)
{
    enum { NAME = LINE_LENGTH - 8 }; /* leaves room for the number */
    text_file_name(to, strrchr(file, '/') != NULL ? strrchr(file, '/') + 1 : file, NAME);
    text_format(to, ":%.0f", curve);
}

/* Adds the heading: curve, verdict and modulus, reason of a curve that was not accepted. Returns
 * the number of lines. */
static size_t add_heading_lines(text_buffer *to, const figure_drawing *d, const listed_curve *c)
{
    const char *verdict = indentation_text(c->rows, c->row, INDENTATION_VERDICT),
               *reason = indentation_text(c->rows, c->row, INDENTATION_REASON);
    const wt_estimate modulus = {
        .value = indentation_get(c->rows, c->row, INDENTATION_MODULUS),
        .standard_error = indentation_get(c->rows, c->row, INDENTATION_MODULUS_STANDARD_ERROR),
        .numerical_error = (double)NAN,
        .unit = "Pa"};
    const bool refused = c->kind == CURVE_REFUSED;
    text_buffer words = {0};
    add_curve_name(to, curves_text(d->table, c->block.from, CURVES_FILE),
                   curves_get(d->table, c->block.from, CURVES_CURVE));
    text_add(to, "\n");
    if (d->tables->n_indentation > 1)
        text_format(&words, "%s: ", c->rows->suffix);
    text_add(&words, refused ? verdict_text(indentation_enum(c->rows, c->row, INDENTATION_VERDICT))
                             : verdict);
    size_t lines = 1 + add_wrapped_lines(to, text_string(&words), VERDICT_LINES);
    if (!refused && isfinite(modulus.value)) {
        text_format(to, "\nE = %s", ESTIMATE(&modulus));
        lines++;
    }
    text_free(&words);
    if (c->kind != CURVE_ACCEPTED && reason[0] != '\0') {
        text_add(to, "\n");
        lines += add_wrapped_lines(to, reason, REASON_LINES);
    }
    return lines;
}

size_t curve_panel_line_count(const figure_drawing *d, const listed_curve *c)
{
    text_buffer words = {0};
    const size_t lines = add_heading_lines(&words, d, c);
    text_free(&words);
    return lines;
}

/* Draws the heading as labels from the left edge of the panel, the last line just above it. */
static void add_heading(figure_drawing *d, const listed_curve *c)
{
    text_buffer words = {0}, line = {0};
    const size_t lines = add_heading_lines(&words, d, c);
    size_t number = 0;
    for (const char *s = text_string(&words); number < lines; number++) {
        const size_t length = strcspn(s, "\n");
        text_bytes(&line, s, length);
        text_format(&d->script, "set label %zu ", number + 1);
        text_quoted(&d->script, text_string(&line));
        text_format(&d->script, " at graph 0,1 offset char -6,%.1f left noenhanced\n",
                    (double)(lines - number) + 0.1);
        text_free(&line);
        s += length + (s[length] == '\n');
    }
    text_free(&words);
}

/* ---- panel ----------------------------------------------------------------------------------- */

/* Adds a section of the samples of one segment, with the fit of the approach. */
static int curve_section(figure_drawing *d, curve_block b, wt_segment_kind segment)
{
    static const char *const columns[] = {"displacement", "force", "fitted_force", NULL};
    static const char *const units[] = {"m", "N", "N", NULL};
    enum { COLUMNS = 3 };
    double *values = wt_alloc((b.to - b.from) * COLUMNS, sizeof *values);
    size_t n = 0;
    for (size_t i = b.from; i < b.to; i++) {
        if (curves_enum(d->table, i, CURVES_SEGMENT) != (int)segment)
            continue;
        values[COLUMNS * n] = curves_get(d->table, i, CURVES_DISPLACEMENT);
        values[COLUMNS * n + 1] = curves_get(d->table, i, CURVES_FORCE);
        values[COLUMNS * n++ + 2] = curves_get(d->table, i, CURVES_FITTED_FORCE);
    }
    const int section =
        drawing_number_section(d, segment_kind_text(segment), columns, units, values, n);
    free(values);
    return section;
}

/* True if the curve has a fit, which determines the contact point. */
static bool has_fitted_samples(const figure_drawing *d, curve_block b)
{
    for (size_t i = b.from; i < b.to; i++)
        if (isfinite(curves_get(d->table, i, CURVES_FITTED_FORCE)))
            return true;
    return false;
}

void draw_curve_panel(figure_drawing *d, const listed_curve *c)
{
    const int approach = curve_section(d, c->block, WT_SEGMENT_APPROACH),
              retract = curve_section(d, c->block, WT_SEGMENT_RETRACT);
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN;
    span_add_section(&x, d, approach, 0, false);
    span_add_section(&x, d, retract, 0, false);
    span_add_section(&y, d, approach, 1, false);
    span_add_section(&y, d, retract, 1, false);
    if (d->status != WT_OK || span_is_empty(&x) || span_is_empty(&y))
        return;
    axis_linear(d, AXIS_X, "Displacement", &curves_schema.columns[CURVES_DISPLACEMENT], x);
    axis_linear(d, AXIS_Y, "Force", &curves_schema.columns[CURVES_FORCE], y);
    text_add(&d->script, "unset arrow\nunset label\n");
    add_heading(d, c);
    if (has_fitted_samples(d, c->block))
        text_add(&d->script, "set arrow from 0, graph 0 to 0, graph 1 nohead ls 12 back\n");
    plot_item(d, retract, "($1*x_unit):($2*y_unit) with lines ls 45 notitle");
    plot_item(d, approach, "($1*x_unit):($2*y_unit) with points ls 41 pt 5 ps 0.3 notitle");
    plot_item(d, approach, "($1*x_unit):($3*y_unit) with lines ls 11 notitle");
    plot_end(d);
}
