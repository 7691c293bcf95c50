/* Job that compares the running-in of records with friction during the growth of a layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"
#include "core/base/param.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "record/validation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
        .fitted = fit->seen
                      ? fit->level + fit->ratio * running_in_curve_at(&c, log(time - fit->shift) -
                                                                              fit->log_factor)
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

/* Creates the table "validation_course". */
static wt_status running_in_curve_tabulate(const run_set *all, const char *verdict,
                                           wt_table **table, wt_error *err)
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

static const wt_interval unknown_interval = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
static const wt_estimate unknown_estimate = {(double)NAN, (double)NAN, (double)NAN, NULL};

typedef struct running_in_task {
    const wt_validation_job *job;
    const wt_job *work;
    recorded_run *rec; /* [n] */
    run_fit *run;      /* [n] */
    growth *growth;    /* [n] of runs with conditions of their own */
    bool *has_growth;  /* [n] true if the run has a prediction of its own */
    size_t n, n_compared;
    char remarks[640]; /* assumptions about the record */
} running_in_task;

/* ---- predictions and fits -------------------------------------------------------------------- */

/* Tolerances of conditions that share one prediction: the control accuracy of a record. */
static const double same_velocity = 0.01, same_pressure = 0.01, same_temperature = 0.25 /* [K] */;

static bool is_within_tolerance(double a, double b, double off)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= off;
}

/* Assigns the prediction of an earlier run with the same conditions, or computes one. */
static wt_status predict_run(running_in_task *task, size_t i, wt_error *err)
{
    run_fit *const run = &task->run[i];
    wt_error failure = WT_ERROR_INIT;
    const measured_step *const b = &task->rec[i].at;
    for (size_t k = 0; k < i; k++) {
        const measured_step *const a = &task->rec[k].at;
        if (task->has_growth[k] &&
            is_within_tolerance(a->velocity, b->velocity, same_velocity * b->velocity) &&
            is_within_tolerance(a->pressure, b->pressure, same_pressure * b->pressure) &&
            is_within_tolerance(a->temperature, b->temperature, same_temperature)) {
            run->growth = &task->growth[k];
            return WT_OK;
        }
    }
    const wt_status status =
        growth_compute(task->job->sliding, task->job->layer, task->job->layer_observation,
                       &task->rec[i].at, task->work, &task->growth[i], &failure);
    if (status == WT_E_MEMORY || status == WT_E_INTERNAL)
        return wt_fail(err, status, "friction in running-in could not be predicted");
    task->has_growth[i] = status == WT_OK;
    if (status == WT_OK)
        run->growth = &task->growth[i];
    else
        snprintf(run->note, sizeof run->note, "%s", failure.message);
    return WT_OK;
}

static wt_status compare_run(running_in_task *task, size_t i, wt_error *err)
{
    run_fit *const run = &task->run[i];
    *run = (run_fit){.rec = &task->rec[i]};
    snprintf(run->note, sizeof run->note, "%s", run->rec->note);
    if (run->note[0] != '\0' || isnan(task->job->sliding->shear_stress.value))
        return WT_OK;
    const wt_status status = predict_run(task, i, err);
    if (status == WT_OK && run->growth != NULL)
        run_fit_compute(run, task->job->running_in_margin);
    task->n_compared += run->value != NULL;
    return status;
}

static wt_status compare_runs(running_in_task *task, wt_error *err)
{
    table_view record = {0}, cycles = {0};
    wt_status status = table_bind(task->job->record, &record_schema, "", &record, err);
    if (status == WT_OK)
        status = table_bind(task->job->cycles, &record_cycles_schema, "", &cycles, err);
    if (status != WT_OK)
        return status;
    measured_default_remarks(&record, true, task->remarks, sizeof task->remarks);
    task->rec = recorded_read(&record, &cycles, task->job->sliding, &task->n);
    task->run = wt_alloc(task->n, sizeof *task->run);
    task->growth = wt_alloc(task->n, sizeof *task->growth);
    task->has_growth = wt_alloc(task->n, sizeof *task->has_growth);
    for (size_t i = 0; status == WT_OK && i < task->n; i++)
        status = compare_run(task, i, err);
    return status;
}

