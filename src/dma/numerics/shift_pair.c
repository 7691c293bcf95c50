/* Shift between two neighbouring isotherms: least squares over their overlap on a grid, with
 * both moduli, both directions and a fitted vertical shift. It starts the joint fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/isotherm.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>

/* These values only set the start of the joint fit and affect no reported number. Minimum shared
 * range of ordinates [decade]: 12 %, beyond noise and clamping. */
static const double least_overlap = 0.05;
/* A point outside the overlap counts with this residual [decade]. A smaller residual favours
 * more overlap, a larger one less residual. At half this value noise of 5 % is taken for a wrong
 * position. */
static const double indifferent_residual = 0.05;
/* Residuals below this are equally good [decade]: 0.7 %, the noise of a good rheometer. */
static const double equal_residual = 0.003;

/* Number of tested shifts over the range of overlap: 40 per decade for ten decades. */
enum { GRID = 400 };

struct pair {
    const shift_curve *p, *s;
    const bool *used; /* [MODULI] */
    bool free_b;
    double fixed_b;
};

struct overlap {
    size_t n[MODULI];
    double sum, square; /* sums over the gaps y_p - y_s */
};

/* Adds the gaps y_onto(x + a) - y_from(x) times `sign` for the points of `from` within `onto`.
 * Both abscissas rise, so one pass over `onto` suffices. */
static void add_pair_gaps(const shift_curve *onto, const shift_curve *from, const bool *used,
                          double a, double sign, double pivot, struct overlap *sum)
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
            if (!used[q])
                continue;
            const double y = onto->y[q][k] + share * (onto->y[q][k + 1] - onto->y[q][k]);
            const double gap = sign * (y - from->y[q][i]) - pivot;
            sum->n[q]++;
            sum->sum += gap;
            sum->square += gap * gap;
        }
    }
}

static struct overlap overlap_sums(const struct pair *pair, double a)
{
    struct overlap sum = {0};
    add_pair_gaps(pair->p, pair->s, pair->used, a, 1.0, pair->fixed_b, &sum);
    add_pair_gaps(pair->s, pair->p, pair->used, -a, -1.0, pair->fixed_b, &sum);
    return sum;
}

/* Returns the mean square residual; *b: the corresponding vertical shift. */
static double mean_square(const struct pair *pair, const struct overlap *sum, double *b)
{
    const double n = (double)(sum->n[STORAGE] + sum->n[LOSS]);
    const double mean = sum->sum / n;
    *b = pair->fixed_b + (pair->free_b ? mean : 0.0);
    return fmax(sum->square / n - (pair->free_b ? mean * mean : 0.0), 0.0);
}

/* Returns the log likelihood relative to residuals of `indifferent_residual` at all points;
 * smaller is better. The plain mean square would prefer a chance match of a few end points. */
static double pair_cost(const struct overlap *sum, double square)
{
    const double n = (double)(sum->n[STORAGE] + sum->n[LOSS]);
    return n * log((square + equal_residual * equal_residual) /
                   (indifferent_residual * indifferent_residual));
}

/* Returns true if the ordinates overlap by a twentieth of a decade, or a quarter of the flatter
 * curve. E'' is not monotonic, so E' decides if available. */
static bool ordinates_overlap(const struct pair *pair)
{
    const int q = pair->used[STORAGE] ? STORAGE : LOSS;
    double low[2], high[2];
    const shift_curve *curve[2] = {pair->p, pair->s};
    for (int c = 0; c < 2; c++)
        gsl_stats_minmax(&low[c], &high[c], curve[c]->y[q], 1, curve[c]->n);
    const double shared = fmin(high[0], high[1]) - fmax(low[0], low[1]);
    const double flatter = fmin(high[0] - low[0], high[1] - low[1]);
    return shared > 0.0 && shared >= fmin(least_overlap, 0.25 * flatter);
}

/* Returns true if enough points lie on the other curve. */
static bool has_enough_overlap(const struct pair *pair, const struct overlap *sum)
{
    bool enough = true;
    for (int q = 0; q < MODULI; q++)
        enough = enough && (!pair->used[q] || sum->n[q] >= SHIFT_MIN_POINTS);
    return enough;
}

bool shift_pair_fit(const shift_set *set, size_t onto, size_t from, bool free_b, double *a,
                    double *b)
{
    const shift_curve *p = &set->curves[onto], *s = &set->curves[from];
    const struct pair pair = {p, s, set->used, free_b, free_b ? 0.0 : *b};
    if (p->n < SHIFT_MIN_POINTS || s->n < SHIFT_MIN_POINTS || !ordinates_overlap(&pair))
        return false;
    const double lowest = p->x[0] - s->x[s->n - 1], highest = p->x[p->n - 1] - s->x[0];
    const double step = (highest - lowest) / GRID;
    double best_cost = HUGE_VAL, least_square = HUGE_VAL, closest = 0.0, b_closest = 0.0;
    for (int g = 1; g < GRID; g++) {
        const struct overlap sum = overlap_sums(&pair, lowest + g * step);
        if (!has_enough_overlap(&pair, &sum))
            continue;
        double vertical;
        const double square = mean_square(&pair, &sum, &vertical);
        const double cost = pair_cost(&sum, square);
        if (cost < best_cost) {
            best_cost = cost;
            *a = lowest + g * step;
            *b = vertical;
        }
        if (square < least_square) {
            least_square = square;
            closest = lowest + g * step;
            b_closest = vertical;
        }
    }
    /* if no shift fits within `indifferent_residual` the cost favours few points */
    if (best_cost >= 0.0) {
        *a = closest;
        *b = b_closest;
    }
    return best_cost < HUGE_VAL;
}
