/* Reduces the spectrum of a fit to a short Prony series that stays as close to both moduli as
 * requested over the measured frequencies. Times and moduli of the terms are fitted as logarithms,
 * so all are positive. After least squares the points are reweighted by their deviation (Lawson),
 * which equalises the largest deviations.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/special.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/math/arena_gsl.h"
#include "dma/law/prony_law.h"
#include "weartrack/dma.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STORAGE, LOSS, MODULI };
/* Points per decade for the fit and for the check: five and thirteen per term of the densest
 * series. */
enum { POINTS = 16, CHECK_POINTS = 40 };
/* Steps of a fit, reweighting rounds, steps in a round, dampings of a step. They limit the time;
 * the best result is stored. Twice as many hardly improve a series, half as many cost one more
 * term. */
enum { STEPS = 60, ROUNDS = 16, ROUND_STEPS = 3, DAMPINGS = 10 };
/* More terms per decade do not improve the moduli, which then ripple by 1e-5 of E''
 * (dma/numerics/master_fit.c). */
static const double max_density = 3;
/* Range of the relaxation times outside the measured range [ln]. A term two decades faster has
 * 1e-4 of its modulus in E' and is a dashpot. A term eight decades slower replaces a long-term
 * modulus that is stated too low. */
static const double faster = 2 * M_LN10, slower = 8 * M_LN10;
/* Allowance for a larger deviation between the points. With 16 points per period the maximum of
 * a curve is missed by cos(pi/16), 2 %. */
static const double interpolation_margin = 0.05;
/* A term with a smaller share of any modulus is removed; it changes no reported digit. */
static const double negligible_share = 1e-9;
/* Relative decrease of the sum of squares that ends the fit; half of it in the deviation. */
static const double least_gain = 1e-3;

wt_reduction wt_reduction_defaults(void)
{
    return (wt_reduction){.error = 0.02, .long_term = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM("prony-terms", wt_reduction, terms, WT_Q_NONE, FROM_TO(0, 200)), .value = "N",
     .help = "of the reduced Prony series; 0 is as few as --prony-error needs"},
    {PARAM("prony-error", wt_reduction, error, WT_Q_NONE, FROM_TO(1e-4, 1)), .value = "X",
     .help = "largest relative deviation of storage and loss modulus of the reduced Prony series "
             "from the spectrum, over the measured frequencies"},
    {PARAM("prony-long-term", wt_reduction, long_term, WT_Q_MODULUS, AT_LEAST(0)), .value = "E",
     .help = "long-term modulus of the reduced Prony series, 0Pa for a liquid",
     .unset = "fitted with the terms"},
};
PARAM_TABLE(wt_reduction_params, wt_reduction, rows, wt_reduction_defaults, NO_PARTS)

typedef struct reducer {
    arena memory;
    const wt_prony *from;
    size_t n;                   /* points */
    double *x;                  /* [n] ln w */
    double *y[MODULI];          /* [n] ln of the moduli of the spectrum */
    double *weight[MODULI];     /* [n] */
    double *off[MODULI];        /* [n] ln of the ratio of the moduli */
    double low, high;           /* limits of the relaxation times [ln] */
    bool fitted;                /* the long-term modulus is fitted */
    double long_term;           /* used if it is not fitted */
    size_t most, initial_terms; /* maximum and initial number of terms in the search */
    size_t terms; /* present number; unknown[2 i] is ln tau, [2 i + 1] ln E; last ln E_inf */
    double *unknown, *candidate, *best;
    double *row[MODULI];
    double objective;
    gsl_matrix *normal, *factor;
    gsl_vector *gradient, *move;
} reducer;

/* ---- moduli ---------------------------------------------------------------------------------- */

static size_t n_unknowns(const reducer *r)
{
    return 2 * r->terms + r->fitted;
}

/* Computes the moduli of the terms at x and, if `row` is not NULL, the derivatives of their
 * logarithms. */
