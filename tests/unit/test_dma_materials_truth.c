/* Materials side by side: isotherms of two rubbers whose spectra, laws and scales are known, so
 * that every ratio is. How often the interval holds it: `unit_dma_materials_truth N` draws N pairs
 * and prints the shares. SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "truth.h"

#include "dma_data.h"
#include "weartrack/dma.h"

enum { ISOTHERMS = 9, POINTS = 13, QUANTITIES = 3 };

#define REFERENCE 293.15

/* One spectrum, moved and scaled, with a law of its own; the moduli follow rho T. */
typedef struct rubber_truth {
    double scale, faster, c1, c2;
    double first, step; /* temperatures [K] */
} rubber_truth;

static const rubber_truth first_rubber = {1, 1, 8, 110, 258.15, 10};
static const rubber_truth second_rubber = {1.5, 4, 9, 130, 253.15, 10};

static double log_a_of(const rubber_truth *r, double temperature)
{
    const double step = temperature - REFERENCE;
    return -r->c1 * step / (r->c2 + step);
}

/* E', E'' and tan delta. */
static void moduli_of(const rubber_truth *r, double temperature, double omega, double x[QUANTITIES])
{
    dma_moduli(&dma_rubber, omega * r->faster * pow(10, log_a_of(r, temperature)), &x[0], &x[1]);
    x[0] *= r->scale * temperature / REFERENCE;
    x[1] *= r->scale * temperature / REFERENCE;
    x[2] = x[1] / x[0];
}

