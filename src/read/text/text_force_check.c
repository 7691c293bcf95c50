/* Checks the rows of a text export for missing, repeated or moved rows.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include "core/base/array.h"

#include <math.h>

/* Number of steps that define the usual step, and the minimum for a check. */
enum { FIRST = 5, STEPS_MIN = 20 };
/* Limits relative to the usual step. Equal steps have at least three digits. A missing row doubles
 * a step; a repeated row or a wrong number gives a step near zero or of another size. */
static const double equal = 0.01, gap_min = 1.5, wrong_max = 0.5;
/* Maximum number of wrong steps; with more the steps are not equal. A moved part causes three, an
 * exchange of two parts four. */
enum { WRONG_MAX = 4 };

typedef struct broken_steps {
    size_t first; /* first row after a break; 0 if there is none or the other steps are not equal */
    size_t gaps;  /* gaps between equal steps */
    size_t wrong; /* other breaks */
} broken_steps;

/* Finds breaks in otherwise equal steps. A ramp of two rates, scattered steps and a noisy height
 * have none. The first and the last step may be incomplete. */
static broken_steps find_step_breaks(const text_table *t, size_t first, size_t end,
                                     const text_column *c)
{
    static const broken_steps none = {0, 0, 0};
    double start[FIRST];
    broken_steps found = none;
    bool after_gap = true;
    for (size_t i = 0; i < FIRST; i++)
        start[i] = text_table_value(t, first + i + 1, c) - text_table_value(t, first + i, c);
    const double usual = numbers_median(start, FIRST);
    for (size_t row = first + 1; row < end; row++) {
        const double steps =
            (text_table_value(t, row, c) - text_table_value(t, row - 1, c)) / usual;
        const bool even = fabs(steps - 1) <= equal, inner = row > first + 1 && row + 1 < end;
        const bool gap = steps >= gap_min && !after_gap && inner;
        const bool wrong = !gap && (steps >= gap_min || steps <= wrong_max) && inner;
        if (!isfinite(steps) || (!even && !gap && !wrong))
            return none;
        found.gaps += gap;
        found.wrong += wrong;
        found.first = !even && found.first == 0 ? row : found.first;
        after_gap = !even;
    }
    return found.wrong <= WRONG_MAX ? found : none;
}

void text_check_steps(const text_file *file, const text_table *t, int segment, size_t first,
                      size_t end, wt_log *log)
{
    static const wt_quantity even[] = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT};
    for (size_t i = 0; i < COUNT_OF(even); i++) {
        const text_column *const c = text_table_column(t, even[i], segment);
        const broken_steps broken = c != NULL && end > first + STEPS_MIN
                                        ? find_step_breaks(t, first, end, c)
                                        : (broken_steps){0, 0, 0};
        if (broken.first == 0)
            continue;
        const line_position_text place = format_line_position(t->row_lines[broken.first]);
        if (broken.wrong == 0)
            wt_log_add(log, WT_WARNING, file->name, place.text,
                       "the equal steps of %s have %zu gap%s from here on: are rows missing?",
                       c->name, broken.gaps, broken.gaps > 1 ? "s" : "");
        else
            wt_log_add(log, WT_WARNING, file->name, place.text,
                       "the equal steps of %s are broken at %zu place%s from here on: are "
                       "rows missing, there twice, moved or changed?",
                       c->name, broken.gaps + broken.wrong,
                       broken.gaps + broken.wrong > 1 ? "s" : "");
        return;
    }
}
