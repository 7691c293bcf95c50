/* Finds the samples of a curve by its row.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/curve_finder.h"

#include "weartrack/report.h"

#include <stdlib.h>
#include <string.h>

/* ---- kinds and availability -------------------------------------------------------------------
 */

curve_kind row_curve_kind(const table_view *rows, size_t row)
{
    const wt_curve_verdict verdict =
        (wt_curve_verdict)indentation_enum(rows, row, INDENTATION_VERDICT);
    return verdict == WT_CURVE_ACCEPTED   ? CURVE_ACCEPTED
           : verdict == WT_CURVE_WIDE     ? CURVE_WIDE
           : verdict == WT_CURVE_DOUBTFUL ? CURVE_DOUBTFUL
                                          : CURVE_REFUSED;
}

/* Returns the number of curves if none is rejected, else 0. */
static size_t count_if_none_refused(const figure_tables *tables)
{
    size_t n = 0;
    for (size_t i = 0; i < tables->n_indentation; i++)
        for (size_t row = 0; row < tables->indentation[i].n_rows; row++, n++)
            if (row_curve_kind(&tables->indentation[i], row) == CURVE_REFUSED)
                return 0;
    return n;
}

wt_status check_curve_samples(const figure_tables *tables, wt_error *err)
{
    if (tables->n_indentation > 0 && tables->curves.n_rows > 0)
        return WT_OK;
    const size_t n = count_if_none_refused(tables);
    const wt_status status = wt_fail(err, WT_E_EMPTY, "no samples of curves in the result");
    if (n > 0)
        wt_error_found(err, "%zu curve%s, none rejected, so that --curves rejected keeps none", n,
                       n == 1 ? "" : "s");
    else
        wt_error_expected(err, "the tables indentation/... and curves");
    wt_error_advice(err, "make it by weartrack indent --curves all, or <curves>all</curves> in the "
                         "<indentation> of a case");
    return status;
}

wt_status wt_report_check_curves(const wt_result *result, wt_error *err)
{
    figure_tables tables;
    wt_status status = figure_tables_bind(result, &tables, err);
    if (status == WT_OK)
        status = check_curve_samples(&tables, err);
    figure_tables_clear(&tables);
    return status;
}

/* ---- samples by row -------------------------------------------------------------------------- */

void curve_finder_init(curve_finder *finder)
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

const curve_block *curve_finder_next(curve_finder *finder, const table_view *rows, size_t row)
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

void curve_finder_clear(curve_finder *finder)
{
    free(finder->blocks);
    finder->blocks = NULL;
}
