/* Materials side by side whose draws are known: values, intervals and verdicts by hand.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding.h"
#include "truth.h"

enum { DRAWS = 400, TERMS = 3 };
static const double scatter = 0.02;

/* All moduli of a draw by one factor: then E' and E'' scatter alike, and tan delta not at all. */
static wt_rubber drawn(double ratio, uint64_t seed)
{
    sliding_set_up(NULL, 0);
    wt_rubber r = rubber;
    r.prony.equilibrium_modulus *= ratio;
    double *own = malloc(TERMS * sizeof *own);
    r.draws = calloc(DRAWS, sizeof *r.draws);
    assert_true(own != NULL && r.draws != NULL);
    for (size_t k = 0; k < TERMS; k++)
        own[k] = ratio * rubber.prony.modulus[k];
    r.prony.modulus = own;
    r.n_draws = DRAWS;
    for (size_t i = 0; i < DRAWS; i++) {
        const double factor = exp(scatter * truth_normal(&seed));
        wt_prony *p = &r.draws[i].prony;
        *p = r.prony;
        p->equilibrium_modulus *= factor;
        p->modulus = malloc(TERMS * sizeof *p->modulus);
        assert_non_null(p->modulus);
        for (size_t k = 0; k < TERMS; k++)
            p->modulus[k] = factor * own[k];
    }
    return r;
}

static void forget(wt_rubber *r)
{
    for (size_t i = 0; i < DRAWS; i++)
        free(r->draws[i].prony.modulus);
    free(r->draws);
    free(r->prony.modulus);
}

static void moduli(double omega, double *storage, double *loss)
{
    *storage = rubber.prony.equilibrium_modulus;
    *loss = 0;
    for (size_t k = 0; k < TERMS; k++) {
        const double z = omega * rubber.prony.relaxation_time[k];
        *storage += rubber.prony.modulus[k] * z * z / (1 + z * z);
        *loss += rubber.prony.modulus[k] * z / (1 + z * z);
    }
}

/* The interval of 95 % of a number whose logarithm has this error, as draws tell it. */
static void check(const wt_table *t, size_t row, const char *name, double truth, double error)
{
    char low[48], high[48];
    snprintf(low, sizeof low, "%s_low", name);
    snprintf(high, sizeof high, "%s_high", name);
    assert_near(cell(t, row, name), truth, 1e-6);
    assert_near_abs(log(cell(t, row, high) / truth), 1.96 * error, 0.15 * 1.96 * error + 1e-6);
    assert_near_abs(log(truth / cell(t, row, low)), 1.96 * error, 0.15 * 1.96 * error + 1e-6);
}

