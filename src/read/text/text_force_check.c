/* What a segment of a text export says against itself: rows that are not there.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include "base/array.h"

#include <math.h>

/* Steps that show which one is usual, and the fewest to say anything. */
enum { FIRST = 5, STEPS_LEAST = 20 };
/* Equal steps are printed with three digits at least; a row that is not there makes a step of two.
 */
static const double equal = 0.01, gap_least = 1.5;

/* The first step that is a gap between equal ones; 0 unless all others are equal: a ramp of two
 * rates, steps that scatter and a height that is measured are none of this. */
static size_t find_gap(const text_table *t, size_t first, size_t end, const text_column *c,
                       size_t *n_gaps)
{
    double start[FIRST];
    size_t found = 0;
    bool after_gap = true; /* a gap has equal steps on both sides */
    for (size_t i = 0; i < FIRST; i++)
        start[i] = text_table_value(t, first + i + 1, c) - text_table_value(t, first + i, c);
    const double usual = numbers_median(start, FIRST);
    *n_gaps = 0;
    for (size_t row = first + 1; row < end; row++) {
        const double steps =
            (text_table_value(t, row, c) - text_table_value(t, row - 1, c)) / usual;
        const bool even = fabs(steps - 1) <= equal,
                   gap = steps >= gap_least && !after_gap && row + 1 < end;
        if (!even && !(gap && isfinite(steps)))
            return 0;
        found = gap && found == 0 ? row : found;
        *n_gaps += gap;
        after_gap = gap;
    }
    return found;
}

void text_check_steps(const text_file *file, const text_table *t, wt_segment_kind kind,
                      size_t first, size_t end, wt_parselog *log)
{
    static const wt_quantity even[] = {WT_Q_TIME, WT_Q_HEIGHT};
    for (size_t i = 0; i < COUNT_OF(even); i++) {
        const text_column *const c = text_table_column(t, even[i], (int)kind);
        size_t n_gaps = 0;
        const size_t row =
            c != NULL && end > first + STEPS_LEAST ? find_gap(t, first, end, c, &n_gaps) : 0;
        if (row == 0)
            continue;
        wt_parselog_add(log, WT_WARNING, file->name, line_place(t->row_lines[row]).words,
                        "the equal steps of %s have %zu gap%s from here on: are rows missing?",
                        c->name, n_gaps, n_gaps > 1 ? "s" : "");
        return;
    }
}
