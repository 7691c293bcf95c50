/* Unusual force curves: each has its verdict and a reason with numbers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw_count.h"
#include "fitted_curve.h"

#include "indentation/law/adhesion.h"
#include "indentation/numerics/curve.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Fits and tests the verdict and a word of the reason. A fitted curve keeps its modulus for any
 * verdict. */
static wt_indent_fit expect(const curve_truth *t, wt_curve_verdict verdict, const char *words)
{
    wt_indent_options options = wt_indent_defaults();
    wt_indent_fit fit = fit_with(t, &options);
    if (fit.verdict != verdict || strstr(fit.reason, words) == NULL)
        fail_msg("%s: %s (expected %s with \"%s\")", wt_curve_verdict_id(fit.verdict), fit.reason,
                 wt_curve_verdict_id(verdict), words);
    assert_true(fit.modulus.value > 0 || !wt_curve_verdict_is_usable(verdict));
    assert_true(isnan(fit.modulus.value) || isnan(fit.misfit_error) ||
                fit.modulus.standard_error >= fit.misfit_error);
    assert_true(!isnan(fit.misfit_error) || verdict != WT_CURVE_ACCEPTED);
    return fit;
}

static void never_touches(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.contact_point = 10e-6;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        t.correlation = seed % 2 == 0 ? 0.0 : 0.9;
        curve_make(&t, seed, &data);
        wt_indent_options options = wt_indent_defaults();
        wt_indent_fit fit = fit_with(&t, &options);
        if (fit.verdict != WT_CURVE_NO_CONTACT)
            fail_msg("seed %d: %s: %s", (int)seed, wt_curve_verdict_id(fit.verdict), fit.reason);
    }
    for (size_t i = 0; i < t.n; i++)
        data.force[i] = 1e-9;
    expect(&t, WT_CURVE_NO_CONTACT, "changes by 0");
}

static void starts_in_contact(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.travel = 100e-9;
    t.contact_point = -30e-9;
    curve_make(&t, 1, &data);
    /* an unknown error is not 0 */
    assert_true(isnan(expect(&t, WT_CURVE_NO_BASELINE, "before the first sample").misfit_error));
    t.contact_point = 0.3e-9;
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_NO_BASELINE, "");
}

static void saturated_detector(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    for (int noisy = 0; noisy < 2; noisy++) {
        uint64_t random = 9;
        curve_make(&t, 1, &data);
        for (size_t i = 0; i < t.n; i++)
            if (data.force[i] > 30e-9)
                data.force[i] = 30e-9 + noisy * 20e-12 * curve_normal(&random);
        wt_indent_fit fit = expect(&t, WT_CURVE_DOUBTFUL, "fitted up to 2");
        assert_near(fit.modulus.value, t.modulus, 4 * fit.modulus.standard_error / t.modulus);
        assert_true(fit.n_fitted < t.n && fit.max_force > 26e-9 /* of all */);
        wt_indent_options options = wt_indent_defaults();
        options.fit_force_fraction = 0.9; /* with a stated one, nothing is doubtful */
        fit = fit_with(&t, &options);
        assert_int_equal(fit.verdict, WT_CURVE_ACCEPTED);
        assert_near(fit.modulus.value, t.modulus, 4 * fit.modulus.standard_error / t.modulus);
    }
    /* A piezo that rests at the end is not a saturation. */
    curve_make(&t, 1, &data);
    for (size_t i = t.n - 200; i < t.n; i++) {
        data.height[i] = data.height[t.n - 200];
        data.force[i] += data.force[t.n - 200] -
                         curve_contact_force(&t, data.height[i] - t.height0 - t.contact_point) -
                         data.force[i] + 1e-12 * (double)(i % 7);
    }
    wt_indent_options options = wt_indent_defaults();
    assert_int_not_equal(fit_with(&t, &options).verdict, WT_CURVE_SATURATED);
    /* Neither is a coarse converter with steps of 0.5 nN. */
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++)
        data.force[i] = 0.5e-9 * round(data.force[i] / 0.5e-9);
    expect(&t, WT_CURVE_ACCEPTED, "accepted");
}

