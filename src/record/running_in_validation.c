/* Job that sets the running-in of records beside friction during the growth of a layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "record/layer_growth.h"
#include "record/numerics/running_in_curve.h"
#include "record/validation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Most rows of a run, in equal ratios of the time, for the resolution of a figure. */
enum { MOST_ROWS = 48 };

/* One record with its prediction. */
typedef struct running_in {
    const recorded_run *rec;
    const growth *growth; /* NULL if not predicted */
    wt_interval factor;   /* of the predicted times, by the record */
    /* of ln of that factor and of ln of the measured time, by the errors of the prediction */
    double factor_error, time_error;
    char note[256]; /* reason */
} running_in;

typedef struct running_in_task {
    const wt_validation_job *job;
    const wt_job *work;
    recorded_run *rec; /* [n] */
    running_in *run;   /* [n] */
    growth *growth;    /* [n] of runs with conditions of their own */
    bool *has_growth;  /* [n] true if the run has a prediction of its own */
    size_t n, n_compared;
    char remarks[640]; /* assumptions about the record */
} running_in_task;

/* ---- course ---------------------------------------------------------------------------------- */

TABLE_ROW(validation_course, VALIDATION_COURSE, double time, measured; wt_estimate layered, bare;
          const char *file;)

/* Adds the mean over the cycles from `first` to before `end`. */
static void add_course_row(const running_in *run, size_t first, size_t end, table_writer *t)
{
    const recorded_run *const rec = run->rec;
    const double from = first > 0 ? rec->end[first - 1] : rec->begin,
                 time = 0.5 * (from + rec->end[end - 1]);
    double mean = 0;
    for (size_t i = first; i < end; i++)
        mean += rec->friction[i] / (double)(end - first);
    TABLE_ADD(validation_course, t, time, mean,
              growth_estimate(run->growth, growth_friction_at, time),
              growth_estimate(run->growth, growth_bare_friction, time), rec->at.file);
}

static void add_course_rows(const running_in *run, table_writer *t)
{
    const recorded_run *const rec = run->rec;
    const double step = pow(rec->end[rec->n - 1] / rec->end[0], 1.0 / MOST_ROWS);
    for (size_t first = 0, end; first < rec->n; first = end) {
        const double until = first > 0 ? rec->end[first - 1] * step : rec->end[0];
        end = first + 1;
        while (end < rec->n && rec->end[end] <= until)
            end++;
        add_course_row(run, first, end, t);
    }
}

static wt_status tabulate_courses(const running_in_task *task, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&validation_course_schema, err);
    for (size_t i = 0; i < task->n && t.status == WT_OK; i++) {
        if (task->run[i].growth == NULL)
            continue;
        table_block(&t);
        add_course_rows(&task->run[i], &t);
    }
    return table_end(&t, table);
}

/* ---- predictions ----------------------------------------------------------------------------- */

/* Tolerances of conditions that share one prediction: the control accuracy of a record. */
static const double same_velocity = 0.01, same_pressure = 0.01, same_temperature = 0.25 /* [K] */;

static bool is_within_tolerance(double a, double b, double off)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= off;
}

