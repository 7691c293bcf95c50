/* Shift factors: known truth, every vertical option, and difficult sweeps (no overlap, no slope,
 * collinear shifts, bad points, unsorted data, repeated temperatures, a reference between
 * isotherms).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "weartrack/dma.h"

#include "dma/numerics/isotherm.h"
#include "dma_data.h"

static wt_master fit_good(const wt_sweep *sweep, const wt_master_options *options, wt_log *log)
{
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_master_fit(sweep, options, log, &master, &err) != WT_OK) {
        char text[1024];
        wt_error_format(&err, text, sizeof text);
        fail_msg("%s", text);
    }
    return master;
}

static wt_master_options at_reference(double kelvin, wt_vertical_shift vertical)
{
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = kelvin;
    options.vertical = vertical;
    return options;
}

static double truth_at(double temperature)
{
    return wt_wlf_log_shift(&dma_rubber.wlf, temperature);
}

static void known_truth_for_every_vertical_option(void **state)
{
    (void)state;
    static const wt_vertical_shift options[] = {WT_VERTICAL_NONE, WT_VERTICAL_PHYSICAL,
                                                WT_VERTICAL_FREE};
    for (size_t v = 0; v < 3; v++) {
        wt_sweep sweep = {0};
        dma_usual(&sweep, options[v] != WT_VERTICAL_NONE, 0.01, 17);
        const wt_master_options at = at_reference(293.15, options[v]);
        wt_master master = fit_good(&sweep, &at, NULL);
        assert_int_equal(master.n_shifts, 11);
        assert_int_equal(master.n, 11 * 16);
        assert_int_equal(master.superposition, WT_SUPERPOSITION_HOLDS);
        for (size_t i = 0; i < master.n_shifts; i++) {
            const wt_master_shift *shift = &master.shifts[i];
            assert_true(shift->determined);
            assert_near_abs(shift->log_a.value, truth_at(shift->temperature),
                            4.0 * shift->log_a.standard_error + 1e-12);
            assert_near_abs(shift->log_a.value, truth_at(shift->temperature), 0.06);
            assert_near(shift->log_b_physical, log10(293.15 / shift->temperature), 1e-12);
            if (options[v] == WT_VERTICAL_NONE)
                assert_near(shift->log_b.value, 0.0, 0.0);
            if (options[v] == WT_VERTICAL_PHYSICAL)
                assert_near(shift->log_b.value, shift->log_b_physical, 1e-12);
            if (options[v] == WT_VERTICAL_FREE)
                assert_near_abs(shift->log_b.value, shift->log_b_physical,
                                4.0 * shift->log_b.standard_error);
        }
        /* the reference isotherm is 0 by definition */
        assert_near(master.shifts[4].log_a.value, 0.0, 0.0);
        assert_near(master.shifts[4].log_a.standard_error, 0.0, 0.0);
        for (size_t k = 1; k < master.n; k++)
            assert_true(master.log_frequency[k] >= master.log_frequency[k - 1]);
        assert_near(master.noise_storage, 0.01, 0.15);
        assert_near(master.noise_loss, 0.01, 0.15);
        assert_near_abs(master.loss_factor, 0.0, 4.0 * master.loss_factor_error);
        wt_master_clear(&master);
        wt_sweep_clear(&sweep);
    }
}

/* Coverage of standard errors: the shifts of 40 noise seeds scatter as stated. */
static void standard_errors_match_the_scatter(void **state)
{
    (void)state;
    double square_a = 0.0, square_b = 0.0;
    size_t n = 0;
    for (uint64_t seed = 1; seed <= DRAW_COUNT(40); seed++) {
        wt_sweep sweep = {0};
        dma_usual(&sweep, true, 0.01, 1000 * seed);
        const wt_master_options at = at_reference(293.15, WT_VERTICAL_FREE);
        wt_master master = fit_good(&sweep, &at, NULL);
        for (size_t i = 0; i < master.n_shifts; i++) {
            const wt_master_shift *shift = &master.shifts[i];
            if (!(shift->log_a.standard_error > 0.0))
                continue;
            const double za =
                (shift->log_a.value - truth_at(shift->temperature)) / shift->log_a.standard_error;
            const double zb =
                (shift->log_b.value - shift->log_b_physical) / shift->log_b.standard_error;
            square_a += za * za;
            square_b += zb * zb;
            n++;
        }
        wt_master_clear(&master);
        wt_sweep_clear(&sweep);
    }
    if (!TEST_RATES)
        return;
    assert_int_equal(n, 400);
    assert_near(sqrt(square_a / (double)n), 1.0, 0.3);
    assert_near(sqrt(square_b / (double)n), 1.0, 0.3);
}

