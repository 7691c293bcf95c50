/* The WLF fit: exact shifts, honest intervals, full covariance, freedom from the choice of the
 * reference isotherm, the pole, straight lines, Arrhenius behaviour, wrong signs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"
#include "weartrack/fit.h"

#include "dma_data.h"

/* A master curve that has shifts and nothing else. */
static wt_master_curve shifts_only(const double *temperature, const double *log_a,
                                   const double *sigma, size_t n, double reference)
{
    wt_master_curve master = {.reference_temperature = reference,
                              .n_shifts = n,
                              .shifts = calloc(n, sizeof(wt_shift)),
                              .covariance = calloc(n * n, sizeof(double))};
    for (size_t i = 0; i < n; i++) {
        master.shifts[i].temperature = temperature[i];
        master.shifts[i].log_a = (wt_estimate){log_a[i], sigma[i], 0.0, "1"};
        master.shifts[i].determined = true;
        master.covariance[i * n + i] = sigma[i] * sigma[i];
    }
    return master;
}

static const double temperatures[] = {228.15, 233.15, 243.15, 253.15,
                                      263.15, 273.15, 283.15, 298.15};
enum { N = sizeof temperatures / sizeof *temperatures };
static const wt_wlf polyisoprene = {243.15, 8.1893, 84.454};

static wt_shift_options with_floor(double floor)
{
    wt_shift_options options = wt_shift_defaults();
    options.floor = floor;
    return options;
}

static void exact_shifts_give_the_constants_back(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    for (size_t i = 0; i < N; i++)
        log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]);
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
    assert_near(fit.wlf.c1, 8.1893, 1e-7);
    assert_near(fit.wlf.c2, 84.454, 1e-7);
    assert_near(fit.b, 8.1893 * 84.454, 1e-7);
    assert_near(fit.pole, 243.15 - 84.454, 1e-7);
    assert_near(fit.pole_error, fit.c2_error, 1e-12);
    assert_near(fit.slope, -8.1893 / 84.454, 1e-7);
    assert_near_abs(fit.offset, 0.0, 1e-8);
    assert_near_abs(fit.rms, 0.0, 1e-8);
    assert_false(fit.straight);
    assert_true(fit.correlation > 0.9 && fit.correlation < 1.0);
    assert_int_equal(fit.n, N);
    assert_true(fit.aicc_wlf < fit.aicc_arrhenius);
    /* b from its parts, with their correlation */
    const double by1 = fit.wlf.c2 * fit.c1_error, by2 = fit.wlf.c1 * fit.c2_error;
    assert_near(fit.b_error, sqrt(by1 * by1 + by2 * by2 + 2.0 * fit.correlation * by1 * by2), 1e-9);
    wt_master_curve_clear(&master);
}

/* The law is one; its constants move by the exact rules when the reference does. */
static void the_reference_isotherm_has_no_privilege(void **state)
{
    (void)state;
    double log_a[N], sigma[N];
    uint64_t noise = 71;
    wt_wlf_fit first = {.n = 0};
    for (size_t reference = 0; reference < N; reference++) {
        noise = 71;
        for (size_t i = 0; i < N; i++) {
            sigma[i] = 0.01;
            log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]) + 0.01 * dma_normal(&noise);
        }
        const double zero = log_a[reference];
        for (size_t i = 0; i < N; i++)
            log_a[i] -= zero;
        wt_master_curve master =
            shifts_only(temperatures, log_a, sigma, N, temperatures[reference]);
        wt_wlf_fit fit;
        assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
        if (reference == 0)
            first = fit;
        assert_near(fit.b, first.b, 1e-5);
        assert_near(fit.pole, first.pole, 1e-5);
        assert_near(fit.rms, first.rms, 1e-5);
        assert_near(fit.pole_error, first.pole_error, 1e-4);
        wt_master_curve_clear(&master);
    }
}

