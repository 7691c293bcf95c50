/* Fit of a force curve with known truth: values, errors and their coverage, the sensitivity budget,
 * and curves as read from a file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fitted_curve.h"

#include "indentation/numerics/curve_model.h"

#include <stdlib.h>
#include <string.h>

static wt_indent_fit fit_default(const curve_truth *t)
{
    wt_indent_options options = every_curve();
    return fit_with(t, &options);
}

static double true_contact(const curve_truth *t)
{
    return t->direction * t->height0 + t->contact_point;
}

static void exact_curves_give_the_truth(void **state)
{
    (void)state;
    for (int variant = 0; variant < 6; variant++) {
        curve_truth t = curve_standard();
        t.noise = 0.0;
        wt_indent_options options = every_curve();
        if (variant == 1)
            t.direction = -1.0; /* the height decreases towards the sample */
        if (variant == 2) {     /* a cantilever much softer than the contact */
            t.spring_constant = 0.1;
            t.travel = 900e-9;
            t.contact_point = 296.37e-9;
            t.tilt = 1e-4;
        }
        if (variant == 3) { /* a sphere on a soft sample, another Poisson ratio */
            t.tip = (wt_tip){.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
            t.modulus = 1234.5;
            t.poisson_ratio = options.poisson_ratio = 0.3;
            t.spring_constant = 0.03;
            t.travel = 6e-6;
            t.contact_point = 3.1415e-6;
            t.offset = -2e-9;
            t.tilt = 5e-5;
        }
        if (variant == 4) { /* the residual of other programs has the same zero */
            options.plain_least_squares = true;
            options.fit_tilt = false;
            t.tilt = 0.0;
        }
        if (variant == 5)
            t.tilt = -0.02;
        curve_make(&t, 1, &data);
        wt_indent_fit fit = fit_with(&t, &options);
        assert_accepted(&fit);
        assert_string_equal(fit.reason, "accepted");
        assert_near(fit.modulus.value, t.modulus, 1e-8);
        assert_near_abs(fit.contact_point.value, true_contact(&t), 1e-7 * t.travel);
        assert_near(fit.baseline_offset.value, t.offset + t.tilt * t.contact_point, 1e-8);
        assert_near_abs(fit.baseline_tilt.value, t.tilt, 1e-9);
        assert_near(fit.direction, t.direction, 0.0);
        assert_int_equal(fit.n_fitted, t.n);
        double z = t.travel - t.contact_point, force = curve_contact_force(&t, z);
        assert_near(fit.max_force, force, 1e-7);
        assert_near(fit.max_indentation, z - force / t.spring_constant, 1e-7);
        assert_near(fit.piezo_rate, t.travel / 0.5, 1e-9);
        assert_near(fit.load_time, 0.5 * z / t.travel, 1e-6);
        assert_near(fit.indentation_rate, fit.max_indentation / fit.load_time, 1e-12);
        assert_int_equal(fit.contact_index,
                         (size_t)ceil(t.contact_point / t.travel * (double)(t.n - 1)));
        assert_near(fit.adhesion_force, 0.0, 0.0);
        assert_string_equal(fit.modulus.unit, "Pa");
        assert_string_equal(fit.baseline_tilt.unit, "N/m");
    }
}

/* 95 % intervals of all four parameters with white and correlated noise, stiff and soft cantilever.
 * The coverage of 240 intervals has a standard deviation of 1.4 %. */
