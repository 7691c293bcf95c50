/* Angular integrals: the closed form of the law, or Chebyshev series in ln w.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/angular.h"

#include "base/array.h"
#include "kernel/angular_integral.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { SHORT_SERIES = 12, COEFFICIENTS = 24, OUTSIDE_COEFFICIENTS = 16, MOST_CUTS = 10 };

/* Pieces end at the whole multiples of this in ln w and at the knots of the law. */
static const double piece_width = 2;
/* Two bounds closer than this are one. */
static const double same_bound = 1e-12;
/* Relative error at which a series is good enough; a piece with more is cut in two. */
static const double series_goal = 4e-14;

/* ln(J / scale) of J1 and J2 on a piece. To the right of a knot w_k both integrals have a
 * (ln w - ln w_k)^(3/2) singularity: the series there runs in sqrt(ln w - ln w_k). */
typedef struct series {
    double low, high; /* ln w */
    double anchor;    /* ln w_k, NaN = the series runs in ln w itself */
    double u_low, u_high;
    size_t n;
    double error;              /* relative */
    double scale_j1, scale_j2; /* J in the middle; 0 for J1 of an elastic material */
    double j1[COEFFICIENTS], j2[COEFFICIENTS];
} series;

typedef struct series_list {
    size_t n;
    series *items;
} series_list;

/* int over the angles with w cos(phi) < limit of cos(phi) E'' is theta^2 times a smooth function
 * of theta = asin(limit / w). */
typedef struct outside_part {
    double limit; /* NaN = none */
    double coefficient[OUTSIDE_COEFFICIENTS];
} outside_part;

struct angular_law {
    const wt_material *material;
    angular_quadrature quadrature;
    double slope, rounding;
    series_list pieces; /* rising, without gaps */
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

static double series_tail(const double *coefficient, size_t n)
{
    double tail = 0;
    for (size_t k = n - 3; k < n; k++)
        tail = fmax(tail, fabs(coefficient[k]));
    return 2 * tail;
}

/* Logarithms, so that the relative error is the same all over a piece. */
static void series_values(const angular_law *a, const series *s, double z, unsigned refine,
                          double *j1, double *j2)
{
    angular_integrate(&a->quadrature, series_omega(s, z), 1, refine, j1, j2);
    *j1 = s->scale_j1 > 0 ? log(*j1 / s->scale_j1) : 0;
    *j2 = log(*j2 / s->scale_j2);
}

static void series_fit(const angular_law *a, series *s, size_t n)
{
    double j1[COEFFICIENTS], j2[COEFFICIENTS];
    s->n = n;
    for (size_t j = 0; j < n; j++)
        series_values(a, s, cos(M_PI * ((double)j + 0.5) / (double)n), 1, &j1[j], &j2[j]);
    chebyshev_fit(j1, n, s->j1);
    chebyshev_fit(j2, n, s->j2);
    s->error = fmax(series_tail(s->j1, n), series_tail(s->j2, n));
}

/* Error of the series, also between its nodes. Against finer panels (refine 2) this holds the error
 * of the quadrature too. */
static double series_check(const angular_law *a, const series *s, unsigned refine)
{
    static const double checks[] = {-0.83, 0.37};
    double error = s->error;
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        double j1, j2;
        series_values(a, s, checks[i], refine, &j1, &j2);
        error = fmax(error, fabs(chebyshev(s->j1, s->n, checks[i]) - j1));
        error = fmax(error, fabs(chebyshev(s->j2, s->n, checks[i]) - j2));
    }
    return error;
}

static void series_make(const angular_law *a, series *s)
{
    angular_integrate(&a->quadrature, series_omega(s, 0), 1, 1, &s->scale_j1, &s->scale_j2);
    series_fit(a, s, SHORT_SERIES);
    if (series_check(a, s, 1) > series_goal)
        series_fit(a, s, COEFFICIENTS);
    s->error = series_check(a, s, 1);
}

