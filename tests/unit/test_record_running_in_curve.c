/* Time of a course by least squares: an exponential with and without scatter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "record/numerics/running_in_curve.h"

#include <math.h>

enum { N = 400 };
static running_in_mean mean[N];

/* A change that is over in the first mean, and an exponential of 50 s. */
static double course(const void *user, double time)
{
    (void)user;
    return 0.3 - 0.05 * exp(-time / 50) + 0.1 * exp(-time / 3);
}

/* Exact means over 5 s of the course in `factor` times its time, of any level and ratio. */
static void fill(double factor, double ratio, double scatter)
{
    const double slow = 50 * factor, fast = 3 * factor;
    for (size_t i = 0; i < N; i++) {
        const double from = 5.0 * (double)i, until = from + 5;
        mean[i] =
            (running_in_mean){from, until,
                              0.1 +
                                  ratio *
                                      (-0.05 * slow * (exp(-from / slow) - exp(-until / slow)) +
                                       0.1 * fast * (exp(-from / fast) - exp(-until / fast))) /
                                      5 +
                                  scatter * cos(2.4 * (double)i)};
    }
}

static void test_factor(void **state)
{
    (void)state;
    static const double factors[] = {0.3, 1, 4};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
        fill(factors[i], i == 1 ? -2 : 1, 1e-4);
        const wt_interval found = running_in_curve_factor(mean, N, course, NULL);
        assert_near(found.value, factors[i], 0.02 * factors[i]);
        assert_true(found.low < factors[i] && factors[i] < found.high);
        assert_near(
            running_in_curve_factor_between(mean, N, course, NULL, factors[i] / 4, factors[i] * 3),
            factors[i], 0.03 * factors[i]);
    }
}

/* A factor on a limit of the search is none. */
static void test_limit(void **state)
{
    (void)state;
    fill(4, 1, 0);
    assert_true(isnan(running_in_curve_factor_between(mean, N, course, NULL, 0.5, 2)));
}

static void test_scatter_alone(void **state)
{
    (void)state;
    fill(1, 0, 1e-3);
    assert_true(isnan(running_in_curve_factor(mean, N, course, NULL).value));
    assert_true(isnan(running_in_curve_factor(mean, 3, course, NULL).value));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_factor),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_scatter_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
