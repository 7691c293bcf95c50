/* The job of temperature sweeps: glass transition from the peaks of tan delta and E'' and the
 * onset of E', moduli at requested temperatures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"
#include "job/cost.h"
#include "job/inputs.h"

#include "core/base/array.h"
#include "core/base/quantity.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Frequencies within 1e-3 are one frequency, because exports with four digits differ by 5e-4. A
 * temperature sweep needs two temperatures more than the constants of a parabola. */
static const double same_frequency = 1e-3;
enum { MIN_POINTS = 5 };

wt_ramp_job wt_ramp_job_defaults(void)
{
    return (wt_ramp_job){.n_temperatures = 0};
}

static const wt_param rows[] = {
    {PARAM_LIST_OF("at", wt_ramp_job, temperature, n_temperatures, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "",
     .help = SUCH_AS("temperatures at which the moduli are reported, ", "0degC", ",25degC,60degC")},
};
PARAM_TABLE(wt_ramp_job_params, wt_ramp_job, rows, wt_ramp_job_defaults, NO_PARTS)

/* ---- isotherms by frequency ------------------------------------------------------------------ */

typedef struct ramp_point {
    double frequency, temperature, storage, loss, factor, strain;
} ramp_point;

static void add_ramp_from_points(wt_sweep *sweep, const ramp_point *points, size_t n)
{
    if (n < MIN_POINTS)
        return;
    wt_ramp *ramp = wt_sweep_add_ramp(sweep, n, WT_SWEEP_HAS_LOSS_FACTOR | WT_SWEEP_HAS_STRAIN);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        ramp->temperature[i] = points[i].temperature;
        ramp->storage_modulus[i] = points[i].storage;
        ramp->loss_modulus[i] = points[i].loss;
        ramp->loss_factor[i] = points[i].factor;
        ramp->strain[i] = points[i].strain;
        sum += points[i].frequency;
    }
    ramp->angular_frequency = sum / (double)n;
    snprintf(ramp->source, sizeof ramp->source, "%zu isotherms", n);
}

/* Converts the isotherms to temperature sweeps, one for each shared frequency, and adds them. */
static void add_isotherm_ramps(wt_sweep *sweep)
{
    size_t n = 0, all = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        all += sweep->isotherms[i].n;
    ramp_point *points = wt_alloc(all, sizeof *points);
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *t = &sweep->isotherms[i];
        for (size_t k = 0; k < t->n; k++)
            points[n++] = (ramp_point){t->angular_frequency[k],
                                       t->temperature,
                                       t->storage_modulus[k],
                                       t->loss_modulus[k],
                                       t->loss_factor != NULL ? t->loss_factor[k] : (double)NAN,
                                       t->strain != NULL ? t->strain[k] : (double)NAN};
    }
    qsort(points, n, sizeof *points, numbers_compare);
    for (size_t first = 0, end; first < n; first = end) {
        for (end = first + 1;
             end < n && points[end].frequency < points[first].frequency * (1 + same_frequency);)
            end++;
        add_ramp_from_points(sweep, points + first, end - first);
    }
    free(points);
    wt_sweep_sort(sweep);
}

/* ---- one temperature sweep ------------------------------------------------------------------- */

typedef enum sweep_quantity { STORAGE, LOSS, FACTOR, QUANTITIES } sweep_quantity;

/* Points of a temperature sweep whose measured quantities are all positive. */
typedef struct usable_points {
    size_t n;
    double *temperature, *value[QUANTITIES];
    bool has[QUANTITIES]; /* the quantity was measured */
} usable_points;

/* Returns the ratio of the moduli, or the measured tan delta if the moduli are missing. */
static double loss_factor(const wt_ramp *ramp, size_t i)
{
    const double storage = ramp->storage_modulus[i];
    if (storage > 0)
        return ramp->loss_modulus[i] / storage;
    return ramp->loss_factor != NULL ? ramp->loss_factor[i] : (double)NAN;
}

