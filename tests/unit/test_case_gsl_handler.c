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
    assert_true(comes_back(pool_of_one));
    assert_true(comes_back(depth_of_one));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gsl_errors_do_not_abort),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