/* Descending frequencies and temperatures (cooling) change nothing. */
static void order_of_the_data_does_not_matter(void **state)
{
    (void)state;
    wt_sweep sweep = {0}, reversed = {0};
    dma_usual(&sweep, true, 0.01, 7);
    for (size_t i = sweep.n_isotherms; i-- > 0;) {
        const wt_isotherm *from = &sweep.isotherms[i];
        wt_isotherm *to = wt_sweep_add(&reversed, from->n, 0);
        to->temperature = from->temperature;
        for (size_t k = 0; k < from->n; k++) {
            to->angular_frequency[k] = from->angular_frequency[from->n - 1 - k];
            to->storage_modulus[k] = from->storage_modulus[from->n - 1 - k];
            to->loss_modulus[k] = from->loss_modulus[from->n - 1 - k];
        }
    }
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_FREE);
    wt_master a = fit_good(&sweep, &at, NULL), b = fit_good(&reversed, &at, NULL);
    for (size_t i = 0; i < a.n_shifts; i++) {
        assert_near(b.shifts[i].temperature, a.shifts[i].temperature, 0.0);
        assert_near(b.shifts[i].log_a.value, a.shifts[i].log_a.value, 0.0);
        assert_near(b.shifts[i].log_b.value, a.shifts[i].log_b.value, 0.0);
    }
    wt_master_clear(&a);
    wt_master_clear(&b);
    wt_sweep_clear(&sweep);
    wt_sweep_clear(&reversed);
}

static void an_isotherm_without_overlap_has_no_shift(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 3;
    for (int i = 0; i <= 3; i++)
        (void)dma_add(&sweep, &dma_rubber, 283.15 + 10.0 * i, 1.0, 30.0, 12, true, 0.005, &noise);
    (void)dma_add(&sweep, &dma_rubber, 243.15, 1.0, 30.0, 12, true, 0.005, &noise);
    wt_sweep_sort(&sweep);
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_FREE);
    wt_log *log = wt_log_new();
    wt_master master = fit_good(&sweep, &at, log);
    assert_false(master.shifts[0].determined);
    assert_near(master.shifts[0].log_a.value, (double)NAN, 0.0);
    assert_near(master.shifts[0].log_a.standard_error, (double)NAN, 0.0);
    assert_near(master.shifts[0].log_b.value, (double)NAN, 0.0);
    assert_non_null(strstr(master.shifts[0].note, "no overlap"));
    assert_near(master.shifts[0].overlap, 0.0, 0.0);
    assert_true(wt_log_count(log) > 0);
    for (size_t i = 1; i < 5; i++)
        assert_true(master.shifts[i].determined);
    assert_int_equal(master.n, 4 * 12); /* its points are not in the master curve */
    for (size_t k = 0; k < master.n; k++)
        assert_int_not_equal(master.isotherm[k], 0);
    wt_log_free(log);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void no_overlap_at_all_is_an_error(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 3;
    (void)dma_add(&sweep, &dma_rubber, 253.15, 1.0, 10.0, 12, true, 0.005, &noise);
    (void)dma_add(&sweep, &dma_rubber, 293.15, 1.0, 10.0, 12, true, 0.005, &noise);
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_FREE);
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_master_fit(&sweep, &at, NULL, &master, &err), WT_E_NO_OVERLAP);
    assert_non_null(strstr(err.message, "20.00 °C"));
    assert_null(master.shifts);
    wt_sweep_clear(&sweep);
}

/* A network far above its transition: the shift has no more than the scatter of clamping. */
static void a_plateau_without_slope_decides_nothing(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 12;
    for (int i = 0; i < 3; i++) {
        wt_isotherm *isotherm = wt_sweep_add(&sweep, 15, 0);
        isotherm->temperature = 330.0 + 10.0 * i;
        for (size_t k = 0; k < isotherm->n; k++) {
            const double w = pow(10.0, 0.2 * (double)k - 1.0), rise = pow(w, 0.002);
            isotherm->angular_frequency[k] = w;
            isotherm->storage_modulus[k] = 1e6 * rise * exp(0.003 * dma_normal(&noise));
            isotherm->loss_modulus[k] =
                1e6 * tan(0.002 * M_PI / 2) * rise * exp(0.003 * dma_normal(&noise));
        }
    }
    const wt_master_options at = at_reference(330.0, WT_VERTICAL_TIED);
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_master_fit(&sweep, &at, NULL, &master, &err), WT_E_NO_OVERLAP);
    assert_non_null(strstr(err.message, "flat"));
    wt_sweep_clear(&sweep);
}