static void intervals_cover_the_truth(void **state)
{
    (void)state;
    const struct {
        double spring_constant, travel, contact_point, tilt, noise, correlation;
        size_t n;
    } cases[] = {
        {1.0, 600e-9, 476.43e-9, 1e-3, 50e-12, 0.0, 600},
        {1.0, 600e-9, 556.43e-9, 1e-3, 50e-12, 0.0, 400}, /* a short contact */
        {1.0, 600e-9, 476.43e-9, 1e-3, 50e-12, 0.8, 1000},
        {1.0, 600e-9, 476.43e-9, 1e-3, 50e-12, 0.95, 2000},
        {0.1, 900e-9, 296.37e-9, 1e-4, 50e-12, 0.0, 600}, /* 13 times stiffer than the cantilever */
        {0.1, 900e-9, 296.37e-9, 1e-4, 50e-12, 0.8, 1000},
    };
    enum { CURVES = 240 };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        curve_truth t = curve_standard();
        t.spring_constant = cases[i].spring_constant;
        t.travel = cases[i].travel;
        t.contact_point = cases[i].contact_point;
        t.tilt = cases[i].tilt;
        t.noise = cases[i].noise;
        t.correlation = cases[i].correlation;
        t.n = cases[i].n;
        curve_truth silent = t;
        silent.noise = 0.0;
        curve_make(&silent, 0, &data);
        static curve_data truth;
        truth = data;
        wt_contact_table *table = table_of(&t);
        wt_indent_options options = every_curve();
        int covered[4] = {0};
        double sum = 0.0, sum2 = 0.0, errors = 0.0, lengths = 0.0, noise = 0.0;
        for (uint64_t seed = 1; seed <= CURVES; seed++) {
            uint64_t random = seed * 7919;
            double x = t.noise * curve_normal(&random);
            for (size_t k = 0; k < t.n; k++) {
                data.force[k] = truth.force[k] + x;
                x = t.correlation * x +
                    sqrt(1.0 - t.correlation * t.correlation) * t.noise * curve_normal(&random);
            }
            wt_indent_fit fit;
            assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, NULL,
                                                 t.n, t.spring_constant, workspace, &fit, NULL),
                             WT_OK);
            assert_accepted(&fit);
            const wt_estimate got[4] = {fit.modulus, fit.contact_point, fit.baseline_offset,
                                        fit.baseline_tilt};
            const double expected[4] = {t.modulus, true_contact(&t),
                                        t.offset + t.tilt * t.contact_point, t.tilt};
            for (int p = 0; p < 4; p++)
                covered[p] +=
                    fabs(got[p].value - expected[p]) < 1.96 * got[p].standard_error ? 1 : 0;
            double e = fit.modulus.value / t.modulus - 1.0;
            sum += e;
            sum2 += e * e;
            errors += fit.modulus.standard_error / t.modulus;
            lengths += fit.correlation_length;
            noise += fit.noise;
        }
        double bias = sum / CURVES, scatter = sqrt(sum2 / CURVES - bias * bias);
        print_message(
            "k %g N/m, correlation %g: bias %.3f %%, scatter %.3f %%, mean error %.3f %%; "
            "covered: E %d, c %d, offset %d, tilt %d of %d\n",
            t.spring_constant, t.correlation, 100 * bias, 100 * scatter, 100 * errors / CURVES,
            covered[0], covered[1], covered[2], covered[3], CURVES);
        /* A baseline half as long as the contact hardly determines waves of that length. */
        const bool little = t.spring_constant < 1.0;
        for (int p = 0; p < 4; p++)
            assert_in_range(covered[p], 0.88 * CURVES, (little ? 1.0 : 0.99) * CURVES);
        assert_in_range(covered[0], 0.90 * CURVES, 0.99 * CURVES);
        assert_true(errors / CURVES > 0.85 * scatter &&
                    errors / CURVES < (little ? 1.6 : 1.25) * scatter);
        assert_true(fabs(bias) < 4.0 * scatter / sqrt(CURVES) + 0.1 * scatter);
        assert_near(noise / CURVES, t.noise, 0.05);
        double tau = (1.0 + t.correlation) / (1.0 - t.correlation);
        assert_near(lengths / CURVES, tau, little ? 0.5 : 0.25);
        wt_contact_table_free(table);
    }
}

/* The plain residual is not the default because of its bias: with a cantilever 12 times softer than
 * the contact the modulus is wrong by many standard deviations. */
static void plain_least_squares_is_biased_with_a_soft_cantilever(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.spring_constant = 0.1;
    t.travel = 900e-9;
    t.contact_point = 296.37e-9;
    t.tilt = 1e-4;
    t.n = 600;
    wt_indent_options plain = every_curve();
    plain.plain_least_squares = true;
    double bias = 0.0, bias_plain = 0.0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        curve_make(&t, seed, &data);
        bias += (fit_default(&t).modulus.value / t.modulus - 1.0) / 20;
        bias_plain += (fit_with(&t, &plain).modulus.value / t.modulus - 1.0) / 20;
    }
    assert_true(fabs(bias) < 0.005);
    assert_true(bias_plain < -0.03);
}

/* d ln E/d ln sensitivity against a fit with another sensitivity. The textbook value for a single
 * point with known contact is 1 + S/k. For 20 MPa at 70 nm under this tip S = 1.2261 N/m, hence
 * 13.3 with 0.1 N/m and 2.2 with 1 N/m, and 14.6 % and 2.25 % for an increase by 1 %. (15.6 % and
 * 2.3 % are also quoted for this case.) A fit of the whole curve with its contact point is close to
 * these values. */
