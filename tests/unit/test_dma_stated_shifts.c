/* Excluded parts of sweeps, shifts from a law or a table, and results from one modulus alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "dma/master.h"
#include "dma/sweep_input.h"

#include "dma_data.h"

static const double noise = 0.005;

static wt_master_options options(wt_shift_quantity by)
{
    wt_master_options o = wt_master_options_defaults();
    o.reference_temperature = 293.15;
    o.shift_by = by;
    return o;
}

/* Moduli every tenth of a kelvin at one frequency, and nothing else. */
static void heat(wt_sweep *sweep, double omega, size_t n, uint64_t *state)
{
    wt_ramp *ramp = wt_sweep_add_ramp(sweep, n, 0);
    assert_non_null(ramp);
    ramp->angular_frequency = omega;
    for (size_t k = 0; k < n; k++) {
        const double t = 253.15 + 100.0 * (double)k / (double)n;
        double *storage = &ramp->storage_modulus[k], *loss = &ramp->loss_modulus[k];
        ramp->temperature[k] = t;
        dma_moduli(&dma_rubber, omega * pow(10, wt_wlf_log_shift(&dma_rubber.wlf, t)), storage,
                   loss);
        *storage *= t / 293.15 * exp(noise * dma_normal(state));
        *loss *= t / 293.15 * exp(noise * dma_normal(state));
    }
}

static void excluded_by_temperature_and_frequency(void **unused)
{
    static const char *const texts[] = {"temperature:..-5degC", "temperature:30degC",
                                        "frequency:10Hz.."};
    wt_sweep sweep = {0};
    uint64_t state = 1;
    (void)unused;
    dma_usual(&sweep, true, 0, 1); /* -20 to 80 degC; 0.1 to 100 rad/s in 16 points */
    heat(&sweep, 2 * M_PI, 100, &state);
    heat(&sweep, 20 * M_PI * 1.001, 100, &state);
    assert_int_equal(flow_sweep_exclude(texts, 3, &sweep, NULL, NULL), WT_OK);
    assert_int_equal(sweep.n_isotherms, 8);
    assert_near_abs(sweep.isotherms[0].temperature, 273.15, 1e-9);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        const wt_isotherm *t = &sweep.isotherms[i];
        assert_true(fabs(t->temperature - 303.15) > 1);
        assert_int_equal(t->n, 14);
        assert_true(t->angular_frequency[t->n - 1] < 20 * M_PI);
    }
    assert_int_equal(sweep.n_ramps, 1);
    assert_near_abs(sweep.ramps[0].angular_frequency, 2 * M_PI, 1e-9);
    for (size_t k = 0; k < sweep.ramps[0].n; k++) /* 15 at colder temperatures, 11 at 30 degC */
        assert_true(sweep.ramps[0].temperature[k] > 268.15 &&
                    fabs(sweep.ramps[0].temperature[k] - 303.15) > 0.5);
    assert_in_range(sweep.ramps[0].n, 80, 84);
    wt_sweep_clear(&sweep);
}

static void invalid_exclusions(void **unused)
{
    static const char *const bad[] = {
        "temperature",           "temperature:", "temperature:..",
        "frequency:5K..",        "strain:1..2",  "temperature:30degC..20degC",
        "temperature:20degC..x", ":20degC"};
    (void)unused;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        wt_sweep sweep = {0};
        wt_error err = WT_ERROR_INIT;
        dma_usual(&sweep, true, 0, 1);
        assert_int_not_equal(flow_sweep_exclude(&bad[i], 1, &sweep, NULL, &err), WT_OK);
        assert_int_not_equal(flow_exclusions_check(&bad[i], 1, &err), WT_OK);
        assert_int_equal(sweep.n_isotherms, 11);
        wt_sweep_clear(&sweep);
    }
}