/* E' on a plateau, E'' still with a slope: E'' decides (polyisoprene melts, warm networks). */
static void loss_decides_on_the_storage_plateau(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 13;
    const double step = 0.41;
    for (int i = 0; i < 4; i++) {
        wt_isotherm *isotherm = wt_sweep_add(&sweep, 16, 0);
        isotherm->temperature = 330.0 + 10.0 * i;
        for (size_t k = 0; k < isotherm->n; k++) {
            const double x = 0.2 * (double)k - 1.0;
            const double y = x - step * i;
            isotherm->angular_frequency[k] = pow(10.0, x);
            isotherm->storage_modulus[k] =
                1e6 * (1.0 + 0.02 * pow(10.0, 0.3 * y)) * exp(0.003 * dma_normal(&noise));
            isotherm->loss_modulus[k] = 3e4 * (pow(10.0, 0.4 * y) + 0.1 * pow(10.0, -0.3 * y)) *
                                        exp(0.003 * dma_normal(&noise));
        }
    }
    const wt_master_options at = at_reference(330.0, WT_VERTICAL_FREE);
    wt_master master = fit_good(&sweep, &at, NULL);
    for (size_t i = 0; i < 4; i++) {
        assert_true(master.shifts[i].determined);
        assert_near_abs(master.shifts[i].log_a.value, -step * (double)i, 0.05);
    }
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

/* E', E'' ~ w^0.05: a horizontal shift a is equivalent to a vertical one of 0.05 a. */
static void on_a_power_law_both_shifts_are_one(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 19;
    for (int i = 0; i < 4; i++) {
        wt_isotherm *isotherm = wt_sweep_add(&sweep, 20, 0);
        isotherm->temperature = 300.0 + 10.0 * i;
        for (size_t k = 0; k < isotherm->n; k++) {
            const double x = 0.15 * (double)k - 1.0;
            isotherm->angular_frequency[k] = pow(10.0, x);
            isotherm->storage_modulus[k] =
                5e6 * pow(10.0, 0.05 * (x - 0.5 * i)) * exp(0.0005 * dma_normal(&noise));
            isotherm->loss_modulus[k] = 5e6 * tan(0.05 * M_PI / 2) *
                                        pow(10.0, 0.05 * (x - 0.5 * i)) *
                                        exp(0.0005 * dma_normal(&noise));
        }
    }
    wt_master_options at = at_reference(300.0, WT_VERTICAL_FREE);
    wt_master master = {0};
    /* Free vertical shifts leave the horizontal ones open, by more than the 0.05 below. */
    if (wt_master_fit(&sweep, &at, NULL, &master, NULL) == WT_OK)
        for (size_t i = 0; i < master.n_shifts; i++)
            assert_true(!master.shifts[i].determined ||
                        master.shifts[i].log_a.standard_error > 0.05);
    wt_master_clear(&master);
    /* With a known vertical shift there is no ambiguity. */
    at.vertical = WT_VERTICAL_NONE;
    master = fit_good(&sweep, &at, NULL);
    for (size_t i = 1; i < 4; i++) {
        assert_true(master.shifts[i].determined);
        assert_near_abs(master.shifts[i].log_a.value, -0.5 * (double)i, 0.05);
    }
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void points_without_positive_modulus_are_left_out_and_named(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 23);
    sweep.isotherms[0].loss_modulus[15] = -1.2e6; /* compliance of the machine */
    sweep.isotherms[0].loss_modulus[14] = 0.0;
    sweep.isotherms[3].storage_modulus[2] = (double)NAN;
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_log *log = wt_log_new();
    wt_master master = fit_good(&sweep, &at, log);
    assert_int_equal(master.n, 11 * 16 - 3);
    assert_true(wt_log_count(log) >= 2);
    assert_non_null(strstr(wt_log_get(log, 0).text, "2 of 16 points left out"));
    assert_non_null(strstr(wt_log_get(log, 0).text, "loss 0 Pa"));
    assert_non_null(strstr(wt_log_get(log, 1).text, "1 of 16 points left out"));
    assert_null(strstr(wt_log_get(log, 1).text, "nan"));
    assert_non_null(strstr(master.shifts[0].note, "2 points"));
    for (size_t i = 0; i < master.n_shifts; i++)
        assert_near_abs(master.shifts[i].log_a.value, truth_at(master.shifts[i].temperature), 0.05);
    wt_master_clear(&master);

    for (size_t k = 0; k < 14; k++)
        sweep.isotherms[5].loss_modulus[k] = -1.0;
    master = fit_good(&sweep, &at, log); /* one isotherm less does not invalidate the others */
    assert_int_equal(master.n, 10 * 16 - 3);
    assert_false(master.shifts[5].determined);
    assert_non_null(strstr(master.shifts[5].note, "14 of 16 points have no positive modulus"));
    for (size_t i = 0; i < master.n_shifts; i++)
        if (i != 5)
            assert_near_abs(master.shifts[i].log_a.value, truth_at(master.shifts[i].temperature),
                            0.05);
    wt_master_clear(&master);

    const size_t n = sweep.n_isotherms;
    sweep.n_isotherms = 2; /* two isotherms would leave nothing */
    for (size_t k = 0; k < 14; k++)
        sweep.isotherms[1].loss_modulus[k] = -1.0;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_master_fit(&sweep, &at, log, &master, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "-10.00 °C"));
    assert_non_null(strstr(err.place, "synthetic 263.15 K"));
    assert_null(master.shifts);
    sweep.n_isotherms = n;
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

/* 50 Hz interference and a first point that was not in equilibrium. */
static void single_bad_points_have_little_weight(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 29);
    for (size_t i = 0; i < sweep.n_isotherms; i++)
        sweep.isotherms[i].loss_modulus[0] *= 1.25;
    sweep.isotherms[6].storage_modulus[9] *= 1.6;
    sweep.isotherms[6].loss_modulus[9] *= 3.0;
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_master master = fit_good(&sweep, &at, NULL);
    for (size_t i = 0; i < master.n_shifts; i++)
        assert_near_abs(master.shifts[i].log_a.value, truth_at(master.shifts[i].temperature), 0.05);
    assert_non_null(strstr(master.shifts[6].note, "off the curve"));
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void repeated_temperatures_get_one_shift(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 31;
    dma_usual(&sweep, true, 0.01, 31);
    wt_isotherm *again = dma_add(&sweep, &dma_rubber, 303.15, 0.05, 80.0, 20, true, 0.01, &noise);
    snprintf(again->source, sizeof again->source, "second run");
    wt_sweep_sort(&sweep);
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_master master = fit_good(&sweep, &at, NULL);
    assert_int_equal(master.n_shifts, 12);
    assert_near_abs(master.shifts[6].log_a.value, master.shifts[5].log_a.value, 0.01);
    assert_string_equal(master.shifts[6].note, "");
    wt_master_clear(&master);

    /* The second run was off by 5 K: reported, not averaged. */
    for (size_t i = 0; i < sweep.n_isotherms; i++)
        if (strcmp(sweep.isotherms[i].source, "second run") == 0)
            for (size_t k = 0; k < sweep.isotherms[i].n; k++)
                sweep.isotherms[i].angular_frequency[k] *= pow(10.0, 0.3);
    master = fit_good(&sweep, &at, NULL);
    assert_non_null(strstr(master.shifts[6].note, "from the other run at this temperature"));
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void the_reference_temperature_need_not_be_measured(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 37);
    static const double asked[] = {297.3, 290.0, 256.4, 351.0, 251.0};
    for (size_t r = 0; r < sizeof asked / sizeof *asked; r++) {
        for (int v = WT_VERTICAL_PHYSICAL; v <= WT_VERTICAL_FREE; v++) {
            const wt_master_options at = at_reference(asked[r], (wt_vertical_shift)v);
            wt_master master = fit_good(&sweep, &at, NULL);
            const wt_wlf law = dma_moved(dma_rubber.wlf, asked[r]);
            assert_near(master.reference_temperature, asked[r], 0.0);
            for (size_t i = 0; i < master.n_shifts; i++) {
                const wt_master_shift *shift = &master.shifts[i];
                assert_near_abs(shift->log_a.value, wt_wlf_log_shift(&law, shift->temperature),
                                0.07);
                assert_near_abs(shift->log_b.value, log10(asked[r] / shift->temperature), 0.025);
                assert_true(shift->log_a.standard_error > 0.0);
            }
            wt_master_clear(&master);
        }
    }
    wt_master_options far = at_reference(180.0, WT_VERTICAL_PHYSICAL);
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_master_fit(&sweep, &far, NULL, &master, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "-93.15 °C"));
    /* Without a stated one: the isotherm in the middle. */
    far = wt_master_options_defaults();
    master = fit_good(&sweep, &far, NULL);
    assert_near(master.reference_temperature, 303.15, 0.0);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

/* A law other than WLF: the shifts have an additional hump. */
static double humped_law(double temperature)
{
    const double away = (temperature - 305.0) / 12.0;
    return truth_at(temperature) + 0.8 * exp(-away * away);
}

/* Largest difference of two results between isotherms, except for a constant [decade]. */
static double spread_between(const wt_master *m, const wt_master *other)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < m->n_shifts; i++) {
        const double off = m->shifts[i].log_a.value - other->shifts[i].log_a.value;
        low = fmin(low, off);
        high = fmax(high, off);
    }
    return high - low;
}

