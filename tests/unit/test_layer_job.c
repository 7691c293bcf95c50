/* The layer beyond its thickness at constant load, as a job makes it: its tables agree with each
 * other and with those that were there before. SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer_tables.h"

#include <stdlib.h>
#include <string.h>

static const double velocity[] = {1e-3, 1e-2, 0.1, 1, 10};
enum { VELOCITIES = sizeof velocity / sizeof *velocity };

static wt_layer_job job_of(void)
{
    wt_layer_job job = wt_layer_job_defaults();
    job.specific_wear_rate.value = 1e-12;
    job.critical_energy.value = 2e10;
    return job;
}

/* The powers add up by their shares. */
static void energies_add_up(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    wt_table *plain = layer_of(&job);
    const double hysteresis = key_number(plain, "surface_power");
    assert_null(wt_table_key(plain, "energy_from"));
    job.energy = WT_LAYER_SHEAR;
    wt_table *shear = layer_of(&job);
    job.energy = WT_LAYER_BOTH;
    wt_table *both = layer_of(&job);
    assert_near(key_number(shear, "hysteresis_power"), hysteresis, 1e-12);
    assert_near(key_number(shear, "surface_power"), key_number(shear, "shear_power"), 1e-12);
    assert_near(key_number(both, "surface_power"), hysteresis + key_number(shear, "shear_power"),
                1e-12);
    /* and that of the shearing is tau_f (A/A0) v */
    wt_friction_tables friction = {0};
    wt_error err = WT_ERROR_INIT;
    sliding.velocity = &velocity[VELOCITIES / 2];
    sliding.n_velocity = 1;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &friction, &err), WT_OK);
    assert_near(key_number(shear, "shear_power"),
                5e6 * number_cell(friction.friction, 0, "area_ratio") * velocity[VELOCITIES / 2],
                1e-9);
    wt_friction_tables_clear(&friction);
    wt_table_free(plain);
    wt_table_free(shear);
    wt_table_free(both);
}

/* A wear rate that grows with the power is that constant rate. */
static void severity_is_a_rate(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    job.severity_power = 1e4;
    job.severity_exponent = 1.5;
    wt_table *severe = layer_of(&job);
    const double power = key_number(severe, "surface_power");
    const double rate = 1e-12 * (1 + pow(power / 1e4, 1.5));
    assert_near(key_number(severe, "severe_wear_rate"), rate, 1e-12);
    job = job_of();
    job.specific_wear_rate.value = rate;
    wt_table *constant = layer_of(&job);
    assert_near(key_number(severe, "balance_thickness"), key_number(constant, "balance_thickness"),
                1e-12);
    wt_table_free(severe);
    wt_table_free(constant);
}

/* The deepest edge is the thickness of the table that was there before. */
static void bands_are_the_layer(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    for (int k = 0; k < 2; k++) {
        wt_layer_job job = job_of();
        wt_table *bands = NULL;
        wt_error err = WT_ERROR_INIT;
        job.profile = k ? WT_PROFILE_INCOMPRESSIBLE : WT_PROFILE_PERSSON;
        wt_table *layer = layer_of(&job);
        assert_int_equal(wt_layer_bands_compute(&sliding, &job, &work, &bands, &err), WT_OK);
        size_t modified = 0;
        for (size_t row = 0, at = 0; row < wt_table_n_rows(bands); row++) {
            if (number_cell(bands, row, "band") > 1)
                continue;
            const bool none = number_cell(bands, row, "band") < 1;
            const double lower = none ? 0 : number_cell(bands, row, "lower");
            assert_near(number_cell(bands, row, "time"), number_cell(layer, at, "time"), 1e-15);
            assert_near(lower, number_cell(layer, at, "thickness"), 1e-10);
            at++;
            modified += !none;
        }
        assert_true(modified > 10);
        wt_table_free(layer);
        wt_table_free(bands);
    }
}

