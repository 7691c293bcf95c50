/* Job that compares the running-in of records with friction during the growth of a layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "record/validation.h"

#include "core/base/param.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void wt_running_in_tables_clear(wt_running_in_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->running_in);
    wt_table_free(tables->course);
    *tables = (wt_running_in_tables){0};
}

static const wt_interval not_known = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
static const wt_estimate no_number = {(double)NAN, (double)NAN, (double)NAN, NULL};

typedef struct running_in_task {
    const wt_validation_job *job;
    const wt_job *work;
    recorded *rec;  /* [n] */
    run_fit *run;   /* [n] */
    growth *growth; /* [n] of runs with conditions of their own */
    bool *own;      /* [n] true if the run has a prediction of its own */
    size_t n, n_compared;
    char remarks[640]; /* assumptions about the record */
} running_in_task;

/* ---- predictions and fits -------------------------------------------------------------------- */

/* Tolerances of conditions that share one prediction: the control accuracy of a record. */
static const double same_velocity = 0.01, same_pressure = 0.01, same_temperature = 0.25 /* [K] */;

static bool is_near(double a, double b, double off)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= off;
}

static bool are_alike(const measured_step *a, const measured_step *b)
{
    return is_near(a->velocity, b->velocity, same_velocity * b->velocity) &&
           is_near(a->pressure, b->pressure, same_pressure * b->pressure) &&
           is_near(a->temperature, b->temperature, same_temperature);
}

/* Uses the prediction of an earlier run with the same conditions, or computes one. */
static wt_status predict(running_in_task *task, size_t i, wt_error *err)
{
    run_fit *const run = &task->run[i];
    wt_error why = WT_ERROR_INIT;
    for (size_t k = 0; k < i; k++)
        if (task->own[k] && are_alike(&task->rec[k].at, &task->rec[i].at)) {
            run->growth = &task->growth[k];
            return WT_OK;
        }
    const wt_status status = growth_make(task->job->sliding, task->job->layer, task->job->known,
                                         &task->rec[i].at, task->work, &task->growth[i], &why);
    if (status == WT_E_MEMORY || status == WT_E_INTERNAL)
        return wt_fail(err, status, "friction in running-in could not be predicted");
    task->own[i] = status == WT_OK;
    if (status == WT_OK)
        run->growth = &task->growth[i];
    else
        snprintf(run->note, sizeof run->note, "%s", why.message);
    return WT_OK;
}

static wt_status compare_run(running_in_task *task, size_t i, wt_error *err)
{
    run_fit *const run = &task->run[i];
    *run = (run_fit){.rec = &task->rec[i]};
    snprintf(run->note, sizeof run->note, "%s", run->rec->note);
    if (run->note[0] != '\0' || isnan(task->job->sliding->shear_stress.value))
        return WT_OK;
    wt_status status = predict(task, i, err);
    if (status == WT_OK && run->growth != NULL)
        status = run_fit_compute(run, task->job->running_in_margin, err);
    task->n_compared += run->value != NULL;
    return status;
}

