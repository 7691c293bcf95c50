/* Fit range: lower and upper limits by indentation, by radii of the tip, by force and by share of
 * the largest force.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw_count.h"
#include "fitted_curve.h"

#include "indentation/numerics/curve.h"

#include <string.h>

static wt_status fit_curve(const curve_truth *t, const wt_indent_options *options,
                           wt_indent_fit *fit, wt_error *err)
{
    wt_contact_table *table = NULL;
    assert_int_equal(wt_contact_table_new(&t->tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    const wt_status status = wt_indent_fit_curve(table, options, data.height, data.force, data.time,
                                                 t->n, t->spring_constant, workspace, fit, err);
    wt_contact_table_free(table);
    return status;
}

static void range_of_the_fit(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    wt_indent_options options = every_curve();
    options.fit_depth = 30e-9;
    wt_indent_fit fit = fit_with(&t, &options);
    assert_accepted(&fit);
    assert_near(fit.modulus.value, t.modulus, 1e-7);
    assert_true(fit.max_indentation <= 30e-9 && fit.max_indentation > 29.5e-9);
    assert_true(fit.n_fitted < t.n);
    assert_near(fit.max_force, curve_contact_force(&t, t.travel - t.contact_point), 1e-6);
    options = every_curve();
    options.fit_force_fraction = 0.5;
    fit = fit_with(&t, &options);
    assert_accepted(&fit);
    assert_near(fit.modulus.value, t.modulus, 1e-7);
    double g, slope;
    wt_contact_function(&t.tip, fit.max_indentation, &g, &slope);
    assert_near(t.modulus / 0.75 * g, 0.5 * fit.max_force, 0.02);

    /* Above 35 nm the sample is stiffer: only the limit gives the modulus of the upper part. */
    for (size_t i = 0; i < t.n; i++) {
        double z = data.height[i] - t.height0 - t.contact_point;
        if (z > 60e-9)
            data.force[i] += 0.2 * (z - 60e-9);
    }
    options = every_curve();
    options.fit_depth = 25e-9;
    fit = fit_with(&t, &options);
    assert_accepted(&fit);
    assert_near(fit.modulus.value, t.modulus, 1e-4);
    assert_true(fabs(fit_with(&t, NULL).modulus.value / t.modulus - 1.0) > 0.05);
}

static double force_at_depth(const curve_truth *t, double depth)
{
    double g, slope;
    wt_contact_function(&t->tip, depth, &g, &slope);
    return t->modulus / (1.0 - t->poisson_ratio * t->poisson_ratio) * g;
}

/* Every limit is exact without noise: the modulus is the true one, and the first and last
 * indentation are those of the limits, to a sample (0.3 nm). */
static void every_limit(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    const double step = 0.3e-9, largest = curve_contact_force(&t, t.travel - t.contact_point);
    const double whole = fit_with(&t, NULL).max_indentation;
    const struct {
        double depth, radii, force, share, depth_from, force_from, share_from;
        double from, to; /* indentation, or force if it is 0 */
        double force_from_is, force_to_is;
    } cases[] = {
        {40e-9, 0, 0, 1, 0, 0, 0, 0, 40e-9, 0, 0},
        {0, 3.5, 0, 1, 0, 0, 0, 0, 35e-9, 0, 0},
        {40e-9, 3.5, 0, 1, 0, 0, 0, 0, 35e-9, 0, 0},
        {0, 0, 20e-9, 1, 0, 0, 0, 0, 0, 0, 20e-9},
        {0, 0, 20e-9, 0.1, 0, 0, 0, 0, 0, 0, 0.1 * largest},
        {0, 0, 0, 1, 15e-9, 0, 0, 15e-9, whole, 0, 0},
        {0, 0, 0, 1, 0, 10e-9, 0, 0, whole, 10e-9, 0},
        {0, 0, 0, 1, 0, 0, 0.25, 0, whole, 0.25 * largest, 0},
        {50e-9, 0, 0, 1, 10e-9, 1e-9, 0, 10e-9, 50e-9, 0, 0},
        {0, 0, 0, 0.8, 0, 0, 0.2, 0, 0, 0.2 * largest, 0.8 * largest},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_indent_options o = every_curve();
        o.fit_depth = cases[i].depth;
        o.fit_radii = cases[i].radii;
        o.fit_force = cases[i].force;
        o.fit_force_fraction = cases[i].share;
        o.fit_depth_from = cases[i].depth_from;
        o.fit_force_from = cases[i].force_from;
        o.fit_force_fraction_from = cases[i].share_from;
        const wt_indent_fit fit = fit_with(&t, &o);
        assert_accepted(&fit);
        assert_string_equal(fit.reason, "accepted");
        assert_near(fit.modulus.value, t.modulus, 1e-6);
        assert_near_abs(fit.contact_point.value, t.height0 + t.contact_point, 1e-12);
        assert_near(fit.max_force, largest, 1e-6);
        if (cases[i].force_from_is > 0)
            assert_near(force_at_depth(&t, fit.fitted_from), cases[i].force_from_is, 0.05);
        else
            assert_near_abs(fit.fitted_from, cases[i].from, step);
        if (cases[i].force_to_is > 0)
            assert_near(force_at_depth(&t, fit.max_indentation), cases[i].force_to_is, 0.05);
        else
            assert_near_abs(fit.max_indentation, cases[i].to, step);
        /* rates are those of the fitted part */
        const double end = fit.max_indentation + force_at_depth(&t, fit.max_indentation);
        assert_near_abs(fit.load_time, 0.5 * end / t.travel, 1e-3 * 0.5);
    }
}

