/* The interval of a group includes errors shared by all its curves, stated or assumed. The groups
 * have another radius than stated, or a rubber with one relaxation time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "indentation/indent.h"
#include "indentation/numerics/curve.h"
#include "weartrack/study.h"

enum { SPOTS = 4, DRAWS = 40 };
/* Relative scatter of the positions. */
static const double scatter = 0.01;

static char paths[SPOTS][32];
static wt_formats *formats;

typedef struct group_result {
    double mean, low, high;
} group_result;

static void write_group(double factor, uint64_t *state)
{
    for (int s = 0; s < SPOTS; s++) {
        hertz h = hertz_standard();
        h.modulus *= factor * exp(scatter * truth_normal(state));
        h.seed = *state + (uint64_t)s;
        strcpy(paths[s], "/tmp/weartrack-group-XXXXXX");
        FILE *out = truth_file(paths[s]);
        hertz_write(out, &h, 0);
        fclose(out);
    }
}

/* Fits the files as one group and tests that both tables have the same interval. */
static group_result fit_group(const wt_indent_job *settings, wt_table **indentation)
{
    const char *patterns[SPOTS];
    wt_indent_tables tables = {0};
    wt_job common = wt_job_defaults();
    wt_indent_job job = *settings;
    wt_error err = WT_ERROR_INIT;
    wt_table *groups = NULL, *budget = NULL;
    for (int s = 0; s < SPOTS; s++)
        patterns[s] = paths[s];
    const wt_file_set set = {.patterns = patterns, .n_patterns = SPOTS, .read = wt_read_defaults()};
    job.sets = &set;
    job.n_sets = 1;
    common.formats = formats;
    common.threads = 1;
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s: %s", err.place, err.message);
    const wt_table *const listed[] = {tables.indentation};
    assert_int_equal(wt_modulus_groups_table(listed, 1, &groups, NULL), WT_OK);
    assert_int_equal(wt_modulus_budget_table(listed, 1, &budget, NULL), WT_OK);
    const group_result found = {cell(groups, 0, "geometric_mean"), cell(groups, 0, "low"),
                                cell(groups, 0, "high")};
    assert_near(key_estimate(budget, "low_bulk").value, found.low, 1e-12);
    assert_near(key_estimate(budget, "high_bulk").value, found.high, 1e-12);
    wt_table_free(groups);
    wt_table_free(budget);
    if (indentation != NULL) {
        *indentation = tables.indentation;
        tables.indentation = NULL;
    }
    wt_indent_tables_clear(&tables);
    for (int s = 0; s < SPOTS; s++)
        unlink(paths[s]);
    return found;
}

static wt_indent_job settings_of(const char *tip)
{
    wt_indent_job job = wt_indent_job_defaults();
    assert_int_equal(wt_tip_parse(tip, &job.tip, NULL), WT_OK);
    return job;
}

/* States small errors of all that a job states but the tip. */
static void state_small_errors(wt_indent_job *job)
{
    job->lever_error = job->sensitivity_error = 0.001;
    job->piezo_error = job->detector_error = 0.001;
    job->thick_sample = true;
}

/* A paraboloid of another radius has the force of another modulus, by the root of the ratio, and no
 * residual shows it. The assumed error of the radius covers radii with a normal error of 10 %; the
 * others are stated as small. */
static void test_radius(void **state)
{
    (void)state;
    uint64_t random = 20261129;
    wt_indent_job job = settings_of(HERTZ_TIP);
    state_small_errors(&job);
    int covered = 0, n_wide = 0;
    for (int i = 0; i < DRAWS; i++) {
        const double radius = 1 + 0.1 * truth_normal(&random);
        write_group(sqrt(radius), &random);
        const group_result g = fit_group(&job, NULL);
        covered += g.low < hertz_standard().modulus && hertz_standard().modulus < g.high;
        n_wide += log(g.high / g.low) > 4 * 0.06;
    }
    assert_true(covered >= 36);
    assert_int_equal(n_wide, 0); /* curves of the right law have no error by the fit range */
}