/* One frequency with a law: the moduli at the reference; without the law there is no result. */
static void one_frequency_by_a_law(void **unused)
{
    enum { DRAWS = 12, PLACES = 9 };
    const wt_shift_law law = {.kind = WT_LAW_WLF, .wlf = dma_rubber.wlf};
    const wt_master_options o = options(WT_SHIFT_MODULI);
    size_t held = 0;
    (void)unused;
    for (uint64_t draw = 1; draw <= DRAWS; draw++) {
        wt_sweep sweep = {0};
        wt_master m = {0};
        uint64_t state = draw;
        heat(&sweep, 2 * M_PI, 400, &state);
        assert_int_equal(flow_ramps_fit(&sweep, &o, &law, NULL, &m, NULL), WT_OK);
        assert_near_abs(m.c1.value, 8, 0.01);
        assert_near_abs(m.c2.value, 110, 0.1);
        assert_true(isnan(m.c1.standard_error) != 0 && isnan(m.c2.low) != 0);
        for (int k = 0; k < PLACES; k++) {
            const double w = pow(10, -1.5 + 0.75 * k);
            double truth[2];
            wt_interval x[2];
            dma_moduli(&dma_rubber, w, &truth[0], &truth[1]);
            wt_master_moduli(&m, w, &x[0], &x[1]);
            for (int q = 0; q < 2; q++) {
                held += x[q].low <= log10(truth[q]) && log10(truth[q]) <= x[q].high;
                assert_near_abs(x[q].value, log10(truth[q]), 0.01);
            }
        }
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
    print_message("moduli held %.3f\n", (double)held / (2.0 * DRAWS * PLACES));
    assert_true((double)held > 0.88 * 2 * DRAWS * PLACES);
}

/* Shifts of every second isotherm are fixed, the others are fitted between them. */
static void stated_shifts_are_fixed(void **unused)
{
    wt_sweep sweep = {0};
    wt_master m = {0};
    const wt_master_options o = options(WT_SHIFT_MODULI);
    size_t given = 0;
    (void)unused;
    dma_usual(&sweep, true, noise, 7);
    for (size_t i = 0; i < sweep.n_isotherms; i += 2) {
        wt_isotherm *t = &sweep.isotherms[i];
        t->shift_is_stated = true; /* another reference: differences count */
        t->stated_log_a = 3 + wt_wlf_log_shift(&dma_rubber.wlf, t->temperature);
    }
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, NULL), WT_OK);
    for (size_t i = 0; i < m.n_shifts; i++) {
        const double truth = wt_wlf_log_shift(&dma_rubber.wlf, m.shifts[i].temperature);
        assert_near_abs(m.shifts[i].log_a.value, truth, i % 2 == 0 ? 1e-9 : 0.02);
        assert_true(i % 2 == 0 ? m.shifts[i].log_a.standard_error < 1e-9
                               : m.shifts[i].log_a.standard_error > 1e-4);
        given += strstr(m.shifts[i].note, "as given") != NULL;
    }
    assert_int_equal(given, 6);
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

/* One isotherm is moved by hand by 0.3 decade. It stays there, and the others do not move, because
 * they determine the spectrum. The value is relative to the isotherm nearest to the reference. */
static void one_shift_by_hand(void **unused)
{
    (void)unused;
    for (int between = 0; between < 2; between++) { /* the reference is an isotherm, or is not */
        static const char *const texts[] = {"40degC=-1.5"};
        wt_sweep sweep = {0};
        wt_master m = {0};
        wt_master_options o = options(WT_SHIFT_MODULI);
        const size_t hand = 6, base = 4; /* 40 and 20 degC */
        o.reference_temperature += between ? 2 : 0;
        dma_usual(&sweep, true, noise, 7);
        assert_int_equal(flow_set_hand_shifts(texts, 1, &sweep, NULL, NULL), WT_OK);
        assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, NULL), WT_OK);
        for (size_t i = 0; i < m.n_shifts; i++) {
            const wt_master_shift *s = &m.shifts[i];
            assert_int_equal(s->origin, i == hand   ? WT_SHIFT_BY_HAND
                                        : i == base ? WT_SHIFT_REFERENCE
                                                    : WT_SHIFT_FITTED);
        }
        assert_near_abs(m.shifts[hand].log_a.value - m.shifts[base].log_a.value, -1.5, 1e-9);
        if (!between)
            assert_true(m.shifts[hand].log_a.standard_error < 1e-9);
        assert_non_null(strstr(m.shifts[hand].note, "by hand"));
        assert_null(strstr(m.shifts[base].note, "as given"));
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
}