static void a_moved_reference_moves_all_shifts_alike(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t seed = 5;
    for (int i = 0; i <= 20; i++) {
        const double temperature = 253.15 + 5.0 * i;
        wt_isotherm *const one =
            dma_add(&sweep, &dma_rubber, temperature, 0.1, 100.0, 16, false, 0.005, &seed);
        const double hump = humped_law(temperature) - truth_at(temperature);
        for (size_t k = 0; k < one->n; k++)
            one->angular_frequency[k] *= pow(10.0, -hump);
    }
    wt_master_options options = at_reference(303.15, WT_VERTICAL_NONE);
    wt_master base = fit_good(&sweep, &options, NULL);
    assert_true(base.law_rms > 0.08); /* the law alone does not describe the shifts */
    double before = 0.0;
    for (double t = 255.65; t <= 350.15; t += t < 290.0 || t > 315.0 ? 12.5 : 1.25) {
        options.reference_temperature = t;
        wt_master m = fit_good(&sweep, &options, NULL);
        assert_true(spread_between(&m, &base) < 0.05);
        assert_near_abs(m.shifts[10].log_a.value, humped_law(303.15) - humped_law(t), 0.06);
        assert_true(m.shifts[10].log_a.low <= humped_law(303.15) - humped_law(t) &&
                    m.shifts[10].log_a.high >= humped_law(303.15) - humped_law(t));
        assert_true(m.shifts[10].log_a.value > before || t < 290.0 || before == 0.0);
        before = m.shifts[10].log_a.value;
        wt_master_clear(&m);
    }
    /* continuous at an isotherm: two references, 0.2 K to either side */
    for (int i = 1; i < 20; i += 3) {
        const double at = 253.15 + 5.0 * i;
        double own[2], position[2];
        for (int side = 0; side < 2; side++) {
            options.reference_temperature = at + (side == 0 ? -0.2 : 0.2);
            wt_master m = fit_good(&sweep, &options, NULL);
            own[side] = m.shifts[i].log_a.value;
            position[side] = m.shifts[i].log_a.standard_error;
            wt_master_clear(&m);
        }
        assert_near_abs(own[0], humped_law(at) - humped_law(at - 0.2), 0.012);
        assert_near_abs(own[1], humped_law(at) - humped_law(at + 0.2), 0.012);
        assert_true(position[0] < 0.03 && position[1] < 0.03);
    }
    wt_master_clear(&base);
    wt_sweep_clear(&sweep);
}

