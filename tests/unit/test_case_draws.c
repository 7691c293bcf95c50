/* Replicates of the standard errors: draws for different purposes are independent, and the seed
 * determines all of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "truth_fixture.h"

#include "weartrack/layer.h"

enum { REPLICATES = 150, MAX_KNOBS = 8 };

/* A quantity with a stated error. */
typedef struct knob {
    const char *name;
    double *value, *error;
} knob;

static wt_layer_observation layer;
static wt_layer_job layer_job;

static void set_up(void)
{
    static const double velocity = 0.1;
    sliding_set_up(&velocity, 1);
    rubber.law = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293.15, 6.5, 110}};
    rubber.temperature_min = 273.15;
    rubber.temperature_max = 333.15;
    surface.q1 = 2e4;
    sliding.pressure.value = 0.8e6;
    sliding.temperature.value = 313.15;
    layer =
        (wt_layer_observation){.thickness = {100e-6, 0, 0, "m"}, .modulus_ratio = {0.6, 0, 0, "1"}};
    layer_job = wt_layer_job_defaults();
    layer_job.specific_wear_rate.value = 1e-12;
    work.replicates = REPLICATES;
}

static wt_estimate friction(const char *key)
{
    wt_friction_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_sliding_friction_compute(&sliding, &layer, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_estimate e = key_estimate(tables.friction, key);
    wt_table_free(tables.friction);
    return e;
}

static wt_estimate thickness(const char *key)
{
    wt_layer_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_thickness_compute(&sliding, &layer_job, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_estimate e = key_estimate(tables.layer, key);
    wt_table_free(tables.layer);
    return e;
}

/* Each quantity has the error that moves the logarithm of the result by `SHARE`, so that all
 * together move it by the root of their number. Shared draws of two quantities would change the
 * square by 2/n, which is four times the scatter of the replicates. */
#define SHARE 0.005

static void check_independent(const knob *knobs, int n, wt_estimate (*result)(const char *),
                              const char *key)
{
    double variance = 0, errors[MAX_KNOBS];
    for (int i = 0; i < n; i++) {
        const knob *k = &knobs[i];
        double value = *k->value, step = 1e-4 * value;
        work.replicates = 0;
        double middle = result(key).value;
        *k->value = value + step;
        double slope = log(result(key).value / middle) / step;
        *k->value = value;
        errors[i] = SHARE / fabs(slope);
        work.replicates = REPLICATES;
        *k->error = errors[i];
        wt_estimate e = result(key);
        *k->error = 0;
        if (!(fabs(e.standard_error / e.value / SHARE - 1) < 0.2))
            fail_msg("%s: an error that moves %s by %g is reported as %g", k->name, key, SHARE,
                     e.standard_error / e.value);
        variance += e.standard_error * e.standard_error;
    }
    for (int i = 0; i < n; i++)
        *knobs[i].error = errors[i];
    wt_estimate all = result(key);
    for (int i = 0; i < n; i++)
        *knobs[i].error = 0;
    print_message("%s: square of the error over the sum of squares %.3f\n", key,
                  all.standard_error * all.standard_error / variance);
    assert_near(all.standard_error * all.standard_error / variance, 1, 1.2 / n);
}

static void test_friction_draws(void **state)
{
    (void)state;
    set_up();
    const knob knobs[] = {
        {"pressure", &sliding.pressure.value, &sliding.pressure.standard_error},
        {"shear stress", &sliding.shear_stress.value, &sliding.shear_stress.standard_error},
        {"temperature", &sliding.temperature.value, &sliding.temperature.standard_error},
        {"density", &surface.c0.value, &surface.c0.standard_error},
        {"shift law", &rubber.law.wlf.c1, &rubber.c1_error},
        {"thickness", &layer.thickness.value, &layer.thickness.standard_error},
        {"ratio", &layer.modulus_ratio.value, &layer.modulus_ratio.standard_error},
    };
    check_independent(knobs, 7, friction, "friction_with_layer_at_reference");
}

static void test_layer_draws(void **state)
{
    (void)state;
    set_up();
    layer_job.critical_energy.value = 1e9;
    const knob knobs[] = {
        {"pressure", &sliding.pressure.value, &sliding.pressure.standard_error},
        {"temperature", &sliding.temperature.value, &sliding.temperature.standard_error},
        {"density", &surface.c0.value, &surface.c0.standard_error},
        {"wear", &layer_job.specific_wear_rate.value, &layer_job.specific_wear_rate.standard_error},
        {"energy", &layer_job.critical_energy.value, &layer_job.critical_energy.standard_error},
    };
    check_independent(knobs, 5, thickness, "balance_thickness");
}

static void test_calibration_draws(void **state)
{
    (void)state;
    set_up();
    layer_job.observed_thickness.value = 3e-6;
    const knob knobs[] = {
        {"pressure", &sliding.pressure.value, &sliding.pressure.standard_error},
        {"wear", &layer_job.specific_wear_rate.value, &layer_job.specific_wear_rate.standard_error},
        {"observed", &layer_job.observed_thickness.value,
         &layer_job.observed_thickness.standard_error},
    };
    check_independent(knobs, 3, thickness, "critical_energy");
}

/* One more stated error changes no other draw, and explains one more slope of their scatter; the
 * seed changes all of them. */
static void test_seed(void **state)
{
    (void)state;
    set_up();
    work.replicates = 16;
    sliding.pressure.standard_error = 0.02e6;
    layer_job.critical_energy.value = 1e9;
    double hysteresis = friction("hysteresis_at_reference").standard_error;
    double depth = thickness("balance_thickness").standard_error;
    assert_true(hysteresis > 0 && depth > 0);
    sliding.shear_stress.standard_error = 0.5e6;
    assert_near(friction("hysteresis_at_reference").standard_error, hysteresis, 1e-3);
    assert_near(thickness("balance_thickness").standard_error, depth, 1e-3);
    sliding.shear_stress.standard_error = 0;
    work.seed += 1;
    assert_true(fabs(friction("hysteresis_at_reference").standard_error / hysteresis - 1) > 1e-6);
    assert_true(fabs(thickness("balance_thickness").standard_error / depth - 1) > 1e-6);
    work.seed -= 1;
    assert_near(friction("hysteresis_at_reference").standard_error, hysteresis, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_friction_draws),
        cmocka_unit_test(test_layer_draws),
        cmocka_unit_test(test_calibration_draws),
        cmocka_unit_test(test_seed),
    };
    return cmocka_run_group_tests_name("draws", tests, NULL, NULL);
}