/* A load in three parts is that load. */
static void loads_in_parts(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    static const double times[] = {10, 100, 1000, 20000};
    static const char *const parts[] = {"time=30s", "time=300s,pressure=0.4MPa", "velocity=0.1m/s"};
    wt_layer_job job = job_of();
    wt_table *whole = NULL, *cut = NULL;
    wt_error err = WT_ERROR_INIT;
    job.time = times;
    job.n_time = 4;
    assert_int_equal(wt_layer_bands_compute(&sliding, &job, &work, &whole, &err), WT_OK);
    job.loads = parts;
    job.n_loads = 3;
    if (wt_layer_bands_compute(&sliding, &job, &work, &cut, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.place);
    assert_int_equal(wt_table_n_rows(whole), wt_table_n_rows(cut));
    for (size_t row = 0; row < wt_table_n_rows(whole); row++)
        assert_near(number_cell(cut, row, "lower"), number_cell(whole, row, "lower"), 1e-11);
    wt_table_free(whole);
    wt_table_free(cut);
}

/* However many loads there are, all are told. */
static void loads_are_told(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    enum { LOADS = 40 };
    char load[LOADS][64];
    const char *loads[LOADS];
    wt_layer_job job = job_of();
    wt_table *bands = NULL;
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < LOADS; i++) {
        snprintf(load[i], sizeof load[i], "time=%zus,pressure=%zukPa", 10 + i, 300 + i);
        loads[i] = load[i];
    }
    job.loads = loads;
    job.n_loads = LOADS;
    static const double times[] = {10, 1000};
    job.time = times;
    job.n_time = 2;
    assert_int_equal(wt_layer_bands_compute(&sliding, &job, &work, &bands, &err), WT_OK);
    const char *text = wt_table_key(bands, "loads");
    assert_non_null(text);
    for (size_t i = 0; text != NULL && i < LOADS; i++) {
        char told[64];
        snprintf(told, sizeof told, "%zu s at 0.%zu MPa, ", 10 + i, 300 + i);
        if (i % 10 == 0) /* 0.31 MPa */
            snprintf(told, sizeof told, "%zu s at 0.%zu MPa, ", 10 + i, (300 + i) / 10);
        if (i == 0)
            snprintf(told, sizeof told, "10 s at 0.3 MPa, ");
        text = strstr(text, told);
        if (text == NULL)
            fail_msg("%s is not told", told);
    }
    assert_non_null(strstr(text, "mm^3/(N m)"));
    wt_table_free(bands);
}

/* It begins with the friction of the bulk, and ends with that of the balance. */
static void running_in_joins_both(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    wt_table *running = NULL, *balances = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_layer_observation observation = {.modulus_ratio = {0.5, 0, 0, "1"}};
    wt_table *layer = layer_of(&job);
    assert_int_equal(wt_running_in_compute(&sliding, &job, &observation, &work, &running, &err),
                     WT_OK);
    const size_t n = wt_table_n_rows(running);
    for (size_t row = 0; row < n; row++)
        assert_near(number_cell(running, row, "thickness"), number_cell(layer, row, "thickness"),
                    1e-12);
    wt_friction_tables friction = {0};
    observation.thickness = (wt_estimate){key_number(layer, "balance_thickness"), 0, 0, "m"};
    assert_int_equal(wt_sliding_friction_compute(&sliding, &observation, &work, &friction, &err),
                     WT_OK);
    assert_near(key_number(running, "bare_friction"),
                key_number(friction.friction, "friction_at_reference"), 1e-9);
    assert_near(key_number(running, "balance_friction"),
                key_number(friction.friction, "friction_with_layer_at_reference"), 1e-9);
    assert_near(number_cell(running, 0, "friction"), key_number(running, "bare_friction"), 1e-12);
    assert_true(key_number(running, "settled") > 0);
    /* with a layer that acts back it ends at the balance of that, also where wear follows it */
    for (int k = 0; k < 2; k++) {
        job.has_feedback = true;
        job.severity_power = k ? 1e4 : 0;
        wt_table_free(running);
        assert_int_equal(wt_running_in_compute(&sliding, &job, &observation, &work, &running, &err),
                         WT_OK);
        assert_int_equal(
            wt_layer_steady_states_compute(&sliding, &job, &observation, &work, &balances, &err),
            WT_OK);
        assert_near(number_cell(running, n - 1, "thickness"), number_cell(balances, 0, "thickness"),
                    1e-8);
        assert_true(
            fabs(number_cell(balances, 0, "thickness") / key_number(balances, "one_way_thickness") -
                 1) > 1e-3);
        assert_true(number_cell(balances, 0, "map_slope") < 1);
        wt_table_free(balances);
    }
    wt_friction_tables_clear(&friction);
    wt_table_free(layer);
    wt_table_free(running);
}