/* Independent noise of known size: about 95 of 100 intervals hold the truth. */
static void intervals_hold_the_truth_as_often_as_they_say(void **state)
{
    (void)state;
    const wt_shift_options options = with_floor(0.01);
    int inside1 = 0, inside2 = 0, inside_b = 0, inside_pole = 0;
    uint64_t noise = 73;
    for (int draw = 0; draw < 400; draw++) {
        double log_a[N], sigma[N] = {0.0};
        for (size_t i = 0; i < N; i++)
            log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]) + 0.01 * dma_normal(&noise);
        wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
        wt_wlf_fit fit;
        assert_int_equal(wt_wlf_fit_shifts(&master, options.floor, &fit, NULL), WT_OK);
        inside1 += fabs(fit.wlf.c1 - 8.1893) < 1.96 * fit.c1_error;
        inside2 += fabs(fit.wlf.c2 - 84.454) < 1.96 * fit.c2_error;
        inside_b += fabs(fit.b - 8.1893 * 84.454) < 1.96 * fit.b_error;
        inside_pole += fabs(fit.pole - 158.696) < 1.96 * fit.pole_error;
        wt_master_curve_clear(&master);
    }
    /* 95 % of 400 is 380 +- 4.4; errors that may only grow with scatter hold a little more. */
    assert_in_range(inside1, 368, 398);
    assert_in_range(inside2, 368, 398);
    assert_in_range(inside_b, 368, 398);
    assert_in_range(inside_pole, 368, 398);
}

/* Everything from the sweep on: noise in the moduli, shifts, law; 60 seeds, each vertical option.
 */
static void the_whole_way_from_noisy_moduli_is_honest(void **state)
{
    (void)state;
    for (int v = WT_VERTICAL_PHYSICAL; v <= WT_VERTICAL_FREE; v++) {
        wt_shift_options options = with_floor(0.0005);
        options.reference_temperature = 293.15;
        options.vertical = (wt_vertical_shift)v;
        int inside1 = 0, inside2 = 0;
        double square1 = 0.0, square2 = 0.0;
        for (uint64_t seed = 1; seed <= 60; seed++) {
            wt_sweep sweep = {0};
            dma_usual(&sweep, true, 0.01, 1000 * seed);
            wt_master_curve master = {0};
            wt_wlf_fit fit;
            assert_int_equal(wt_shift_fit(&sweep, &options, NULL, &master, NULL), WT_OK);
            assert_int_equal(wt_wlf_fit_shifts(&master, options.floor, &fit, NULL), WT_OK);
            const double z1 = (fit.wlf.c1 - 8.0) / fit.c1_error;
            const double z2 = (fit.wlf.c2 - 110.0) / fit.c2_error;
            inside1 += fabs(z1) < 1.96;
            inside2 += fabs(z2) < 1.96;
            square1 += z1 * z1;
            square2 += z2 * z2;
            wt_master_curve_clear(&master);
            wt_sweep_clear(&sweep);
        }
        assert_in_range(inside1, 52, 60);
        assert_in_range(inside2, 52, 60);
        /* and not by being far too wide */
        assert_near(sqrt(square1 / 60.0), 1.0, 0.35);
        assert_near(sqrt(square2 / 60.0), 1.0, 0.35);
    }
}

/* Cumulative shifts share their steps. Taking only the diagonal would claim to know the slope at
 * the reference too well. */
static void the_covariance_of_a_chain_counts(void **state)
{
    (void)state;
    double log_a[N], sigma[N];
    for (size_t i = 0; i < N; i++) {
        log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]);
        sigma[i] = 0.02 * sqrt(fabs((double)i - 2.0)); /* reference is the third */
    }
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    wt_wlf_fit diagonal, chain;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &diagonal, NULL), WT_OK);
    for (size_t i = 0; i < N; i++)
        for (size_t k = 0; k < N; k++) {
            const double from_i = (double)i - 2.0, from_k = (double)k - 2.0;
            master.covariance[i * N + k] =
                from_i * from_k > 0.0 ? 0.0004 * fmin(fabs(from_i), fabs(from_k)) : 0.0;
        }
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &chain, NULL), WT_OK);
    assert_near(chain.wlf.c1, 8.1893, 1e-6);
    assert_true(chain.slope_error > 1.2 * diagonal.slope_error);
    wt_master_curve_clear(&master);
}