static void sensitivity_budget(void **state)
{
    (void)state;
    const double k[2] = {0.1, 1.0}, point[2] = {13.261, 2.2261}, step[2] = {14.64, 2.25};
    for (int i = 0; i < 2; i++) {
        curve_truth t = curve_standard();
        double g, slope, g_less, unused, force;
        wt_contact_function(&t.tip, 70e-9, &g, &slope);
        force = t.modulus / 0.75 * g;
        assert_near(force, 53.57e-9, 1e-4);
        assert_near(1.0 + t.modulus / 0.75 * slope / k[i], point[i], 1e-4);
        wt_contact_function(&t.tip, 70e-9 - 0.01 * force / k[i], &g_less, &unused);
        assert_near(100.0 * (1.01 * g / g_less - 1.0), step[i], 1e-3);

        t.noise = 0.0;
        t.spring_constant = k[i];
        t.contact_point = 500e-9;
        t.travel = t.contact_point + 70e-9 + force / k[i];
        curve_make(&t, 0, &data);
        wt_indent_fit fit = fit_default(&t);
        assert_accepted(&fit);
        assert_true(fit.sensitivity_gain > 0.8 * point[i] && fit.sensitivity_gain < 1.4 * point[i]);
        double modulus[2];
        const double change[2] = {0.9995, 1.0005};
        for (int s = 0; s < 2; s++) {
            curve_make(&t, 0, &data);
            for (size_t j = 0; j < t.n; j++)
                data.force[j] *= change[s];
            modulus[s] = fit_default(&t).modulus.value;
        }
        double gain = log(modulus[1] / modulus[0]) / log(change[1] / change[0]);
        assert_near(fit.sensitivity_gain, gain, 0.01);
    }
}

/* A baseline that enters by its sums has the same cost as its samples, also when the contact point
 * moves into it. */
static void baseline_by_sums(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    wt_contact_table *table = table_of(&t);
    curve_make(&t, 1, &data);
    curve_reserve(workspace, t.n);
    curve_samples samples = {.n = t.n,
                             .position = data.height,
                             .force = data.force,
                             .spring_constant = t.spring_constant};
    curve_law m = {.table = table, .samples = &samples, .workspace = workspace};
    double p[CURVE_N_PARAMETERS];
    p[CURVE_E] = t.modulus / 0.75;
    p[CURVE_C] = true_contact(&t);
    p[CURVE_F0] = t.offset;
    p[CURVE_T] = t.tilt;
    curve_model_start(&m, p);
    static const double moves[] = {0, 20e-9, -10e-9, -100e-9, -300e-9, 50e-9};
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        p[CURVE_C] = true_contact(&t) + moves[i];
        const double cost = curve_model_cost(&m, p);
        curve_model_complete(&m, p);
        assert_near(curve_dot(workspace->residual, workspace->residual, t.n), cost, 1e-6);
        curve_law one_by_one = {.table = table, .samples = &samples, .workspace = workspace};
        assert_near(curve_model_cost(&one_by_one, p), cost, 1e-6);
    }
    wt_contact_table_free(table);
}

/* The largest force may be at any sample, the first one included. */
static void largest_force(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    const double largest = fit_with(&t, NULL).max_force;
    for (size_t i = 0; i < 20; i++) /* few are spikes */
        data.force[i] += 10 * largest;
    wt_indent_fit fit = fit_with(&t, NULL);
    assert_near(fit.max_force, 10 * largest, 0.1);
}

/* At the ends there are neighbours on one side only. */
static void spikes_at_the_ends(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 1, &data);
    const double modulus = fit_default(&t).modulus.value;
    const double step = fabs(data.force[t.n - 1] - data.force[t.n - 21]) / 20;
    data.force[0] += 40 * step;
    data.force[4] += 30 * step;
    data.force[t.n - 5] += 30 * step;
    data.force[t.n - 4] += 30 * step;
    data.force[t.n - 1] += 40 * step;
    const wt_indent_fit fit = fit_default(&t);
    assert_int_equal(fit.n_fitted, t.n - 5);
    assert_near(fit.modulus.value, modulus, 0.01);
}

