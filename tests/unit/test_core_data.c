/* Force curves, sweeps, Prony series, tables. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/data/force_curve.h"
#include "weartrack/core.h"

#include <stdio.h>
#include <string.h>

static void force_curve_memory(void **state)
{
    (void)state;
    static const struct {
        size_t segments, points, channels;
    } rounds[] = {{2, 100, 3}, {5, 10, 1}, {1, 5000, 4}, {0, 0, 0}, {3, 0, 2}, {2, 7, 0}};
    wt_force_curve curve = {0};
    for (size_t i = 0; i < sizeof rounds / sizeof *rounds; i++) {
        wt_force_curve_reset(&curve);
        assert_int_equal(curve.n_segments, 0);
        assert_near(curve.x, (double)NAN, 0);
        assert_int_equal(curve.grid_x, -1);
        for (size_t s = 0; s < rounds[i].segments; s++) {
            wt_segment *const segment = wt_force_curve_add_segment(
                &curve, s == 1 ? WT_SEGMENT_RETRACT : WT_SEGMENT_APPROACH, rounds[i].points,
                rounds[i].channels);
            assert_non_null(segment);
            assert_int_equal(segment->index, s);
            assert_int_equal(segment->n_points, rounds[i].points);
            assert_int_equal(segment->n_channels, rounds[i].channels);
            assert_near(segment->duration, (double)NAN, 0);
            for (size_t c = 0; c < rounds[i].channels; c++) {
                wt_channel *const channel = &segment->channels[c];
                assert_int_equal(channel->quantity, WT_Q_NONE);
                assert_string_equal(channel->name, "");
                channel->quantity = c == 0 ? WT_Q_FORCE : WT_Q_HEIGHT;
                (void)snprintf(channel->name, sizeof channel->name, "channel %zu", c);
                for (size_t k = 0; k < rounds[i].points; k++)
                    channel->values[k] = (double)k;
            }
        }
        assert_int_equal(curve.n_segments, rounds[i].segments);
    }
    const wt_segment *const retract = wt_force_curve_segment(&curve, WT_SEGMENT_RETRACT);
    assert_ptr_equal(retract, &curve.segments[1]);
    assert_null(wt_force_curve_segment(&curve, WT_SEGMENT_DWELL));
    wt_force_curve_reset(&curve);
    wt_segment *const one = wt_force_curve_add_segment(&curve, WT_SEGMENT_DWELL, 3, 2);
    one->channels[1].quantity = WT_Q_TIME;
    assert_ptr_equal(wt_segment_channel(one, WT_Q_TIME), &one->channels[1]);
    assert_null(wt_segment_channel(one, WT_Q_FORCE));
    /* Sizes that a corrupted file may state. */
    assert_null(wt_force_curve_add_segment(&curve, WT_SEGMENT_APPROACH, SIZE_MAX / 4, 1));
    assert_null(wt_force_curve_add_segment(&curve, WT_SEGMENT_APPROACH, 1, SIZE_MAX / 4));
    assert_int_equal(curve.n_segments, 1);
    wt_force_curve_clear(&curve);
    assert_null(curve.segments);
    wt_force_curve_clear(&curve);
    wt_force_curve_clear(NULL);
    assert_string_equal(wt_segment_kind_name(WT_SEGMENT_MODULATION), "modulation");
}

