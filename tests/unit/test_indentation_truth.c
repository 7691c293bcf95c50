/* The indentation job on curves with known truth: every column of its tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "weartrack/study.h"

#define SNAP 40e-9

static char path[] = "/tmp/weartrack-indent-XXXXXX";
static wt_formats *formats;
static wt_indent_tables tables;
static hertz truth;

/* A file with two curves: one with contact, one without. */
static int indent(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    const char *const patterns[] = {path};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job common = wt_job_defaults();
    truth = hertz_standard();
    truth.snap = SNAP;
    hertz soft = truth;
    soft.modulus = 1e-3;
    soft.snap = 0;
    FILE *out = truth_file(path);
    hertz_write(out, &truth, 0);
    hertz_write(out, &soft, 1);
    fclose(out);
    if (wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK ||
        wt_tip_parse(HERTZ_TIP " +- 10%", &job.tip, NULL) != WT_OK)
        return -1;
    set.spot = "s7";
    job.sets = &set;
    job.n_sets = 1;
    job.group = "track";
    job.median_curve = true;
    job.spring_constant = (wt_estimate){10, 0.5, 0, "N/m"};
    common.formats = formats;
    common.threads = 1;
    if (wt_indent_group(&job, &common, &tables, &err) == WT_OK)
        return 0;
    print_error("%s: %s\n", err.place, err.message);
    return -1;
}

static int clean(void **state)
{
    (void)state;
    wt_indent_tables_clear(&tables);
    wt_formats_free(formats);
    unlink(path);
    return 0;
}

/* |value - truth| is within 4 stated errors, which are below `most`. */
static void check(const char *column, const char *error, double expected, double most)
{
    double value = cell(tables.indentation, 0, column), se = cell(tables.indentation, 0, error);
    assert_true(se > 0 && se < most);
    assert_near_abs(value, expected, 4 * se);
}

static void test_columns(void **state)
{
    (void)state;
    const wt_table *t = tables.indentation;
    double load = hertz_travel(&truth) / truth.velocity;
    assert_string_equal(wt_table_name(t), "indentation/track");
    assert_int_equal(wt_table_n_rows(t), 2);
    assert_non_null(strstr(cell_text(t, 0, "file"), "weartrack-indent"));
    assert_near(cell(t, 1, "curve"), 1, 0);
    assert_string_equal(cell_text(t, 0, "spot"), "s7");
    assert_near(cell(t, 0, "x"), 1e-6, 1e-12);
    assert_near(cell(t, 0, "y"), 2e-6, 1e-12);
    assert_string_equal(cell_text(t, 0, "verdict"), "accepted");
    assert_non_null(strstr(cell_text(t, 0, "reason"), "(4 samples)"));
    check("modulus", "modulus_standard_error", truth.modulus, 0.06 * truth.modulus);
    check("contact_point", "contact_point_standard_error", HERTZ_FREE - HERTZ_TOP, 4e-9);
    assert_near_abs(cell(t, 0, "baseline_offset"), HERTZ_OFFSET, HERTZ_NOISE);
    assert_near(cell(t, 0, "baseline_tilt"), HERTZ_TILT, 0.4);
    assert_near(cell(t, 0, "noise"), HERTZ_NOISE, 0.1);
    assert_true(cell(t, 0, "lack_of_fit") > 0 && cell(t, 0, "lack_of_fit_p") > 0.01);
    assert_true(cell(t, 0, "baseline_p") > 0.01);
    assert_near(cell(t, 0, "max_force"), hertz_force(&truth, truth.depth), 0.005);
    assert_near(cell(t, 0, "max_indentation"), truth.depth, 0.005);
    assert_near(cell(t, 0, "adhesion_force"), SNAP, 0.05);
    assert_near(cell(t, 0, "piezo_rate"), truth.velocity, 1e-3);
    assert_near(cell(t, 0, "indentation_rate"), truth.depth / load, 0.01);
    assert_near(cell(t, 0, "load_time"), load, 0.01);
    assert_near(cell(t, 0, "equivalent_frequency"), 1 / load, 0.01);
    /* one point with a known contact has 1 + (contact stiffness)/k; the contact is fitted */
    double stiffness = 1.5 * hertz_force(&truth, truth.depth) / truth.depth;
    assert_true(cell(t, 0, "sensitivity_gain") > 1 + stiffness / truth.spring_constant);
    assert_true(cell(t, 0, "sensitivity_gain") < 4 * (1 + stiffness / truth.spring_constant));
    double second = cell(t, 0, "second_minimum_ratio");
    assert_true(isnan(second) || second > 1);
}

