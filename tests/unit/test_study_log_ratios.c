/* Comparison of two ratios and of several: by hand, without a result, and coverage of the interval
 * for ratios from four positions each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static void by_hand(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    /* 0.3 / hypot(0.03, 0.04) = 6; freedom 0.05^4 / (0.03^4/5 + 0.04^4/3) */
    wt_log_ratio_difference d =
        wt_log_ratio_compare(&(wt_log_ratio){0.5, 0.03, 5}, &(wt_log_ratio){0.2, 0.04, 3});
    assert_near(d.value, 0.3, 1e-15);
    assert_near(d.df, 6.155613919894945, 1e-12);
    /* integral of Student's density from another program */
    assert_near(d.p, 8.779878336e-4, 1e-9);
    assert_near(d.high - d.value, d.value - d.low, 1e-15);
    /* normal errors */
    d = wt_log_ratio_compare(&(wt_log_ratio){0, 0.03, nan}, &(wt_log_ratio){0.1, 0.04, nan});
    assert_true(isnan(d.df));
    assert_near(d.p, 0.04550026389635842, 1e-13);
    assert_near(d.high, -0.1 + 0.05 * 1.959963984540054, 1e-13);
    assert_near(d.low, -0.1 - 0.05 * 1.959963984540054, 1e-13);
    /* one of each: the degrees of freedom are those of the other's share */
    d = wt_log_ratio_compare(&(wt_log_ratio){0, 0.03, 4}, &(wt_log_ratio){0.1, 0.04, nan});
    assert_near(d.df, 4 * pow(0.05 / 0.03, 4), 1e-10);
    /* exchanged: the opposite sign and the same p value */
    const wt_log_ratio_difference e =
        wt_log_ratio_compare(&(wt_log_ratio){0.1, 0.04, nan}, &(wt_log_ratio){0, 0.03, 4});
    assert_near(e.low, -d.high, 0);
    assert_near(e.p, d.p, 0);
}

static void no_answer(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const wt_log_ratio known = {0.1, 0.02, 5};
    const wt_log_ratio odd[] = {{nan, 0.02, 5}, {0.1, nan, 5}, {(double)INFINITY, 0.02, 5}};
    for (size_t i = 0; i < 3; i++) {
        const wt_log_ratio_difference d = wt_log_ratio_compare(&known, &odd[i]);
        assert_true(isnan(d.p) && isnan(d.low) && isnan(d.high));
    }
    /* zero errors do not show a difference of zero */
    const wt_log_ratio exact = {0.1, 0, nan};
    assert_true(isnan(wt_log_ratio_compare(&exact, &exact).p));
}

/* splitmix64, and the sum of twelve. */
static double draw(uint64_t *state)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
        z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
        sum += (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    return sum;
}

/* A ratio as from compare: logarithms at n positions of the track minus those of n in the bulk. */
static wt_log_ratio observe(double truth, double scatter, size_t n, uint64_t *seed)
{
    double mean[2] = {truth, 0}, squares = 0;
    for (int g = 0; g < 2; g++) {
        double sum = 0, sum_2 = 0;
        for (size_t i = 0; i < n; i++) {
            const double x = scatter * draw(seed);
            sum += x;
            sum_2 += x * x;
        }
        mean[g] += sum / (double)n;
        squares += (sum_2 - sum * sum / (double)n) / (double)((n - 1) * n);
    }
    return (wt_log_ratio){mean[0] - mean[1], sqrt(squares), 2 * (double)(n - 1)};
}

static void coverage(void **state)
{
    (void)state;
    enum { TRIALS = 4000 };
    uint64_t seed = 7;
    size_t held = 0, false_yes = 0;
    for (int i = 0; i < TRIALS; i++) {
        const wt_log_ratio a = observe(-0.4, 0.05, 4, &seed), b = observe(-0.4, 0.15, 3, &seed);
        const wt_log_ratio_difference d = wt_log_ratio_compare(&a, &b);
        held += d.low <= 0 && 0 <= d.high;
        false_yes += d.p < 0.05;
    }
    assert_true(held + false_yes == TRIALS);
    const double share = (double)held / TRIALS;
    assert_true(share > 0.94 && share < 0.965);
}

/* Two normal values: the squared distance over the sum of the variances. */
static void several_by_hand(void **state)
{
    (void)state;
    const wt_log_ratio of[] = {{1, 0.1, (double)NAN}, {1.3, 0.2, (double)NAN}};
    assert_near(wt_log_ratio_test(of, 2), gsl_cdf_chisq_Q(0.09 / 0.05, 1), 1e-12);
}

/* Four means with different scatter and one true value: the test finds a difference in 5 %, with
 * the error of its correction and three binomial errors. */
static void several_alike(void **state)
{
    (void)state;
    enum { TRIALS = 4000 };
    uint64_t seed = 11;
    for (size_t n = 3; n <= 10; n += 7) {
        size_t different = 0;
        for (int i = 0; i < TRIALS; i++) {
            const wt_log_ratio of[] = {observe(0.3, 0.1, n, &seed), observe(0.3, 0.1, n, &seed),
                                       observe(0.3, 0.3, n, &seed), observe(0.3, 0.5, n, &seed)};
            different += wt_log_ratio_test(of, 4) < 0.05;
        }
        assert_in_range(different, 0.035 * TRIALS, 0.075 * TRIALS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),       cmocka_unit_test(no_answer),
        cmocka_unit_test(coverage),      cmocka_unit_test(several_by_hand),
        cmocka_unit_test(several_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