static void term_moduli(const reducer *r, const double *unknown, double x, double modulus[MODULI],
                        double *const row[MODULI])
{
    const size_t n = 2 * r->terms;
    const double rest = r->fitted ? exp(unknown[n]) : r->long_term;
    modulus[STORAGE] = rest;
    modulus[LOSS] = 0;
    for (size_t i = 0; i < n; i += 2) {
        const double u = x + unknown[i], e = exp(unknown[i + 1]), t = tanh(u),
                     bell = 1 / cosh(u); /* z/(1 + z^2) = bell/2, z^2/(1 + z^2) = (1 + t)/2 */
        modulus[STORAGE] += 0.5 * e * (1 + t);
        modulus[LOSS] += 0.5 * e * bell;
        if (row != NULL) {
            row[STORAGE][i] = 0.5 * e * bell * bell;
            row[STORAGE][i + 1] = 0.5 * e * (1 + t);
            row[LOSS][i] = -0.5 * e * bell * t;
            row[LOSS][i + 1] = 0.5 * e * bell;
        }
    }
    if (row == NULL)
        return;
    if (r->fitted) {
        row[STORAGE][n] = rest;
        row[LOSS][n] = 0;
    }
    for (int q = 0; q < MODULI; q++)
        for (size_t i = 0; i < n_unknowns(r); i++)
            row[q][i] /= modulus[q];
}

/* Returns the weighted sum of squares; with_normal: also fills the normal equations. */
static double weighted_squares(reducer *r, const double *unknown, bool with_normal)
{
    const size_t n = n_unknowns(r);
    double sum = 0;
    if (with_normal) {
        gsl_matrix_set_zero(r->normal);
        gsl_vector_set_zero(r->gradient);
    }
    for (size_t k = 0; k < r->n; k++) {
        double modulus[MODULI];
        term_moduli(r, unknown, r->x[k], modulus, with_normal ? r->row : NULL);
        for (int q = 0; q < MODULI; q++) {
            const double off = log(modulus[q]) - r->y[q][k], w = r->weight[q][k];
            r->off[q][k] = off;
            sum += w * off * off;
            for (size_t i = 0; with_normal && i < n; i++) {
                const double by = w * r->row[q][i];
                double *to = gsl_matrix_ptr(r->normal, i, 0);
                for (size_t j = 0; j <= i; j++)
                    to[j] += by * r->row[q][j];
                *gsl_vector_ptr(r->gradient, i) -= by * off;
            }
        }
    }
    return sum;
}

/* ---- fit with a fixed number of terms -------------------------------------------------------- */

static bool solve_damped(reducer *r, double damping)
{
    const size_t n = n_unknowns(r);
    gsl_matrix_view factor = gsl_matrix_submatrix(r->factor, 0, 0, n, n);
    gsl_vector_view gradient = gsl_vector_subvector(r->gradient, 0, n),
                    move = gsl_vector_subvector(r->move, 0, n);
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, gsl_matrix_get(r->normal, i, i));
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            gsl_matrix_set(r->factor, i, j, gsl_matrix_get(r->normal, i, j));
    /* the regularisation fixes a term that does not affect the points */
    for (size_t i = 0; i < n; i++)
        *gsl_matrix_ptr(r->factor, i, i) +=
            damping * gsl_matrix_get(r->normal, i, i) + 1e-10 * most;
    return gsl_linalg_cholesky_decomp1(&factor.matrix) == GSL_SUCCESS &&
           gsl_linalg_cholesky_solve(&factor.matrix, &gradient.vector, &move.vector) == GSL_SUCCESS;
}

static void clamp_times(const reducer *r, double *unknown)
{
    for (size_t i = 0; i < 2 * r->terms; i += 2)
        unknown[i] = fmin(fmax(unknown[i], r->low), r->high);
}

