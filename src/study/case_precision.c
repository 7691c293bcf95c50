/* Error against run time of the numbers of a case: numerical error as the tolerance is swept, with
 * the textbook method; standard error against the number of replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"
#include "friction/numerics/angular.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "study/case_override.h"
#include "study/textbook_methods.h"
#include "weartrack/study.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

wt_accuracy_job wt_accuracy_job_defaults(void)
{
    return (wt_accuracy_job){.repeats = 9};
}

static const wt_param rows[] = {
    {PARAM("repeats", wt_accuracy_job, repeats, WT_Q_NONE, FROM_TO(1, 1000)), .value = "N",
     .help = "how often each point is timed"},
};
PARAM_TABLE(wt_accuracy_job_params, wt_accuracy_job, rows, wt_accuracy_job_defaults, NO_PARTS)

/* Largest relative error of a number, and the error that it states; NaN if none. */
typedef struct accuracy_errors {
    double true_error, stated_error;
} accuracy_errors;

typedef struct accuracy_timing {
    double median, spread; /* [s] */
    size_t repeats;
} accuracy_timing;

TABLE_ROW(work_precision, WORK_PRECISION, const char *part, *method, *setting, *words;
          double value, reference_error; accuracy_errors errors; accuracy_timing time;)

enum { ACCURACY_VALUES = 8 }; /* capacity of a sweep */

typedef enum precision_sweep {
    BY_TOLERANCE,
    BY_WAVENUMBERS,
    BY_REPLICATES,
    SWEEPS
} precision_sweep;

/* Number of sets of replicates for the standard error, and size of the reference set. */
enum { SETS = 4, REFERENCE_SET = 2400, MOST_REPLICATES = 400 };
enum { ALL_DRAWS = REFERENCE_SET + SETS * MOST_REPLICATES };
/* Tolerance of the reference. */
static const double tightest = 1e-13;

static const struct {
    const char *before, *after; /* text before and after the name of the number */
    const char *method, *case_variant, *words;
    double values[ACCURACY_VALUES]; /* ends with 0 */
} sweeps[SWEEPS] = {
    [BY_TOLERANCE] = {"",
                      " by tolerance",
                      "weartrack",
                      "1 / tolerance",
                      "The number of the case, without replicates; reference: the tolerance 1e-13",
                      {1e2, 1e4, 1e6, 1e8, 1e10, 1e12}},
    [BY_WAVENUMBERS] = {"",
                        " by tolerance",
                        "textbook",
                        "wavenumbers",
                        "The same by the trapezoidal rule, with the closed form over the angle if "
                        "the material has one",
                        {30, 100, 300, 1000, 3000}},
    [BY_REPLICATES] = {"error of ",
                       " by replicates",
                       "weartrack",
                       "replicates",
                       "The standard error of the number, rms of 4 sets of replicates; reference: "
                       "2400 others",
                       {25, 50, 100, 200, MOST_REPLICATES}},
};

typedef struct sweep_point {
    double value; /* of the setting; 0 if not computed */
    accuracy_errors errors;
    accuracy_timing time;
} sweep_point;

typedef struct precision_problem {
    const case_variant *given;
    const wt_job *job_settings;
    case_variant current; /* inputs of the current computation */
    wt_job work;          /* options of the current computation */
    size_t repeats;
    bool timed;
    unsigned first, last; /* numbers that are computed now */
    wt_estimate number[CASE_QUANTITIES];
    sliding_contact contact;   /* for the textbook method */
    wt_rubber extended_rubber; /* the material with ALL_DRAWS draws, if it was fitted */
    const wt_rubber *drawn;    /* the same, or as stated */
    sweep_point cells[CASE_QUANTITIES][SWEEPS][ACCURACY_VALUES];
    double reference_error[CASE_QUANTITIES][SWEEPS];
    double standard_error[CASE_QUANTITIES]; /* relative, with the most replicates */
} precision_problem;

/* Solves the problem at a value of the setting; this call is timed. */
typedef wt_status accuracy_solve(precision_problem *o, double value, wt_error *err);

