/* Cost of the stages: a row for each, whose items and nodes are the same for any number of threads.
 * Without a request nothing is timed or counted.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"

#include "case/plan/plan.h"
#include "core/base/array.h"
#include "dma/numerics/posterior.h"
#include "friction/numerics/angular.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define CASE WT_SOURCE_DIR "/fixtures/case"
enum { CURVES = 48, ISOTHERMS = 12, VELOCITIES = 32, TIMES = 61, REPLICATES = 3 };

/* ---- clocks ---------------------------------------------------------------------------------- */

static size_t looks;

double __real_wt_time_wall(void);
double __wrap_wt_time_wall(void);
double __wrap_wt_time_wall(void)
{
    looks++;
    return __real_wt_time_wall();
}

double __real_wt_time_cpu(void);
double __wrap_wt_time_cpu(void);
double __wrap_wt_time_cpu(void)
{
    looks++;
    return __real_wt_time_cpu();
}

/* ---- a whole case ---------------------------------------------------------------------------- */

static wt_case *the_case;

static wt_result *run(unsigned threads, bool timed)
{
    wt_run_options options = wt_run_defaults();
    wt_error err = WT_ERROR_INIT;
    wt_result *result = NULL;
    size_t n_failed = 0;
    options.threads = threads;
    options.tolerance = 1e-6;
    options.replicates = REPLICATES;
    options.no_provenance = !timed;
    if (wt_run_case(the_case, &options, NULL, &result, &n_failed, &err) != WT_OK || n_failed > 0)
        fail_msg("%s", err.message);
    return result;
}

static size_t row_of(const wt_table *cost, const char *stage)
{
    size_t found = SIZE_MAX, n = 0;
    for (size_t row = 0; row < wt_table_n_rows(cost); row++)
        if (strcmp(text_cell(cost, row, "stage"), stage) == 0) {
            found = row;
            n++;
        }
    if (n != 1)
        fail_msg("stage %s has %zu rows", stage, n);
    return found;
}

static double of(const wt_table *cost, const char *stage, const char *column)
{
    return number_cell(cost, row_of(cost, stage), column);
}

static double size_of(const char *name)
{
    struct stat info;
    char path[512];
    snprintf(path, sizeof path, CASE "/%s", name);
    assert_int_equal(stat(path, &info), 0);
    return (double)info.st_size;
}

/* A stage that did not run only has its reason. */
static void check_stages(const wt_table *cost)
{
    flow_plan plan;
    flow_plan_create(the_case, &plan);
    assert_int_equal(wt_table_n_rows(cost), FLOW_N_STAGES);
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        const size_t row = row_of(cost, flow_stages[i].id);
        assert_near(number_cell(cost, row, "runs"), plan.chosen[i], 0);
        if (plan.chosen[i]) {
            assert_true(number_cell(cost, row, "items") > 0);
            continue;
        }
        static const char *const nothing[] = {"wall_time", "cpu_time", "items",
                                              "nodes",     "files",    "bytes"};
        for (size_t k = 0; k < COUNT_OF(nothing); k++)
            assert_near(number_cell(cost, row, nothing[k]), 0, 0);
        assert_true(isnan(number_cell(cost, row, "tolerance_asked")));
        assert_true(isnan(number_cell(cost, row, "standard_error")));
    }
}

static void check_work(const wt_table *cost)
{
    static const char *const groups[] = {"indentation_bulk", "indentation_track"};
    for (size_t g = 0; g < 2; g++) {
        double bytes = 0;
        for (int i = 1; i <= 4; i++) {
            char name[64];
            snprintf(name, sizeof name, "%s-%d.jpk-force-map", g == 0 ? "bulk" : "track", i);
            bytes += size_of(name);
        }
        assert_near(of(cost, groups[g], "items"), CURVES, 0);
        assert_near(of(cost, groups[g], "files"), 4, 0);
        assert_near(of(cost, groups[g], "bytes"), bytes, 0);
        assert_true(of(cost, groups[g], "nodes") >= CURVES); /* every curve was fitted */
        const double error = of(cost, groups[g], "standard_error");
        assert_true(error > 1e-4 && error < 0.1);
    }
    assert_near(of(cost, "master_curve", "items"), ISOTHERMS, 0);
    assert_near(of(cost, "master_curve", "bytes"), size_of("dma.txt"), 0);
    assert_true(of(cost, "master_curve", "nodes") > 10);
    assert_near(of(cost, "friction", "items"), VELOCITIES * 2 * (1 + REPLICATES), 0);
    assert_near(of(cost, "layer", "items"), TIMES * (1 + REPLICATES), 0);
    /* a rule has at least 4 nodes, and a plan at least 2 subintervals */
    assert_true(of(cost, "friction", "nodes") > 4.0 * 2 * VELOCITIES * 2 * (1 + REPLICATES));
    assert_true(of(cost, "layer", "nodes") > 4.0 * 2 * (1 + REPLICATES));
}