/* Levenberg-Marquardt steps with the present weights. */
static void fit_unknowns(reducer *r, int steps)
{
    const size_t n = n_unknowns(r);
    double damping = 1e-3;
    for (int i = 0; i < steps; i++) {
        const double before = weighted_squares(r, r->unknown, true);
        double after = before;
        for (int k = 0; k < DAMPINGS; k++) {
            after = HUGE_VAL;
            if (solve_damped(r, damping)) {
                for (size_t u = 0; u < n; u++)
                    r->candidate[u] = r->unknown[u] + gsl_vector_get(r->move, u);
                clamp_times(r, r->candidate);
                after = weighted_squares(r, r->candidate, false);
            }
            if (after < before)
                break;
            damping = fmax(10 * damping, 1e-6);
        }
        if (!(after < before))
            break;
        memcpy(r->unknown, r->candidate, n * sizeof *r->candidate);
        damping /= 10;
        if (before - after < least_gain * before)
            break;
    }
    r->objective = weighted_squares(r, r->unknown, false);
}

static double largest_deviation(const reducer *r)
{
    double most = 0;
    for (int q = 0; q < MODULI; q++)
        for (size_t k = 0; k < r->n; k++)
            most = fmax(most, fabs(expm1(r->off[q][k])));
    return most;
}

/* Fits from the present unknowns. `best` gets those with the least maximum deviation, which is
 * returned. Reweighting runs only if it can reach the requested deviation. */
static double fit_terms(reducer *r, double tolerance)
{
    const size_t n = n_unknowns(r);
    for (int q = 0; q < MODULI; q++)
        for (size_t k = 0; k < r->n; k++)
            r->weight[q][k] = 1;
    fit_unknowns(r, STEPS);
    double best = largest_deviation(r);
    memcpy(r->best, r->unknown, n * sizeof *r->best);
    for (int i = 0; i < ROUNDS && best > tolerance && (best < 4 * tolerance || tolerance == 0);
         i++) {
        double sum = 0;
        for (int q = 0; q < MODULI; q++)
            for (size_t k = 0; k < r->n; k++)
                sum += r->weight[q][k] *= fabs(r->off[q][k]) + 0.01 * best;
        for (int q = 0; q < MODULI; q++)
            for (size_t k = 0; k < r->n; k++)
                r->weight[q][k] *= 2 * (double)r->n / sum;
        fit_unknowns(r, ROUND_STEPS);
        const double now = largest_deviation(r);
        if (now < best) {
            best = now;
            memcpy(r->best, r->unknown, n * sizeof *r->best);
        }
    }
    return best;
}

/* Sets start values: times evenly over the measured range, moduli from the spectrum. */
static void spread_terms(reducer *r, size_t terms)
{
    const double from = -r->x[r->n - 1], step = (r->x[r->n - 1] - r->x[0]) / (double)terms;
    double modulus[MODULI];
    r->terms = terms;
    for (size_t i = 0; i < terms; i++) {
        r->unknown[2 * i] = from + ((double)i + 0.5) * step;
        r->unknown[2 * i + 1] = 0;
        for (size_t k = 0; k < r->from->n; k++) {
            const double at = floor((log(r->from->relaxation_time[k]) - from) / step);
            if (fmin(fmax(at, 0), (double)(terms - 1)) == (double)i)
                r->unknown[2 * i + 1] += r->from->modulus[k];
        }
        const double w = exp(-r->unknown[2 * i]);
        prony_moduli(r->from, w, &modulus[STORAGE], &modulus[LOSS]);
        /* a modulus of 0 is no start value */
        r->unknown[2 * i + 1] = log(fmax(r->unknown[2 * i + 1], 0.1 * modulus[LOSS]));
    }
    if (r->fitted) {
        prony_moduli(r->from, exp(r->x[0]), &modulus[STORAGE], &modulus[LOSS]);
        r->unknown[2 * terms] = log(fmax(r->from->equilibrium_modulus, 1e-3 * modulus[STORAGE]));
    } else if (terms > 1 && r->from->equilibrium_modulus > r->long_term) {
        r->unknown[2 * terms - 2] = r->high;
        r->unknown[2 * terms - 1] = log(r->from->equilibrium_modulus - r->long_term);
    }
}