/* One law of the shear stress, in running-in and in friction: exponent and reach. */
static void one_shear_stress(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    job.shear = (wt_layer_shear){2, 3e-6};
    wt_table *running = NULL, *layer = layer_of(&job);
    wt_error err = WT_ERROR_INIT;
    wt_layer_observation observation = {
        .thickness = {key_number(layer, "balance_thickness"), 0, 0, "m"},
        .modulus_ratio = {0.5, 0, 0, "1"}};
    assert_int_equal(wt_running_in_compute(&sliding, &job, &observation, &work, &running, &err),
                     WT_OK);
    static const char *const of_running[] = {"bare_friction", "balance_friction"},
                             *const of_friction[] = {"friction_at_reference",
                                                     "friction_with_layer_at_reference"};
    for (int with = 0; with < 2; with++) {
        wt_friction_tables friction = {0};
        observation.shear = with ? &job.shear : NULL;
        assert_int_equal(
            wt_sliding_friction_compute(&sliding, &observation, &work, &friction, &err), WT_OK);
        for (int i = 0; i < 2; i++) {
            const double apart =
                key_number(friction.friction, of_friction[i]) / key_number(running, of_running[i]) -
                1;
            /* with a layer they differ by per cents without that law */
            assert_int_equal(fabs(apart) < 1e-9, with || i == 0);
            assert_int_equal(fabs(apart) > 1e-2, !with && i == 1);
        }
        wt_friction_tables_clear(&friction);
    }
    wt_table_free(layer);
    wt_table_free(running);
}

/* Shearing a layer costs what its own shear stress says; a bare surface that is modified where its
 * first layer is worn stays at none, and a balance thinner than any wave is found. */
static void shearing_the_layer(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    const wt_layer_observation observation = {.modulus_ratio = {0.5, 0, 0, "1"}};
    wt_error err = WT_ERROR_INIT;
    wt_table *balances = NULL, *running = NULL;
    double thickness[2];
    wt_layer_job job = job_of();
    job.has_feedback = true;
    job.energy = WT_LAYER_SHEAR;
    for (int k = 0; k < 2; k++) {
        job.shear.exponent = k;
        assert_int_equal(
            wt_layer_steady_states_compute(&sliding, &job, &observation, &work, &balances, &err),
            WT_OK);
        thickness[k] = number_cell(balances, 0, "thickness");
        wt_table_free(balances);
    }
    assert_true(thickness[1] > 0 && thickness[1] < 0.9 * thickness[0]);
    for (int k = 0; k < 2; k++) {
        job.energy = k ? WT_LAYER_HYSTERESIS : WT_LAYER_SHEAR;
        wt_table *layer = layer_of(&job);
        job.specific_wear_rate.value =
            key_number(layer, "critical_specific_wear_rate") / (k ? 1.001 : 1.1);
        wt_table_free(layer);
        assert_int_equal(
            wt_layer_steady_states_compute(&sliding, &job, &observation, &work, &balances, &err),
            WT_OK);
        assert_int_equal(number_cell(balances, 0, "thickness") > 0, k);
        assert_true(number_cell(balances, 0, "thickness") < 1e-8);
        assert_int_equal(wt_running_in_compute(&sliding, &job, &observation, &work, &running, &err),
                         WT_OK);
        assert_near(key_number(running, "balance_thickness"), number_cell(balances, 0, "thickness"),
                    1e-9);
        wt_table_free(balances);
        wt_table_free(running);
    }
}

