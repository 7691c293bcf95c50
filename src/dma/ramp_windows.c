/* Converts temperature sweeps to isotherms. Points of neighbouring temperatures form one
 * isotherm. The shift law, found in the same fit, moves each point to its temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "dma/sweep_input.h"

#include <math.h>
#include <stdlib.h>

/* 30 windows are ten for each constant of a law; the time grows with the cube of their number. A
 * window needs one point for each frequency and LEAST_POINTS points, as SHIFT_MIN_POINTS. Above
 * 600 points (20 per window) neighbours are merged. Each round moves the points by half of the
 * residual. Anderson mixing of two rounds extrapolates by up to eight times. */
enum { MOST_WINDOWS = 30, LEAST_POINTS = 4, MOST_POINTS = 600, MOST_ROUNDS = 8, MOST_AHEAD = 8 };
static const double same_frequency = 1e-3; /* exports with four digits differ by 5e-4 */
/* The rounds end if no point moves farther [decade]: 1 %, the size of the noise. */
static const double convergence_limit = 0.005;
enum { STORAGE, LOSS, FACTOR, QUANTITIES };

typedef struct window_point {
    double temperature, frequency;
    double value[QUANTITIES]; /* storage modulus, loss modulus, and the loss factor if it was
                                 measured alone */
    double off;               /* log10 a to the temperature of its window [decade] */
    double law_shift,
        law_residual; /* last value of the law and its difference from `off` [decade] */
} window_point;

typedef struct windows {
    size_t n, n_points, n_left_out;
    window_point *window_point; /* sorted by temperature */
    size_t *first;              /* [n + 1] */
    wt_isotherm *isotherm; /* [n] copies of the isotherms of the sweep; they borrow its arrays */
} windows;

static void windows_free(windows *w)
{
    free(w->window_point);
    free(w->first);
    free(w->isotherm);
}

/* Counts the distinct frequencies of the sorted sweeps. */
static size_t count_frequencies(const wt_sweep *sweep)
{
    size_t n = 0;
    double last = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++) {
        const double w = sweep->ramps[i].angular_frequency;
        if (w > last * (1 + same_frequency)) {
            last = w;
            n++;
        }
    }
    return n;
}

/* Splits the points into windows that are wide enough and contain enough points. */
static void split_into_windows(windows *w, size_t n_frequencies)
{
    const size_t least = n_frequencies > LEAST_POINTS ? n_frequencies : LEAST_POINTS;
    const window_point *p = w->window_point;
    const double width = (p[w->n_points - 1].temperature - p[0].temperature) / MOST_WINDOWS;
    w->n = 0;
    w->first[0] = 0;
    for (size_t i = 1; i < w->n_points; i++) {
        const size_t first = w->first[w->n];
        if (i - first >= least && p[i].temperature - p[first].temperature >= width &&
            w->n_points - i >= least)
            w->first[++w->n] = i;
    }
    w->first[++w->n] = w->n_points;
}

static double ramp_value(const wt_ramp *r, int q, size_t k)
{
    const double *const values[QUANTITIES] = {r->storage_modulus, r->loss_modulus, r->loss_factor};
    return values[q] != NULL ? values[q][k] : (double)NAN;
}

/* Finds which quantities have a value at some point of the sweep. */
static void find_measured_quantities(const wt_ramp *r, bool has[QUANTITIES])
{
    for (int q = 0; q < QUANTITIES; q++) {
        has[q] = false;
        for (size_t k = 0; k < r->n && !has[q]; k++)
            has[q] = isfinite(ramp_value(r, q, k));
    }
}

/* Adds the means of `each` neighbouring points of a sweep. Points without logarithms are
 * skipped. */
static void add_sweep_points(const wt_ramp *r, size_t each, windows *w)
{
    bool has[QUANTITIES];
    find_measured_quantities(r, has);
    for (size_t first = 0; first < r->n; first += each) {
        double temperature = 0, sum[QUANTITIES] = {0};
        size_t n = 0;
        for (size_t k = first; k < first + each && k < r->n; k++) {
            bool good = has[STORAGE] || has[LOSS] || has[FACTOR];
            for (int q = 0; q < QUANTITIES; q++)
                good = good && (!has[q] || ramp_value(r, q, k) > 0);
            w->n_left_out += !good;
            for (int q = 0; good && q < QUANTITIES; q++)
                sum[q] += log(ramp_value(r, q, k));
            temperature += good ? r->temperature[k] : 0;
            n += good;
        }
        if (n == 0)
            continue;
        window_point *p = &w->window_point[w->n_points++];
        *p = (window_point){.temperature = temperature / (double)n,
                            .frequency = r->angular_frequency};
        for (int q = 0; q < QUANTITIES; q++)
            p->value[q] = exp(sum[q] / (double)n);
    }
}