static usable_points select_usable_points(const wt_ramp *ramp, arena *memory, wt_log *log)
{
    usable_points u = {.temperature = arena_numbers(memory, ramp->n)};
    for (int q = 0; q < QUANTITIES; q++)
        u.value[q] = arena_numbers(memory, ramp->n);
    for (size_t i = 0; i < ramp->n; i++) {
        u.has[STORAGE] = u.has[STORAGE] || !isnan(ramp->storage_modulus[i]);
        u.has[LOSS] = u.has[LOSS] || !isnan(ramp->loss_modulus[i]);
        u.has[FACTOR] = u.has[FACTOR] || !isnan(loss_factor(ramp, i));
    }
    for (size_t i = 0; i < ramp->n; i++) {
        const double values[QUANTITIES] = {ramp->storage_modulus[i], ramp->loss_modulus[i],
                                           loss_factor(ramp, i)};
        bool good = true;
        for (int q = 0; q < QUANTITIES; q++)
            good = good && (!u.has[q] || (values[q] > 0 && isfinite(values[q])));
        if (!good)
            continue;
        u.temperature[u.n] = ramp->temperature[i];
        for (int q = 0; q < QUANTITIES; q++)
            u.value[q][u.n] = values[q];
        u.n++;
    }
    if (u.n < ramp->n)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, ramp->n - u.n, "--columns", ramp->source, NULL,
                      "temperature sweep at %.4g rad/s: %zu of %zu points left out, no positive "
                      "modulus",
                      ramp->angular_frequency, ramp->n - u.n, ramp->n);
    return u;
}

TABLE_ROW(ramp, RAMP, double temperature, angular_frequency, storage_modulus, loss_modulus,
          loss_factor, strain;
          const char *source;)

static void add_ramp_rows(table_writer *t, const wt_ramp *r)
{
    table_block(t);
    for (size_t i = 0; i < r->n; i++)
        TABLE_ADD(ramp, t, r->temperature[i], r->angular_frequency, r->storage_modulus[i],
                  r->loss_modulus[i], loss_factor(r, i),
                  r->strain != NULL ? r->strain[i] : (double)NAN, r->source);
}

typedef struct peak_columns {
    wt_interval at;
    double height, points, misfit;
    const char *why_not;
} peak_columns;

TABLE_ROW(glass_transition, GLASS_TRANSITION, peak_columns factor, loss; wt_interval onset;
          const char *onset_note; double angular_frequency, temperature_min, temperature_max;
          const char *source; bool other;)

static const wt_interval unknown_interval = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

static peak_columns peak_to_columns(const wt_peak *p)
{
    const double none = (double)NAN;
    return p->found ? (peak_columns){p->at, p->height.value, (double)p->n, p->misfit, p->reason}
                    : (peak_columns){unknown_interval, none, none, none, p->reason};
}

typedef struct peak_set {
    wt_peak factor, loss;
    wt_onset onset;
} peak_set;

static wt_status find_quantity_peak(const usable_points *u, sweep_quantity q, wt_peak *peak,
                                    wt_error *err)
{
    if (u->has[q])
        return wt_peak_find(u->temperature, u->value[q], u->n, peak, err);
    *peak = (wt_peak){.found = false, .reason = "not measured"};
    return WT_OK;
}

/* A rubber has fewer transitions than this; further peaks are scatter. */
enum { MAX_SECONDARY_PEAKS = 8 };

/* Adds a row for each lower peak of one quantity. Its assignment to a peak of the other quantity
 * is unknown. */
static wt_status add_secondary_peak_rows(table_writer *t, const wt_ramp *ramp,
                                         const usable_points *u, sweep_quantity q, wt_error *err)
{
    wt_peak lower[MAX_SECONDARY_PEAKS];
    size_t n = 0;
    const wt_status status =
        wt_secondary_peaks(u->temperature, u->value[q], u->n, MAX_SECONDARY_PEAKS, lower, &n, err);
    for (size_t i = 0; i < n; i++) {
        const wt_peak none = {.found = false,
                              .reason = q == LOSS ? "of the loss modulus" : "of tan delta"};
        TABLE_ADD(glass_transition, t, peak_to_columns(q == FACTOR ? &lower[i] : &none),
                  peak_to_columns(q == LOSS ? &lower[i] : &none), unknown_interval,
                  "in the row of the largest peak", ramp->angular_frequency, ramp->temperature[0],
                  ramp->temperature[ramp->n - 1], ramp->source, true);
    }
    return status;
}

static wt_status add_transition_row(table_writer *t, const wt_ramp *ramp, const usable_points *u,
                                    peak_set *found, wt_error *err)
{
    wt_status status = find_quantity_peak(u, FACTOR, &found->factor, err);
    if (status == WT_OK)
        status = find_quantity_peak(u, LOSS, &found->loss, err);
    found->onset = (wt_onset){.at = unknown_interval, .reason = "not measured"};
    if (status == WT_OK && u->has[STORAGE])
        status = wt_onset_find(u->temperature, u->value[STORAGE], u->n, &found->onset, err);
    if (status != WT_OK)
        return status;
    TABLE_ADD(glass_transition, t, peak_to_columns(&found->factor), peak_to_columns(&found->loss),
              found->onset.at, found->onset.reason, ramp->angular_frequency, ramp->temperature[0],
              ramp->temperature[ramp->n - 1], ramp->source, false);
    for (sweep_quantity q = LOSS; q <= FACTOR && status == WT_OK; q++)
        status = u->has[q] ? add_secondary_peak_rows(t, ramp, u, q, err) : WT_OK;
    return status;
}