static void compare(double ratio, double sample_error, wt_materials_tables *tables)
{
    wt_rubber r[2] = {drawn(1, 3), drawn(ratio, 9)};
    const wt_compared_material two[] = {{.name = "first", .rubber = &r[0]},
                                        {.name = "second", .rubber = &r[1]}};
    wt_materials_job job = wt_materials_job_defaults();
    wt_error err = WT_ERROR_INIT;
    job.materials = two;
    job.n_materials = 2;
    job.sample_error = sample_error;
    if (wt_compare_materials(&job, &work, tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    for (size_t i = 0; i < 2; i++)
        forget(&r[i]);
}

static void test_tables(void **state)
{
    (void)state;
    static const double ratios[] = {1.5, 0.5}, sample_errors[] = {0, 0.03};
    for (size_t i = 0; i < 4; i++) {
        const double ratio = ratios[i / 2], sample = sample_errors[i % 2],
                     one = hypot(scatter, sample), both = one * M_SQRT2;
        wt_materials_tables tables = {0};
        compare(ratio, sample, &tables);
        const wt_table *m = tables.materials, *t = tables.material_ratio;
        const size_t n = wt_table_n_rows(m) / 2;
        assert_true(n > 10);
        for (size_t row = 0; row < 2 * n; row++) {
            const double of = row < n ? 1 : ratio, omega = cell(m, row, "angular_frequency");
            double storage, loss;
            moduli(omega, &storage, &loss);
            assert_string_equal(cell_text(m, row, "material"), row < n ? "first" : "second");
            assert_int_equal(wt_table_block(m, row), row / n);
            assert_near(omega, cell(m, row % n, "angular_frequency"), 1e-9);
            assert_near(cell(m, row, "storage_modulus"), of * storage, 1e-6);
            assert_near(cell(m, row, "loss_modulus"), of * loss, 1e-6);
            assert_near(cell(m, row, "loss_factor"), loss / storage, 1e-6);
            if (sample == 0) {
                check(m, row, "storage_modulus", of * storage, one);
                check(m, row, "loss_modulus", of * loss, one);
            }
            assert_near_abs(log(cell(m, row, "loss_factor_high") * storage / loss), 0, 1e-6);
        }
        for (size_t row = 0; row < wt_table_n_rows(t); row++) {
            assert_string_equal(cell_text(t, row, "material"), "second");
            assert_string_equal(cell_text(t, row, "over"), "frequency"); /* no law of shifts */
            assert_near(cell(t, row, "temperature"), 293.15, 1e-9);
            check(t, row, "storage_ratio", ratio, both);
            check(t, row, "loss_ratio", ratio, both);
            check(t, row, "loss_factor_ratio", 1, 0);
        }
        char words[160];
        snprintf(words, sizeof words,
                 "yes: second has %.3g times the E' and %.3g times the E'' of first; within the "
                 "margin: tan delta",
                 ratio, ratio);
        assert_string_equal(wt_table_key(t, "differs"), words);
        assert_null(wt_table_key(t, "settled_by"));
        assert_string_equal(wt_table_key(t, "first_material"), "first");
        assert_near(key_estimate(t, "temperature").value, 293.15, 0);
        assert_near(key_estimate(m, "temperature").value, 293.15, 0);
        assert_near(strtod(wt_table_key(t, "equivalence_margin"), NULL), 0.2, 0);
        wt_materials_tables_clear(&tables);
    }
}

/* Of three materials the third has no 10 Hz: the frequency over temperature is one that all have,
 * and each pair has rows over temperature. Without a common one the pair says so. */
static void test_one_frequency(void **state)
{
    (void)state;
    static const struct {
        double low, high; /* of the third material [rad/s] */
        bool common;
    } cases[] = {{1e3, 1e6, true}, {1e-1, 1e4, true}, {1e7, 1e8, false}};
    for (size_t c = 0; c < 3; c++) {
        wt_rubber r[3];
        sliding_set_up(NULL, 0);
        for (size_t i = 0; i < 3; i++) {
            r[i] = rubber;
            r[i].law = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293.15, 8.86, 101.6}};
            r[i].temperature_min = 283.15;
            r[i].temperature_max = 303.15;
        }
        r[1].prony.frequency_max = cases[c].common ? 1e8 : 1e5;
        r[0].prony.frequency_max = cases[c].common ? 1e8 : 2e7;
        r[2].prony.frequency_min = cases[c].low;
        r[2].prony.frequency_max = cases[c].high;
        const wt_compared_material three[] = {{.name = "first", .rubber = &r[0]},
                                              {.name = "second", .rubber = &r[1]},
                                              {.name = "third", .rubber = &r[2]}};
        wt_materials_job job = wt_materials_job_defaults();
        wt_materials_tables tables = {0};
        job.materials = three;
        job.n_materials = 3;
        assert_int_equal(wt_compare_materials(&job, &work, &tables, NULL), WT_OK);
        const wt_table *t = tables.material_ratio;
        size_t over[2] = {0, 0};
        for (size_t row = 0; row < wt_table_n_rows(t); row++)
            if (strcmp(cell_text(t, row, "over"), "temperature") == 0) {
                const bool third = strcmp(cell_text(t, row, "material"), "third") == 0;
                const double omega = cell(t, row, "angular_frequency");
                assert_true(omega >= cases[c].low && omega <= cases[c].high);
                over[third]++;
            }
        const char *outside = wt_table_key(t, "outside");
        if (cases[c].common) {
            assert_true(over[0] > 5 && over[1] > 5);
            if (c == 1) /* all have 10 Hz */
                assert_near(key_estimate(t, "angular_frequency").value, 20 * M_PI, 1e-9);
        } else {
            assert_int_equal(over[0] + over[1], 0);
            assert_non_null(strstr(outside, "second over temperature: "));
            assert_non_null(strstr(outside, "third over temperature: "));
        }
        wt_materials_tables_clear(&tables);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tables),
                                       cmocka_unit_test(test_one_frequency)};
    return cmocka_run_group_tests_name("tables of materials", tests, NULL, NULL);
}