static wt_status build_windows(const wt_sweep *sweep, windows *w, wt_error *err)
{
    size_t n = 0;
    for (size_t i = 0; i < sweep->n_ramps; i++)
        n += sweep->ramps[i].n;
    w->window_point = wt_alloc(n, sizeof *w->window_point);
    w->first = wt_alloc(n + 2, sizeof *w->first);
    for (size_t i = 0; i < sweep->n_ramps; i++)
        add_sweep_points(&sweep->ramps[i], (n + MOST_POINTS - 1) / MOST_POINTS, w);
    if (w->n_points == 0)
        return wt_fail(err, WT_E_RANGE, "no point of the temperature sweeps has positive moduli");
    qsort(w->window_point, w->n_points, sizeof *w->window_point, numbers_compare);
    split_into_windows(w, count_frequencies(sweep));
    return WT_OK;
}

static void add_window_isotherms(wt_sweep *sweep, windows *w)
{
    w->isotherm = wt_alloc(w->n, sizeof *w->isotherm);
    for (size_t i = 0; i < w->n; i++) {
        const size_t first = w->first[i], n = w->first[i + 1] - first;
        bool factor = false;
        for (size_t k = 0; k < n; k++)
            factor = factor || isfinite(w->window_point[first + k].value[FACTOR]);
        wt_isotherm *t = wt_sweep_add(sweep, n, factor ? WT_SWEEP_HAS_LOSS_FACTOR : 0);
        double sum = 0;
        for (size_t k = 0; k < n; k++)
            sum += w->window_point[first + k].temperature;
        t->temperature = sum / (double)n;
        clocale_print(t->source, sizeof t->source, "temperature sweeps, %.1f to %.1f degC",
                      w->window_point[first].temperature - WT_ZERO_CELSIUS,
                      w->window_point[first + n - 1].temperature - WT_ZERO_CELSIUS);
        w->isotherm[i] = *t;
    }
}

/* Updates the shift of each point by the fitted law. The residual shrinks by the same factor in
 * each round, so two rounds predict the limit (Anderson mixing). Returns the largest residual
 * [decade]. */
static double update_fitted_shifts(const windows *w, const wt_master *master, bool first)
{
    double most = 0, product = 0, square = 0;
    for (size_t i = 0; i < w->n; i++) {
        const double window_shift = wt_master_log_shift(master, w->isotherm[i].temperature).value;
        for (size_t k = w->first[i]; k < w->first[i + 1]; k++) {
            window_point *p = &w->window_point[k];
            const double off = wt_master_log_shift(master, p->temperature).value - window_shift,
                         law_shift = isfinite(off) ? off : 0, law_residual = law_shift - p->off;
            product += law_residual * (law_residual - p->law_residual);
            square += (law_residual - p->law_residual) * (law_residual - p->law_residual);
            most = fmax(most, fabs(law_residual));
            p->off =
                law_shift - p->law_shift; /* holds the change of the law until the second loop */
            p->law_shift = law_shift;
            p->law_residual = law_residual;
        }
    }
    const double share = square > 0 && !first ? fmax(-MOST_AHEAD, fmin(0.5, product / square)) : 0;
    for (size_t k = 0; k < w->n_points; k++)
        w->window_point[k].off = w->window_point[k].law_shift - share * w->window_point[k].off;
    return most;
}

/* Sets the shifts of points and isotherms by the stated law. No iteration is needed and no shift
 * is fitted. */
static wt_status set_stated_shifts(const windows *w, const wt_shift_law *law, wt_sweep *sweep,
                                   wt_error *err)
{
    for (size_t i = 0; i < w->n; i++) {
        const double window_shift = wt_shift_law_log_a(law, w->isotherm[i].temperature);
        for (size_t k = w->first[i]; k < w->first[i + 1]; k++)
            w->window_point[k].off =
                wt_shift_law_log_a(law, w->window_point[k].temperature) - window_shift;
    }
    return flow_set_stated_shifts(law, NULL, WT_VERTICAL_NONE, sweep, NULL, err);
}

