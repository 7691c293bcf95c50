/* Angular integrals: the closed form of the law, or Chebyshev series in ln w.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/angular.h"

#include "kernel/angular_integral.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COEFFICIENTS = 48, OUTSIDE_COEFFICIENTS = 16 };

/* Pieces end at the whole multiples of this in ln w and at the knots of the law. */
static const double piece_width = 2;
/* Two bounds closer than this are one. */
static const double same_bound = 1e-12;
/* Relative error at which a series is long enough. */
static const double series_goal = 64 * DBL_EPSILON;

/* To the right of a knot w_k both integrals have a (ln w - ln w_k)^(3/2) singularity: the series
 * there runs in sqrt(ln w - ln w_k). */
typedef struct series {
    double low, high; /* ln w */
    double anchor;    /* ln w_k, NaN = the series runs in ln w itself */
    double u_low, u_high;
    size_t n;
    double error; /* relative */
    double j1[COEFFICIENTS], j2[COEFFICIENTS];
} series;

/* int over the angles with w cos(phi) < limit of cos(phi) E'' is theta^2 times a smooth function
 * of theta = asin(limit / w). */
typedef struct outside_part {
    double limit; /* NaN = none */
    double coefficient[OUTSIDE_COEFFICIENTS];
} outside_part;

struct wt_angular {
    const wt_material *material;
    wt_angular_quadrature quadrature;
    size_t n;
    series *pieces; /* rising, without gaps */
    outside_part below, above;
};

static double chebyshev(const double *coefficient, size_t n, double z)
{
    double b1 = 0, b2 = 0;
    for (size_t k = n - 1; k > 0; k--) {
        const double b = 2 * z * b1 - b2 + coefficient[k];
        b2 = b1;
        b1 = b;
    }
    return z * b1 - b2 + coefficient[0];
}

static void chebyshev_fit(const double *value, size_t n, double *coefficient)
{
    for (size_t k = 0; k < n; k++) {
        double sum = 0;
        for (size_t j = 0; j < n; j++)
            sum += value[j] * cos(M_PI * (double)k * ((double)j + 0.5) / (double)n);
        coefficient[k] = sum * (k ? 2 : 1) / (double)n;
    }
}

/* ---- series ---------------------------------------------------------------------------------- */

static double series_coordinate(const series *s, double x)
{
    const double u = isnan(s->anchor) ? x : sqrt(fmax(0, x - s->anchor));
    const double z = (2 * u - s->u_low - s->u_high) / (s->u_high - s->u_low);
    return fmin(fmax(z, -1), 1);
}

static double series_omega(const series *s, double z)
{
    const double u = 0.5 * (s->u_low + s->u_high) + 0.5 * (s->u_high - s->u_low) * z;
    return exp(isnan(s->anchor) ? u : s->anchor + u * u);
}

/* Relative error from the end of the series. */
static double series_tail(const double *coefficient, const double *value, size_t n)
{
    double least = INFINITY, most = 0, tail = 0;
    for (size_t j = 0; j < n; j++) {
        least = fmin(least, fabs(value[j]));
        most = fmax(most, fabs(value[j]));
    }
    for (size_t k = n - 3; k < n; k++)
        tail = fmax(tail, fabs(coefficient[k]));
    return most == 0 ? 0 : 2 * tail / least;
}

static double relative(double value, double reference)
{
    return reference == value ? 0 : fabs(value - reference) / fabs(reference);
}

static void series_make(const wt_angular *a, series *s)
{
    static const size_t lengths[] = {12, 24, COEFFICIENTS};
    double j1[COEFFICIENTS], j2[COEFFICIENTS];
    for (size_t trial = 0; trial < sizeof lengths / sizeof *lengths; trial++) {
        s->n = lengths[trial];
        for (size_t j = 0; j < s->n; j++) {
            const double z = cos(M_PI * ((double)j + 0.5) / (double)s->n);
            wt_angular_integrate(&a->quadrature, series_omega(s, z), 1, 1, &j1[j], &j2[j]);
        }
        chebyshev_fit(j1, s->n, s->j1);
        chebyshev_fit(j2, s->n, s->j2);
        s->error = fmax(series_tail(s->j1, j1, s->n), series_tail(s->j2, j2, s->n));
        if (s->error <= series_goal)
            break;
    }
    /* The quadrature itself is checked with finer panels, between the nodes of the series. */
    static const double checks[] = {-0.83, 0.37};
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        double fine_j1, fine_j2;
        wt_angular_integrate(&a->quadrature, series_omega(s, checks[i]), 1, 2, &fine_j1, &fine_j2);
        s->error = fmax(s->error, relative(chebyshev(s->j1, s->n, checks[i]), fine_j1));
        s->error = fmax(s->error, relative(chebyshev(s->j2, s->n, checks[i]), fine_j2));
    }
}