/* Assigns the prediction of an earlier run with the same conditions, or computes one. */
static wt_status predict_run(running_in_task *task, size_t i, wt_error *err)
{
    running_in *const run = &task->run[i];
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

/* The predicted course of the nominal values (k = 0) or of draw k - 1. */
typedef struct drawn_course {
    const growth *growth;
    size_t k;
} drawn_course;

static double drawn_friction(const void *user, double time)
{
    const drawn_course *const c = user;
    return growth_friction_at(c->growth, c->k, time);
}

/* Adds a finite value to the n in x. */
static size_t add_finite(double *x, size_t n, double value)
{
    if (isfinite(value))
        x[n++] = value;
    return n;
}

/* The course of each draw is fitted to the nominal one at times of the record, so that the errors
 * hold that of the shape of the course, too. */
static void fit_drawn_courses(running_in *run, const running_in_mean *mean)
{
    /* The courses are without scatter, so that more times add nothing. */
    enum { MOST_TIMES = 256 };
    static const double range = 4, /* of the factor of a draw over the nominal one, both ways */
        least_share = 0.95;        /* of draws with a time; else the error is unknown */
    const size_t every = (run->rec->n + MOST_TIMES - 1) / MOST_TIMES, n = run->rec->n / every,
                 n_draws = run->growth->n_draws;
    const drawn_course nominal = {run->growth, 0};
    running_in_mean *const at = wt_alloc(n, sizeof *at);
    double *const log_factor = wt_alloc(n_draws, sizeof *log_factor), *const log_time = wt_alloc(
                                                                          n_draws,
                                                                          sizeof *log_time);
    size_t n_factors = 0, n_times = 0;
    for (size_t i = 0; i < n; i++) {
        at[i] = mean[i * every];
        at[i].friction =
            running_in_mean_of(drawn_friction, &nominal, at[i].begin / run->factor.value,
                               at[i].end / run->factor.value);
    }
    for (size_t k = 1; k <= n_draws; k++) {
        const drawn_course drawn = {run->growth, k};
        const double factor = running_in_curve_factor_between(
            at, n, drawn_friction, &drawn, run->factor.value / range, run->factor.value * range);
        n_factors = add_finite(log_factor, n_factors, log(factor));
        n_times = add_finite(log_time, n_times,
                             log(factor * growth_settling_time(run->growth, k, (double)NAN)));
    }
    if (n_factors > 1 && (double)n_factors >= least_share * (double)n_draws)
        run->factor_error = sqrt(sample_moments(log_factor, n_factors).variance);
    if (n_times > 1 && (double)n_times >= least_share * (double)n_draws)
        run->time_error = sqrt(sample_moments(log_time, n_times).variance);
    free(at);
    free(log_factor);
    free(log_time);
}

/* Fits the predicted course to the means of the cycles. */
static void fit_course(running_in *run)
{
    const recorded_run *const rec = run->rec;
    running_in_mean *const mean = wt_alloc(rec->n, sizeof *mean);
    for (size_t i = 0; i < rec->n; i++)
        mean[i] =
            (running_in_mean){i > 0 ? rec->end[i - 1] : rec->begin, rec->end[i], rec->friction[i]};
    const drawn_course nominal = {run->growth, 0};
    run->factor = running_in_curve_factor(mean, rec->n, drawn_friction, &nominal);
    run->factor_error = run->time_error = (double)NAN;
    if (!isnan(run->factor.value))
        fit_drawn_courses(run, mean);
    if (isnan(run->factor.low) && isnan(run->factor.high))
        snprintf(run->note, sizeof run->note,
                 "no change like that by the layer exceeds the scatter of the cycles");
    else if (isnan(run->factor.low) || isnan(run->factor.high))
        snprintf(run->note, sizeof run->note, "the record does not determine the time both ways");
    free(mean);
}

static wt_status predict_runs(running_in_task *task, wt_error *err)
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
    for (size_t i = 0; status == WT_OK && i < task->n; i++) {
        running_in *const run = &task->run[i];
        run->rec = &task->rec[i];
        if (run->rec->note[0] != '\0')
            snprintf(run->note, sizeof run->note, "%s", run->rec->note);
        else if (isnan(task->job->sliding->shear_stress.value))
            snprintf(run->note, sizeof run->note,
                     "no shear stress is given, and the total friction is not predicted without "
                     "it");
        else
            status = predict_run(task, i, err);
        if (run->growth != NULL)
            fit_course(run);
        task->n_compared += run->growth != NULL;
    }
    return status;
}

static void task_clear(running_in_task *task)
{
    for (size_t i = 0; task->growth != NULL && i < task->n; i++)
        growth_clear(&task->growth[i]);
    free(task->run);
    free(task->growth);
    free(task->has_growth);
    recorded_free(task->rec, task->n);
}