/* For the instrument 2 V is 100 nm is 30 nN; other calibrations start from the volts. */
static void deflection_and_force(void **state)
{
    (void)state;
    static const wt_quantity steps[] = {WT_Q_DEFLECTION_VOLTAGE, WT_Q_DEFLECTION, WT_Q_FORCE};
    const wt_cantilever file = {.spring_constant = 0.3, .sensitivity = 50e-9};
    const double stored[] = {2, 100e-9, 30e-9};
    for (unsigned given = 0; given < 4; given++) {
        wt_cantilever used = file;
        used.spring_constant_is_overridden = (given & 1) != 0;
        used.sensitivity_is_overridden = (given & 2) != 0;
        used.spring_constant = used.spring_constant_is_overridden ? 0.7 : 0.3;
        used.sensitivity = used.sensitivity_is_overridden ? 80e-9 : 50e-9;
        const double made[] = {2, 2 * used.sensitivity,
                               2 * used.sensitivity * used.spring_constant};
        for (size_t from = 0; from < 3; from++)
            for (size_t to = 0; to < 3; to++)
                assert_near(stored[from] * deflection_factor(steps[from], steps[to], &file, &used),
                            made[to], 1e-14);
    }
    /* Unknown channels are not computed; missing values of the file are not replaced. */
    const wt_cantilever none = {.spring_constant = (double)NAN, .sensitivity = (double)NAN};
    wt_cantilever used = none;
    assert_near(deflection_factor(WT_Q_FORCE, WT_Q_FORCE, &none, &used), 1, 0);
    assert_near(deflection_factor(WT_Q_DEFLECTION, WT_Q_FORCE, &none, &used), (double)NAN, 0);
    assert_near(deflection_factor(WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE, &none, &used),
                (double)NAN, 0);
    used = (wt_cantilever){.spring_constant = 0.5,
                           .sensitivity = 1e-7,
                           .spring_constant_is_overridden = true,
                           .sensitivity_is_overridden = true};
    assert_near(deflection_factor(WT_Q_FORCE, WT_Q_FORCE, &none, &used), 1, 0);
    assert_near(deflection_factor(WT_Q_DEFLECTION, WT_Q_FORCE, &none, &used), 0.5, 0);
    assert_near(deflection_factor(WT_Q_DEFLECTION_VOLTAGE, WT_Q_FORCE, &none, &used), 5e-8, 1e-15);
    assert_near(tip_position(4e-6, 1e-8, 0.01), 3e-6, 1e-15);
    /* Four samples of a segment of 2 s: the next sample would begin the next segment. */
    double times[4];
    sample_times(10, 2, 4, times);
    for (size_t i = 0; i < 4; i++)
        assert_near(times[i], 10 + 0.5 * (double)i, 0);
}

static void add_isotherm(wt_sweep *sweep, double temperature, const char *source, bool strain)
{
    static const double frequency[] = {100.0, 1.0, 31.6, 10.0, 3.16, 0.1, 0.316};
    const size_t n = sizeof frequency / sizeof *frequency;
    wt_isotherm *const isotherm = wt_sweep_add(sweep, n, strain);
    assert_non_null(isotherm);
    assert_int_equal(isotherm->strain != NULL, strain);
    isotherm->temperature = temperature;
    (void)snprintf(isotherm->source, sizeof isotherm->source, "%s", source);
    for (size_t i = 0; i < n; i++) {
        isotherm->angular_frequency[i] = frequency[i];
        isotherm->storage_modulus[i] = 2.0 * frequency[i];
        isotherm->loss_modulus[i] = 3.0 * frequency[i];
        if (strain)
            isotherm->strain[i] = 4.0 * frequency[i];
    }
}

static void sweep_order(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    add_isotherm(&sweep, 300.0, "a.txt step 10", false);
    add_isotherm(&sweep, (double)NAN, "a.txt step 3", false);
    add_isotherm(&sweep, 300.0, "a.txt step 9", true);
    add_isotherm(&sweep, 250.0, "b.txt", false);
    wt_sweep_sort(&sweep);
    static const char *const sources[] = {"b.txt", "a.txt step 9", "a.txt step 10", "a.txt step 3"};
    assert_int_equal(sweep.n_isotherms, 4);
    for (size_t i = 0; i < 4; i++) {
        const wt_isotherm *const t = &sweep.isotherms[i];
        assert_string_equal(t->source, sources[i]);
        for (size_t k = 0; k < t->n; k++) {
            assert_true(k == 0 || t->angular_frequency[k] > t->angular_frequency[k - 1]);
            assert_near(t->storage_modulus[k], 2.0 * t->angular_frequency[k], 0);
            assert_near(t->loss_modulus[k], 3.0 * t->angular_frequency[k], 0);
            if (t->strain != NULL)
                assert_near(t->strain[k], 4.0 * t->angular_frequency[k], 0);
        }
    }
    assert_int_equal(sweep.n_isotherms, 4);
    wt_sweep_clear(&sweep);
    wt_sweep_clear(NULL);
    wt_sweep_sort(&sweep);
}

