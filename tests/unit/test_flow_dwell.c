/* Dwells: the power law against a hereditary integral summed step by step, files by an independent
 * writer, what is left out.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"

#include "dma_data.h"
#include "weartrack/flow.h"
#include "writers/jpk_writer.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { POINTS = 30, STEPS = 20000 };

/* Held value `power` of time, loaded over `load`: sum of what each step of the loading left. */
static double summed(double exponent, double power, double load, double t, bool creep)
{
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double a = load * i / STEPS, b = load * (i + 1) / STEPS;
        const double step = pow(b / load, power) - pow(a / load, power);
        const double since = t - 0.5 * (a + b);
        sum += step * (creep ? pow(since, exponent) / (tgamma(1 + exponent) * tgamma(1 - exponent))
                             : pow(since, -exponent));
    }
    return creep ? 1 / sum : sum;
}

static void test_law(void **state)
{
    (void)state;
    static const double exponents[] = {0.03, 0.15, 0.4};
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++)
        for (int creep = 0; creep < 2; creep++) {
            const double n = exponents[k], load = 0.3, power = creep ? 2 : 1.5;
            double time[POINTS], modulus[POINTS];
            wt_dwell law;
            for (int i = 0; i < POINTS; i++) {
                time[i] = load + 0.01 * pow(300, (double)i / (POINTS - 1));
                modulus[i] = 2e6 * summed(n, power, load, time[i], creep);
                assert_near(wt_dwell_modulus(2e6, n, time[i], load, power, creep), modulus[i],
                            1e-4);
            }
            assert_int_equal(wt_dwell_fit(time, modulus, POINTS, load, power, creep, &law, NULL),
                             WT_OK);
            assert_true(law.found);
            assert_near_abs(law.exponent, n, 1e-3);
            assert_near(law.modulus, 2e6, 2e-3);
            assert_true(law.misfit < 1e-3);
        }
}

/* A loading in proportion to time: tau^(1-n) - (tau-1)^(1-n) over 1-n, to the end of the loading,
 * where the rubber has had no time for what came last. */
static void test_steep(void **state)
{
    (void)state;
    static const double exponents[] = {0.1, 0.6, 0.9}, since[] = {0, 1e-6, 1e-3, 1, 1e3};
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++)
        for (size_t k = 0; k < sizeof since / sizeof *since; k++) {
            const double n = exponents[i], m = 1 - n, tau = 1 + since[k];
            assert_near(wt_dwell_modulus(1, n, tau, 1, 1, false),
                        (pow(tau, m) - pow(since[k], m)) / m, 1e-9);
            assert_near(wt_dwell_modulus(1, n, tau, 1, 1, true),
                        tgamma(1 + n) * tgamma(m) * (1 + n) /
                            (pow(tau, 1 + n) - pow(since[k], 1 + n)),
                        1e-9);
        }
}

