/* Prony series: the non-negative solver against its optimality conditions, known series, liquids,
 * smoothing, the Kramers-Kronig check, and replicates for the error of the material.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"
#include "weartrack/fit.h"

#include "dma_data.h"
#include "fit/nnls.h"
#include "fit/prony.h"

/* ---- non-negative least squares -------------------------------------------------------------- */

/* At the solution: x >= 0, gradient <= 0 where x = 0, gradient = 0 where x > 0. */
static void assert_optimal(const gsl_matrix *a, const gsl_vector *b, const double *x)
{
    for (size_t j = 0; j < a->size2; j++) {
        double gradient = 0.0, norm = 0.0;
        for (size_t i = 0; i < a->size1; i++) {
            double residual = gsl_vector_get(b, i);
            for (size_t k = 0; k < a->size2; k++)
                residual -= gsl_matrix_get(a, i, k) * x[k];
            gradient += gsl_matrix_get(a, i, j) * residual;
            norm += gsl_matrix_get(a, i, j) * gsl_matrix_get(a, i, j);
        }
        assert_true(x[j] >= 0.0);
        gradient /= sqrt(norm > 0.0 ? norm : 1.0);
        assert_true(gradient < 1e-9);
        if (x[j] > 0.0)
            assert_near_abs(gradient, 0.0, 1e-9);
    }
}

static void solve_and_check(const gsl_matrix *a, const gsl_vector *b, double *x)
{
    gsl_matrix *work = gsl_matrix_alloc(a->size1, a->size2);
    gsl_vector *rhs = gsl_vector_alloc(b->size);
    gsl_matrix_memcpy(work, a);
    gsl_vector_memcpy(rhs, b);
    assert_int_equal(nnls(work, rhs, x, NULL), WT_OK);
    assert_optimal(a, b, x);
    gsl_matrix_free(work);
    gsl_vector_free(rhs);
}

/* min |x - c| over x >= 0 is max(c, 0). */
static void nnls_projects_onto_the_positive_orthant(void **state)
{
    (void)state;
    static const double c[] = {2.385, -1.7, 0.31, -1e-7, 0.0, 5.5};
    gsl_matrix *a = gsl_matrix_calloc(6, 6);
    gsl_vector *b = gsl_vector_alloc(6);
    double x[6];
    for (size_t i = 0; i < 6; i++) {
        gsl_matrix_set(a, i, i, 1.0);
        gsl_vector_set(b, i, c[i]);
    }
    solve_and_check(a, b, x);
    for (size_t i = 0; i < 6; i++)
        assert_near_abs(x[i], fmax(c[i], 0.0), 1e-14);
    gsl_matrix_free(a);
    gsl_vector_free(b);
}

/* Random problems of very different column lengths, one column empty, two equal. */
static void nnls_meets_the_optimality_conditions(void **state)
{
    (void)state;
    uint64_t noise = 89;
    for (int round = 0; round < 50; round++) {
        gsl_matrix *a = gsl_matrix_alloc(30, 12);
        gsl_vector *b = gsl_vector_alloc(30);
        double x[12];
        for (size_t i = 0; i < 30; i++) {
            for (size_t j = 0; j < 12; j++)
                gsl_matrix_set(a, i, j, dma_normal(&noise) * pow(10.0, (double)j - 6.0));
            gsl_matrix_set(a, i, 3, 0.0);
            gsl_matrix_set(a, i, 8, gsl_matrix_get(a, i, 7));
            gsl_vector_set(b, i, dma_normal(&noise));
        }
        solve_and_check(a, b, x);
        assert_near(x[3], 0.0, 0.0);
        gsl_matrix_free(a);
        gsl_vector_free(b);
    }
}

static void nnls_refuses_too_few_rows(void **state)
{
    (void)state;
    gsl_matrix *a = gsl_matrix_calloc(2, 3);
    gsl_vector *b = gsl_vector_calloc(2);
    double x[3];
    assert_int_equal(nnls(a, b, x, NULL), WT_E_ARG);
    gsl_matrix_free(a);
    gsl_vector_free(b);
}

/* ---- series ---------------------------------------------------------------------------------- */

