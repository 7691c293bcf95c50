/* Computations for errors that nothing states: fit of a curve by a tip that is blunter than
 * stated, and Welch's t-test for a difference between the means of two groups of quantities other
 * than the modulus (adhesion, lack of fit).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "indentation/law/tip.h"
#include "weartrack/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

/* Depths of the curve, and steps of the search for the contact point: to 1e-6 of the depth. */
enum { NODES = 64, STEPS = 36 };

/* Weights of the residuals. Noise of the force also moves the tip, so that a residual counts less
 * by 1 + contact stiffness over spring constant. Samples are equidistant along the piezo, which
 * travels further than the tip by this factor. */
typedef struct worn_curve {
    const wt_contact_table *stated;
    double depth;                       /* largest depth of the equidistant nodes [m] */
    double force[NODES], travel[NODES]; /* 1 + contact stiffness over spring constant */
} worn_curve;

/* Returns the residual sum of squares with the contact point late by `shift`, and the modulus. */
static double wear_residual_squares(const worn_curve *c, double shift, double *modulus)
{
    double at[NODES], g[NODES], gg = 0, gf = 0, ff = 0;
    for (int i = 0; i < NODES; i++)
        at[i] = c->depth * (i + 1) / NODES - shift;
    wt_contact_table_eval(c->stated, at, NODES, g, NULL);
    for (int i = 0; i < NODES; i++) {
        const double weight = 1 / c->travel[i];
        gg += weight * g[i] * g[i];
        gf += weight * g[i] * c->force[i];
        ff += weight * c->force[i] * c->force[i];
    }
    *modulus = gf / gg;
    return fmax(0, ff - gf * gf / gg);
}

wt_status wt_tip_wear_fit(const wt_tip *tip, double radius, double depth, double bending,
                          wt_tip_wear *fit, wt_error *err)
{
    wt_contact_table *table = NULL;
    wt_tip worn = *tip;
    worn.radius = radius;
    worn.transition_radius = tip_default_transition(radius, tip->half_angle, tip->sides);
    wt_status status = wt_contact_table_new(tip, 1e-3 * depth, 2 * depth, &table, err);
    if (status != WT_OK)
        return status;
    worn_curve c = {.stated = table, .depth = depth};
    double samples = 0, slope, largest;
    wt_contact_function(&worn, depth, &largest, &slope);
    for (int i = 0; i < NODES; i++) {
        wt_contact_function(&worn, depth * (i + 1) / NODES, &c.force[i], &slope);
        c.travel[i] = 1 + bending * slope / largest;
        samples += c.travel[i];
    }
    double low = -depth / 2, high = depth / 2, modulus;
    for (int step = 0; step < STEPS; step++) { /* ternary search */
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (wear_residual_squares(&c, a, &modulus) < wear_residual_squares(&c, b, &modulus))
            high = b;
        else
            low = a;
    }
    const double left = wear_residual_squares(&c, 0.5 * (low + high), &modulus);
    *fit = (wt_tip_wear){log(modulus), sqrt(left / samples) / largest};
    wt_contact_table_free(table);
    return WT_OK;
}

typedef struct spot_value {
    long spot;
    double value;
} spot_value;

/* ---- means of two groups --------------------------------------------------------------------- */

static int compare_by_spot_and_value(const void *a, const void *b)
{
    const spot_value *x = a, *y = b;
    if (x->spot != y->spot)
        return x->spot < y->spot ? -1 : 1;
    return (x->value > y->value) - (x->value < y->value);
}

/* Computes the means of the spots, in the order of their numbers, and returns how many there are.
 * Values that are not finite are skipped. */
static size_t average_spots(const double *values, const long *spots, size_t n, arena *memory,
                            spot_value **result)
{
    size_t n_values = 0, n_spots = 0;
    spot_value *values_by_spot = arena_alloc(memory, n, sizeof *values_by_spot);
    spot_value *means = arena_alloc(memory, n, sizeof *means);
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i]))
            values_by_spot[n_values++] =
                (spot_value){spots != NULL ? spots[i] : (long)i, values[i]};
    qsort(values_by_spot, n_values, sizeof *values_by_spot, compare_by_spot_and_value);
    for (size_t from = 0, to; from < n_values; from = to) {
        double sum = 0;
        for (to = from; to < n_values && values_by_spot[to].spot == values_by_spot[from].spot; to++)
            sum += values_by_spot[to].value;
        means[n_spots++] = (spot_value){values_by_spot[from].spot, sum / (double)(to - from)};
    }
    *result = means;
    return n_spots;
}

/* Moments of the means of all spots but one. */
static moments other_moments(const spot_value *means, size_t n, size_t left_out, arena *memory)
{
    double *others = arena_numbers(memory, n);
    size_t kept = 0;
    for (size_t i = 0; i < n; i++)
        if (i != left_out)
            others[kept++] = means[i].value;
    return sample_moments(others, kept);
}

long wt_outlying_spot(const double *values, const long *spots, size_t n, double *p_value)
{
    enum { OTHERS = 3 }; /* smallest number that tells a scatter */
    arena memory = {0};
    spot_value *means;
    const size_t n_spots = average_spots(values, spots, n, &memory, &means);
    long farthest = 0;
    *p_value = 1;
    for (size_t i = 0; n_spots > OTHERS && i < n_spots; i++) {
        const moments m = other_moments(means, n_spots, i, &memory);
        const double t = fabs(means[i].value - m.mean) / sqrt(m.variance * (1 + 1 / m.n));
        const double p = 2 * (double)n_spots * gsl_cdf_tdist_Q(t, m.n - 1);
        if (p < *p_value) {
            *p_value = p;
            farthest = means[i].spot;
        }
    }
    arena_free(&memory);
    return farthest;
}

wt_mean_comparison wt_compare_means(const double *const values[2], const long *const spots[2],
                                    const size_t n[2])
{
    arena memory = {0};
    moments m[2];
    for (int g = 0; g < 2; g++) {
        spot_value *means;
        const size_t n_spots = average_spots(values[g], spots[g], n[g], &memory, &means);
        m[g] = other_moments(means, n_spots, n_spots, &memory);
    }
    arena_free(&memory);
    const t_error parts[] = {{sqrt(m[0].variance / m[0].n), m[0].n - 1},
                             {sqrt(m[1].variance / m[1].n), m[1].n - 1}};
    const t_error welch = t_error_sum(parts, COUNT_OF(parts));
    const double unknown = (double)NAN;
    wt_mean_comparison comparison = {
        {m[0].n > 0 ? m[0].mean : unknown, m[1].n > 0 ? m[1].mean : unknown}, {unknown, unknown}};
    if (!(fmin(m[0].n, m[1].n) > 1))
        return comparison;
    const double difference = m[1].mean - m[0].mean;
    if (!(welch.error > 0)) { /* without scatter the means are equal or different */
        comparison.larger_p[1] = difference > 0 ? 0 : 1;
        comparison.larger_p[0] = difference < 0 ? 0 : 1;
        return comparison;
    }
    comparison.larger_p[1] = gsl_cdf_tdist_Q(difference / welch.error, welch.df);
    comparison.larger_p[0] = gsl_cdf_tdist_P(difference / welch.error, welch.df);
    return comparison;
}

double wt_combined_p_value(double a, double b)
{
    if (isnan(a) || isnan(b))
        return isnan(a) ? b : a;
    const double product = a * b;
    return product > 0 ? product * (1 - log(product)) : 0;
}