/* A bare surface that is worn where any layer of a stiffer rubber grows: between the two stable
 * balances is a threshold, at 0 where the shear stress jumps, else below any thickness looked at.
 */
static void threshold_of_a_stiff_layer(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    const wt_layer_observation observation = {.modulus_ratio = {4, 0, 0, "1"}};
    wt_error err = WT_ERROR_INIT;
    wt_table *balances = NULL;
    wt_layer_job job = job_of();
    job.has_feedback = true;
    job.energy = WT_LAYER_SHEAR;
    wt_table *layer = layer_of(&job);
    job.specific_wear_rate.value = key_number(layer, "critical_specific_wear_rate") / 0.58;
    wt_table_free(layer);
    for (int k = 0; k < 2; k++) {
        job.shear.transition_thickness = k ? 1e-11 : 0;
        assert_int_equal(
            wt_layer_steady_states_compute(&sliding, &job, &observation, &work, &balances, &err),
            WT_OK);
        static const char *const stable[] = {"stable", "unstable", "stable"};
        const size_t kind = (size_t)wt_table_find(balances, "kind"),
                     at = (size_t)wt_table_find(balances, "stable");
        for (size_t row = 0; row < 3; row++) {
            assert_string_equal(wt_table_text(balances, row, kind), "balance");
            assert_string_equal(wt_table_text(balances, row, at), stable[row]);
        }
        const double threshold = number_cell(balances, 1, "thickness");
        assert_true(number_cell(balances, 0, "thickness") == 0);
        assert_true(k ? threshold > 0 && threshold < 1e-10 : threshold == 0);
        assert_true(number_cell(balances, 2, "thickness") > 1e-7);
        wt_table_free(balances);
    }
}

/* At the edge R is 1, and beyond it there is no layer and no change of friction. */
static void existence_ends_where_it_says(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    const wt_layer_observation observation = {.modulus_ratio = {0.5, 0, 0, "1"}};
    wt_layer_job job = job_of();
    wt_table *existence = NULL;
    wt_error err = WT_ERROR_INIT;
    job.severity_power = 1e4;
    assert_int_equal(wt_regime_map_compute(&sliding, &job, &observation, &work, &existence, &err),
                     WT_OK);
    const double edge = key_number(existence, "to_velocity");
    assert_true(isnan(key_number(existence, "from_velocity")));
    assert_true(edge > velocity[0] && edge < velocity[VELOCITIES - 1]);
    for (size_t row = 0; row < VELOCITIES; row++) {
        const bool there = number_cell(existence, row, "velocity") < edge;
        assert_int_equal(number_cell(existence, row, "thickness") > 0, there);
        assert_int_equal(number_cell(existence, row, "change") != 0, there);
    }
    static const double other_way[] = {10, 1, 1e-2, 0.1, 1e-3};
    wt_table *again = NULL;
    sliding.velocity = other_way;
    assert_int_equal(wt_regime_map_compute(&sliding, &job, &observation, &work, &again, &err),
                     WT_OK);
    assert_near(key_number(again, "to_velocity"), edge, 1e-9);
    wt_table_free(again);
    sliding.velocity = &edge;
    sliding.n_velocity = 1;
    wt_table *layer = layer_of(&job);
    assert_near(key_number(layer, "formation_wear_ratio"), 1, 1e-7);
    assert_near(key_number(layer, "surface_power"), key_number(existence, "to_power"), 1e-9);
    wt_table_free(layer);
    wt_table_free(existence);
}