/* A master curve of n points over [low, high] decades from a function, one "isotherm". */
static wt_master_curve curve_of(void (*moduli)(double log_w, double *storage, double *loss),
                                double low, double high, size_t n, double noise, uint64_t seed)
{
    wt_master_curve master = {.deformation = WT_SHEAR,
                              .reference_temperature = 293.15,
                              .n_shifts = 1,
                              .shifts = calloc(1, sizeof(wt_shift)),
                              .covariance = calloc(1, sizeof(double)),
                              .covariance_ab = calloc(4, sizeof(double)),
                              .n = n,
                              .log_frequency = calloc(n, sizeof(double)),
                              .log_storage = calloc(n, sizeof(double)),
                              .log_loss = calloc(n, sizeof(double)),
                              .isotherm = calloc(n, sizeof(size_t))};
    uint64_t state = seed;
    for (size_t i = 0; i < n; i++) {
        double storage, loss;
        master.log_frequency[i] = low + (high - low) * (double)i / (double)(n - 1);
        moduli(master.log_frequency[i], &storage, &loss);
        master.log_storage[i] = log10(storage) + noise / log(10.0) * dma_normal(&state);
        master.log_loss[i] = log10(loss) + noise / log(10.0) * dma_normal(&state);
    }
    return master;
}

static void rubber(double log_w, double *storage, double *loss)
{
    dma_moduli(&dma_rubber, pow(10.0, log_w), storage, loss);
}

static void maxwell_liquid(double log_w, double *storage, double *loss)
{
    const double z = pow(10.0, log_w) * 0.37;
    *storage = 2.385e5 * z * z / (1.0 + z * z);
    *loss = 2.385e5 * z / (1.0 + z * z);
}

static prony_points points_of(const wt_master_curve *master)
{
    return (prony_points){
        master->n,        master->log_frequency,    master->log_storage,
        master->log_loss, master->log_frequency[0], master->log_frequency[master->n - 1]};
}

static void a_known_rubber_comes_back(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(rubber, -5.0, 7.0, 200, 0.01, 97);
    wt_prony_options options = wt_prony_defaults();
    options.terms_per_decade = 2.0;
    wt_prony_fit fit;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, NULL), WT_OK);
    assert_int_equal(fit.prony.deformation, WT_SHEAR);
    assert_near(fit.prony.reference_temperature, 293.15, 0.0);
    assert_near(fit.prony.frequency_min, 1e-5, 1e-12);
    assert_near(fit.prony.frequency_max, 1e7, 1e-12);
    assert_int_equal(fit.prony.n, 27); /* 13 decades at two, both ends */
    assert_near(fit.prony.relaxation_time[0], 1e5 * sqrt(10.0), 1e-12);
    assert_near(fit.prony.relaxation_time[26], 1e-7 / sqrt(10.0), 1e-12);
    assert_near(fit.prony.equilibrium_modulus, 1e6, 0.02);
    for (size_t k = 0; k < fit.prony.n; k++)
        assert_true(fit.prony.modulus[k] >= 0.0);
    assert_true(fit.rms_storage < 0.012);
    assert_true(fit.rms_loss < 0.012);
    for (double x = -5.0; x <= 7.0; x += 0.237) { /* between the points too */
        double storage, loss, log_storage, log_loss;
        rubber(x, &storage, &loss);
        prony_log_moduli(&fit.prony, x, &log_storage, &log_loss);
        assert_near(pow(10.0, log_storage), storage, 0.02);
        assert_near(pow(10.0, log_loss), loss, 0.03);
    }
    wt_prony_clear(&fit.prony);

    /* One term per decade: the ripple of a few percent that dma theory expects. */
    options.terms_per_decade = 1.0;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, NULL), WT_OK);
    assert_true(fit.rms_storage < 0.05 && fit.rms_storage > 0.012);
    assert_true(fit.rms_loss < 0.06 && fit.rms_loss > 0.012);
    wt_prony_clear(&fit.prony);
    wt_master_curve_clear(&master);
}

static void a_liquid_has_no_equilibrium_modulus(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(maxwell_liquid, -3.0, 3.0, 61, 0.0, 1);
    wt_prony_options options = wt_prony_defaults();
    wt_prony_fit fit;
    options.liquid = true;
    options.terms_per_decade = 10.0;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, NULL), WT_OK);
    assert_near(fit.prony.equilibrium_modulus, 0.0, 0.0);
    double sum = 0.0, weighted = 0.0;
    for (size_t k = 0; k < fit.prony.n; k++) {
        sum += fit.prony.modulus[k];
        weighted += fit.prony.modulus[k] * fit.prony.relaxation_time[k];
    }
    assert_near(sum, 2.385e5, 0.01);             /* plateau */
    assert_near(weighted, 2.385e5 * 0.37, 0.01); /* viscosity */
    wt_prony_clear(&fit.prony);
    wt_master_curve_clear(&master);
}