static void missing_and_repeated_samples(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    double modulus = expect(&t, WT_CURVE_ACCEPTED, "accepted").modulus.value;
    for (size_t i = 7; i < t.n; i += 50) {
        data.force[i] = (double)NAN;
        data.height[i + 3] = (double)INFINITY;
    }
    wt_indent_fit fit = expect(&t, WT_CURVE_ACCEPTED, "80 missing samples");
    assert_near(fit.modulus.value, modulus, 1e-3);
    assert_int_equal(fit.n_fitted, t.n - 80);
    for (size_t i = 0; i < t.n; i += 5)
        data.force[i] = (double)NAN;
    expect(&t, WT_CURVE_NOT_FINITE, "of 2000");
    for (size_t i = 0; i < t.n; i++)
        data.force[i] = (double)NAN;
    expect(&t, WT_CURVE_NOT_FINITE, "2000 of 2000");

    curve_make(&t, 1, &data);
    for (size_t i = 3; i < t.n; i += 3) {
        data.force[i] = data.force[i - 1];
        data.height[i] = data.height[i - 1];
    }
    fit = expect(&t, WT_CURVE_ACCEPTED, "666 repeated samples");
    assert_near(fit.modulus.value, modulus, 2e-3);

    t.n = 31;
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_TOO_SHORT, "31 different samples");
    t.n = 1;
    expect(&t, WT_CURVE_TOO_SHORT, "1 different");
}

static void disturbed_baseline(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++) { /* a wave other than a sine */
        const double x = data.height[i] / 30e-9;
        data.force[i] += 4e-9 * (sin(x) + sin(1.3 * x) + sin(0.6 * x));
    }
    expect(&t, WT_CURVE_WIDE, "the 95 % interval is wide: E +- ");
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++) { /* drag that becomes constant */
        double x = (data.height[i] - t.height0) / t.travel;
        data.force[i] += 400e-9 * x * exp(-8.0 * x);
    }
    assert_int_not_equal(fit_with(&t, NULL).verdict, WT_CURVE_ACCEPTED);

    /* A sine is fitted. A ripple of 2 % that is too short for optical interference is part of the
     * error. */
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++)
        data.force[i] += 0.5e-9 * sin(data.height[i] / 20e-9);
    wt_indent_fit fit = expect(&t, WT_CURVE_ACCEPTED, "accepted");
    assert_true(fit.modulus.standard_error > 0.01 * t.modulus);
    assert_true(fabs(fit.modulus.value - t.modulus) < 4 * fit.modulus.standard_error);
}

static void wrong_direction(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    for (size_t i = 0, j = t.n - 1; i < j; i++, j--) {
        double h = data.height[i], f = data.force[i];
        data.height[i] = data.height[j];
        data.force[i] = data.force[j];
        data.height[j] = h;
        data.force[j] = f;
    }
    expect(&t, WT_CURVE_NO_APPROACH, "leaves the sample");
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++)
        data.force[i] = -data.force[i];
    expect(&t, WT_CURVE_NEGATIVE, "sign of the deflection");
    /* the means of the first and last tenth of a ramp differ by nine tenths of it */
    for (size_t i = 0; i < t.n; i++)
        data.force[i] = -1e-9 * (double)i / (double)t.n;
    expect(&t, WT_CURVE_NEGATIVE, "falls by 900 pN");
    curve_make(&t, 1, &data);
    for (size_t i = t.n / 2; i < t.n; i++)
        data.height[i] = data.height[t.n - 1 - i] + 1e-12;
    expect(&t, WT_CURVE_NO_APPROACH, "does not go one way");
    for (size_t i = 0; i < t.n; i++)
        data.height[i] = 1e-6;
    expect(&t, WT_CURVE_NO_APPROACH, "does not go one way");
}

static void too_stiff_for_the_cantilever(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.modulus = 70e9; /* silica */
    t.spring_constant = 0.1;
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_RIGID, "bending of the cantilever");
    /* Sensitivity 1 % too large: the tip seems to move backwards. */
    for (size_t i = 0; i < t.n; i++)
        data.force[i] *= 1.01;
    expect(&t, WT_CURVE_RIGID, "bending of the cantilever");
}