static void undetermined_shifts_do_not_take_part(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    for (size_t i = 0; i < N; i++)
        log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]);
    log_a[5] = (double)NAN;
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    master.shifts[5].determined = false;
    for (size_t k = 0; k < N; k++)
        master.covariance[5 * N + k] = master.covariance[k * N + 5] = (double)NAN;
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
    assert_int_equal(fit.n, N - 1);
    assert_near(fit.wlf.c2, 84.454, 1e-6);
    for (size_t i = 0; i < 5; i++)
        master.shifts[i].determined = false;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, &err),
                     WT_E_MISSING);
    assert_non_null(strstr(err.found, "2 shifts"));
    wt_master_curve_clear(&master);
}

/* Data down to 2 K above the pole: the fit may not step over it. */
static void the_pole_is_not_crossed(void **state)
{
    (void)state;
    const wt_wlf steep = {293.15, 9.0, 42.0};
    static const double warm[] = {253.15, 258.15, 268.15, 278.15, 293.15, 313.15, 333.15};
    double log_a[7], sigma[7] = {0.0};
    for (size_t i = 0; i < 7; i++)
        log_a[i] = wt_wlf_log_shift(&steep, warm[i]);
    wt_master_curve master = shifts_only(warm, log_a, sigma, 7, 293.15);
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
    assert_near(fit.wlf.c1, 9.0, 1e-6);
    assert_near(fit.wlf.c2, 42.0, 1e-6);
    assert_true(fit.pole < warm[0]);
    wt_master_curve_clear(&master);
}

static void a_straight_line_has_only_a_slope(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    uint64_t noise = 79;
    for (size_t i = 0; i < N; i++)
        log_a[i] = -0.31 * (temperatures[i] - 243.15) + 0.02 * dma_normal(&noise);
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
    assert_true(fit.straight);
    assert_near_abs(fit.slope, -0.31, 3.0 * fit.slope_error);
    assert_true(fit.slope_error > 0.0 && fit.slope_error < 0.002);
    assert_near(fit.c1_error, (double)NAN, 0.0);
    assert_near(fit.c2_error, (double)NAN, 0.0);
    assert_near(fit.b_error, (double)NAN, 0.0);
    /* the constants still draw the line */
    assert_near_abs(wt_wlf_log_shift(&fit.wlf, 298.15), -0.31 * 55.0, 0.15);
    wt_master_curve_clear(&master);
}

/* A secondary process: below the transition the shifts follow 1/T, curving less than any WLF. */
static void arrhenius_shifts_are_recognised(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    uint64_t noise = 83;
    for (size_t i = 0; i < N; i++)
        log_a[i] =
            wt_arrhenius_log_shift(83e3, 243.15, temperatures[i]) + 0.003 * dma_normal(&noise);
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    wt_wlf_fit fit;
    const wt_shift_options options = with_floor(0.003);
    assert_int_equal(wt_wlf_fit_shifts(&master, options.floor, &fit, NULL), WT_OK);
    assert_near_abs(fit.activation_energy, 83e3, 3.0 * fit.activation_energy_error);
    assert_true(fit.activation_energy_error < 500.0);
    assert_true(fit.aicc_arrhenius < fit.aicc_wlf);
    wt_master_curve_clear(&master);
}

static void few_shifts_have_no_criterion(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    for (size_t i = 0; i < N; i++)
        log_a[i] = wt_wlf_log_shift(&polyisoprene, temperatures[i]);
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, 5, 243.15);
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
    assert_near(fit.aicc_wlf, (double)NAN, 0.0);
    wt_master_curve_clear(&master);
}