/* Shortest measured time [s]. A clock with a resolution of 1 us then has an error of 0.5 %. */
#define MIN_SECONDS 2e-4
/* Longest total time [s]. A slow method is repeated less often. */
#define MAX_SECONDS 0.2

static wt_status time_repeats(precision_problem *o, accuracy_solve *solve, double value,
                              accuracy_timing *t, wt_error *err)
{
    double *const seconds = wt_alloc(o->repeats, sizeof *seconds);
    double sum = 0;
    wt_status status = WT_OK;
    size_t n = 0;
    for (; status == WT_OK && n < o->repeats && sum < MAX_SECONDS; n++) {
        const double start = wt_time_cpu();
        double solved = 0, all = 0;
        while (status == WT_OK && all < MIN_SECONDS) {
            status = solve(o, value, err);
            solved++;
            all = wt_time_cpu() - start;
        }
        seconds[n] = all / solved;
        sum += seconds[n];
    }
    if (status == WT_OK) {
        numbers_sort(seconds, n);
        *t = (accuracy_timing){
            seconds[n / 2], n > 2 ? (seconds[(3 * n) / 4] - seconds[n / 4]) / 2 : (double)NAN, n};
    }
    free(seconds);
    return status;
}

/* Solves once, or repeatedly if it is timed. */
static wt_status solve_and_time(precision_problem *o, accuracy_solve *solve, double value,
                                accuracy_timing *time, wt_error *err)
{
    *time = (accuracy_timing){(double)NAN, (double)NAN, 1};
    return o->timed ? time_repeats(o, solve, value, time, err) : solve(o, value, err);
}

/* Skips a number that is unknown. */
static void set_cell(precision_problem *o, unsigned k, precision_sweep by, size_t i, sweep_point c)
{
    if (isfinite(c.errors.true_error))
        o->cells[k][by][i] = c;
}

static void set_cells(precision_problem *o, precision_sweep by, size_t i, double value,
                      const wt_estimate *reference, accuracy_timing time)
{
    for (unsigned k = o->first; k < o->last; k++) {
        const wt_estimate e = o->number[k];
        const double off = fabs(e.value - reference[k].value); /* two zeros differ by 0 */
        set_cell(o, k, by, i,
                 (sweep_point){value,
                               {off > 0 ? off / fabs(reference[k].value) : off,
                                e.numerical_error / fabs(e.value)},
                               time});
    }
}

/* Resets the inputs to those of the case without the parts that are not computed. */
static void begin_sweep(precision_problem *o)
{
    const case_variant *full = o->given;
    o->current = *full;
    o->current.has_layer = o->first > 0 && full->has_layer;
    o->current.has_known = o->first > 0 && full->has_known;
    o->work = *o->job_settings;
    o->work.progress = (wt_progress){0};
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        o->number[k] = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
}

/* ---- tolerance ------------------------------------------------------------------------------- */

static wt_status solve_tolerance(precision_problem *o, double value, wt_error *err)
{
    o->work.tolerance = 1 / value;
    o->work.replicates = 0;
    return case_variant_compute(&o->current, &o->work, o->number, err);
}

static wt_status solve_case_textbook(precision_problem *o, double value, wt_error *err)
{
    enum { LEAST_ANGLES = 20 }; /* a usual number for a textbook rule */
    const sliding_contact *c = &o->contact;
    const size_t n = (size_t)value, angles = n / 20 * 2;
    const double none = (double)NAN;
    textbook_friction found;
    const wt_status status =
        textbook_friction_compute(c->material, c->roughness, c->pressure, o->current.velocity, n,
                                  angles > LEAST_ANGLES ? angles : LEAST_ANGLES, &found);
    if (status != WT_OK)
        return wt_fail(err, status, "the textbook method failed");
    o->number[CASE_QUANTITY_HYSTERESIS] = (wt_estimate){found.hysteresis, none, none, "1"};
    o->number[CASE_QUANTITY_AREA_RATIO] = (wt_estimate){found.area_ratio, none, none, "1"};
    o->number[CASE_QUANTITY_FRICTION] =
        wt_friction_total(o->number[CASE_QUANTITY_HYSTERESIS], o->number[CASE_QUANTITY_AREA_RATIO],
                          (wt_estimate){c->shear_stress, none, none, "Pa"}, c->pressure);
    return WT_OK;
}

