/* Temperature sweeps in one spectrum: the master curve of sweeps at few frequencies equals that of
 * isotherms of the same material.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "dma/master.h"

#include "dma_data.h"

/* Two Cole-Cole processes and a network; moduli follow rho T. */
static void moduli(double omega, double temperature, double *storage, double *loss)
{
    static const double strength[] = {1.5e9, 4e6}, time[] = {1e-5, 0.1}, alpha[] = {0.6, 0.4};
    const double shifted = omega * pow(10, wt_wlf_log_shift(&dma_rubber.wlf, temperature));
    *storage = 2e6;
    *loss = 0;
    for (int i = 0; i < 2; i++) {
        const double r = pow(shifted * time[i], alpha[i]), c = r * cos(alpha[i] * M_PI / 2),
                     s = r * sin(alpha[i] * M_PI / 2), below = (1 + c) * (1 + c) + s * s;
        *storage += strength[i] * (c + r * r) / below;
        *loss += strength[i] * s / below;
    }
    *storage *= temperature / 293.15;
    *loss *= temperature / 293.15;
}

enum { DRAWS = 10, PLACES = 21 };
static const double noise = 0.005;

/* From -30 to 80 degC at several frequencies over two decades, while the temperature rises. */
static void heat(wt_sweep *sweep, size_t frequencies, double step, uint64_t *state)
{
    const size_t n = (size_t)(110 / step);
    for (size_t i = 0; i < frequencies; i++) {
        wt_ramp *ramp = wt_sweep_add_ramp(sweep, n, 0);
        assert_non_null(ramp);
        const double share = frequencies > 1 ? (double)i / (double)(frequencies - 1) : 0.5;
        ramp->angular_frequency = 2 * M_PI * pow(10, -1 + 2 * share);
        for (size_t k = 0; k < n; k++) {
            double *storage = &ramp->storage_modulus[k], *loss = &ramp->loss_modulus[k];
            ramp->temperature[k] = 243.15 + step * ((double)k + (double)i / (double)frequencies);
            moduli(ramp->angular_frequency, ramp->temperature[k], storage, loss);
            *storage *= exp(noise * dma_normal(state));
            *loss *= exp(noise * dma_normal(state));
        }
    }
    wt_sweep_sort(sweep);
}

static void hold(wt_sweep *sweep, double first, double last, uint64_t *state)
{
    for (double t = first; t < last + 1; t += 10) {
        wt_isotherm *isotherm = wt_sweep_add(sweep, 13, 0);
        assert_non_null(isotherm);
        isotherm->temperature = t;
        for (size_t k = 0; k < 13; k++) {
            double *storage = &isotherm->storage_modulus[k], *loss = &isotherm->loss_modulus[k];
            isotherm->angular_frequency[k] = 2 * M_PI * pow(10, -1 + (double)k / 6);
            moduli(isotherm->angular_frequency[k], t, storage, loss);
            *storage *= exp(noise * dma_normal(state));
            *loss *= exp(noise * dma_normal(state));
        }
    }
    wt_sweep_sort(sweep);
}

static const wt_shift_law none = {.kind = WT_LAW_NONE};

static wt_master_options options(void)
{
    wt_master_options o = wt_master_options_defaults();
    o.reference_temperature = 293.15;
    return o;
}

/* Both methods for one material: each covers the truth, and they agree within their errors. */
static void ramps_agree_with_isotherms(void **unused)
{
    const wt_master_options o = options();
    size_t held = 0, agree = 0, law = 0;
    (void)unused;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        uint64_t state = draw + 1;
        wt_sweep heated = {0}, held_at = {0};
        wt_master a = {0}, b = {0};
        heat(&heated, 3, 1, &state);
        hold(&held_at, 243.15, 353.15, &state);
        assert_int_equal(flow_ramps_fit(&heated, &o, &none, NULL, &a, NULL), WT_OK);
        assert_int_equal(wt_master_fit(&held_at, &o, NULL, &b, NULL), WT_OK);
        assert_int_equal(a.superposition, WT_SUPERPOSITION_HOLDS);
        assert_true(a.noise_storage < 1.2 * noise && a.noise_loss < 1.2 * noise);
        for (size_t k = 0; k < PLACES; k++) {
            const double w = pow(10, -3 + 0.5 * (double)k);
            double truth[2];
            wt_interval x[2], y[2];
            moduli(w, 293.15, &truth[0], &truth[1]);
            wt_master_moduli(&a, w, &x[0], &x[1]);
            wt_master_moduli(&b, w, &y[0], &y[1]);
            for (int q = 0; q < 2; q++) {
                held += x[q].low <= log10(truth[q]) && log10(truth[q]) <= x[q].high;
                agree += fabs(x[q].value - y[q].value) <
                         1.96 * hypot(x[q].standard_error, y[q].standard_error);
            }
        }
        for (double t = 253.15; t < 344; t += 10) {
            const wt_interval got = wt_master_log_shift(&a, t);
            const double truth = wt_wlf_log_shift(&dma_rubber.wlf, t);
            assert_near_abs(got.value, truth, 0.03);
            law += got.low <= truth && truth <= got.high;
        }
        wt_master_clear(&a);
        wt_master_clear(&b);
        wt_sweep_clear(&heated);
        wt_sweep_clear(&held_at);
    }
    const double n = 2.0 * DRAWS * PLACES;
    print_message("moduli held %.3f, agree %.3f; law held %.2f\n", (double)held / n,
                  (double)agree / n, (double)law / (10.0 * DRAWS));
    assert_true((double)held > 0.88 * n && (double)agree > 0.9 * n);
    assert_true(law > 80);
}

/* A single frequency with isotherms is placed by the law; alone it has no law. */
static void one_frequency(void **unused)
{
    const wt_master_options o = options();
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    uint64_t state = 5;
    (void)unused;
    heat(&sweep, 1, 1, &state);
    assert_int_equal(flow_ramps_fit(&sweep, &o, &none, NULL, &m, &err), WT_E_MISSING);
    assert_non_null(strstr(err.message, "at one frequency"));
    hold(&sweep, 243.15, 353.15, &state);
    assert_int_equal(flow_ramps_fit(&sweep, &o, &none, NULL, &m, &err), WT_OK);
    assert_true(m.n > 12 * 13);
    assert_true(m.n_shifts == sweep.n_isotherms && m.n_shifts > 30);
    for (size_t i = 1; i < sweep.n_isotherms; i++)
        assert_true(sweep.isotherms[i].temperature >= sweep.isotherms[i - 1].temperature);
    assert_near_abs(m.c1.value, 8.0, 5 * m.c1.standard_error);
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ramps_agree_with_isotherms),
                                       cmocka_unit_test(one_frequency)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