static void thermal_expansion_enters_the_physical_shift(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 41);
    wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    at.expansion = 6e-4;
    wt_master master = fit_good(&sweep, &at, NULL);
    const double t = master.shifts[10].temperature;
    assert_near(master.shifts[10].log_b.value, log10(293.15 / t) + 6e-4 * (t - 293.15) / log(10.0),
                1e-12);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

/* A second relaxation with another temperature dependence, in E'' only. */
static double linear_congruential(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

static double small_noise(uint64_t *state, double size)
{
    const double radius = sqrt(-2.0 * log(linear_congruential(state)));
    return exp(size * radius * cos(2.0 * M_PI * linear_congruential(state)));
}

/* With these draws the errors of the vertical shifts between neighbours add up to decades. */
static void a_thousand_isotherms_are_joined(void **state)
{
    (void)state;
    enum { N = 1000, POINTS = 13 };
    const wt_wlf law = {293.15, 8.5, 130.0};
    wt_sweep sweep = {0};
    uint64_t seed = 77;
    for (int i = 0; i < N; i++) {
        wt_isotherm *isotherm = wt_sweep_add(&sweep, POINTS, 0);
        assert_non_null(isotherm);
        isotherm->temperature = 253.15 + 80.0 * i / N;
        const double log_a = wt_wlf_log_shift(&law, isotherm->temperature);
        for (int k = 0; k < POINTS; k++) {
            const double w = 0.1 * pow(10.0, 0.25 * k);
            double storage = 1e6, loss = 0.0;
            for (int term = 0; term < 56; term++) {
                const double place = 0.25 * term, z = w * pow(10.0, log_a + 2.0 - place),
                             modulus = 2.5e5 * pow(10.0, 0.22 * place);
                storage += modulus * z * z / (1.0 + z * z);
                loss += modulus * z / (1.0 + z * z);
            }
            isotherm->angular_frequency[k] = w;
            isotherm->storage_modulus[k] = storage * small_noise(&seed, 0.005);
            isotherm->loss_modulus[k] = loss * small_noise(&seed, 0.01);
        }
    }
    wt_sweep_sort(&sweep);
    wt_master_options at = at_reference(293.15, WT_VERTICAL_TIED);
    at.series_only = at.skip_fitted_moduli = true;
    wt_master master = fit_good(&sweep, &at, NULL);
    for (size_t i = 0; i < master.n_shifts; i++) {
        const wt_master_shift *shift = &master.shifts[i];
        assert_true(shift->determined);
        assert_near_abs(shift->log_a.value, wt_wlf_log_shift(&law, shift->temperature), 0.3);
    }
    assert_near_abs(master.c1.value, law.c1, 4.0 * master.c1.standard_error);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void failed_superposition_is_reported(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.005, 43);
    wt_sweep other = {0};
    dma_truth shifted = dma_rubber;
    shifted.wlf.c1 = 4.0;
    uint64_t noise = 47;
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        wt_isotherm *wrong = dma_add(&other, &shifted, sweep.isotherms[i].temperature, 0.1, 100.0,
                                     16, true, 0.005, &noise);
        memcpy(sweep.isotherms[i].loss_modulus, wrong->loss_modulus,
               16 * sizeof *wrong->loss_modulus);
    }
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_log *log = wt_log_new();
    wt_master master = fit_good(&sweep, &at, log);
    assert_int_equal(master.superposition, WT_SUPERPOSITION_FAILS);
    assert_true(wt_log_count(log) > 0);
    wt_log_free(log);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
    wt_sweep_clear(&other);
}

