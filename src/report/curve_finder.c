/* The samples of a curve by its row.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/curve_finder.h"

#include <stdlib.h>
#include <string.h>

wt_status curve_finder_make(curve_finder *finder, wt_error *err)
{
    const table_view *view = finder->view;
    size_t last = 0;
    finder->n = finder->next = 0;
    finder->blocks = malloc((view->n_rows > 0 ? view->n_rows : 1) * sizeof *finder->blocks);
    if (finder->blocks == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < view->n_rows; i++) {
        const size_t number = wt_table_block(view->table, i);
        if (finder->n == 0 || number != last)
            finder->blocks[finder->n++].from = i;
        finder->blocks[finder->n - 1].to = i + 1;
        last = number;
    }
    return WT_OK;
}

static bool is_of_row(const table_view *curves, curve_block b, const table_view *rows, size_t row)
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
        if (!is_of_row(finder->view, finder->blocks[k], rows, row))
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
