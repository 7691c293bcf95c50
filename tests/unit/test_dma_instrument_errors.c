/* Errors of the instrument that all isotherms share: phase lag, inertia and compliance of the
 * frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/dma.h"

#include "dma_data.h"

#define NOISE 0.01

/* What an instrument makes of the moduli: the storage modulus lacks `inertia` [Pa s^2] times the
 * square of the frequency, and the phase lags by `lag` [s] times the frequency. */
static void distort(wt_sweep *sweep, double lag, double inertia)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        for (size_t k = 0; k < sweep->isotherms[i].n; k++) {
            const wt_isotherm *const t = &sweep->isotherms[i];
            const double omega = t->angular_frequency[k], angle = lag * omega,
                         storage = t->storage_modulus[k] - inertia * omega * omega,
                         loss = t->loss_modulus[k];
            t->storage_modulus[k] = storage * cos(angle) - loss * sin(angle);
            t->loss_modulus[k] = storage * sin(angle) + loss * cos(angle);
        }
}

/* Fits distorted isotherms of the synthetic rubber. */
static wt_master fit_distorted(double lag, double inertia, wt_log *log)
{
    wt_sweep sweep = {0};
    wt_master master = {0};
    dma_usual(&sweep, true, NOISE, 5);
    distort(&sweep, lag, inertia);
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = 293.15;
    assert_int_equal(wt_master_fit(&sweep, &options, log, &master, NULL), WT_OK);
    wt_sweep_clear(&sweep);
    return master;
}

/* Highest frequency of the isotherms, and the largest share of a unit of inertia in E'. */
static void find_scales(double *fastest, double *share)
{
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, NOISE, 5);
    *fastest = *share = 0.0;
    for (size_t i = 0; i < sweep.n_isotherms; i++)
        for (size_t k = 0; k < sweep.isotherms[i].n; k++) {
            const double omega = sweep.isotherms[i].angular_frequency[k];
            *fastest = fmax(*fastest, omega);
            *share = fmax(*share, omega * omega / sweep.isotherms[i].storage_modulus[k]);
        }
    wt_sweep_clear(&sweep);
}

static bool log_has(const wt_log *log, const char *text)
{
    for (size_t i = 0; i < wt_log_count(log); i++)
        if (strstr(wt_log_get(log, i).text, text) != NULL)
            return true;
    return false;
}

static void assert_shifts_are_true(const wt_master *m)
{
    for (size_t i = 0; i < m->n_shifts; i++)
        assert_near_abs(m->shifts[i].log_a.value,
                        wt_wlf_log_shift(&dma_rubber.wlf, m->shifts[i].temperature),
                        4.0 * m->shifts[i].log_a.standard_error + 1e-12);
}

/* Moduli of the spectrum within the measured frequencies are those of the rubber. */
static void assert_moduli_are_true(const wt_master *m)
{
    for (size_t i = 0; i < m->n; i += 10) {
        double storage, loss;
        dma_moduli(&dma_rubber, pow(10.0, m->log_frequency[i]), &storage, &loss);
        assert_near_abs(m->fitted_storage[i].value, log10(storage),
                        4.0 * m->fitted_storage[i].standard_error);
        assert_near_abs(m->fitted_loss[i].value, log10(loss),
                        4.0 * m->fitted_loss[i].standard_error);
    }
}

static void nothing_is_found_in_sound_isotherms(void **state)
{
    (void)state;
    wt_log *log = wt_log_new();
    wt_master m = fit_distorted(0.0, 0.0, log);
    assert_near_abs(m.phase_lag.value, 0.0, 3.0 * m.phase_lag.standard_error);
    assert_near_abs(m.inertia.value, 0.0, 3.0 * m.inertia.standard_error);
    assert_true(m.phase_lag.standard_error < 0.003); /* [rad], of 0.0087 before the data */
    assert_false(log_has(log, "phase angle"));
    assert_false(log_has(log, "inertia"));
    assert_shifts_are_true(&m);
    wt_log_free(log);
    wt_master_clear(&m);
}

static void a_phase_lag_is_found_and_corrected(void **state)
{
    (void)state;
    double fastest, share;
    find_scales(&fastest, &share);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double angle = sign * 0.015; /* 0.9 degrees */
        wt_log *log = wt_log_new();
        wt_master m = fit_distorted(angle / fastest, 0.0, log);
        assert_near_abs(m.phase_lag.value, angle, 3.0 * m.phase_lag.standard_error);
        assert_true(log_has(log, sign > 0 ? "the phase angle is too large"
                                          : "the phase angle is too small"));
        assert_int_equal(m.superposition, WT_SUPERPOSITION_HOLDS);
        assert_shifts_are_true(&m);
        assert_moduli_are_true(&m);
        wt_log_free(log);
        wt_master_clear(&m);
    }
}

