/* Budget of a modulus: every number of its table by hand, for any stated sources.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "indentation/calibration_errors.h"
#include "indentation/numerics/group_statistics.h"

enum { SPOTS = 4, CURVES = 8 };

static double modulus[CURVES];
static long spot[CURVES];

/* Two curves at each position, a little above and below it. */
static wt_group_data make_group(void)
{
    static const double of_spot[SPOTS] = {-0.15, 0.05, -0.02, 0.12};
    wt_group_data d = {.group = {.modulus = modulus, .spot = spot, .n = CURVES}};
    for (int i = 0; i < CURVES; i++) {
        spot[i] = i / 2;
        modulus[i] = 3e6 * exp(of_spot[i / 2] + (i % 2 == 0 ? 0.02 : -0.02));
    }
    d.tip_error = (double)NAN;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++) {
        d.common_error[i] = d.assumed_error[i] = (double)NAN;
        d.common_gain[i] = (wt_estimate){(double)NAN, (double)NAN, 0, "1"};
    }
    return d;
}

static double squared(double x)
{
    return x * x;
}

/* By hand: the means of the positions are their offsets, which add up to 0. */
static double spot_variance(void)
{
    return (squared(0.15) + squared(0.05) + squared(0.02) + squared(0.12)) / (SPOTS - 1) / SPOTS;
}

static double curve_deviation(void)
{
    const double of_spots = squared(0.15) + squared(0.05) + squared(0.02) + squared(0.12);
    return sqrt((2 * of_spots + CURVES * squared(0.02)) / (CURVES - 1));
}

static void check_row(const wt_table *t, size_t row, const char *source, const char *kind,
                      double error, double gain, double effect, double all)
{
    assert_string_equal(cell_text(t, row, "group"), "track");
    assert_string_equal(cell_text(t, row, "source"), source);
    assert_string_equal(cell_text(t, row, "kind"), kind);
    assert_near(cell(t, row, "source_error"), error, 1e-12);
    assert_near(cell(t, row, "gain"), gain, 1e-12);
    assert_near(cell(t, row, "relative_error"), effect, 1e-9);
    assert_near(cell(t, row, "share"), squared(effect / all), 1e-9);
}

/* Each source alone, with its own sign, then all of them. */
static void test_every_source(void **state)
{
    (void)state;
    static const char *const names[] = {"track"};
    static const double error[] = {0.05, 0.03, 0.02, 0.1, 0.005, 0.01, 0.05},
                        gain[] = {1.2, -1.5, -2, 0.4, 8, 3, 0.5};
    static const char *const words[] = {"spring constant",        "deflection sensitivity",
                                        "half-angle of the tip",  "radius of the tip",
                                        "bend of the piezo",      "nonlinearity of the detector",
                                        "thickness of the sample"};
    const double scatter = spot_variance(), none = (double)NAN;
    for (unsigned which = 1; which < 1u << WT_SYSTEMATIC_SOURCES; which++) {
        wt_group_data d = make_group();
        wt_table *t = NULL;
        double variance = scatter;
        size_t row = 0;
        for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
            if (which & 1u << i) {
                d.common_error[i] = error[i];
                d.common_gain[i] = (wt_estimate){gain[i], 0.01 * (i + 1), 0, "1"};
                variance += squared(error[i] * gain[i]);
            }
        d.loss_error = which % 3 == 0 ? 0.04 : 0;
        d.bend_error = which % 5 == 0 ? -0.06 : 0;
        variance += squared(d.loss_error) + squared(d.bend_error);
        const double all = sqrt(variance);
        assert_int_equal(modulus_budget_create(&d, names, 1, &t, NULL), WT_OK);
        for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
            if (which & 1u << i) {
                assert_near(cell(t, row, "gain_standard_error"), 0.01 * (i + 1), 1e-12);
                check_row(t, row++, words[i], "shared", error[i], gain[i], fabs(error[i] * gain[i]),
                          all);
            }
        if (d.loss_error > 0)
            check_row(t, row++, "loss of unknown spectrum", "shared", 0.04, 1, 0.04, all);
        if (d.bend_error < 0)
            check_row(t, row++, "bend of the baselines", "shared", 0.06, 1, 0.06, all);
        check_row(t, row++, "scatter of the spots", "scatter", none, none, sqrt(scatter), all);
        check_row(t, row++, "all together", "together", none, none, all, all);
        assert_string_equal(cell_text(t, row, "source"), "one spot");
        assert_string_equal(cell_text(t, row, "kind"), "beside");
        assert_near(cell(t, row, "relative_error"), sqrt(SPOTS * scatter), 1e-9);
        assert_true(isnan(cell(t, row++, "share")));
        assert_string_equal(cell_text(t, row, "source"), "one curve");
        assert_near(cell(t, row, "relative_error"), curve_deviation(), 1e-9);
        assert_int_equal(wt_table_n_rows(t), row + 1);

        const wt_estimate e = key_estimate(t, "modulus_track");
        const double df = key_estimate(t, "df_track").value, reach = wt_student_quantile(df) * all;
        assert_near(e.value, 3e6, 1e-9);
        assert_near(e.standard_error, 3e6 * all, 1e-9);
        assert_near(key_estimate(t, "low_track").value, 3e6 * exp(-reach), 1e-6);
        assert_near(key_estimate(t, "high_track").value, 3e6 * exp(reach), 1e-6);
        /* degrees of freedom by Welch and Satterthwaite: known errors have an infinite number */
        assert_near(df, (SPOTS - 1) * squared(variance / scatter), 1e-6);
        wt_table_free(t);
    }
}