static void test_no_law(void **state)
{
    (void)state;
    enum { FEW = 6 };
    static const struct {
        double first_time, last_modulus, power, fall;
        const char *why;
    } cases[] = {{1, 1, 1.5, 0.2, ""},
                 {1, 1, 1 - 1e-12, 0.2, ""}, /* a punch, as rounding leaves it */
                 {1, 1, 1.5, 1.5, "falls faster than any power law of rubber"},
                 {0.1, 1, 1.5, 0.2, "a point from before the end of the loading, or from no time"},
                 {1, (double)INFINITY, 1.5, 0.2, "a modulus that is no positive number"},
                 {1, 0, 1.5, 0.2, "a modulus that is no positive number"},
                 {1, 1, (double)NAN, 0.2, "no loading that force and time tell"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double time[FEW], modulus[FEW];
        wt_dwell law;
        for (int i = 0; i < FEW; i++) {
            time[i] = i == 0 ? cases[k].first_time : i + 1;
            modulus[i] =
                1e6 * pow(i + 1, -cases[k].fall) * (i == FEW - 1 ? cases[k].last_modulus : 1);
        }
        assert_int_equal(wt_dwell_fit(time, modulus, FEW, 0.3, cases[k].power, false, &law, NULL),
                         WT_OK);
        assert_string_equal(law.why_not, cases[k].why);
        assert_int_equal(law.found, cases[k].why[0] == '\0');
        assert_int_equal(isnan(law.exponent), !law.found);
    }
}

/* ---- files ----------------------------------------------------------------------------------- */

enum { N = 600, CURVES = 6, FREE = 300 };
static const double radius = 5e-6, depth = 400e-9, load_time = 0.2, hold = 4, exponent = 0.12,
                    modulus = 1e6, lever = 5000;
static double height[CURVES][2][N], force[CURVES][2][N];
static wt_formats *formats;

static double force_at(double t)
{
    const double g = 4.0 / 3 * sqrt(radius) * pow(depth, 1.5) / 0.75;
    if (t <= 0)
        return 0;
    if (t >= load_time)
        return modulus * g * summed(exponent, 1.5, load_time, t, false);
    return modulus * g * pow(t / load_time, 1.5) * summed(exponent, 1.5, t, t * (1 + 1e-9), false);
}

static void write_map(const char *path, uint64_t *seed)
{
    static jpk_writer_segment segments[CURVES][2];
    static jpk_writer_curve curves[CURVES];
    static double known[2][N];
    jpk_writer_file file = jpk_writer_defaults();
    const double step = load_time / (N - FREE);
    for (size_t k = 0; k < N; k++) {
        known[0][k] = force_at(step * ((double)k + 1 - FREE));
        known[1][k] = force_at(load_time + hold * ((double)k + 1) / N);
    }
    for (size_t i = 0; i < CURVES; i++) {
        const double own = exp(0.05 * dma_normal(seed));
        for (size_t k = 0; k < N; k++) {
            const double at = depth * ((double)k + 1 - FREE) / (N - FREE);
            for (int s = 0; s < 2; s++)
                force[i][s][k] = own * known[s][k] + 0.002 * known[0][N - 1] * dma_normal(seed);
            height[i][0][k] = 6e-6 - at - own * known[0][k] / lever;
            height[i][1][k] = 6e-6 - depth - own * known[0][N - 1] / lever;
        }
        segments[i][0] =
            (jpk_writer_segment){"extend", N, step * N, height[i][0], force[i][0], NULL};
        segments[i][1] = (jpk_writer_segment){"pause", N, hold, height[i][1], force[i][1], NULL};
        curves[i] = (jpk_writer_curve){i, 0, 0, 2, segments[i]};
    }
    file.path = path;
    file.map = true;
    file.n_curves = CURVES;
    file.curves = curves;
    file.spring_constant = lever;
    file.sensitivity = 50e-9;
    assert_int_equal(jpk_write(&file), 0);
}

static wt_status make(const char *path, wt_tip tip, wt_dwell_tables *tables, wt_error *err)
{
    const char *const paths[] = {path};
    const wt_file_set set = {.patterns = paths, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.tip = tip;
    return wt_dwell_make(&job, &work, tables, err);
}

static void test_relaxation(void **state)
{
    (void)state;
    static const char path[] = "test_dwell.jpk-force-map";
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = radius};
    wt_dwell_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    wt_estimate n = {0}, e = {0};
    uint64_t seed = 8;
    write_map(path, &seed);
    if (make(path, tip, &t, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    assert_int_equal(wt_table_n_rows(t.dwell), CURVES);
    for (size_t i = 0; i < CURVES; i++)
        assert_string_equal(wt_table_text(t.dwell, i, (size_t)wt_table_find(t.dwell, "kind")),
                            "relaxation");
    assert_true(wt_table_estimate(t.dwell, "exponent", &n));
    assert_true(wt_table_estimate(t.dwell, "modulus_1s", &e));
    print_message("exponent %g +- %g, modulus %g +- %g\n", n.value, n.standard_error, e.value,
                  e.standard_error);
    assert_near(n.value, exponent, 0.005);
    assert_near(e.value, modulus, 0.03);
    wt_dwell_tables_clear(&t);
    (void)remove(path);
    assert_int_equal(make(WT_SOURCE_DIR "/fixtures/case/bulk-1.jpk-force-map", tip, &t, &err),
                     WT_E_EMPTY);
    assert_string_equal(err.message, "no curve dwells behind its approach");
}

/* A pause of 3 s on a gel. */
static void test_genuine(void **state)
{
    (void)state;
    static const char path[] =
        WT_SHARED_DIR "/data/afm/jpk/fmt-jpk-cc_pr14-polymergel-2021.06.30.jpk-force";
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
    wt_dwell_tables t = {0};
    if (access(path, R_OK) != 0)
        skip();
    assert_int_equal(make(path, tip, &t, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(t.dwell), 1);
    wt_dwell_tables_clear(&t);
}

static int open_formats(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int free_formats(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_law), cmocka_unit_test(test_steep), cmocka_unit_test(test_no_law),
        cmocka_unit_test(test_relaxation), cmocka_unit_test(test_genuine)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