static void mixed_strain_amplitudes_are_reported(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 53);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        sweep.isotherms[i].strain = calloc(sweep.isotherms[i].n, sizeof(double));
        for (size_t k = 0; k < sweep.isotherms[i].n; k++)
            sweep.isotherms[i].strain[k] = i < 3 ? 7e-5 : 5e-2;
    }
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_log *log = wt_log_new();
    wt_master master = fit_good(&sweep, &at, log);
    bool said = false;
    for (size_t i = 0; i < wt_log_count(log); i++)
        said = said || strstr(wt_log_get(log, i).text, "amplitudes from 0.007 % to 5 %");
    assert_true(said);
    wt_log_free(log);
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

static void expect_failure(const wt_sweep *sweep, const wt_master_options *options,
                           wt_status expected)
{
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_master_fit(sweep, options, NULL, &master, &err), expected);
    assert_int_equal(err.status, expected);
    assert_true(err.message[0] != '\0');
    assert_null(master.shifts);
}

/* One sharp process per decade: the positions of the spectrum terms do not attract the isotherms,
 * for lines at or between them. */
static void spectral_lines_do_not_bias_shifts(void **state)
{
    (void)state;
    static const double phase[] = {0.0, 0.6, 0.0}, scatter[] = {0.005, 0.005, 0.03};
    for (size_t p = 0; p < 3; p++) {
        wt_sweep sweep = {0};
        uint64_t noise = 71 + p;
        for (int i = -6; i <= 5; i++) {
            wt_isotherm *iso = wt_sweep_add(&sweep, 16, 0);
            iso->temperature = 293.15 + 5.0 * i;
            for (size_t k = 0; k < iso->n; k++) {
                const double omega = pow(10.0, -1.0 + 0.2 * (double)k);
                const double reduced = omega * pow(10.0, truth_at(iso->temperature));
                double storage = 1e6, loss = 0.0;
                for (int line = 0; line < 14; line++) {
                    const double z = reduced * pow(10.0, 2.0 + phase[p] - line);
                    const double share = 1e6 * pow(10.0, 0.22 * line) * z / (1.0 + z * z);
                    storage += share * z;
                    loss += share;
                }
                iso->angular_frequency[k] = omega;
                iso->storage_modulus[k] = storage * (1.0 + scatter[p] * dma_normal(&noise));
                iso->loss_modulus[k] = loss * (1.0 + scatter[p] * dma_normal(&noise));
            }
        }
        const wt_master_options at = at_reference(293.15, WT_VERTICAL_NONE);
        wt_log *log = wt_log_new();
        wt_master master = fit_good(&sweep, &at, log);
        bool named = false;
        for (size_t i = 0; i < wt_log_count(log); i++)
            named = named || strstr(wt_log_get(log, i).text, "few sharp lines") != NULL;
        assert_true(named);
        wt_log_free(log);
        double square = 0.0;
        for (size_t i = 0; i < master.n_shifts; i++) {
            const wt_interval a = master.shifts[i].log_a;
            if (a.standard_error > 0.0)
                square += pow((a.value - truth_at(master.shifts[i].temperature)) / a.standard_error,
                              2.0) /
                          8.0;
        }
        assert_true(square < 4.0); /* the p value is 1e-5; with three terms a decade 160 */
        wt_master_clear(&master);
        wt_sweep_clear(&sweep);
    }
}

