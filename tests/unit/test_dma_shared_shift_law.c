/* One law for samples of two known laws: every column and key of its table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "weartrack/dma.h"

/* log10 aT = -9 (T - 20) / (90 + T) and -12 (T - 20) / (120 + T), T in degrees Celsius. */
static const char file[] = WT_SOURCE_DIR "/fixtures/dma/two_materials.csv";
static const char *const names[] = {"NR", "SBR 10%", "gone"};
static const double c1[] = {9, 12}, c2[] = {110, 140};
static wt_formats *formats;
static wt_master_tables fitted[2];

static int fit(void **state)
{
    (void)state;
    const char *const patterns[] = {file};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job work = wt_job_defaults();
    if (wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
        return -1;
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    for (size_t i = 0; i < 2; i++) {
        set.read.sample = names[i];
        if (wt_master_compute(&job, &work, &fitted[i], NULL, NULL) != WT_OK)
            return -1;
    }
    return 0;
}

static int clean(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++)
        wt_master_tables_clear(&fitted[i]);
    wt_formats_free(formats);
    return 0;
}

static double wlf(double a, double b, double reference, double temperature)
{
    return -a * (temperature - reference) / (b + temperature - reference);
}

static double material_law(size_t sample, double temperature)
{
    return wlf(c1[sample], c2[sample], 293.15, temperature);
}

static wt_table *make(wt_shared_law_mode how, const wt_master *const *fits, size_t n, double margin)
{
    wt_shared_shift_law_job job = wt_shared_shift_law_job_defaults();
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    job.common = how;
    job.names = names;
    job.fits = fits;
    job.n = n;
    job.margin = margin;
    if (wt_shared_shift_law_compute(&job, &table, &err) != WT_OK)
        fail_msg("%s", err.message);
    return table;
}

/* Of each sample its isotherms, about the law of all. */
static void check_rows(const wt_table *t, bool moved)
{
    const double a = key_estimate(t, "wlf_c1").value, b = key_estimate(t, "wlf_c2").value,
                 reference = key_estimate(t, "reference_temperature").value;
    double furthest = 0;
    for (size_t first = 0, end = 0, s = 0; s < 2; s++, first = end) {
        double offset = 0;
        const double shift = moved ? cell(t, first, "moved") : 0;
        for (end = first;
             end < wt_table_n_rows(t) && strcmp(cell_text(t, end, "sample"), names[s]) == 0; end++)
            ;
        assert_int_equal(end - first, 6);
        double at_middle = (double)INFINITY;
        for (size_t i = first; i < end; i++) {
            const double temperature = cell(t, i, "temperature"),
                         law = wlf(a, b, reference + shift, temperature);
            assert_near(temperature, cell(fitted[s].shift_factors, i - first, "temperature"), 1e-9);
            assert_near_abs(cell(t, i, "law_log_a"), law, 0.02 + (moved ? 0.1 : 0));
            assert_true(cell(t, i, "law_log_a_low") <= cell(t, i, "law_log_a"));
            assert_true(cell(t, i, "law_log_a_high") >= cell(t, i, "law_log_a"));
            assert_true(cell(t, i, "log_a_standard_error") >= 0 &&
                        cell(t, i, "log_a_standard_error") < 0.05);
            offset += (cell(t, i, "log_a") - cell(fitted[s].shift_factors, i - first, "log_a")) / 6;
            const double low = cell(t, i, "difference_low"), high = cell(t, i, "difference_high");
            assert_true(low <= cell(t, i, "difference") && cell(t, i, "difference") <= high);
            furthest = fmax(furthest, fmax(fabs(low), fabs(high)));
            at_middle = fmin(at_middle, fabs(cell(t, i, "difference")));
        }
        /* the shifts are those of the sample, but for one step of all of them */
        for (size_t i = first; i < end; i++)
            assert_near_abs(cell(t, i, "log_a") - cell(fitted[s].shift_factors, i - first, "log_a"),
                            offset, 1e-9);
        /* how the own law falls against it between any two isotherms */
        for (size_t i = first + 1; i < end; i++) {
            const double from = cell(t, i - 1, "temperature"), to = cell(t, i, "temperature");
            assert_near_abs(cell(t, i, "difference") - cell(t, i - 1, "difference"),
                            material_law(s, to) - material_law(s, from) -
                                (cell(t, i, "law_log_a") - cell(t, i - 1, "law_log_a")),
                            0.03);
        }
        assert_true(at_middle < 0.35);
    }
    assert_near(key_estimate(t, "largest_deviation").value, furthest, 1e-9);
}