static wt_status sweep_values(precision_problem *o, precision_sweep by, accuracy_solve *one,
                              const wt_estimate *reference, wt_error *err)
{
    wt_status status = WT_OK;
    accuracy_timing time;
    for (size_t i = 0; i < ACCURACY_VALUES && sweeps[by].values[i] > 0 && status == WT_OK; i++) {
        status = solve_and_time(o, one, sweeps[by].values[i], &time, err);
        if (status == WT_OK)
            set_cells(o, by, i, sweeps[by].values[i], reference, time);
    }
    return status;
}

static wt_status sweep_tolerance(precision_problem *o, wt_error *err)
{
    wt_estimate reference[CASE_QUANTITIES];
    begin_sweep(o);
    wt_status status = solve_tolerance(o, 1 / tightest, err);
    memcpy(reference, o->number, sizeof reference);
    for (unsigned k = o->first; k < o->last; k++)
        o->reference_error[k][BY_TOLERANCE] = o->reference_error[k][BY_WAVENUMBERS] =
            reference[k].numerical_error / fabs(reference[k].value);
    if (status == WT_OK)
        status = sweep_values(o, BY_TOLERANCE, solve_tolerance, reference, err);
    /* the textbook method has no softening, gamma or layer */
    if (status != WT_OK || o->first > 0 || o->current.has_softness || o->current.sliding.gamma < 1)
        return status;
    const wt_layer_state none = {.thickness = 0, .modulus_ratio = 1};
    status = sliding_contact_create(&o->current.sliding, &o->work, WT_NO_REPLICATE, NULL, none,
                                    &o->contact, err);
    if (status == WT_OK)
        status = sweep_values(o, BY_WAVENUMBERS, solve_case_textbook, reference, err);
    sliding_contact_clear(&o->contact);
    return status;
}

/* ---- replicates ------------------------------------------------------------------------------ */

static wt_status solve_replicates(precision_problem *o, double value, wt_error *err)
{
    o->work.replicates = (size_t)value;
    return case_variant_compute(&o->current, &o->work, o->number, err);
}

/* Selects draws of the material that no other set has, if enough exist, and a separate seed for the
 * other inputs. Set 0 is the reference. */
static void select_draw_set(precision_problem *o, size_t set, size_t n)
{
    const size_t first = set > 0 ? REFERENCE_SET + (set - 1) * n : 0;
    o->work.seed = o->job_settings->seed + set;
    o->current.rubber = *o->drawn;
    o->current.given = NULL;
    if (o->drawn->n_draws >= first + n) {
        o->current.rubber.draws = o->drawn->draws + first;
        o->current.rubber.n_draws = n;
    }
}

/* Relative error of the standard deviation of n draws of a normal number. */
static double draw_count_error(double n)
{
    return 1 / sqrt(2 * (n - 1));
}

/* rms: [CASE_QUANTITIES] error of the standard error of n replicates, over the sets. */
static wt_status replicate_set_error(precision_problem *o, size_t n, const wt_estimate *reference,
                                     double *rms, wt_error *err)
{
    double squares[CASE_QUANTITIES] = {0};
    wt_status status = WT_OK;
    for (size_t set = 1; set <= SETS && status == WT_OK; set++) {
        select_draw_set(o, set, n);
        status = solve_replicates(o, (double)n, err);
        for (unsigned k = o->first; k < o->last; k++) {
            const double off = o->number[k].standard_error / reference[k].standard_error - 1;
            squares[k] += off * off / SETS;
        }
    }
    for (unsigned k = o->first; k < o->last; k++)
        rms[k] = sqrt(squares[k]);
    return status;
}

