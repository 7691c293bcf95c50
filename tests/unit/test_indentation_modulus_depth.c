/* Modulus against depth from many curves: a layer that a homogeneous fit of one curve hides, a
 * wrong tip, no change, and too little data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fitted_curve.h"

#include "indentation/curve_tables.h"
#include "indentation/law/tip.h"

#include <stdio.h>
#include <string.h>

enum { CURVES = 30 };

/* Relative to solutions of the integral equation with 11 digits. */
static void quick_form(void **state)
{
    (void)state;
    FILE *file = fopen(WT_SHARED_DIR "/reference/indentation/layer.csv", "r");
    char line[512];
    int rows = 0;
    if (file == NULL)
        skip();
    while (fgets(line, sizeof line, file) != NULL) {
        double ratio, x[7];
        char tip[16];
        if (sscanf(line, "%lf %15s %lf %lf %lf %lf %lf %lf %lf", &ratio, tip, x, x + 1, x + 2,
                   x + 3, x + 4, x + 5, x + 6) != 9 ||
            !thin_layer_is_valid(ratio, x[6]))
            continue;
        assert_near(thin_layer_apparent_modulus(ratio, x[6]), x[4], 0.02);
        rows++;
    }
    fclose(file);
    assert_true(rows > 40);
}

typedef struct scene {
    double ratio, thickness; /* of a layer; 0: none */
    double radius_factor;    /* of the true tip */
    double noise;            /* [N] */
    double bow;              /* bow of the force over the approach [N] */
    double loss_error;       /* of the modulus, as if the rubber had loss */
} scene;

static curve_truth truth_of(const scene *s)
{
    curve_truth t = {.tip = {.sides = 4, .half_angle = 35 * M_PI / 180, .radius = 20e-9},
                     .modulus = 5e6,
                     .poisson_ratio = 0.5,
                     .spring_constant = 0.5,
                     .n = 1200,
                     .travel = 400e-9,
                     .contact_point = 280e-9,
                     .noise = s->noise,
                     .direction = 1.0,
                     .height0 = 1e-6};
    t.tip.transition_radius = wt_tip_tangent_transition(t.tip.radius, t.tip.half_angle);
    return t;
}

static double apparent(const scene *s, const wt_tip *tip, double depth)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    return s->ratio > 0 ? thin_layer_apparent_modulus(s->ratio, slope / 2 / s->thickness) : 1;
}

static double force_at(const scene *s, const curve_truth *t, const wt_tip *tip, double z)
{
    double low = 0, high = z;
    for (int i = 0; z > 0 && i < 60; i++) {
        const double middle = 0.5 * (low + high);
        double g, slope;
        wt_contact_function(tip, middle, &g, &slope);
        *(t->spring_constant * (z - middle) > t->modulus / 0.75 * apparent(s, tip, middle) * g
              ? &low
              : &high) = middle;
    }
    return z > 0 ? t->spring_constant * (z - low) : 0;
}

