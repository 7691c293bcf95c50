/* Every declared column and key is written by some run, job or conversion, and no other one is
 * written.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "sliding_fixture.h"
#include "truth_fixture.h"

#include "case/case.h"
#include "core/base/array.h"
#include "core/table/registry.h"
#include "weartrack/case.h"
#include "writers/jpk_writer.h"
#include "writers/nid_writer.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CASE WT_SOURCE_DIR "/fixtures/case/"
#define FORMATS WT_SOURCE_DIR "/fixtures/formats/"

/* Schemas and their columns and keys that were written. */
typedef struct seen {
    bool table;
    uint64_t columns, cells, keys; /* columns, columns with a number or text, keys */
} seen;

enum { MOST = 128 };
static seen found[MOST];
static wt_formats *formats;

static bool is_called(const wt_table *table, const table_schema *schema)
{
    const size_t length = strlen(schema->name);
    const char *name = wt_table_name(table);
    return schema->name[length - 1] == '/' ? strncmp(name, schema->name, length) == 0
                                           : strcmp(name, schema->name) == 0;
}

static bool has_all(const wt_table *table, const table_schema *schema)
{
    for (size_t i = 0; i < schema->n_columns; i++)
        if (!schema->columns[i].optional && wt_table_find(table, schema->columns[i].name) < 0)
            return false;
    return true;
}

static bool is_filled(const wt_table *table, size_t column)
{
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        if (wt_table_column_kind(table, column) == WT_COLUMN_TEXT
                ? wt_table_text(table, row, column)[0] != '\0'
                : !isnan(wt_table_number(table, row, column)))
            return true;
    return false;
}

/* Key of a schema that matches a key of a table. */
static size_t key_of(const table_schema *schema, const char *name)
{
    for (size_t i = 0; i < schema->n_keys; i++) {
        const char *declared = schema->keys[i].name;
        const size_t length = strlen(declared);
        if (declared[length - 1] == '_' ? strncmp(name, declared, length) == 0
                                        : strcmp(name, declared) == 0)
            return i;
    }
    return SIZE_MAX;
}

static void see(const wt_table *table)
{
    size_t at = 0;
    while (at < table_n_schemas &&
           !(is_called(table, table_schemas[at]) && has_all(table, table_schemas[at])))
        at++;
    if (at == table_n_schemas)
        fail_msg("table %s is not declared", wt_table_name(table));
    const table_schema *schema = table_schemas[at];
    found[at].table = true;
    for (size_t i = 0; i < wt_table_n_columns(table); i++) {
        size_t k = 0;
        wt_quantity quantity;
        while (k < schema->n_columns &&
               strcmp(schema->columns[k].name, wt_table_column_name(table, i)) != 0)
            k++;
        if (k < schema->n_columns) {
            found[at].columns |= SCHEMA_BIT(k);
            found[at].cells |= is_filled(table, i) ? SCHEMA_BIT(k) : 0;
        } else if (schema != &force_curve_schema ||
                   !wt_quantity_find(wt_table_column_name(table, i), &quantity)) {
            fail_msg("%s: column %s is not declared", wt_table_name(table),
                     wt_table_column_name(table, i));
        }
    }
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const size_t k = key_of(schema, wt_table_key_name(table, i));
        if (k == SIZE_MAX)
            fail_msg("%s: key %s is not declared", wt_table_name(table),
                     wt_table_key_name(table, i));
        found[at].keys |= SCHEMA_BIT(k);
    }
}

static wt_status see_and_free(void *user, wt_table *table, wt_error *err)
{
    (void)user;
    (void)err;
    see(table);
    wt_table_free(table);
    return WT_OK;
}

/* ---- sources of tables ----------------------------------------------------------------------- */

/* Expensive tables, of a case that has them. */
static void run_errors(wt_case *c, wt_run_options options)
{
    wt_result *result = NULL;
    assert_int_equal(wt_case_request_tables(c, "error_budget work_precision", NULL), WT_OK);
    assert_int_equal(wt_run_case(c, &options, NULL, &result, NULL, NULL), WT_OK);
    if (wt_result_find(result, "error_budget") != NULL)
        see(wt_result_find(result, "error_budget"));
    if (wt_result_find(result, "work_precision") != NULL)
        see(wt_result_find(result, "work_precision"));
    wt_result_free(result);
}

/* The bundled case with one text replaced. */
static void run_case_of(const char *path, bool errors, double tolerance, const char *text,
                        const char *instead)
{
    FILE *in = fopen(path, "rb");
    char xml[8192], changed[9000];
    assert_non_null(in);
    xml[fread(xml, 1, sizeof xml - 1, in)] = '\0';
    fclose(in);
    const char *at = strstr(xml, text);
    assert_non_null(at);
    (void)snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - xml), xml, instead,
                   at + strlen(text));
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_table *plan = NULL;
    wt_log *log = wt_log_new();
    wt_run_options options = wt_run_defaults();
    options.replicates = 3;
    options.tolerance = tolerance;
    wt_log_add(log, WT_WARNING, "file", "line 1", "a warning");
    wt_error err = WT_ERROR_INIT;
    if (case_from_bytes(changed, strlen(changed), path, &c, &err) != WT_OK ||
        wt_run_case(c, &options, log, &result, NULL, &err) != WT_OK)
        fail_msg("%s: %s", err.place, err.message);
    assert_int_equal(wt_plan(c, &plan, NULL), WT_OK);
    see(plan);
    for (size_t i = 0; i < wt_result_n_tables(result); i++)
        see(wt_result_table(result, i));
    wt_table_free(plan);
    assert_int_equal(wt_result_contents(result, &plan, NULL), WT_OK);
    see(plan);
    wt_table_free(plan);
    assert_int_equal(wt_table_keys(wt_result_find(result, "friction"), &plan, NULL), WT_OK);
    see(plan);
    wt_table_free(plan);
    wt_result_free(result);
    if (errors)
        run_errors(c, options);
    wt_log_free(log);
    wt_case_free(c);
}

