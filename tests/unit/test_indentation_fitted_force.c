/* Curves for viewing: the shown fit is the fitted law, also with adhesion. A named curve is found,
 * and the worst curves are the worst.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "synthetic_curve.h"
#include "table_cells.h"

#include "indentation/law/adhesion.h"
#include "weartrack/indentation.h"

#include <string.h>
#include <unistd.h>

#define CASE WT_SOURCE_DIR "/fixtures/case/"

static wt_formats *formats;

static wt_indent_job job_of(const wt_file_set *set, const char *tip)
{
    wt_indent_job job = wt_indent_job_defaults();
    job.sets = set;
    job.n_sets = 1;
    assert_int_equal(wt_tip_parse(tip, &job.tip, NULL), WT_OK);
    return job;
}

static wt_indent_tables fitted(const wt_indent_job *job)
{
    wt_job work = wt_job_defaults();
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    work.formats = formats;
    if (wt_indent_group(job, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s: %s", err.file, err.place, err.message);
    return tables;
}

/* Cantilever and adhesive contact in equilibrium, moved 300 nm beyond the contact. */
typedef struct scene {
    const char *tip;
    double modulus, work, spring, noise;
    bool constant_pull; /* what the fit finds: the force of a sphere hardly distinguishes both */
} scene;

static void write_adhesive(const scene *of, const char *path)
{
    enum { SAMPLES = 1500 };
    const double step = 0.4e-9, contact = 300e-9;
    wt_tip tip;
    wt_contact_table *table = NULL;
    uint64_t seed = 7;
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_int_equal(wt_tip_parse(of->tip, &tip, NULL), WT_OK);
    assert_int_equal(wt_contact_table_new(&tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    const adhesion law = {table, of->modulus / 0.75, of->work};
    const double release = adhesion_release(&law, of->spring);
    (void)fprintf(out,
                  "## table: force_curve/0\n## title: force curve\n## spring_constant: %g "
                  "standard_error=0 numerical_error=0 unit=N/m\n## curve: 0\n"
                  "# segment[text]\theight[m]\tforce[N]\n",
                  of->spring);
    for (int i = 0; i < SAMPLES; i++) {
        const double z = i * step - contact;
        double bare = 0, force = of->noise * curve_normal(&seed);
        if (z > 0) {
            adhesion_balance(&law, of->spring, release, &z, 1, &bare);
            force += adhesion_contact_value(&law, bare).force;
        }
        (void)fprintf(out, "approach\t%.12g\t%.12g\n", i * step, force);
    }
    (void)fputs("##\n", out);
    assert_int_equal(fclose(out), 0);
    wt_contact_table_free(table);
}

static void test_adhesion(void **state)
{
    (void)state;
    static const char *const file[] = {"shown-adhesive.tsv"}, *const all[] = {"all"};
    static const scene scenes[] = {
        {"pyramid:half-angle=35deg,radius=20nm", 5e6, 0.05, 0.5, 50e-12, false},
        {"paraboloid:radius=5um", 1e6, 2e-3, 1, 200e-12, true}};
    for (size_t k = 0; k < 2; k++) {
        write_adhesive(&scenes[k], file[0]);
        const wt_file_set set = {
            .patterns = file, .n_patterns = 1, .folder = NULL, .read = wt_read_defaults()};
        wt_indent_job job = job_of(&set, scenes[k].tip);
        job.curves = all;
        job.n_curves = 1;
        job.median_curve = true;
        wt_indent_tables tables = fitted(&job);
        assert_true(number_cell(tables.indentation, 0,
                                scenes[k].constant_pull ? "contact_pull" : "work_of_adhesion") > 0);
        const wt_table *const shown[] = {tables.curves, tables.force_indentation};
        for (size_t t = 0; t < 2; t++) {
            double squares = 0;
            size_t n = 0;
            for (size_t i = 0; i < wt_table_n_rows(shown[t]); i++) {
                const double left =
                    number_cell(shown[t], i, "force") - number_cell(shown[t], i, "fitted_force");
                if (!(number_cell(shown[t], i, "indentation") > 5e-9) || isnan(left))
                    continue;
                squares += left * left;
                n++;
            }
            assert_true(n > 50);
            /* at the measured indentation the noise is that of the force times 1 + stiffness over
             * spring constant; thinning keeps the extremes */
            if (!(sqrt(squares / (double)n) < 5 * scenes[k].noise))
                fail_msg("%s, table %zu: the fit is %g N off", scenes[k].tip, t,
                         sqrt(squares / (double)n));
        }
        wt_indent_tables_clear(&tables);
        assert_int_equal(unlink(file[0]), 0);
    }
}

/* The two with the largest relative errors, and one named by the end of its path. */
static void test_selected_curves(void **state)
{
    (void)state;
    static const char *const file[] = {CASE "bulk-1.jpk-force-map"};
    static const char *const words[] = {"worst:2", "case/bulk-1.jpk-force-map:7"};
    const wt_file_set set = {file, 1, NULL, wt_read_defaults(), NULL};
    wt_indent_job job = job_of(&set, "pyramid:half-angle=20deg,radius=20nm");
    job.curves = words;
    job.n_curves = 2;
    wt_indent_tables tables = fitted(&job);
    double error[12];
    bool shown[12] = {false};
    for (size_t i = 0; i < 12; i++)
        error[i] = number_cell(tables.indentation, i, "modulus_standard_error") /
                   number_cell(tables.indentation, i, "modulus");
    for (size_t i = 0; i < wt_table_n_rows(tables.curves); i++)
        shown[(size_t)number_cell(tables.curves, i, "curve")] = true;
    assert_true(shown[7]);
    size_t n = 0;
    for (size_t i = 0; i < 12; i++) {
        size_t worse = 0;
        for (size_t k = 0; k < 12; k++)
            worse += k != 7 && error[k] > error[i];
        if (i != 7)
            assert_int_equal(shown[i], worse < 2);
        n += shown[i];
    }
    assert_int_equal(n, 3);
    wt_indent_tables_clear(&tables);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_adhesion),
                                       cmocka_unit_test(test_selected_curves)};
    if (wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
        return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    wt_formats_free(formats);
    return failed;
}