/* A manual shift is added to a law for all others, and is refused for the reference. */
static void manual_shift_with_a_law(void **unused)
{
    static const char *const forty[] = {"40degC=-1.5"}, *const reference[] = {"20.3degC=-1.5"},
                             *const other[] = {"25degC=1"},
                             *const twice[] = {"40degC=-1.5", "40.2degC=-1"},
                             *const none[] = {"40degC"};
    const wt_shift_law law = {.kind = WT_LAW_WLF,
                              .wlf = {313.15, dma_rubber.wlf.c1, dma_rubber.wlf.c2}};
    const wt_master_options o = options(WT_SHIFT_MODULI);
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    (void)unused;
    dma_usual(&sweep, true, noise, 7);
    assert_int_equal(flow_set_hand_shifts(other, 1, &sweep, NULL, &err), WT_E_NOT_FOUND);
    assert_int_equal(flow_hand_shifts_check(none, 1, &err), WT_E_ARG);
    assert_int_equal(flow_set_stated_shifts(&law, NULL, WT_VERTICAL_TIED, &sweep, NULL, &err),
                     WT_OK);
    assert_int_equal(flow_set_hand_shifts(forty, 1, &sweep, NULL, &err), WT_OK);
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, &err), WT_OK);
    for (size_t i = 0; i < m.n_shifts; i++) {
        const double given = wt_wlf_log_shift(&law.wlf, m.shifts[i].temperature) -
                             wt_wlf_log_shift(&law.wlf, m.shifts[4].temperature);
        assert_near_abs(m.shifts[i].log_a.value, i == 6 ? -1.5 : given, 1e-9);
        assert_int_equal(m.shifts[i].origin, i == 6   ? WT_SHIFT_BY_HAND
                                             : i == 4 ? WT_SHIFT_REFERENCE
                                                      : WT_SHIFT_GIVEN);
    }
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
    dma_usual(&sweep, true, noise, 7);
    assert_int_equal(flow_set_hand_shifts(twice, 2, &sweep, NULL, &err), WT_E_AMBIGUOUS);
    wt_sweep_clear(&sweep);
    dma_usual(&sweep, true, noise, 7);
    assert_int_equal(flow_set_hand_shifts(reference, 1, &sweep, NULL, &err), WT_OK);
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, &err), WT_E_ARG);
    assert_string_equal(err.place, "shift");
    wt_sweep_clear(&sweep);
}

/* Two runs at one temperature have separate shifts in the table. Two shifts for one isotherm, or
 * for temperatures that were not measured, are reported. */
static void runs_at_one_temperature_keep_their_shifts(void **unused)
{
    static const double temperature[] = {293.15, 293.15, 303.15, 393.15},
                        log_a[] = {0, 0.1, -0.6, -3};
    const wt_shift_law none = {.kind = WT_LAW_NONE};
    (void)unused;
    for (int run = 0; run < 2; run++) {
        wt_sweep sweep = {0};
        wt_error err = WT_ERROR_INIT;
        wt_log *log = wt_log_new();
        wt_table *table = wt_table_new("shifts", "");
        uint64_t state = 1;
        size_t said = 0;
        assert_int_equal(wt_table_add_column(table, "temperature", "K", "", NULL), WT_OK);
        assert_int_equal(wt_table_add_column(table, "log_a", "1", "", NULL), WT_OK);
        for (size_t i = 0; i < 4; i++) {
            assert_int_equal(wt_table_add_row(table, NULL), WT_OK);
            wt_table_set_number(table, 0, temperature[i]);
            wt_table_set_number(table, 1, log_a[i]);
        }
        for (size_t i = run == 0 ? 0 : 1; i < 3; i++) /* the second time one run only */
            assert_non_null(
                dma_add(&sweep, &dma_rubber, temperature[i], 0.1, 100, 8, true, noise, &state));
        const wt_status status =
            flow_set_stated_shifts(&none, table, WT_VERTICAL_TIED, &sweep, log, &err);
        assert_int_equal(status, run == 0 ? WT_OK : WT_E_AMBIGUOUS);
        for (size_t i = 0; run == 0 && i < 3; i++) {
            assert_true(sweep.isotherms[i].shift_is_stated);
            assert_near_abs(sweep.isotherms[i].stated_log_a, log_a[i], 0);
        }
        for (size_t i = 0; i < wt_log_count(log); i++)
            said += strstr(wt_log_get(log, i).text, "1 of the 4 given shifts are of no") != 0;
        assert_int_equal(said, run == 0);
        wt_table_free(table);
        wt_log_free(log);
        wt_sweep_clear(&sweep);
    }
}