/* The text: the largest part first, its share of the square, and unstated errors. */
static void test_words(void **state)
{
    (void)state;
    static const char *const names[] = {"bulk"};
    wt_group_data d = make_group();
    wt_table *t = NULL;
    char words[256];
    d.common_error[0] = 0.05;
    d.common_gain[0] = (wt_estimate){1, 0, 0, "1"};
    d.common_error[3] = 0.2;
    d.common_gain[3] = (wt_estimate){-0.5, 0, 0, "1"};
    d.common_gain[1] = (wt_estimate){1.3, 0, 0, "1"};
    const double scatter = spot_variance(), all = scatter + squared(0.05) + squared(0.1);
    assert_int_equal(modulus_budget_create(&d, names, 1, &t, NULL), WT_OK);
    const char *says = wt_table_key(t, "says_bulk");
    snprintf(words, sizeof words,
             "standard error %.2g %%, of its square %.2g %% by the radius of the tip, %.2g %% by "
             "the scatter of the spots, %.2g %% by the spring constant; no error is stated of: "
             "deflection sensitivity",
             100 * sqrt(all), 100 * squared(0.1) / all, 100 * scatter / all,
             100 * squared(0.05) / all);
    if (strstr(says, words) == NULL)
        fail_msg("\"%s\" does not say \"%s\"", says, words);
    wt_table_free(t);
    /* one position gives no scatter, the shared parts remain */
    d.group.n = 2;
    assert_int_equal(modulus_budget_create(&d, names, 1, &t, NULL), WT_OK);
    says = wt_table_key(t, "says_bulk");
    if (strstr(says, "one spot does not determine the scatter of the sample; what its curves "
                     "share makes 5 % (spring constant), 10 % (radius of the tip)") == NULL)
        fail_msg("%s", says);
    assert_null(wt_table_key(t, "low_bulk"));
    assert_true(isnan(cell(t, wt_table_n_rows(t) - 2, "relative_error")));
    wt_table_free(t);
    /* a source of unknown effect makes the sum unknown */
    d.group.n = CURVES;
    d.common_gain[3].value = (double)NAN;
    assert_int_equal(modulus_budget_create(&d, names, 1, &t, NULL), WT_OK);
    assert_non_null(strstr(wt_table_key(t, "says_bulk"), "no curve could be fitted anew"));
    assert_null(wt_table_key(t, "low_bulk"));
    wt_table_free(t);
    /* without stated errors there is no budget */
    d.common_error[0] = d.common_error[3] = 0;
    assert_int_equal(modulus_budget_create(&d, names, 1, &t, NULL), WT_OK);
    assert_null(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_source),
                                       cmocka_unit_test(test_words)};
    return cmocka_run_group_tests_name("budget of a modulus", tests, NULL, NULL);
}