/* A stated contact point is fixed and has no error. */
static void contact_point_given(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    wt_indent_options options = every_curve();
    options.fixed_contact_point = true_contact(&t);
    wt_indent_fit fit = fit_with(&t, &options);
    assert_accepted(&fit);
    assert_near(fit.modulus.value, t.modulus, 1e-8);
    assert_near(fit.contact_point.value, true_contact(&t), 1e-15);
    assert_near(fit.contact_point.standard_error, 0.0, 0.0);
    options.fixed_contact_point += 2e-9;
    assert_true(fit_with(&t, &options).modulus.value > 1.02 * t.modulus);
}

/* A baseline with a step before the chosen part and a curvature after it: the modulus is that of a
 * straight baseline, and the contact point is free. */
static void baseline_given(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    curve_make(&t, 0, &data);
    const double contact = true_contact(&t), before = contact - data.height[0];
    wt_indent_options options = every_curve();
    options.baseline_from = contact - 0.6 * before;
    options.baseline_to = contact - 0.2 * before;
    for (size_t i = 0; i < t.n; i++)
        if (data.height[i] < options.baseline_from)
            data.force[i] += 2e-9;
        else if (data.height[i] > options.baseline_to && data.height[i] < contact)
            data.force[i] += 3e-9 * sin(M_PI * (data.height[i] - options.baseline_to) /
                                        (contact - options.baseline_to));
    wt_indent_options all = every_curve();
    assert_true(fabs(fit_with(&t, &all).modulus.value / t.modulus - 1) > 0.01);
    const wt_indent_fit fit = fit_with(&t, &options);
    assert_near(fit.modulus.value, t.modulus, 1e-3);
    assert_near(fit.contact_point.value, contact, 1e-3);
    assert_near(fit.baseline_length, 0.6 * before, 0.02);
    options.baseline_from = contact + 1e-9;
    assert_int_equal(fit_with(&t, &options).verdict, WT_CURVE_NO_BASELINE);
}

/* Another zero of height and force, or other curves before it: the same result. */
static void irrelevant_changes_have_no_effect(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    curve_make(&t, 5, &data);
    wt_indent_fit first = fit_default(&t);
    assert_accepted(&first);
    const double *block = workspace->block;
    curve_truth other = t;
    other.modulus = 3e6;
    other.n = 1000;
    curve_make(&other, 6, &data);
    wt_indent_fit between = fit_default(&other);
    assert_accepted(&between);
    curve_make(&t, 5, &data);
    wt_indent_fit again = fit_default(&t);
    assert_true(first.modulus.value == again.modulus.value &&
                first.modulus.standard_error == again.modulus.standard_error &&
                first.contact_point.value == again.contact_point.value);
    assert_ptr_equal(workspace->block, block); /* no allocation after the first curves */

    t.height0 += 1e-6;
    t.offset -= 7e-9;
    curve_make(&t, 5, &data);
    wt_indent_fit moved = fit_default(&t);
    assert_near(moved.modulus.value, first.modulus.value, 1e-7);
    assert_near(moved.modulus.standard_error, first.modulus.standard_error, 1e-5);
    assert_near_abs(moved.contact_point.value - first.contact_point.value, 1e-6, 1e-14);
    assert_near_abs(moved.baseline_offset.value - first.baseline_offset.value, -7e-9, 1e-15);
}

static void points_for_plots(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.noise = 0.0;
    t.direction = -1.0;
    curve_make(&t, 0, &data);
    wt_indent_fit fit = fit_default(&t);
    static double delta[CURVE_MAX], force[CURVE_MAX];
    size_t n =
        wt_indent_plot_points(&fit, data.height, data.force, t.n, t.spring_constant, delta, force);
    assert_int_equal(n, t.n - fit.contact_index);
    for (size_t i = 0; i < n; i++) {
        double g, slope;
        wt_contact_function(&t.tip, delta[i], &g, &slope);
        assert_near_abs(force[i], t.modulus / 0.75 * g, 1e-7 * fit.max_force);
    }
}

/* ---- curves from files ----------------------------------------------------------------------- */

static void add_segment(wt_force_curve *curve, wt_segment_kind kind, wt_quantity quantity,
                        double factor, const curve_truth *t)
{
    wt_segment *segment = wt_force_curve_add_segment(curve, kind, t->n, 2);
    assert_non_null(segment);
    /* The last sample is half a second after the first; the duration includes the next one. */
    segment->duration = 0.5 * (double)t->n / (double)(t->n - 1);
    segment->channels[0].quantity = WT_Q_HEIGHT;
    segment->channels[1].quantity = quantity;
    for (size_t i = 0; i < t->n; i++) {
        segment->channels[0].values[i] = data.height[i];
        segment->channels[1].values[i] = factor * data.force[i];
    }
}