/* Storage moduli without rho T, because the closed form has none. */
static void closed_form_of_the_standard(void **unused)
{
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_master_options o = options(WT_SHIFT_MODULI);
    (void)unused;
    dma_usual(&sweep, false, 0, 1);
    o.vertical = WT_VERTICAL_NONE;
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, NULL), WT_OK);
    for (size_t i = 0; i < m.n_shifts; i++) /* lines between the points: not exact */
        assert_near_abs(wt_master_closed_form(&m, i),
                        wt_wlf_log_shift(&dma_rubber.wlf, m.shifts[i].temperature), 0.08);
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

/* Each modulus alone: the intervals cover the true shifts, and there is no statement on what it
 * leaves open. */
static void one_quantity_alone(void **unused)
{
    enum { DRAWS = 24 };
    static const wt_shift_quantity by[] = {WT_SHIFT_STORAGE, WT_SHIFT_LOSS, WT_SHIFT_LOSS_FACTOR};
    (void)unused;
    for (size_t b = 0; b < 3; b++) {
        const wt_master_options o = options(WT_SHIFT_MODULI);
        const wt_master_options alone = options(by[b]);
        size_t held = 0, n = 0;
        for (uint64_t draw = 1; draw <= DRAWS; draw++) {
            wt_sweep sweep = {0};
            wt_master m = {0};
            dma_usual(&sweep, true, noise, draw);
            for (size_t i = 0; by[b] != WT_SHIFT_LOSS_FACTOR && i < sweep.n_isotherms; i++)
                for (size_t k = 0; k < sweep.isotherms[i].n; k++) /* as if not measured */
                    (by[b] == WT_SHIFT_STORAGE ? sweep.isotherms[i].loss_modulus
                                               : sweep.isotherms[i].storage_modulus)[k] =
                        (double)NAN;
            const wt_master_options *use = by[b] == WT_SHIFT_LOSS_FACTOR ? &alone : &o;
            assert_int_equal(wt_master_fit(&sweep, use, NULL, &m, NULL), WT_OK);
            assert_int_equal(wt_master_shift_quantity(&m), by[b]);
            assert_int_equal(m.superposition, WT_SUPERPOSITION_INCONCLUSIVE);
            for (size_t i = 0; i < m.n_shifts; i++) {
                const double truth = wt_wlf_log_shift(&dma_rubber.wlf, m.shifts[i].temperature);
                const wt_interval a = m.shifts[i].log_a;
                if (!m.shifts[i].determined || !(a.standard_error > 0))
                    continue;
                n++;
                held += a.low <= truth && truth <= a.high;
            }
            const bool level = by[b] == WT_SHIFT_STORAGE, factor = by[b] == WT_SHIFT_LOSS_FACTOR;
            const double measured = wt_master_loss_factor(&m, m.n / 2);
            const wt_interval ratio = m.fitted_loss_factor[m.n / 2];
            assert_int_equal(m.prony.n > 0, level);
            assert_int_equal(isfinite(m.fitted_storage[m.n / 2].value) != 0, level);
            assert_int_equal(isfinite(m.fitted_loss[m.n / 2].value) != 0, !factor);
            assert_int_equal(isfinite(ratio.value) != 0, by[b] != WT_SHIFT_LOSS);
            assert_int_equal(isfinite(measured) != 0, factor);
            assert_int_equal(isfinite(m.log_storage[0]) != 0, level);
            assert_int_equal(isfinite(m.shifts[0].log_b.value) != 0, !factor);
            if (factor)
                assert_near_abs(ratio.value, log10(measured), 3 * noise);
            wt_master_clear(&m);
            wt_sweep_clear(&sweep);
        }
        print_message("%zu: %zu of %zu shifts held\n", b, held, n);
        assert_true(n > 5 * DRAWS && (double)held > 0.85 * (double)n);
    }
}

