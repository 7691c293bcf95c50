/* Error against run time of the numbers of a case: numerical error as the tolerance is swept, with
 * the textbook method; standard error against the number of replicates; values with fewer
 * isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"
#include "friction/numerics/angular_weight.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "study/accuracy.h"
#include "study/parametric_bootstrap.h"
#include "study/textbook_methods.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/param.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum swept { BY_TOLERANCE, BY_WAVENUMBERS, BY_REPLICATES, BY_ISOTHERMS, SWEEPS } swept;

/* Number of sets of replicates for the standard error, and size of the reference set. */
enum { SETS = 4, REFERENCE_SET = 2400, MOST_REPLICATES = 400 };
enum { ALL_DRAWS = REFERENCE_SET + SETS * MOST_REPLICATES };
/* Tolerance of the reference. */
static const double tightest = 1e-13;
/* Fewest isotherms for shifts, a law and its lack of fit. */
enum { LEAST_ISOTHERMS = 4 };

static const struct {
    const char *before, *after; /* text before and after the name of the number */
    const char *method, *setting, *words;
    double values[ACCURACY_VALUES]; /* for isotherms: fractions of their number; ends with 0 */
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
    [BY_ISOTHERMS] = {"",
                      " by isotherms",
                      "weartrack",
                      "isotherms",
                      "The number with so many of the isotherms fitted again; stated: the standard "
                      "error that the material gives it; reference: all isotherms",
                      {0.25, 1 / 3., 0.5, 0.75, 1}},
};

typedef struct cell {
    double value; /* of the setting; 0 if not computed */
    accuracy_errors errors;
    accuracy_timing time;
} cell;

typedef struct own_case {
    const setting *given;
    const wt_job *asked;
    setting now; /* inputs of the current computation */
    wt_job work; /* options of the current computation */
    size_t repeats;
    bool timed;
    unsigned first, last; /* numbers that are computed now */
    wt_estimate number[SETTING_NUMBERS];
    sliding_contact contact; /* for the textbook method */
    wt_rubber more;          /* the material with ALL_DRAWS draws, if it was fitted */
    const wt_rubber *drawn;  /* the same, or as stated */
    size_t n_isotherms;      /* number of isotherms to be fitted */
    cell cells[SETTING_NUMBERS][SWEEPS][ACCURACY_VALUES];
    double reference_error[SETTING_NUMBERS][SWEEPS];
    double standard_error[SETTING_NUMBERS]; /* relative, with the most replicates */
} own_case;

/* Solves once, or repeatedly if it is timed. */
static wt_status solve(own_case *o, accuracy_solve *one, double value, accuracy_timing *time,
                       wt_error *err)
{
    *time = (accuracy_timing){(double)NAN, (double)NAN, 1};
    return o->timed ? accuracy_time(one, o, value, o->repeats, time, err) : one(o, value, err);
}

/* Skips a number that is unknown. */
static void put_cell(own_case *o, unsigned k, swept by, size_t i, cell c)
{
    if (isfinite(c.errors.true_error))
        o->cells[k][by][i] = c;
}

static void put_cells(own_case *o, swept by, size_t i, double value, const wt_estimate *reference,
                      accuracy_timing time)
{
    for (unsigned k = o->first; k < o->last; k++) {
        const wt_estimate e = o->number[k];
        const double stated = by == BY_ISOTHERMS ? e.standard_error : e.numerical_error;
        put_cell(o, k, by, i,
                 (cell){value,
                        {accuracy_relative(e.value, reference[k].value), stated / fabs(e.value)},
                        time});
    }
}

/* Resets the inputs to those of the case without the parts that are not computed. */
static void begin_sweep(own_case *o)
{
    const setting *full = o->given;
    o->now = *full;
    o->now.has_layer = o->first > 0 && full->has_layer;
    o->now.has_known = o->first > 0 && full->has_known;
    o->work = *o->asked;
    o->work.progress = (wt_progress){0};
    for (size_t k = 0; k < SETTING_NUMBERS; k++)
        o->number[k] = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
}