static double roughness_of(const wt_prony *prony)
{
    double sum = 0.0, level = 0.0;
    for (size_t k = 1; k + 1 < prony->n; k++) {
        sum += fabs(prony->modulus[k - 1] - 2.0 * prony->modulus[k] + prony->modulus[k + 1]);
        level += prony->modulus[k];
    }
    return sum / level;
}

static void smoothing_smooths(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(rubber, -5.0, 7.0, 200, 0.02, 101);
    wt_prony_options options = {.terms_per_decade = 4.0};
    wt_prony_fit plain, smooth;
    assert_int_equal(wt_prony_fit_master(&master, &options, &plain, NULL), WT_OK);
    options.smoothing = 0.1;
    assert_int_equal(wt_prony_fit_master(&master, &options, &smooth, NULL), WT_OK);
    assert_true(roughness_of(&smooth.prony) < 0.5 * roughness_of(&plain.prony));
    assert_true(smooth.rms_loss < 1.2 * plain.rms_loss);
    wt_prony_clear(&plain.prony);
    wt_prony_clear(&smooth.prony);
    wt_master_curve_clear(&master);
}

static void reduced_frequencies_beyond_any_instrument_are_kept(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(rubber, -5.0, 7.0, 100, 0.0, 1);
    for (size_t i = 0; i < master.n; i++)
        master.log_frequency[i] -= 33.0;
    wt_prony_fit fit;
    assert_int_equal(wt_prony_fit_master(&master, NULL, &fit, NULL), WT_OK);
    assert_near(fit.prony.frequency_min, 1e-38, 1e-9);
    assert_near(fit.prony.equilibrium_modulus, 1e6, 0.05);
    assert_true(fit.rms_storage < 0.05);
    wt_prony_clear(&fit.prony);
    wt_master_curve_clear(&master);
}

static void senseless_settings_are_refused(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(rubber, -5.0, 7.0, 100, 0.0, 1);
    wt_prony_fit fit;
    wt_error err = WT_ERROR_INIT;
    wt_prony_options options = wt_prony_defaults();
    options.terms_per_decade = 0.0;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, &err), WT_E_RANGE);
    options.terms_per_decade = (double)NAN;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, &err), WT_E_RANGE);
    options = wt_prony_defaults();
    options.smoothing = -1.0;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, &err), WT_E_RANGE);
    options = wt_prony_defaults();
    options.terms_per_decade = 8.0;
    master.n = 20;
    master.log_frequency[19] = 7.0;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, &err), WT_E_MISSING);
    assert_non_null(strstr(err.advice, "fewer terms"));
    wt_master_curve_clear(&master);
    assert_int_equal(wt_prony_fit_master(&master, NULL, &fit, &err), WT_E_MISSING);
}

/* ---- Kramers-Kronig -------------------------------------------------------------------------- */

static void kramers_kronig_tells_a_causal_material_from_a_miscalibrated_one(void **state)
{
    (void)state;
    wt_master_curve master = curve_of(rubber, -5.0, 7.0, 200, 0.01, 103);
    prony_points points = points_of(&master);
    double misfit;
    assert_int_equal(prony_kramers_kronig(&points, &misfit, NULL), WT_OK);
    assert_true(misfit < 0.05);
    for (size_t i = 0; i < master.n; i++)
        master.log_loss[i] += log10(1.5);
    assert_int_equal(prony_kramers_kronig(&points, &misfit, NULL), WT_OK);
    assert_near(misfit, 1.0 - 1.0 / 1.5, 0.15);
    /* Nothing but plateau: E' cannot tell. */
    for (size_t i = 0; i < master.n; i++)
        master.log_loss[i] = master.log_storage[i] - 1.5;
    assert_int_equal(prony_kramers_kronig(&points, &misfit, NULL), WT_OK);
    assert_near(misfit, (double)NAN, 0.0);
    wt_master_curve_clear(&master);
}

/* ---- replicates ------------------------------------------------------------------------------ */