/* The stated errors are in the tables of the stages, too. The tolerance is that of the integrals; a
 * thickness may depend on them more than proportionally. */
static void check_errors(const wt_result *result, const wt_table *cost)
{
    wt_estimate e;
    size_t fits = 0;
    for (size_t i = 0; i < wt_table_n_rows(cost); i++) {
        const double asked = number_cell(cost, i, "tolerance_asked");
        if (isnan(asked))
            continue;
        const char *stage = text_cell(cost, i, "stage");
        if (strcmp(stage, "master_curve") == 0 || strncmp(stage, "indentation", 11) == 0) {
            const double reached = number_cell(cost, i, "error_estimated"),
                         error = number_cell(cost, i, "standard_error");
            assert_true(asked > 0 && asked < 0.04 * error); /* of a fit */
            assert_true(reached > 0 && reached <= asked);
            fits++;
            continue;
        }
        assert_near(asked, 1e-6, 0);
        const bool of_thickness = strcmp(stage, "layer") == 0 || strcmp(stage, "what_if") == 0;
        assert_true(number_cell(cost, i, "error_estimated") <= (of_thickness ? 100 : 1) * asked);
    }
    assert_int_equal(fits, 3);
    const wt_table *friction = wt_result_find(result, "friction"),
                   *layer = wt_result_find(result, "layer");
    double largest = 0;
    for (size_t i = 0; i < wt_table_n_rows(friction); i++)
        largest = fmax(largest, number_cell(friction, i, "hysteresis_numerical_error") /
                                    number_cell(friction, i, "hysteresis"));
    assert_true(wt_table_estimate(friction, "hysteresis_at_reference", &e));
    largest = fmax(largest, e.numerical_error / e.value);
    assert_near(of(cost, "friction", "error_estimated"), largest, 0);
    assert_true(wt_table_estimate(friction, "friction_at_reference", &e));
    assert_near(of(cost, "friction", "standard_error"), e.standard_error / e.value, 0);
    assert_true(wt_table_estimate(layer, "balance_thickness", &e));
    assert_near(of(cost, "layer", "standard_error"), e.standard_error / e.value, 0);
    assert_near(of(cost, "layer", "error_estimated"), e.numerical_error / e.value, 0);
}

/* The bounds are wide, because the machine may be busy. */
static void check_times(const wt_table *cost, unsigned threads)
{
    wt_estimate total;
    double sum = 0;
    assert_true(wt_table_estimate(cost, "threads", &total));
    assert_near(total.value, threads, 0);
    for (size_t i = 0; i < wt_table_n_rows(cost); i++) {
        const double wall = number_cell(cost, i, "wall_time");
        if (number_cell(cost, i, "runs") == 0)
            continue;
        assert_true(wall > 0);
        assert_true(number_cell(cost, i, "cpu_time") <= 2 * threads * wall + 0.1);
        sum += wall;
    }
    assert_true(wt_table_estimate(cost, "total_wall_time", &total));
    assert_true(sum <= total.value);
    assert_true(wt_table_estimate(cost, "total_cpu_time", &total));
    assert_true(total.value > 0);
}

static void test_case(void **state)
{
    (void)state;
    wt_result *result = run(2, true);
    const wt_table *cost = wt_result_find(result, "cost");
    check_stages(cost);
    check_work(cost);
    check_errors(result, cost);
    check_times(cost, 2);
    wt_result_free(result);
}