static wt_status begin(running_in_task *task, wt_error *err)
{
    table_view record = {0}, cycles = {0};
    wt_status status = table_bind(task->job->record, &record_schema, "", &record, err);
    if (status == WT_OK)
        status = table_bind(task->job->cycles, &record_cycles_schema, "", &cycles, err);
    if (status == WT_OK)
        measured_taken(&record, true, task->remarks, sizeof task->remarks);
    if (status == WT_OK)
        status = recorded_read(&record, &cycles, task->job->sliding, &task->rec, &task->n, err);
    if (status != WT_OK)
        return status;
    task->run = calloc(task->n + 1, sizeof *task->run);
    task->growth = calloc(task->n + 1, sizeof *task->growth);
    task->own = calloc(task->n + 1, sizeof *task->own);
    if (task->run == NULL || task->growth == NULL || task->own == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
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
    free(task->own);
    recorded_free(task->rec, task->n);
}

/* ---- table of the runs ----------------------------------------------------------------------- */

TABLE_ROW(validation_running_in, VALIDATION_RUNNING_IN, measured_step at;
          wt_interval settled, time_ratio, change_ratio; wt_estimate predicted, change;
          const char *note, *file;)

/* Standard error of a number of a run. NaN without draws, since the interval must include the error
 * of the prediction. */
static double error_of(const run_fit *run, run_number number)
{
    return hypot(sqrt(run_fit_own(run, number)), run_fit_spread(run, number));
}

/* Interval of a time or its ratio. If the record determines one limit alone, the other is NaN. */
static wt_interval factor_of(const run_fit *run, run_number number)
{
    const bool has_low = !isnan(run->fit.low), has_high = !isnan(run->fit.high);
    const double end = exp(run_fit_end(run, number)), none = (double)NAN;
    if (has_low && has_high)
        return validation_factor(run_fit_value(run, 0, number), error_of(run, number),
                                 (double)INFINITY);
    return (wt_interval){none, none, has_low ? end : none, has_high ? end : none};
}

static wt_interval ratio_of_run(const run_fit *run)
{
    const double value = run_fit_value(run, 0, RUN_RATIO), error = error_of(run, RUN_RATIO),
                 half = agreement_quantile((double)INFINITY) * error;
    return (wt_interval){value, error, value - half, value + half};
}

/* Largest difference of friction from its final value. NaN without a final value. */
static double farthest(const growth *g, size_t k, double time)
{
    const course c = growth_course(g, k);
    double most = 0;
    (void)time;
    for (size_t i = 0; i < c.n; i++)
        if (fabs(c.value[i]) > fabs(most))
            most = c.value[i];
    return k == 0 || isfinite(growth_number_of(g, k, GROWTH_END)) ? most : (double)NAN;
}

static wt_estimate change_of(const growth *g)
{
    const double none = (double)NAN;
    return (wt_estimate){-farthest(g, 0, none), growth_scatter(g, farthest, none), none, NULL};
}

static void add_run(const run_fit *run, const wt_sliding *sliding, table_writer *t)
{
    validation_running_in_row row = {.at = run->rec->at,
                                     .settled = not_known,
                                     .time_ratio = not_known,
                                     .change_ratio = not_known,
                                     .predicted = no_number,
                                     .change = no_number,
                                     .note = run->note,
                                     .file = run->rec->at.file};
    if (isnan(row.at.temperature))
        row.at.temperature = sliding->rubber->prony.reference_temperature;
    if (run->value != NULL) {
        const double predicted = exp(run_fit_value(run, 0, RUN_PREDICTED));
        row.predicted.value = predicted;
        row.predicted.standard_error = predicted * run_fit_spread(run, RUN_PREDICTED);
        row.change = change_of(run->growth);
        row.change_ratio = ratio_of_run(run);
        if (run->fit.seen) {
            row.settled = factor_of(run, RUN_MEASURED);
            row.time_ratio = factor_of(run, RUN_TIME_RATIO);
        }
    }
    validation_running_in_add_row(t, &row);
}

/* ---- keys ------------------------------------------------------------------------------------ */

/* Without an error of the prediction, the error of the record alone is not an interval of the
 * number. */
static wt_interval level_of(const run_set *all, run_number number)
{
    wt_interval i = run_level_interval(&all->level[number]);
    if (all->without_errors != NULL)
        i.standard_error = i.low = i.high = (double)NAN;
    return i;
}

static wt_interval exponential_of(wt_interval i)
{
    const double value = exp(i.value);
    return (wt_interval){value, value * i.standard_error, exp(i.low), exp(i.high)};
}

static void set_interval(table_writer *t, validation_running_in_key key, wt_interval i)
{
    if (isnan(i.value))
        return;
    validation_running_in_set_value(t, key, i.value, i.standard_error, (double)NAN);
    if (isnan(i.low) || isnan(i.high))
        return;
    /* the limits follow the value, see KEY_ENDS, and have no error */
    validation_running_in_set_value(t, (validation_running_in_key)(key + 1), i.low, 0, 0);
    validation_running_in_set_value(t, (validation_running_in_key)(key + 2), i.high, 0, 0);
}

/* Compares the required wear rate with the measured one. */
static wt_status set_agreement(const running_in_task *task, const run_set *all, table_writer *t,
                               wt_error *err)
{
    table_view wear = {0};
    const wt_interval needed = level_of(all, RUN_WEAR);
    if (task->job->wear == NULL || isnan(needed.standard_error))
        return WT_OK;
    const wt_status status = table_bind(task->job->wear, &wear_schema, "", &wear, err);
    if (status != WT_OK)
        return status;
    const wt_estimate is = wear_value(&wear, WEAR_KEY_RATE);
    if (!(is.value > 0))
        return WT_OK;
    const bool known = is.standard_error > 0;
    const wt_interval ratio = validation_factor(
        needed.value - log(is.value),
        hypot(needed.standard_error, known ? is.standard_error / is.value : (double)NAN),
        (double)INFINITY);
    if (known)
        validation_running_in_set_print(
            t, VALIDATION_RUNNING_IN_KEY_AGREES,
            "%s: the time asks for %.3g times the wear rate that was measured (95 %%: %s)",
            ratio.low <= 1 && ratio.high >= 1 ? "agrees within the errors" : "contradicts",
            ratio.value, format_range(ratio.low, ratio.high, 3).text);
    else
        validation_running_in_set_print(t, VALIDATION_RUNNING_IN_KEY_AGREES,
                                        "cannot say: the time asks for %.3g times the wear rate "
                                        "that was measured, which has no "
                                        "stated error",
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
static const char *errors_of(const running_in_task *task)
{
    for (size_t i = 0; i < task->n; i++)
        if (task->own[i])
            return task->growth[i].n_draws > 0 ? task->growth[i].includes
                                               : "nothing: none were drawn";
    return "nothing: there is no prediction";
}

static wt_status set_keys(const running_in_task *task, const run_set *all, const run_verdict *said,
                          table_writer *t, wt_error *err)
{
    validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_VERDICT, said->verdict);
    validation_running_in_set_print(
        t, VALIDATION_RUNNING_IN_KEY_TEST,
        "explains: the intervals of 95 %% of the time and of the change of friction, measured over "
        "predicted, are from %s; does not: one of them is outside; else it cannot say. "
        "Errors of record and prediction are in them, choices of the model are not",
        validation_requested_range(all->margin).text);
    if (said->settled_by[0] != '\0')
        validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_SETTLED_BY, said->settled_by);
    set_interval(t, VALIDATION_RUNNING_IN_KEY_TIME_RATIO,
                 exponential_of(level_of(all, RUN_TIME_RATIO)));
    set_interval(t, VALIDATION_RUNNING_IN_KEY_CHANGE_RATIO, level_of(all, RUN_RATIO));
    wt_status status = WT_OK;
    if (task->job->layer->closure == WT_CLOSURE_ENERGY) {
        set_interval(t, VALIDATION_RUNNING_IN_KEY_WEAR, exponential_of(level_of(all, RUN_WEAR)));
        set_interval(t, VALIDATION_RUNNING_IN_KEY_ENERGY,
                     exponential_of(level_of(all, RUN_ENERGY)));
        status = set_agreement(task, all, t, err);
    }
    validation_running_in_set_print(t, VALIDATION_RUNNING_IN_KEY_RUNS, "%zu", task->n_compared);
    validation_running_in_set_text(t, VALIDATION_RUNNING_IN_KEY_INCLUDES, errors_of(task));
    set_remarks(task, t);
    return status;
}

static wt_status make_runs(const running_in_task *task, const run_set *all, const run_verdict *said,
                           wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&validation_running_in_schema, err);
    for (size_t i = 0; i < task->n; i++)
        add_run(&task->run[i], task->job->sliding, &t);
    if (t.status == WT_OK)
        t.status = set_keys(task, all, said, &t, err);
    return table_end(&t, table);
}