/* ---- number of terms ------------------------------------------------------------------------- */

/* Returns the largest share of a term in a modulus. */
static double largest_modulus_share(const reducer *r, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < r->n; k++) {
        const double u = r->x[k] + r->unknown[2 * i], e = exp(r->unknown[2 * i + 1]);
        most = fmax(
            most,
            0.5 * e * fmax((1 + tanh(u)) * exp(-r->y[STORAGE][k]), exp(-r->y[LOSS][k]) / cosh(u)));
    }
    return most;
}

static void remove_term(reducer *r, size_t i)
{
    memmove(r->unknown + 2 * i, r->unknown + 2 * i + 2,
            (n_unknowns(r) - 2 * i - 2) * sizeof *r->unknown);
    r->terms--;
}

/* Removes one term: a negligible one, otherwise the two closest are merged. */
static void remove_or_merge_term(reducer *r, double little)
{
    for (size_t i = 0; i < r->terms; i++)
        if (largest_modulus_share(r, i) < little) {
            remove_term(r, i);
            return;
        }
    size_t at = 0;
    for (size_t i = 1; i + 1 < r->terms; i++)
        if (r->unknown[2 * i + 2] - r->unknown[2 * i] < r->unknown[2 * at + 2] - r->unknown[2 * at])
            at = i;
    double *first = r->unknown + 2 * at;
    const double e1 = exp(first[1]), e2 = exp(first[3]), share = e2 / (e1 + e2);
    first[0] += share * (first[2] - first[0]);
    first[1] = log(e1 + e2);
    remove_term(r, at + 1);
}

/* Returns to the best terms, without negligible ones and in the order of their times, and stores
 * them. */
static void store_best_terms(reducer *r, double *best_terms)
{
    memcpy(r->unknown, r->best, n_unknowns(r) * sizeof *r->best);
    for (size_t i = r->terms; i-- > 0;)
        if (largest_modulus_share(r, i) < negligible_share)
            remove_term(r, i);
    qsort(r->unknown, r->terms, 2 * sizeof *r->unknown, numbers_compare);
    memcpy(best_terms, r->unknown, n_unknowns(r) * sizeof *best_terms);
}

/* Finds the smallest number of terms: it increases by half until the deviation suffices, then terms
 * are merged as long as it does. */
static size_t fewest_terms(reducer *r, double tolerance, double *best_terms)
{
    size_t n = r->initial_terms;
    spread_terms(r, n);
    double off = fit_terms(r, tolerance);
    while (off > tolerance && n < r->most) {
        n = (size_t)fmin((double)(n + n / 2 + 1), (double)r->most);
        spread_terms(r, n);
        off = fit_terms(r, tolerance);
    }
    store_best_terms(r, best_terms);
    for (n = r->terms; off <= tolerance && n > 1; n = r->terms) {
        remove_or_merge_term(r, 0.1 * tolerance);
        off = fit_terms(r, tolerance);
        if (off > tolerance)
            break;
        store_best_terms(r, best_terms);
    }
    return n;
}

/* ---- interface ------------------------------------------------------------------------------- */

