/* Standard errors of what a layer is beyond its thickness at constant load: they are those of the
 * tables that were there before, and what the formulas say where there are some.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer_tables.h"

#include <stdlib.h>
#include <string.h>

static const double velocity[] = {1e-3, 1e-2, 0.1, 1, 10};
enum { VELOCITIES = sizeof velocity / sizeof *velocity };
/* Replicates are computed to 1e-5, and what they scatter is some per cent. */
#define AS_CLOSE 2e-3

static wt_layer_job job_of(double of_wear, double of_energy)
{
    wt_layer_job job = wt_layer_job_defaults();
    job.specific_wear_rate = (wt_estimate){1e-12, of_wear * 1e-12, 0, "m^2/N"};
    job.critical_energy = (wt_estimate){2e10, of_energy * 2e10, 0, "J/m^3"};
    return job;
}

static double key_error(const wt_table *table, const char *key)
{
    return number_after(table, key, "standard_error=");
}

static wt_table *bands_of(const wt_layer_job *job)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_bands_compute(&sliding, job, &work, &table, &err) != WT_OK)
        fail_msg("bands: %s %s", err.message, err.found);
    return table;
}

static wt_table *running_of(const wt_layer_job *job, const wt_layer_observation *observation)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_running_in_compute(&sliding, job, observation, &work, &table, &err) != WT_OK)
        fail_msg("running-in: %s %s", err.message, err.found);
    return table;
}

static wt_table *balances_of(const wt_layer_job *job, const wt_layer_observation *observation)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_steady_states_compute(&sliding, job, observation, &work, &table, &err) != WT_OK)
        fail_msg("balances: %s %s", err.message, err.found);
    return table;
}

static wt_table *regime_map_of(const wt_layer_job *job, const wt_layer_observation *observation)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_regime_map_compute(&sliding, job, observation, &work, &table, &err) != WT_OK)
        fail_msg("existence: %s %s", err.message, err.found);
    return table;
}

static void set_up(size_t replicates)
{
    sliding_set_up(velocity, VELOCITIES);
    work.replicates = replicates;
}

/* One thickness has one error, whichever table says it, by one set of draws; also one that is
 * calibrated. */
static void one_error_of_the_thickness(void **state)
{
    (void)state;
    const wt_layer_observation observation = {.modulus_ratio = {0.6, 0.03, 0, "1"}};
    for (int calibrated = 0; calibrated < 2; calibrated++) {
        set_up(48);
        sliding.pressure.standard_error = 0.05 * sliding.pressure.value;
        surface.c0.standard_error = 0.05 * surface.c0.value;
        wt_layer_job job = job_of(0.1, 0.1);
        if (calibrated) {
            job.critical_energy.value = (double)NAN;
            job.observed_thickness = (wt_estimate){2e-5, 2e-6, 0, "m"};
        }
        wt_table *layer = layer_of(&job), *bands = bands_of(&job),
                 *running = running_of(&job, &observation), *existence = regime_map_of(&job, NULL);
        const double incubation = key_error(layer, "incubation_time");
        assert_near(key_error(bands, "onset_time"), incubation, AS_CLOSE);
        size_t looked = 0;
        for (size_t row = 0, at = 0; row < wt_table_n_rows(bands); row++, at++) {
            if (number_cell(bands, row, "share") < 1 || number_cell(bands, row, "band") < 1)
                continue;
            const double error = number_cell(layer, at, "thickness_standard_error");
            assert_near(number_cell(bands, row, "lower_standard_error"), error, AS_CLOSE);
            /* its slopes are those beside one more number, that of the modulus */
            assert_near(number_cell(running, at, "thickness_standard_error"), error, 1e-2);
            looked++;
        }
        assert_true(looked > 20);
        assert_near(number_cell(existence, VELOCITIES / 2, "ratio_standard_error"),
                    key_error(layer, "formation_wear_ratio"), AS_CLOSE);
        assert_near(number_cell(existence, VELOCITIES / 2, "power_standard_error"),
                    key_error(layer, "surface_power"), AS_CLOSE);
        if (!calibrated) { /* else what was observed is that of another replicate's balance */
            assert_near(key_error(running, "balance_thickness"),
                        key_error(layer, "balance_thickness"), 1e-2);
            assert_near(number_cell(existence, VELOCITIES / 2, "thickness_standard_error"),
                        key_error(layer, "balance_thickness"), 1e-2);
        }
        wt_table_free(layer);
        wt_table_free(bands);
        wt_table_free(running);
        wt_table_free(existence);
    }
}