/* The sweeps of a rubber, each oven temperature off by a normal `spread` [K]. */
static void fit_rubber(const rubber_truth *r, size_t n, double noise, double spread, uint64_t *seed,
                       wt_master_tables *tables, wt_rubber *rubber)
{
    char path[] = "/tmp/weartrack-materials-XXXXXX";
    const char *const patterns[] = {path};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    FILE *out = truth_file(path);
    fputs("## table: sweep\n# angular_frequency[rad/s]\tstorage_modulus[Pa]\tloss_modulus[Pa]\t"
          "temperature[K]\n",
          out);
    for (size_t i = 0; i < n; i++) {
        const double t = r->first + r->step * (double)i, truly = t + spread * truth_normal(seed);
        for (int k = 0; k < POINTS; k++) {
            double omega = pow(10, -1 + 3.0 * k / (POINTS - 1)), x[QUANTITIES];
            moduli_of(r, truly, omega, x);
            fprintf(out, "%.17g\t%.17g\t%.17g\t%.17g\n", omega,
                    x[0] * exp(noise * truth_normal(seed)), x[1] * exp(noise * truth_normal(seed)),
                    t);
        }
        fputs(i + 1 < n ? "\n" : "##\n", out);
    }
    fclose(out);
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_master_compute(&job, &common, tables, rubber, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    unlink(path);
}

typedef struct made_pair {
    wt_master_tables tables[2];
    wt_rubber rubber[2];
    wt_compared_material compared[2];
    wt_materials_tables made;
} made_pair;

static void pair_clear(made_pair *p)
{
    for (int k = 0; k < 2; k++) {
        wt_master_tables_clear(&p->tables[k]);
        wt_rubber_clear(&p->rubber[k]);
    }
    wt_materials_tables_clear(&p->made);
}

static void pair_fit(const rubber_truth *first, const rubber_truth *second, double noise,
                     double spread, uint64_t seed, made_pair *p)
{
    static const char *const names[2] = {"first", "second"};
    const rubber_truth *const truth[2] = {first, second};
    *p = (made_pair){.made = {.materials = NULL}};
    for (int k = 0; k < 2; k++) {
        fit_rubber(truth[k], ISOTHERMS, noise, spread, &seed, &p->tables[k], &p->rubber[k]);
        p->compared[k] = (wt_compared_material){
            .name = names[k], .rubber = &p->rubber[k], .shift_factors = p->tables[k].shift_factors};
    }
}

static wt_status pair_compare(made_pair *p, wt_materials_job job, wt_error *err)
{
    const wt_job work = wt_job_defaults();
    job.materials = p->compared;
    job.n_materials = 2;
    wt_materials_tables_clear(&p->made);
    return wt_compare_materials(&job, &work, &p->made, err);
}

/* ---- coverage -------------------------------------------------------------------------------- */

static const char *const ratio_names[QUANTITIES] = {"storage_ratio", "loss_ratio",
                                                    "loss_factor_ratio"};

typedef struct share {
    size_t n, held;
    double width; /* sum of ln high - ln low */
} share;

static void count_row(const wt_table *t, size_t row, share shares[QUANTITIES])
{
    double a[QUANTITIES], b[QUANTITIES];
    const double temperature = cell(t, row, "temperature"),
                 omega = cell(t, row, "angular_frequency");
    moduli_of(&first_rubber, temperature, omega, a);
    moduli_of(&second_rubber, temperature, omega, b);
    for (int q = 0; q < QUANTITIES; q++) {
        char low[64], high[64];
        snprintf(low, sizeof low, "%s_low", ratio_names[q]);
        snprintf(high, sizeof high, "%s_high", ratio_names[q]);
        const double truth = b[q] / a[q];
        shares[q].n++;
        shares[q].held += cell(t, row, low) <= truth && truth <= cell(t, row, high);
        shares[q].width += log(cell(t, row, high) / cell(t, row, low));
    }
}

/* Rows of the ends, quarters and the middle of the block of frequencies, and of temperatures. */
static void count_pair(const wt_table *t, share shares[2][QUANTITIES])
{
    size_t n[2] = {0, 0};
    for (size_t row = 0; row < wt_table_n_rows(t); row++)
        n[strcmp(cell_text(t, row, "over"), "temperature") == 0]++;
    for (int over = 0; over < 2; over++)
        for (int part = 0; part <= 4 && n[over] > 0; part++)
            count_row(t, (over > 0 ? n[0] : 0) + (n[over] - 1) * (size_t)part / 4, shares[over]);
}

static void draw_pairs(size_t n, double noise, double spread, share shares[2][QUANTITIES],
                       size_t verdicts[3])
{
    for (size_t i = 0; i < n; i++) {
        made_pair p;
        wt_error err = WT_ERROR_INIT;
        pair_fit(&first_rubber, &second_rubber, noise, spread, 1000 + 7919 * i, &p);
        if (pair_compare(&p, wt_materials_job_defaults(), &err) != WT_OK)
            fail_msg("%s %s", err.message, err.found);
        count_pair(p.made.material_ratio, shares);
        const char *differs = wt_table_key(p.made.material_ratio, "differs");
        verdicts[differs[0] == 'y' ? 0 : differs[0] == 'n' ? 1 : 2]++;
        pair_clear(&p);
    }
}

static void test_the_interval_holds_the_truth(void **state)
{
    (void)state;
    enum { PAIRS = 12 };
    share shares[2][QUANTITIES] = {{{0}}};
    size_t verdicts[3] = {0};
    draw_pairs(PAIRS, 0.01, 0.1, shares, verdicts);
    for (int over = 0; over < 2; over++)
        for (int q = 0; q < QUANTITIES; q++) {
            const share *s = &shares[over][q];
            const double of = (double)s->held / (double)s->n;
            if (s->n != 5 * PAIRS || of < 0.8)
                fail_msg("%s: held in %zu of %zu", ratio_names[q], s->held, s->n);
            assert_true(s->width / (double)s->n < 0.2);
        }
    assert_int_equal(verdicts[0], PAIRS);
}

/* ---- verdicts -------------------------------------------------------------------------------- */

static void test_one_rubber_twice(void **state)
{
    (void)state;
    made_pair p;
    wt_materials_job job = wt_materials_job_defaults();
    pair_fit(&first_rubber, &first_rubber, 0.003, 0, 7, &p);
    assert_int_equal(pair_compare(&p, job, NULL), WT_OK);
    assert_int_equal(strncmp(wt_table_key(p.made.material_ratio, "differs"), "no: ", 4), 0);
    assert_null(wt_table_key(p.made.material_ratio, "settled_by"));
    /* a margin below the interval, which is wide by the dimensions of the samples */
    job.margin = 0.05;
    job.sample_error = 0.1;
    assert_int_equal(pair_compare(&p, job, NULL), WT_OK);
    const wt_table *t = p.made.material_ratio;
    assert_int_equal(strncmp(wt_table_key(t, "differs"), "inconclusive: ", 14), 0);
    assert_non_null(strstr(wt_table_key(t, "settled_by"), "sample-error"));
    assert_non_null(strstr(wt_table_key(t, "interval_includes"), "dimensions of the samples"));
    /* both samples: 0.1 sqrt 2; tan delta knows nothing of them */
    assert_near(log(cell(t, 3, "storage_ratio_high") / cell(t, 3, "storage_ratio_low")),
                2 * 1.96 * 0.1414, 0.05);
    assert_true(log(cell(t, 3, "loss_factor_ratio_high") / cell(t, 3, "loss_factor_ratio_low")) <
                0.1);
    pair_clear(&p);
}

/* Without draws nobody knows the error: a ratio, no interval, no verdict. */
static void test_without_errors(void **state)
{
    (void)state;
    made_pair p;
    wt_rubber bare = {0};
    pair_fit(&first_rubber, &second_rubber, 0.003, 0, 6, &p);
    const wt_rubber_tables of = {.prony = p.tables[1].prony,
                                 .shift_factors = p.tables[1].shift_factors};
    assert_int_equal(wt_rubber_from_tables(&of, 0.5, &bare, NULL), WT_OK);
    p.compared[1].rubber = &bare;
    assert_int_equal(pair_compare(&p, wt_materials_job_defaults(), NULL), WT_OK);
    const wt_table *t = p.made.material_ratio;
    assert_string_equal(wt_table_key(t, "differs"),
                        "inconclusive: the error of second is not known");
    assert_non_null(strstr(wt_table_key(t, "settled_by"), "the isotherms of second"));
    assert_null(wt_table_key(t, "interval_includes"));
    assert_true(cell(t, 0, "storage_ratio") > 1 && isnan(cell(t, 0, "storage_ratio_low")));
    wt_rubber_clear(&bare);
    pair_clear(&p);
}

/* ---- what is compared ------------------------------------------------------------------------ */

static void test_common_range(void **state)
{
    (void)state;
    made_pair p;
    pair_fit(&first_rubber, &second_rubber, 0.003, 0, 7, &p);
    assert_int_equal(pair_compare(&p, wt_materials_job_defaults(), NULL), WT_OK);
    const wt_table *t = p.made.material_ratio, *m = p.made.materials;
    const double at = key_estimate(t, "temperature").value;
    assert_near(at, p.rubber[0].prony.reference_temperature, 0);
    assert_near(key_estimate(t, "angular_frequency").value, 62.83185307, 1e-8);
    assert_string_equal(wt_table_key(t, "first_material"), "first");
    assert_non_null(strstr(wt_table_key(t, "outside"), "second below -15.0 °C"));
    assert_non_null(strstr(wt_table_key(t, "outside"), "first above 60.0 °C"));
    double low = 0, high = (double)INFINITY;
    const rubber_truth *const truth[2] = {&first_rubber, &second_rubber};
    for (int k = 0; k < 2; k++) {
        const double coldest = truth[k]->first,
                     warmest = coldest + truth[k]->step * (ISOTHERMS - 1);
        low = fmax(low, 0.1 * pow(10, log_a_of(truth[k], warmest) - log_a_of(truth[k], at)));
        high = fmin(high, 100 * pow(10, log_a_of(truth[k], coldest) - log_a_of(truth[k], at)));
    }
    assert_near(cell(t, 0, "angular_frequency"), low, 0.1);
    size_t n = 0;
    for (size_t row = 0; row < wt_table_n_rows(t); row++) {
        if (strcmp(cell_text(t, row, "over"), "frequency") == 0) {
            n++;
            assert_near(cell(t, row, "temperature"), at, 0);
            assert_true(cell(t, row, "angular_frequency") < 1.1 * high);
        } else {
            assert_near(cell(t, row, "angular_frequency"), 62.83185307, 1e-8);
            assert_true(cell(t, row, "temperature") >= 258.1 &&
                        cell(t, row, "temperature") < 333.2);
        }
    }
    assert_true(n > 20 && wt_table_n_rows(t) == n + 25);
    /* each over its own range, and right */
    for (size_t row = 0; row < wt_table_n_rows(m); row++) {
        double x[QUANTITIES];
        const bool second = strcmp(cell_text(m, row, "material"), "second") == 0;
        assert_int_equal(wt_table_block(m, row), second);
        moduli_of(truth[second], at, cell(m, row, "angular_frequency"), x);
        assert_near(cell(m, row, "storage_modulus"), x[0], 0.05);
        assert_near(cell(m, row, "loss_modulus"), x[1], 0.05);
        assert_near(cell(m, row, "loss_factor"), x[2], 0.05);
        assert_true(cell(m, row, "loss_factor_low") < cell(m, row, "loss_factor_high"));
    }
    pair_clear(&p);
}

static void test_where_it_is_asked_for(void **state)
{
    (void)state;
    made_pair p;
    wt_error err = WT_ERROR_INIT;
    wt_materials_job job = wt_materials_job_defaults();
    pair_fit(&first_rubber, &second_rubber, 0.003, 0, 8, &p);
    job.temperature = 303.15;
    job.frequency = 20;
    assert_int_equal(pair_compare(&p, job, NULL), WT_OK);
    assert_near(cell(p.made.material_ratio, 0, "temperature"), 303.15, 0);
    assert_near(key_estimate(p.made.material_ratio, "angular_frequency").value, 20, 0);
    job.temperature = 253.15; /* the second alone */
    assert_int_equal(pair_compare(&p, job, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "at-temperature"));
    assert_string_equal(err.expected, "-15.0 to 60.0 °C");
    pair_clear(&p);
}

/* One isotherm has no law: at its temperature only, or not at all. */
static void test_without_a_law(void **state)
{
    (void)state;
    static const double where[] = {288.15, 400};
    for (int i = 0; i < 2; i++) {
        made_pair p;
        wt_error err = WT_ERROR_INIT;
        rubber_truth single = second_rubber;
        uint64_t seed = 9;
        pair_fit(&first_rubber, &second_rubber, 0.003, 0, 9, &p);
        wt_master_tables_clear(&p.tables[1]);
        wt_rubber_clear(&p.rubber[1]);
        single.first = where[i];
        fit_rubber(&single, 1, 0.003, 0, &seed, &p.tables[1], &p.rubber[1]);
        p.compared[1].shift_factors = p.tables[1].shift_factors;
        const wt_status status = pair_compare(&p, wt_materials_job_defaults(), &err);
        if (i == 0) {
            const wt_table *t = p.made.material_ratio;
            assert_int_equal(status, WT_OK);
            assert_near_abs(cell(t, 0, "temperature"), 288.15, 1);
            for (size_t row = 0; row < wt_table_n_rows(t); row++)
                assert_string_equal(cell_text(t, row, "over"), "frequency");
            assert_non_null(strstr(wt_table_key(t, "outside"), "second has no shift law"));
        } else {
            assert_int_equal(status, WT_E_RANGE);
            assert_non_null(strstr(err.message, "no temperature in common"));
            assert_non_null(strstr(err.found, "first: -15.0 to 65.0 °C; second: "));
        }
        pair_clear(&p);
    }
}

/* ---- main ------------------------------------------------------------------------------------ */

static int print_coverage(size_t n)
{
    static const double scenes[][2] = {{0.01, 0}, {0.01, 0.1}, {0.003, 0.3}, {0.03, 0}};
    static const char *const over[] = {"frequency", "temperature"};
    if (open_formats(NULL) != 0)
        return 1;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        share shares[2][QUANTITIES] = {{{0}}};
        size_t verdicts[3] = {0};
        draw_pairs(n, scenes[k][0], scenes[k][1], shares, verdicts);
        printf("noise %g, %g K: yes %zu, no %zu, inconclusive %zu\n", scenes[k][0], scenes[k][1],
               verdicts[0], verdicts[1], verdicts[2]);
        for (int o = 0; o < 2; o++)
            for (int q = 0; q < QUANTITIES; q++)
                printf("  over %s, %s: %.1f %% of %zu, half width %.2f %%\n", over[o],
                       ratio_names[q], 100.0 * (double)shares[o][q].held / (double)shares[o][q].n,
                       shares[o][q].n, 50 * shares[o][q].width / (double)shares[o][q].n);
        fflush(stdout);
    }
    return free_formats(NULL);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_interval_holds_the_truth),
        cmocka_unit_test(test_one_rubber_twice),
        cmocka_unit_test(test_without_errors),
        cmocka_unit_test(test_common_range),
        cmocka_unit_test(test_where_it_is_asked_for),
        cmocka_unit_test(test_without_a_law),
    };
    if (argc > 1)
        return print_coverage(strtoul(argv[1], NULL, 10));
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