static void task_clear(running_in_task *task)
{
    for (size_t i = 0; i < task->n; i++) {
        if (task->run != NULL)
            run_fit_clear(&task->run[i]);
        if (task->growth != NULL)
            growth_clear(&task->growth[i]);
    }
    free(task->run);
    free(task->growth);
    free(task->has_growth);
    recorded_free(task->rec, task->n);
}

/* ---- table of the runs ----------------------------------------------------------------------- */

TABLE_ROW(validation_running_in, VALIDATION_RUNNING_IN, measured_step at;
          wt_interval settled, time_ratio, change_ratio; wt_estimate predicted, change;
          const char *note, *file;)

/* Standard error of a number of a run. NaN without draws, since the interval must include the error
 * of the prediction. */
static double run_standard_error(const run_fit *run, run_quantity number)
{
    return hypot(sqrt(run_fit_record_variance(run, number)),
                 run_fit_prediction_deviation(run, number));
}

/* Interval of a time or its ratio. If the record determines one limit alone, the other is NaN. */
static wt_interval run_factor_interval(const run_fit *run, run_quantity number)
{
    const bool has_low = !isnan(run->fit.low), has_high = !isnan(run->fit.high);
    const double limit = exp(run_fit_bound(run, number)), none = (double)NAN;
    if (has_low && has_high)
        return validation_factor(run_fit_value(run, 0, number), run_standard_error(run, number),
                                 (double)INFINITY);
    return (wt_interval){none, none, has_low ? limit : none, has_high ? limit : none};
}

static wt_interval run_ratio_interval(const run_fit *run)
{
    const double value = run_fit_value(run, 0, RUN_RATIO),
                 error = run_standard_error(run, RUN_RATIO),
                 half = agreement_quantile((double)INFINITY) * error;
    return (wt_interval){value, error, value - half, value + half};
}

/* Largest difference of friction from its final value. NaN without a final value. */
static double largest_change(const growth *g, size_t k, double time)
{
    const running_in_curve c = growth_curve(g, k);
    double most = 0;
    (void)time;
    for (size_t i = 0; i < c.n; i++)
        if (fabs(c.value[i]) > fabs(most))
            most = c.value[i];
    return k == 0 || isfinite(growth_quantity_value(g, k, GROWTH_END)) ? most : (double)NAN;
}

static void add_run_row(const run_fit *run, const wt_sliding *sliding, table_writer *t)
{
    validation_running_in_row row = {.at = run->rec->at,
                                     .settled = unknown_interval,
                                     .time_ratio = unknown_interval,
                                     .change_ratio = unknown_interval,
                                     .predicted = unknown_estimate,
                                     .change = unknown_estimate,
                                     .note = run->note,
                                     .file = run->rec->at.file};
    const double none = (double)NAN;
    if (isnan(row.at.temperature))
        row.at.temperature = sliding->rubber->prony.reference_temperature;
    if (run->value != NULL) {
        const double predicted = exp(run_fit_value(run, 0, RUN_PREDICTED));
        row.predicted.value = predicted;
        row.predicted.standard_error = predicted * run_fit_prediction_deviation(run, RUN_PREDICTED);
        row.change =
            (wt_estimate){-largest_change(run->growth, 0, none),
                          growth_standard_deviation(run->growth, largest_change, none), none, NULL};
        if (!run->ambiguous)
            row.change_ratio = run_ratio_interval(run);
        if (run->fit.seen && !run->ambiguous) {
            row.settled = run_factor_interval(run, RUN_MEASURED);
            row.time_ratio = run_factor_interval(run, RUN_TIME_RATIO);
        }
    }
    validation_running_in_add_row(t, &row);
}

