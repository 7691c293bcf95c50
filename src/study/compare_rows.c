/* The table "comparison": all rates together, then each rate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"

#include "core/base/number.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct comparison_task {
    compare_pair *p;
    const wt_compare_job *job;
    const wt_job *work;
    comparison_inputs inputs;
    unstated_errors unstated;
    compare_row *rows; /* [1 + n_rates] */
    size_t n_rates;
} comparison_task;

/* A rate with a single unit or without scatter leaves its row without numbers. */
static wt_status compare_bin(comparison_task *task, size_t bin, compare_row *r, wt_error *err)
{
    compare_pair *p = task->p;
    const bool all = bin == COMPARE_ALL_BINS;
    wt_group bulk = compare_select_curves(p, 0, bin, 0, p->by_factor),
             track = compare_select_curves(p, 1, bin, bulk.n, p->by_factor);
    if (task->inputs.rates_by_dma)
        bulk.rate = track.rate = NULL;
    *r = (compare_row){.low = all ? (double)NAN : p->low[bin],
                       .high = all ? (double)NAN : p->high[bin],
                       .n = {bulk.n, track.n},
                       .holm = (double)NAN};
    if (!all && (bulk.n == 0 || track.n == 0))
        return WT_OK;
    wt_error failure = WT_ERROR_INIT;
    const wt_status status =
        wt_compare_moduli(&bulk, &track, &task->inputs.offset, &r->c, &failure);
    r->valid = status == WT_OK && r->c.undecided_reason == WT_UNDECIDED_NOT;
    if (all && status == WT_OK) {
        r->n[0] = r->c.curves_bulk;
        r->n[1] = r->c.curves_track;
    }
    if (status == WT_OK || (status == WT_E_RANGE && !all))
        return WT_OK;
    if (err != NULL)
        *err = failure;
    return status;
}

static void correct_p_values(compare_row *rows, size_t n)
{
    double *p = wt_alloc(2 * n, sizeof *p);
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (rows[i].valid)
            p[m++] = rows[i].c.p;
    wt_holm_adjust(p, m, p + n);
    m = 0;
    for (size_t i = 0; i < n; i++)
        if (rows[i].valid)
            rows[i].holm = p[n + m++];
    free(p);
}

/* Without a curve in one group, the row has only the counts. */
static wt_status count_group_units(const comparison_task *task, compare_row *r, wt_error *err)
{
    const double none = (double)NAN;
    wt_group_summary of[2] = {{0}};
    wt_status status = WT_OK;
    *r = (compare_row){.low = none, .high = none, .holm = none};
    for (int g = 0; status == WT_OK && g < 2; g++) {
        const wt_group *group = &task->p->data[g].group;
        r->n[g] = group->n;
        if (group->n > 0)
            status = wt_group_summarise(group, &of[g], err);
    }
    const wt_estimate unknown = {none, none, 0, "1"};
    r->c = (wt_comparison){.by_spot = task->p->data[0].group.spot != NULL &&
                                      task->p->data[1].group.spot != NULL,
                           .n_bulk = of[0].n_spots,
                           .n_track = of[1].n_spots,
                           .undecided_reason = WT_UNDECIDED_ONE_SPOT,
                           .log_ratio = unknown,
                           .rate_slope = unknown,
                           .interaction_p = none};
    return status;
}

/* If the curves do not determine the dependence on the rate, the DMA may. */
static wt_status compare_all_rows(comparison_task *task, wt_error *err)
{
    compare_pair *p = task->p;
    wt_status status = comparison_find_inputs(p, task->job, task->work, false, &task->inputs, err);
    if (status == WT_OK)
        status = compare_bin(task, COMPARE_ALL_BINS, &task->rows[0], err);
    if (status == WT_OK && task->rows[0].c.undecided_reason == WT_UNDECIDED_NO_COMMON_RATE &&
        (task->job->rubber != NULL || p->by_factor)) {
        status = comparison_find_inputs(p, task->job, task->work, true, &task->inputs, err);
        if (status == WT_OK)
            status = compare_bin(task, COMPARE_ALL_BINS, &task->rows[0], err);
    }
    for (size_t b = 0; status == WT_OK && b < p->n_bins; b++)
        status = compare_bin(task, b, &task->rows[b + 1], err);
    if (status == WT_OK)
        correct_p_values(task->rows + 1, p->n_bins);
    return status;
}