static wt_modulus_profile depth_of(const scene *s, size_t n, long spots)
{
    static double clean[CURVE_MAX];
    const curve_truth t = truth_of(s);
    wt_contact_table *table = NULL;
    wt_curve_residuals curve[CURVES];
    wt_modulus_profile depth;
    wt_tip tip = t.tip;
    uint64_t seed = 7;
    tip.radius *= s->radius_factor;
    tip.transition_radius *= s->radius_factor;
    assert_int_equal(wt_contact_table_new(&t.tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    for (size_t i = 0; i < t.n; i++) {
        data.height[i] = t.height0 + t.travel * (double)i / (double)(t.n - 1);
        const double x = (double)i / (double)t.n;
        clean[i] = force_at(s, &t, &tip, data.height[i] - t.height0 - t.contact_point) +
                   4 * s->bow * x * (1 - x);
    }
    for (size_t c = 0; c < n; c++) {
        wt_indent_fit fit;
        for (size_t i = 0; i < t.n; i++)
            data.force[i] = clean[i] + t.noise * curve_normal(&seed);
        assert_int_equal(wt_indent_fit_curve(table, NULL, data.height, data.force, NULL, t.n,
                                             t.spring_constant, workspace, &fit, NULL),
                         WT_OK);
        assert_true(wt_curve_verdict_is_usable(fit.verdict) || fit.verdict == WT_CURVE_POOR_FIT);
        curve[c] = (wt_curve_residuals){.modulus = fit.modulus.value,
                                        .depth = fit.max_indentation,
                                        .spring_constant = t.spring_constant,
                                        .baseline = fit.baseline_length,
                                        .window = fit.misfit_length,
                                        .curvature = fit.baseline_curvature,
                                        .loss_error = s->loss_error,
                                        .spot = (long)c % spots};
        memcpy(curve[c].misfit, fit.misfit, sizeof fit.misfit);
    }
    assert_int_equal(wt_modulus_profile_fit(table, 0.5, curve, n, &depth, NULL), WT_OK);
    wt_contact_table_free(table);
    return depth;
}

/* The error includes that of the basis: linear or curved in the contact radius. */
static void assert_moduli(const scene *s, const wt_modulus_profile *d, double rtol)
{
    const curve_truth t = truth_of(s);
    for (size_t i = 0; i < WT_DEPTHS; i++)
        assert_near(d->modulus[i].value, t.modulus * apparent(s, &t.tip, d->depth[i]), rtol);
}

static void no_change(void **state)
{
    (void)state;
    const scene s = {.radius_factor = 1, .noise = 100e-12};
    const wt_modulus_profile d = depth_of(&s, CURVES, CURVES), of_spots = depth_of(&s, CURVES, 5);
    assert_int_equal(d.verdict, WT_DEPTH_SAME);
    assert_true(d.change.low < 1 && d.change.high > 1 && d.change.high < 1.05);
    assert_moduli(&s, &d, 0.01);
    assert_true(isnan(d.thickness.value));
    assert_int_equal(d.n_units, CURVES);
    assert_int_equal(of_spots.n_units, 5);
    const wt_modulus_profile of_two = depth_of(&s, CURVES, 2);
    assert_true(of_two.two_spots && !of_spots.two_spots && !d.two_spots);
    assert_near(of_two.change.value, d.change.value, 1e-9);
    assert_true(isnan(of_two.change.low) && isnan(of_two.change.high));
    assert_true(isnan(of_two.modulus[0].low) && isnan(of_two.change_p));
    assert_int_equal(of_two.verdict, WT_DEPTH_INCONCLUSIVE);
    assert_near(of_spots.change.value, d.change.value, 1e-9);
}

static void layers(void **state)
{
    (void)state;
    static const scene scenes[] = {{0.5, 40e-9, 1, 100e-12, 0, 0},
                                   {0.4, 60e-9, 1, 400e-12, 0, 0},
                                   {2.5, 60e-9, 1, 100e-12, 0, 0},
                                   {0.7, 30e-9, 1, 100e-12, 0, 0}};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const wt_modulus_profile d = depth_of(&scenes[i], CURVES, CURVES);
        assert_int_equal(d.verdict, WT_DEPTH_CHANGES);
        assert_int_equal(d.change.value > 1, scenes[i].ratio < 1);
        assert_moduli(&scenes[i], &d, 0.06);
        if (!isnan(d.thickness.value)) {
            assert_true(d.thickness.low < 1.2 * scenes[i].thickness &&
                        d.thickness.high > scenes[i].thickness / 1.2);
            assert_near(d.layer_modulus.value, 5e6, 0.3);
            assert_near(d.substrate_modulus.value, 5e6 / scenes[i].ratio, 0.3);
        }
        print_message("ratio %g, %g nm: %g to %g nm, %g on %g Pa, left %g\n", scenes[i].ratio,
                      1e9 * scenes[i].thickness, 1e9 * d.thickness.low, 1e9 * d.thickness.high,
                      d.layer_modulus.value, d.substrate_modulus.value, d.misfit_p);
    }
}

static void wrong_tip(void **state)
{
    (void)state;
    const scene s = {.radius_factor = 2, .noise = 400e-12};
    const wt_modulus_profile d = depth_of(&s, CURVES, CURVES);
    assert_int_equal(d.verdict, WT_DEPTH_CHANGES);
    assert_true(d.change.value < 0.95);
}

static void too_little(void **state)
{
    (void)state;
    const scene few = {.radius_factor = 1, .noise = 100e-12},
                noisy = {.radius_factor = 1, .noise = 3e-9};
    const wt_modulus_profile d = depth_of(&few, 11, 11), loud = depth_of(&noisy, 12, 12);
    assert_int_equal(d.verdict, WT_DEPTH_INCONCLUSIVE);
    assert_true(isnan(d.change.value) && isnan(d.thickness.value));
    assert_int_equal(loud.verdict, WT_DEPTH_INCONCLUSIVE);
    assert_true(loud.change.high > 1.1 || loud.change.low < 0.9);
}

/* A change of a few per cent is shown or negligible, but never shown by an interval that contains
 * zero. */
static void little_change(void **state)
{
    (void)state;
    for (double thickness = 500e-9; thickness < 5e-6; thickness *= 1.3) {
        const scene s = {0.4, thickness, 1, 30e-12, 0, 0};
        const wt_modulus_profile d = depth_of(&s, CURVES, CURVES);
        assert_true(d.verdict == WT_DEPTH_SAME || d.change.low > 1 || d.change.high < 1);
    }
}

static void assert_held(const scene *s, const wt_modulus_profile *d)
{
    for (size_t i = 0; i < WT_DEPTHS; i++)
        assert_true(d->modulus[i].low < 5e6 && d->modulus[i].high > 5e6);
    assert_true(s->bow > 0 || d->curvature_share < 0.01);
}

/* A curvature that all baselines share does not scatter: the intervals include it, and no change is
 * found. With little noise they would not without it. */
static void curved_baselines(void **state)
{
    (void)state;
    for (double bow = 150e-12; bow < 700e-12; bow *= 1.7) {
        const scene s = {.radius_factor = 1, .noise = 100e-12, .bow = bow};
        const wt_modulus_profile d = depth_of(&s, CURVES, CURVES);
        assert_held(&s, &d);
        assert_true(d.curvature_share > 0.5 && d.modulus[4].value < 5e6 * 0.99);
        assert_true(d.modulus[4].high < 5e6 * 1.12);
        assert_true(d.verdict == WT_DEPTH_SAME || d.verdict == WT_DEPTH_INCONCLUSIVE);
    }
}

/* So does the error of a viscoelastic response; if the effect of the loss is unknown, there is no
 * statement. */
static void loss(void **state)
{
    (void)state;
    const scene clean = {.radius_factor = 1, .noise = 100e-12},
                lossy = {.radius_factor = 1, .noise = 100e-12, .loss_error = 0.04},
                unknown = {.radius_factor = 1, .noise = 100e-12, .loss_error = (double)NAN};
    const wt_modulus_profile a = depth_of(&clean, CURVES, CURVES),
                             b = depth_of(&lossy, CURVES, CURVES),
                             c = depth_of(&unknown, CURVES, CURVES);
    assert_near(b.modulus[4].value, a.modulus[4].value, 1e-12);
    assert_near(b.modulus[4].standard_error, 0.04 * 5e6, 0.1);
    assert_true(b.modulus[0].standard_error > 1.5 * b.modulus[4].standard_error);
    assert_int_equal(a.verdict, WT_DEPTH_SAME);
    assert_int_equal(b.verdict, WT_DEPTH_INCONCLUSIVE);
    assert_true(b.loss_share > 0.9 && a.loss_share < 1e-9);
    assert_int_equal(c.verdict, WT_DEPTH_INCONCLUSIVE);
    assert_true(isnan(c.change.value) && c.n == 0 && c.n_excluded_by_loss == CURVES);
}

/* The viscoelastic error of the moduli of layer and substrate equals that of the modulus at full
 * depth; it widens their intervals in the squares. */
static void loss_of_layers(void **state)
{
    (void)state;
    static const scene scenes[] = {{0.5, 40e-9, 1, 100e-12, 0, 0}, {2.5, 60e-9, 1, 100e-12, 0, 0}};
    size_t told = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        scene lossy = scenes[i];
        lossy.loss_error = 0.03;
        const wt_modulus_profile d[2] = {depth_of(&scenes[i], CURVES, CURVES),
                                         depth_of(&lossy, CURVES, CURVES)};
        if (isnan(d[0].thickness.value) || isnan(d[1].thickness.value))
            continue;
        const size_t last = WT_DEPTHS - 1;
        double more[3] = {0};
        for (size_t k = 0; k < 2; k++) {
            const wt_interval of[3] = {d[k].modulus[last], d[k].layer_modulus,
                                       d[k].substrate_modulus};
            for (size_t j = 0; j < 3; j++)
                more[j] += (k == 1 ? 1 : -1) * pow(log(of[j].high / of[j].value), 2);
        }
        assert_near(more[1], more[0], 0.1); /* Student's t has other degrees of freedom */
        assert_near(more[2], more[0], 0.1);
        told++;
    }
    assert_true(told > 0);
}

