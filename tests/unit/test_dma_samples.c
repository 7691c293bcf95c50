/* Sweeps of several samples: their list, selection of one, and files of possibly different
 * materials.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "dma/sweep_input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static wt_sweep sweep;

static char *copy(const char *name)
{
    char *own = name == NULL ? NULL : strdup(name);
    assert_true(name == NULL || own != NULL);
    return own;
}

static void add(const char *sample, double temperature, const char *source)
{
    wt_isotherm *t = wt_sweep_add(&sweep, 1, 0);
    assert_non_null(t);
    t->temperature = temperature;
    t->angular_frequency[0] = t->storage_modulus[0] = t->loss_modulus[0] = 1;
    t->sample = copy(sample);
    snprintf(t->source, sizeof t->source, "%s", source);
}

static void add_others(const char *ramp, const char *strain)
{
    wt_ramp *r = wt_sweep_add_ramp(&sweep, 1, 0);
    wt_strain_sweep *s = wt_sweep_add_strain_sweep(&sweep, 1);
    assert_true(r != NULL && s != NULL);
    r->sample = copy(ramp);
    s->sample = copy(strain);
}

/* Each once, in natural order: 2 before 10. */
static void test_list_of_samples(void **state)
{
    (void)state;
    wt_sample_names samples = {0, NULL};
    static const char *const names[] = {"", "NR 2", "NR 10", "SBR"};
    add("NR 10", 300, "a");
    add(NULL, 310, "a");
    add("NR 2", 300, "a");
    add("NR 10", 310, "a");
    add("", 320, "a");
    add_others("SBR", "CR");
    samples = flow_samples_find(&sweep);
    assert_int_equal(samples.n, 4);
    for (size_t i = 0; i < 4; i++)
        assert_string_equal(samples.name[i], names[i]);
    wt_sample_names_clear(&samples);
    assert_int_equal(samples.n, 0);
}

static void test_name_with_strain_sweeps_only(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    add("NR", 300, "a");
    add("SBR", 300, "a");
    add(NULL, 310, "a");
    add_others("NR", "CR");
    assert_int_equal(flow_select_sample(&sweep, NULL, &err), WT_OK);
    assert_int_equal(flow_select_sample(&sweep, "all", &err), WT_OK);
    assert_int_equal(sweep.n_isotherms, 3);
    assert_int_equal(flow_select_sample(&sweep, "EPDM", &err), WT_E_NOT_FOUND);
    assert_string_equal(err.message, "no sweep is of the sample \"EPDM\"");
    assert_string_equal(err.found, "(without a name), NR, SBR, CR");
    assert_int_equal(sweep.n_isotherms, 3);
    assert_int_equal(flow_select_sample(&sweep, "NR", &err), WT_OK);
    assert_int_equal(sweep.n_isotherms, 1);
    assert_int_equal(sweep.n_ramps, 1);
    assert_int_equal(sweep.n_strain_sweeps, 0);
    assert_string_equal(sweep.isotherms[0].sample, "NR");
}

/* A name that only strain sweeps or ramps have is listed, too. */
static void test_other_samples(void **state)
{
    (void)state;
    add("NR", 300, "a");
    add_others("SBR", "CR");
    assert_int_equal(flow_select_sample(&sweep, "CR", NULL), WT_OK);
    assert_int_equal(sweep.n_strain_sweeps, 1);
    assert_int_equal(sweep.n_isotherms + sweep.n_ramps, 0);
}

static void test_one(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_file_set set = {.read = wt_read_defaults()};
    add("NR", 300, "a");
    assert_int_equal(flow_require_one_sample(&sweep, &set, 1, NULL, &err), WT_OK);
    for (int i = 0; i < 40; i++) {
        char name[24];
        snprintf(name, sizeof name, "compound %02d", i);
        add(name, 300, "a");
    }
    assert_int_equal(flow_require_one_sample(&sweep, &set, 1, NULL, &err), WT_E_AMBIGUOUS);
    assert_string_equal(err.expected, "those of one");
    assert_int_equal(strncmp(err.found, "NR, compound 00, compound 01", 28), 0);
    assert_string_equal(err.found + sizeof err.found - 4, "..."); /* truncated, with a mark */
    set.read.sample = "NR";                                       /* was chosen */
    assert_int_equal(flow_require_one_sample(&sweep, &set, 1, NULL, &err), WT_OK);
    assert_int_equal(flow_require_one_sample(&sweep, NULL, 0, NULL, &err), WT_E_AMBIGUOUS);
}

/* Two files at one temperature, within half a kelvin, may be two materials: one warning. */
static void test_files(void **state)
{
    (void)state;
    static const struct {
        const char *sample, *first, *second;
        double apart;
        bool said;
    } cases[] = {
        {NULL, "one.csv, line 1", "two.csv, line 1", 0.49, true},
        {NULL, "one.csv, line 1", "two.csv, line 1", -0.49, true},
        {NULL, "one.csv, line 1", "two.csv, line 1", 0.51, false},
        {NULL, "one.csv, line 1", "one.csv, line 9", 0, false},
        {NULL, "one.csv", "one.csv2", 0, true},
        {NULL, "one.csv", "two.csv", 0, true},
        {"NR", "one.csv, line 1", "two.csv, line 1", 0, false},
    };
    const wt_file_set set = {.read = wt_read_defaults()};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_log *log = wt_log_new();
        wt_sweep_clear(&sweep);
        add(cases[i].sample, 293.15, cases[i].first);
        add(cases[i].sample, 293.15 + cases[i].apart, cases[i].second);
        add(cases[i].sample, 293.15 + cases[i].apart, "three.csv");
        if (!cases[i].said)
            sweep.n_isotherms--;
        assert_int_equal(flow_require_one_sample(&sweep, &set, 1, log, NULL), WT_OK);
        sweep.n_isotherms += !cases[i].said;
        assert_int_equal(wt_log_count(log), cases[i].said);
        if (cases[i].said) {
            char words[96];
            snprintf(words, sizeof words, "measured at %.1f degC like %.*s: taken as one material",
                     20 + cases[i].apart, (int)strcspn(cases[i].first, ","), cases[i].first);
            assert_non_null(strstr(wt_log_get(log, 0).text, words));
        }
        wt_log_free(log);
    }
}

static int end(void **state)
{
    (void)state;
    wt_sweep_clear(&sweep);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_list_of_samples, end),
        cmocka_unit_test_teardown(test_name_with_strain_sweeps_only, end),
        cmocka_unit_test_teardown(test_other_samples, end),
        cmocka_unit_test_teardown(test_one, end), cmocka_unit_test_teardown(test_files, end)};
    return cmocka_run_group_tests_name("samples of sweeps", tests, NULL, NULL);
}