wt_status compare_fitted_ratio(const wt_compare_job *job, const wt_job *work,
                               wt_estimate *log_ratio, double *df, wt_error *err)
{
    compare_pair p = {0};
    compare_row row = {.valid = false};
    comparison_task task = {.p = &p, .job = job, .work = work};
    *log_ratio = (wt_estimate){(double)NAN, (double)NAN, 0, "1"};
    *df = (double)INFINITY;
    wt_status status = compare_read_groups(job, &p, err);
    for (int g = 0; g < 2; g++)
        p.data[g].range_error = 0;
    if (status == WT_OK && p.data[0].group.n > 0 && p.data[1].group.n > 0) {
        status = comparison_find_inputs(&p, job, work, false, &task.inputs, err);
        if (status == WT_OK)
            status = compare_bin(&task, COMPARE_ALL_BINS, &row, err);
    }
    if (status == WT_OK && row.valid && !task.inputs.lacks_spring_constant_error) {
        *log_ratio = row.c.log_ratio;
        *df = row.c.df;
    }
    compare_pair_clear(&p);
    return status;
}

/* ---- warnings -------------------------------------------------------------------------------- */

static void warn_copies(const comparison_task *task)
{
    for (int g = 0; g < 2; g++) {
        const wt_group_data *d = &task->p->data[g];
        if (d->n_copies > 0)
            wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
                       "%zu curves of the %s are there twice and count once: %s and %s hold "
                       "the same",
                       d->n_copies, compare_group_name[g], d->duplicate_file[0],
                       d->duplicate_file[1]);
    }
}

/* Error rate of Welch's test at 5 % with normal deviates: 10 % for two spots with five times the
 * scatter of six, 7 % with equal scatter, 6 % for three spots against six. Two spots determine
 * Satterthwaite's degrees of freedom too poorly. */
static void warn_two_spots(const comparison_task *task)
{
    const wt_comparison *c = &task->rows[0].c;
    if (!c->by_spot || (c->n_bulk == 2) == (c->n_track == 2) || c->n_bulk < 2 || c->n_track < 2)
        return;
    const int g = c->n_track == 2;
    wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
               "the two spots of the %s do not determine whether they scatter more than those "
               "of the %s; if they do, the interval is too narrow and a difference may be "
               "shown where there is none: measure a third spot",
               compare_group_name[g], compare_group_name[!g]);
}

/* The scatter of a single spot is taken from the other group; see compare_lone in indentation. */
static void warn_one_spot(const comparison_task *task)
{
    const wt_comparison *c = &task->rows[0].c;
    if (c->undecided_reason != WT_UNDECIDED_NOT || (c->n_bulk > 1 && c->n_track > 1))
        return;
    if (c->scatter_is_stated) {
        wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
                   "the interval of the ratio rests on spots that scatter by %.3g %%, as "
                   "given: one spot does not determine it; three spots in each group would",
                   100 * task->job->spot_scatter);
        return;
    }
    const int g = c->n_track == 1;
    wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
               "the %s has one spot only: it is taken to scatter up to twice as much as those "
               "of the %s; more spots would determine it",
               compare_group_name[g], compare_group_name[!g]);
}

/* Rates in one group only are excluded if there are others. */
static void warn_rates(const comparison_task *task)
{
    const compare_pair *p = task->p;
    const compare_row *all = &task->rows[0];
    const size_t unknown[2] = {p->data[0].group.n, p->data[1].group.n};
    size_t left_out = p->by_rate ? unknown[0] + unknown[1] : 0;
    for (size_t b = 0; b < p->n_bins; b++) {
        const compare_row *r = &task->rows[b + 1];
        left_out -= p->by_rate ? r->n[0] + r->n[1] : 0;
        if ((r->n[0] == 0) == (r->n[1] == 0))
            continue;
        wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
                   "curves at %s m/s are in one group only (bulk %zu, track %zu)%s",
                   format_range(r->low, r->high, 3).text, r->n[0], r->n[1],
                   all->c.rate_matching == WT_RATES_COMMON &&
                           all->c.undecided_reason != WT_UNDECIDED_NO_COMMON_RATE
                       ? "; the comparison leaves them out"
                       : "");
    }
    if (left_out > 0)
        wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
                   "%zu curves have no indentation rate; the comparison leaves them out", left_out);
}

