/* Force curves drawn anew: what a noiseless one is fitted with comes back, and the intervals of
 * noisy ones hold it. The curve that the set is made of is that of synthetic_curve.h.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/indent.h"
#include "near.h"
#include "synthetic_curve.h"

#include "indentation/curve_set.h"
#include "weartrack/indentation.h"

#include <string.h>

enum { SAMPLES = 800 };
static curve_data data;

static double term[] = {4e6, 2e6, 1e6}, tau[] = {1e-3, 0.03, 0.5};
static wt_prony spectrum = {.deformation = WT_TENSION,
                            .equilibrium_modulus = 2e6,
                            .n = 3,
                            .modulus = term,
                            .relaxation_time = tau,
                            .frequency_min = 1e-2,
                            .frequency_max = 1e6};

static void add_channel(wt_segment *segment, int number, wt_quantity quantity, const double *values)
{
    segment->channels[number].quantity = quantity;
    memcpy(segment->channels[number].values, values, SAMPLES * sizeof *values);
}

/* The way in, and the way out with what it loses, the largest force once more. */
static void make_segments(wt_force_curve *curve, double loss)
{
    for (int out = 0; out <= (loss > 0); out++) {
        wt_segment *s = wt_force_curve_add_segment(
            curve, out ? WT_SEGMENT_RETRACT : WT_SEGMENT_APPROACH, SAMPLES, 3);
        assert_non_null(s);
        curve_data way = data;
        for (size_t i = 0; out && i < SAMPLES; i++) {
            const double above = data.force[SAMPLES - 1 - i] - data.force[0];
            way.height[i] = data.height[SAMPLES - 1 - i];
            way.force[i] = data.force[0] + above * (i == 0 ? 1 : 1 - loss);
        }
        add_channel(s, 0, WT_Q_HEIGHT, way.height);
        add_channel(s, 1, WT_Q_FORCE, way.force);
        add_channel(s, 2, WT_Q_TIME, data.time);
    }
}

typedef struct fixture {
    wt_curve_set *set;
    wt_contact_table *contact;
    curve_scratch *scratch;
    wt_indent_fit fit;
} fixture;

/* A set of one curve with noise, fitted as it is. */
static void set_up(fixture *f, double noise, double correlation, const wt_prony *known, double loss)
{
    wt_indent_job job = wt_indent_job_defaults();
    wt_indent_options options = wt_indent_defaults();
    wt_force_curve curve = {0};
    curve_truth truth = {.modulus = 5e6,
                         .poisson_ratio = 0.5,
                         .spring_constant = 0.3,
                         .n = SAMPLES,
                         .travel = 1.2e-6,
                         .contact_point = 0.6e-6,
                         .offset = 1e-9,
                         .tilt = 1e-4,
                         .noise = noise,
                         .correlation = correlation,
                         .direction = -1,
                         .height0 = 3e-6};
    assert_int_equal(wt_tip_parse("pyramid:half-angle=35deg,radius=20nm", &truth.tip, NULL), WT_OK);
    curve_make(&truth, 5, &data);
    curve.cantilever.spring_constant = truth.spring_constant;
    make_segments(&curve, loss);
    job.tip = truth.tip;
    job.options = options;
    wt_indent_workspace *workspace = wt_indent_workspace_new();
    f->set = wt_curve_set_new();
    assert_true(workspace != NULL && f->set != NULL);
    assert_int_equal(indent_contact_table(&job.tip, &f->contact, NULL), WT_OK);
    assert_int_equal(
        wt_indent_fit_force_curve(f->contact, &options, &curve, workspace, &f->fit, NULL), WT_OK);
    if (f->fit.verdict != WT_CURVE_ACCEPTED)
        fail_msg("%s", f->fit.reason);
    if (known != NULL)
        f->fit.spectrum_factor = (wt_estimate){1, 0.01, 0, "1"};
    curve_set_begin(f->set, &job);
    assert_int_equal(curve_set_add(f->set, &curve, &f->fit, NULL), WT_OK);
    assert_int_equal(curve_set_size(f->set), 1);
    f->scratch = curve_scratch_new((const wt_curve_set *const[2]){f->set, NULL});
    assert_non_null(f->scratch);
    wt_indent_workspace_free(workspace);
    wt_force_curve_clear(&curve);
}