/* All tables except the times, which are absent without provenance. */
static void test_any_number_of_threads(void **state)
{
    (void)state;
    looks = 0;
    wt_result *one = run(1, false);
    assert_int_equal(looks, 0);
    wt_result *two = run(2, false);
    const wt_table *a = wt_result_find(one, "cost"), *b = wt_result_find(two, "cost");
    wt_estimate none;
    assert_false(wt_table_estimate(a, "threads", &none));
    for (size_t c = 0; c < wt_table_n_columns(a); c++)
        for (size_t i = 0; i < wt_table_n_rows(a); i++) {
            if (wt_table_column_kind(a, c) == WT_COLUMN_TEXT) {
                assert_string_equal(wt_table_text(a, i, c), wt_table_text(b, i, c));
                continue;
            }
            const double x = wt_table_number(a, i, c), y = wt_table_number(b, i, c);
            if (!(isnan(x) && isnan(y)) && x != y)
                fail_msg("%s, %s: %.17g with one thread, %.17g with two", text_cell(a, i, "stage"),
                         wt_table_column_name(a, c), x, y);
        }
    wt_result_free(one);
    wt_result_free(two);
}

/* ---- materials ------------------------------------------------------------------------------- */

static size_t fits; /* fits of the angular integrals of a material */

wt_status __real_angular_subintervals_new(const wt_material *material, const gauss_rule *rule,
                                          double low, double high, double goal,
                                          angular_subintervals *panels, wt_error *err);
wt_status __wrap_angular_subintervals_new(const wt_material *material, const gauss_rule *rule,
                                          double low, double high, double goal,
                                          angular_subintervals *panels, wt_error *err);
wt_status __wrap_angular_subintervals_new(const wt_material *material, const gauss_rule *rule,
                                          double low, double high, double goal,
                                          angular_subintervals *panels, wt_error *err)
{
    fits++;
    return __real_angular_subintervals_new(material, rule, low, high, goal, panels, err);
}

/* Layer, friction and friction with the layer, for a material without a closed form. */
static wt_result *run_zener(const char *temperature, unsigned threads, const char *asks)
{
    char path[] = "/tmp/weartrack-cost-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    dprintf(file,
            "<?xml version=\"1.0\"?><case version=\"1\"><dma>"
            "<reference-temperature>20degC</reference-temperature>"
            "<fractional-zener><e0>5MPa</e0><eg>2GPa</eg><tau>1us</tau><alpha>0.4</alpha>"
            "</fractional-zener><wlf><c1>12</c1><c2>80K</c2></wlf></dma>"
            "<roughness><self-affine><q0>2e3rad/m</q0><qr>4e3rad/m</qr><q1>2e6rad/m</q1>"
            "<hurst>0.8</hurst><c0>2e-17m^4 +- 5%%</c0></self-affine></roughness>"
            "<sliding><pressure>0.4MPa</pressure><temperature>%s</temperature>"
            "<velocity>1e-3:1m/s:log:4</velocity><shear-stress>5MPa</shear-stress></sliding>"
            "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"
            "<critical-energy>1e10J/m^3</critical-energy><modulus-ratio>0.6</modulus-ratio></layer>"
            "<report><result>layer</result><result>friction</result>%s</report></case>",
            temperature, asks);
    close(file);
    wt_error err = WT_ERROR_INIT;
    wt_case *whole = the_case;
    const wt_status status = wt_case_read(path, &the_case, &err);
    unlink(path);
    if (status != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    fits = 0;
    wt_result *result = run(threads, false);
    wt_case_free(the_case);
    the_case = whole;
    return result;
}

/* Three contacts of the values share one material. The replicates have one each, or one together if
 * no material is drawn. Model variants use that of the values, whose range suffices here; those of
 * another Poisson ratio, three contacts, have another material. */
static void test_materials_are_shared(void **state)
{
    (void)state;
    wt_result *result = run_zener("30degC", 1, "");
    assert_int_equal(fits, 1 + 1);
    wt_result_free(result);
    result = run_zener("30degC +- 1K", 1, "");
    assert_int_equal(fits, 1 + REPLICATES);
    wt_result_free(result);
    result = run_zener("30degC", 1, "<result>what_if</result>");
    assert_int_equal(fits, 1 + 1 + 3);
    wt_result_free(result);
}