static void inertia_is_found_and_corrected(void **state)
{
    (void)state;
    double fastest, share;
    find_scales(&fastest, &share);
    wt_log *log = wt_log_new();
    wt_master m = fit_distorted(0.0, 0.04 / share, log);
    assert_near_abs(m.inertia.value, 0.04, 3.0 * m.inertia.standard_error);
    assert_true(log_has(log, "the storage modulus is too low by up to"));
    assert_shifts_are_true(&m);
    assert_moduli_are_true(&m);
    wt_log_free(log);
    wt_master_clear(&m);
}

/* Isotherms hardly show a spring in series, so that its assumed error is in the errors of the
 * moduli.
 */
static void the_compliance_of_the_frame_widens_the_errors(void **state)
{
    (void)state;
    wt_master m = fit_distorted(0.0, 0.0, NULL);
    assert_near_abs(m.frame_compliance.value, 0.0, 1e-15); /* it is not fitted */
    assert_near(m.frame_compliance.standard_error, 1e-11, 1e-6);
    size_t stiffest = 0, softest = 0;
    for (size_t i = 0; i < m.n; i++) {
        stiffest = m.log_storage[i] > m.log_storage[stiffest] ? i : stiffest;
        softest = m.log_storage[i] < m.log_storage[softest] ? i : softest;
    }
    const double assumed = 1e-11 * pow(10.0, m.log_storage[stiffest]) / M_LN10;
    assert_true(m.fitted_storage[stiffest].standard_error > 0.8 * assumed);
    assert_true(m.fitted_loss[stiffest].standard_error > 1.8 * assumed);
    assert_true(m.fitted_storage[softest].standard_error <
                m.fitted_storage[stiffest].standard_error);
    wt_master_clear(&m);
}

static void one_quantity_has_no_such_errors(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    wt_master m = {0};
    dma_usual(&sweep, true, NOISE, 5);
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = 293.15;
    options.shift_by = WT_SHIFT_STORAGE;
    assert_int_equal(wt_master_fit(&sweep, &options, NULL, &m, NULL), WT_OK);
    assert_true(isnan(m.phase_lag.value) && isnan(m.inertia.value) &&
                isnan(m.frame_compliance.standard_error));
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

/* Draws of a sample that may be warmer than stated: at any temperature the times move by the slope
 * of the law there. */
static void a_warmer_sample_moves_the_draws(void **state)
{
    (void)state;
    enum { DRAWS = 100 };
    static const double temperature[] = {283.15, 293.15, 323.15};
    wt_sweep sweep = {0};
    wt_master m[2] = {{0}};
    dma_usual(&sweep, true, NOISE, 5);
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = 293.15;
    assert_int_equal(wt_master_fit(&sweep, &options, NULL, &m[1], NULL), WT_OK);
    options.sample_temperature_error = 0;
    assert_int_equal(wt_master_fit(&sweep, &options, NULL, &m[0], NULL), WT_OK);
    assert_true(isnan(m[0].sample_temperature_error));
    assert_near(m[1].sample_temperature_error, 0.5, 0.0);
    assert_near(m[1].c2.standard_error, m[0].c2.standard_error, 1e-9);
    double kelvin[3] = {0}, square[3] = {0};
    for (size_t i = 0; i < DRAWS; i++) {
        wt_prony p[2] = {{0}};
        wt_shift_law law[2];
        for (int k = 0; k < 2; k++)
            assert_int_equal(wt_master_draw(&m[k], 1, i, &p[k], &law[k], NULL, NULL), WT_OK);
        for (int t = 0; t < 3; t++) {
            double log_time[2];
            for (int k = 0; k < 2; k++)
                log_time[k] =
                    log10(p[k].relaxation_time[0]) + wt_shift_law_log_a(&law[k], temperature[t]);
            const double slope = wt_shift_law_log_a(&law[0], temperature[t] + 0.01) -
                                 wt_shift_law_log_a(&law[0], temperature[t] - 0.01);
            kelvin[t] = (log_time[0] - log_time[1]) * 0.02 / slope;
            square[t] += kelvin[t] * kelvin[t] / DRAWS;
            assert_near_abs(kelvin[t], kelvin[0], 0.03 * fabs(kelvin[0]) + 1e-9);
        }
        wt_prony_clear(&p[0]);
        wt_prony_clear(&p[1]);
    }
    for (int t = 0; t < 3; t++)
        assert_near(sqrt(square[t]), 0.5, 0.2);
    wt_master_clear(&m[0]);
    wt_master_clear(&m[1]);
    wt_sweep_clear(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_found_in_sound_isotherms),
        cmocka_unit_test(a_phase_lag_is_found_and_corrected),
        cmocka_unit_test(inertia_is_found_and_corrected),
        cmocka_unit_test(the_compliance_of_the_frame_widens_the_errors),
        cmocka_unit_test(one_quantity_has_no_such_errors),
        cmocka_unit_test(a_warmer_sample_moves_the_draws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
