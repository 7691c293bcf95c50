/* Measured against predicted friction: the curve, its errors, the scatter, the verdict and the
 * likelihood, against independent values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "record/numerics/agreement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 6 };
static double log_velocity[N], value[N], measurement_variance[N], prediction_covariance[N * N];

static agreement_data data_of(size_t n)
{
    return (agreement_data){n, log_velocity, value, measurement_variance, prediction_covariance};
}

static void set_up(double level, double slope, double error, double shared)
{
    for (size_t i = 0; i < N; i++) {
        log_velocity[i] = -3 + 0.6 * (double)i;
        value[i] = level + slope * log_velocity[i];
        measurement_variance[i] = error * error;
        for (size_t k = 0; k < N; k++)
            prediction_covariance[i * N + k] = shared * shared;
    }
}

static agreement fitted(size_t n, size_t most_terms)
{
    agreement a;
    const agreement_data data = data_of(n);
    assert_int_equal(agreement_fit(&data, most_terms, &a, NULL), WT_OK);
    return a;
}

/* A line is found exactly, and an error that all steps share is not divided by their number. */
static void test_line(void **state)
{
    (void)state;
    set_up(0.3, 0.05, 0.01, 0.07);
    agreement a = fitted(N, 0);
    assert_int_equal(a.terms, 3);
    for (size_t i = 0; i < N; i++) {
        assert_true(fabs(a.fitted_value[i] - value[i]) < 1e-12);
        assert_true(a.error[i] > 0.07 && a.error[i] < hypot(0.07, 0.01));
    }
    assert_true(a.scatter < 1e-18);
    agreement_clear(&a);
    a = fitted(N, 1); /* plain mean with equal errors, except for the line, which then is scatter */
    double mean = 0;
    for (size_t i = 0; i < N; i++)
        mean += value[i] / N;
    assert_true(fabs(a.coefficient[0] - mean) < 1e-12);
    assert_true(a.scatter > 0);
    assert_true(isfinite(a.df[0]) && a.df[0] >= N - 1);
    agreement_clear(&a);
}

/* Mandel-Paule for equal errors: the scatter is the variance about the mean minus the stated
 * one. */
static void test_scatter(void **state)
{
    (void)state;
    static const double off[N] = {0.05, -0.04, 0.02, -0.06, 0.03, 0};
    double squares = 0;
    set_up(0, 0, 0.01, 0.2);
    for (size_t i = 0; i < N; i++) {
        value[i] = off[i];
        squares += off[i] * off[i];
    }
    agreement a = fitted(N, 1);
    assert_true(fabs(a.scatter - (squares / (N - 1) - 1e-4)) < 1e-9);
    const double variance = 0.04 + squares / (N - 1) / N;
    assert_true(fabs(a.error[0] / sqrt(variance) - 1) < 1e-9);
    agreement_clear(&a);
    /* scatter that the prediction explains does not count */
    for (size_t i = 0; i < N; i++)
        prediction_covariance[i * N + i] += 0.01;
    a = fitted(N, 1);
    assert_true(a.scatter < 1e-18);
    agreement_clear(&a);
}

static agreement_verdict verdict_for(double level, double slope, double error)
{
    set_up(level, slope, error, 0);
    agreement a = fitted(N, 0);
    agreement_assess(&a, 0.2);
    const agreement_verdict verdict = a.verdict;
    if (verdict == AGREEMENT_NO && slope < 0)
        assert_int_equal(a.deciding_step, 0);
    agreement_clear(&a);
    return verdict;
}

static void test_verdicts(void **state)
{
    (void)state;
    assert_int_equal(verdict_for(0, 0, 0.01), AGREEMENT_YES);
    assert_int_equal(verdict_for(0.19, 0, 0.01), AGREEMENT_INCONCLUSIVE);
    assert_int_equal(verdict_for(0.21, 0, 0.01), AGREEMENT_INCONCLUSIVE);
    assert_int_equal(verdict_for(-0.3, 0, 0.01), AGREEMENT_NO);
    assert_int_equal(verdict_for(0, 0, 0.5), AGREEMENT_INCONCLUSIVE);
    assert_int_equal(verdict_for(0, -0.2, 0.001), AGREEMENT_NO); /* 0.6 at the slowest velocity */
}

/* One velocity: a level, for any measured value; the interval of all steps is that of one. */
static void test_one_velocity(void **state)
{
    (void)state;
    double ends[2], at_once[2];
    set_up(0.1, 0, 0.02, 0.05);
    agreement a = fitted(1, 0);
    assert_int_equal(a.terms, 1);
    assert_true(isinf(a.df[0]));
    assert_true(fabs(a.error[0] - hypot(0.02, 0.05)) < 1e-12);
    agreement_interval(&a, 0, false, ends);
    agreement_interval(&a, 0, true, at_once);
    assert_true(fabs(ends[1] - at_once[1]) < 1e-6);
    assert_true(fabs(ends[1] - ends[0] - 2 * agreement_quantile((double)INFINITY) * a.error[0]) <
                1e-12);
    agreement_clear(&a);
}

static void test_nothing(void **state)
{
    (void)state;
    agreement a;
    wt_error err = WT_ERROR_INIT;
    const agreement_data data = data_of(0);
    assert_int_equal(agreement_fit(&data, 0, &a, &err), WT_E_EMPTY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),     cmocka_unit_test(test_scatter),
        cmocka_unit_test(test_verdicts), cmocka_unit_test(test_one_velocity),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