/* A shared material gives the same numbers as that of a single job. */
static void test_shared_material_changes_nothing(void **state)
{
    (void)state;
    const wt_zener zener = {.e0 = 5e6, .eg = 2e9, .tau = 1e-6, .alpha = 0.4};
    static const double velocity[] = {1e-3, 1e-2, 0.1, 1};
    wt_result *result = run_zener("30degC +- 1K", 2, "");
    const wt_table *layer = wt_result_find(result, "layer"),
                   *friction = wt_result_find(result, "friction");
    wt_friction_tables alone = {0};
    wt_estimate thickness;
    sliding_set_up(velocity, COUNT_OF(velocity));
    rubber = (wt_rubber){.kind = WT_RUBBER_ZENER,
                         .zener = zener,
                         .poisson_ratio = 0.5,
                         .law = {.kind = WT_LAW_WLF, .wlf = {293.15, 12, 80}},
                         .temperature_min = (double)NAN,
                         .temperature_max = (double)NAN,
                         .prony = {.reference_temperature = 293.15,
                                   .frequency_min = (double)NAN,
                                   .frequency_max = (double)NAN}};
    surface.c0.standard_error = 0.05 * surface.c0.value;
    sliding.temperature = (wt_estimate){303.15, 1, 0, "K"};
    sliding.reference_velocity = 0.1;
    work.tolerance = 1e-6;
    work.replicates = REPLICATES;
    assert_true(wt_table_estimate(layer, "balance_thickness", &thickness));
    thickness.numerical_error = 0;
    const wt_layer_observation observation = {.thickness = thickness,
                                              .modulus_ratio = {0.6, 0, 0, "1"}};
    assert_int_equal(wt_sliding_friction_compute(&sliding, &observation, &work, &alone, NULL),
                     WT_OK);
    for (size_t i = 0; i < COUNT_OF(velocity); i++) {
        static const char *const columns[] = {"friction", "friction_standard_error",
                                              "friction_with_layer_standard_error"};
        for (size_t k = 0; k < COUNT_OF(columns); k++) {
            const double x = number_cell(friction, i, columns[k]);
            assert_true(x > 0);
            assert_near(number_cell(alone.friction, i, columns[k]), x, 1e-12 * x);
        }
    }
    wt_table_free(alone.friction);
    wt_result_free(result);
}

/* ---- a further step of a fit ----------------------------------------------------------------- */

static void log_storage(spectrum *s, const double *value, double *log_e, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        double modulus[MODULI], slope[MODULI];
        spectrum_terms(s, value, s->term);
        spectrum_moduli(s, s->term, log(1e-2) + (double)k, modulus, slope, NULL);
        log_e[k] = modulus[STORAGE];
    }
}

/* The continued fit of the case, noise and smoothness included, is within its stated error. The
 * vertical shifts are fixed, so that there is one fit. */
static void test_continued_fit(void **state)
{
    (void)state;
    enum { PLACES = 20, MORE = 40 };
    wt_job reading = wt_job_defaults();
    wt_master_job job = the_case->master;
    wt_rubber fitted = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_formats *formats = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, &err), WT_OK);
    reading.formats = formats;
    job.sets = the_case->dma.sets;
    job.n_sets = the_case->dma.n;
    assert_int_equal(wt_master_compute(&job, &reading, NULL, &fitted, &err), WT_OK);
    job.fit.vertical = WT_VERTICAL_PHYSICAL;
    assert_int_equal(wt_master_fit(&fitted.sweep, &job.fit, NULL, &m, &err), WT_OK);
    spectrum *s = &m.posterior->frame;
    const spectrum_prior held = {.held = true, .mean = m.posterior->mean_b};
    double was[PLACES], is[PLACES], most = 0;
    log_storage(s, s->value, was, PLACES);
    s->prior = &held;
    for (int again = 0; again < MORE; again++)
        assert_int_equal(spectrum_fit(s, SPECTRUM_NOISE, &err), WT_OK);
    log_storage(s, s->value, is, PLACES);
    for (size_t k = 0; k < PLACES; k++) {
        wt_interval storage, loss;
        wt_master_moduli(&m, 1e-2 * exp((double)k), &storage, &loss);
        most = fmax(most, fabs(is[k] - was[k]) / (M_LN10 * storage.standard_error));
    }
    assert_true(most > 1e-5 && most <= m.step_bound);
    assert_true(m.step_bound <= m.step_tolerance);
    assert_near(m.step_tolerance, sqrt(1e-3), 1e-12);
    s->prior = NULL;
    wt_master_clear(&m);
    wt_rubber_clear(&fitted);
    wt_formats_free(formats);
}