/* A sample that differs near its surface: only a lower limit gives the modulus below it. */
static void shallow_part_is_excluded(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    for (size_t i = 0; i < t.n; i++) { /* a force that ends at 12 nm */
        const double z = data.height[i] - t.height0 - t.contact_point;
        if (z > 0 && z < 14e-9)
            data.force[i] += 2e-9 * sin(M_PI * z / 14e-9);
    }
    wt_indent_options options = every_curve();
    options.fit_depth_from = 20e-9;
    const wt_indent_fit fit = fit_with(&t, &options), all = fit_with(&t, NULL);
    assert_accepted(&fit);
    assert_near(fit.modulus.value, t.modulus, 1e-3);
    assert_true(fabs(all.modulus.value / t.modulus - 1) > 0.02);
}

/* 95 % intervals of the modulus and of the contact point with ranges. The coverage of 240 has a
 * standard deviation of 1.4 %. */
static void intervals_cover(void **state)
{
    (void)state;
    const struct {
        double depth, depth_from, force_from, share, correlation;
    } cases[] = {
        {0, 20e-9, 0, 1, 0.0}, {40e-9, 10e-9, 0, 1, 0.0}, {0, 0, 5e-9, 0.8, 0.0},
        {0, 20e-9, 0, 1, 0.8}, {35e-9, 0, 0, 1, 0.0},
    };
    enum { CURVES = DRAW_COUNT(240) };
    int likely = 0, judged = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        curve_truth t = curve_standard();
        t.n = 1000;
        t.correlation = cases[i].correlation;
        wt_indent_options options = wt_indent_defaults();
        options.fit_depth = cases[i].depth;
        options.fit_depth_from = cases[i].depth_from;
        options.fit_force_from = cases[i].force_from;
        options.fit_force_fraction = cases[i].share;
        int modulus = 0, contact = 0, refused = 0;
        double sum = 0, errors = 0;
        for (uint64_t seed = 1; seed <= CURVES; seed++) {
            curve_make(&t, seed * 7919, &data);
            const wt_indent_fit fit = fit_with(&t, &options);
            if (fit.verdict != WT_CURVE_ACCEPTED) {
                refused++;
                continue;
            }
            judged++;
            likely += fit.lack_of_fit_p > 0.5;
            modulus +=
                fabs(fit.modulus.value - t.modulus) < 1.96 * fit.modulus.standard_error ? 1 : 0;
            contact += fabs(fit.contact_point.value - t.height0 - t.contact_point) <
                               1.96 * fit.contact_point.standard_error
                           ? 1
                           : 0;
            sum += fit.modulus.value / t.modulus - 1;
            errors += fit.modulus.standard_error / t.modulus;
        }
        const int n = CURVES - refused;
        print_message("case %zu: E %.1f %%, contact %.1f %%, refused %d, bias %.2f %%, "
                      "mean error %.2f %%\n",
                      i, 100.0 * modulus / n, 100.0 * contact / n, refused, 100 * sum / n,
                      100 * errors / n);
        if (!TEST_RATES)
            continue;
        assert_in_range(refused, 0, 0.04 * CURVES);
        /* with the error by a lack of fit, mostly in the excluded depths */
        assert_in_range(modulus, 0.91 * n, n);
        assert_in_range(contact, 0.91 * n, n);
        assert_true(fabs(sum) < 0.25 * errors);
    }
    /* p values above a half are as frequent as below, also in the compared part alone */
    print_message("%d of %d chances above a half\n", likely, judged);
    if (!TEST_RATES)
        return;
    assert_in_range(likely, 0.44 * judged, 0.58 * judged);
}

static void too_little_is_refused(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    const struct {
        double from, to;
    } cases[] = {{50e-9, 51e-9}, {100e-9, 0}, {0, 1e-9}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_indent_options options = every_curve();
        options.fit_depth_from = cases[i].from;
        options.fit_depth = cases[i].to;
        const wt_indent_fit fit = fit_with(&t, &options);
        assert_int_equal(fit.verdict, WT_CURVE_TOO_SHORT);
        assert_non_null(strstr(fit.reason, "samples in contact in the range of the fit, 8 needed"));
        assert_false(wt_curve_verdict_is_usable(fit.verdict));
    }
}

static void limits_in_order(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 0, &data);
    wt_indent_options o[5];
    for (size_t i = 0; i < 5; i++)
        o[i] = wt_indent_defaults();
    o[0].fit_depth = 20e-9;
    o[0].fit_depth_from = 20e-9;
    o[1].fit_radii = 2;
    o[1].fit_depth_from = 25e-9;
    o[2].fit_force = 1e-9;
    o[2].fit_force_from = 2e-9;
    o[3].fit_force_fraction = 0.4;
    o[3].fit_force_fraction_from = 0.5;
    o[4].fit_radii = 2; /* of a sharp tip */
    for (size_t i = 0; i < 5; i++) {
        wt_indent_fit fit;
        wt_error err = WT_ERROR_INIT;
        if (i == 4)
            t.tip = (wt_tip){.shape = WT_TIP_CONE, .half_angle = 0.35};
        assert_int_equal(fit_curve(&t, &o[i], &fit, &err), WT_E_RANGE);
        assert_non_null(strstr(err.message, i < 4 ? "empty" : "radius"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(range_of_the_fit),         cmocka_unit_test(every_limit),
        cmocka_unit_test(shallow_part_is_excluded), cmocka_unit_test(intervals_cover),
        cmocka_unit_test(too_little_is_refused),    cmocka_unit_test(limits_in_order)};
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