/* With a stated contact the force of a sphere follows the power 1.5 of the depth. */
static void test_known_contact(void **state)
{
    (void)state;
    const char *const patterns[] = {path};
    wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job common = wt_job_defaults();
    wt_indent_tables known = {0};
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.options.fixed_contact_point = HERTZ_FREE - HERTZ_TOP;
    assert_int_equal(wt_tip_parse(HERTZ_TIP, &job.tip, NULL), WT_OK);
    if (wt_indent_group(&job, &common, &known, &err) != WT_OK)
        fail_msg("%s: %s", err.place, err.message);
    assert_near(cell(known.indentation, 0, "equivalent_frequency"),
                2.02 * truth.velocity / hertz_travel(&truth), 0.01);
    wt_indent_tables_clear(&known);
}

static void test_rejected(void **state)
{
    (void)state;
    const wt_table *t = tables.indentation;
    assert_string_equal(cell_text(t, 1, "verdict"), "no_contact");
    assert_non_null(strstr(cell_text(t, 1, "reason"), "noise"));
    assert_string_equal(wt_table_key(t, "n_used"), "1");
    assert_string_equal(wt_table_key(t, "n_doubtful"), "0");
    assert_string_equal(wt_table_key(t, "n_rejected"), "1");
    assert_string_equal(wt_table_key(t, "spots"), "named");
    assert_near(key_estimate(t, "spring_constant").value, 10, 0);
    assert_near(key_estimate(t, "spring_constant").standard_error, 0.5, 0);
    assert_int_equal(tables.n_curves, 2);
    assert_int_equal(tables.n_accepted, 1);
    assert_int_equal(tables.n_files, 1);
}

/* Curves for the figures: from the contact point, above the baseline. */
static void test_curves(void **state)
{
    (void)state;
    const wt_table *fd = tables.force_displacement, *fi = tables.force_indentation;
    double end = HERTZ_FREE + hertz_travel(&truth);
    assert_int_equal(wt_table_n_rows(fd), HERTZ_N);
    for (size_t i = 0; i < HERTZ_N; i += 37) {
        double beyond = end * (double)i / (HERTZ_N - 1) - HERTZ_FREE;
        if (beyond < 0 && beyond > -20e-9)
            continue; /* the snap-in */
        assert_string_equal(cell_text(fd, i, "group"), "track");
        assert_string_equal(cell_text(fd, i, "segment"), "approach");
        assert_near_abs(cell(fd, i, "displacement"), beyond, 1e-9);
        assert_near_abs(cell(fd, i, "force"),
                        HERTZ_TILT * beyond + hertz_force(&truth, hertz_depth(&truth, beyond)),
                        5 * HERTZ_NOISE);
    }
    size_t n = wt_table_n_rows(fi);
    assert_near_abs((double)n, HERTZ_N * hertz_travel(&truth) / end, 2);
    for (size_t i = 9; i < n; i += 17) {
        double beyond = end * (double)(HERTZ_N - n + i) / (HERTZ_N - 1) - HERTZ_FREE;
        double depth = hertz_depth(&truth, beyond), force = hertz_force(&truth, depth);
        assert_string_equal(cell_text(fi, i, "group"), "track");
        assert_near_abs(cell(fi, i, "indentation"), depth, 1e-9);
        assert_near_abs(cell(fi, i, "force"), force, 5 * HERTZ_NOISE);
        assert_near_abs(cell(fi, i, "fitted_force"), force, 5 * HERTZ_NOISE);
    }
    assert_non_null(strstr(wt_table_key(fd, "curve_track"), "curve 0"));
    assert_near(key_estimate(fd, "contact_point_track").standard_error,
                cell(tables.indentation, 0, "contact_point_standard_error"), 1e-9);
    assert_true(key_estimate(fd, "contact_force_track").standard_error > 0);
}