static wt_status prepare_reduction(reducer *r, const wt_reduction *options, wt_error *err)
{
    const wt_prony *from = r->from;
    const double first = log(from->frequency_min), last = log(from->frequency_max);
    const double decades = (last - first) / M_LN10;
    if (!(decades >= 0) || !isfinite(decades) || from->n == 0)
        return wt_fail(err, WT_E_MISSING,
                       "a series without terms or without a measured range of "
                       "frequencies cannot be reduced");
    r->n = (size_t)(POINTS * decades) + 8;
    r->most = options->terms > 0 ? options->terms : (size_t)(max_density * decades) + 3;
    r->initial_terms = (size_t)decades + 1;
    r->low = -last - faster;
    r->high = -first + slower;
    r->long_term = isnan(options->long_term) ? 0 : options->long_term;
    r->fitted = isnan(options->long_term) && from->equilibrium_modulus > 0;
    const size_t n = 2 * r->most + 1;
    r->x = arena_numbers(&r->memory, r->n);
    for (int q = 0; q < MODULI; q++) {
        r->y[q] = arena_numbers(&r->memory, r->n);
        r->weight[q] = arena_numbers(&r->memory, r->n);
        r->off[q] = arena_numbers(&r->memory, r->n);
        r->row[q] = arena_numbers(&r->memory, n);
    }
    r->unknown = arena_numbers(&r->memory, n);
    r->candidate = arena_numbers(&r->memory, n);
    r->best = arena_numbers(&r->memory, n);
    r->normal = arena_matrix(&r->memory, n, n);
    r->factor = arena_matrix(&r->memory, n, n);
    r->gradient = arena_vector(&r->memory, n);
    r->move = arena_vector(&r->memory, n);
    for (size_t k = 0; k < r->n; k++) {
        double modulus[MODULI];
        r->x[k] = first + (last - first) * (double)k / (double)(r->n - 1);
        prony_moduli(from, exp(r->x[k]), &modulus[STORAGE], &modulus[LOSS]);
        for (int q = 0; q < MODULI; q++)
            r->y[q][k] = log(modulus[q]);
        if (!isfinite(r->y[STORAGE][k]) || !isfinite(r->y[LOSS][k]))
            return wt_fail(err, WT_E_RANGE, "a modulus of the series is not positive");
    }
    return WT_OK;
}

void wt_prony_deviation(const wt_prony *from, const wt_prony *to, double deviation[2])
{
    const double first = log(from->frequency_min), last = log(from->frequency_max);
    const size_t n = (size_t)(CHECK_POINTS * (last - first) / M_LN10) + 2;
    deviation[0] = deviation[1] = 0;
    for (size_t k = 0; k < n; k++) {
        double is[MODULI], was[MODULI];
        const double w = exp(first + (last - first) * (double)k / (double)(n - 1));
        prony_moduli(to, w, &is[STORAGE], &is[LOSS]);
        prony_moduli(from, w, &was[STORAGE], &was[LOSS]);
        for (int q = 0; q < MODULI; q++)
            deviation[q] = fmax(deviation[q], fabs(is[q] / was[q] - 1));
    }
}

static void terms_to_series(const reducer *r, const double *best_terms, size_t terms, wt_prony *to)
{
    wt_prony made;
    wt_prony_alloc(&made, terms);
    for (size_t i = 0; i < terms; i++) {
        made.relaxation_time[i] = exp(best_terms[2 * i]);
        made.modulus[i] = exp(best_terms[2 * i + 1]);
    }
    made.equilibrium_modulus = r->fitted ? exp(best_terms[2 * terms]) : r->long_term;
    made.deformation = r->from->deformation;
    made.reference_temperature = r->from->reference_temperature;
    made.frequency_min = r->from->frequency_min;
    made.frequency_max = r->from->frequency_max;
    *to = made;
}

wt_status wt_prony_reduce(const wt_prony *from, const wt_reduction *options, wt_prony *to,
                          wt_error *err)
{
    if (from == NULL || to == NULL)
        return wt_fail(err, WT_E_ARG, "no series to reduce");
    const wt_reduction o = options != NULL ? *options : wt_reduction_defaults();
    reducer r = {.from = from};
    gsl_quiet();
    wt_status status = param_check(wt_reduction_params(), &o, err);
    if (status == WT_OK)
        status = prepare_reduction(&r, &o, err);
    if (status == WT_OK) {
        double *best_terms = arena_numbers(&r.memory, 2 * r.most + 1);
        size_t terms = o.terms;
        if (terms > 0) {
            spread_terms(&r, terms);
            (void)fit_terms(&r, 0);
            store_best_terms(&r, best_terms);
            terms = r.terms;
        } else {
            terms = fewest_terms(&r, o.error * (1 - interpolation_margin), best_terms);
        }
        terms_to_series(&r, best_terms, terms, to);
    }
    arena_free(&r.memory);
    return status;
}