/* A stated error replaces an assumed one. */
static void test_stated(void **state)
{
    (void)state;
    uint64_t random = 7;
    wt_table *t = NULL;
    wt_indent_job job = settings_of(HERTZ_TIP);
    write_group(1, &random);
    const group_result assumed = fit_group(&job, &t);
    assert_near(key_estimate(t, "radius_error_assumed").value, 0.1, 1e-12);
    assert_near(key_estimate(t, "spring_constant_error_assumed").value, 0.1, 1e-12);
    assert_near(key_estimate(t, "spring_constant_gain").value, 1, 1e-12);
    assert_near(key_estimate(t, "radius_gain").value, -0.5, 0.01);
    assert_non_null(
        strstr(wt_table_key(t, "assumed_errors"), "10 % of the radius of the tip (5 % of E)"));
    wt_table_free(t);
    job = settings_of(HERTZ_TIP "+-1%");
    state_small_errors(&job);
    random = 7;
    write_group(1, &random);
    const group_result stated = fit_group(&job, &t);
    assert_null(wt_table_key(t, "assumed_errors"));
    assert_null(wt_table_key(t, "radius_error_assumed"));
    assert_true(log(stated.high / stated.low) < 0.5 * log(assumed.high / assumed.low));
    wt_table_free(t);
}

/* Forces of a paraboloid on a rubber with one relaxation time, of which seven tenths relax, and a
 * rigid cantilever: E(t) = soft + fading exp(-t/time). */
static void write_relaxing(double time)
{
    enum { N = 600 };
    const double soft = 1.5e6, fading = 3.5e6, step = 0.2 / N, depth = 500e-9;
    for (int s = 0; s < SPOTS; s++) {
        uint64_t random = 100 + (uint64_t)s;
        double faded = 0, before = 0;
        strcpy(paths[s], "/tmp/weartrack-group-XXXXXX");
        FILE *out = truth_file(paths[s]);
        fprintf(out, "## table: force_curve/0\n"
                     "## spring_constant: 1000 standard_error=0 numerical_error=0 unit=N/m\n"
                     "## curve: 0\n# segment[text]\theight[m]\tforce[N]\ttime[s]\n");
        for (int i = 0; i < N; i++) {
            const double beyond = depth * (2.0 * i / (N - 1) - 1),
                         now = 4.0 / 3.0 / 0.75 * sqrt(HERTZ_RADIUS) * pow(fmax(beyond, 0), 1.5),
                         decay = exp(-step / time);
            faded = faded * decay + time / step * (1 - decay) * (now - before);
            before = now;
            const double force = soft * now + fading * faded;
            fprintf(out, "approach\t%.17g\t%.17g\t%.17g\n", HERTZ_TOP - beyond - force / 1000,
                    force + 2 * HERTZ_NOISE * truth_normal(&random), step * i);
        }
        fputs("##\n", out);
        fclose(out);
    }
}

/* Curves without a retraction do not show a loss; lack of fit and fit range show the error. The
 * truth is |E*| at the inverse of the loading time of 0.1 s. */
static void test_one_relaxation_time(void **state)
{
    (void)state;
    wt_indent_job job = settings_of(HERTZ_TIP "+-0.1%");
    job.lever_error = job.sensitivity_error = 0.001;
    for (int i = 0; i < 3; i++) {
        const double time = 0.1 * pow(3, i - 1), z = time / 0.1,
                     truth = hypot(1.5e6 + 3.5e6 * z * z / (1 + z * z), 3.5e6 * z / (1 + z * z));
        wt_table *t = NULL;
        write_relaxing(time);
        const group_result g = fit_group(&job, &t);
        wt_table_free(t);
        assert_true(g.low < truth && truth < g.high);
    }
}

/* Largest mean shift without its noise, and at least the noise of the most precise mean. A mean
 * weighs each curve by its noise. A fit range with too few samples does not count. */