/* No sample bends the cantilever by more than the piezo moves. A curve with the sensitivity of
 * another cantilever is not called stiff or without contact. */
static void more_bending_than_travel(void **state)
{
    (void)state;
    const double factors[] = {2, 4, 100};
    for (size_t f = 0; f < sizeof factors / sizeof *factors; f++) {
        curve_truth t = curve_standard();
        curve_make(&t, 1, &data);
        for (size_t i = 0; i < t.n; i++)
            data.force[i] *= factors[f];
        expect(&t, WT_CURVE_RIGID, "times as far as the piezo moves");
    }
}

static void snap_in_is_excluded(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.contact_point = 450e-9;
    curve_make(&t, 1, &data);
    double depth = 4e-9;
    for (size_t i = 0; i < t.n; i++) { /* attraction of 4 nN from 4 nm before contact */
        double z = data.height[i] - t.height0 - t.contact_point + depth;
        if (z > 0.0 && z < 12e-9)
            data.force[i] -= 4e-9 * (1.0 - z / 12e-9) + curve_contact_force(&t, z - depth);
    }
    wt_indent_fit fit = expect(&t, WT_CURVE_ACCEPTED, "snap-on of");
    assert_near(fit.adhesion_force, 4e-9, 0.1);
    assert_near(fit.modulus.value, t.modulus, 0.02);
    assert_near_abs(fit.contact_point.value, t.height0 + t.contact_point, 0.5e-9);
}

static void wrong_tip_is_detected(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++) { /* a membrane that breaks */
        double z = data.height[i] - t.height0 - t.contact_point;
        if (z > 50e-9)
            data.force[i] -= 0.85 * curve_contact_force(&t, z);
    }
    wt_indent_fit fit = expect(&t, WT_CURVE_POOR_FIT, "misfit: E +- ");
    assert_true(fit.lack_of_fit > 100 && fit.lack_of_fit_p < 1e-6);
    wt_indent_options options = wt_indent_defaults();
    options.misfit_p_threshold = 0.0;
    fit = fit_with(&t, &options);
    assert_int_not_equal(fit.verdict, WT_CURVE_POOR_FIT);
}

/* A contact of 10 nm in slow noise: the noise causes additional contact points, and some curves
 * cannot decide between them. */
static void several_contact_points(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.n = 800;
    t.contact_point = 590e-9;
    t.noise = 0.4e-9;
    t.correlation = 0.95;
    int ambiguous = 0, second = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        curve_make(&t, seed, &data);
        wt_indent_options options = wt_indent_defaults();
        options.misfit_p_threshold = 0.0;
        wt_indent_fit fit = fit_with(&t, &options);
        if (!isnan(fit.second_minimum_ratio)) {
            second++;
            assert_true(fit.second_minimum_ratio >= 1.0);
            assert_true(fabs(fit.second_contact_point - fit.contact_point.value) > 1e-9);
        }
        if (fit.verdict == WT_CURVE_AMBIGUOUS) {
            ambiguous++;
            const char *instead = strstr(fit.reason, "instead of ");
            assert_non_null(instead);
            assert_true(atof(instead + 11) > 0); /* modulus of the better one */
            assert_true(fit.second_minimum_ratio < 1.5);
            assert_true(fit.modulus.standard_error > options.largest_error * fit.modulus.value);
        }
    }
    print_message("%d with a second minimum, %d ambiguous of 30\n", second, ambiguous);
    assert_true(second > 5);
    assert_true(ambiguous > 0);
}

/* A soft cantilever, few samples in contact, and repulsion before it: block means show a second
 * minimum that the samples do not have. */