/* Where the layer begins again and goes on beyond the list, it ends at no velocity of it. */
static void existence_of_two_ranges(void **state)
{
    (void)state;
    enum { LIST = 45 };
    double list[LIST], term[] = {10e6, 10e6}, tau[] = {1e-5, 10}, wear = 1e-12;
    for (size_t i = 0; i < LIST; i++)
        list[i] = 1e-8 * pow(10, 0.25 * (double)i);
    sliding_set_up(list, LIST);
    rubber.prony.n = 2;
    rubber.prony.relaxation_time = tau;
    rubber.prony.modulus = term;
    surface.q1 = 2e4;
    const wt_layer_observation observation = {.modulus_ratio = {0.5, 0, 0, "1"}};
    wt_layer_job job = job_of();
    wt_table *existence = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_regime_map_compute(&sliding, &job, &observation, &work, &existence, &err),
                     WT_OK);
    /* R goes with 1/k: a wear rate between the two peaks of R and the valley */
    size_t first = 0, valley = 0, last = 0;
    double ratio[LIST];
    for (size_t i = 0; i < LIST; i++)
        ratio[i] = number_cell(existence, i, "ratio");
    wt_table_free(existence);
    while (ratio[first + 1] > ratio[first])
        first++;
    for (valley = first; valley + 1 < LIST && ratio[valley + 1] < ratio[valley];)
        valley++;
    for (last = valley; last + 1 < LIST && ratio[last + 1] > ratio[last];)
        last++;
    assert_true(first > 0 && valley > first && last > valley && last + 1 < LIST);
    wear *= sqrt(ratio[valley] * fmin(ratio[first], ratio[last]));
    job.specific_wear_rate.value = wear;
    for (int whole = 0; whole < 2; whole++) {
        sliding.n_velocity = whole ? LIST : last + 1;
        assert_int_equal(
            wt_regime_map_compute(&sliding, &job, &observation, &work, &existence, &err), WT_OK);
        const double from = key_number(existence, "from_velocity"),
                     to = key_number(existence, "to_velocity"),
                     power = key_number(existence, "to_power");
        assert_true(from < list[first]);
        assert_true(whole ? to > list[last] : isnan(to));
        assert_int_equal(isnan(power), !whole);
        assert_non_null(strstr(wt_table_key(existence, "words"), "up to"));
        wt_table_free(existence);
    }
}

static void refuses(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    wt_layer_tables tables = {0};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_layer_observation unknown = {.modulus_ratio = {(double)NAN, 0, 0, "1"}};
    assert_int_equal(wt_running_in_compute(&sliding, &job, &unknown, &work, &table, &err),
                     WT_E_MISSING);
    const wt_layer_observation given = {.modulus_ratio = {0.5, 0, 0, "1"}};
    job.has_feedback = true;
    job.start_thickness = 1e-6;
    assert_int_equal(wt_running_in_compute(&sliding, &job, &given, &work, &table, &err), WT_E_ARG);
    job = job_of();
    job.energy = WT_LAYER_SHEAR;
    sliding.shear_stress.value = (double)NAN;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &work, &tables, &err),
                     WT_E_MISSING);
    job = job_of();
    job.severity_power = -1;
    assert_int_equal(wt_layer_job_check(&job, &err), WT_E_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_add_up),
        cmocka_unit_test(severity_is_a_rate),
        cmocka_unit_test(bands_are_the_layer),
        cmocka_unit_test(loads_in_parts),
        cmocka_unit_test(loads_are_told),
        cmocka_unit_test(running_in_joins_both),
        cmocka_unit_test(one_shear_stress),
        cmocka_unit_test(shearing_the_layer),
        cmocka_unit_test(threshold_of_a_stiff_layer),
        cmocka_unit_test(existence_ends_where_it_says),
        cmocka_unit_test(existence_of_two_ranges),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