/* ---- keys ------------------------------------------------------------------------------------ */

/* Without an error of the prediction, the error of the record alone is not an interval of the
 * number. */
static wt_interval level_interval(const run_set *all, run_quantity number)
{
    wt_interval i = run_level_interval(&all->level[number]);
    if (all->skip_numerical_errors != NULL)
        i.standard_error = i.low = i.high = (double)NAN;
    return i;
}

static wt_interval exponential_interval(wt_interval i)
{
    const double value = exp(i.value);
    return (wt_interval){value, value * i.standard_error, exp(i.low), exp(i.high)};
}

static void set_running_in_interval(table_writer *t, validation_running_in_key key, wt_interval i)
{
    if (isnan(i.value))
        return;
    validation_running_in_set_value(t, key, i.value, i.standard_error, (double)NAN);
    if (isnan(i.low) || isnan(i.high))
        return;
    /* the limits follow the value, see KEY_BOUNDS, and have no error */
    validation_running_in_set_value(t, (validation_running_in_key)(key + 1), i.low, 0, 0);
    validation_running_in_set_value(t, (validation_running_in_key)(key + 2), i.high, 0, 0);
}

/* Compares the required wear rate with the measured one. */
static wt_status set_wear_agreement(const running_in_task *task, const run_set *all,
                                    table_writer *t, wt_error *err)
{
    table_view wear = {0};
    const wt_interval required = level_interval(all, RUN_WEAR);
    if (task->job->wear == NULL || isnan(required.standard_error))
        return WT_OK;
    const wt_status status = table_bind(task->job->wear, &wear_schema, "", &wear, err);
    if (status != WT_OK)
        return status;
    const wt_estimate measured_rate = wear_value(&wear, WEAR_KEY_RATE);
    if (!(measured_rate.value > 0))
        return WT_OK;
    const bool known = measured_rate.standard_error > 0;
    const wt_interval ratio = validation_factor(
        required.value - log(measured_rate.value),
        hypot(required.standard_error,
              known ? measured_rate.standard_error / measured_rate.value : (double)NAN),
        (double)INFINITY);
    if (known)
        validation_running_in_set_print(
            t, VALIDATION_RUNNING_IN_KEY_AGREES,
            "%s: the time requires %.3g times the wear rate that was measured (95 %%: %s)",
            ratio.low <= 1 && ratio.high >= 1 ? "agrees within the errors" : "contradicts",
            ratio.value, format_range(ratio.low, ratio.high, 3).text);
    else
        validation_running_in_set_print(t, VALIDATION_RUNNING_IN_KEY_AGREES,
                                        "inconclusive: the time requires %.3g times the wear "
                                        "rate that was measured, which has no stated error",
                                        ratio.value);
    return WT_OK;
}

static void set_remarks(const running_in_task *task, table_writer *t)
{
    const double duty = task->job->layer->duty;
    const char *const words = task->remarks, *const join = words[0] != '\0' ? "; " : "";
    if (duty < 1)
        validation_running_in_set_print(
            t, VALIDATION_RUNNING_IN_KEY_REMARKS,
            "%s%sa place of the rubber is in contact for %.3g of the time, as the case says", words,
            join, duty);
    else
        validation_running_in_set_print(t, VALIDATION_RUNNING_IN_KEY_REMARKS,
                                        "%s%sthe rubber is in contact all the time, as the case "
                                        "has no duty below 1: a track that a pin passes once in a "
                                        "lap is not",
                                        words, join);
}

/* Names the errors in the prediction of the first run that has one. */
static const char *prediction_error_sources(const running_in_task *task)
{
    for (size_t i = 0; i < task->n; i++)
        if (task->has_growth[i])
            return task->growth[i].n_draws > 0 ? task->growth[i].includes
                                               : "nothing: none were drawn";
    return "nothing: there is no prediction";
}