static void test_same(void **state)
{
    (void)state;
    const wt_master *const fits[] = {fitted[0].fit, fitted[1].fit, NULL};
    wt_table *t = make(WT_SHARED_LAW_SAME, fits, 3, 0.05);
    char words[160];
    assert_int_equal(wt_table_n_rows(t), 13); /* one for the sample without a fit */
    check_rows(t, false);
    assert_string_equal(wt_table_key(t, "law"), "WLF");
    assert_string_equal(wt_table_key(t, "margin"), "0.05");
    assert_near(key_estimate(t, "reference_temperature").value, 293.15, 1e-6);
    assert_int_equal(strncmp(wt_table_key(t, "agree"), "no: the samples have not one law (p ", 36),
                     0);
    snprintf(words, sizeof words, "that of SBR 10%% is off by up to %.2g decade",
             key_estimate(t, "largest_deviation").value);
    assert_non_null(strstr(wt_table_key(t, "agree"), words));
    assert_true(atof(wt_table_key(t, "p")) < 0.05);
    assert_null(wt_table_key(t, "settled_by"));
    /* between the two laws */
    const wt_estimate a = key_estimate(t, "wlf_c1"), b = key_estimate(t, "wlf_c2");
    assert_true(a.value > 8.5 && a.value < 12.5 && a.standard_error > 0);
    assert_true(b.value > 100 && b.value < 150 && b.standard_error > a.standard_error);
    assert_true(atof(wt_table_key(t, "wlf_correlation")) > 0.5);
    snprintf(words, sizeof words, "wlf:reference-temperature=20degC,c1=%.6g,c2=%.6gK", a.value,
             b.value);
    assert_string_equal(wt_table_key(t, "shift_law"), words);
    assert_string_equal(wt_table_key(t, "sample_shifts"), "NR 20.00 °C, SBR 10% 20.00 °C");
    assert_int_equal(strncmp(wt_table_key(t, "left_out"), "gone: ", 6), 0);
    assert_string_equal(cell_text(t, 12, "sample"), "gone");
    assert_non_null(strstr(wt_table_key(t, "left_out"), cell_text(t, 12, "note")));
    assert_true(isnan(cell(t, 12, "temperature")));
    assert_true(key_estimate(t, "temperature_spread").value > 0);
    wt_table_free(t);
    /* a margin that is wider than the difference */
    t = make(WT_SHARED_LAW_SAME, fits, 2, 9);
    snprintf(words, sizeof words, "yes: the laws of the samples are one within 9 decade");
    assert_int_equal(strncmp(wt_table_key(t, "agree"), words, strlen(words)), 0);
    assert_non_null(strstr(wt_table_key(t, "agree"), "they differ by more than their errors"));
    assert_null(wt_table_key(t, "left_out"));
    wt_table_free(t);
}

/* A sample against itself has one law, and both together know it better. */
static void test_twice(void **state)
{
    (void)state;
    const wt_master *const fits[] = {fitted[0].fit, fitted[0].fit};
    wt_table *t = make(WT_SHARED_LAW_SAME, fits, 2, 0.5);
    const wt_estimate a = key_estimate(t, "wlf_c1"), b = key_estimate(t, "wlf_c2"),
                      own = key_estimate(fitted[0].shift_factors, "wlf_c1");
    assert_near_abs(a.value, c1[0], 4 * a.standard_error);
    assert_near_abs(b.value, c2[0], 4 * b.standard_error);
    assert_true(a.standard_error < own.standard_error);
    assert_int_equal(strncmp(wt_table_key(t, "agree"), "yes: ", 5), 0);
    assert_true(atof(wt_table_key(t, "p")) > 0.5);
    for (size_t i = 0; i < wt_table_n_rows(t); i++)
        assert_near_abs(cell(t, i, "difference"), 0, 0.02);
    wt_table_free(t);
}

/* Each sample moved along the temperature: the first is the one that the others are moved from. */
static void test_moved(void **state)
{
    (void)state;
    const wt_master *const fits[] = {fitted[0].fit, fitted[1].fit};
    wt_table *t = make(WT_SHARED_LAW_SHIFTED, fits, 2, 0.1);
    char words[320];
    check_rows(t, true);
    const double moved = cell(t, 6, "moved"), error = cell(t, 6, "moved_standard_error"),
                 a = key_estimate(t, "wlf_c1").value, b = key_estimate(t, "wlf_c2").value;
    assert_near(cell(t, 0, "moved"), 0, 0);
    assert_true(error > 0 && fabs(moved) > 0.1);
    snprintf(words, sizeof words, "NR 20.00 °C, SBR 10%% %.2f °C ± %.2g K", 20 + moved, error);
    assert_string_equal(wt_table_key(t, "sample_shifts"), words);
    snprintf(words, sizeof words,
             "NR wlf:reference-temperature=20degC,c1=%.6g,c2=%.6gK; SBR 10%% "
             "wlf:reference-temperature=%.6gdegC,c1=%.6g,c2=%.6gK",
             a, b, 20 + moved, a, b);
    assert_string_equal(wt_table_key(t, "shift_law"), words);
    assert_true(strstr(wt_table_key(t, "agree"), ", moved along the temperature") != NULL ||
                strncmp(wt_table_key(t, "agree"), "inconclusive", 12) == 0);
    wt_table_free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same), cmocka_unit_test(test_twice),
                                       cmocka_unit_test(test_moved)};
    return cmocka_run_group_tests_name("one law for samples", tests, fit, clean);
}