static wt_status sweep_replicates(precision_problem *o, wt_error *err)
{
    wt_estimate reference[CASE_QUANTITIES];
    double rms[CASE_QUANTITIES];
    accuracy_timing time;
    const double drawn = (double)o->drawn->n_draws;
    begin_sweep(o);
    select_draw_set(o, 0, REFERENCE_SET);
    wt_status status = solve_replicates(o, REFERENCE_SET, err);
    memcpy(reference, o->number, sizeof reference);
    for (unsigned k = o->first; k < o->last; k++) {
        o->standard_error[k] = reference[k].standard_error / fabs(reference[k].value);
        o->reference_error[k][BY_REPLICATES] =
            draw_count_error(drawn > 0 ? fmin(drawn, REFERENCE_SET) : REFERENCE_SET);
    }
    for (size_t i = 0; sweeps[BY_REPLICATES].values[i] > 0 && status == WT_OK; i++) {
        const double n = sweeps[BY_REPLICATES].values[i];
        status = replicate_set_error(o, (size_t)n, reference, rms, err);
        if (status == WT_OK)
            status = solve_and_time(o, solve_replicates, n, &time, err);
        for (unsigned k = o->first; k < o->last && status == WT_OK; k++)
            set_cell(o, k, BY_REPLICATES, i, (sweep_point){n, {rms[k], draw_count_error(n)}, time});
    }
    return status;
}

/* ---- job ------------------------------------------------------------------------------------- */

/* Sweeps the numbers of friction, or those that the layer adds. */
static wt_status sweep_numbers(precision_problem *o, unsigned first, unsigned last, wt_error *err)
{
    o->first = first;
    o->last = last;
    const wt_progress *p = &o->job_settings->progress;
    if (p->report != NULL && !p->report(p->user, "error against run time", 0, 0))
        return wt_fail(err, WT_E_CANCELLED, "cancelled");
    wt_status status = sweep_tolerance(o, err);
    if (status == WT_OK)
        status = sweep_replicates(o, err);
    return status;
}

static wt_status prepare_draws(precision_problem *o, wt_error *err)
{
    const wt_rubber *own = &o->given->rubber;
    wt_master fit = {0};
    o->drawn = own;
    if (own->kind != WT_RUBBER_SERIES || own->sweep.n_isotherms == 0)
        return WT_OK;
    const wt_status status = flow_rubber_fit(&own->sweep, &own->fit, own->poisson_ratio, ALL_DRAWS,
                                             o->job_settings, &fit, &o->extended_rubber, err);
    o->extended_rubber.is_transverse = own->is_transverse;
    o->extended_rubber.transverse = own->transverse;
    o->drawn = &o->extended_rubber;
    wt_master_clear(&fit);
    return status;
}

/* A reference in double precision is not more accurate than this. */
static const double least_reference = DBL_EPSILON / 2;

/* A true error below that of the reference is replaced by the latter. */
static void add_precision_rows(const precision_problem *o, table_writer *t)
{
    char part[96];
    for (unsigned k = 0; k < CASE_QUANTITIES; k++)
        for (unsigned by = 0; by < SWEEPS; by++)
            for (size_t i = 0; i < ACCURACY_VALUES; i++) {
                const sweep_point *c = &o->cells[k][by][i];
                if (!(c->value > 0))
                    continue;
                snprintf(part, sizeof part, "%s%s%s", sweeps[by].before, case_quantity_names[k],
                         sweeps[by].after);
                const double reference = fmax(o->reference_error[k][by], least_reference);
                const accuracy_errors errors = {fmax(c->errors.true_error, reference),
                                                c->errors.stated_error};
                TABLE_ADD(work_precision, t, part, sweeps[by].method, sweeps[by].case_variant,
                          sweeps[by].words, c->value, reference, errors, c->time);
            }
}

/* Indices of the values that the summary line reports. */
enum { LOOSE = 0, TIGHT = 4, USUAL_REPLICATES = 3 };