/* Writes the points to the isotherms, moved to the temperature of their window. */
static void shift_to_windows(const windows *w, bool vertical)
{
    for (size_t i = 0; i < w->n; i++) {
        const wt_isotherm *t = &w->isotherm[i];
        for (size_t k = 0; k < t->n; k++) {
            const window_point *p = &w->window_point[w->first[i] + k];
            const double b = vertical ? t->temperature / p->temperature : 1;
            t->angular_frequency[k] = p->frequency * pow(10, p->off);
            t->storage_modulus[k] = p->value[STORAGE] * b;
            t->loss_modulus[k] = p->value[LOSS] * b;
            if (t->loss_factor != NULL)
                t->loss_factor[k] = p->value[FACTOR];
        }
    }
}

static wt_status check_frequency_count(const wt_sweep *sweep, wt_error *err)
{
    if (sweep->n_isotherms > 0 || count_frequencies(sweep) > 1)
        return WT_OK;
    wt_fail(err, WT_E_MISSING, "a temperature sweep at one frequency has no shift of its own");
    wt_error_expected(err, "sweeps at two frequencies or more, or isotherms beside it");
    wt_error_advice(err, "give the law of the shifts (--shift-law wlf:...); `weartrack ramp "
                         "FILE` reports the glass transition");
    wt_error_options(err, "shift-law");
    return WT_E_MISSING;
}

static void report_windows(const wt_sweep *sweep, const windows *w, const wt_master *master,
                           bool given, double moved, wt_log *log)
{
    const size_t frequencies = count_frequencies(sweep);
    wt_log_add(log, WT_NOTE, sweep->ramps[0].source, NULL,
               "%zu temperature sweep%s at %zu frequenc%s %s fitted as %zu isotherms, each "
               "point brought to the temperature of its isotherm by the shift law%s",
               sweep->n_ramps, sweep->n_ramps > 1 ? "s" : "", frequencies,
               frequencies > 1 ? "ies" : "y", sweep->n_ramps > 1 ? "are" : "is", w->n,
               given ? " that is given" : "");
    if (w->n_left_out > 0)
        wt_log_action(
            log, WT_WARNING, WT_LEFT_OUT, w->n_left_out, "--columns", sweep->ramps[0].source, NULL,
            "%zu points of the temperature sweeps left out, no positive modulus", w->n_left_out);
    if (moved >= convergence_limit)
        wt_log_add(log, WT_WARNING, sweep->ramps[0].source, NULL,
                   "the shift law and the temperature sweeps that it shifts agree to %.2g "
                   "decades only",
                   moved);
    if (master->law.kind == WT_LAW_NONE)
        wt_log_add(log, WT_WARNING, sweep->ramps[0].source, NULL,
                   "no shift law brings the points of the temperature sweeps to one "
                   "temperature: those of %.1f K count as an isotherm",
                   w->window_point[w->first[1] - 1].temperature - w->window_point[0].temperature);
}

wt_status flow_ramps_fit(wt_sweep *sweep, const wt_master_options *options,
                         const wt_shift_law *given, wt_log *log, wt_master *master, wt_error *err)
{
    windows w = {0};
    const bool is_stated = given->kind != WT_LAW_NONE;
    wt_status status = is_stated ? WT_OK : check_frequency_count(sweep, err);
    if (status == WT_OK)
        status = build_windows(sweep, &w, err);
    if (status == WT_OK)
        add_window_isotherms(sweep, &w);
    if (status == WT_OK && is_stated)
        status = set_stated_shifts(&w, given, sweep, err);
    wt_master_options quick = *options;
    if (quick.vertical != WT_VERTICAL_NONE)
        quick.vertical = WT_VERTICAL_PHYSICAL; /* accurate enough for the law */
    quick.series_only = true;
    bool last = false;
    double moved = 0;
    for (int round = 0; status == WT_OK && !last; round++) {
        moved = round > 0 ? update_fitted_shifts(&w, master, round == 1) : 0;
        last = is_stated || (round > 0 && (moved < convergence_limit || round == MOST_ROUNDS));
        shift_to_windows(&w, options->vertical != WT_VERTICAL_NONE);
        wt_sweep_sort(sweep);
        wt_master_clear(master);
        status = wt_master_fit(sweep, last ? options : &quick, last ? log : NULL, master, err);
    }
    if (status == WT_OK)
        report_windows(sweep, &w, master, is_stated, moved, log);
    windows_free(&w);
    return status;
}