/* For a Hertz contact E is proportional to k and to 1/sqrt(R); the effect of the sensitivity is the
 * fit's own derivative. Only the errors of k (5 %) and R (10 %) are stated, that of the sensitivity
 * is assumed (3 %), like those of piezo, detector and sample, and the scatter of one position is
 * unknown. */
static void test_budget(void **state)
{
    (void)state;
    wt_table *budget = NULL;
    const wt_table *const listed[] = {tables.indentation};
    assert_int_equal(wt_modulus_budget_table(listed, 1, &budget, NULL), WT_OK);
    const struct {
        const char *source;
        double error, gain;
    } expected[] = {
        {"spring constant", 0.05, 1},
        {"deflection sensitivity", 0.03, cell(tables.indentation, 0, "sensitivity_gain")},
        {"radius of the tip", 0.1, -0.5}};
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(cell_text(budget, i, "group"), "track");
        assert_string_equal(cell_text(budget, i, "source"), expected[i].source);
        assert_string_equal(cell_text(budget, i, "kind"), "shared");
        assert_near(cell(budget, i, "gain"), expected[i].gain, i == 1 ? 0.01 : 1e-5);
        assert_near(cell(budget, i, "source_error"), expected[i].error, 1e-9);
        assert_near(cell(budget, i, "relative_error"), fabs(expected[i].error * expected[i].gain),
                    i == 1 ? 1e-2 : 1e-5);
    }
    const struct {
        const char *source;
        double error, low, high; /* assumed; limits of the gain */
    } assumed[] = {{"bend of the piezo", 0.005, 0, 20},
                   {"nonlinearity of the detector", cell(budget, 4, "source_error"), 0.5, 3},
                   /* a base increases the force at the largest depth by 5.9 %, that at others less,
                    * so that the contact point moves and the modulus changes more */
                   {"thickness of the sample", 0.05, log(1.059) / 0.05, 2 * log(1.059) / 0.05}};
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(cell_text(budget, 3 + i, "source"), assumed[i].source);
        assert_near(cell(budget, 3 + i, "source_error"), assumed[i].error, 1e-9);
        const double gain = cell(budget, 3 + i, "gain");
        if (!(gain > assumed[i].low && gain < assumed[i].high))
            fail_msg("%s: gain %g", assumed[i].source, gain);
    }
    assert_string_equal(cell_text(budget, 6, "source"), "range of the fit");
    assert_true(cell(budget, 6, "relative_error") < 0.01);
    assert_string_equal(cell_text(budget, 8, "kind"), "together");
    assert_true(isnan(cell(budget, 8, "relative_error")));
    assert_non_null(strstr(wt_table_key(budget, "says_track"), "one spot does not determine "
                                                               "the scatter"));
    assert_non_null(strstr(wt_table_key(budget, "says_track"), "(deflection sensitivity)"));
    wt_table_free(budget);
}

/* ---- viscoelastic rubber ----------------------------------------------------------------------
 */

enum { MEMORY_N = 800 };
static const double soft = 2e6, fading = 3e6, fade_time = 0.05, memory_k = 2, memory_end = 800e-9,
                    memory_free = 300e-9;

/* For a series of one term: elastic forces of a paraboloid over the modulus, with the relaxing part
 * in time steps, and a cantilever. depth, force: [MEMORY_N]. */
static void remember(double factor, double *depth, double *force)
{
    const double step = 1e-3, g = 4.0 / 3 / 0.75 * sqrt(HERTZ_RADIUS),
                 decay = exp(-step / fade_time), mean = fade_time / step * (1 - decay);
    double faded = 0, before = 0;
    for (int i = 0; i < MEMORY_N; i++) {
        const double beyond = memory_end * i / (MEMORY_N - 1) - memory_free;
        double low = 0, high = fmax(beyond, 0), now = 0;
        for (int round = 0; round < 80; round++) {
            depth[i] = 0.5 * (low + high);
            now = g * pow(depth[i], 1.5);
            force[i] = factor * (soft * now + fading * (faded * decay + mean * (now - before)));
            *(memory_k * (beyond - depth[i]) > force[i] ? &low : &high) = depth[i];
        }
        if (beyond <= 0)
            depth[i] = force[i] = now = 0;
        faded = faded * decay + mean * (now - before);
        before = now;
    }
}

/* The factor on the spectrum, and the fitted hereditary force, for either direction of the
 * height. */