/* ---- one job --------------------------------------------------------------------------------- */

static wt_table *make_friction(wt_cost *cost)
{
    static const double velocity[] = {0.01, 0.1, 1};
    wt_friction_tables tables = {0};
    sliding_set_up(velocity, COUNT_OF(velocity));
    work.tolerance = 1e-6;
    work.replicates = 0;
    work.cost = cost;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &tables, NULL), WT_OK);
    return tables.friction;
}

/* The nodes are those of the last rules of the kernel and of the rules before. */
static void test_nodes(void **state)
{
    (void)state;
    wt_cost *cost = wt_cost_new(false, 1);
    wt_table *table = NULL;
    wt_cost_begin_stage(cost, "friction");
    wt_table_free(make_friction(cost));
    wt_cost_begin_stage(cost, "nothing");
    assert_int_equal(wt_cost_table(cost, &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 2);
    assert_near(of(table, "friction", "items"), 4, 0); /* and that of the result */
    assert_near(of(table, "nothing", "nodes"), 0, 0);
    assert_true(isnan(of(table, "friction", "wall_time")));

    wt_material *material = NULL;
    wt_roughness *road = NULL;
    wt_friction_workspace *workspace = NULL;
    wt_friction_options options = wt_friction_defaults();
    wt_friction_point point[4];
    const double velocity[] = {0.01, 0.1, 1, 0.1};
    options.tolerance = 1e-6;
    assert_int_equal(
        wt_rubber_material(&rubber, (double)NAN, 1, WT_NO_REPLICATE, &material, NULL, NULL), WT_OK);
    assert_int_equal(wt_surface_roughness(&surface, 1, &road, NULL), WT_OK);
    assert_int_equal(wt_friction_workspace_new(material, road, &options, &workspace, NULL), WT_OK);
    assert_int_equal(wt_friction_compute(workspace, 0.4e6, velocity, 4, point, NULL), WT_OK);
    double last = 0;
    for (size_t i = 0; i < 4; i++)
        last += (double)point[i].nodes;
    const double nodes = of(table, "friction", "nodes");
    assert_true(nodes >= last && nodes < 6 * last);
    wt_friction_workspace_free(workspace);
    wt_roughness_free(road);
    wt_material_free(material);
    wt_cost_free(cost);
    wt_table_free(table);
}

static void test_nothing_timed_without_request(void **state)
{
    (void)state;
    wt_cost *cost = wt_cost_new(true, 1);
    looks = 0;
    wt_table *plain = make_friction(NULL);
    wt_cost_begin_stage(NULL, "friction");
    assert_int_equal(looks, 0);
    wt_table *counted = make_friction(cost);
    for (size_t c = 0; c < wt_table_n_columns(plain); c++)
        assert_memory_equal(wt_table_numbers(plain, c), wt_table_numbers(counted, c),
                            wt_table_n_rows(plain) * sizeof(double));
    wt_cost_free(cost);
    wt_table_free(plain);
    wt_table_free(counted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_case),
        cmocka_unit_test(test_any_number_of_threads),
        cmocka_unit_test(test_materials_are_shared),
        cmocka_unit_test(test_shared_material_changes_nothing),
        cmocka_unit_test(test_continued_fit),
        cmocka_unit_test(test_nodes),
        cmocka_unit_test(test_nothing_timed_without_request),
    };
    wt_error err = WT_ERROR_INIT;
    if (wt_case_read(CASE "/case.xml", &the_case, &err) != WT_OK) {
        fprintf(stderr, "%s\n", err.message);
        return EXIT_FAILURE;
    }
    const int failed = cmocka_run_group_tests_name("cost", tests, NULL, NULL);
    wt_case_free(the_case);
    return failed;
}
