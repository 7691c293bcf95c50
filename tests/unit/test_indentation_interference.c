/* A sine on the baseline (optical interference): exact without noise, found in noise, not found
 * where there is none, and part of the error.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw_count.h"
#include "fitted_curve.h"

#include <string.h>

typedef struct sine {
    double amplitude, period, phase;
    bool by_height;
} sine;

/* 1.2 um of baseline, and 250 nm in contact, of which a fifth bends the cantilever. */
static curve_truth soft(void)
{
    curve_truth t = curve_standard();
    t.tip = (wt_tip){.shape = WT_TIP_PARABOLOID, .radius = 500e-9};
    t.modulus = 50e3;
    t.spring_constant = 0.05;
    t.travel = 1450e-9;
    t.contact_point = 1200.3e-9;
    t.offset = 0.2e-9;
    t.tilt = 1e-5;
    t.noise = 10e-12;
    return t;
}

static void make(const curve_truth *t, const sine *s, uint64_t seed)
{
    curve_make(t, seed, &data);
    for (size_t i = 0; i < t->n; i++) {
        const double z = t->travel * (double)i / (double)(t->n - 1);
        const double bent = curve_contact_force(t, z - t->contact_point) / t->spring_constant;
        const double path = s->by_height ? z : z - bent;
        data.force[i] += s->amplitude * sin(2 * M_PI * path / s->period + s->phase);
    }
}

static wt_indent_fit fit_of(const curve_truth *t)
{
    return fit_with(t, NULL);
}

static void exact(void **state)
{
    (void)state;
    const sine cases[] = {{20e-12, 350e-9, 0.3, false},
                          {20e-12, 350e-9, 2.0, true},
                          {200e-12, 180e-9, 4.0, false},
                          {100e-12, 700e-9, 1.0, true},
                          {100e-12, 700e-9, 5.0, false}};
    curve_truth t = soft();
    t.noise = 1e-16; /* of forces of 2.5 nN */
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        t.direction = i % 2 == 0 ? 1 : -1;
        make(&t, &cases[i], 1 + i);
        const wt_indent_fit fit = fit_of(&t);
        if (fit.verdict != WT_CURVE_ACCEPTED)
            fail_msg("case %zu: %s", i, fit.reason);
        assert_near(fit.modulus.value, t.modulus, 1e-5);
        assert_near(fit.interference_amplitude, cases[i].amplitude, 1e-4);
        assert_near(fit.interference_period, cases[i].period, 1e-5);
        assert_near_abs(fit.contact_point.value, t.direction * t.height0 + t.contact_point, 1e-13);
        assert_non_null(strstr(fit.reason, "interference of "));
    }
}

/* The part outside the fit range is corrected, too. */
static void with_a_range(void **state)
{
    (void)state;
    const sine s = {100e-12, 350e-9, 1.0, false};
    curve_truth t = soft();
    t.noise = 1e-16;
    const double top = curve_contact_force(&t, t.travel - t.contact_point);
    wt_indent_options options[4];
    for (int i = 0; i < 4; i++)
        options[i] = wt_indent_defaults();
    options[0].fit_force_fraction = 0.5;
    options[1].fit_depth = 100e-9;
    options[2].fit_depth_from = 40e-9;
    options[3].fixed_contact_point = t.height0 + t.contact_point;
    make(&t, &s, 1);
    for (int i = 0; i < 4; i++) {
        const wt_indent_fit fit = fit_with(&t, &options[i]);
        if (fit.verdict != WT_CURVE_ACCEPTED)
            fail_msg("case %d: %s", i, fit.reason);
        assert_near(fit.modulus.value, t.modulus, 1e-5);
        assert_near(fit.interference_amplitude, s.amplitude, 1e-4);
        assert_near(fit.max_force, top, 0.02);
    }
}