static wt_master_curve shifted_rubber(void)
{
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 107);
    wt_shift_options options = wt_shift_defaults();
    options.reference_temperature = 293.15;
    options.vertical = WT_VERTICAL_PHYSICAL;
    wt_master_curve master = {0};
    assert_int_equal(wt_shift_fit(&sweep, &options, NULL, &master, NULL), WT_OK);
    wt_sweep_clear(&sweep);
    return master;
}

static void replicates_are_reproducible_and_distinct(void **state)
{
    (void)state;
    wt_master_curve master = shifted_rubber();
    wt_prony first = {0}, again = {0}, next = {0}, seeded = {0};
    assert_int_equal(wt_prony_replicate(&master, NULL, 5, 3, &first, NULL, NULL), WT_OK);
    assert_int_equal(wt_prony_replicate(&master, NULL, 5, 4, &next, NULL, NULL), WT_OK);
    assert_int_equal(wt_prony_replicate(&master, NULL, 5, 3, &again, NULL, NULL), WT_OK);
    assert_int_equal(wt_prony_replicate(&master, NULL, 6, 3, &seeded, NULL, NULL), WT_OK);
    assert_int_equal(first.n, again.n);
    assert_int_equal(first.n, next.n);
    assert_near(first.reference_temperature, 293.15, 0.0);
    bool other_index = false, other_seed = false;
    for (size_t k = 0; k < first.n; k++) {
        assert_near(again.modulus[k], first.modulus[k], 0.0);
        assert_near(again.relaxation_time[k], first.relaxation_time[k], 0.0);
        assert_near(next.relaxation_time[k], first.relaxation_time[k], 0.0);
        other_index |= next.modulus[k] != first.modulus[k];
        other_seed |= seeded.modulus[k] != first.modulus[k];
    }
    assert_true(other_index);
    assert_true(other_seed);
    wt_prony_clear(&first);
    wt_prony_clear(&again);
    wt_prony_clear(&next);
    wt_prony_clear(&seeded);
    wt_master_curve_clear(&master);
}

/* Where E' rises with slope m, shifts of standard error s scatter it by m s; the reference isotherm
 * stays. Residuals are switched off by making the points lie on the series. */
static void replicates_carry_the_errors_of_the_shifts(void **state)
{
    (void)state;
    wt_master_curve master = shifted_rubber();
    const wt_prony_options options = {.terms_per_decade = 2.0};
    wt_prony_fit fit;
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, NULL), WT_OK);
    for (size_t i = 0; i < master.n; i++)
        prony_log_moduli(&fit.prony, master.log_frequency[i], &master.log_storage[i],
                         &master.log_loss[i]);
    const size_t n = master.n_shifts;
    /* all shifts but the reference move together, by 0.1 decade */
    for (size_t i = 0; i < n; i++) {
        const bool reference = master.shifts[i].log_a.standard_error == 0.0;
        master.shifts[i].log_a.standard_error = reference ? 0.0 : 0.1;
        for (size_t k = 0; k < n; k++) {
            const double both = reference || master.shifts[k].log_a.value == 0.0 ? 0.0 : 0.01;
            master.covariance[i * n + k] = both;
            master.covariance_ab[i * 2 * n + k] = both;
            master.covariance_ab[i * 2 * n + n + k] = 0.0;
            master.covariance_ab[(n + i) * 2 * n + k] = 0.0;
            master.covariance_ab[(n + i) * 2 * n + n + k] = 0.0;
        }
    }
    double before, after, unused, middle = 0.0, square = 0.0;
    enum { DRAWS = 200 };
    for (size_t r = 0; r < DRAWS; r++) {
        wt_prony prony = {0};
        assert_int_equal(wt_prony_replicate(&master, &options, 11, r, &prony, NULL, NULL), WT_OK);
        double storage;
        prony_log_moduli(&prony, 4.5, &storage, &unused);
        middle += storage / DRAWS;
        square += storage * storage / DRAWS;
        wt_prony_clear(&prony);
    }
    prony_log_moduli(&fit.prony, 4.4, &before, &unused);
    prony_log_moduli(&fit.prony, 4.6, &after, &unused);
    const double slope = (after - before) / 0.2;
    assert_near(sqrt(square - middle * middle), 0.1 * slope, 0.2);
    wt_prony_clear(&fit.prony);
    wt_master_curve_clear(&master);
}