/* ---- tolerance ------------------------------------------------------------------------------- */

static wt_status solve_tolerance(void *problem, double value, wt_error *err)
{
    own_case *o = problem;
    o->work.tolerance = 1 / value;
    o->work.replicates = 0;
    return setting_compute(&o->now, &o->work, o->number, err);
}

static wt_status solve_textbook(void *problem, double value, wt_error *err)
{
    enum { LEAST_ANGLES = 20 }; /* a usual number for a textbook rule */
    own_case *o = problem;
    const sliding_contact *c = &o->contact;
    const size_t n = (size_t)value, angles = n / 20 * 2;
    const double none = (double)NAN;
    textbook_friction found;
    const wt_status status =
        friction_textbook(c->material, c->roughness, c->pressure, o->now.velocity, n,
                          angles > LEAST_ANGLES ? angles : LEAST_ANGLES, &found);
    if (status != WT_OK)
        return wt_fail(err, status, "the textbook method failed");
    o->number[SETTING_HYSTERESIS] = (wt_estimate){found.hysteresis, none, none, "1"};
    o->number[SETTING_AREA_RATIO] = (wt_estimate){found.area_ratio, none, none, "1"};
    o->number[SETTING_FRICTION] =
        wt_friction_total(o->number[SETTING_HYSTERESIS], o->number[SETTING_AREA_RATIO],
                          (wt_estimate){c->shear_stress, none, none, "Pa"}, c->pressure);
    return WT_OK;
}

static wt_status sweep_values(own_case *o, swept by, accuracy_solve *one,
                              const wt_estimate *reference, wt_error *err)
{
    wt_status status = WT_OK;
    accuracy_timing time;
    for (size_t i = 0; i < ACCURACY_VALUES && sweeps[by].values[i] > 0 && status == WT_OK; i++) {
        status = solve(o, one, sweeps[by].values[i], &time, err);
        if (status == WT_OK)
            put_cells(o, by, i, sweeps[by].values[i], reference, time);
    }
    return status;
}

static wt_status sweep_tolerance(own_case *o, wt_error *err)
{
    wt_estimate reference[SETTING_NUMBERS];
    begin_sweep(o);
    wt_status status = solve_tolerance(o, 1 / tightest, err);
    memcpy(reference, o->number, sizeof reference);
    for (unsigned k = o->first; k < o->last; k++)
        o->reference_error[k][BY_TOLERANCE] = o->reference_error[k][BY_WAVENUMBERS] =
            reference[k].numerical_error / fabs(reference[k].value);
    if (status == WT_OK)
        status = sweep_values(o, BY_TOLERANCE, solve_tolerance, reference, err);
    /* the textbook method has no softening, anisotropy, gamma or layer */
    if (status != WT_OK || o->first > 0 || o->now.has_softness || o->now.sliding.gamma < 1 ||
        anisotropy_is_any(&o->now.sliding.anisotropy))
        return status;
    const wt_layer_state none = {.thickness = 0, .modulus_ratio = 1};
    status = sliding_contact_make(&o->now.sliding, &o->work, WT_NO_REPLICATE, NULL, none,
                                  &o->contact, err);
    if (status == WT_OK)
        status = sweep_values(o, BY_WAVENUMBERS, solve_textbook, reference, err);
    sliding_contact_clear(&o->contact);
    return status;
}

/* ---- replicates ------------------------------------------------------------------------------ */

static wt_status solve_replicates(void *problem, double value, wt_error *err)
{
    own_case *o = problem;
    o->work.replicates = (size_t)value;
    return setting_compute(&o->now, &o->work, o->number, err);
}

/* Selects draws of the material that no other set has, if enough exist, and a separate seed for the
 * other inputs. Set 0 is the reference. */
static void take_set(own_case *o, size_t set, size_t n)
{
    const size_t first = set > 0 ? REFERENCE_SET + (set - 1) * n : 0;
    o->work.seed = o->asked->seed + set;
    o->now.rubber = *o->drawn;
    o->now.given = NULL;
    if (o->drawn->n_draws >= first + n) {
        o->now.rubber.draws = o->drawn->draws + first;
        o->now.rubber.n_draws = n;
    }
}

