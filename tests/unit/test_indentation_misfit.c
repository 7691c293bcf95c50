/* Error by a lack of fit: as large as its effect on the modulus, and negligible where the law
 * holds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "indentation/numerics/curve.h"
#include "synthetic_curve.h"

static curve_data data;
static wt_indent_workspace *workspace;

/* Fits with the tip `stated`. */
static wt_indent_fit fit_tip(const curve_truth *t, const wt_tip *stated)
{
    wt_contact_table *table = NULL;
    wt_indent_fit fit;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_contact_table_new(stated, 1e-11, 1e-4, &table, NULL), WT_OK);
    if (wt_indent_fit_curve(table, NULL, data.height, data.force, data.time, t->n,
                            t->spring_constant, workspace, &fit, &err) != WT_OK)
        fail_msg("%s", err.message);
    wt_contact_table_free(table);
    return fit;
}

/* Errors of curves that fit the law are those of the noise, however small. */
static void law_that_holds(void **state)
{
    (void)state;
    const double noises[] = {0, 1e-13, 1e-12, 1e-11, 1e-10};
    for (size_t k = 0; k < sizeof noises / sizeof noises[0]; k++) {
        double square = 0, stated = 0;
        enum { CURVES = 12 };
        for (uint64_t seed = 1; seed <= CURVES; seed++) {
            curve_truth t = curve_standard();
            t.noise = noises[k];
            curve_make(&t, seed, &data);
            const wt_indent_fit fit = fit_tip(&t, &t.tip);
            assert_int_equal(fit.verdict, WT_CURVE_ACCEPTED);
            square += pow(fit.modulus.value / t.modulus - 1, 2) / CURVES;
            stated += pow(fit.modulus.standard_error / t.modulus, 2) / CURVES;
        }
        if (!(sqrt(stated) < fmax(1.6 * sqrt(square), 5e-5)))
            fail_msg("noise %g: errors of %g, %g stated", noises[k], sqrt(square), sqrt(stated));
    }
}

/* With few samples the contact force rises from one to the next by more than any noise. */
static void few_samples_in_contact(void **state)
{
    (void)state;
    for (size_t in_contact = 9; in_contact < 16; in_contact++) {
        curve_truth t = curve_standard();
        const double beyond = t.travel - t.contact_point;
        t.n = 200;
        t.travel = t.contact_point + beyond;
        t.contact_point = t.travel * (1 - ((double)in_contact - 0.5) / (double)(t.n - 1));
        t.noise = 20e-12;
        curve_make(&t, 3, &data);
        const wt_indent_fit fit = fit_tip(&t, &t.tip);
        if (fit.n_fitted != t.n)
            fail_msg("%zu in contact: %zu of %zu samples fitted: %s", in_contact, fit.n_fitted, t.n,
                     fit.reason);
        assert_near(fit.modulus.value, t.modulus, 0.02);
        assert_near(fit.max_force, curve_contact_force(&t, t.travel - t.contact_point), 0.01);
    }
}

/* A quarter of the approach before contact is enough baseline, for any samples. */
static void short_baselines(void **state)
{
    (void)state;
    for (size_t n = 128; n <= 8192; n *= 4) {
        curve_truth t = curve_standard();
        t.n = n;
        t.contact_point = (t.travel - t.contact_point) / 3;
        t.travel = 4 * t.contact_point;
        t.noise = 20e-12;
        curve_make(&t, 3, &data);
        const wt_indent_fit fit = fit_tip(&t, &t.tip);
        if (fit.verdict != WT_CURVE_ACCEPTED)
            fail_msg("%zu samples: %s", n, fit.reason);
        assert_near_abs(fit.modulus.value, t.modulus, 3 * fit.modulus.standard_error);
        assert_true(fit.modulus.standard_error < 0.05 * t.modulus);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(law_that_holds),
        cmocka_unit_test(few_samples_in_contact),
        cmocka_unit_test(short_baselines),
    };
    workspace = wt_indent_workspace_new();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    wt_indent_workspace_free(workspace);
    return failed;
}