static bool series_push(series_list *list, const series *s)
{
    series *items = array_grow(list->items, list->n, sizeof *items);
    if (items == NULL)
        return false;
    list->items = items;
    list->items[list->n++] = *s;
    return true;
}

/* The piece, or its halves where one series is not good enough: close knots, steep tables. */
static bool series_add(const angular_law *a, series_list *list, double low, double high,
                       double anchor, int cuts)
{
    series s = {.low = low, .high = high, .anchor = anchor, .u_low = low, .u_high = high};
    if (!isnan(anchor)) {
        s.u_low = sqrt(fmax(0, low - anchor));
        s.u_high = sqrt(high - anchor);
    }
    series_make(a, &s);
    if (s.error <= series_goal || cuts == MOST_CUTS) {
        s.error = series_check(a, &s, 2);
        return series_push(list, &s);
    }
    const double u = 0.5 * (s.u_low + s.u_high);
    const double middle = isnan(anchor) ? u : anchor + u * u;
    return series_add(a, list, low, middle, anchor, cuts + 1) &&
           series_add(a, list, middle, high, anchor, cuts + 1);
}

/* The nearest knot at or below x that a piece there must mind, or NaN. */
static double knot_before(const angular_law *a, double x)
{
    double anchor = (double)NAN;
    for (size_t k = 0; k < a->quadrature.n_breaks; k++) {
        const double knot = log(a->quadrature.breaks[k]);
        if (knot <= x + same_bound && knot > x - piece_width)
            anchor = knot;
    }
    return anchor;
}

/* Adds the pieces from one multiple of piece_width to another. */
static bool add_pieces(const angular_law *a, long first, long last, double *bounds,
                       series_list *list)
{
    size_t n = 0;
    for (long m = first; m <= last; m++)
        bounds[n++] = (double)m * piece_width;
    for (size_t k = 0; k < a->quadrature.n_breaks; k++) {
        const double x = log(a->quadrature.breaks[k]);
        if (x > bounds[0] && x < (double)last * piece_width)
            bounds[n++] = x;
    }
    numbers_sort(bounds, n);
    for (size_t i = 1, from = 0; i < n; i++) {
        if (bounds[i] - bounds[from] < same_bound)
            continue;
        if (!series_add(a, list, bounds[from], bounds[i], knot_before(a, bounds[from]), 0))
            return false;
        from = i;
    }
    return true;
}

wt_status angular_cover(angular_law *angular, double w_min, double w_max, wt_error *err)
{
    if (angular->material->law->angular)
        return WT_OK;
    long first = (long)floor(log(w_min) / piece_width);
    long last = (long)ceil(log(w_max) / piece_width);
    if (last <= first)
        last = first + 1;
    const series_list *have = &angular->pieces;
    long have_first = last, have_last = last; /* nothing yet */
    if (have->n) {
        have_first = lround(have->items[0].low / piece_width);
        have_last = lround(have->items[have->n - 1].high / piece_width);
        if (first >= have_first && last <= have_last)
            return WT_OK;
        first = first < have_first ? first : have_first;
        last = last > have_last ? last : have_last;
    }
    series_list made = {0};
    double *bounds =
        calloc((size_t)(last - first) + 1 + angular->quadrature.n_breaks, sizeof *bounds);
    bool good = bounds && add_pieces(angular, first, have_first, bounds, &made);
    for (size_t i = 0; good && i < have->n; i++)
        good = series_push(&made, &have->items[i]);
    good = good && add_pieces(angular, have_last, last, bounds, &made);
    free(bounds);
    if (!good) {
        free(made.items);
        return wt_fail(err, WT_E_MEMORY, "out of memory for the angular integrals");
    }
    free(angular->pieces.items);
    angular->pieces = made;
    return WT_OK;
}