/* ---- all runs -------------------------------------------------------------------------------- */

static const char *why_without_errors(const running_in_task *task)
{
    for (size_t i = 0; i < task->n; i++)
        if (task->own[i] && task->growth[i].n_draws == 0)
            return task->growth[i].without_errors
                       ? "the errors of a layer that acts back are not drawn"
                       : "the prediction has no errors: none are stated, or no replicates drawn";
    return NULL;
}

static wt_status judge(const running_in_task *task, run_set *all, wt_error *err)
{
    *all = (run_set){.runs = task->run,
                     .n = task->n,
                     .margin = task->job->running_in_margin,
                     .seed = task->work->seed,
                     .has_shear = !isnan(task->job->sliding->shear_stress.value),
                     .without_errors = why_without_errors(task)};
    return run_set_levels(all, err);
}

static wt_status check_job(const wt_validation_job *job, const wt_job *work,
                           const wt_running_in_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || job->record == NULL ||
        job->cycles == NULL || job->layer == NULL || job->known == NULL)
        return wt_fail(err, WT_E_ARG, "no running-in to hold against a layer");
    const wt_status status = param_check(wt_validation_job_params(), job, err);
    return status == WT_OK ? flow_sliding_check(job->sliding, work, err) : status;
}

wt_status wt_validation_running_in_make(const wt_validation_job *job, const wt_job *work,
                                        wt_running_in_tables *tables, wt_error *err)
{
    running_in_task task = {.job = job, .work = work};
    wt_running_in_tables made = {0};
    run_set all = {.n = 0};
    wt_status status = check_job(job, work, tables, err);
    if (status != WT_OK)
        return status;
    status = begin(&task, err);
    if (status == WT_OK)
        status = judge(&task, &all, err);
    if (status == WT_OK) {
        const run_verdict said = run_set_assess(&all);
        status = make_runs(&task, &all, &said, &made.running_in, err);
        if (status == WT_OK)
            status = running_in_course_table(&all, said.verdict, &made.course, err);
    }
    cost_report(work, (cost_summary){.items = (double)task.n, .tolerance_asked = work->tolerance});
    run_set_clear(&all);
    task_clear(&task);
    if (status == WT_OK) {
        *tables = made;
        made = (wt_running_in_tables){0};
    }
    wt_running_in_tables_clear(&made);
    return status;
}
