/* Runs of cases: friction of a stated material, and reports about failed stages.
 * SPDX-License-Identifier: GPL-3.0-or-later */

#include "table_cells.h"
#include "weartrack/case.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HEAD "<case version=\"1\">\n"
#define PRONY                                                                                      \
    "<dma><reference-temperature>20degC</reference-temperature>"                                   \
    "<prony deformation=\"tension\" frequency-min=\"1e-2rad/s\" frequency-max=\"1e8rad/s\">"       \
    "<equilibrium>3MPa</equilibrium><term time=\"1e-6s\" modulus=\"300MPa\"/>"                     \
    "<term time=\"1e-4s\" modulus=\"10MPa\"/><term time=\"1e-2s\" modulus=\"3MPa\"/></prony>"      \
    "<wlf><c1>6.5 +- 0.1</c1><c2>110K</c2></wlf></dma>"
#define ROAD                                                                                       \
    "<roughness><self-affine><q0>2e3rad/m</q0><qr>4e3rad/m</qr><q1>1e6rad/m</q1>"                  \
    "<hurst>0.8</hurst><c0>2e-17m^4</c0></self-affine></roughness>"
#define SLIDE(more)                                                                                \
    "<sliding><pressure>0.4MPa</pressure><velocity>1e-3:1m/s:log:4</velocity>" more "</sliding>"
#define LAYER(more)                                                                                \
    "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"                               \
    "<observed-thickness>2um +- 0.3um</observed-thickness>" more "</layer>"

typedef struct ran {
    wt_result *result;
    size_t n_failed;
} ran;

