/* Does time-temperature superposition hold? The shifts that each modulus asks for by itself.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/shift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The two moduli disagree if their shifts are this many standard errors apart on average, and
 * somewhere by more than what counts as determined [decade]. */
static const double many_errors = 2.5;
static const double large_difference = 0.2;

/* Shifts of one modulus alone; a, covariance: [n], [2n * 2n] out. */
static wt_status fit_alone(const shift_joint *joint, int q, double *a, double *b,
                           double *covariance, double *scratch, wt_error *err)
{
    const size_t n = joint->set->n;
    shift_joint alone = *joint;
    memcpy(a, joint->a, n * sizeof *a);
    memcpy(b, joint->b, n * sizeof *b);
    alone.a = a;
    alone.b = b;
    alone.covariance_ab = covariance;
    alone.sigma_b = scratch;
    alone.correlation = scratch + n;
    alone.slope_noise = scratch + 2 * n;
    alone.n_outliers = NULL;
    alone.free_b = false;
    for (int m = 0; m < MODULI; m++)
        alone.use[m] = m == q;
    return shift_joint_fit(&alone, err);
}

wt_status shift_superposition(const shift_joint *joint, double floor, superposition_check *result,
                              wt_error *err)
{
    const size_t n = joint->set->n;
    double *numbers = calloc(6 * n + 8 * n * n, sizeof *numbers);
    superposition_check made = {0};
    wt_status status = WT_OK;

    if (numbers == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the superposition check");
    double *a[MODULI] = {numbers, numbers + n};
    double *b = numbers + 2 * n, *scratch = b + n;
    double *covariance[MODULI] = {scratch + 3 * n, scratch + 3 * n + 4 * n * n};
    for (int q = 0; q < MODULI && status == WT_OK; q++)
        status = fit_alone(joint, q, a[q], b, covariance[q], scratch, err);
    double square = 0.0;
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        if (!joint->placed[i] || i == joint->anchor)
            continue;
        const double difference = a[STORAGE][i] - a[LOSS][i];
        const size_t ii = i * 2 * n + i;
        const double variance = covariance[STORAGE][ii] + covariance[LOSS][ii];
        made.largest = fmax(made.largest, fabs(difference));
        square += difference * difference / (variance + 2.0 * floor * floor);
        made.n++;
    }
    if (made.n > 0)
        made.normalised = sqrt(square / (double)made.n);
    made.failed = made.normalised > many_errors && made.largest > large_difference;
    *result = made;
    free(numbers);
    return status;
}