static void one_contact_point(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.tip.radius = 20e-9;
    t.tip.transition_radius = wt_tip_tangent_transition(t.tip.radius, t.tip.half_angle);
    t.n = 4100;
    t.modulus = 190e3;
    t.spring_constant = 0.0155;
    t.travel = 10.27e-6;
    t.contact_point = 9.98e-6;
    t.tilt = 0.0;
    t.noise = 5e-12;
    wt_indent_options options = wt_indent_defaults();
    options.fit_tilt = false;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        uint64_t other = 991 * seed;
        curve_make(&t, seed, &data);
        for (size_t i = 0; i < t.n; i++) {
            const double z = t.travel * (double)i / (double)(t.n - 1) - t.contact_point;
            data.height[i] += 0.5e-9 * curve_normal(&other);
            data.force[i] += 100e-12 * exp(fmin(z, 0.0) / 120e-9);
        }
        const wt_indent_fit fit = fit_with(&t, &options);
        assert_true(fit.modulus.value > 0.0);
        if (!isnan(fit.second_minimum_ratio))
            fail_msg("seed %d: a second minimum at %.4f times the cost", (int)seed,
                     fit.second_minimum_ratio);
    }
}

/* Meaningless numbers: always a verdict with a reason, never a modulus that is not a number. */
static void meaningless_data_have_a_verdict(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    uint64_t random = 4711;
    for (int i = 0; i < 400; i++) {
        t.n = 1 + (size_t)(200.0 * curve_uniform(&random));
        double scale = pow(10.0, 40.0 * curve_uniform(&random) - 30.0), walk = 0.0;
        double height_scale = i % 5 == 0 ? 1e300 : pow(10.0, 20.0 * curve_uniform(&random) - 15.0);
        for (size_t k = 0; k < t.n; k++) {
            walk += curve_normal(&random);
            data.force[k] = scale * (i % 2 == 0 ? walk : curve_normal(&random));
            data.height[k] = height_scale * (i % 3 == 0 ? curve_normal(&random) : (double)k);
            data.time[k] = i % 7 == 0 ? (double)NAN : (double)k;
            if (i % 4 == 0 && curve_uniform(&random) < 0.05)
                data.force[k] = k % 2 == 0 ? (double)NAN : -DBL_MAX;
        }
        wt_indent_options options = wt_indent_defaults();
        options.misfit_p_threshold = 0.0;
        options.fit_tilt = i % 2 == 1;
        options.fit_depth = i % 6 == 0 ? 1e-8 : 0.0;
        options.plain_least_squares = i % 8 == 0;
        wt_indent_fit fit = fit_with(&t, &options);
        assert_true(fit.reason[0] != '\0');
        assert_true(!wt_curve_verdict_is_usable(fit.verdict) ||
                    (isfinite(fit.modulus.value) && fit.modulus.value > 0.0));
    }
}

/* Spikes are excluded, without any other message about the curve. */
static void spikes(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    const double modulus = expect(&t, WT_CURVE_ACCEPTED, "accepted").modulus.value;
    data.force[300] += 60e-9;
    for (size_t i = 40; i < t.n; i += 97)
        data.force[i] += 3e-9;
    wt_indent_fit fit = expect(&t, WT_CURVE_ACCEPTED, "22 spikes left out");
    assert_near(fit.modulus.value, modulus, 2e-3);
    uint64_t random = 3;
    for (size_t i = 0; i < t.n; i++)
        data.force[i] += curve_uniform(&random) < 0.3 ? 3e-9 : 0.0;
    assert_int_not_equal(fit_with(&t, NULL).verdict, WT_CURVE_ACCEPTED);
}

/* A signal that is flat beyond `most`: the contact force through a tanh. */
static void flatten(const curve_truth *t, double most)
{
    for (size_t i = 0; i < t->n; i++) {
        const double z = t->travel * (double)i / (double)(t->n - 1);
        const double force = curve_contact_force(t, z - t->contact_point);
        data.force[i] += most * tanh(force / most) - force;
    }
}