/* Amplitudes of half and three standard deviations of the noise, white and correlated. */
static void intervals_cover(void **state)
{
    (void)state;
    static const struct {
        double amplitude, period, correlation;
        int found; /* least share of them [%] */
    } cases[] = {{0.5, 250e-9, 0, 75}, {3, 400e-9, 0, 97}, {3, 400e-9, 0.9, 90}};
    enum { CURVES = DRAW_COUNT(200) };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        curve_truth t = soft();
        t.n = 1500;
        t.correlation = cases[i].correlation;
        int covered = 0, contact = 0, accepted = 0, found = 0;
        for (int draw = 0; draw < CURVES; draw++) {
            const sine s = {cases[i].amplitude * t.noise, cases[i].period, 0.7 * draw, draw % 2};
            make(&t, &s, 1 + 7919 * (uint64_t)draw);
            const wt_indent_fit fit = fit_of(&t);
            if (fit.verdict != WT_CURVE_ACCEPTED)
                continue;
            accepted++;
            found += fit.interference_amplitude > 0;
            covered += fabs(fit.modulus.value - t.modulus) < 1.96 * fit.modulus.standard_error;
            contact += fabs(fit.contact_point.value - t.height0 - t.contact_point) <
                       1.96 * fit.contact_point.standard_error;
        }
        print_message("%g noises, correlation %g: %d accepted, %d found, E %d, contact %d\n",
                      cases[i].amplitude, cases[i].correlation, accepted, found, covered, contact);
        if (!TEST_RATES)
            continue;
        assert_in_range(accepted, 0.96 * CURVES, CURVES);
        assert_in_range(100 * found, cases[i].found * accepted, 100 * accepted);
        assert_in_range(covered, 0.90 * accepted, 0.99 * accepted);
        assert_in_range(contact, 0.90 * accepted, 0.99 * accepted);
    }
}

/* One in 1000 baselines without a sine is said to have one; a curved one remains curved. */
static void no_false_alarms(void **state)
{
    (void)state;
    static const double correlation[] = {0, 0.8, 0.95};
    enum { CURVES = DRAW_COUNT(800) };
    for (size_t k = 0; k < sizeof correlation / sizeof correlation[0]; k++) {
        int found = 0, bent = 0;
        curve_truth t = soft();
        t.n = 1000;
        t.correlation = correlation[k];
        for (int draw = 0; draw < CURVES; draw++) {
            curve_make(&t, 3 + 104729 * (uint64_t)draw, &data);
            found += fit_of(&t).interference_amplitude > 0;
            for (size_t i = 0; i < t.n; i++) {
                const double x = (double)i / (double)t.n;
                data.force[i] += 12 * t.noise * x * (1 - x);
            }
            bent += fit_of(&t).interference_amplitude > 0;
        }
        print_message("correlation %g: %d, with a bend %d of %d\n", correlation[k], found, bent,
                      CURVES);
        assert_in_range(found, 0, 5); /* 6 of a mean of 0.8: 2e-4 */
        assert_in_range(bent, 0, 5);
    }
}

static void add(wt_force_curve *curve, wt_segment_kind kind, const curve_truth *t, double pull)
{
    const bool back = kind == WT_SEGMENT_RETRACT;
    wt_segment *segment = wt_force_curve_add_segment(curve, kind, t->n, 2);
    assert_non_null(segment);
    segment->duration = 1;
    segment->channels[0].quantity = WT_Q_HEIGHT;
    segment->channels[1].quantity = WT_Q_FORCE;
    for (size_t i = 0; i < t->n; i++) {
        const size_t from = back ? t->n - 1 - i : i;
        const double z = t->travel * (double)from / (double)(t->n - 1) - t->contact_point;
        segment->channels[0].values[i] = data.height[from];
        segment->channels[1].values[i] =
            data.force[from] - (back && z > -20e-9 && z < 5e-9 ? pull : 0);
    }
}

/* A pull-off causes a fit with adhesion. If that does not describe the curve, all results are as
 * without it. */
