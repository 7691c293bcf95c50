/* Table of measured and predicted friction during the running-in.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"

#include "core/math/normal_quantile.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>

/* Most rows of a run, in equal ratios of the time, for the resolution of a figure. */
enum { MOST_ROWS = 48 };

TABLE_ROW(validation_course, VALIDATION_COURSE, double time; wt_interval measured;
          wt_estimate layered, bare; double fitted; const char *file;)

static double friction_without_layer(const growth *g, size_t k, double time)
{
    (void)time;
    return growth_quantity_value(g, k, GROWTH_BARE);
}

/* Predicted value with its standard deviation over the draws. */
static wt_estimate predicted_estimate(const growth *g, growth_function *of, double time)
{
    return (wt_estimate){of(g, 0, time), growth_standard_deviation(g, of, time), (double)NAN, NULL};
}

/* Adds the mean over the means from `first` to before `end` of the series. */
static void add_running_in_row(const run_fit *run, const running_in_series *s, size_t first,
                               size_t end, table_writer *t)
{
    const running_in_curve_fit *const fit = &run->fit;
    const running_in_curve c = growth_curve(run->growth, 0);
    const size_t n = end - first;
    const double from = first > 0 ? s->end[first - 1] : s->begin,
                 time = 0.5 * (from + s->end[end - 1]),
                 error = sqrt(fit->scatter * scatter_mean_variance(fit->law, n));
    double mean = 0;
    for (size_t i = first; i < end; i++)
        mean += s->friction[i] / (double)n;
    const double half = NORMAL_95 * error;
    const validation_course_row row = {
        .time = time,
        .measured = {mean, error, mean - half, mean + half},
        .layered = predicted_estimate(run->growth, growth_friction_at, time),
        .bare = predicted_estimate(run->growth, friction_without_layer, time),
        .fitted = fit->seen ? fit->level +
                                  fit->ratio * running_in_curve_at(&c, log(time) - fit->log_factor)
                            : (double)NAN,
        .file = run->rec->at.file};
    validation_course_add_row(t, &row);
}

static void add_measured_curve_rows(const run_fit *run, const running_in_series *s, table_writer *t)
{
    const double step = pow(s->end[s->n - 1] / s->end[0], 1.0 / MOST_ROWS);
    for (size_t first = 0, end; first < s->n; first = end) {
        const double until = first > 0 ? s->end[first - 1] * step : s->end[0];
        end = first + 1;
        while (end < s->n && s->end[end] <= until)
            end++;
        add_running_in_row(run, s, first, end, t);
    }
}

wt_status running_in_curve_tabulate(const run_set *all, const char *verdict, wt_table **table,
                                    wt_error *err)
{
    table_writer t = table_begin(&validation_course_schema, err);
    for (size_t i = 0; i < all->n && t.status == WT_OK; i++) {
        if (all->runs[i].value == NULL)
            continue;
        running_in_series s = recorded_read_series(all->runs[i].rec, all->runs[i].until);
        table_block(&t);
        add_measured_curve_rows(&all->runs[i], &s, &t);
        running_in_series_clear(&s);
    }
    validation_course_set_text(&t, VALIDATION_COURSE_KEY_VERDICT, verdict);
    return table_end(&t, table);
}