static void force_curve_as_read(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    wt_contact_table *table = table_of(&t);
    wt_indent_options options = every_curve();
    curve_make(&t, 3, &data);
    wt_indent_fit expected = fit_default(&t), fit;
    const struct {
        wt_quantity quantity;
        double factor;
    } channels[] = {{WT_Q_FORCE, 1.0},
                    {WT_Q_DEFLECTION, 1.0 / t.spring_constant},
                    {WT_Q_DEFLECTION_VOLTAGE, 1.0 / (t.spring_constant * 50e-9)}};
    wt_force_curve curve = {0};
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < 3; i++) {
        wt_force_curve_reset(&curve);
        curve.cantilever =
            (wt_cantilever){.spring_constant = t.spring_constant, .sensitivity = 50e-9};
        add_segment(&curve, WT_SEGMENT_APPROACH, channels[i].quantity, channels[i].factor, &t);
        assert_int_equal(wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, &err),
                         WT_OK);
        assert_accepted(&fit);
        assert_near(fit.modulus.value, expected.modulus.value, 1e-8);
        assert_near(fit.load_time, expected.load_time, 1e-8); /* from the duration */
    }
    curve.cantilever.sensitivity = (double)NAN;
    assert_int_equal(wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, &err),
                     WT_E_MISSING);
    assert_non_null(strstr(err.advice, "--sensitivity"));
    curve.cantilever.spring_constant = (double)NAN;
    assert_int_equal(wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, &err),
                     WT_E_MISSING);
    assert_non_null(strstr(err.advice, "--spring-constant"));

    /* Retract before approach in the file, and a file without approach. */
    wt_force_curve_reset(&curve);
    curve.cantilever.spring_constant = t.spring_constant;
    add_segment(&curve, WT_SEGMENT_RETRACT, WT_Q_FORCE, 1.0, &t);
    assert_int_equal(wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, &err),
                     WT_OK);
    assert_int_equal(fit.verdict, WT_CURVE_NO_APPROACH);
    assert_non_null(strstr(fit.reason, "retract"));
    assert_true(isnan(fit.modulus.value));
    add_segment(&curve, WT_SEGMENT_APPROACH, WT_Q_FORCE, 1.0, &t);
    assert_int_equal(wt_indent_fit_force_curve(table, &options, &curve, workspace, &fit, &err),
                     WT_OK);
    assert_accepted(&fit);
    assert_non_null(strstr(fit.reason, "retract comes first"));
    assert_near(fit.modulus.value, expected.modulus.value, 1e-8);

    wt_force_curve_clear(&curve);
    wt_contact_table_free(table);
}

static void arguments(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    wt_contact_table *table = table_of(&t);
    wt_indent_options options = every_curve();
    wt_indent_fit fit;
    curve_make(&t, 1, &data);
    const double bad[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, NULL, t.n,
                                             bad[i], workspace, &fit, NULL),
                         WT_E_ARG);
    assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, NULL, 0, 1.0,
                                         workspace, &fit, NULL),
                     WT_E_ARG);
    options.poisson_ratio = 0.6;
    assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, NULL, t.n, 1.0,
                                         workspace, &fit, NULL),
                     WT_E_RANGE);
    options = every_curve();
    options.fit_force_fraction = 0.0;
    assert_int_equal(wt_indent_fit_curve(table, &options, data.height, data.force, NULL, t.n, 1.0,
                                         workspace, &fit, NULL),
                     WT_E_RANGE);
    wt_contact_table_free(table);
    wt_indent_workspace_free(NULL);
}

/* ---- a further step -------------------------------------------------------------------------- */

enum { UNKNOWNS = 4 };

/* Force at E, contact point, offset there, tilt. */
static double modelled(const curve_truth *t, const double p[UNKNOWNS], double z)
{
    curve_truth at = *t;
    at.modulus = p[0];
    return p[2] + p[3] * (z - p[1]) + curve_contact_force(&at, z - p[1]);
}