/* The sweeps of one sample, of every kind, in their order. */
static void one_sample(void **state)
{
    (void)state;
    static const char *const samples[] = {"A", "B", "A", "B"};
    wt_sweep sweep = {0};
    for (int i = 0; i < 4; i++) {
        wt_isotherm *isotherm = wt_sweep_add(&sweep, 2, 0);
        wt_ramp *ramp = wt_sweep_add_ramp(&sweep, 2, 0);
        wt_strain_sweep *strains = wt_sweep_add_strain_sweep(&sweep, 2);
        assert_true(isotherm != NULL && ramp != NULL && strains != NULL);
        isotherm->temperature = 300 + i;
        ramp->angular_frequency = 1 + i;
        strains->angular_frequency = 10 + i;
        isotherm->sample = strdup(samples[i]);
        ramp->sample = strdup(samples[i]);
        strains->sample = strdup(samples[i]);
    }
    assert_int_equal(wt_sweep_select_sample(&sweep, "B"), WT_OK);
    assert_int_equal(sweep.n_isotherms, 2);
    assert_int_equal(sweep.n_ramps, 2);
    assert_int_equal(sweep.n_strain_sweeps, 2);
    for (int i = 0; i < 2; i++) {
        assert_true(sweep.isotherms[i].temperature == 301 + 2 * i);
        assert_true(sweep.ramps[i].angular_frequency == 2 + 2 * i);
        assert_true(sweep.strain_sweeps[i].angular_frequency == 11 + 2 * i);
    }
    assert_int_equal(wt_sweep_select_sample(&sweep, "C"), WT_E_NOT_FOUND);
    wt_sweep_clear(&sweep);
}

static void small_types(void **state)
{
    (void)state;
    wt_prony prony = {0};
    wt_prony_alloc(&prony, 3);
    assert_int_equal(prony.n, 3);
    assert_near(prony.reference_temperature, (double)NAN, 0);
    prony.modulus[2] = 2.385e6;
    wt_prony_clear(&prony);
    assert_null(prony.modulus);
    wt_prony_clear(NULL);
    wt_image_clear(NULL);
    wt_power_spectrum_clear(NULL);
}

static void table_columns(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_table *const t = wt_table_new("friction", "Friction");
    assert_int_equal(wt_table_add_row(t, &err), WT_E_ARG); /* no columns */
    static const char *const bad_names[] = {"", "a b", "a[m]", "block", "\xC2\xB5"};
    for (size_t i = 0; i < sizeof bad_names / sizeof *bad_names; i++)
        assert_int_equal(wt_table_add_column(t, bad_names[i], "m", "", &err), WT_E_ARG);
    static const char *const bad_units[] = {"", "text", "m]", "m\tm", "m\xFF"};
    for (size_t i = 0; i < sizeof bad_units / sizeof *bad_units; i++)
        assert_int_equal(wt_table_add_column(t, "x", bad_units[i], "", &err), WT_E_ARG);
    assert_int_equal(wt_table_add_column(t, "x", "m", "", &err), WT_OK);
    assert_int_equal(wt_table_add_column(t, "x", "m", "", &err), WT_E_ARG);
    assert_int_equal(wt_table_add_text_column(t, "note", "", &err), WT_OK);
    assert_int_equal(wt_table_find(t, "note"), 1);
    assert_int_equal(wt_table_find(t, "none"), -1);
    for (int i = 0; i < 100; i++) {
        if (i % 10 == 0) {
            /* An empty block does not exist. */
            wt_table_new_block(t);
            wt_table_new_block(t);
        }
        assert_int_equal(wt_table_add_row(t, &err), WT_OK);
        assert_near(wt_table_number(t, (size_t)i, 0), (double)NAN, 0);
        assert_string_equal(wt_table_text(t, (size_t)i, 1), "");
        wt_table_set_number(t, 0, i);
        wt_table_set_text(t, 1, "first");
        wt_table_set_text(t, 1, i % 2 == 0 ? "second" : NULL);
    }
    assert_int_equal(wt_table_add_column(t, "late", "m", "", &err), WT_E_ARG);
    assert_int_equal(wt_table_n_rows(t), 100);
    for (size_t i = 0; i < 100; i++) {
        assert_int_equal(wt_table_block(t, i), i / 10);
        assert_near(wt_table_numbers(t, 0)[i], (double)i, 0);
        assert_string_equal(wt_table_text(t, i, 1), i % 2 == 0 ? "second" : "");
    }
    wt_table_free(t);
    wt_table_free(NULL);
}

