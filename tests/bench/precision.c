/* Timing of every method of every numerical part at each of its settings.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/precision.h"
#include "bench/bench.h"

#include "core/base/array.h"
#include "core/table/table_rows.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const precision_part *const lists[] = {
    precision_contact, precision_spectrum, precision_angular, precision_friction, precision_layer};

typedef struct timing {
    double median, spread; /* [s] */
    size_t repeats;
} timing;

TABLE_ROW(work_precision, WORK_PRECISION, const char *part, *method, *setting, *words;
          double value, reference_error; precision_errors errors; timing time;)

typedef struct timed_solution {
    precision_solve *solve;
    void *problem;
    double value;
} timed_solution;

static void solve_once(void *data)
{
    const timed_solution *s = data;
    wt_error err = WT_ERROR_INIT;
    bench_check(s->solve(s->problem, s->value, &err), &err);
}

/* A reference in double precision is not more accurate than this. */
static const double least_reference = DBL_EPSILON / 2;
/* The references of the parts with bounds, and the best of the methods, are better than these. */
static const double worst_reference = 1e-11, worst_best = 1e-11, worst_textbook = 1e-4;

static int n_broken;

static void check(bool holds, const precision_part *part, const char *words, double value)
{
    if (holds)
        return;
    n_broken++;
    fprintf(stderr, "bench: %s: %s: %g\n", part->name, words, value);
}

static void check_known(const precision_part *part, double value, double error)
{
    for (size_t i = 0; i < PRECISION_KNOWN; i++)
        if (part->known[i].value > 0 && !(fabs(part->known[i].value - value) > 0))
            check(fabs(error / part->known[i].error - 1) < 1e-8, part,
                  "the error of the textbook method is not the known one", error);
}

static void sweep_setting(const precision_part *part, const measured_method *m, void *problem,
                          double reference, table_writer *t)
{
    const bool is_textbook = strcmp(m->name, "textbook") == 0;
    double best = 1;
    for (size_t i = 0; i < PRECISION_VALUES && m->values[i] > 0; i++) {
        timed_solution s = {m->solve, problem, m->values[i]};
        const double seconds = bench_time(solve_once, &s);
        precision_errors e = part->errors_of_solution(problem);
        e.true_error = fmax(e.true_error, reference);
        best = fmin(best, e.true_error);
        TABLE_ADD(work_precision, t, part->name, m->name, m->setting, part->words, m->values[i],
                  reference, e, (timing){seconds, (double)NAN, BENCH_RUNS});
        if (is_textbook)
            check_known(part, m->values[i], e.true_error);
        else if (part->is_bound)
            check(e.true_error <= e.stated_error + reference, part,
                  "the error is larger than stated at", m->values[i]);
    }
    if (part->is_bound)
        check(best < (is_textbook ? worst_textbook : worst_best), part,
              "the smallest error is too large", best);
}

static void run_part(const precision_part *part, table_writer *t)
{
    wt_error err = WT_ERROR_INIT;
    double reference = (double)NAN;
    void *problem = calloc(1, part->size);
    bench_check(problem != NULL ? WT_OK : WT_E_MEMORY, NULL);
    bench_check(part->begin(problem, &reference, &err), &err);
    reference = fmax(reference, least_reference);
    if (part->is_bound)
        check(reference < worst_reference, part, "the error of the reference is too large",
              reference);
    for (const measured_method *m = part->methods; m->name != NULL; m++)
        sweep_setting(part, m, problem, reference, t);
    part->end(problem);
    free(problem);
}

int bench_precision(const char *name)
{
    wt_error err = WT_ERROR_INIT;
    wt_table *table = NULL;
    table_writer t = table_begin(&work_precision_schema, &err);
    for (size_t l = 0; l < COUNT_OF(lists); l++)
        for (const precision_part *p = lists[l]; p->name != NULL; p++)
            if (name == NULL || strcmp(name, p->name) == 0)
                run_part(p, &t);
    bench_check(table_end(&t, &table), &err);
    bench_check(wt_table_n_rows(table) > 0 ? WT_OK : WT_E_NOT_FOUND, &err);
    bench_check(wt_stream_write(stdout, table, NULL, &err), &err);
    wt_table_free(table);
    return n_broken;
}
