/* Timing of every method of every numerical part at each of its settings.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/accuracy.h"

#include "core/base/array.h"
#include "core/base/param.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const accuracy_part *const lists[] = {accuracy_contact, accuracy_spectrum, accuracy_angular,
                                             accuracy_friction, accuracy_layer};

wt_accuracy_job wt_accuracy_job_defaults(void)
{
    return (wt_accuracy_job){.repeats = 9};
}

static const wt_param rows[] = {
    {PARAM_TEXT_OF("part", wt_accuracy_job, part), .value = "NAME", .unset = "all",
     .help = "this numerical part alone, such as friction-prony"},
    {PARAM("repeats", wt_accuracy_job, repeats, WT_Q_NONE, FROM_TO(1, 1000)), .value = "N",
     .help = "how often each point is timed"},
    {PARAM_FLAG_OF("built-in", wt_accuracy_job, built_in),
     .help = "of a case: the problems that are built in, too, after its own numbers"},
};
PARAM_TABLE(wt_accuracy_job_params, wt_accuracy_job, rows, wt_accuracy_job_defaults, NO_PARTS)

/* Shortest measured time [s]. A clock with a resolution of 1 us then has an error of 0.5 %. */
#define MIN_SECONDS 2e-4

static wt_status time_solution(accuracy_solve *solve, void *problem, double value, double *seconds,
                               wt_error *err)
{
    size_t n = 0;
    const double start = wt_time_cpu();
    do {
        const wt_status status = solve(problem, value, err);
        if (status != WT_OK)
            return status;
        n++;
        *seconds = wt_time_cpu() - start;
    } while (*seconds < MIN_SECONDS);
    *seconds /= (double)n;
    return WT_OK;
}

/* Longest total time [s]. A slow method is repeated less often. */
#define MAX_SECONDS 0.2

wt_status accuracy_time(accuracy_solve *solve, void *problem, double value, size_t repeats,
                        accuracy_timing *t, wt_error *err)
{
    double *seconds = malloc(repeats * sizeof *seconds), sum = 0;
    wt_status status = seconds == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory") : WT_OK;
    size_t n = 0;
    while (status == WT_OK && n < repeats && sum < MAX_SECONDS) {
        status = time_solution(solve, problem, value, &seconds[n], err);
        sum += seconds[n++];
    }
    if (status == WT_OK) {
        numbers_sort(seconds, n);
        *t = (accuracy_timing){
            seconds[n / 2], n > 2 ? (seconds[(3 * n) / 4] - seconds[n / 4]) / 2 : (double)NAN, n};
    }
    free(seconds);
    return status;
}

TABLE_ROW_OF(work_precision, WORK_PRECISION, accuracy_row)

/* A reference in double precision is not more accurate than this. */
static const double least_reference = DBL_EPSILON / 2;

void accuracy_add_row(table_writer *t, accuracy_row row)
{
    row.reference_error = fmax(row.reference_error, least_reference);
    if (row.errors.true_error < row.reference_error)
        row.errors.true_error = row.reference_error;
    work_precision_add_row(t, &row);
}

static wt_status sweep_setting(const accuracy_part *part, void *problem, double reference_error,
                               size_t repeats, table_writer *t, wt_error *err)
{
    wt_status status = WT_OK;
    for (const accuracy_method *m = part->methods; m->name != NULL; m++)
        for (size_t i = 0; i < ACCURACY_VALUES && m->values[i] > 0 && status == WT_OK; i++) {
            accuracy_timing time;
            status = accuracy_time(m->solve, problem, m->values[i], repeats, &time, err);
            if (status == WT_OK)
                accuracy_add_row(t, (accuracy_row){part->name, m->name, m->setting, part->words,
                                                   m->values[i], reference_error,
                                                   part->errors_of_solution(problem), time});
        }
    return status;
}

static wt_status run_part(const accuracy_part *part, size_t repeats, table_writer *t, wt_error *err)
{
    double reference_error = (double)NAN;
    void *problem = calloc(1, part->size);
    if (problem == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = part->begin(problem, &reference_error, err);
    if (status == WT_OK)
        status = sweep_setting(part, problem, reference_error, repeats, t, err);
    part->end(problem);
    free(problem);
    return status;
}

static wt_status report_unknown_part(const char *name, wt_error *err)
{
    char names[512] = "";
    size_t n = 0;
    for (size_t l = 0; l < COUNT_OF(lists); l++)
        for (const accuracy_part *p = lists[l]; p->name != NULL && n < sizeof names; p++)
            n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", n > 0 ? ", " : "", p->name);
    wt_fail(err, WT_E_NOT_FOUND, "there is no numerical part of this name");
    wt_error_place(err, "part");
    wt_error_expected(err, "%s", names);
    wt_error_found(err, "%s", name);
    return WT_E_NOT_FOUND;
}

void accuracy_add_parts(const wt_accuracy_job *job, const wt_job *work, table_writer *t,
                        wt_error *err)
{
    bool found = false;
    for (size_t l = 0; l < COUNT_OF(lists); l++)
        for (const accuracy_part *p = lists[l]; p->name != NULL && t->status == WT_OK; p++) {
            if (job->part != NULL && strcmp(job->part, p->name) != 0)
                continue;
            found = true;
            if (work->progress.report != NULL &&
                !work->progress.report(work->progress.user, p->name, 0, 0))
                t->status = wt_fail(err, WT_E_CANCELLED, "cancelled");
            else
                t->status = run_part(p, job->repeats, t, err);
        }
    if (t->status == WT_OK && !found)
        t->status = report_unknown_part(job->part, err);
}

wt_status wt_accuracy_compute(const wt_accuracy_job *job, const wt_job *work, wt_table **table,
                              wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no accuracy job");
    const wt_status status = param_check(wt_accuracy_job_params(), job, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&work_precision_schema, err);
    accuracy_add_parts(job, work, &t, err);
    return table_end(&t, table);
}