static void shifts_of_the_wrong_sign_are_refused(void **state)
{
    (void)state;
    double log_a[N], sigma[N] = {0.0};
    for (size_t i = 0; i < N; i++)
        log_a[i] = -wt_wlf_log_shift(&polyisoprene, temperatures[i]);
    wt_master_curve master = shifts_only(temperatures, log_a, sigma, N, 243.15);
    wt_wlf_fit fit = {.n = 99};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, &err), WT_E_RANGE);
    assert_int_equal(fit.n, 99);
    assert_non_null(strstr(err.message, "do not fall with temperature"));
    /* a reference in degrees Celsius among temperatures in kelvin */
    master.reference_temperature = -30.0;
    assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, &err), WT_E_RANGE);
    master.reference_temperature = 243.15;
    const wt_shift_options none = with_floor(0.0);
    assert_int_equal(wt_wlf_fit_shifts(&master, none.floor, &fit, &err), WT_E_RANGE);
    wt_master_curve_clear(&master);
}

/* A technician waits for nothing: 20 isotherms of 20 points, from the sweep to the law. */
static void twenty_isotherms_take_little_time(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 109;
    for (int i = 0; i < 20; i++)
        (void)dma_add(&sweep, &dma_rubber, 253.15 + 6.0 * i, 0.1, 100.0, 20, true, 0.01, &noise);
    double least = HUGE_VAL;
    for (int run = 0; run < 3; run++) {
        const double start = wt_time_cpu();
        wt_master_curve master = {0};
        wt_wlf_fit fit;
        assert_int_equal(wt_shift_fit(&sweep, NULL, NULL, &master, NULL), WT_OK);
        assert_int_equal(wt_wlf_fit_shifts(&master, wt_shift_defaults().floor, &fit, NULL), WT_OK);
        least = fmin(least, wt_time_cpu() - start);
        wt_master_curve_clear(&master);
    }
    print_message("20 isotherms of 20 points: %.1f ms\n", 1e3 * least);
    assert_true(least < 0.1);
    wt_sweep_clear(&sweep);
}

/* Shifts that scatter far more than their errors say: the error of the activation energy is that of
 * a straight line through them, with n - 2 degrees of freedom. */
static void the_error_follows_the_scatter(void **state)
{
    (void)state;
    const double energy = 100e3, reference = 263.15, per = 1.0 / (8.314462618 * log(10.0));
    double x[N], y[N], sigma[N], mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, rest = 0.0;
    for (size_t i = 0; i < N; i++) {
        sigma[i] = 0.01;
        x[i] = (1.0 / temperatures[i] - 1.0 / reference) * per;
        y[i] = energy * x[i] + (i % 2 == 0 ? 0.2 : -0.2);
        mean_x += x[i] / N;
        mean_y += y[i] / N;
    }
    for (size_t i = 0; i < N; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    for (size_t i = 0; i < N; i++) {
        double away = y[i] - mean_y - xy / xx * (x[i] - mean_x);
        rest += away * away;
    }
    wt_master_curve master = shifts_only(temperatures, y, sigma, N, reference);
    wt_wlf_fit fit;
    assert_int_equal(wt_wlf_fit_shifts(&master, 0.02, &fit, NULL), WT_OK);
    assert_near(fit.activation_energy, xy / xx, 1e-6);
    assert_near(fit.activation_energy_error, sqrt(rest / (N - 2) / xx), 1e-6);
    wt_master_curve_clear(&master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_follows_the_scatter),
        cmocka_unit_test(exact_shifts_give_the_constants_back),
        cmocka_unit_test(the_reference_isotherm_has_no_privilege),
        cmocka_unit_test(intervals_hold_the_truth_as_often_as_they_say),
        cmocka_unit_test(the_whole_way_from_noisy_moduli_is_honest),
        cmocka_unit_test(the_covariance_of_a_chain_counts),
        cmocka_unit_test(undetermined_shifts_do_not_take_part),
        cmocka_unit_test(the_pole_is_not_crossed),
        cmocka_unit_test(a_straight_line_has_only_a_slope),
        cmocka_unit_test(arrhenius_shifts_are_recognised),
        cmocka_unit_test(few_shifts_have_no_criterion),
        cmocka_unit_test(shifts_of_the_wrong_sign_are_refused),
        cmocka_unit_test(twenty_isotherms_take_little_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