TABLE_ROW(moduli_at, MODULI_AT, double temperature, angular_frequency;
          wt_interval modulus[QUANTITIES]; const char *note, *source;)

static wt_status add_moduli_rows(table_writer *t, const wt_ramp_job *job, const wt_ramp *ramp,
                                 const usable_points *u, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t k = 0; status == WT_OK && k < job->n_temperatures; k++) {
        const double at = job->temperature[k];
        const bool within =
            u->n >= MIN_POINTS && at >= u->temperature[0] && at <= u->temperature[u->n - 1];
        moduli_at_row row = {at,
                             ramp->angular_frequency,
                             {unknown_interval, unknown_interval, unknown_interval},
                             within               ? ""
                             : u->n >= MIN_POINTS ? "outside of the temperatures measured"
                                                  : "too few points",
                             ramp->source};
        for (int q = 0; within && status == WT_OK && q < QUANTITIES; q++)
            if (u->has[q])
                status = wt_smooth_interpolate(u->temperature, u->value[q], u->n, at,
                                               &row.modulus[q], err);
        moduli_at_add_row(t, &row);
    }
    return status;
}

/* ---- activation energy of a peak ------------------------------------------------------------- */

/* Weighted sums over the peaks at all frequencies, for x = 1/T with its error and y = ln omega. */
typedef struct peak_regression {
    size_t n;
    double w, x, y, xx, xy, yy; /* sums relative to the first peak */
    double x0, y0;
} peak_regression;

static void add_regression_point(peak_regression *m, const wt_peak *peak, double angular_frequency)
{
    const double temperature = peak->at.value,
                 error = peak->at.standard_error / (temperature * temperature);
    if (!peak->found || !(error > 0))
        return;
    if (m->n++ == 0) {
        m->x0 = 1 / temperature;
        m->y0 = log(angular_frequency);
    }
    const double w = 1 / (error * error), x = 1 / temperature - m->x0,
                 y = log(angular_frequency) - m->y0;
    m->w += w;
    m->x += w * x;
    m->y += w * y;
    m->xx += w * x * x;
    m->xy += w * x * y;
    m->yy += w * y * y;
}

/* Returns the apparent activation energy -R d ln omega / d (1/T) from a line of 1/T over ln
 * omega. The errors are those of the peaks, or their scatter if it is larger; WLF curvature
 * counts as scatter. A line through two frequencies has the errors of the peaks alone. */
static wt_estimate activation_energy(const peak_regression *m)
{
    const double none = (double)NAN, yy = m->yy - m->y * m->y / m->w,
                 xy = m->xy - m->x * m->y / m->w, xx = m->xx - m->x * m->x / m->w, slope = xy / yy;
    if (m->n < 2 || !(yy > 0) || !(slope < 0))
        return (wt_estimate){none, none, none, "J/mol"};
    const double energy = -GAS_CONSTANT / slope,
                 scatter = m->n > 2 ? (xx - slope * xy) / (double)(m->n - 2) : 1;
    return (wt_estimate){energy, energy * sqrt(fmax(scatter, 1) / yy) / -slope, 0, "J/mol"};
}

/* ---- the job --------------------------------------------------------------------------------- */

typedef struct ramp_writers {
    table_writer ramp, transition, moduli;
} ramp_writers;

/* The keys describe the frequency nearest to 1 Hz that has a peak. */
TABLE_KEYS(glass_transition, GLASS_TRANSITION, wt_interval factor_peak, loss_peak, onset;
           wt_estimate factor_energy, loss_energy; double angular_frequency;
           const char *deformation;)