/* Friction at the start and at the end is that of the table friction, with the same errors. */
static void one_error_of_the_friction(void **state)
{
    (void)state;
    set_up(64);
    sliding.pressure.standard_error = 0.05 * sliding.pressure.value;
    sliding.shear_stress.standard_error = 0.1 * sliding.shear_stress.value;
    const wt_layer_job job = job_of(0, 0);
    wt_layer_observation observation = {.modulus_ratio = {0.6, 0.03, 0, "1"}};
    wt_table *running = running_of(&job, &observation);
    observation.thickness = (wt_estimate){key_number(running, "balance_thickness"), 0, 0, "m"};
    wt_friction_tables friction = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_sliding_friction_compute(&sliding, &observation, &work, &friction, &err),
                     WT_OK);
    assert_near(key_error(running, "bare_friction"),
                key_error(friction.friction, "friction_at_reference"), AS_CLOSE);
    /* the pressure moves the thickness, which is given there, by next to nothing of the friction */
    assert_near(key_error(running, "balance_friction"),
                key_error(friction.friction, "friction_with_layer_at_reference"), 0.05);
    wt_friction_tables_clear(&friction);
    wt_table_free(running);
}

/* Where only the wear rate scatters, by little, an error is what a wear rate that much higher and
 * lower makes of the number. */
static void errors_are_slopes(void **state)
{
    (void)state;
    static const double times[] = {3, 100, 1000, 20000};
    static const char *const loads[] = {"time=30s", "time=300s,specific-wear-rate=2e-12m^2/N",
                                        "velocity=0.02m/s"};
    const double share = 0.02;
    const wt_layer_observation observation = {.modulus_ratio = {0.6, 0, 0, "1"}};
    set_up(64);
    wt_layer_job job = job_of(share, 0);
    job.severity_power = 1e4;
    wt_table *existence = regime_map_of(&job, NULL), *running = running_of(&job, &observation);
    double edge[2], settled[2];
    for (int up = 0; up < 2; up++) {
        wt_layer_job moved = job_of(0, 0);
        moved.severity_power = 1e4;
        moved.specific_wear_rate.value *= exp(up ? share : -share);
        wt_table *other = regime_map_of(&moved, NULL), *run = running_of(&moved, &observation);
        edge[up] = key_number(other, "to_velocity");
        settled[up] = key_number(run, "settled");
        wt_table_free(other);
        wt_table_free(run);
    }
    assert_near(key_error(existence, "to_velocity"), fabs(edge[1] - edge[0]) / 2, 0.02);
    assert_near(
        log(key_number(existence, "to_velocity_high") / key_number(existence, "to_velocity_low")),
        1.959964 * fabs(log(edge[1] / edge[0])), 0.02);
    assert_near(key_error(running, "settled"), fabs(settled[1] - settled[0]) / 2, 0.05);
    wt_table_free(existence);
    wt_table_free(running);
    job = job_of(share, 0);
    job.time = times;
    job.n_time = 4;
    job.loads = loads;
    job.n_loads = 3;
    wt_table *bands = bands_of(&job);
    double depth[2];
    for (int up = 0; up < 2; up++) { /* and the wear rate that a load has of its own goes with it */
        char own[64];
        const char *const moved_loads[] = {loads[0], own, loads[2]};
        wt_layer_job moved = job;
        moved.specific_wear_rate = (wt_estimate){1e-12 * exp(up ? share : -share), 0, 0, "m^2/N"};
        snprintf(own, sizeof own, "time=300s,specific-wear-rate=%.17gm^2/N",
                 2e-12 * exp(up ? share : -share));
        moved.loads = moved_loads;
        wt_table *other = bands_of(&moved);
        depth[up] = key_number(other, "last_thickness");
        wt_table_free(other);
    }
    assert_near(key_error(bands, "last_thickness"), fabs(depth[1] - depth[0]) / 2, 0.02);
    assert_true(key_error(bands, "onset_time") > 0);
    wt_table_free(bands);
}

/* The edge depends on nothing but the product of wear rate and critical energy, whose normal error
 * is known: the ends are the edges at the product's own ends, whichever draws a seed has; also of
 * few, of which the outermost alone would be off by a tenth and more. */
static void ends_do_not_hang_on_the_seed(void **state)
{
    (void)state;
    const double of_each = 0.1, of_product = 1.959964 * sqrt(2) * of_each;
    double edge[3];
    for (int k = 0; k < 3; k++) {
        set_up(0);
        wt_layer_job job = job_of(0, 0);
        job.severity_power = 1e4;
        job.specific_wear_rate.value *= exp((1 - k) * of_product);
        wt_table *exact = regime_map_of(&job, NULL);
        edge[k] = key_number(exact, "to_velocity");
        wt_table_free(exact);
    }
    for (uint64_t seed = 1; seed <= 6; seed++) {
        set_up(seed % 2 ? 80 : 200);
        work.seed = seed;
        wt_layer_job job = job_of(of_each, of_each);
        job.severity_power = 1e4;
        wt_table *drawn = regime_map_of(&job, NULL);
        const double value = key_number(drawn, "to_velocity");
        assert_near(value, edge[1], 1e-6);
        assert_near(log(value / key_number(drawn, "to_velocity_low")), log(value / edge[0]), 0.02);
        assert_near(log(key_number(drawn, "to_velocity_high") / value), log(edge[2] / value), 0.02);
        wt_table_free(drawn);
    }
}

