/* The shift between two neighbouring isotherms: least squares over their overlap, both moduli, both
 * directions, vertical shift projected out. The start of the joint fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/gsl_quiet.h"
#include "fit/shift.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

/* Shared range of ordinates below which two curves do not overlap [decade]. */
static const double least_overlap = 0.05;
/* A point outside the overlap counts as one that is off by this much: what a shift that uses few
 * points has to beat. Below it, more overlap wins; above it, less residual. [decade] */
static const double indifferent_residual = 0.05;
/* Residuals below this are equally good [decade]. */
static const double equal_residual = 0.003;

enum { GRID = 400 };

struct pair {
    const shift_curve *p, *s;
    bool free_b;
    double fixed_b;
};

struct overlap {
    size_t n[MODULI];
    double sum, square; /* of the gaps y_p - y_s */
};

/* Gaps y_onto(x + a) - y_from(x) times `sign` for the points of `from` that fall on `onto`. Both
 * abscissas rise, so one pass over `onto` is enough. */
static void add_gaps(const shift_curve *onto, const shift_curve *from, double a, double sign,
                     double pivot, struct overlap *sum)
{
    size_t k = 0;
    for (size_t i = 0; i < from->n; i++) {
        const double x = from->x[i] + a;
        if (x < onto->x[0])
            continue;
        if (x > onto->x[onto->n - 1])
            return;
        while (k + 2 < onto->n && onto->x[k + 1] < x)
            k++;
        const double width = onto->x[k + 1] - onto->x[k];
        const double share = width > 0.0 ? (x - onto->x[k]) / width : 0.5;
        for (int q = 0; q < MODULI; q++) {
            const double y = onto->y[q][k] + share * (onto->y[q][k + 1] - onto->y[q][k]);
            const double gap = sign * (y - from->y[q][i]) - pivot;
            sum->n[q]++;
            sum->sum += gap;
            sum->square += gap * gap;
        }
    }
}

static struct overlap overlap_at(const struct pair *pair, double a)
{
    struct overlap sum = {0};
    add_gaps(pair->p, pair->s, a, 1.0, pair->fixed_b, &sum);
    add_gaps(pair->s, pair->p, -a, -1.0, pair->fixed_b, &sum);
    return sum;
}

/* Mean square residual; b is the vertical shift that belongs to it. */
static double mean_square(const struct pair *pair, const struct overlap *sum, double *b)
{
    const double n = (double)(sum->n[STORAGE] + sum->n[LOSS]);
    const double mean = sum->sum / n;
    *b = pair->fixed_b + (pair->free_b ? mean : 0.0);
    return fmax(sum->square / n - (pair->free_b ? mean * mean : 0.0), 0.0);
}

static bool enough(const struct overlap *sum)
{
    return sum->n[STORAGE] >= SHIFT_MIN_POINTS && sum->n[LOSS] >= SHIFT_MIN_POINTS;
}

/* Log likelihood lost against all points lying off by `indifferent_residual`; smaller is better.
 * The plain mean square would prefer a chance match of a few points at the ends. */
static double cost_of(const struct overlap *sum, double square)
{
    const double n = (double)(sum->n[STORAGE] + sum->n[LOSS]);
    return n * log((square + equal_residual * equal_residual) /
                   (indifferent_residual * indifferent_residual));
}

static double mean_square_at(double a, void *parameters)
{
    const struct pair *pair = parameters;
    const struct overlap sum = overlap_at(pair, a);
    double b;
    return enough(&sum) ? mean_square(pair, &sum, &b) : HUGE_VAL;
}

/* Refines a grid minimum; keeps `a` if the neighbours do not bracket one. */
static double refine(struct pair *pair, double a, double step, gsl_min_fminimizer *minimiser)
{
    gsl_function function = {mean_square_at, pair};
    if (gsl_min_fminimizer_set(minimiser, &function, a, a - step, a + step) != GSL_SUCCESS)
        return a;
    for (int i = 0; i < 60; i++) {
        if (gsl_min_fminimizer_iterate(minimiser) != GSL_SUCCESS)
            break;
        if (gsl_min_test_interval(gsl_min_fminimizer_x_lower(minimiser),
                                  gsl_min_fminimizer_x_upper(minimiser), 1e-5, 0.0) == GSL_SUCCESS)
            break;
    }
    return gsl_min_fminimizer_x_minimum(minimiser);
}

/* Shared range of ordinates, and whether it is enough: a twentieth of a decade, or a quarter
 * of the flatter curve (a plateau has no more to give). */
static bool ordinates_overlap(const shift_curve *p, const shift_curve *s, int q, double *shared)
{
    double low[2], high[2];
    const shift_curve *curve[2] = {p, s};
    for (int c = 0; c < 2; c++)
        gsl_stats_minmax(&low[c], &high[c], curve[c]->y[q], 1, curve[c]->n);
    *shared = fmax(fmin(high[0], high[1]) - fmax(low[0], low[1]), 0.0);
    const double flatter = fmin(high[0] - low[0], high[1] - low[1]);
    return *shared >= fmin(least_overlap, 0.25 * flatter) && *shared > 0.0;
}

wt_status shift_pair_fit(const shift_curve *p, const shift_curve *s, bool free_b, double fixed_b,
                         shift_pair *result, wt_error *err)
{
    struct pair pair = {p, s, free_b, free_b ? 0.0 : fixed_b};
    *result = (shift_pair){0};
    gsl_quiet();
    if (p->n < SHIFT_MIN_POINTS || s->n < SHIFT_MIN_POINTS)
        return WT_OK;
    const bool storage = ordinates_overlap(p, s, STORAGE, &result->overlap[STORAGE]);
    (void)ordinates_overlap(p, s, LOSS, &result->overlap[LOSS]);
    /* E'' may turn back and meet anything; E' rises with frequency, so it decides. */
    if (!storage)
        return WT_OK;

    const double lowest = p->x[0] - s->x[s->n - 1], highest = p->x[p->n - 1] - s->x[0];
    const double step = (highest - lowest) / GRID;
    double best = 0.0, best_cost = HUGE_VAL;
    double closest = 0.0, least_square = HUGE_VAL;
    for (int g = 1; g < GRID; g++) {
        const double a = lowest + g * step;
        const struct overlap sum = overlap_at(&pair, a);
        if (!enough(&sum))
            continue;
        double b;
        const double square = mean_square(&pair, &sum, &b);
        const double cost = cost_of(&sum, square);
        if (cost < best_cost) {
            best_cost = cost;
            best = a;
        }
        if (square < least_square) {
            least_square = square;
            closest = a;
        }
    }
    if (!(best_cost < HUGE_VAL))
        return WT_OK;
    /* Nothing fits within `indifferent_residual`: the measure above would then favour few points.
     */
    if (best_cost >= 0.0)
        best = closest;
    gsl_min_fminimizer *minimiser = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (minimiser == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a minimiser");
    result->a = refine(&pair, best, step, minimiser);
    gsl_min_fminimizer_free(minimiser);
    const struct overlap sum = overlap_at(&pair, result->a);
    result->rms = sqrt(mean_square(&pair, &sum, &result->b));
    result->found = true;
    return WT_OK;
}