static int compare(const void *left, const void *right)
{
    const double a = *(const double *)left;
    const double b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Makes the pieces from one multiple of piece_width to another into `out` (NULL: only counts). */
static size_t make_pieces(const wt_angular *a, long first, long last, double *bounds, series *out)
{
    size_t n = 0;
    for (long m = first; m <= last; m++)
        bounds[n++] = (double)m * piece_width;
    for (size_t k = 0; k < a->quadrature.n_breaks; k++) {
        const double x = log(a->quadrature.breaks[k]);
        if (x > bounds[0] && x < (double)last * piece_width)
            bounds[n++] = x;
    }
    qsort(bounds, n, sizeof *bounds, compare);
    size_t made = 0;
    for (size_t i = 1, from = 0; i < n; i++) {
        if (bounds[i] - bounds[from] < same_bound)
            continue;
        if (out) {
            series *s = &out[made];
            *s = (series){.low = bounds[from], .high = bounds[i], .anchor = NAN};
            for (size_t k = 0; k < a->quadrature.n_breaks; k++) {
                const double x = log(a->quadrature.breaks[k]);
                if (x <= s->low + same_bound && x > s->low - piece_width)
                    s->anchor = x;
            }
            s->u_low = isnan(s->anchor) ? s->low : sqrt(fmax(0, s->low - s->anchor));
            s->u_high = isnan(s->anchor) ? s->high : sqrt(s->high - s->anchor);
            series_make(a, s);
        }
        made++;
        from = i;
    }
    return made;
}

wt_status wt_angular_cover(wt_angular *angular, double w_min, double w_max, wt_error *err)
{
    if (angular->material->law->angular)
        return WT_OK;
    long first = (long)floor(log(w_min) / piece_width);
    long last = (long)ceil(log(w_max) / piece_width);
    if (last <= first)
        last = first + 1;
    long have_first = last, have_last = last; /* nothing yet */
    if (angular->n) {
        have_first = lround(angular->pieces[0].low / piece_width);
        have_last = lround(angular->pieces[angular->n - 1].high / piece_width);
        if (first >= have_first && last <= have_last)
            return WT_OK;
        first = first < have_first ? first : have_first;
        last = last > have_last ? last : have_last;
    }
    const size_t room = (size_t)(last - first) + 1 + angular->quadrature.n_breaks;
    double *bounds = calloc(room, sizeof *bounds);
    series *pieces = calloc(room, sizeof *pieces);
    if (!bounds || !pieces) {
        free(bounds);
        free(pieces);
        return wt_fail(err, WT_E_MEMORY, "out of memory for the angular integrals");
    }
    size_t n = make_pieces(angular, first, have_first, bounds, pieces);
    if (angular->n)
        memcpy(pieces + n, angular->pieces, angular->n * sizeof *pieces);
    n += angular->n;
    n += make_pieces(angular, have_last, last, bounds, pieces + n);
    free(bounds);
    free(angular->pieces);
    angular->pieces = pieces;
    angular->n = n;
    return WT_OK;
}

void wt_angular_eval(const wt_angular *angular, const double *w, size_t n, double *j1, double *j2)
{
    if (angular->material->law->angular) {
        angular->material->law->angular(angular->material, w, n, j1, j2);
        return;
    }
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        const double x = log(w[i]);
        while (k + 1 < angular->n && x > angular->pieces[k].high)
            k++;
        while (k > 0 && x < angular->pieces[k].low)
            k--;
        const series *s = &angular->pieces[k];
        const double z = series_coordinate(s, x);
        j1[i] = chebyshev(s->j1, s->n, z);
        j2[i] = chebyshev(s->j2, s->n, z);
    }
}

double wt_angular_error(const wt_angular *angular)
{
    double error = 0;
    for (size_t i = 0; i < angular->n; i++)
        error = fmax(error, angular->pieces[i].error);
    return error;
}

/* ---- the share of extrapolated frequencies --------------------------------------------------- */

static void outside_make(const wt_angular *a, double limit, outside_part *part)
{
    part->limit = limit > 0 && isfinite(limit) ? limit : (double)NAN;
    if (isnan(part->limit))
        return;
    double value[OUTSIDE_COEFFICIENTS];
    for (size_t j = 0; j < OUTSIDE_COEFFICIENTS; j++) {
        const double z = cos(M_PI * ((double)j + 0.5) / OUTSIDE_COEFFICIENTS);
        const double theta = M_PI_4 * (1 + z);
        double j1, j2;
        wt_angular_integrate(&a->quadrature, limit / sin(theta), sin(theta), 1, &j1, &j2);
        value[j] = j1 / (theta * theta);
    }
    chebyshev_fit(value, OUTSIDE_COEFFICIENTS, part->coefficient);
}

static double outside_below(const outside_part *part, double w, double j1)
{
    if (w <= part->limit)
        return j1;
    const double theta = asin(part->limit / w);
    return theta * theta * chebyshev(part->coefficient, OUTSIDE_COEFFICIENTS, theta / M_PI_4 - 1);
}

bool wt_angular_limited(const wt_angular *angular)
{
    return !isnan(angular->below.limit) || !isnan(angular->above.limit);
}

double wt_angular_outside(const wt_angular *angular, double w, double j1)
{
    double outside = 0;
    if (!isnan(angular->below.limit))
        outside += outside_below(&angular->below, w, j1);
    if (!isnan(angular->above.limit))
        outside += j1 - outside_below(&angular->above, w, j1);
    return fmin(fmax(outside, 0), j1);
}

wt_status wt_angular_new(const wt_material *material, wt_angular **angular, wt_error *err)
{
    wt_angular *made = calloc(1, sizeof *made);
    if (!made)
        return wt_fail(err, WT_E_MEMORY, "out of memory for the angular integrals");
    made->material = material;
    const wt_status status = wt_angular_quadrature_init(material, &made->quadrature, err);
    if (status != WT_OK) {
        free(made);
        return status;
    }
    outside_make(made, material->frequency_min, &made->below);
    outside_make(made, material->frequency_max, &made->above);
    *angular = made;
    return WT_OK;
}

void wt_angular_free(wt_angular *angular)
{
    if (!angular)
        return;
    wt_angular_quadrature_clear(&angular->quadrature);
    free(angular->pieces);
    free(angular);
}