/* The incompressible isotropic solid is not a transversely isotropic one. */
static void test_transverse_isotropy(void **state)
{
    (void)state;
    static const double velocity = 0.1;
    sliding_set_up(&velocity, 1);
    rubber.is_transverse = true;
    rubber.transverse = wt_transverse_defaults();
    rubber.transverse.axial_storage = rubber.transverse.axial_loss = 2.5;
    for (int i = 0; i < 2; i++) {
        wt_table *table = NULL;
        rubber.poisson_ratio = i == 0 ? 0.49 : 0.5;
        assert_int_equal(wt_transverse_isotropy_compute(&sliding, &work, &table, NULL), WT_OK);
        see(table);
        wt_table_free(table);
    }
}

static void run_case(const char *text, const char *instead)
{
    run_case_of(CASE "case.xml", false, wt_run_defaults().tolerance, text, instead);
}

static void test_cases(void **state)
{
    (void)state;
    run_case_of(CASE "case.xml", true, wt_run_defaults().tolerance, "", "");
    run_case_of(CASE "case.xml", false, 1e-16, "", ""); /* never reached */
    run_case("<end>2e6rad/m", "<end>2e7rad/m");         /* outside the resolved range of the maps */
    run_case_of(CASE "stated-road.xml", false, wt_run_defaults().tolerance, "", "");
    run_case("<temperature>23degC", "<temperature>90degC");
    run_case("<temperature>23degC", "<track-temperature>24degC</track-temperature>"
                                    "<cantilevers>two</cantilevers>"
                                    "<sensitivity-error>0.3</sensitivity-error>"
                                    "<piezo-nonlinearity>0.01</piezo-nonlinearity>"
                                    "<detector-nonlinearity>0.01</detector-nonlinearity>"
                                    "<misfit-p-threshold>0</misfit-p-threshold>"
                                    "<temperature>23degC");
    run_case("<temperature>30degC", "<temperature>90degC");
    run_case("<temperature>30degC</temperature>",
             "<strain-softening><file>softening.txt</file></strain-softening>"
             "<temperature>30degC</temperature>"
             "<decades>yes</decades>");
    run_case("<temperature>30degC", "<flash-temperature>yes</flash-temperature>"
                                    "<temperature>30degC");
    run_case("<vertical-shift>tied</vertical-shift>",
             "<vertical-shift>tied</vertical-shift>"
             "<sample-temperature-error>0.7K</sample-temperature-error>");
    run_case("</dma>", "<transverse><axial-storage>1.2</axial-storage></transverse></dma>");
    run_case("<critical-energy>2e10J/m^3 +- 10%</critical-energy>",
             "<observed-thickness>3um</observed-thickness>");
    run_case("<files>dma.txt", "<files>absent.txt</files><files>dma.txt");
    run_case("<vertical-shift>tied</vertical-shift>\n"
             "    <files>dma.txt</files>", /* a material without draws */
             "<prony deformation=\"tension\"><equilibrium>5MPa</equilibrium>"
             "<term time=\"1e-4s\" modulus=\"20MPa\"/></prony><wlf><c1>5</c1><c2>100K</c2></wlf>");
}

/* A melt whose shift law changes to Arrhenius in the cold. The loss modulus of the isotherms up to
 * `odd` is wrong. */
static void write_melt(char *path, double odd)
{
    const wt_shift_law law = {.kind = WT_LAW_WLF_ARRHENIUS,
                              .wlf = {293.15, 9, 110},
                              .activation_energy = 1.2e5,
                              .joint = 253.15};
    uint64_t seed = 3;
    FILE *out = truth_file(path);
    fputs("## table: sweep\n# angular_frequency[rad/s]\tstorage_modulus[Pa]\tloss_modulus[Pa]\t"
          "temperature[K]\tstrain[1]\n",
          out);
    for (double t = 213.15; t < 340; t += 10) {
        const double log_a = wt_shift_law_log_a(&law, t);
        for (double x = -1; x < 2.1; x += 0.2) {
            double storage = 0, loss = 0;
            for (double l = -9; l <= 0; l += 0.25) {
                const double z = pow(10, x + log_a + l);
                storage += 1e6 * pow(10, -0.3 * l) * z * z / (1 + z * z);
                loss += 1e6 * pow(10, -0.3 * l) * z / (1 + z * z);
            }
            loss *= t < odd ? exp(0.8 * sin(t)) : 1;
            fprintf(out, "%.17g\t%.17g\t%.17g\t%.17g\t0.001\n", pow(10, x),
                    storage * exp(0.005 * truth_normal(&seed)),
                    loss * exp(0.005 * truth_normal(&seed)), t);
        }
        fputs("\n", out);
    }
    fclose(out);
}

