/* The layer job: the energy that modifies the rubber, and standard errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
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
    /* the power of shearing is tau_f (A/A0) v */
    wt_friction_tables friction = {0};
    wt_error err = WT_ERROR_INIT;
    sliding.velocity = &velocity[VELOCITIES / 2];
    sliding.n_velocity = 1;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &friction, &err), WT_OK);
    assert_near(key_number(shear, "shear_power"),
                5e6 * number_cell(friction.friction, 0, "area_ratio") * velocity[VELOCITIES / 2],
                1e-9);
    wt_table_free(friction.friction);
    wt_table_free(plain);
    wt_table_free(shear);
    wt_table_free(both);
}

/* If only the wear rate has a small scatter, an error is the change of the number with a
 * correspondingly higher and lower wear rate. The number of threads does not matter. */
static void errors_are_slopes(void **state)
{
    (void)state;
    static const char *const keys[] = {"balance_thickness", "relaxation_time",
                                       "time_to_90_percent"};
    enum { KEYS = sizeof keys / sizeof *keys };
    const double share = 0.02;
    double moved[2][KEYS], error[2][KEYS];
    sliding_set_up(velocity, VELOCITIES);
    for (int up = 0; up < 2; up++) {
        wt_layer_job job = job_of();
        job.specific_wear_rate.value *= exp(up ? share : -share);
        work.replicates = 0;
        wt_table *layer = layer_of(&job);
        job = job_of();
        job.specific_wear_rate.standard_error = share * job.specific_wear_rate.value;
        work.replicates = 64;
        work.threads = up ? 4 : 1;
        wt_table *drawn = layer_of(&job);
        for (size_t k = 0; k < KEYS; k++) {
            moved[up][k] = key_number(layer, keys[k]);
            error[up][k] = number_after(drawn, keys[k], "standard_error=");
        }
        wt_table_free(layer);
        wt_table_free(drawn);
    }
    for (size_t k = 0; k < KEYS; k++) {
        assert_near(error[0][k], fabs(moved[1][k] - moved[0][k]) / 2, 0.03);
        assert_true(error[0][k] == error[1][k]);
    }
}

static void refuses(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_layer_job job = job_of();
    wt_layer_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    job.energy = WT_LAYER_SHEAR;
    sliding.shear_stress.value = (double)NAN;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &work, &tables, &err),
                     WT_E_MISSING);
    job = job_of();
    job.duty = 2;
    assert_int_equal(wt_layer_job_check(&job, &err), WT_E_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_add_up),
        cmocka_unit_test(errors_are_slopes),
        cmocka_unit_test(refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