static void test_memory(void **state)
{
    (void)state;
    static const double factor = 0.7;
    static double depth[MEMORY_N], force[MEMORY_N];
    double tau[] = {fade_time}, term[] = {fading};
    const wt_rubber rubber = {.prony = {.deformation = WT_TENSION,
                                        .reference_temperature = 293.15,
                                        .equilibrium_modulus = soft,
                                        .n = 1,
                                        .relaxation_time = tau,
                                        .modulus = term,
                                        .frequency_min = 1e-3,
                                        .frequency_max = 1e6},
                              .poisson_ratio = 0.5};
    remember(factor, depth, force);
    for (int way = -1; way <= 1; way += 2) {
        char own[] = "/tmp/weartrack-memory-XXXXXX";
        const char *const patterns[] = {own};
        wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
        wt_indent_job job = wt_indent_job_defaults();
        wt_job common = wt_job_defaults();
        wt_indent_tables known = {0};
        wt_error err = WT_ERROR_INIT;
        uint64_t seed = 12;
        FILE *out = truth_file(own);
        fprintf(out,
                "## table: force_curve/0\n"
                "## spring_constant: %.9g standard_error=0 numerical_error=0 unit=N/m\n"
                "## curve: 0\n# segment[text]\theight[m]\tforce[N]\ttime[s]\n",
                memory_k);
        for (int i = 0; i < MEMORY_N; i++)
            fprintf(out, "approach\t%.17g\t%.17g\t%.17g\n",
                    3e-6 + way * memory_end * i / (MEMORY_N - 1),
                    force[i] + 0.2e-9 * truth_normal(&seed), 1e-3 * i);
        fputs("##\n", out);
        fclose(out);
        common.formats = formats;
        job.sets = &set;
        job.n_sets = 1;
        job.group = "track";
        job.median_curve = true;
        job.rubber = &rubber;
        assert_int_equal(wt_tip_parse(HERTZ_TIP, &job.tip, NULL), WT_OK);
        if (wt_indent_group(&job, &common, &known, &err) != WT_OK)
            fail_msg("%s: %s", err.place, err.message);
        const wt_table *t = known.indentation, *fi = known.force_indentation,
                       *fd = known.force_displacement;
        assert_string_equal(cell_text(t, 0, "verdict"), "accepted");
        assert_near_abs(cell(t, 0, "spectrum_factor"), factor,
                        4 * cell(t, 0, "spectrum_factor_standard_error") + 0.005);
        assert_true(cell(t, 0, "spectrum_factor_standard_error") < 0.02);
        const double load = 1e-3 * (MEMORY_N - 1) * (1 - memory_free / memory_end),
                     z = fade_time / load;
        assert_near(cell(t, 0, "load_time"), load, 0.01);
        assert_near(cell(t, 0, "equivalent_frequency"), 1 / load, 0.01);
        assert_near(cell(t, 0, "modulus") / cell(t, 0, "spectrum_factor"),
                    hypot(soft + fading * z * z / (1 + z * z), fading * z / (1 + z * z)), 0.01);
        const size_t n = wt_table_n_rows(fi), first = MEMORY_N - n;
        double off = 0;
        for (size_t i = 0; i < n; i++) {
            const double truth_force = force[first + i];
            assert_near_abs(cell(fi, i, "indentation"), depth[first + i], 2e-9);
            assert_near_abs(cell(fi, i, "force"), truth_force, 1.5e-9);
            assert_near_abs(cell(fi, i, "fitted_force"), truth_force, 1e-9 + 0.015 * truth_force);
            off += (cell(fi, i, "fitted_force") - truth_force) / force[MEMORY_N - 1];
        }
        assert_true(fabs(off / (double)n) < 1e-3);
        for (size_t i = 0; i < wt_table_n_rows(fd); i += 19)
            assert_near_abs(cell(fd, i, "displacement"),
                            memory_end * (double)i / (MEMORY_N - 1) - memory_free, 2e-9);
        wt_indent_tables_clear(&known);
        unlink(own);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns),  cmocka_unit_test(test_known_contact),
        cmocka_unit_test(test_rejected), cmocka_unit_test(test_curves),
        cmocka_unit_test(test_budget),   cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests_name("indentation of known truth", tests, indent, clean);
}