/* An error of the reference isotherm is one of all other vertical shifts together: it does not
 * average out over the isotherms, and is told for the material at another temperature. */
static void replicates_carry_the_common_error_of_the_vertical_shifts(void **state)
{
    (void)state;
    wt_master_curve master = shifted_rubber();
    const wt_prony_options options = {.terms_per_decade = 2.0};
    const size_t n = master.n_shifts;
    enum { DRAWS = 200 };
    double *change = calloc(n, sizeof *change), middle = 0.0, square = 0.0, of_change = 0.0;
    wt_prony_fit fit;
    assert_non_null(change);
    assert_int_equal(wt_prony_fit_master(&master, &options, &fit, NULL), WT_OK);
    for (size_t i = 0; i < master.n; i++)
        prony_log_moduli(&fit.prony, master.log_frequency[i], &master.log_storage[i],
                         &master.log_loss[i]);
    for (size_t i = 0; i < 2 * n; i++)
        for (size_t k = 0; k < 2 * n; k++) /* 0.01 decade */
            master.covariance_ab[i * 2 * n + k] = i < n || k < n ? 0.0 : 1e-4;
    for (size_t r = 0; r < DRAWS; r++) {
        wt_prony prony = {0};
        double storage, loss;
        assert_int_equal(wt_prony_replicate(&master, &options, 11, r, &prony, change, NULL), WT_OK);
        prony_log_moduli(&prony, 4.5, &storage, &loss);
        middle += storage / DRAWS;
        square += storage * storage / DRAWS;
        of_change += change[0] * change[0] / DRAWS;
        assert_near(change[n - 1], change[0], 1e-12);
        wt_prony_clear(&prony);
    }
    assert_near(sqrt(square - middle * middle), 0.01, 0.15);
    assert_near(sqrt(of_change), 0.01, 0.15);
    free(change);
    wt_prony_clear(&fit.prony);
    wt_master_curve_clear(&master);
}

/* The spread of replicates holds the truth about as often as two standard deviations should. */
static void replicates_spread_about_the_truth(void **state)
{
    (void)state;
    wt_master_curve master = shifted_rubber();
    const wt_prony_options options = {.terms_per_decade = 2.0};
    enum { DRAWS = 60 };
    double sum[20] = {0.0}, square[20] = {0.0};
    for (size_t r = 0; r < DRAWS; r++) {
        wt_prony prony = {0};
        assert_int_equal(wt_prony_replicate(&master, &options, 13, r, &prony, NULL, NULL), WT_OK);
        for (size_t g = 0; g < 20; g++) {
            double storage, loss;
            prony_log_moduli(&prony, -3.0 + 0.47 * (double)g, &storage, &loss);
            sum[g] += storage / DRAWS;
            square[g] += storage * storage / DRAWS;
        }
        wt_prony_clear(&prony);
    }
    int inside = 0;
    for (size_t g = 0; g < 20; g++) {
        double storage, loss;
        rubber(-3.0 + 0.47 * (double)g, &storage, &loss);
        const double spread = sqrt(square[g] - sum[g] * sum[g]);
        assert_true(spread > 1e-4 && spread < 0.05); /* decade */
        inside += fabs(sum[g] - log10(storage)) < 2.5 * spread;
    }
    assert_in_range(inside, 15, 20);
    wt_master_curve_clear(&master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nnls_projects_onto_the_positive_orthant),
        cmocka_unit_test(nnls_meets_the_optimality_conditions),
        cmocka_unit_test(nnls_refuses_too_few_rows),
        cmocka_unit_test(a_known_rubber_comes_back),
        cmocka_unit_test(a_liquid_has_no_equilibrium_modulus),
        cmocka_unit_test(smoothing_smooths),
        cmocka_unit_test(reduced_frequencies_beyond_any_instrument_are_kept),
        cmocka_unit_test(senseless_settings_are_refused),
        cmocka_unit_test(kramers_kronig_tells_a_causal_material_from_a_miscalibrated_one),
        cmocka_unit_test(replicates_are_reproducible_and_distinct),
        cmocka_unit_test(replicates_carry_the_errors_of_the_shifts),
        cmocka_unit_test(replicates_carry_the_common_error_of_the_vertical_shifts),
        cmocka_unit_test(replicates_spread_about_the_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