static void softly_saturated_detector(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    const double top = curve_contact_force(&t, t.travel - t.contact_point);
    wt_indent_options options = wt_indent_defaults();
    wt_indent_fit fit;
    int held = 0;
    for (int draw = 0; draw < 20; draw++) {
        curve_make(&t, 1 + 7919 * (uint64_t)draw, &data);
        flatten(&t, 1.3 * top);
        fit = expect(&t, WT_CURVE_DOUBTFUL, "above which the force flattens");
        held += fabs(fit.modulus.value - t.modulus) < 1.96 * fit.modulus.standard_error;
        assert_true(fit.n_fitted < t.n);
    }
    print_message("%d of 20 hold\n", held);
    assert_in_range(held, 16, 20);     /* one of 400 holds fewer samples */
    options.fit_force_fraction = 0.15; /* where tanh x is x to 0.4 % */
    fit = fit_with(&t, &options);
    assert_int_equal(fit.verdict, WT_CURVE_ACCEPTED);
    assert_near(fit.modulus.value, t.modulus, 0.01);
    /* A nearly linear force with a cantilever much softer than the contact is not a saturation: at
     * most one in 1000. The p value of 4 in 600 is 0.003. */
    int flat = 0;
    enum { DRAWS = DRAW_COUNT(200) };
    for (int k = 0; k < 3; k++) {
        t = curve_standard();
        t.n = 1000;
        t.spring_constant = 0.1;
        t.correlation = 0.45 * k;
        for (int draw = 0; draw < DRAWS; draw++) {
            curve_make(&t, 5 + 104729 * (uint64_t)draw, &data);
            const wt_indent_fit nearly = fit_with(&t, NULL);
            flat +=
                nearly.verdict == WT_CURVE_SATURATED || strstr(nearly.reason, "flattens") != NULL;
        }
    }
    print_message("%d of %d\n", flat, 3 * DRAWS);
    assert_in_range(flat, 0, 3);
}

/* With missing samples or a slowing piezo, the contact force is curved against the sample number
 * but not against the height. */
static void uneven_heights(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 5e-12;
    for (int draw = 0; draw < 20; draw++) {
        curve_make(&t, 1 + 7919 * (uint64_t)draw, &data);
        for (size_t i = t.n - 80; i < t.n - 60; i++)
            data.force[i] = (double)NAN;
        expect(&t, WT_CURVE_ACCEPTED, "accepted");
        uint64_t seed = 1 + 7919 * (uint64_t)draw;
        for (size_t i = 0; i < t.n; i++) { /* to a third of its rate at the end */
            const double x = (double)i / (double)(t.n - 1);
            const double z =
                t.travel * (x < 0.8 ? x : x - (x - 0.8) * (x - 0.8) / 0.6) / (14. / 15);
            data.height[i] = t.height0 + z;
            data.force[i] = t.offset + t.tilt * z + curve_contact_force(&t, z - t.contact_point) +
                            t.noise * curve_normal(&seed);
        }
        expect(&t, WT_CURVE_ACCEPTED, "accepted");
    }
}

static void deeper_than_the_sphere(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.tip = (wt_tip){.shape = WT_TIP_PARABOLOID, .radius = 60e-9};
    t.modulus = 5e6;
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_DOUBTFUL, "radii of the tip");
    t.tip = (wt_tip){.sides = 4, .half_angle = 0.6, .sample_thickness.value = 10e-9};
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_DOUBTFUL, "of the thickness of the sample");
    t.tip = (wt_tip){.shape = WT_TIP_PARABOLOID, .radius = 300e-9};
    curve_make(&t, 1, &data);
    expect(&t, WT_CURVE_ACCEPTED, "accepted");
}

static void too_uncertain(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    wt_indent_options options = wt_indent_defaults();
    options.largest_error = 1e-4;
    assert_int_equal(fit_with(&t, &options).verdict, WT_CURVE_IMPRECISE);
}

static void bend(const curve_truth *t, double force)
{
    for (size_t i = 0; i < t->n; i++) {
        const double x = (double)i / (double)t->n;
        data.force[i] += 4 * force * x * (1 - x);
    }
}