/* ---- table of the runs ----------------------------------------------------------------------- */

TABLE_ROW(validation_running_in, VALIDATION_RUNNING_IN, measured_step at;
          wt_interval settled, time_ratio; wt_estimate predicted, change; const char *note, *file;)

/* Returns x times a factor, with the relative error of the prediction, too, as that of a logarithm.
 */
static wt_interval with_prediction(wt_interval x, double by, double error)
{
    const double low = exp(-hypot(log(x.value / x.low), NORMAL_95 * error)) * x.value,
                 high = exp(hypot(log(x.high / x.value), NORMAL_95 * error)) * x.value;
    return (wt_interval){by * x.value, by * (high - low) / (2 * NORMAL_95), by * low, by * high};
}

static wt_interval time_ratio(const running_in *run)
{
    return with_prediction(run->factor, 1, run->factor_error);
}

/* The keys are of a single record that determines a time. */
static void set_time_ratio_keys(const running_in_task *task, table_writer *t)
{
    wt_interval ratio = {0, 0, 0, 0};
    size_t n = 0;
    for (size_t i = 0; i < task->n; i++)
        if (task->run[i].growth != NULL && !isnan(task->run[i].factor.value)) {
            ratio = time_ratio(&task->run[i]);
            n++;
        }
    if (n != 1)
        return;
    validation_running_in_set_value(t, VALIDATION_RUNNING_IN_KEY_TIME_RATIO, ratio.value,
                                    ratio.standard_error, (double)NAN);
    if (isnan(ratio.low) || isnan(ratio.high))
        return;
    /* the limits follow the value, see KEY_BOUNDS, and have no error */
    validation_running_in_set_value(t, VALIDATION_RUNNING_IN_KEY_TIME_RATIO_LOW, ratio.low, 0, 0);
    validation_running_in_set_value(t, VALIDATION_RUNNING_IN_KEY_TIME_RATIO_HIGH, ratio.high, 0, 0);
}

static void add_run_row(const running_in *run, const wt_sliding *sliding, table_writer *t)
{
    const double none = (double)NAN;
    validation_running_in_row row = {.at = run->rec->at,
                                     .settled = {none, none, none, none},
                                     .time_ratio = {none, none, none, none},
                                     .predicted = {none, none, none, NULL},
                                     .change = {none, none, none, NULL},
                                     .note = run->note,
                                     .file = run->rec->at.file};
    if (isnan(row.at.temperature))
        row.at.temperature = sliding->rubber->prony.reference_temperature;
    if (run->growth != NULL) {
        row.predicted = growth_estimate(run->growth, growth_settling_time, none);
        row.change = growth_estimate(run->growth, growth_change, none);
        row.time_ratio = time_ratio(run);
        row.settled = with_prediction(run->factor, row.predicted.value, run->time_error);
    }
    validation_running_in_add_row(t, &row);
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

static wt_status tabulate_runs(const running_in_task *task, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&validation_running_in_schema, err);
    for (size_t i = 0; i < task->n; i++)
        add_run_row(&task->run[i], task->job->sliding, &t);
    set_time_ratio_keys(task, &t);
    validation_running_in_set_print(&t, VALIDATION_RUNNING_IN_KEY_RUNS, "%zu", task->n_compared);
    validation_running_in_set_text(&t, VALIDATION_RUNNING_IN_KEY_INCLUDES,
                                   prediction_error_sources(task));
    set_remarks(task, &t);
    return table_end(&t, table);
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
    status = predict_runs(&task, err);
    if (status == WT_OK)
        status = tabulate_runs(&task, &made.running_in, err);
    if (status == WT_OK)
        status = tabulate_courses(&task, &made.running_in_curve, err);
    cost_report(work, (cost_summary){.items = (double)task.n, .tolerance_asked = work->tolerance});
    task_clear(&task);
    if (status == WT_OK) {
        *tables = made;
        made = (wt_running_in_tables){0};
    }
    wt_tables_clear(&made, sizeof made);
    return status;
}