static ran run_text(const char *text, unsigned threads)
{
    char path[] = "/tmp/weartrack-run-XXXXXX";
    int file = mkstemp(path);
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_run_options options = wt_run_defaults();
    ran r = {NULL, 99};
    options.threads = threads;
    options.replicates = 8;
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    if (wt_case_read(path, &c, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    if (wt_run_case(c, &options, NULL, &r.result, &r.n_failed, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    wt_case_free(c);
    unlink(path);
    return r;
}

static const wt_table *table_of(const ran *r, const char *name)
{
    const wt_table *table = wt_result_find(r->result, name);
    if (table == NULL)
        fail_msg("no table %s", name);
    return table;
}

enum { DIFFERS, THICKNESS, FRICTION }; /* rows of the answer */

static void check_answer(const ran *r, size_t row, const char *verdict, const char *part)
{
    const wt_table *answer = table_of(r, "answer");
    assert_string_equal(text_cell(answer, row, "verdict"), verdict);
    if (strstr(text_cell(answer, row, "answer"), part) == NULL)
        fail_msg("\"%s\" is not in: %s", part, text_cell(answer, row, "answer"));
}

static void check_limit(const ran *r, const char *part)
{
    const wt_table *limits = table_of(r, "limits");
    for (size_t i = 0; i < wt_table_n_rows(limits); i++)
        if (strstr(text_cell(limits, i, "limit"), part) != NULL)
            return;
    fail_msg("no limit says \"%s\"", part);
}

/* The numbers equal those of the kernel, at another temperature. */
static void test_friction_only(void **state)
{
    (void)state;
    ran r = run_text(HEAD PRONY ROAD SLIDE("<temperature>40degC</temperature>"
                                           "<shear-stress>5MPa</shear-stress>") "</case>",
                     1);
    const wt_table *friction = table_of(&r, "friction");
    assert_int_equal(r.n_failed, 0);
    assert_int_equal(wt_table_n_rows(friction), 4);
    double a = pow(10, -6.5 * 20 / (110 + 20.0));
    double tau[] = {1e-6 * a, 1e-4 * a, 1e-2 * a}, modulus[] = {300e6, 10e6, 3e6};
    wt_prony prony = {.deformation = WT_TENSION,
                      .reference_temperature = 313.15,
                      .equilibrium_modulus = 3e6,
                      .n = 3,
                      .relaxation_time = tau,
                      .modulus = modulus,
                      .frequency_min = 1e-2 / a,
                      .frequency_max = 1e8 / a};
    wt_material *material = NULL;
    wt_roughness *road = NULL;
    wt_friction_workspace *workspace = NULL;
    const double velocity[] = {1e-3, 1e-2, 0.1, 1};
    wt_friction_point points[4];
    assert_int_equal(wt_material_prony(&prony, 0.5, &material, NULL), WT_OK);
    assert_int_equal(wt_roughness_self_affine(2e3, 4e3, 1e6, 0.8, 2e-17, &road, NULL), WT_OK);
    assert_int_equal(wt_friction_workspace_new(material, road, NULL, &workspace, NULL), WT_OK);
    assert_int_equal(wt_friction_compute(workspace, 0.4e6, velocity, 4, points, NULL), WT_OK);
    for (size_t i = 0; i < 4; i++) {
        double adhesion = 5e6 * points[i].area_ratio.value / 0.4e6;
        assert_near(number_cell(friction, i, "velocity"), velocity[i], 1e-14);
        assert_near(number_cell(friction, i, "hysteresis"), points[i].hysteresis.value, 1e-9);
        assert_near(number_cell(friction, i, "area_ratio"), points[i].area_ratio.value, 1e-9);
        assert_near(number_cell(friction, i, "adhesion"), adhesion, 1e-9);
        assert_near(number_cell(friction, i, "friction"), points[i].hysteresis.value + adhesion,
                    1e-9);
        assert_true(number_cell(friction, i, "friction_standard_error") > 0);
        assert_true(isnan(number_cell(friction, i, "friction_with_layer")));
    }
    wt_friction_workspace_free(workspace);
    wt_roughness_free(road);
    wt_material_free(material);

    assert_string_equal(wt_table_key(friction, "standard_error_includes"), "shift law");
    /* no question is asked */
    assert_int_equal(wt_table_n_rows(table_of(&r, "answer")), 0);
    check_limit(&r, "The 95 % interval of the friction excludes errors of");
    const wt_table *cost = table_of(&r, "cost");
    assert_near(number_cell(cost, row_where(cost, "stage", "friction"), "runs"), 1, 0);
    assert_true(number_cell(cost, row_where(cost, "stage", "friction"), "error_estimated") <=
                1e-10);
    assert_near(number_cell(cost, row_where(cost, "stage", "layer"), "runs"), 0, 0);
    assert_int_equal(wt_table_n_rows(table_of(&r, "inputs")), 1); /* the case itself */
    assert_null(wt_result_find(r.result, "layer"));
    wt_result_free(r.result);
}

/* An observed thickness calibrates the critical energy: it is reproduced, with its own error. */
static void test_layer(void **state)
{
    (void)state;
    ran r = run_text(HEAD PRONY ROAD SLIDE("<shear-stress>5MPa</shear-stress>")
                         LAYER("<modulus-ratio>0.6 +- 0.05</modulus-ratio>") "</case>",
                     2);
    wt_estimate e;
    const wt_table *layer = table_of(&r, "layer"), *friction = table_of(&r, "friction");
    assert_int_equal(r.n_failed, 0);
    assert_true(wt_table_estimate(layer, "balance_thickness", &e));
    assert_near(e.value, 2e-6, 1e-6);
    assert_true(e.standard_error > 0.1e-6 && e.standard_error < 0.7e-6);
    check_answer(&r, THICKNESS, "not computed", "calibrated to the stated thickness");
    check_limit(&r, "calibrated to the stated thickness");
    assert_true(wt_table_estimate(friction, "relative_change_at_reference", &e));
    assert_true(e.value > -0.6 && e.value < 0.5 && e.standard_error > 0);
    /* a softer layer has more contact area and a lower shear stress */
    assert_true(number_cell(friction, 0, "friction_with_layer") > 0);
    check_answer(&r, FRICTION, "inconclusive", "interval");
    wt_result_free(r.result);
}

/* The complete stage fails (a layer without wear has no thickness): the simpler one replaces it,
 * and the result states what is missing. */
static void test_simpler_stage_replaces_failed_one(void **state)
{
    (void)state;
    ran r = run_text(
        HEAD PRONY ROAD SLIDE("") "<layer><specific-wear-rate>0mm^3/(N m)</specific-wear-rate>"
                                  "<critical-energy>1e10J/m^3</critical-energy>"
                                  "<modulus-ratio>0.6</modulus-ratio></layer></case>",
        1);
    const wt_table *cost = table_of(&r, "cost");
    assert_int_equal(r.n_failed, 1);
    assert_string_equal(text_cell(table_of(&r, "failures"), 0, "file"),
                        "stage friction with the layer");
    const size_t first = row_where(cost, "stage", "friction");
    assert_non_null(strstr(text_cell(cost, first, "reason"), ", and failed"));
    assert_string_equal(text_cell(cost, first + 1, "stage"), "friction");
    assert_string_equal(text_cell(cost, first + 1, "reason"),
                        "runs because it did not succeed with the layer");
    assert_int_equal(wt_table_n_rows(table_of(&r, "friction")), 4);
    check_answer(&r, THICKNESS, "predicted", "grows without limit");
    check_answer(&r, FRICTION, "not computed",
                 "The stage failed: friction needs a layer of finite thickness");
    check_limit(&r, "1 file or stage failed");
    wt_result_free(r.result);
}

/* A failed stage only blocks stages that need it. */
static void test_missing_file(void **state)
{
    (void)state;
    ran r =
        run_text(HEAD "<dma><files>no-such-file-*.txt</files></dma>" ROAD SLIDE("") "</case>", 1);
    assert_true(r.n_failed >= 2); /* the file, and the stage without data */
    assert_non_null(wt_result_find(r.result, "roughness"));
    assert_null(wt_result_find(r.result, "friction"));
    check_answer(&r, FRICTION, "not computed", "A stage that friction needs failed");
    wt_result_free(r.result);
}

/* Missing curves: each is one failure, and the result states the failure, not that it was not
 * requested. */
static void test_missing_curves(void **state)
{
    (void)state;
    ran r = run_text(HEAD "<indentation><tip>sphere:radius=5um</tip>"
                          "<bulk><files>no-such-bulk.txt</files></bulk>"
                          "<track><files>no-such-track.txt</files></track></indentation>" PRONY
                          "</case>",
                     1);
    const wt_table *failures = table_of(&r, "failures");
    assert_int_equal(r.n_failed, 4); /* two files, two stages */
    assert_string_equal(text_cell(failures, 0, "file"), "no-such-bulk.txt");
    assert_string_equal(text_cell(failures, 1, "file"), "stage indentation_bulk");
    check_answer(&r, DIFFERS, "not computed",
                 "A stage that comparison needs failed (indentation_bulk): no force "
                 "curve could be read for \"bulk\"");
    wt_table *headlines = NULL;
    assert_int_equal(wt_result_main_values(r.result, &headlines, NULL), WT_OK);
    /* a requested result is missing: no verdict, and a status that states it */
    assert_string_equal(text_cell(headlines, 0, "key"), "status");
    assert_near(number_cell(headlines, 0, "value"), WT_RESULT_EMPTY, 0);
    assert_string_equal(wt_table_key(failures, "status"), "1");
    for (size_t i = 0; i < wt_table_n_rows(headlines); i++)
        assert_string_not_equal(text_cell(headlines, i, "key"), "verdict");
    wt_table_free(headlines);
    wt_result_free(r.result);
}

/* A measured spectrum with units from the case, truncated at both ends, with its own error. */
static void test_spectrum(void **state)
{
    (void)state;
    ran r =
        run_text(HEAD PRONY "<roughness><spectrum><file units=\"q=rad/m; C(q)=m^4\">" WT_SOURCE_DIR
                            "/fixtures/formats/table-spectrum/surface.txt</file>"
                            "<error>20%</error></spectrum></roughness>" SLIDE("") "</case>",
                 1);
    const wt_table *friction = table_of(&r, "friction");
    wt_estimate height;
    assert_int_equal(r.n_failed, 0);
    assert_int_equal(wt_table_n_rows(table_of(&r, "inputs")), 2);
    assert_string_equal(wt_table_text(table_of(&r, "inputs"), 1, 1), "roughness");
    assert_true(wt_table_estimate(table_of(&r, "roughness"), "rms_height", &height));
    assert_near(height.standard_error, 0.1 * height.value, 1e-12);
    assert_non_null(strstr(wt_table_key(friction, "standard_error_includes"), "roughness"));
    for (size_t i = 0; i < 4; i++)
        assert_true(number_cell(friction, i, "hysteresis") > 0);
    wt_result_free(r.result);
}

/* One isotherm: no shift and no law; friction at its temperature only. */
static void test_one_isotherm(void **state)
{
    (void)state;
#define STARE                                                                                      \
    "<dma><terms-per-decade>2</terms-per-decade><files>" WT_SOURCE_DIR                             \
    "/fixtures/formats/stare/isotherm.txt</files></dma>"
    ran r = run_text(HEAD STARE ROAD SLIDE("") "</case>", 1);
    assert_int_equal(r.n_failed, 0);
    assert_int_equal(wt_table_n_rows(table_of(&r, "shift_factors")), 1);
    assert_null(wt_table_key(table_of(&r, "shift_factors"), "wlf_c1"));
    assert_true(number_cell(table_of(&r, "friction"), 0, "hysteresis") > 0);
    check_limit(&r, "No sliding temperature is stated");
    wt_result_free(r.result);
    r = run_text(HEAD STARE ROAD SLIDE("<temperature>90degC</temperature>") "</case>", 1);
    assert_int_equal(r.n_failed, 1);
    check_answer(&r, FRICTION, "not computed",
                 "no shift law takes the material to another temperature");
    wt_result_free(r.result);
}

/* The number of threads only changes the time. */
static void test_threads(void **state)
{
    (void)state;
    static const char text[] = HEAD PRONY ROAD SLIDE("<shear-stress>5MPa +- 10%</shear-stress>")
        LAYER("<modulus-ratio>0.6 +- 0.05</modulus-ratio>") "</case>";
    ran a = run_text(text, 1), b = run_text(text, 3);
    assert_int_equal(wt_result_n_tables(a.result), wt_result_n_tables(b.result));
    for (size_t t = 0; t < wt_result_n_tables(a.result); t++) {
        const wt_table *x = wt_result_table(a.result, t), *y = wt_result_table(b.result, t);
        if (strcmp(wt_table_name(x), "cost") == 0 || strcmp(wt_table_name(x), "inputs") == 0)
            continue; /* times, and the name of the temporary case */
        assert_int_equal(wt_table_n_rows(x), wt_table_n_rows(y));
        for (size_t c = 0; c < wt_table_n_columns(x); c++)
            if (wt_table_column_kind(x, c) == WT_COLUMN_NUMBER && wt_table_n_rows(x) > 0)
                assert_memory_equal(wt_table_numbers(x, c), wt_table_numbers(y, c),
                                    wt_table_n_rows(x) * sizeof(double));
    }
    wt_result_free(a.result);
    wt_result_free(b.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_friction_only),
        cmocka_unit_test(test_layer),
        cmocka_unit_test(test_simpler_stage_replaces_failed_one),
        cmocka_unit_test(test_missing_file),
        cmocka_unit_test(test_missing_curves),
        cmocka_unit_test(test_spectrum),
        cmocka_unit_test(test_one_isotherm),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests_name("flow run", tests, NULL, NULL);
}