void angular_eval(const angular_law *angular, const double *w, size_t n, double *j1, double *j2)
{
    if (angular->material->law->angular) {
        angular->material->law->angular(angular->material, w, n, j1, j2);
        return;
    }
    const series_list *pieces = &angular->pieces;
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        const double x = log(w[i]);
        while (k + 1 < pieces->n && x > pieces->items[k].high)
            k++;
        while (k > 0 && x < pieces->items[k].low)
            k--;
        const series *s = &pieces->items[k];
        const double z = series_coordinate(s, x);
        j1[i] = s->scale_j1 > 0 ? s->scale_j1 * exp(chebyshev(s->j1, s->n, z)) : 0;
        j2[i] = s->scale_j2 * exp(chebyshev(s->j2, s->n, z));
    }
}

double angular_error(const angular_law *angular)
{
    double error = 0;
    for (size_t i = 0; i < angular->pieces.n; i++)
        error = fmax(error, angular->pieces.items[i].error);
    return error + angular->rounding;
}

double angular_slope(const angular_law *angular)
{
    return angular->slope;
}

/* A modulus is the exponential of a logarithm interpolated at a logarithm: what these lose by
 * rounding is multiplied by its slope. The frequencies may lie outside the knots. */
static void rounding_make(angular_law *a)
{
    double steepest = 1, farthest = 50, largest = 0, last[3];
    if (a->material->law->angular) {
        a->slope = 1;
        return;
    }
    for (size_t i = 0; i < a->quadrature.n_breaks; i++) {
        const double omega = a->quadrature.breaks[i];
        double e[2];
        a->material->law->modulus(a->material, &omega, 1, &e[0], &e[1]);
        const double now[] = {log(omega), log(e[0]), log(e[1])};
        farthest = fmax(farthest, fabs(now[0]));
        for (size_t k = 1; k < 3; k++) {
            largest = fmax(largest, fabs(now[k]));
            if (i > 0)
                steepest = fmax(steepest, fabs((now[k] - last[k]) / (now[0] - last[0])));
            last[k] = now[k];
        }
        last[0] = now[0];
    }
    a->slope = steepest;
    /* twice, for |E|^2 */
    a->rounding = 2 * DBL_EPSILON * (4 + largest + 2 * steepest * farthest);
}

/* ---- the share of extrapolated frequencies --------------------------------------------------- */

static void outside_make(const angular_law *a, double limit, outside_part *part)
{
    part->limit = limit > 0 && isfinite(limit) ? limit : (double)NAN;
    if (isnan(part->limit))
        return;
    double value[OUTSIDE_COEFFICIENTS];
    for (size_t j = 0; j < OUTSIDE_COEFFICIENTS; j++) {
        const double z = cos(M_PI * ((double)j + 0.5) / OUTSIDE_COEFFICIENTS);
        const double theta = M_PI_4 * (1 + z);
        double j1, j2;
        angular_integrate(&a->quadrature, limit / sin(theta), sin(theta), 1, &j1, &j2);
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

bool angular_limited(const angular_law *angular)
{
    return !isnan(angular->below.limit) || !isnan(angular->above.limit);
}

double angular_outside(const angular_law *angular, double w, double j1)
{
    double outside = 0;
    if (!isnan(angular->below.limit))
        outside += outside_below(&angular->below, w, j1);
    if (!isnan(angular->above.limit))
        outside += j1 - outside_below(&angular->above, w, j1);
    return fmin(fmax(outside, 0), j1);
}

wt_status angular_new(const wt_material *material, pool *memory, angular_law **angular,
                      wt_error *err)
{
    angular_law *made = pool_alloc(memory, 1, sizeof *made);
    if (made == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for the angular integrals");
    made->material = material;
    const wt_status status = angular_quadrature_init(material, memory, &made->quadrature, err);
    if (status != WT_OK)
        return status;
    rounding_make(made);
    outside_make(made, material->frequency_min, &made->below);
    outside_make(made, material->frequency_max, &made->above);
    *angular = made;
    return WT_OK;
}

void angular_clear(angular_law *angular)
{
    if (angular != NULL)
        free(angular->pieces.items);
}