/* Solves for two right sides. */
static void solve_normal(double a[UNKNOWNS][UNKNOWNS], double b[2][UNKNOWNS])
{
    for (int k = 0; k < UNKNOWNS; k++)
        for (int i = 0; i < UNKNOWNS; i++) {
            const double share = i == k ? 0 : a[i][k] / a[k][k];
            for (int j = 0; j < UNKNOWNS; j++)
                a[i][j] -= share * a[k][j];
            for (int j = 0; j < 2; j++)
                b[j][i] -= share * b[j][k];
        }
    for (int k = 0; k < UNKNOWNS; k++)
        for (int j = 0; j < 2; j++)
            b[j][k] /= a[k][k];
}

/* Gauss-Newton step by differences from the end of the fit, relative: the step of the modulus, and
 * the largest possible one for a step of this length in all unknowns. */
static void step_from(const curve_truth *t, const wt_indent_fit *fit, double *step, double *most)
{
    const double unit[UNKNOWNS] = {1e5, 1e-10, 1e-11, 1e-5};
    const double p[UNKNOWNS] = {fit->modulus.value, fit->contact_point.value - t->height0,
                                fit->baseline_offset.value, fit->baseline_tilt.value};
    double jj[UNKNOWNS][UNKNOWNS] = {{0}}, solved[2][UNKNOWNS] = {{0}, {1, 0, 0, 0}};
    double jr[UNKNOWNS], length = 0;
    for (size_t i = 0; i < t->n; i++) {
        const double z = data.height[i] - t->height0;
        const double r = data.force[i] - modelled(t, p, z);
        double row[UNKNOWNS];
        for (int a = 0; a < UNKNOWNS; a++) {
            double up[UNKNOWNS], down[UNKNOWNS];
            memcpy(up, p, sizeof up);
            memcpy(down, p, sizeof down);
            up[a] += 0.01 * unit[a];
            down[a] -= 0.01 * unit[a];
            row[a] = 50 * (modelled(t, up, z) - modelled(t, down, z));
        }
        for (int a = 0; a < UNKNOWNS; a++) {
            solved[0][a] += row[a] * r;
            for (int b = 0; b < UNKNOWNS; b++)
                jj[a][b] += row[a] * row[b];
        }
    }
    memcpy(jr, solved[0], sizeof jr);
    solve_normal(jj, solved);
    for (int a = 0; a < UNKNOWNS; a++)
        length += jr[a] * solved[0][a];
    *step = fabs(solved[0][0]) * unit[0] / p[0];
    *most = sqrt(length * solved[1][0]) * unit[0] / p[0];
}

static void fit_has_converged(void **state)
{
    (void)state;
    curve_truth t = curve_standard();
    t.n = 500;
    double largest = 0;
    for (uint64_t seed = 1; seed <= 14; seed++) {
        double step, most;
        t.modulus = seed % 2 == 0 ? 20e6 : 2e6;
        curve_make(&t, seed, &data);
        workspace->step_left = workspace->step_allowed = 0;
        const wt_indent_fit fit = fit_default(&t);
        assert_accepted(&fit);
        const double share = fit.modulus.standard_error / fit.modulus.value;
        step_from(&t, &fit, &step, &most);
        assert_near_abs(workspace->step_left, most, 0.02 * most + 3e-10);
        assert_true(step <= workspace->step_left + 3e-10);
        assert_true(workspace->step_left <= workspace->step_allowed);
        /* 1e-5 of the error by uncorrelated noise */
        assert_true(workspace->step_allowed < 2e-5 * share);
        assert_true(workspace->step_allowed > 2e-6 * share);
        largest = fmax(largest, most);
    }
    assert_true(largest > 5e-9); /* the test has found cases */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_curves_give_the_truth),
        cmocka_unit_test(intervals_cover_the_truth),
        cmocka_unit_test(plain_least_squares_is_biased_with_a_soft_cantilever),
        cmocka_unit_test(sensitivity_budget),
        cmocka_unit_test(baseline_by_sums),
        cmocka_unit_test(largest_force),
        cmocka_unit_test(spikes_at_the_ends),
        cmocka_unit_test(contact_point_given),
        cmocka_unit_test(baseline_given),
        cmocka_unit_test(irrelevant_changes_have_no_effect),
        cmocka_unit_test(points_for_plots),
        cmocka_unit_test(force_curve_as_read),
        cmocka_unit_test(arguments),
        cmocka_unit_test(fit_has_converged),
    };
    return cmocka_run_group_tests(tests, make_workspace, free_workspace);
}
