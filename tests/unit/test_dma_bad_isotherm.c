/* One bad isotherm in a sound sweep: it is excluded and named, the others have the true shifts, and
 * the reference temperature only moves the shifts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/dma.h"

#include "dma_data.h"

enum { BAD = 4 }; /* 20 degC, in the middle of the transition */

static wt_master fit(const wt_sweep *sweep, double reference, wt_log *log)
{
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = reference;
    if (wt_master_fit(sweep, &options, log, &m, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    return m;
}

/* Checks the differences of log aT against the truth, without the isotherm `bad`. */
static void check_shifts(const wt_master *m, size_t bad, double tolerance)
{
    const size_t first = bad == 3 ? 2 : 3;
    const double at = m->shifts[first].log_a.value -
                      wt_wlf_log_shift(&dma_rubber.wlf, m->shifts[first].temperature);
    for (size_t i = 0; i < m->n_shifts; i++) {
        if (i == bad)
            continue;
        const double off = m->shifts[i].log_a.value - at -
                           wt_wlf_log_shift(&dma_rubber.wlf, m->shifts[i].temperature);
        assert_true(m->shifts[i].determined);
        assert_true(fabs(off) < tolerance);
    }
}

/* Returns the number of exclusions that name the isotherm and the cause. */
static size_t named(const wt_log *log, const char *temperature, const char *cause)
{
    size_t n = 0;
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry e = wt_log_get(log, i);
        n += e.severity == WT_LOSS && strstr(e.text, temperature) != NULL &&
             strstr(e.text, cause) != NULL;
    }
    return n;
}

static size_t count_losses(const wt_log *log)
{
    size_t n = 0;
    for (size_t i = 0; i < wt_log_count(log); i++)
        n += wt_log_get(log, i).severity == WT_LOSS;
    return n;
}

/* Index of the isotherm in the sorted sweep. */
static void check_left_out(wt_sweep *sweep, size_t index, const char *temperature,
                           const char *cause, bool is_determined)
{
    wt_log *log = wt_log_new();
    wt_master m = fit(sweep, 303.15, log);
    assert_int_equal(m.shifts[index].determined, is_determined);
    assert_int_equal(named(log, temperature, cause), 1);
    assert_int_equal(count_losses(log), 1);
    check_shifts(&m, is_determined ? m.n_shifts : index, 0.08);
    wt_master_clear(&m);
    wt_log_free(log);
    wt_sweep_clear(sweep);
}

static void a_bad_loss_modulus_is_named(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 11);
    for (size_t k = 0; k < sweep.isotherms[BAD].n; k++)
        sweep.isotherms[BAD].loss_modulus[k] *= 1.4;
    check_left_out(&sweep, BAD, "20.00 °C", "its E'' is left out: it deviates by +", true);
}

static void radians_labelled_hertz_are_named(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 12);
    for (size_t k = 0; k < sweep.isotherms[BAD].n; k++)
        sweep.isotherms[BAD].angular_frequency[k] *= 2 * M_PI;
    check_left_out(&sweep, BAD, "20.00 °C", "rad/s read as Hz", false);
}

static void kelvin_labelled_celsius_is_named(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 13);
    sweep.isotherms[BAD].temperature += 273.15;
    wt_sweep_sort(&sweep);
    check_left_out(&sweep, sweep.n_isotherms - 1, "293.15 °C", "kelvin", false);
}

static void an_isotherm_without_positive_moduli_is_named(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    dma_usual(&sweep, true, 0.01, 14);
    for (size_t k = 0; k < sweep.isotherms[BAD].n; k++)
        sweep.isotherms[BAD].loss_modulus[k] *= -1;
    check_left_out(&sweep, BAD, "20.00 °C", "no positive modulus", false);
}

static void sound_isotherms_are_all_used(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        wt_sweep sweep = {0};
        wt_log *log = wt_log_new();
        dma_usual(&sweep, true, 0.01, 20 + seed);
        wt_master m = fit(&sweep, 293.15, log);
        assert_int_equal(count_losses(log), 0);
        check_shifts(&m, sweep.n_isotherms, 0.08);
        wt_master_clear(&m);
        wt_log_free(log);
        wt_sweep_clear(&sweep);
    }
}

/* Largest change of a difference of log aT between two references. */
static double reference_spread(const wt_sweep *sweep, double one, double other)
{
    wt_master a = fit(sweep, one, NULL), b = fit(sweep, other, NULL);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < a.n_shifts; i++) {
        assert_int_equal(a.shifts[i].determined, b.shifts[i].determined);
        assert_int_equal(isnan(a.shifts[i].log_a.value), isnan(b.shifts[i].log_a.value));
        if (isnan(a.shifts[i].log_a.value))
            continue;
        const double off = a.shifts[i].log_a.value - b.shifts[i].log_a.value;
        low = fmin(low, off);
        high = fmax(high, off);
        if (fabs(b.shifts[i].temperature - other) < 0.1) {
            assert_true(b.shifts[i].log_a.value == 0.0);
            assert_true(b.shifts[i].log_a.standard_error == 0.0);
        }
    }
    assert_true(a.n == b.n);
    wt_master_clear(&a);
    wt_master_clear(&b);
    return high - low;
}

/* Sound isotherms, and isotherms that one spectrum does not describe: E'' of the warm half is
 * wrong, so that the overlaps decide. */
static void the_reference_only_moves_the_shifts(void **state)
{
    (void)state;
    for (int fails = 0; fails < 2; fails++) {
        wt_sweep sweep = {0};
        dma_usual(&sweep, true, 0.01, 31);
        for (size_t i = 0; fails && i < sweep.n_isotherms; i++)
            for (size_t k = 0; k < sweep.isotherms[i].n; k++)
                sweep.isotherms[i].loss_modulus[k] *= i % 2 == 0 ? 1.5 : 1;
        assert_true(reference_spread(&sweep, 303.15, 253.15) < 0.05);
        assert_true(reference_spread(&sweep, 303.15, 333.15) < 0.05);
        wt_sweep_clear(&sweep);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bad_loss_modulus_is_named),
        cmocka_unit_test(radians_labelled_hertz_are_named),
        cmocka_unit_test(kelvin_labelled_celsius_is_named),
        cmocka_unit_test(an_isotherm_without_positive_moduli_is_named),
        cmocka_unit_test(sound_isotherms_are_all_used),
        cmocka_unit_test(the_reference_only_moves_the_shifts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