static double error_of(const double shift[2][WT_FIT_RANGES], double noise, double noise_of_second)
{
    const wt_indent_options options = wt_indent_defaults();
    const double w[2] = {1 / (noise * noise), 1 / (noise_of_second * noise_of_second)};
    const bool is_alone = isnan(shift[1][1]);
    indent_summary all = {0};
    for (int i = 0; i < 2; i++) {
        wt_indent_fit fit = {.modulus.value = 1e6, .max_force = 1e-9};
        for (int r = 0; r < WT_FIT_RANGES; r++) {
            fit.range_shift[r] = shift[i][r];
            fit.range_error[r] = i == 0 ? noise : noise_of_second;
        }
        indent_summary_add(&all, &fit, &options);
    }
    const double error = indent_summary_range_error(&all);
    const wt_estimate middle = indent_summary_range_shift(&all, 1);
    assert_near(middle.value,
                is_alone ? shift[0][1] : (w[0] * shift[0][1] + w[1] * shift[1][1]) / (w[0] + w[1]),
                1e-12);
    assert_near(middle.standard_error, is_alone ? noise : 1 / sqrt(w[0] + w[1]), 1e-12);
    assert_true(isnan(indent_summary_range_shift(&all, 2).value));
    indent_summary_clear(&all);
    return error;
}

static void test_range_error(void **state)
{
    (void)state;
    const double none = (double)NAN, small = 1e-8;
    const double both[2][WT_FIT_RANGES] = {{0.10, -0.04, none}, {0.14, -0.02, none}},
                 one[2][WT_FIT_RANGES] = {{0.10, -0.04, none}, {0.14, none, none}};
    assert_near(error_of(both, small, small), 0.12, 1e-12);
    assert_near(error_of(one, small, small), 0.12, 1e-12);
    assert_near(error_of(both, small, 2 * small), 0.108, 1e-12);
    assert_near(error_of(both, 0.05, 0.05), sqrt(0.12 * 0.12 - 0.05 * 0.05 / 2), 1e-12);
    assert_near(error_of(both, 1, 1), sqrt(0.5), 1e-12);
    indent_summary none_added = {0};
    assert_true(isnan(indent_summary_range_error(&none_added))); /* not tested */
}

/* Without a second range of the fit its error is not known, which the result names. */
static void test_no_range(void **state)
{
    (void)state;
    uint64_t random = 7;
    wt_table *t = NULL, *budget = NULL;
    wt_indent_job job = settings_of(HERTZ_TIP);
    job.options.misfit_p_threshold = 0;
    write_group(1, &random);
    const group_result g = fit_group(&job, &t);
    assert_true(g.low < g.mean && g.mean < g.high);
    assert_true(isnan(key_estimate(t, "range_error").value));
    assert_non_null(strstr(wt_table_key(t, "not_shown"), "a wrong contact law"));
    assert_int_equal(wt_modulus_budget_table((const wt_table *const[]){t}, 1, &budget, NULL),
                     WT_OK);
    assert_non_null(strstr(wt_table_key(budget, "says_bulk"), "not included"));
    wt_table_free(budget);
    wt_table_free(t);
}

/* An attraction before contact that no law of adhesion describes is returned if it is above a tenth
 * of the largest force; the larger adhesion of the retraction replaces it. */
static void test_excluded_attraction(void **state)
{
    (void)state;
    const double none = (double)NAN;
    wt_indent_fit fit = {.max_force = 40e-9, .adhesion_force = 7e-9, .pull_off_force = none};
    fit.work_of_adhesion.value = fit.contact_pull.value = none;
    assert_near(curve_left_out_pull(&fit), 7e-9, 1e-12);
    fit.pull_off_force = 18e-9;
    assert_near(curve_left_out_pull(&fit), 18e-9, 1e-12);
    fit.work_of_adhesion.value = 0.05; /* the law describes it */
    assert_true(curve_left_out_pull(&fit) == 0);
    fit.work_of_adhesion.value = none;
    fit.max_force = 200e-9; /* small */
    assert_true(curve_left_out_pull(&fit) == 0);
    fit.max_force = 40e-9;
    fit.adhesion_force = 0; /* a pull-off alone does not change the approach */
    assert_true(curve_left_out_pull(&fit) == 0);
}

static int open_formats(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int close_formats(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_radius),
                                       cmocka_unit_test(test_stated),
                                       cmocka_unit_test(test_one_relaxation_time),
                                       cmocka_unit_test(test_range_error),
                                       cmocka_unit_test(test_no_range),
                                       cmocka_unit_test(test_excluded_attraction)};
    return cmocka_run_group_tests_name("error of a group", tests, open_formats, close_formats);
}