/* Near a fold the replicates do not agree, and far from it they do. */
static void balances_that_may_be_others(void **state)
{
    (void)state;
    const wt_layer_observation observation = {.modulus_ratio = {4, 0, 0, "1"}};
    for (int near = 0; near < 2; near++) {
        set_up(32);
        wt_layer_job job = job_of(0, 0);
        job.has_feedback = true;
        job.energy = WT_LAYER_SHEAR;
        wt_table *layer = layer_of(&job);
        const double most = key_number(layer, "critical_specific_wear_rate");
        wt_table_free(layer);
        /* up to `most` a bare surface is modified: one balance; above it three */
        job.specific_wear_rate.value = most / (near ? 1.01 : 2);
        job.specific_wear_rate.standard_error = 0.05 * job.specific_wear_rate.value;
        wt_table *balances = balances_of(&job, &observation);
        const char *const agreement = wt_table_key(balances, "agreement");
        assert_non_null(agreement);
        if (strncmp(agreement, near ? "cannot say" : "yes", near ? 10 : 3) != 0)
            fail_msg("%d: %s", near, agreement);
        assert_near(number_cell(balances, 0, "wear_rate_standard_error"),
                    job.specific_wear_rate.standard_error, 0.05);
        /* of what a part of the replicates has there is none, which is said */
        assert_int_equal(isnan(number_cell(balances, 0, "thickness_standard_error")) != 0, near);
        assert_int_equal(
            strstr(wt_table_key(balances, "errors"), "not known of the balances") != NULL, near);
        wt_table_free(balances);
    }
}

/* Edges that a part of the replicates has beyond the list have no interval. */
static void edges_that_may_not_be_there(void **state)
{
    (void)state;
    set_up(32);
    wt_layer_job job = job_of(0.1, 0);
    job.severity_power = 1e4;
    wt_table *whole = regime_map_of(&job, NULL);
    const double edge = key_number(whole, "to_velocity");
    assert_int_equal(strncmp(wt_table_key(whole, "known"), "yes", 3), 0);
    wt_table_free(whole);
    const double list[] = {1e-3, 1e-2, 1.02 * edge};
    sliding.velocity = list;
    sliding.n_velocity = 3;
    wt_table *cut = regime_map_of(&job, NULL);
    assert_near(key_number(cut, "to_velocity"), edge, 1e-6);
    assert_int_equal(strncmp(wt_table_key(cut, "known"), "cannot say", 10), 0);
    assert_null(wt_table_key(cut, "to_velocity_low"));
    const double share = number_cell(cut, 2, "share");
    assert_true(share > 0.1 && share < 0.9);
    wt_table_free(cut);
}

/* Where the layer may be there or not, its first appearance has no interval. */
static void a_layer_that_may_not_come(void **state)
{
    (void)state;
    set_up(48);
    wt_layer_job job = job_of(0.2, 0.2);
    wt_table *layer = layer_of(&job);
    job.specific_wear_rate.value *= key_number(layer, "formation_wear_ratio") / 1.1;
    job.specific_wear_rate.standard_error = 0.2 * job.specific_wear_rate.value;
    wt_table_free(layer);
    for (int given = 0; given < 2; given++) {
        if (given) /* none by the values themselves */
            job.specific_wear_rate.value *= 1.2;
        wt_table *bands = bands_of(&job);
        const char *const known = wt_table_key(bands, "first_appearance_known");
        assert_int_equal(wt_table_key(bands, "onset_time") == NULL, given);
        assert_int_equal(strncmp(known, "cannot say", 10), 0);
        assert_non_null(strstr(known, given ? "something is modified" : "nothing is ever"));
        assert_null(wt_table_key(bands, "first_appearance_high"));
        assert_true(given || isnan(key_error(bands, "onset_time")));
        wt_table_free(bands);
    }
}

/* Nothing is drawn where no error is stated, and the number of threads does not matter. */
static void nothing_to_draw(void **state)
{
    (void)state;
    const wt_layer_observation observation = {.modulus_ratio = {0.6, 0, 0, "1"}};
    set_up(16);
    wt_layer_job job = job_of(0, 0);
    wt_table *running = running_of(&job, &observation);
    assert_true(isnan(key_error(running, "settled")));
    assert_null(wt_table_key(running, "settled_low"));
    assert_non_null(strstr(wt_table_key(running, "errors"), "no error was measured or stated"));
    wt_table_free(running);
    job = job_of(0.1, 0.1);
    double error[2];
    for (int k = 0; k < 2; k++) {
        work.threads = k ? 4 : 1;
        wt_table *bands = bands_of(&job);
        error[k] = key_error(bands, "last_thickness");
        wt_table_free(bands);
    }
    assert_true(error[0] == error[1] && error[0] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_error_of_the_thickness),
        cmocka_unit_test(one_error_of_the_friction),
        cmocka_unit_test(errors_are_slopes),
        cmocka_unit_test(ends_do_not_hang_on_the_seed),
        cmocka_unit_test(balances_that_may_be_others),
        cmocka_unit_test(edges_that_may_not_be_there),
        cmocka_unit_test(a_layer_that_may_not_come),
        cmocka_unit_test(nothing_to_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