static void impossible_input_is_refused(void **state)
{
    (void)state;
    wt_sweep empty = {0};
    const wt_master_options any = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_master none_made = {0};
    wt_error err = WT_ERROR_INIT;
    expect_failure(&empty, &any, WT_E_MISSING);
    assert_int_equal(wt_master_fit(&empty, &any, NULL, &none_made, &err), WT_E_MISSING);
    assert_string_equal(err.message, "a master curve needs an isotherm with points");
    assert_string_equal(err.found, "0 isotherms, 0 points");
    for (int i = 0; i < 2; i++) { /* isotherms without a point */
        wt_isotherm *none = wt_sweep_add(&empty, 0, 0);
        assert_non_null(none);
        none->temperature = 290 + 10 * i;
        expect_failure(&empty, &any, WT_E_MISSING);
    }
    wt_sweep_clear(&empty);
    wt_sweep sweep = {0};
    uint64_t noise = 59;
    wt_master_options at = at_reference(293.15, WT_VERTICAL_FREE);
    expect_failure(&sweep, &at, WT_E_MISSING);
    (void)dma_add(&sweep, &dma_rubber, 293.15, 0.1, 100.0, 16, true, 0.01, &noise);
    at.reference_temperature = 310.0; /* no law applies to one isotherm there */
    expect_failure(&sweep, &at, WT_E_RANGE);
    at.reference_temperature = 293.15;
    (void)dma_add(&sweep, &dma_rubber, 303.15, 0.1, 100.0, 16, true, 0.01, &noise);
    at.reference_temperature = -30.0; /* degrees Celsius */
    expect_failure(&sweep, &at, WT_E_RANGE);
    at = at_reference(293.15, WT_VERTICAL_FREE);
    at.terms_per_decade = 0.0;
    expect_failure(&sweep, &at, WT_E_RANGE);
    at = at_reference(293.15, WT_VERTICAL_FREE);
    sweep.isotherms[1].temperature = -10.0;
    expect_failure(&sweep, &at, WT_E_RANGE);
    sweep.isotherms[1].temperature = 0.0;
    expect_failure(&sweep, &at, WT_E_RANGE);
    sweep.isotherms[1].temperature = (double)NAN;
    expect_failure(&sweep, &at, WT_E_RANGE);
    wt_sweep_clear(&sweep);
    wt_master_clear(NULL);
}

static void isotherms_of_few_points_are_left_out(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    uint64_t noise = 61;
    dma_usual(&sweep, true, 0.01, 61);
    (void)dma_add(&sweep, &dma_rubber, 298.15, 0.1, 100.0, 3, true, 0.01, &noise);
    (void)dma_add(&sweep, &dma_rubber, 308.15, 0.1, 100.0, 0, true, 0.01, &noise);
    wt_sweep_sort(&sweep);
    const wt_master_options at = at_reference(293.15, WT_VERTICAL_PHYSICAL);
    wt_master master = fit_good(&sweep, &at, NULL);
    assert_int_equal(master.n_shifts, 13);
    for (size_t i = 0; i < master.n_shifts; i++) {
        const bool whole = fmod(master.shifts[i].temperature - 253.15 + 0.5, 10.0) < 1.0;
        assert_int_equal(master.shifts[i].determined, whole);
        if (!whole)
            assert_non_null(strstr(master.shifts[i].note, "points"));
    }
    wt_master_clear(&master);
    wt_sweep_clear(&sweep);
}

/* Lines a decade apart, from the storage modulus alone: nothing is known between them, but there is
 * a spectrum. Many points of an isotherm give the same result as few. */
static void lines_at_six_temperatures(wt_sweep *sweep, size_t points, double scatter)
{
    uint64_t noise = 5;
    const wt_wlf law = {293.15, 8.18, 110.0};
    for (int i = 0; i < 6; i++) {
        wt_isotherm *t = wt_sweep_add(sweep, points, 0);
        t->temperature = 263.15 + 10.0 * i;
        const double a = pow(10.0, wt_wlf_log_shift(&law, t->temperature));
        for (size_t k = 0; k < points; k++) {
            const double w = pow(10.0, 3.0 * (double)k / (double)(points - 1));
            double storage = 1e6, loss = 0.0;
            for (int j = 0; j < 3; j++) {
                const double z = w * a * pow(10.0, j - 3.0), e = 1e8 * pow(10.0, -0.3 * j);
                storage += e * z * z / (1.0 + z * z);
                loss += e * z / (1.0 + z * z);
            }
            t->angular_frequency[k] = w;
            t->storage_modulus[k] = storage * exp(scatter * dma_normal(&noise));
            t->loss_modulus[k] = loss * exp(scatter * dma_normal(&noise));
        }
    }
}