/* Another tip or a curved baseline: R squared accepts them at 0.999 and more. */
static void weak_nonlinearity_is_not_saturation(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    t.tip.radius = 40e-9;
    t.tip.transition_radius = wt_tip_tangent_transition(t.tip.radius, t.tip.half_angle);
    const wt_indent_fit blunt = expect(&t, WT_CURVE_ACCEPTED, "misfit: E +- ");
    assert_true(blunt.misfit_error > 0.7 * blunt.modulus.standard_error);
    /* the error includes a curvature that the residual does not show */
    t = curve_standard();
    curve_make(&t, 1, &data);
    const double straight = fit_with(&t, NULL).modulus.standard_error;
    bend(&t, 0.1e-9);
    const wt_indent_fit bent =
        expect(&t, WT_CURVE_ACCEPTED, "baseline bent, which is in the error");
    assert_true(bent.baseline_p < 0.01);
    assert_true(bent.modulus.standard_error > 1.5 * straight);
    assert_near_abs(bent.modulus.value, t.modulus, 2 * bent.modulus.standard_error);
    assert_near_abs(bent.modulus.value - t.modulus, bent.curvature_shift, 4 * straight);
    assert_true(bent.curvature_shift < -straight);
    bend(&t, 3e-9);
    const wt_indent_fit more = expect(&t, WT_CURVE_ACCEPTED, "baseline bent");
    assert_near_abs(more.modulus.value, t.modulus, 2 * more.modulus.standard_error);
}

/* One noisy curve hides what thirty together show. */
static void curves_together(void **state)
{
    (void)state;
    for (int wrong = 0; wrong < 2; wrong++) {
        double misfit[30][WT_MISFIT_TERMS];
        curve_truth t = curve_standard();
        t.noise = 1e-9;
        for (size_t i = 0; i < 30; i++) {
            curve_truth stated = t;
            curve_make(&t, i + 1, &data);
            stated.tip.radius *= wrong ? 2.5 : 1.0;
            stated.tip.transition_radius =
                wt_tip_tangent_transition(stated.tip.radius, t.tip.half_angle);
            const wt_indent_fit fit = fit_with(&stated, NULL);
            for (size_t j = 0; j < WT_MISFIT_TERMS; j++)
                misfit[i][j] = fit.misfit[j];
        }
        const wt_pooled_misfit pooled =
            wt_pooled_misfit_compute((const double(*)[WT_MISFIT_TERMS])misfit, 30);
        assert_true(wrong ? pooled.p_value < 1e-3 : pooled.p_value > 0.01);
        assert_true(
            isnan(wt_pooled_misfit_compute((const double(*)[WT_MISFIT_TERMS])misfit, 11).p_value));
    }
}

/* Cantilever and adhesive contact in equilibrium: modulus and work of adhesion are recovered;
 * without adhesion the modulus is too large by a third. */