/* ---- table ----------------------------------------------------------------------------------- */

TABLE_ROW_OF(comparison, COMPARISON, compare_row)

/* Widens the interval by the effect of plausible other causes. */
static void add_comparison_rows(table_writer *t, const compare_row *rows, size_t n, bool silent,
                                bool interval, const unstated_errors *unstated)
{
    for (size_t i = 0; i < n; i++) {
        compare_row row = rows[i];
        wt_comparison *c = &row.c;
        const bool told = !silent && (i == 0 || row.valid);
        if (!told)
            c->ratio = (double)NAN;
        if (!told || !interval || !row.valid)
            c->ratio_low = c->ratio_high = c->t = c->df = c->p = row.holm = c->mann_whitney_p =
                c->mann_whitney_smallest_p = c->effect_size = (double)NAN;
        if (isinf(c->df))
            c->df = (double)NAN; /* normal error */
        c->ratio_low *= exp(-unstated->lower);
        c->ratio_high *= exp(unstated->higher);
        comparison_add_row(t, &row);
        comparison_put(t, COMPARISON_RATIO_LOW, c->ratio_low);
        comparison_put(t, COMPARISON_RATIO_HIGH, c->ratio_high);
    }
}

static void format_analysis_unit(const comparison_task *task, char *text, size_t size)
{
    const compare_pair *p = task->p;
    const bool by_spot = task->rows[0].c.by_spot;
    const char *const how = !by_spot ? ": no spots in the tables"
                            : p->data[0].spots_are_named && p->data[1].spots_are_named ? ""
                            : task->job->map_spots
                                ? ": each place of a map counts as one"
                                : ": each file counts as one where none were named";
    snprintf(text, size, "%s%s", analysis_unit_text(by_spot ? UNIT_IS_SPOT : UNIT_IS_CURVE), how);
}

static void format_rates(const comparison_task *task, char *text, size_t size)
{
    const wt_rate_matching matching = task->rows[0].c.rate_matching;
    const bool by_factor = task->p->by_factor,
               by_dma = task->inputs.rates_by_dma || (by_factor && matching != WT_RATES_COMMON);
    const rate_match match = !task->p->by_rate                          ? RATES_NOT_KNOWN
                             : by_dma                                   ? RATES_BROUGHT
                             : by_factor || matching == WT_RATES_COMMON ? RATES_COMMON
                                                                        : RATES_BROUGHT;
    const char *const how = match == RATES_NOT_KNOWN       ? ""
                            : by_dma                       ? " by the DMA"
                            : by_factor                    ? ", each brought to one by the DMA"
                            : matching == WT_RATES_WITHIN  ? " by the slope within the spots"
                            : matching == WT_RATES_BETWEEN ? " by the slope between the spots"
                                                           : "";
    snprintf(text, size, "%s%s", rate_match_text(match), how);
}

/* Half the range of ln(ratio) over the rates. It becomes an error of the single ratio. */
static double rate_ratio_half_range(const compare_row *rates, size_t n)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++)
        if (rates[i].valid) {
            low = fmin(low, rates[i].c.log_ratio.value);
            high = fmax(high, rates[i].c.log_ratio.value);
        }
    return high > low ? (high - low) / 2 : 0;
}

TABLE_KEYS(comparison, COMPARISON, const char *differs, *settled_by, *would_explain, *unit, *rates,
           *includes, *cancels;
           cantilever_count cantilevers; wt_estimate margin, rate_slope, ratio;
           double interaction_p, ratio_df, rate_spread, calibration_share, spot_scatter;
           ratio_choices choices;)

/* Sets the ratio and its error for friction: a Student's t error of the logarithm, unknown without
 * an interval. */