static void release(fixture *f)
{
    wt_curve_set_free(f->set);
    wt_contact_table_free(f->contact);
    curve_scratch_free(f->scratch);
}

/* Moduli other than the curve's own come back, within what the noise leaves open. */
static void check_level(double level, const wt_prony *known, double loss, double within)
{
    fixture f;
    simulated_fit again;
    set_up(&f, 1e-13, 0, known, loss);
    assert_int_equal(curve_set_has_spectrum(f.set), known != NULL);
    assert_true(loss > 0 ? f.fit.loss_power > 0 : !(f.fit.loss_power > 0));
    assert_int_equal(curve_set_simulate_fit(f.set, 0, level, known, known, f.contact, 1, f.scratch,
                                            &again, NULL),
                     WT_OK);
    assert_true(again.accepted);
    if (!(fabs(again.log_level.value) < within))
        fail_msg("%g is found as %g, %g off", level, again.level, again.log_level.value);
    assert_true(fabs(again.contact_point.value) < 1e-9 * (loss > 0 ? 10 : 1));
    release(&f);
}

static void levels(void **state)
{
    (void)state;
    check_level(5e6, NULL, 0, 1e-3);
    check_level(8e6, NULL, 0, 1e-3);
    check_level(1.0, &spectrum, 0, 1e-3);
    check_level(1.7, &spectrum, 0, 1e-3);
}

/* Of noisy curves, white and correlated ones, as often as it says. */
static void intervals(void **state)
{
    (void)state;
    enum { DRAWS = 200 };
    for (int k = 0; k < 3; k++) {
        fixture f;
        double held[2] = {0, 0}, square = 0, n = 0;
        set_up(&f, 2e-11, k == 1 ? 0.6 : 0, k == 2 ? &spectrum : NULL, 0);
        if (k == 1)
            assert_true(f.fit.correlation_length > 2);
        for (uint64_t i = 0; i < DRAWS; i++) {
            simulated_fit again;
            const wt_prony *known = k == 2 ? &spectrum : NULL;
            const double level = known != NULL ? 1.2 : 6e6;
            assert_int_equal(curve_set_simulate_fit(f.set, 0, level, known, known, f.contact, i,
                                                    f.scratch, &again, NULL),
                             WT_OK);
            n += again.accepted;
            if (!again.accepted)
                continue;
            held[0] += fabs(again.log_level.value) < 1.96 * again.log_level.standard_error;
            held[1] += fabs(again.contact_point.value) < 1.96 * again.contact_point.standard_error;
            square += pow(again.log_level.value / again.log_level.standard_error, 2);
        }
        assert_true(n > 0.95 * DRAWS); /* one in a hundred is left out by chance */
        for (int i = 0; i < 2; i++)
            if (held[i] < 0.9 * n)
                fail_msg("kind %d: %g of %g intervals of %s hold", k, held[i], n,
                         i == 0 ? "moduli" : "contact points");
        /* The noise is as strong as that of the curve; what the law may miss is stated, too. */
        if (!(square < 1.5 * n && square > 0.4 * n))
            fail_msg("kind %d: %g of the stated square", k, square / n);
        release(&f);
    }
}

/* A set that cannot be drawn anew says so. */
static void useless(void **state)
{
    (void)state;
    fixture f;
    wt_force_curve curve = {0};
    set_up(&f, 1e-12, 0, NULL, 0);
    make_segments(&curve, 0);
    f.fit.work_of_adhesion.value = 0.01;
    assert_int_equal(curve_set_add(f.set, &curve, &f.fit, NULL), WT_OK);
    assert_int_equal(curve_set_size(f.set), 0);
    assert_int_equal(curve_set_size(NULL), 0);
    wt_force_curve_clear(&curve);
    release(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels),
        cmocka_unit_test(intervals),
        cmocka_unit_test(useless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