static void adhesive_contact_is_fitted(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.modulus = 5e6;
    t.spring_constant = 0.5;
    t.tip.half_angle = 35 * M_PI / 180;
    t.tip.radius = 20e-9;
    t.tip.transition_radius = wt_tip_tangent_transition(t.tip.radius, t.tip.half_angle);
    t.contact_point = 450e-9;
    wt_contact_table *table = NULL;
    assert_int_equal(wt_contact_table_new(&t.tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    const adhesion law = {table, t.modulus / 0.75, 0.05};
    const double release = adhesion_release(&law, t.spring_constant);
    curve_make(&t, 1, &data);
    for (size_t i = 0; i < t.n; i++) {
        const double z = data.height[i] - t.height0 - t.contact_point;
        if (!(z > 0.0))
            continue;
        double bare;
        adhesion_balance(&law, t.spring_constant, release, &z, 1, &bare);
        data.force[i] += adhesion_contact_value(&law, bare).force - curve_contact_force(&t, z);
    }
    wt_contact_table_free(table);
    const wt_indent_fit fit = expect(&t, WT_CURVE_ACCEPTED, "with adhesion of");
    assert_near(fit.modulus.value, t.modulus, 4 * fit.modulus.standard_error / t.modulus);
    assert_true(fit.modulus.standard_error < 0.03 * t.modulus);
    assert_near_abs(fit.work_of_adhesion.value, 0.05, 4 * fit.work_of_adhesion.standard_error);
    assert_true(fit.work_of_adhesion.standard_error < 0.003 && fit.tabor_number > 5);
    t.tip.sample_thickness.value = 1e-3; /* no base has an effect */
    const wt_indent_fit thick = expect(&t, WT_CURVE_ACCEPTED, "with adhesion of");
    assert_near(thick.modulus.value, fit.modulus.value, 1e-3);
}

/* A retraction that returns `share` of the force and begins some samples below the maximum. */
static double loss_of(const curve_truth *t, double share, size_t late)
{
    static curve_data out;
    wt_contact_table *table = NULL;
    wt_indent_fit fit;
    curve_make(t, 1, &data);
    for (size_t i = 0; i + late < t->n; i++) {
        const size_t j = t->n - 1 - late - i;
        const double baseline = t->offset + t->tilt * (data.height[j] - t->height0);
        out.height[i] = data.height[j];
        out.force[i] = baseline + share * (data.force[j] - baseline);
    }
    const curve_branch in = {data.height, data.force, data.time, t->n};
    const curve_branch back = {out.height, out.force, NULL, t->n - late};
    assert_int_equal(wt_contact_table_new(&t->tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    assert_int_equal(curve_fit_branches(table, NULL, &in, &back, false, t->spring_constant,
                                        workspace, &fit, NULL),
                     WT_OK);
    wt_contact_table_free(table);
    return fit.loss;
}

/* The cantilever stores most of the work. A loss of the total may exceed the work of the sample: it
 * is not a loss of the sample. */
static void loss_of_the_sample(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.spring_constant = 0.1;
    t.travel = 900e-9;
    t.contact_point = 296.37e-9;
    const double z = t.travel - t.contact_point, top = curve_contact_force(&t, z);
    double work = 0.0, cantilever = 0.5 * top * top / t.spring_constant;
    for (int i = 0; i < 1000; i++)
        work += curve_contact_force(&t, z * (i + 0.5) / 1000) * z / 1000;
    assert_true((work - cantilever) / work < 0.25);
    assert_near(loss_of(&t, 0.97, 0), 0.03 * work / (work - cantilever), 0.05);
    assert_true(isnan(loss_of(&t, 0.7, 0)));
    /* the sample does not return more than it received */
    assert_true(isnan(loss_of(&t, 1.3, 0)));
    assert_near_abs(loss_of(&t, 1, 5), 0, 0.01); /* absent work is not a loss */
}

static void names_of_verdicts(void **state)
{
    (void)state;
    assert_string_equal(wt_curve_verdict_id(WT_CURVE_DRIFT), "disturbed_baseline");
    assert_string_equal(wt_curve_verdict_text(WT_CURVE_ACCEPTED), "accepted");
    assert_string_equal(wt_curve_verdict_id((wt_curve_verdict)999), "unknown");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(never_touches),
        cmocka_unit_test(starts_in_contact),
        cmocka_unit_test(saturated_detector),
        cmocka_unit_test(missing_and_repeated_samples),
        cmocka_unit_test(disturbed_baseline),
        cmocka_unit_test(spikes),
        cmocka_unit_test(softly_saturated_detector),
        cmocka_unit_test(uneven_heights),
        cmocka_unit_test(deeper_than_the_sphere),
        cmocka_unit_test(too_uncertain),
        cmocka_unit_test(weak_nonlinearity_is_not_saturation),
        cmocka_unit_test(curves_together),
        cmocka_unit_test(adhesive_contact_is_fitted),
        cmocka_unit_test(loss_of_the_sample),
        cmocka_unit_test(wrong_direction),
        cmocka_unit_test(too_stiff_for_the_cantilever),
        cmocka_unit_test(more_bending_than_travel),
        cmocka_unit_test(snap_in_is_excluded),
        cmocka_unit_test(wrong_tip_is_detected),
        cmocka_unit_test(several_contact_points),
        cmocka_unit_test(one_contact_point),
        cmocka_unit_test(meaningless_data_have_a_verdict),
        cmocka_unit_test(names_of_verdicts),
    };
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