/* No equilibrium modulus, two laws. */
static void test_joined_law(void **state)
{
    (void)state;
    static char path[] = "/tmp/weartrack-put-XXXXXX";
    const char *const patterns[] = {path};
    const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job common = wt_job_defaults();
    wt_master_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    write_melt(path, 0);
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.fit.reference_temperature = 293.15;
    if (wt_master_compute(&job, &common, &tables, NULL, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_string_equal(wt_table_key(tables.shift_factors, "law"), "joined");
    see(tables.shift_factors);
    see(tables.prony);
    see(tables.prony_reduced);
    see(tables.relaxation_spectrum);
    see(tables.influences);
    see(tables.material_draws);
    wt_master_tables_clear(&tables);
    job.fit.shift_by = WT_SHIFT_STORAGE;
    assert_int_equal(wt_master_compute(&job, &common, &tables, NULL, NULL), WT_OK);
    see(tables.shift_factors);
    wt_master_tables_clear(&tables);
    unlink(path);
}

/* After a step of strain, and after a step of stress. */
static void step_jobs(void **state)
{
    (void)state;
    static const char *const files[] = {FORMATS "table-step/relaxation-two-temperatures.txt",
                                        FORMATS "table-step/creep-two-temperatures.txt"};
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        const wt_file_set set = {
            .patterns = &files[i], .n_patterns = 1, .read = wt_read_defaults()};
        wt_master_job job = wt_master_job_defaults();
        wt_job common = wt_job_defaults();
        wt_master_tables tables = {0};
        common.formats = formats;
        job.sets = &set;
        job.n_sets = 1;
        assert_int_equal(wt_master_compute(&job, &common, &tables, NULL, NULL), WT_OK);
        assert_string_equal(wt_table_key(tables.shift_factors, "shifted_by"),
                            i == 0 ? "relaxation modulus" : "creep compliance");
        see(tables.master_curve);
        wt_master_tables_clear(&tables);
    }
}

/* One spectrum fails in the cold or everywhere: in a part, or with shifts by overlaps. */
static void test_no_superposition(void **state)
{
    (void)state;
    static char path[] = "/tmp/weartrack-put-XXXXXX";
    const char *const patterns[] = {path};
    const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    static const double odd[] = {265, 400};
    for (int i = 0; i < 2; i++) {
        wt_master_job job = wt_master_job_defaults();
        wt_job common = wt_job_defaults();
        wt_master_tables tables = {0};
        memcpy(path + strlen(path) - 6, "XXXXXX", 6);
        write_melt(path, odd[i]);
        common.formats = formats;
        job.sets = &set;
        job.n_sets = 1;
        job.fit.reference_temperature = 303.15;
        assert_int_equal(wt_master_compute(&job, &common, &tables, NULL, NULL), WT_OK);
        assert_true((wt_table_key(tables.shift_factors, "route") != NULL) == (i == 1));
        assert_true((wt_table_key(tables.shift_factors, "valid_from") != NULL) == (i == 0));
        assert_true(strncmp(wt_table_key(tables.shift_factors, "superposition"),
                            i == 0 ? "fails up to" : "fails: ", i == 0 ? 11 : 7) == 0);
        see(tables.shift_factors);
        wt_master_tables_clear(&tables);
        unlink(path);
    }
}

/* Cases with names, and one pair without them. */
static void test_collection(void **state)
{
    (void)state;
    wt_collection_tables tables = {0};
    wt_case *read = NULL;
    wt_run_options options = wt_run_defaults();
    options.replicates = 3;
    assert_int_equal(wt_case_read(WT_SOURCE_DIR "/fixtures/case/case.xml", &read, NULL), WT_OK);
    assert_int_equal(wt_run_case(read, &options, NULL, &fixture_case, NULL, NULL), WT_OK);
    wt_case_free(read);
    fixture_of_case("layer", "identification");
    fixture_ramp();
    fixture_collect(&tables);
    see(tables.collection);
    see(tables.collected_modulus);
    see(tables.collected_friction);
    see(tables.collected_ramp);
    see(tables.collected_force);
    see(tables.ratio_pairs);
    wt_tables_clear(&tables, sizeof tables);
    wt_collect_job job = wt_collect_job_defaults();
    wt_result *labelled = fixture_labelled("HC", "mild", 0.6, 0.02);
    see(wt_result_find(labelled, "answer"));
    fixture_check(wt_table_set_key((wt_table *)wt_result_find(labelled, "ramp"), "deformation",
                                   "shear", NULL));
    const wt_collected_result cases[] = {{labelled, "a.h5"}, {fixture_case, "b.h5"}};
    assert_int_equal(wt_collection_compute(cases, 2, &job, &tables, NULL), WT_OK);
    assert_null(tables.ratio_pairs);
    see(tables.collected_ramp);
    wt_tables_clear(&tables, sizeof tables);
    wt_result_free(labelled);
    fixture_free();
}

/* The bundled material, one with a narrower range, and one of another deformation. */
static void test_materials(void **state)
{
    (void)state;
    const char *const patterns[] = {CASE "dma.txt"};
    const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    wt_master_job job = wt_master_job_defaults();
    wt_master_tables fitted = {0};
    wt_rubber made[2] = {0};
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_master_compute(&job, &common, &fitted, &made[0], &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(fitted.prony_reduced);
    wt_master_tables_clear(&fitted);
    assert_int_equal(wt_master_compute(&job, &common, &fitted, &made[1], NULL), WT_OK);
    wt_master_tables_clear(&fitted);
    for (int k = 0; k < 2; k++)
        wt_rubber_clear(&made[k]);
}

static void shift_waves(wt_table *copy, size_t row)
{
    /* a fifth of the residual, on a soft layer of 100 nm */
    static const double wave[] = {1.513e-4, 6.242e-4, -5.172e-4, -1.915e-4, -3.442e-4, -8.22e-5};
    for (size_t i = 0; i < COUNT_OF(wave); i++) {
        char name[32];
        snprintf(name, sizeof name, "misfit_wave_%zu", i + 1);
        const size_t column = (size_t)wt_table_find(copy, name);
        fixture_put(copy, name, wt_table_number(copy, row, column) + wave[i]);
    }
}

/* The bundled case with the residual of a layer in its track, whose thickness the curves
 * determine. */
static void test_layer_by_curves(void **state)
{
    (void)state;
    const fixture_change layered = {.table = "indentation/track", .edit = shift_waves};
    wt_case *read = NULL;
    wt_result *result = NULL;
    wt_table *table = NULL;
    wt_compare_job job = wt_compare_job_defaults();
    const wt_job common = wt_job_defaults();
    assert_int_equal(wt_case_read(CASE "case.xml", &read, NULL), WT_OK);
    assert_int_equal(
        wt_case_request_tables(read, "track_layer indentation/bulk indentation/track", NULL),
        WT_OK);
    assert_int_equal(wt_run_case(read, NULL, NULL, &result, NULL, NULL), WT_OK);
    wt_table *const track = fixture_copy(wt_result_find(result, "indentation/track"), &layered);
    job.bulk = wt_result_find(result, "indentation/bulk");
    job.track = track;
    job.expected_thickness = (wt_estimate){3e-7, 2e-8, 0, "m"};
    assert_int_equal(wt_track_layer_compute(&job, NULL, &common, &table, NULL), WT_OK);
    see(table);
    wt_table_free(table);
    wt_table_free(track);
    wt_result_free(result);
    wt_case_free(read);
}

/* One position of each, with a stated scatter. */
static void test_one_position_per_group(void **state)
{
    (void)state;
    static const char *const files[] = {CASE "bulk-1.jpk-force-map", CASE "track-1.jpk-force-map"};
    wt_indent_job job = wt_indent_job_defaults();
    wt_compare_job compared = wt_compare_job_defaults();
    wt_job common = wt_job_defaults();
    wt_indent_tables tables[2] = {{0}};
    wt_compare_tables both = {0};
    common.formats = formats;
    job.tip = (wt_tip){.sides = 4, .half_angle = M_PI / 9, .radius = 20e-9};
    job.tip.transition_radius = wt_tip_tangent_transition(job.tip.radius, job.tip.half_angle);
    for (int g = 0; g < 2; g++) {
        const wt_file_set set = {&files[g], 1, NULL, wt_read_defaults(), NULL};
        job.sets = &set;
        job.n_sets = 1;
        assert_int_equal(wt_indent_group(&job, &common, &tables[g], NULL), WT_OK);
    }
    compared.bulk = tables[0].indentation;
    compared.track = tables[1].indentation;
    compared.spot_scatter = 0.1;
    assert_int_equal(wt_compare_groups(&compared, &common, &both, NULL), WT_OK);
    see(both.comparison);
    wt_tables_clear(&both, sizeof both);
    for (int g = 0; g < 2; g++)
        wt_indent_tables_clear(&tables[g]);
}

/* A group with different cantilevers, and a tip for which the modulus changes with depth. */
static void test_spring_constants(void **state)
{
    (void)state;
    static const char *const files[] = {CASE "bulk-1.jpk-force-map", CASE "bulk-3.jpk-force-map",
                                        CASE "bulk-4.jpk-force-map", CASE "bulk-2.jpk-force-map"};
    wt_file_set sets[2] = {{files, 4, NULL, wt_read_defaults(), NULL},
                           {&files[3], 1, NULL, wt_read_defaults(), NULL}};
    sets[1].read.spring_constant = 0.2;
    wt_indent_job job = wt_indent_job_defaults();
    wt_job common = wt_job_defaults();
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.sets = sets;
    job.n_sets = 2;
    job.tip = (wt_tip){.sides = 4, .half_angle = M_PI / 9, .radius = 30e-9}; /* it was 20 nm */
    job.tip.transition_radius = wt_tip_tangent_transition(job.tip.radius, job.tip.half_angle);
    job.n_sets = 1;
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    see(tables.modulus_depth);
    wt_indent_tables_clear(&tables);
    sets[0].n_patterns = 1;
    job.n_sets = 2;
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    see(tables.indentation);
    wt_indent_tables_clear(&tables);
    static const char *const looked_at[] = {"worst:2"};
    FILE *by_hand = fopen("put-choices.tsv", "w");
    assert_non_null(by_hand);
    (void)fputs("# file[text]\tcurve[1]\tchoice[text]\tvalue[text]\tnote[text]\n"
                "bulk-1.jpk-force-map\t0\texclude\t-\tan edge\n"
                "bulk-2.jpk-force-map\tnan\tsensitivity\t58nm/V\t-\n",
                by_hand);
    assert_int_equal(fclose(by_hand), 0);
    job.curves = looked_at;
    job.n_curves = 1;
    job.choices = "put-choices.tsv";
    job.tip.sample_thickness.value = 20e-6;
    job.tip.sample_thickness.standard_error = 1e-6;
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    see(tables.indentation);
    see(tables.curves);
    see(tables.choices);
    wt_indent_tables_clear(&tables);
    assert_int_equal(unlink("put-choices.tsv"), 0);
    job.n_curves = 0;
    job.choices = NULL;
    job.tip.sample_thickness = (wt_estimate){0};
    job.options.fit_force_fraction = 0.9;
    job.options.fit_retract = true;
    job.tip.radius_error = 3e-9;
    job.tip.half_angle_error = 0.02;
    job.sensitivity = (wt_estimate){60e-9, 2e-9, 0, "m/V"};
    job.lever_error = 0.1;
    sets[1].read.spring_constant = (double)NAN; /* two positions then */
    if (wt_indent_group(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    see(tables.indentation);
    wt_table *budget = NULL;
    const wt_table *const listed[] = {tables.indentation};
    assert_int_equal(wt_modulus_budget_table(listed, 1, &budget, NULL), WT_OK);
    see(budget);
    wt_table_free(budget);
    wt_indent_tables_clear(&tables);
}

static void convert_with(const char *path, unsigned kind, wt_table_sink sink)
{
    wt_convert_job job = wt_convert_job_defaults();
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.kind = kind;
    if (wt_convert_file(&job, path, &common, sink, NULL, &err) != WT_OK)
        fail_msg("%s: %s", path, err.message);
}

static void convert(const char *path, unsigned kind)
{
    convert_with(path, kind, see_and_free);
}

/* A column without a width to divide by. */
static wt_status one_column(void *user, wt_table *table, wt_error *err)
{
    const long x = wt_table_find(table, "x");
    assert_true(x >= 0);
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        assert_true(isfinite(wt_table_number(table, row, (size_t)x)));
    return see_and_free(user, table, err);
}

static void test_conversions(void **state)
{
    (void)state;
    static const char path[] = "test_tables_put.nid";
    const double values[4] = {0, 1, 0, 1};
    const nid_writer_channel channel = {0, "Z-Axis", "m", 0, 2, 16, values};
    nid_writer_group group = {.name = "Scan forward",
                              .points = 2,
                              .lines = 2,
                              .x_name = "X",
                              .x_unit = "m",
                              .y_name = "Y",
                              .y_unit = "m",
                              .x_range = 1,
                              .y_range = 1,
                              .n_channels = 1,
                              .channels = &channel};
    nid_writer_file file = nid_writer_defaults();
    file.path = path;
    file.groups = &group;
    file.n_groups = 1;
    assert_int_equal(nid_write(&file), 0);
    convert(path, WT_KIND_IMAGE);
    group.points = 1;
    group.lines = 4;
    assert_int_equal(nid_write(&file), 0);
    convert_with(path, WT_KIND_IMAGE, one_column);
    (void)remove(path);
    convert(CASE "bulk-1.jpk-force-map", WT_KIND_FORCE);
    convert(CASE "dma.txt", WT_KIND_SWEEP);
    convert(FORMATS "stare/isotherm.txt", WT_KIND_SWEEP);
    convert(FORMATS "table-units/loss-factor-only.csv", WT_KIND_SWEEP);
    convert(FORMATS "table-step/relaxation.csv", WT_KIND_SWEEP);
    convert(FORMATS "table-step/tensile-creep.csv", WT_KIND_SWEEP);
    convert(FORMATS "table-step/relaxation-two-temperatures.txt", WT_KIND_SWEEP);
    convert(FORMATS "table-step/creep-two-temperatures.txt", WT_KIND_SWEEP);
    convert(FORMATS "table-spectrum/surface.txt", WT_KIND_SPECTRUM);
    convert(FORMATS "table-spectrum/line.csv", WT_KIND_SPECTRUM);
}

/* A temperature sweep with peaks, and isotherms without one. */
static void test_ramps(void **state)
{
    (void)state;
    static const char *const files[] = {FORMATS "table-units/ramp.csv", CASE "dma.txt",
                                        FORMATS "table-units/ramp-with-strain.csv",
                                        FORMATS "table-units/ramp-frequencies-in-turn.txt"};
    static const double at[] = {290, 500};
    wt_job common = wt_job_defaults();
    common.formats = formats;
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        const wt_file_set set = {
            .patterns = &files[i], .n_patterns = 1, .read = wt_read_defaults()};
        wt_ramp_job job = wt_ramp_job_defaults();
        wt_ramp_tables tables = {0};
        wt_error err = WT_ERROR_INIT;
        job.sets = &set;
        job.n_sets = 1;
        job.temperature = at;
        job.n_temperatures = COUNT_OF(at);
        if (wt_ramp_compute(&job, &common, &tables, &err) != WT_OK)
            fail_msg("%s %s", err.message, err.found);
        see(tables.ramp);
        see(tables.glass_transition);
        see(tables.moduli_at);
        wt_tables_clear(&tables, sizeof tables);
    }
}

/* A layer with all its quantities. */
static void test_layer_models(void **state)
{
    (void)state;
    static const double velocity[] = {1e-3, 0.1, 10};
    const wt_layer_observation observation = {.modulus_ratio = {0.6, 0, 0, "1"},
                                              .ratio_slope = {0.05, 0.01, 0, "1"},
                                              .ratio_frequency = 1e3,
                                              .ratio_lowest = 10,
                                              .ratio_highest = 1e5,
                                              .ratio_temperature = (double)NAN};
    wt_layer_job job = wt_layer_job_defaults();
    wt_layer_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    sliding_set_up(velocity, 3);
    job.specific_wear_rate.value = 1e-12;
    job.energy = WT_LAYER_BOTH;
    job.critical_energy = (wt_estimate){2e10, 1e9, 0, "J/m^3"};
    assert_int_equal(wt_layer_thickness_compute(&sliding, &job, &work, &tables, &err), WT_OK);
    see(tables.layer);
    wt_table_free(tables.layer);
    wt_layer_observation sheared = observation;
    sheared.thickness = (wt_estimate){1e-6, 0, 0, "m"};
    wt_friction_tables friction = {0};
    assert_int_equal(wt_sliding_friction_compute(&sliding, &sheared, &work, &friction, &err),
                     WT_OK);
    see(friction.friction);
    wt_table_free(friction.friction);
}

/* A velocity without hysteresis: there is no share of friction. */
static void test_no_hysteresis(void **state)
{
    (void)state;
    static double slow[] = {1e-323, 1}, tau[] = {1e-9}, term[] = {3e8}, strain[] = {1e-3, 1e-2},
                  ratio[] = {1, 0.7};
    const wt_strain_softening s = {
        .table = {.n = 2, .strain = strain, .storage = ratio, .loss = ratio},
        .temperature = (double)NAN};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    sliding_set_up(slow, 2);
    rubber.prony.n = 1;
    rubber.prony.relaxation_time = tau;
    rubber.prony.modulus = term;
    sliding.strain_softening = &s;
    if (wt_softened_friction_compute(&sliding, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_true(wt_table_number(table, 0, (size_t)wt_table_find(table, "hysteresis")) <= 0);
    for (size_t row = 0; row < 2; row++) {
        const size_t below = (size_t)wt_table_find(table, "share_below"),
                     above = (size_t)wt_table_find(table, "share_above");
        assert_int_equal(isnan(wt_table_number(table, row, below)), row == 0);
        assert_int_equal(isnan(wt_table_number(table, row, above)), row == 0);
    }
    assert_string_equal(wt_table_key(table, "shares_unknown"),
                        "1 of 2 velocities have no hysteresis friction, of which there could be a "
                        "share");
    see(table);
    wt_table_free(table);
}

/* Glassy rubber: a hot contact stays hot, and burns at a high velocity. */
static void test_flash(void **state)
{
    (void)state;
    static double velocity[] = {1e-3, 10, 1e4},
                  tau[] = {1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11},
                  term[] = {1e6, 1.2e6, 1.6e6, 2.4e6, 4e6, 8e6, 2e7, 6e7, 2e8, 5e8, 7e8, 4e8};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    sliding_set_up(velocity, 3);
    rubber.prony.n = COUNT_OF(tau);
    rubber.prony.relaxation_time = tau;
    rubber.prony.modulus = term;
    rubber.prony.equilibrium_modulus = 5e6;
    rubber.law = (wt_shift_law){.kind = WT_LAW_WLF,
                                .wlf = {.c1 = 7.4, .c2 = 121.6, .reference_temperature = 293.15}};
    rubber.temperature_min = 210;
    rubber.temperature_max = 230;
    surface = (wt_surface){.self_affine = true, .q0 = 500, .qr = 2000, .q1 = 1e6, .hurst = 0.8};
    surface.c0 = (wt_estimate){6e-16, 0, 0, "m^4"};
    sliding.temperature.value = 253.15;
    sliding.pressure.value = 10e6;
    sliding.flash.on = true;
    sliding.flash.contact_size = 5e-3;
    sliding.flash.macroscopic = 0.1;
    sliding.reference_velocity = 1e-3;
    if (wt_flash_temperature_compute(&sliding, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    const char *const range = wt_table_key(table, "law_range");
    assert_non_null(range);
    assert_non_null(strstr(range, "above the isotherms"));
    see(table);
    wt_table_free(table);
    sliding.temperature.value = 293.15;
    sliding.pressure.value = 30e6;
    sliding.flash.contact_size = 1;
    sliding.flash.macroscopic = 0.01;
    velocity[1] = 100;
    if (wt_flash_temperature_compute(&sliding, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    const char *const unsettled = wt_table_key(table, "unsettled");
    assert_non_null(unsettled);
    assert_non_null(strstr(unsettled, "no stable temperature below 300 degC"));
    see(table);
    wt_table_free(table);
}

/* Strain sweeps up to half of the fall and its double. */
static void test_strain_sweeps(void **state)
{
    (void)state;
    static const char *const file[] = {FORMATS "tidy/strain-sweeps.csv"};
    const wt_file_set set = {.patterns = file, .n_patterns = 1, .read = wt_read_defaults()};
    wt_job common = wt_job_defaults();
    wt_payne_job job = wt_payne_job_defaults();
    wt_payne_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_payne_compute(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_int_equal(wt_table_n_rows(tables.payne), 3);
    see(tables.payne);
    see(tables.payne_sweep);
    wt_tables_clear(&tables, sizeof tables);
    wt_file_set named = set;
    named.read.sample_by = WT_SAMPLE_BY_FILE;
    job.sets = &named;
    assert_int_equal(wt_payne_compute(&job, &common, &tables, NULL), WT_OK);
    see(tables.payne);
    see(tables.payne_sweep);
    wt_tables_clear(&tables, sizeof tables);
    convert(file[0], WT_KIND_SWEEP);
}

/* Curves on a hard surface, from a file that states its sensitivity. */
static void test_calibration(void **state)
{
    (void)state;
    enum { N = 200, CURVES = 2 };
    static const char path[] = "test_tables_put.jpk-force-map";
    static double height[2][N], force[3][N];
    const jpk_writer_segment there = {"extend", N, 1, height[0], force[0], NULL},
                             back = {"retract", N, 1, height[1], force[1], NULL},
                             back_again = {"retract", N, 1, height[1], force[2], NULL};
    const jpk_writer_segment segments[CURVES][2] = {{there, back}, {there, back_again}};
    const jpk_writer_curve curves[CURVES] = {{0, 0, 0, 2, segments[0]},
                                             {1, 1e-6, 0, 2, segments[1]}};
    const char *const patterns[] = {path};
    const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    wt_job common = wt_job_defaults();
    jpk_writer_file file = jpk_writer_defaults();
    for (size_t i = 0; i < N; i++) {
        height[0][i] = height[1][N - 1 - i] = 1e-6 - 1e-9 * (double)i;
        force[0][i] = i > 150 ? 1e-9 * (double)(i - 150) * 0.1 : 0;
        force[1][N - 1 - i] = 1.01 * force[0][i];
        force[2][N - 1 - i] = 1.02 * force[0][i];
    }
    file.path = path;
    file.map = true;
    file.n_curves = CURVES;
    file.curves = curves;
    file.spring_constant = 0.1;
    file.sensitivity = 50e-9;
    assert_int_equal(jpk_write(&file), 0);
    common.formats = formats;
    wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_sensitivity_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_sensitivity_compute(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(tables.sensitivity);
    see(tables.sensitivity_curves);
    wt_tables_clear(&tables, sizeof tables);
    (void)remove(path);
}

/* A reciprocating record with all channels, then a disc, once with all data of its
 * wear and once without. */
static void test_record(void **state)
{
    (void)state;
    static const char strokes[] = "test_tables_put_strokes.csv",
                      disc[] = "test_case_tables_written_disc.csv";
    uint64_t seed = 4;
    FILE *out = fopen(strokes, "w");
    assert_non_null(out);
    fprintf(out, "time (s),distance (m),cycle,position (mm),v (mm/s),rotation (rad/s),T (degC),"
                 "pressure (MPa),Ff (N),Fn (N),mu,wear depth (um)\n");
    for (int i = 0; i < 40 * 60; i++) {
        const double phase = 2 * M_PI * (i + 0.5) / 40, way = sin(phase) > 0 ? 1 : -1,
                     lap = i / 40.0, force = (lap < 20 ? 6 : 5) + 0.1 * truth_normal(&seed);
        fprintf(out, "%g,%g,%g,%g,%g,2,%g,%g,%g,10,%g,%g\n", 0.02 * i, 5e-4 * i, lap,
                -5 * cos(phase), 25.0, 23.0, 0.4, way * force + 0.3, 0.1 * force + 0.001,
                1 + 0.01 * i);
    }
    fclose(out);
    out = fopen(disc, "w");
    assert_non_null(out);
    fprintf(out, "time (s),laps,mu\n");
    for (int i = 0; i < 50 * 60; i++)
        fprintf(out, "%g,%g,%g\n", 0.02 * i, i / 50.0,
                0.5 + 0.01 * (i % 25) + 0.001 * truth_normal(&seed));
    fclose(out);
    for (int known = 0; known < 2; known++) {
        const char *const patterns[] = {known ? strokes : disc};
        const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
        wt_job common = wt_job_defaults();
        wt_record_job job = wt_record_job_defaults();
        wt_record_tables tables = {0};
        wt_error err = WT_ERROR_INIT;
        common.formats = formats;
        job.sets = &set;
        job.n_sets = 1;
        job.ball_radius.value = 3e-3;
        if (known) {
            job.track_length = (wt_estimate){10e-3, 0, 0, "m"};
            job.track_radius = (wt_estimate){12e-3, 0, 0, "m"};
            job.track_area = (wt_estimate){1e-10, 1e-11, 0, "m^2"};
            job.mass_loss = (wt_estimate){1e-6, 1e-7, 0, "kg"};
            job.density = (wt_estimate){1150, 0, 0, "kg/m^3"};
            job.modulus.value = 20e6;
        }
        if (wt_record_compute(&job, &common, &tables, &err) != WT_OK)
            fail_msg("%s %s", err.message, err.found);
        see(tables.record);
        see(tables.record_cycles);
        see(tables.wear);
        wt_tables_clear(&tables, sizeof tables);
    }
    (void)remove(strokes);
    (void)remove(disc);
}

static void test_files(void **state)
{
    (void)state;
    wt_input *input = NULL;
    wt_table *table = NULL;
    /* The file of this curve states no sensitivity; an option does. */
    assert_int_equal(wt_input_open(FORMATS "table-force/volts.csv", &input, NULL), WT_OK);
    assert_int_equal(wt_input_describe(formats, input, NULL, NULL, &table, NULL), WT_OK);
    see(table);
    wt_table_free(table);
    wt_input_close(input);
    assert_int_equal(wt_input_open(FORMATS "tidy/two-runs.csv", &input, NULL), WT_OK);
    assert_int_equal(wt_input_describe(formats, input, NULL, NULL, &table, NULL), WT_OK);
    see(table);
    wt_table_free(table);
    assert_int_equal(wt_format_description_check(WT_SOURCE_DIR "/formats/tidy.xml", input, NULL,
                                                 NULL, &table, NULL),
                     WT_OK);
    see(table);
    wt_table_free(table);
    wt_input_close(input);
}

/* An image of a wave. */
static void test_spot(void **state)
{
    (void)state;
    enum { SIDE = 128 };
    static const char path[] = "test_tables_spot.nid";
    static double z[SIDE * SIDE];
    for (size_t i = 0; i < COUNT_OF(z); i++) {
        const double x = (double)(i % SIDE), y = (double)(i / SIDE);
        z[i] = 1e-9 * (sin(0.7 * x) + cos(0.5 * y + 0.2 * x));
    }
    const nid_writer_channel channel = {1, "Z-Axis", "m", -1e-6, 2e-6, 32, z};
    const nid_writer_group group = {"Scan forward", SIDE, SIDE, 0,    NULL, "X*",    "m",
                                    "Y*",           "m",  1e-6, 1e-6, 1,    &channel};
    nid_writer_file file = nid_writer_defaults();
    file.path = path;
    file.n_groups = 1;
    file.groups = &group;
    assert_int_equal(nid_write(&file), 0);
    wt_spot_job job = wt_spot_job_defaults();
    wt_job common = wt_job_defaults();
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.tip = (wt_tip){.shape = WT_TIP_CONE, .half_angle = M_PI / 4};
    job.depth = 60e-9;
    if (wt_spot_compute(&job, path, &common, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(table);
    wt_table_free(table);
    (void)remove(path);
}

/* Two positions and a smaller window, whose spectrum is extrapolated to a slope. The profiles for
 * the line density are columns of another file. */
static void see_surfaces(const char *const *files, size_t n)
{
    const wt_file_set set = {.patterns = files, .n_patterns = n, .read = wt_read_defaults()};
    wt_topography_job job = wt_topography_job_defaults();
    wt_job common = wt_job_defaults();
    wt_topography_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.heights = true;
    job.end_slope = n > 1 ? 1.3 : (double)NAN;
    if (wt_topography_compute(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(tables.power_spectrum);
    if (tables.place_errors != NULL)
        see(tables.place_errors);
    if (tables.angular_spectrum != NULL)
        see(tables.angular_spectrum);
    if (tables.height_map != NULL)
        see(tables.height_map);
    see(tables.height_profile);
    see(tables.surfaces);
    wt_tables_clear(&tables, sizeof tables);
}

static void test_surface(void **state)
{
    (void)state;
    static const char *const files[] = {WT_SOURCE_DIR "/fixtures/surface/place-1.gsf",
                                        WT_SOURCE_DIR "/fixtures/surface/place-2.gsf",
                                        WT_SOURCE_DIR "/fixtures/surface/near-by.gsf"};
    static const char *const profile[] = {WT_SOURCE_DIR "/fixtures/surface/profile-*.gsf"};
    /* two sizes, and positions that scatter because they are of two surfaces */
    static const char *const sizes[] = {WT_SOURCE_DIR "/fixtures/surface/road.gsf",
                                        WT_SOURCE_DIR "/fixtures/surface/place-*.gsf",
                                        WT_SOURCE_DIR "/fixtures/case/road-*-near.gsf"};
    static const char *const both[] = {WT_SOURCE_DIR "/fixtures/surface/place-*.gsf",
                                       WT_SOURCE_DIR "/fixtures/surface/profile-*.gsf"};
    see_surfaces(files, COUNT_OF(files));
    see_surfaces(both, COUNT_OF(both));
    see_surfaces(sizes, COUNT_OF(sizes));
    see_surfaces(profile, 1);
}

/* ---- measured against predicted -------------------------------------------------------------- */

/* A disc with three velocities, one of them zero; friction is `friction` times a power of the
 * velocity. */
static void write_disc(const char *path, double friction, double power, uint64_t seed)
{
    FILE *const out = fopen(path, "w");
    assert_non_null(out);
    fprintf(out, "laps,velocity (mm/s),T (degC),Fn (N),mu\n");
    for (int i = 0; i < 3 * 60 * 25; i++) {
        const double velocity = pow(10, i / (60 * 25)), lap = i / 25.0;
        fprintf(out, "%g,%g,20,%g,%.5f\n", lap, velocity, 5.0 + (i > 60 * 25),
                friction * pow(velocity, power) * (1 + 0.01 * truth_normal(&seed)));
    }
    fclose(out);
}

/* Comparison with a record, with and without wear, with a shear stress (0: none) and a layer. */
static void see_validation(const char *path, double shear, double wear, bool with_layer)
{
    static const double slow[] = {1e-3, 1e-2, 1e-1};
    const char *const patterns[] = {path};
    const wt_file_set set = {.patterns = patterns, .n_patterns = 1, .read = wt_read_defaults()};
    const wt_layer_observation observation = {.thickness = {1e-6, 1e-7, 0, "m"},
                                              .modulus_ratio = {0.6, 0.05, 0, "1"},
                                              .ratio_slope = {0.05, 0.01, 0, "1"},
                                              .ratio_frequency = 1e3,
                                              .ratio_lowest = 10,
                                              .ratio_highest = 1e5,
                                              .ratio_temperature = (double)NAN};
    wt_layer_job layer = wt_layer_job_defaults();
    wt_job common = wt_job_defaults();
    wt_record_job records = wt_record_job_defaults();
    wt_record_tables measured = {0};
    wt_validation_job job = wt_validation_job_defaults();
    wt_validation_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    common.formats = formats;
    common.replicates = 40;
    records.sets = &set;
    records.n_sets = 1;
    records.track_radius.value = 12e-3;
    records.track_area = (wt_estimate){3e-11, wear * 3e-11, 0, "m^2"};
    sliding_set_up(slow, 3);
    sliding.shear_stress =
        (wt_estimate){shear > 0 ? shear : (double)NAN, 0.1 * fmax(shear, 0), 0, "Pa"};
    layer.specific_wear_rate = (wt_estimate){1e-12, 1e-13, 0, "m^2/N"};
    layer.critical_energy.value = 2e10;
    if (wt_record_compute(&records, &common, &measured, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    job.sliding = &sliding;
    job.layer = &layer;
    job.layer_observation = with_layer ? &observation : NULL;
    job.record = measured.record;
    job.wear = measured.wear;
    if (wt_validation_compute(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(tables.validation);
    see(tables.sources);
    wt_tables_clear(&tables, sizeof tables);
    wt_tables_clear(&measured, sizeof measured);
}

/* The running-in of a case against a growing layer, or without a known layer. */
static void see_running_in(const char *path)
{
    wt_case *read = NULL;
    wt_result *result = NULL;
    wt_run_options few = wt_run_defaults();
    size_t failed = 0;
    wt_error err = WT_ERROR_INIT;
    few.replicates = 20;
    if (wt_case_read(path, &read, &err) != WT_OK ||
        wt_case_request_tables(read, "validation_running_in validation_course wear", &err) !=
            WT_OK ||
        wt_run_case(read, &few, NULL, &result, &failed, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(wt_result_find(result, "validation_running_in"));
    see(wt_result_find(result, "validation_course"));
    wt_result_free(result);
    wt_case_free(read);
}

static void test_validation(void **state)
{
    (void)state;
    static const char path[] = "test_tables_put_validation.csv";
    write_disc(path, 0.95, 0, 5);
    see_validation(path, 5e6, 0.2, true);
    see_validation(path, 0, 0, false);
    write_disc(path, 0.05, 0.3, 6);
    see_validation(path, 5e6, 0.2, false);
    see_running_in(WT_SOURCE_DIR "/fixtures/growth/case.xml");
    see_running_in(WT_SOURCE_DIR "/fixtures/growth/unsaid.xml");
    (void)remove(path);
}

/* ---- identification -------------------------------------------------------------------------- */

static void test_identification(void **state)
{
    (void)state;
    static const double slow[] = {0.1};
    wt_identify_job job = wt_identify_job_defaults();
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    sliding_set_up(slow, 1);
    work.replicates = 120;
    sliding.pressure.standard_error = 1e4;
    job.observed_thickness = (wt_estimate){2e-6, 3e-7, 0, "m"};
    job.specific_wear_rate = (wt_estimate){1e-12, 1e-13, 0, "m^2/N"};
    job.running_in_time = (wt_estimate){500, 50, 0, "s"};
    if (wt_identification_compute(&sliding, &job, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    see(table);
    assert_int_equal(wt_table_n_rows(table), 4);
    wt_table_free(table);
}

static void test_data_quality(void **state)
{
    (void)state;
    wt_log *log = wt_log_new();
    wt_table *table = NULL;
    wt_log_action(log, WT_WARNING, WT_CORRECTED, 2, "--scan-lines keep", "map.gsf", "line 3",
                  "scars");
    assert_int_equal(wt_data_quality_table(log, NULL, &table, NULL), WT_OK);
    see(table);
    wt_table_free(table);
    wt_log_free(log);
}

/* ---- tables that were not written ------------------------------------------------------------ */

/* Every fit of isotherms converges; a key warns of one that does not. The moduli of this program
 * have the same ratio at all rates; unit_study_ratio_pairs has others. */
static bool is_never_met(const table_schema *schema, size_t key)
{
    const char *const name = schema->keys[key].name;
    return (schema == &shift_factors_schema && strcmp(name, "step_left") == 0) ||
           (schema == &comparison_schema && strcmp(name, "rate_spread") == 0);
}

static void test_everything_is_written(void **state)
{
    (void)state;
    bool good = true;
    for (size_t i = 0; i < table_n_schemas; i++) {
        const table_schema *s = table_schemas[i];
        if (!found[i].table)
            print_error("%s: never made\n", s->name);
        good = good && found[i].table;
        for (size_t k = 0; found[i].table && k < s->n_columns; k++) {
            const bool put =
                (s->columns[k].sparse ? found[i].cells : found[i].columns) & SCHEMA_BIT(k);
            if (!put)
                print_error("%s: column %s is never put\n", s->name, s->columns[k].name);
            good = good && put;
        }
        for (size_t k = 0; found[i].table && k < s->n_keys; k++) {
            const bool put = (found[i].keys & SCHEMA_BIT(k)) != 0 || is_never_met(s, k);
            if (!put)
                print_error("%s: key %s is never put\n", s->name, s->keys[k].name);
            good = good && put;
        }
    }
    assert_true(good);
}

static int open_formats(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK && table_n_schemas <= MOST ? 0 : -1;
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
        cmocka_unit_test(step_jobs),
        cmocka_unit_test(test_cases),
        cmocka_unit_test(test_joined_law),
        cmocka_unit_test(test_no_superposition),
        cmocka_unit_test(test_collection),
        cmocka_unit_test(test_layer_models),
        cmocka_unit_test(test_no_hysteresis),
        cmocka_unit_test(test_flash),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_layer_by_curves),
        cmocka_unit_test(test_one_position_per_group),
        cmocka_unit_test(test_spring_constants),
        cmocka_unit_test(test_conversions),
        cmocka_unit_test(test_ramps),
        cmocka_unit_test(test_strain_sweeps),
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_record),
        cmocka_unit_test(test_validation),
        cmocka_unit_test(test_identification),
        cmocka_unit_test(test_transverse_isotropy),
        cmocka_unit_test(test_spot),
        cmocka_unit_test(test_surface),
        cmocka_unit_test(test_data_quality),
        cmocka_unit_test(test_everything_is_written),
    };
    return cmocka_run_group_tests_name("tables put", tests, open_formats, free_formats);
}