/* The verdict on a change agrees with its interval, and the advice with its largest error. */
static void text_of_a_change(void **state)
{
    (void)state;
    static const struct {
        wt_interval change;
        const char *changes, *reading;
    } cases[] = {
        {{1.4, 0.1, 1.2, 1.6}, "yes: the modulus at 50.0 nm differs", "the layer is softer than"},
        {{0.7, 0.1, 0.5, 0.9}, "yes: the modulus at 50.0 nm differs", "is stiffer than"},
        {{1.05, 0.02, 1.01, 1.09}, "yes, but hardly", "is softer than"},
        {{1.1, 0.2, 0.8, 1.5},
         "the curves do not determine the size and sign of the change "
         "(factor 1.100",
         "softer or stiffer than"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_modulus_profile d = {.verdict = WT_DEPTH_CHANGES,
                                .change = cases[i].change,
                                .thickness = {(double)NAN, 0, 0, 0}};
        wt_indent_tables tables = {0};
        for (size_t j = 0; j < WT_DEPTHS; j++)
            d.depth[j] = 10e-9 * (double)(j + 1);
        assert_int_equal(flow_depth_table_add(&tables, "bulk", &d, NULL), WT_OK);
        assert_non_null(
            strstr(wt_table_key(tables.modulus_depth, "changes_bulk"), cases[i].changes));
        assert_non_null(
            strstr(wt_table_key(tables.modulus_depth, "reading_bulk"), cases[i].reading));
        wt_indent_tables_clear(&tables);
    }
}

static void text_without_result(void **state)
{
    (void)state;
    static const struct {
        wt_depth_verdict verdict;
        double bend_share, loss_share;
        size_t n_excluded_by_loss;
        const char *words;
        bool two_spots;
    } cases[] = {
        {WT_DEPTH_INCONCLUSIVE, 0, 0, 0, "two spots do not allow an interval", true},
        {WT_DEPTH_INCONCLUSIVE, 0, 0, 0, "more curves would decide", false},
        {WT_DEPTH_INCONCLUSIVE, 0.6, 0, 0,
         "curves of a straight piezo, or one that has "
         "settled, would decide",
         false},
        {WT_DEPTH_INCONCLUSIVE, 0, 0.6, 0, "the DMA of the rubber would decide", false},
        {WT_DEPTH_INCONCLUSIVE, 0, 0, 40, "inconclusive: 40 of 70 curves lose work", false},
        {WT_DEPTH_OTHER_RESIDUAL, 0, 0, 0, "another tip or rate would decide", false},
        {WT_DEPTH_OTHER_RESIDUAL, 0.1, 0, 0,
         "curves of a straight piezo, or one that has settled, would decide", false},
        {WT_DEPTH_OTHER_RESIDUAL, 0, 0.1, 0, "the DMA of the rubber would decide", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const wt_modulus_profile d = {.n = 30,
                                      .n_excluded_by_loss = cases[i].n_excluded_by_loss,
                                      .verdict = cases[i].verdict,
                                      .two_spots = cases[i].two_spots,
                                      .change = {1, 0.1, 0.8, 1.2},
                                      .curvature_share = cases[i].bend_share,
                                      .loss_share = cases[i].loss_share};
        wt_indent_tables tables = {0};
        assert_int_equal(flow_depth_table_add(&tables, "bulk", &d, NULL), WT_OK);
        const char *words = wt_table_key(tables.modulus_depth, "changes_bulk");
        assert_ptr_equal(strstr(words, "inconclusive"), words);
        assert_non_null(strstr(words, cases[i].words));
        wt_indent_tables_clear(&tables);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quick_form),
        cmocka_unit_test(no_change),
        cmocka_unit_test(layers),
        cmocka_unit_test(wrong_tip),
        cmocka_unit_test(too_little),
        cmocka_unit_test(text_of_a_change),
        cmocka_unit_test(little_change),
        cmocka_unit_test(curved_baselines),
        cmocka_unit_test(loss),
        cmocka_unit_test(loss_of_layers),
        cmocka_unit_test(text_without_result),
    };
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
