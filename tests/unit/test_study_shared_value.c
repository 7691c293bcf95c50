/* One shared value of several estimates, against closed forms and draws.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "layer/numerics/correlated_pair.h"
#include "study/numerics/shared_value.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

/* Two normal values: inverse-variance mean and squared distance. */
static void test_two(void **state)
{
    (void)state;
    const wt_log_ratio of[] = {{1, 0.1, (double)NAN}, {1.3, 0.2, (double)NAN}};
    shared_value found;
    shared_deviation d[2];
    assert_int_equal(shared_value_fit(of, NULL, 2, &found, d, NULL), WT_OK);
    assert_near(found.value, (1 / 0.01 + 1.3 / 0.04) / 125, 1e-12);
    assert_near(found.error, sqrt(1.0 / 125), 1e-12);
    assert_near(found.chi_squared, 0.09 / 0.05, 1e-12);
    assert_near(found.df, 1, 0);
    assert_near(found.p, gsl_cdf_chisq_Q(1.8, 1), 1e-12);
    /* distance of a value from the mean, with Bonferroni correction */
    assert_near(d[1].value, 1.3 - found.value, 1e-12);
    assert_near(d[1].high - d[1].value, gsl_cdf_ugaussian_Qinv(0.0125) * sqrt(0.04 - 1.0 / 125),
                1e-12);
}

/* A possible shared error may widen the error of the mean, but makes neither the test nor the
 * distances sharper. */
static void test_shared_errors(void **state)
{
    (void)state;
    const double shared[] = {0, 0.09, 0.09, 0};
    const wt_log_ratio of[] = {{2, sqrt(0.1), (double)NAN}, {2.2, sqrt(0.1), (double)NAN}};
    shared_value found;
    shared_deviation d[2];
    assert_int_equal(shared_value_fit(of, shared, 2, &found, d, NULL), WT_OK);
    assert_near(found.value, 2.1, 1e-12);
    assert_near(found.error, sqrt(0.09 + 0.01 / 2), 1e-12);
    assert_near(found.chi_squared, 0.04 / 0.2, 1e-9);
    assert_near(d[1].high - d[1].value, gsl_cdf_ugaussian_Qinv(0.0125) * sqrt(0.05), 1e-12);
}

/* Two of three share all of their error: their agreement does not make the third more different
 * than a single one would. */
static void test_third(void **state)
{
    (void)state;
    const double shared[] = {0, 1, 0, 1, 0, 0, 0, 0, 0},
                 /* which together are not a valid covariance */
        chain[] = {0, 1, 0, 1, 0, 1, 0, 1, 0};
    const wt_log_ratio of[] = {{0, 1, (double)NAN}, {0, 1, (double)NAN}, {2, 0.1, (double)NAN}};
    shared_value found;
    shared_deviation d[3];
    assert_int_equal(shared_value_fit(of, shared, 3, &found, d, NULL), WT_OK);
    assert_near(found.chi_squared, 4 / 1.01, 1e-4);
    assert_int_equal(shared_value_fit(of, chain, 3, &found, d, NULL), WT_OK);
    assert_true(found.p > 0 && found.p < 1);
}

/* The distance of a normal value from its mean with a value of few positions has the degrees of
 * freedom of the latter, too: by Satterthwaite for the parts. */
static void test_freedom(void **state)
{
    (void)state;
    const double df = 5; /* weighted by the errors */
    const wt_log_ratio of[] = {{1, 0.1, (double)NAN}, {1, 0.1, df}};
    shared_value found;
    shared_deviation d[2];
    assert_int_equal(shared_value_fit(of, NULL, 2, &found, d, NULL), WT_OK);
    /* half of each, so that half of the variance is of the second */
    for (int i = 0; i < 2; i++)
        assert_near(d[i].high - d[i].value, gsl_cdf_tdist_Qinv(0.0125, 4 * df) * sqrt(0.005),
                    1e-12);
}

static void test_refused(void **state)
{
    (void)state;
    const double all[] = {0, 0.01, 0.01, 0};
    wt_log_ratio of[] = {{1, 0.1, (double)NAN}, {2, 0.1, (double)NAN}};
    shared_value found;
    shared_deviation d[2];
    assert_int_equal(shared_value_fit(of, NULL, 1, &found, d, NULL), WT_E_ARG);
    /* only shared errors reject nothing */
    assert_int_equal(shared_value_fit(of, all, 2, &found, d, NULL), WT_OK);
    assert_near(found.chi_squared, 1 / 0.02, 1e-9);
    of[0].standard_error = 0;
    assert_int_equal(shared_value_fit(of, NULL, 2, &found, d, NULL), WT_E_ARG);
}

/* Means of a few values each with different scatter: coverage of the interval, and rate of the
 * verdict "differs". */
static void count(int each)
{
    enum { DRAWS = 4000, GROUPS = 4, MOST = 10 };
    static const double scatter[GROUPS] = {0.1, 0.1, 0.3, 0.5};
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    int held = 0, different = 0;
    for (int i = 0; i < DRAWS; i++) {
        wt_log_ratio of[GROUPS];
        shared_value found;
        shared_deviation d[GROUPS];
        for (int g = 0; g < GROUPS; g++) {
            double x[MOST], mean = 0, square = 0;
            for (int k = 0; k < each; k++)
                mean += (x[k] = 3 + gsl_ran_gaussian(random, scatter[g])) / each;
            for (int k = 0; k < each; k++)
                square += (x[k] - mean) * (x[k] - mean) / (each - 1);
            of[g] = (wt_log_ratio){mean, sqrt(square / each), each - 1};
        }
        assert_int_equal(shared_value_fit(of, NULL, GROUPS, &found, d, NULL), WT_OK);
        held += found.low <= 3 && found.high >= 3;
        different += found.p < 0.05;
    }
    gsl_rng_free(random);
    /* 95 % and 5 %, with the error of the corrections and three binomial errors */
    assert_in_range(held, 0.93 * DRAWS, 0.975 * DRAWS);
    assert_in_range(different, 0.035 * DRAWS, 0.075 * DRAWS);
}