static wt_status add_sweep_rows(const wt_ramp_job *job, const wt_job *work, const wt_sweep *sweep,
                                ramp_writers *w, wt_error *err)
{
    double away = HUGE_VAL;
    peak_regression factors = {0}, losses = {0};
    glass_transition_keys best = {.factor_peak = unknown_interval,
                                  .loss_peak = unknown_interval,
                                  .onset = unknown_interval,
                                  .angular_frequency = (double)NAN,
                                  .deformation = flow_deformation_name(sweep->deformation)};
    wt_status status = WT_OK;
    for (size_t i = 0; i < sweep->n_ramps && status == WT_OK; i++) {
        const wt_ramp *ramp = &sweep->ramps[i];
        arena memory = {0};
        const usable_points u = select_usable_points(ramp, &memory, work->log);
        peak_set found = {0};
        add_ramp_rows(&w->ramp, ramp);
        if ((work->left_out & WT_EXTRA_TRANSITION) == 0)
            status = add_transition_row(&w->transition, ramp, &u, &found, err);
        if (status == WT_OK)
            status = add_moduli_rows(&w->moduli, job, ramp, &u, err);
        arena_free(&memory);
        add_regression_point(&factors, &found.factor, ramp->angular_frequency);
        add_regression_point(&losses, &found.loss, ramp->angular_frequency);
        const double off = fabs(log(ramp->angular_frequency / (2 * M_PI)));
        if (status == WT_OK && (found.factor.found || found.loss.found) && off < away) {
            away = off;
            best.angular_frequency = ramp->angular_frequency;
            best.factor_peak = found.factor.found ? found.factor.at : unknown_interval;
            best.loss_peak = found.loss.found ? found.loss.at : unknown_interval;
            best.onset = found.onset.at;
        }
    }
    best.factor_energy = activation_energy(&factors);
    best.loss_energy = activation_energy(&losses);
    glass_transition_set_keys(&w->transition, &best);
    return status;
}

static wt_status build_ramp_tables(const wt_ramp_job *job, const wt_job *work,
                                   const wt_sweep *sweep, wt_ramp_tables *t, wt_error *err)
{
    const char *deformation = flow_deformation_name(sweep->deformation);
    ramp_writers w = {table_begin(&ramp_schema, err), table_begin(&glass_transition_schema, err),
                      table_begin(&moduli_at_schema, err)};
    wt_status status = add_sweep_rows(job, work, sweep, &w, err);
    ramp_set_text(&w.ramp, RAMP_KEY_DEFORMATION, deformation);
    moduli_at_set_text(&w.moduli, MODULI_AT_KEY_DEFORMATION, deformation);
    const wt_status ended[] = {table_end(&w.ramp, &t->ramp),
                               table_end(&w.transition, &t->glass_transition),
                               table_end(&w.moduli, &t->moduli_at)};
    for (size_t i = 0; i < COUNT_OF(ended) && status == WT_OK; i++)
        status = ended[i];
    if (job->n_temperatures == 0) {
        wt_table_free(t->moduli_at);
        t->moduli_at = NULL;
    }
    return status;
}

wt_status wt_ramp_compute(const wt_ramp_job *job, const wt_job *work, wt_ramp_tables *tables,
                          wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of temperature sweeps");
    wt_sweep sweep = {0};
    wt_ramp_tables t = {0};
    wt_status status = param_check(wt_ramp_job_params(), job, err);
    if (status == WT_OK)
        status = flow_sweeps_read(job->sets, job->n_sets, work, &sweep, err);
    if (status == WT_OK)
        status = flow_require_one_sample(&sweep, job->sets, job->n_sets, work->log, err);
    if (status == WT_OK)
        status = flow_select_amplitude(&sweep, job->sets, job->n_sets, work->log, err);
    const size_t isotherms = sweep.n_isotherms, strain_sweeps = sweep.n_strain_sweeps;
    if (status == WT_OK)
        status = flow_require_oscillation(&sweep, "a temperature sweep", err);
    if (status == WT_OK)
        add_isotherm_ramps(&sweep);
    if (status == WT_OK && sweep.n_ramps == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no temperature sweep could be read");
        wt_error_expected(err, "moduli at one frequency at %d temperatures or more", MIN_POINTS);
        wt_error_found(err, "isotherms: %zu, strain sweeps: %zu", isotherms, strain_sweeps);
        if (strain_sweeps > 0)
            wt_error_advice(err, "`weartrack payne FILE` reports how the rubber softens with "
                                 "strain");
    }
    if (status == WT_OK)
        status = build_ramp_tables(job, work, &sweep, &t, err);
    if (status == WT_OK) {
        cost_report(work, (cost_summary){.items = (double)sweep.n_ramps});
        *tables = t;
        t = (wt_ramp_tables){0};
    }
    wt_tables_clear(&t, sizeof t);
    wt_sweep_clear(&sweep);
    return status;
}
