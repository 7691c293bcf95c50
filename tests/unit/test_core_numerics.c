/* Bisection, golden section, small equations and moduli of a series: known values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "core/math/cholesky.h"
#include "core/math/root.h"
#include "dma/law/prony_law.h"

#include <float.h>
#include <math.h>

static bool below_root_two(double x, void *user)
{
    ++*(int *)user;
    return x * x < 2;
}

static bool below_step(double x, void *user)
{
    (void)user;
    return x < 0.3; /* a jump, and no value beyond it */
}

static void test_bisection(void **state)
{
    (void)state;
    int calls = 0;
    double low = 1, high = 2;
    root_bisect(below_root_two, &calls, &low, &high, 0, 10);
    assert_int_equal(calls, 10);
    assert_true(high - low == ldexp(1, -10));
    assert_true(low < M_SQRT2 && high > M_SQRT2);
    root_bisect(below_root_two, &calls, &low, &high, 1e-6, 1000);
    assert_true(high - low <= 2e-6 && high - low > 0.4e-6);
    root_bisect(below_root_two, &calls, &low, &high, 0, 1000); /* terminates */
    assert_true(low * low < 2 && high == nextafter(low, 2));
    low = -1;
    high = 1;
    root_bisect(below_step, NULL, &low, &high, 0, 1000);
    assert_true(high == 0.3 && low == nextafter(0.3, 0));
}

static double sine(double x, void *user)
{
    (void)user;
    return sin(x);
}

static void test_maximum(void **state)
{
    (void)state;
    /* the maximum is flat to the square root of the rounding error */
    assert_near(root_maximum(sine, NULL, 0, 3, 60), M_PI / 2, 3e-8);
    const double coarse = root_maximum(sine, NULL, 0, 3, 10);
    assert_true(fabs(coarse - M_PI / 2) < 3 * pow(0.618034, 10) && coarse != M_PI / 2);
    assert_near(root_maximum(sine, NULL, 0, 1, 60), 1, 1e-12); /* at a limit */
}

static void test_equations(void **state)
{
    (void)state;
    /* 4 2 .5; 2 5 1; .5 1 3 times 1 -2 3; the last column is spare */
    double a[3][4] = {{4, 9e9, 9e9, 9e9}, {2, 5, 9e9, 9e9}, {0.5, 1, 3, 9e9}},
           x[3] = {1.5, -5, 7.5};
    assert_true(cholesky_solve(&a[0][0], 4, 3, 0, x));
    assert_near(x[0], 1, 4e-15);
    assert_near(x[1], -2, 4e-15);
    assert_near(x[2], 3, 4e-15);
    double same[2][2] = {{1, 0}, {1, 1 + 1e-13}}, y[2] = {1, 1};
    assert_false(cholesky_solve(&same[0][0], 2, 2, 1e-12, y));
    double negative[2][2] = {{1, 0}, {2, 1}}, z[2] = {1, 1};
    assert_false(cholesky_solve(&negative[0][0], 2, 2, 0, z));
}

static void test_series(void **state)
{
    (void)state;
    double tau[] = {2, 1e-3}, e[] = {3e6, 5e7}, storage, loss;
    const wt_prony p = {.n = 2, .relaxation_time = tau, .modulus = e, .equilibrium_modulus = 1e6};
    prony_moduli(&p, 0.5, &storage, &loss); /* z = 1, and 5e-4 */
    assert_near(storage, 1e6 + 1.5e6 + 5e7 * 2.5e-7 / (1 + 2.5e-7), 1e-15);
    assert_near(loss, 1.5e6 + 5e7 * 5e-4 / (1 + 2.5e-7), 1e-15);
    prony_moduli(&p, 1e300, &storage, &loss); /* the square would overflow */
    assert_near(storage, 5.4e7, 1e-15);
    assert_near(loss / (3e6 / 2e300 + 5e7 / 1e297), 1, 1e-14);
    prony_moduli(&p, 0, &storage, &loss);
    assert_true(storage == 1e6 && loss == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bisection), cmocka_unit_test(test_maximum),
        cmocka_unit_test(test_equations), cmocka_unit_test(test_series)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