/* One modulus does not determine a free vertical shift. */
static void one_modulus_and_free_shifts(void **unused)
{
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options o = options(WT_SHIFT_STORAGE);
    (void)unused;
    dma_usual(&sweep, true, noise, 1);
    o.vertical = WT_VERTICAL_FREE;
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, &err), WT_E_ARG);
    assert_string_equal(err.place, "vertical-shift");
    wt_sweep_clear(&sweep);
}

/* The reference is where tan delta of the rubber at 1 Hz, on a fine grid, has its peak. */
static void glass_transition_as_reference(void **unused)
{
    double peak = 0, largest = 0;
    (void)unused;
    for (double t = 223.15; t < 353; t += 0.05) {
        double storage, loss;
        dma_moduli(&dma_rubber, 2 * M_PI * pow(10, wt_wlf_log_shift(&dma_rubber.wlf, t)), &storage,
                   &loss);
        if (loss / storage > largest) {
            largest = loss / storage;
            peak = t;
        }
    }
    for (size_t by = WT_SHIFT_MODULI; by <= WT_SHIFT_LOSS_FACTOR; by++) {
        wt_sweep sweep = {0};
        wt_master m = {0};
        wt_error err = WT_ERROR_INIT;
        wt_master_options o = options((wt_shift_quantity)by);
        o.reference_at = WT_REFERENCE_TAN_DELTA_PEAK;
        o.reference_temperature = (double)NAN;
        dma_usual(&sweep, true, noise, 3);
        const wt_status status = wt_master_fit(&sweep, &o, NULL, &m, &err);
        assert_int_equal(status, by == WT_SHIFT_LOSS ? WT_E_RANGE : WT_OK);
        if (by == WT_SHIFT_LOSS) {
            assert_non_null(strstr(err.message, "no peak that was measured"));
        } else {
            print_message("%.2f, truth %.2f K\n", m.reference_temperature, peak);
            assert_near_abs(m.reference_temperature, peak, 0.5);
        }
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
}

/* Isotherms far above the transition that reach it by their frequencies: at 1 Hz it lies further
 * below them than the law is valid. */
static void no_glass_transition_far_from_the_isotherms(void **unused)
{
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options o = options(WT_SHIFT_MODULI);
    uint64_t state = 3;
    (void)unused;
    o.reference_at = WT_REFERENCE_TAN_DELTA_PEAK;
    o.reference_temperature = (double)NAN;
    for (int i = 0; i < 5; i++)
        assert_non_null(
            dma_add(&sweep, &dma_rubber, 333.15 + 10 * i, 1e3, 1e10, 30, true, noise, &state));
    assert_int_equal(wt_master_fit(&sweep, &o, NULL, &m, &err), WT_E_RANGE);
    print_message("%s\n", err.message);
    assert_non_null(strstr(err.message, "peaks more than 20 K below the isotherms"));
    wt_sweep_clear(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(excluded_by_temperature_and_frequency),
        cmocka_unit_test(invalid_exclusions),
        cmocka_unit_test(one_frequency_by_a_law),
        cmocka_unit_test(stated_shifts_are_fixed),
        cmocka_unit_test(runs_at_one_temperature_keep_their_shifts),
        cmocka_unit_test(no_glass_transition_far_from_the_isotherms),
        cmocka_unit_test(one_shift_by_hand),
        cmocka_unit_test(manual_shift_with_a_law),
        cmocka_unit_test(closed_form_of_the_standard),
        cmocka_unit_test(one_quantity_alone),
        cmocka_unit_test(one_modulus_and_free_shifts),
        cmocka_unit_test(glass_transition_as_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
