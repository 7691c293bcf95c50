/* Isotherms that do not belong to the others: one whose E'' is off, and one whose frequencies have
 * another unit. What is off is left out and named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/clocale.h"

#include <math.h>
#include <stdlib.h>

/* Minimum number of isotherms that remain. With three, any one of them may be the wrong one. */
enum { LEAST_LEFT = 4 };

/* ---- an isotherm whose E'' is off ------------------------------------------------------------ */

/* The smallest gap that is named [ln], its significance in standard errors, and the share of it up
 * to which the other isotherms agree. A material that changes with temperature parts them by
 * similar gaps from one isotherm to the next. */
static const double least_gap = 0.03, gap_significance = 4.0, agreement = 0.3;
enum { LEAST_PAIRS = 3 };

/* Computes by how much E'' of isotherm i exceeds that of isotherm j at equal E' [ln], which no
 * horizontal shift changes, and its standard error. NaN: they share too few points. */
static double loss_gap(const master_work *work, size_t i, size_t j, double *error)
{
    const shift_curve *s = &work->set.curves[i], *p = &work->set.curves[j];
    const double b = work->physical[i] - work->physical[j];
    double sum = 0.0, square = 0.0;
    size_t n = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double y = s->y[STORAGE][k] + b;
        size_t m = 1;
        while (m < p->n && !(y >= p->y[STORAGE][m - 1] && y < p->y[STORAGE][m]))
            m++;
        if (m >= p->n)
            continue;
        const double *const e = p->y[STORAGE] + m - 1, *const loss = p->y[LOSS] + m - 1;
        const double off =
            s->y[LOSS][k] + b - loss[0] - (y - e[0]) / (e[1] - e[0]) * (loss[1] - loss[0]);
        sum += off * M_LN10;
        square += off * off * M_LN10 * M_LN10;
        n++;
    }
    const double mean = sum / (double)n;
    *error = sqrt(fmax(square / (double)n - mean * mean, 0.0) / ((double)n - 1.0));
    return n >= LEAST_PAIRS ? mean : (double)NAN;
}

/* Returns the gap of isotherm list[k] to both neighbours, or 0 if it does not object: the gaps must
 * have one sign, the neighbours agree with each other, and so do all other isotherms. */
static double objection(const master_work *work, const size_t *list, size_t n, size_t k)
{
    double error[3];
    const double cold = loss_gap(work, list[k], list[k - 1], &error[0]),
                 warm = loss_gap(work, list[k], list[k + 1], &error[1]);
    const double least = fmin(fabs(cold), fabs(warm));
    if (!(cold * warm > 0.0 && fabs(cold) > gap_significance * error[0] &&
          fabs(warm) > gap_significance * error[1] && least > least_gap &&
          fabs(loss_gap(work, list[k - 1], list[k + 1], &error[2])) < agreement * least))
        return 0.0;
    for (size_t i = 1; i < n; i++)
        if (i != k && i != k + 1 &&
            fabs(loss_gap(work, list[i - 1], list[i], &error[0])) - 2.0 * error[0] >
                agreement * least)
            return 0.0;
    return 0.5 * (cold + warm);
}

bool master_misfits(const master_work *work)
{
    return work->is_gross || master_misfit_is_significant(&work->lack) ||
           master_loss_is_inconsistent(&work->lack);
}

bool master_find_objecting(master_work *work, size_t *found)
{
    size_t n = 0, *list = wt_alloc(work->set.n, sizeof *list);
    double gap = 0.0;
    for (size_t i = 0; work->set.quantity == WT_SHIFT_MODULI && i < work->set.n; i++)
        if (work->set.curves[i].n >= SHIFT_MIN_POINTS)
            list[n++] = i;
    for (size_t k = 1; n > LEAST_LEFT && k + 1 < n && gap == 0.0; k++) {
        gap = objection(work, list, n, k);
        *found = list[k];
    }
    free(list);
    if (gap != 0.0)
        clocale_print(work->set.curves[*found].exclusion, sizeof work->set.curves[*found].exclusion,
                      "its E'' is left out: it is %+.0f %% off what E' and the others demand",
                      100.0 * expm1(gap));
    return gap != 0.0;
}

/* ---- an isotherm with another unit of frequency ---------------------------------------------- */

/* Tolerance of a shift by 2 pi, and largest deviation of the other isotherms from their neighbours
 * [decade]. */
static const double unit_tolerance = 0.12, smooth_deviation = 0.15;

/* Returns the deviation of the shift of isotherm `list[k]` from the cubic through two isotherms on
 * either side, or the parabola through three at the ends of the list. NaN: no neighbour on one
 * side. */
static double deviation_from_neighbours(const master_work *work, const size_t *list, size_t n,
                                        size_t k)
{
    const size_t first = k >= 2 ? k - 2 : 0, last = k + 2 < n ? k + 2 : n - 1;
    const double t = work->set.curves[list[k]].temperature;
    double expected = 0.0;
    if (k == 0 || k + 1 >= n)
        return (double)NAN;
    for (size_t i = first; i <= last; i++) {
        double weight = 1.0;
        const double ti = work->set.curves[list[i]].temperature;
        for (size_t j = first; j <= last; j++)
            if (j != i && j != k) {
                const double tj = work->set.curves[list[j]].temperature;
                weight *= (t - tj) / (ti - tj);
            }
        if (i != k)
            expected += weight * spectrum_a(work->s, work->curve[list[i]]) / M_LN10;
    }
    return spectrum_a(work->s, work->curve[list[k]]) / M_LN10 - expected;
}

/* Returns the largest deviation of any isotherm but `without` from its neighbours. */
static double largest_deviation(const master_work *work, const size_t *list, size_t n,
                                size_t without, size_t *others)
{
    size_t m = 0;
    double most = 0.0;
    for (size_t k = 0; k < n; k++)
        if (k != without)
            others[m++] = list[k];
    for (size_t k = 1; k + 1 < m; k++) {
        const double off = fabs(deviation_from_neighbours(work, others, m, k));
        most = off <= most ? most : off; /* two isotherms of one temperature have no deviation */
    }
    return most;
}

bool master_find_unit_slip(master_work *work, size_t *found)
{
    const double two_pi = log10(2.0 * M_PI);
    size_t n = 0, *list = wt_alloc(2 * work->set.n, sizeof *list), *others = list + work->set.n;
    double least = smooth_deviation;
    *found = work->set.n;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i] && !work->set.curves[i].is_shift_fixed)
            list[n++] = i;
    for (size_t k = 1; n > LEAST_LEFT + 1 && k + 1 < n; k++) {
        const double off = deviation_from_neighbours(work, list, n, k);
        if (!(fabs(fabs(off) - two_pi) <= unit_tolerance))
            continue;
        const double rest = largest_deviation(work, list, n, k, others);
        if (!(rest < least))
            continue;
        least = rest;
        *found = list[k];
        clocale_print(work->set.curves[*found].exclusion, sizeof work->set.curves[*found].exclusion,
                      "left out: its frequencies are %.2f decade off, as 2 pi: %s", fabs(off),
                      off < 0.0 ? "rad/s read as Hz" : "Hz read as rad/s");
    }
    free(list);
    return *found < work->set.n;
}