/* Relative error of the standard deviation of n draws of a normal number. */
static double error_of_draws(double n)
{
    return 1 / sqrt(2 * (n - 1));
}

/* rms: [SETTING_NUMBERS] error of the standard error of n replicates, over the sets. */
static wt_status spread_of_sets(own_case *o, size_t n, const wt_estimate *reference, double *rms,
                                wt_error *err)
{
    double squares[SETTING_NUMBERS] = {0};
    wt_status status = WT_OK;
    for (size_t set = 1; set <= SETS && status == WT_OK; set++) {
        take_set(o, set, n);
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

static wt_status sweep_replicates(own_case *o, wt_error *err)
{
    wt_estimate reference[SETTING_NUMBERS];
    double rms[SETTING_NUMBERS];
    accuracy_timing time;
    const double drawn = (double)o->drawn->n_draws;
    begin_sweep(o);
    take_set(o, 0, REFERENCE_SET);
    wt_status status = solve_replicates(o, REFERENCE_SET, err);
    memcpy(reference, o->number, sizeof reference);
    for (unsigned k = o->first; k < o->last; k++) {
        o->standard_error[k] = reference[k].standard_error / fabs(reference[k].value);
        o->reference_error[k][BY_REPLICATES] =
            error_of_draws(drawn > 0 ? fmin(drawn, REFERENCE_SET) : REFERENCE_SET);
    }
    for (size_t i = 0; sweeps[BY_REPLICATES].values[i] > 0 && status == WT_OK; i++) {
        const double n = sweeps[BY_REPLICATES].values[i];
        status = spread_of_sets(o, (size_t)n, reference, rms, err);
        if (status == WT_OK)
            status = solve(o, solve_replicates, n, &time, err);
        for (unsigned k = o->first; k < o->last && status == WT_OK; k++)
            put_cell(o, k, BY_REPLICATES, i, (cell){n, {rms[k], error_of_draws(n)}, time});
    }
    return status;
}

/* ---- isotherms ------------------------------------------------------------------------------- */

/* Selects n isotherms at even spacing, with the reference isotherm. The arrays stay owned by the
 * sweep. */
static void take_isotherms(const wt_sweep *all, size_t n, double reference, wt_isotherm *taken)
{
    size_t near = 0;
    for (size_t i = 1; i < all->n_isotherms; i++)
        if (fabs(all->isotherms[i].temperature - reference) <
            fabs(all->isotherms[near].temperature - reference))
            near = i;
    for (size_t i = 0; i < n; i++) {
        const size_t from = i * all->n_isotherms / n, to = (i + 1) * all->n_isotherms / n;
        taken[i] = all->isotherms[near >= from && near < to ? near : (from + to - 1) / 2];
    }
}

static wt_status solve_isotherms(void *problem, double value, wt_error *err)
{
    own_case *o = problem;
    const wt_rubber *own = &o->given->rubber;
    const size_t n = (size_t)value;
    wt_sweep part = {.deformation = own->sweep.deformation, .n_isotherms = n};
    wt_master_options options = own->fit;
    wt_master fit = {0};
    wt_rubber rubber = {0};
    part.isotherms = malloc(n * sizeof *part.isotherms);
    if (part.isotherms == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    options.reference_temperature = own->prony.reference_temperature;
    take_isotherms(&own->sweep, n, options.reference_temperature, part.isotherms);
    wt_status status = flow_rubber_fit(&part, &options, own->poisson_ratio, FLOW_STORED_DRAWS,
                                       &o->work, &fit, &rubber, err);
    if (status == WT_OK) {
        rubber.is_transverse = own->is_transverse;
        rubber.transverse = own->transverse;
        o->now.rubber = rubber;
        o->now.given = NULL;
        status = setting_compute(&o->now, &o->work, o->number, err);
    }
    wt_rubber_clear(&rubber);
    wt_master_clear(&fit);
    free(part.isotherms);
    return status;
}

/* Too few isotherms may not determine a shift law that reaches the sliding temperature. They are
 * skipped. */
static wt_status sweep_isotherms(own_case *o, wt_error *err)
{
    const double *shares = sweeps[BY_ISOTHERMS].values, all = (double)o->n_isotherms;
    wt_estimate reference[SETTING_NUMBERS];
    accuracy_timing time;
    double before = LEAST_ISOTHERMS - 1;
    begin_sweep(o);
    bootstrap_fix_inputs(&o->now);
    wt_status status = solve_isotherms(o, all, NULL);
    if (status != WT_OK)
        return status == WT_E_MEMORY ? wt_fail(err, status, "out of memory") : WT_OK;
    memcpy(reference, o->number, sizeof reference);
    for (unsigned k = o->first; k < o->last; k++)
        o->reference_error[k][BY_ISOTHERMS] =
            reference[k].standard_error / fabs(reference[k].value);
    for (size_t i = 0; shares[i] > 0 && status == WT_OK; i++) {
        const double n = round(shares[i] * all);
        if (!(n > before))
            continue;
        before = n;
        const wt_status of_some = solve(o, solve_isotherms, n, &time, NULL);
        if (of_some == WT_OK)
            put_cells(o, BY_ISOTHERMS, i, n, reference, time);
        else if (of_some == WT_E_MEMORY)
            status = wt_fail(err, of_some, "out of memory");
    }
    return status;
}

/* ---- job ------------------------------------------------------------------------------------- */

static wt_status text_append(const own_case *o, const char *what, wt_error *err)
{
    const wt_progress *p = &o->asked->progress;
    if (p->report != NULL && !p->report(p->user, what, 0, 0))
        return wt_fail(err, WT_E_CANCELLED, "cancelled");
    return WT_OK;
}

/* Sweeps the numbers of friction, or those that the layer adds. */
static wt_status sweep_numbers(own_case *o, unsigned first, unsigned last, wt_error *err)
{
    o->first = first;
    o->last = last;
    wt_status status = text_append(o, "error against run time", err);
    if (status == WT_OK)
        status = sweep_tolerance(o, err);
    if (status == WT_OK)
        status = sweep_replicates(o, err);
    if (status == WT_OK && o->n_isotherms > LEAST_ISOTHERMS)
        status = sweep_isotherms(o, err);
    return status;
}

static wt_status make_draws(own_case *o, wt_error *err)
{
    const wt_rubber *own = &o->given->rubber;
    wt_master fit = {0};
    o->drawn = own;
    o->n_isotherms = own->kind == WT_RUBBER_SERIES ? own->sweep.n_isotherms : 0;
    if (o->n_isotherms == 0)
        return WT_OK;
    const wt_status status = flow_rubber_fit(&own->sweep, &own->fit, own->poisson_ratio, ALL_DRAWS,
                                             o->asked, &fit, &o->more, err);
    o->more.is_transverse = own->is_transverse;
    o->more.transverse = own->transverse;
    o->drawn = &o->more;
    wt_master_clear(&fit);
    return status;
}

static void put_rows(const own_case *o, table_writer *t)
{
    char part[96];
    for (unsigned k = 0; k < SETTING_NUMBERS; k++)
        for (unsigned by = 0; by < SWEEPS; by++)
            for (size_t i = 0; i < ACCURACY_VALUES; i++) {
                const cell *c = &o->cells[k][by][i];
                if (!(c->value > 0))
                    continue;
                snprintf(part, sizeof part, "%s%s%s", sweeps[by].before, setting_words[k],
                         sweeps[by].after);
                accuracy_put(t, (accuracy_row){part, sweeps[by].method, sweeps[by].setting,
                                               sweeps[by].words, c->value,
                                               o->reference_error[k][by], c->errors, c->time});
            }
}

/* Indices of the values that the summary line reports. */
enum { LOOSE = 0, TIGHT = 4, USUAL_REPLICATES = 3, HALF_THE_ISOTHERMS = 2 };

/* Returns " in 37 us", or an empty text without a time. */
static const char *in_time(const cell *c, char text[48])
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
static void put_answer(const own_case *o, table_writer *t)
{
    static const setting_number about[] = {SETTING_WITH_LAYER, SETTING_FRICTION,
                                           SETTING_HYSTERESIS};
    char text[640], first[48], second[48];
    size_t i = 0, n = 0;
    while (i + 1 < COUNT_OF(about) && !(o->cells[about[i]][BY_TOLERANCE][LOOSE].value > 0))
        i++;
    const setting_number k = about[i];
    const cell *loose = &o->cells[k][BY_TOLERANCE][LOOSE],
               *tight = &o->cells[k][BY_TOLERANCE][TIGHT],
               *drawn = &o->cells[k][BY_REPLICATES][USUAL_REPLICATES],
               *half = &o->cells[k][BY_ISOTHERMS][HALF_THE_ISOTHERMS];
    if (!(loose->value > 0 && tight->value > 0))
        return;
#define SAY(...)                                                                                   \
    n += n < sizeof text ? (size_t)clocale_print(text + n, sizeof text - n, __VA_ARGS__) : 0
    SAY("%s: the arithmetic states an error of %.1g%s at a tolerance of %g and of %.1g%s at %g",
        setting_words[k], loose->errors.stated_error, in_time(loose, first), 1 / loose->value,
        tight->errors.stated_error, in_time(tight, second), 1 / tight->value);
    if (o->standard_error[k] > 0)
        SAY("; the standard error is %.2g %%", 100 * o->standard_error[k]);
    if (drawn->value > 0)
        SAY(", which %.0f replicates tell to %.1g %%%s", drawn->value,
            100 * drawn->errors.stated_error, in_time(drawn, first));
    if (half->value > 0)
        SAY("; %.0f of %zu isotherms are within %.2g %% of all of them, with a standard error by "
            "the material of %.2g %% instead of %.2g %%",
            half->value, o->n_isotherms,
            100 * fmax(half->errors.true_error, o->reference_error[k][BY_ISOTHERMS]),
            100 * half->errors.stated_error, 100 * o->reference_error[k][BY_ISOTHERMS]);
#undef SAY
    work_precision_set_text(t, WORK_PRECISION_KEY_ANSWER, text);
}

wt_status wt_case_precision_make(const wt_sliding *sliding, const wt_layer_job *layer,
                                 const wt_layer_observation *known, const wt_accuracy_job *job,
                                 const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no numbers to time");
    setting given;
    wt_job asked = *work;
    asked.threads = 1; /* the processor time of a single thread is measured */
    asked.left_out = WT_EXTRAS & ~(unsigned)WT_EXTRA_DRAWS;
    asked.drawn = NULL; /* the stored draws are for another material */
    asked.log = NULL;   /* warnings about these numbers exist already */
    asked.cost = NULL;  /* the number of computations depends on the clock */
    wt_status status = param_check(wt_accuracy_job_params(), job, err);
    if (status == WT_OK)
        status = setting_make(sliding, layer, known, work, &given, err);
    if (status != WT_OK)
        return status;
    own_case *o = calloc(1, sizeof *o);
    if (o == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *o = (own_case){.given = &given,
                    .asked = &asked,
                    .repeats = job->repeats,
                    .timed = !isnan(cost_clock(work->cost))};
    status = make_draws(o, err);
    if (status == WT_OK)
        status = sweep_numbers(o, 0, SETTING_THICKNESS, err);
    if (status == WT_OK && (given.has_layer || given.has_known))
        status = sweep_numbers(o, SETTING_THICKNESS, SETTING_NUMBERS, err);
    table_writer t = table_begin(&work_precision_schema, err);
    if (status == WT_OK) {
        put_rows(o, &t);
        put_answer(o, &t);
    }
    if (status == WT_OK && job->built_in)
        accuracy_add_parts(job, work, &t, err);
    if (status != WT_OK)
        t.status = status;
    status = table_end(&t, table);
    if (status == WT_OK)
        cost_report(work, (cost_summary){.items = (double)wt_table_n_rows(*table)});
    wt_rubber_clear(&o->more);
    free(o);
    return status;
}