/* Returns " in 37 us", or an empty text without a time. */
static const char *format_time(const sweep_point *c, char text[48])
{
    char time[32];
    text[0] = '\0';
    if (c->time.median > 0) {
        wt_format_si(c->time.median, "s", 2, time, sizeof time);
        snprintf(text, 48, " in %s", time);
    }
    return text;
}

/* Writes the summary line about the main number of the case: the last known one except the
 * thickness. */
static void write_precision_summary(const precision_problem *o, table_writer *t)
{
    static const case_quantity about[] = {CASE_QUANTITY_WITH_LAYER, CASE_QUANTITY_FRICTION,
                                          CASE_QUANTITY_HYSTERESIS};
    char text[640] = "", first[48], second[48];
    size_t i = 0;
    while (i + 1 < COUNT_OF(about) && !(o->cells[about[i]][BY_TOLERANCE][LOOSE].value > 0))
        i++;
    const case_quantity k = about[i];
    const sweep_point *loose = &o->cells[k][BY_TOLERANCE][LOOSE],
                      *tight = &o->cells[k][BY_TOLERANCE][TIGHT],
                      *drawn = &o->cells[k][BY_REPLICATES][USUAL_REPLICATES];
    if (!(loose->value > 0 && tight->value > 0))
        return;
    clocale_append(
        text, sizeof text,
        "%s: the arithmetic states an error of %.1g%s at a tolerance of %g and of %.1g%s at %g",
        case_quantity_names[k], loose->errors.stated_error, format_time(loose, first),
        1 / loose->value, tight->errors.stated_error, format_time(tight, second), 1 / tight->value);
    if (o->standard_error[k] > 0)
        clocale_append(text, sizeof text, "; the standard error is %s",
                       format_percent(o->standard_error[k]).text);
    if (drawn->value > 0)
        clocale_append(text, sizeof text, ", which %.0f replicates determine to %.1g %%%s",
                       drawn->value, 100 * drawn->errors.stated_error, format_time(drawn, first));
    work_precision_set_text(t, WORK_PRECISION_KEY_ANSWER, text);
}

wt_status wt_case_precision_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                    const wt_layer_observation *observation,
                                    const wt_accuracy_job *job, const wt_job *work,
                                    wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no numbers to time");
    case_variant given;
    wt_job job_settings = *work;
    job_settings.threads = 1; /* the processor time of a single thread is measured */
    job_settings.left_out = WT_EXTRA_ALL & ~(unsigned)WT_EXTRA_DRAWS;
    job_settings.drawn = NULL; /* the stored draws are for another material */
    job_settings.log = NULL;   /* warnings about these numbers exist already */
    job_settings.cost = NULL;  /* the number of computations depends on the clock */
    wt_status status = param_check(wt_accuracy_job_params(), job, err);
    if (status == WT_OK)
        status = case_variant_create(sliding, layer, observation, work, &given, err);
    if (status != WT_OK)
        return status;
    precision_problem *o = wt_alloc(1, sizeof *o);
    *o = (precision_problem){.given = &given,
                             .job_settings = &job_settings,
                             .repeats = job->repeats,
                             .timed = !isnan(cost_clock(work->cost))};
    status = prepare_draws(o, err);
    if (status == WT_OK)
        status = sweep_numbers(o, 0, CASE_QUANTITY_THICKNESS, err);
    if (status == WT_OK && (given.has_layer || given.has_known))
        status = sweep_numbers(o, CASE_QUANTITY_THICKNESS, CASE_QUANTITIES, err);
    table_writer t = table_begin(&work_precision_schema, err);
    if (status == WT_OK) {
        add_precision_rows(o, &t);
        write_precision_summary(o, &t);
    }
    if (status != WT_OK)
        t.status = status;
    status = table_end(&t, table);
    if (status == WT_OK)
        cost_report(work, (cost_summary){.items = (double)wt_table_n_rows(*table)});
    wt_rubber_clear(&o->extended_rubber);
    free(o);
    return status;
}