static void storage_alone_finds_a_spectrum_of_lines(void **state)
{
    (void)state;
    static const double scatter[] = {0.0, 1e-3};
    for (size_t i = 0; i < 2; i++) {
        wt_sweep sweep = {0};
        lines_at_six_temperatures(&sweep, 13, scatter[i]);
        wt_master_options by_storage = at_reference(293.15, WT_VERTICAL_NONE);
        by_storage.shift_by = WT_SHIFT_STORAGE;
        wt_master m = fit_good(&sweep, &by_storage, NULL);
        assert_near_abs(m.shifts[0].log_a.value, 8.18 * 30.0 / 80.0, 0.05);
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
}

static void many_points_give_the_result_of_few(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    lines_at_six_temperatures(&sweep, 3001, 0.02);
    const wt_master_options tied = at_reference(293.15, WT_VERTICAL_NONE);
    wt_master m = fit_good(&sweep, &tied, NULL);
    assert_true(m.n < 6 * 50);
    for (size_t i = 0; i < m.n_shifts; i++) {
        const double t = m.shifts[i].temperature - 293.15;
        assert_true(m.shifts[i].determined);
        assert_near_abs(m.shifts[i].log_a.value, -8.18 * t / (110.0 + t), 0.01);
    }
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

/* Number of points of an isotherm over 3 decades, measured at `near` frequencies 0.005 decade apart
 * at each of 31 steps of a tenth. */
static size_t points_of(size_t near)
{
    enum { STEPS = 31 };
    wt_sweep sweep = {0};
    shift_set set = {0};
    arena memory = {0};
    wt_error err = WT_ERROR_INIT;
    const wt_master_options options = wt_master_options_defaults();
    wt_isotherm *t = wt_sweep_add(&sweep, STEPS * near, 0);
    assert_non_null(t);
    t->temperature = 293.15;
    for (size_t k = 0; k < t->n; k++) {
        t->angular_frequency[k] =
            pow(10, 0.1 * (double)(k / near) + 0.005 * (double)(k % near) - 1);
        t->storage_modulus[k] = 1e6 * pow(t->angular_frequency[k], 0.2);
        t->loss_modulus[k] = 3e5 * pow(t->angular_frequency[k], 0.2);
    }
    if (shift_set_new(&sweep, &options, NULL, &memory, &set, &err) != WT_OK)
        fail_msg("%s", err.message);
    const size_t n = set.curves[0].n;
    assert_int_equal(set.curves[0].n_merged, n < t->n ? t->n : 0);
    arena_free(&memory);
    wt_sweep_clear(&sweep);
    return n;
}

/* Neighbouring points are merged if there are five for each remaining one, because their distances
 * are uneven. */
static void dense_points_are_merged(void **state)
{
    (void)state;
    assert_int_equal(points_of(2), 62);
    assert_int_equal(points_of(4), 124);
    assert_int_equal(points_of(5), 31);
    assert_int_equal(points_of(9), 31);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_truth_for_every_vertical_option),
        cmocka_unit_test(standard_errors_match_the_scatter),
        cmocka_unit_test(order_of_the_data_does_not_matter),
        cmocka_unit_test(an_isotherm_without_overlap_has_no_shift),
        cmocka_unit_test(no_overlap_at_all_is_an_error),
        cmocka_unit_test(a_plateau_without_slope_decides_nothing),
        cmocka_unit_test(loss_decides_on_the_storage_plateau),
        cmocka_unit_test(storage_alone_finds_a_spectrum_of_lines),
        cmocka_unit_test(many_points_give_the_result_of_few),
        cmocka_unit_test(on_a_power_law_both_shifts_are_one),
        cmocka_unit_test(points_without_positive_modulus_are_left_out_and_named),
        cmocka_unit_test(single_bad_points_have_little_weight),
        cmocka_unit_test(repeated_temperatures_get_one_shift),
        cmocka_unit_test(the_reference_temperature_need_not_be_measured),
        cmocka_unit_test(a_moved_reference_moves_all_shifts_alike),
        cmocka_unit_test(thermal_expansion_enters_the_physical_shift),
        cmocka_unit_test(a_thousand_isotherms_are_joined),
        cmocka_unit_test(failed_superposition_is_reported),
        cmocka_unit_test(mixed_strain_amplitudes_are_reported),
        cmocka_unit_test(dense_points_are_merged),
        cmocka_unit_test(spectral_lines_do_not_bias_shifts),
        cmocka_unit_test(impossible_input_is_refused),
        cmocka_unit_test(isotherms_of_few_points_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