static void set_ratio_keys(const comparison_task *task, bool twisted, bool interval,
                           comparison_keys *keys)
{
    const wt_comparison *c = &task->rows[0].c;
    double error = interval ? c->log_ratio.standard_error : (double)NAN;
    if (twisted) {
        keys->rate_spread = rate_ratio_half_range(task->rows + 1, task->p->n_bins);
        error = hypot(error, keys->rate_spread);
    }
    /* uniform distribution over the effect of plausible causes */
    error = hypot(error, hypot(task->unstated.lower, task->unstated.higher) / sqrt(3));
    keys->ratio = (wt_estimate){c->ratio, c->ratio * error, 0, NULL};
    if (interval && isfinite(c->df))
        keys->ratio_df = c->df;
    /* share of spring constants, sensitivities, tips and temperatures in this variance */
    const double known = c->offset_variance_share * pow(c->log_ratio.standard_error / error, 2);
    if (interval && known > 0)
        keys->calibration_share = known;
}

static wt_status write_comparison_table(const comparison_task *task, wt_table **table,
                                        wt_error *err)
{
    const compare_pair *p = task->p;
    const wt_comparison *c = &task->rows[0].c;
    const size_t n_rates = task->n_rates;
    const compare_verdict v = compare_assess(p, task->job, &task->inputs, &task->unstated,
                                             &task->rows[0], task->rows + 1, n_rates);
    const bool interval =
        c->undecided_reason == WT_UNDECIDED_NOT && !task->inputs.lacks_spring_constant_error;
    table_writer t = table_begin(&comparison_schema, err);
    add_comparison_rows(&t, task->rows, n_rates + 1, v.is_unreportable, interval, &task->unstated);
    const bool given = interval && c->scatter_is_stated;
    char includes[544];
    snprintf(includes, sizeof includes, "%s%s%s",
             given ? "scatter of spots as given" : "scatter of the units", task->inputs.includes,
             task->unstated.plausible[0] != '\0' ? " + what else may well make the ratio" : "");
    const double none = (double)NAN;
    char differs[640], unit[96], rates[96];
    format_analysis_unit(task, unit, sizeof unit);
    format_rates(task, rates, sizeof rates);
    snprintf(differs, sizeof differs, "%s: %s", stated_verdict_text(v.verdict), v.reason);
    comparison_keys keys = {
        .differs = differs,
        .settled_by = v.settled_by,
        .would_explain = v.is_unreportable ? NULL : task->unstated.would_explain,
        .unit = unit,
        .rates = rates,
        .includes = interval && !v.is_unreportable ? includes : NULL,
        .cantilevers = task->inputs.has_two_cantilevers ? TWO_CANTILEVERS : ONE_CANTILEVER,
        .cancels = v.is_unreportable ? NULL : task->inputs.cancels,
        .margin = {task->job->margin, 0, 0, NULL},
        .rate_slope = c->rate_slope,
        .ratio = {none, none, 0, NULL},
        .interaction_p = c->interaction_p,
        .ratio_df = none,
        .rate_spread = none,
        .calibration_share = none,
        .choices = v.choices,
        .spot_scatter = given ? task->job->spot_scatter : none};
    if (!v.is_unreportable)
        set_ratio_keys(task, v.depends_on_rate, interval, &keys);
    comparison_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status compare_tabulate(compare_pair *p, const wt_compare_job *job, const wt_job *work,
                           wt_table **table, wt_error *err)
{
    comparison_task task = {.p = p, .job = job, .work = work};
    const bool both = p->data[0].group.n > 0 && p->data[1].group.n > 0;
    task.n_rates = both ? p->n_bins : 0;
    task.rows = wt_alloc(1 + task.n_rates, sizeof *task.rows);
    wt_status status =
        both ? compare_all_rows(&task, err) : count_group_units(&task, task.rows, err);
    if (status == WT_OK && !both)
        status = comparison_find_inputs(p, job, work, false, &task.inputs, err);
    if (status == WT_OK && both)
        status = compare_find_unstated_errors(p, job, work, &task.rows[0], &task.unstated, err);
    if (status == WT_OK)
        warn_copies(&task);
    if (status == WT_OK && both) {
        warn_two_spots(&task);
        warn_one_spot(&task);
        warn_rates(&task);
    }
    if (status == WT_OK)
        status = write_comparison_table(&task, table, err);
    free(task.rows);
    return status;
}