static void rejected_adhesion_changes_nothing(void **state)
{
    (void)state;
    wt_contact_table *table = NULL;
    wt_force_curve curve = {0};
    curve_truth t = soft();
    const double top = curve_contact_force(&t, t.travel - t.contact_point);
    assert_int_equal(wt_contact_table_new(&t.tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    for (int draw = 0; draw < 8; draw++) {
        const sine s = {100e-12, 350e-9, 0.7 * draw, draw % 2};
        wt_indent_fit fit[2];
        wt_indent_options options = wt_indent_defaults();
        if (draw >= 4)
            options.fit_force_fraction = 0.8;
        make(&t, &s, 17 + (uint64_t)draw);
        for (size_t i = 0; i < t.n; i++) { /* of no law */
            const double z = t.travel * (double)i / (double)(t.n - 1) - t.contact_point;
            if (z > 0)
                data.force[i] -= 0.03 * top * sin(9 * z / (t.travel - t.contact_point));
        }
        for (int pulled = 0; pulled < 2; pulled++) {
            wt_force_curve_reset(&curve);
            curve.cantilever.spring_constant = t.spring_constant;
            add(&curve, WT_SEGMENT_APPROACH, &t, 0);
            add(&curve, WT_SEGMENT_RETRACT, &t, pulled ? 0.2 * top : 0);
            assert_int_equal(
                wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit[pulled], NULL),
                WT_OK);
        }
        assert_true(fit[0].interference_amplitude > 0 && isnan(fit[1].work_of_adhesion.value));
        assert_near_abs(fit[0].pull_off_force, 0, 0.05 * top);
        assert_true(fit[1].pull_off_force > 0.1 * top);
        assert_near(fit[1].modulus.value, fit[0].modulus.value, 1e-6);
        assert_near(fit[1].interference_period, fit[0].interference_period, 1e-6);
        assert_near(fit[1].max_force, fit[0].max_force, 1e-6);
        assert_near(fit[1].max_indentation, fit[0].max_indentation, 1e-6);
    }
    wt_force_curve_clear(&curve);
    wt_contact_table_free(table);
}

/* Noise is no pull-off, and a pull-off of ten times the noise is found. */
static void noise_does_not_pull(void **state)
{
    (void)state;
    enum { DRAWS = 100 };
    wt_contact_table *table = NULL;
    wt_force_curve curve = {0};
    curve_truth t = curve_standard();
    t.n = 400;
    t.noise = 0.5e-9;
    const wt_indent_options options = wt_indent_defaults();
    assert_int_equal(wt_contact_table_new(&t.tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    for (int pulled = 0; pulled < 2; pulled++) {
        size_t found = 0;
        for (int draw = 0; draw < DRAWS; draw++) {
            wt_indent_fit fit;
            curve_make(&t, 100 + (uint64_t)draw, &data);
            wt_force_curve_reset(&curve);
            curve.cantilever.spring_constant = t.spring_constant;
            add(&curve, WT_SEGMENT_APPROACH, &t, 0);
            curve_make(&t, 900 + (uint64_t)draw, &data);
            add(&curve, WT_SEGMENT_RETRACT, &t, pulled ? 10 * t.noise : 0);
            assert_int_equal(
                wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, NULL), WT_OK);
            found += fit.pull_off_force > 0;
        }
        printf("%zu of %d with a pull-off\n", found, DRAWS);
        assert_true(pulled ? found >= DRAWS - 5 : found <= 1);
    }
    wt_force_curve_clear(&curve);
    wt_contact_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(exact),
                                       cmocka_unit_test(with_a_range),
                                       cmocka_unit_test(intervals_cover),
                                       cmocka_unit_test(no_false_alarms),
                                       cmocka_unit_test(rejected_adhesion_changes_nothing),
                                       cmocka_unit_test(noise_does_not_pull)};
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
