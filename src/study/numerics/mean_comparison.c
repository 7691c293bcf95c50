/* Welch's t-test for a difference between the means of two groups, for quantities other than the
 * modulus: adhesion, lack of fit. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/arena.h"
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "weartrack/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

typedef struct spot_value {
    long spot;
    double value;
} spot_value;

static int compare_by_spot_and_value(const void *a, const void *b)
{
    const spot_value *x = a, *y = b;
    if (x->spot != y->spot)
        return x->spot < y->spot ? -1 : 1;
    return (x->value > y->value) - (x->value < y->value);
}

/* Returns the moments of the means of the spots. Values that are not finite are skipped. */
static moments spot_mean_moments(const double *values, const long *spots, size_t n, arena *memory)
{
    size_t n_values = 0, n_spots = 0;
    spot_value *values_by_spot = arena_alloc(memory, n, sizeof *values_by_spot);
    double *means = arena_numbers(memory, n);
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i]))
            values_by_spot[n_values++] =
                (spot_value){spots != NULL ? spots[i] : (long)i, values[i]};
    qsort(values_by_spot, n_values, sizeof *values_by_spot, compare_by_spot_and_value);
    for (size_t from = 0, to; from < n_values; from = to) {
        double sum = 0;
        for (to = from; to < n_values && values_by_spot[to].spot == values_by_spot[from].spot; to++)
            sum += values_by_spot[to].value;
        means[n_spots++] = sum / (double)(to - from);
    }
    return sample_moments(means, n_spots);
}

wt_mean_comparison wt_compare_means(const double *const values[2], const long *const spots[2],
                                    const size_t n[2])
{
    arena memory = {0};
    moments m[2];
    for (int g = 0; g < 2; g++)
        m[g] = spot_mean_moments(values[g], spots[g], n[g], &memory);
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
