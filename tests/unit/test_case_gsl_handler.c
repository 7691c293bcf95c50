/* Each function that calls a GSL function which may fail is the first call of a process. The error
 * handler of GSL, which would abort the process, must be off by then.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "synthetic_curve.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <sys/wait.h>
#include <unistd.h>

/* Returns true if the call returns true in its own process. */
static bool comes_back(bool (*call)(void))
{
    int ended = -1;
    const pid_t child = fork();
    if (child == 0)
        _exit(call() ? 0 : 1);
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &ended, 0), child);
    return WIFEXITED(ended) && WEXITSTATUS(ended) == 0;
}

static wt_contact_table *table_of(void)
{
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
    wt_contact_table *table = NULL;
    return wt_contact_table_new(&tip, 1e-11, 1e-4, &table, NULL) == WT_OK ? table : NULL;
}

enum { SAMPLES = 600 };

/* A dwell at constant height after a ramp, of an elastic sample. */
static bool fit_dwell(double noise, double spring_constant, wt_dwell *dwell)
{
    static double time[2 * SAMPLES], position[2 * SAMPLES], force[2 * SAMPLES];
    uint64_t seed = 1;
    for (int i = 0; i < 2 * SAMPLES; i++) {
        time[i] = 1e-3 * i;
        position[i] = 1e-9 * ((i < SAMPLES ? i : SAMPLES - 1) - SAMPLES / 2);
        force[i] = 4e3 * pow(fmax(position[i], 0), 1.5) + noise * curve_normal(&seed);
    }
    const wt_dwell_history h = {.time = time,
                                .position = position,
                                .force = force,
                                .n_approach = SAMPLES,
                                .n_dwell = SAMPLES,
                                .spring_constant = spring_constant,
                                .poisson_ratio = 0.5,
                                .modulus = 1e6};
    wt_contact_table *table = table_of();
    const bool done = wt_dwell_fit(table, &h, dwell, NULL) == WT_OK;
    wt_contact_table_free(table);
    return done;
}

/* With a soft cantilever the sample is rigid: there are no normal equations to solve. */
static bool dwell_on_a_wall(void)
{
    wt_dwell dwell;
    return fit_dwell(1e-12, 1e-6, &dwell) && !dwell.found && dwell.reason[0] != '\0';
}

enum { CURVES = 40 };

/* Equal residuals have no scatter. */
static bool pool_of_one(void)
{
    static double misfit[CURVES][WT_MISFIT_TERMS];
    return isnan(
        wt_pooled_misfit_compute((const double(*)[WT_MISFIT_TERMS])misfit, CURVES).p_value);
}

static bool depth_of_one(void)
{
    static wt_curve_residuals curve[CURVES];
    wt_contact_table *table = table_of();
    wt_modulus_profile depth;
    for (int i = 0; i < CURVES; i++)
        curve[i] = (wt_curve_residuals){.modulus = 1e6,
                                        .depth = 1e-7,
                                        .spring_constant = 1,
                                        .baseline = 1e-6,
                                        .window = 1e-7,
                                        .spot = i};
    const bool done = wt_modulus_profile_fit(table, 0.5, curve, CURVES, &depth, NULL) == WT_OK;
    wt_contact_table_free(table);
    return done && isnan(depth.change_p);
}

static void gsl_errors_do_not_abort(void **state)
{
    (void)state;
    assert_true(comes_back(dwell_on_a_wall));
    assert_true(comes_back(pool_of_one));
    assert_true(comes_back(depth_of_one));
}

static void dwell_without_noise(void **state)
{
    (void)state;
    wt_dwell dwell;
    assert_true(fit_dwell(0, 1, &dwell));
    assert_false(dwell.found);
    assert_string_equal(dwell.reason, "no noise in the baseline");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gsl_errors_do_not_abort),
        cmocka_unit_test(dwell_without_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