static void test_few_degrees(void **state)
{
    (void)state;
    count(3); /* the plain mean */
    count(5); /* weighted by the errors */
    count(10);
}

/* ---- pairs ----------------------------------------------------------------------------------- */

/* Two pairs by hand: their difference has the sum of the covariances minus twice the common one;
 * chi-squared is that of the difference. */
static double by_hand(const constant_pair *a, const constant_pair *b, double part)
{
    const double e = a->energy - b->energy, k = a->wear - b->wear,
                 ee = a->whole.energy + b->whole.energy - 2 * part * a->inputs.energy,
                 kk = a->whole.wear + b->whole.wear - 2 * part * a->inputs.wear,
                 ek = a->whole.both + b->whole.both - 2 * part * a->inputs.both;
    return (e * e * kk - 2 * e * k * ek + k * k * ee) / (ee * kk - ek * ek);
}

static void test_pair(void **state)
{
    (void)state;
    const pair_covariance inputs = {0.0016, 0.0009, -0.0006};
    constant_pair of[] = {{26, -27.6, {0.04, 0.01, -0.018}, inputs},
                          {26.3, -27.5, {0.02, 0.03, -0.02}, inputs}};
    bool common[] = {false, false, false, false};
    shared_pair s;
    assert_int_equal(shared_pair_fit(of, common, 2, &s, NULL), WT_OK);
    assert_near(s.chi_squared, by_hand(&of[0], &of[1], 0), 1e-9);
    assert_near(s.p, exp(-s.chi_squared / 2), 1e-9); /* of two degrees of freedom */
    const pair_covariance apart = s.covariance;
    common[1] = common[2] = true;
    assert_int_equal(shared_pair_fit(of, common, 2, &s, NULL), WT_OK);
    /* a common error makes a difference more significant: the smaller one is stated */
    assert_near(s.chi_squared, by_hand(&of[0], &of[1], 0), 1e-9);
    assert_true(s.covariance.energy + s.covariance.wear >= apart.energy + apart.wear);
    /* equal ones: the mean has half of a single variance and all of the common one */
    of[1] = of[0];
    assert_int_equal(shared_pair_fit(of, common, 2, &s, NULL), WT_OK);
    assert_near(s.energy, of[0].energy, 1e-12);
    assert_near(s.wear, of[0].wear, 1e-12);
    assert_near(s.covariance.energy, (0.04 + 0.0016) / 2, 1e-12);
    assert_near(s.covariance.both, (-0.018 - 0.0006) / 2, 1e-12);
    assert_true(s.chi_squared < 1e-9 && s.p > 1 - 1e-9);
    /* each alone agrees with the other within its error, the pair does not */
    of[0].whole = of[1].whole = (pair_covariance){0.04, 0.04, -0.0396};
    of[1].energy = of[0].energy + 0.2;
    of[1].wear = of[0].wear + 0.2;
    of[0].inputs = of[1].inputs = (pair_covariance){0, 0, 0};
    assert_int_equal(shared_pair_fit(of, common, 2, &s, NULL), WT_OK);
    assert_near(s.chi_squared, by_hand(&of[0], &of[1], 0), 1e-9);
    assert_true(s.p < 1e-3);
    of[0].whole.both = -0.04; /* no pair */
    assert_int_equal(shared_pair_fit(of, common, 2, &s, NULL), WT_E_ARG);
    assert_int_equal(shared_pair_fit(of, common, 1, &s, NULL), WT_E_ARG);
}

/* ln U_c + 0.5 ln k has the largest error; with a smaller error of U_c than of k the reverse. */
static void test_axes(void **state)
{
    (void)state;
    const double angle = atan(-0.5), c = cos(angle), s = sin(angle);
    const double loose = 0.09, tight = 0.0004;
    const pair_covariance of = {loose * c * c + tight * s * s, loose * s * s + tight * c * c,
                                (loose - tight) * s * c},
                          turned = {of.wear, of.energy, of.both};
    constant_axes a = constant_axes_compute(of);
    assert_string_equal(a.loose, "U_c k^-0.50");
    assert_near(a.loose_error, 0.3, 1e-12);
    assert_near(a.tight_error, 0.02, 1e-9);
    assert_near(a.correlation, of.both / sqrt(of.energy * of.wear), 1e-12);
    a = constant_axes_compute(turned);
    assert_string_equal(a.loose, "k U_c^-0.50");
    a = constant_axes_compute((pair_covariance){(double)NAN, 1, 0});
    assert_string_equal(a.loose, "");
    assert_true(isnan(a.correlation) && isnan(a.loose_error) && isnan(a.tight_error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two),     cmocka_unit_test(test_shared_errors),
        cmocka_unit_test(test_third),   cmocka_unit_test(test_freedom),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_few_degrees),
        cmocka_unit_test(test_pair),    cmocka_unit_test(test_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