static void table_keys(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_table *const t = wt_table_new("friction", "Friction");
    assert_null(wt_table_key(t, "tip"));
    assert_int_equal(wt_table_set_key(t, "tip", "sphere", &err), WT_OK);
    assert_int_equal(wt_table_set_key(t, "tip", "cone", &err), WT_OK);
    assert_int_equal(wt_table_n_keys(t), 1);
    assert_string_equal(wt_table_key(t, "tip"), "cone");
    static const char *const bad[] = {"", "a b", "a:b", "title", "column", "key_order", "table"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(wt_table_set_key(t, bad[i], "x", &err), WT_E_ARG);
    wt_estimate e = {2.385, 0.1, (double)NAN, NULL}, found = {0};
    assert_int_equal(wt_table_set_estimate(t, "ratio", e, &err), WT_OK);
    assert_true(wt_table_estimate(t, "ratio", &found));
    assert_near(found.value, 2.385, 0);
    assert_string_equal(found.unit, "1");
    assert_string_equal(wt_table_key(t, "ratio"),
                        "2.385 standard_error=0.1 numerical_error=nan unit=1");
    /* Names of the parts of an estimate in a stored file. */
    assert_int_equal(wt_table_set_key(t, "ratio_units", "x", &err), WT_E_ARG);
    assert_int_equal(wt_table_set_key(t, "other_units", "x", &err), WT_OK);
    assert_int_equal(wt_table_set_estimate(t, "other", e, &err), WT_E_ARG);
    assert_null(wt_table_key(t, "other"));
    /* Every spelling gives the same estimate. */
    assert_int_equal(
        wt_table_set_key(t, "again", "2.50 standard_error=1e0 numerical_error=0 unit=N/m", &err),
        WT_OK);
    assert_string_equal(wt_table_key(t, "again"),
                        "2.5 standard_error=1 numerical_error=0 unit=N/m");
    assert_int_equal(wt_table_set_key(t, "ratio", "none", &err), WT_OK);
    assert_false(wt_table_estimate(t, "ratio", &found));
    wt_table_free(t);
}

static void add_measured(wt_sweep *sweep, double temperature, double storage, const char *source)
{
    static const double w[] = {10, 1, 1, 0.1, 1};
    wt_isotherm *t = wt_sweep_add(sweep, 5, WT_SWEEP_HAS_STRAIN);
    assert_non_null(t);
    t->temperature = temperature;
    snprintf(t->source, sizeof t->source, "%s", source);
    for (size_t i = 0; i < 5; i++) {
        t->angular_frequency[i] = w[i];
        t->storage_modulus[i] = i == 2 ? 7 : storage;
        t->loss_modulus[i] = 1;
        t->strain[i] = (double)i;
    }
}

/* Identical copies are removed, each with a message; a repeated measurement stays. */
static void sweep_copies(void **state)
{
    (void)state;
    wt_sweep sweep = {0};
    wt_log *log = wt_log_new();
    add_measured(&sweep, 300, 5, "a.csv");
    add_measured(&sweep, 300, 5, "b.csv");
    add_measured(&sweep, 300, nextafter(5, 6), "c.csv");
    add_measured(&sweep, 320, 9, "a.csv");
    wt_sweep_sort(&sweep);
    wt_sweep_remove_duplicates(&sweep, log);
    assert_int_equal(sweep.n_isotherms, 3);
    assert_string_equal(sweep.isotherms[0].source, "a.csv");
    assert_string_equal(sweep.isotherms[1].source, "c.csv");
    for (size_t i = 0; i < 3; i++) {
        const wt_isotherm *t = &sweep.isotherms[i];
        double sum = 0;
        assert_int_equal(t->n, 4); /* duplicates: the point of 5 at 1 rad/s, and that of 7 */
        assert_near(t->angular_frequency[0], 0.1, 0);
        assert_near(t->angular_frequency[3], 10, 0);
        for (size_t k = 1; k < 3; k++) {
            assert_near(t->angular_frequency[k], 1, 0);
            sum += t->storage_modulus[k];
        }
        assert_near(sum, 7 + t->storage_modulus[0], 1e-15);
        assert_near(t->strain[0], 3, 0);
        assert_near(t->strain[3], 0, 0);
    }
    assert_int_equal(wt_log_count(log), 5);
    assert_non_null(
        strstr(wt_log_get(log, 4).text,
               "1 isotherm is a copy of another and left out; the first: b.csv is a.csv"));
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

/* By frequency, points by temperature; a duplicate is removed. */
static void ramps(void **state)
{
    static const double frequency[] = {10, 1, 1};
    wt_sweep sweep = {0};
    wt_log *log = wt_log_new();
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        wt_ramp *ramp = wt_sweep_add_ramp(&sweep, 6, 0);
        assert_non_null(ramp);
        ramp->angular_frequency = frequency[i];
        (void)snprintf(ramp->source, sizeof ramp->source, "%zu.txt", i);
        for (size_t k = 0; k < 6; k++) {
            ramp->temperature[k] = 300.0 - 10.0 * (double)k;
            ramp->storage_modulus[k] = 2 * ramp->temperature[k];
            ramp->loss_modulus[k] = 3 * ramp->temperature[k];
        }
    }
    wt_sweep_sort(&sweep);
    wt_sweep_remove_duplicates(&sweep, log);
    assert_int_equal(sweep.n_ramps, 2);
    assert_string_equal(sweep.ramps[0].source, "1.txt");
    assert_near(sweep.ramps[1].angular_frequency, 10, 0);
    for (size_t k = 0; k < 6; k++) {
        const wt_ramp *ramp = &sweep.ramps[0];
        assert_near(ramp->temperature[k], 250.0 + 10.0 * (double)k, 0);
        assert_near(ramp->storage_modulus[k], 2 * ramp->temperature[k], 0);
        assert_near(ramp->loss_modulus[k], 3 * ramp->temperature[k], 0);
    }
    assert_non_null(strstr(wt_log_get(log, 0).text, "a copy of that of 1.txt"));
    assert_int_equal(wt_log_get(log, 0).n_values, 1);
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

/* By temperature and frequency, points by strain; a duplicate is removed. */
static void strain_sweeps(void **state)
{
    static const double temperature[] = {300, 280, 280, 280}, frequency[] = {1, 10, 1, 1};
    wt_sweep sweep = {0};
    wt_log *log = wt_log_new();
    (void)state;
    for (size_t i = 0; i < 4; i++) {
        wt_strain_sweep *s = wt_sweep_add_strain_sweep(&sweep, 6);
        assert_non_null(s);
        s->temperature = temperature[i];
        s->angular_frequency = frequency[i];
        (void)snprintf(s->source, sizeof s->source, "%zu.txt", i);
        for (size_t k = 0; k < 6; k++) {
            s->strain[k] = 0.1 / (double)(k + 1);
            s->storage_modulus[k] = 2 * s->strain[k];
            s->loss_modulus[k] = 3 * s->strain[k];
        }
    }
    wt_sweep_sort(&sweep);
    wt_sweep_remove_duplicates(&sweep, log);
    assert_int_equal(sweep.n_strain_sweeps, 3);
    assert_string_equal(sweep.strain_sweeps[0].source, "2.txt");
    assert_string_equal(sweep.strain_sweeps[1].source, "1.txt");
    assert_string_equal(sweep.strain_sweeps[2].source, "0.txt");
    for (size_t k = 0; k < 6; k++) {
        const wt_strain_sweep *s = &sweep.strain_sweeps[0];
        assert_near(s->strain[k], 0.1 / (double)(6 - k), 0);
        assert_near(s->storage_modulus[k], 2 * s->strain[k], 0);
        assert_near(s->loss_modulus[k], 3 * s->strain[k], 0);
    }
    assert_non_null(strstr(wt_log_get(log, 0).text, "a copy of that of 2.txt"));
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ramps),
        cmocka_unit_test(strain_sweeps),
        cmocka_unit_test(force_curve_memory),
        cmocka_unit_test(deflection_and_force),
        cmocka_unit_test(sweep_order),
        cmocka_unit_test(sweep_copies),
        cmocka_unit_test(one_sample),
        cmocka_unit_test(small_types),
        cmocka_unit_test(table_columns),
        cmocka_unit_test(table_keys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