static wt_status set_running_in_keys(const running_in_task *task, const run_set *all,
                                     const run_verdict *result, table_writer *t, wt_error *err)
{
    validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_VERDICT, result->verdict);
    validation_running_in_set_print(
        t, VALIDATION_RUNNING_IN_KEY_TEST,
        "yes: the intervals of 95 %% of the time and of the change of friction, measured over "
        "predicted, are from %s; no: one of them is outside; else it is inconclusive. "
        "Errors of record and prediction are in them, choices of the model are not",
        validation_requested_range(all->margin).text);
    if (result->settled_by[0] != '\0')
        validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_SETTLED_BY, result->settled_by);
    set_running_in_interval(t, VALIDATION_RUNNING_IN_KEY_TIME_RATIO,
                            exponential_interval(level_interval(all, RUN_TIME_RATIO)));
    set_running_in_interval(t, VALIDATION_RUNNING_IN_KEY_CHANGE_RATIO,
                            level_interval(all, RUN_RATIO));
    wt_status status = WT_OK;
    set_running_in_interval(t, VALIDATION_RUNNING_IN_KEY_WEAR,
                            exponential_interval(level_interval(all, RUN_WEAR)));
    set_running_in_interval(t, VALIDATION_RUNNING_IN_KEY_ENERGY,
                            exponential_interval(level_interval(all, RUN_ENERGY)));
    status = set_wear_agreement(task, all, t, err);
    validation_running_in_set_print(t, VALIDATION_RUNNING_IN_KEY_RUNS, "%zu", task->n_compared);
    validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_INCLUDES,
                                   prediction_error_sources(task));
    set_remarks(task, t);
    return status;
}

static wt_status tabulate_runs(const running_in_task *task, const run_set *all,
                               const run_verdict *result, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&validation_running_in_schema, err);
    for (size_t i = 0; i < task->n; i++)
        add_run_row(&task->run[i], task->job->sliding, &t);
    if (t.status == WT_OK)
        t.status = set_running_in_keys(task, all, result, &t, err);
    return table_end(&t, table);
}

/* ---- all runs -------------------------------------------------------------------------------- */

static const char *missing_errors_reason(const running_in_task *task)
{
    for (size_t i = 0; i < task->n; i++)
        if (task->has_growth[i] && task->growth[i].n_draws == 0)
            return "the prediction has no errors: none are stated, or no replicates drawn";
    return NULL;
}

wt_status wt_running_in_validation_compute(const wt_validation_job *job, const wt_job *work,
                                           wt_running_in_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || job->record == NULL ||
        job->cycles == NULL || job->layer == NULL || job->layer_observation == NULL)
        return wt_fail(err, WT_E_ARG, "no running-in to hold against a layer");
    running_in_task task = {.job = job, .work = work};
    wt_running_in_tables made = {0};
    wt_status status = param_check(wt_validation_job_params(), job, err);
    if (status == WT_OK)
        status = flow_sliding_check(job->sliding, work, err);
    if (status != WT_OK)
        return status;
    status = compare_runs(&task, err);
    run_set all = {.runs = task.run,
                   .n = task.n,
                   .margin = job->running_in_margin,
                   .seed = work->seed,
                   .has_shear = !isnan(job->sliding->shear_stress.value),
                   .skip_numerical_errors = missing_errors_reason(&task)};
    if (status == WT_OK)
        status = run_set_compute_levels(&all, err);
    if (status == WT_OK) {
        const run_verdict result = run_set_assess(&all);
        status = tabulate_runs(&task, &all, &result, &made.running_in, err);
        if (status == WT_OK)
            status = running_in_curve_tabulate(&all, result.verdict, &made.running_in_curve, err);
    }
    cost_report(work, (cost_summary){.items = (double)task.n, .tolerance_asked = work->tolerance});
    run_set_clear(&all);
    task_clear(&task);
    if (status == WT_OK) {
        *tables = made;
        made = (wt_running_in_tables){0};
    }
    wt_tables_clear(&made, sizeof made);
    return status;
}
