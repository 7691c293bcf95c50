/* Standard errors in the main tables: each is known, unknown or zero, depending on the source of
 * the number and its errors. 0 means no error; unknown is nan and named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"

#include "indentation/indent.h"
#include "truth_fixture.h"

/* Four runs: errors of all inputs; no errors; a material without draws and an error of the
 * pressure; no draws, no errors and no measured frequencies. */
enum { ALL, MATERIAL_ONLY, PRESSURE_ONLY, NOTHING, WAYS };

/* For the four runs: known, unknown, or 0 without an error. A column or key with a standard error
 * that is not listed here fails the test. */
typedef struct expectation {
    const table_schema *schema;
    const char *name, *expected;
} expectation;

static const expectation list[] = {
    {&friction_schema, "pressure", "knkn"},
    {&friction_schema, "temperature", "knnn"},
    {&friction_schema, "shear_stress", "knnn"},
    {&friction_schema, "reference_velocity", "0000"},
    {&friction_schema, "friction_at_reference", "kkkn"},
    {&friction_schema, "hysteresis_at_reference", "kkkn"},
    {&friction_schema, "shearing_at_reference", "kkkn"},
    {&friction_schema, "area_ratio_at_reference", "kkkn"},
    {&friction_schema, "strain", "...."}, /* no softening */
    {&friction_schema, "layer_thickness", "knnn"},
    {&friction_schema, "layer_modulus_ratio", "knnn"},
    {&friction_schema, "layer_ratio_slope", "...."}, /* one ratio */
    {&friction_schema, "layer_outside_share", "...."},
    {&friction_schema, "friction_with_layer_at_reference", "kkkn"},
    {&friction_schema, "friction_change_at_reference", "kkkn"},
    {&friction_schema, "relative_change_at_reference", "kkkn"},
    {&friction_schema, "relative_change_low", "nnnn"},
    {&friction_schema, "relative_change_high", "nnnn"},
    {&friction_schema, "shear_stress_at_reference", "...."}, /* it is constant */
    {&friction_schema, "sensitivity_to_modulus", "nnnn"},
    {&friction_schema, "sensitivity_to_spectrum", "nnnn"},
    {&friction_schema, "sensitivity_to_pressure", "nnnn"},
    {&friction_schema, "sensitivity_to_cutoff", "nnnn"},
    {&friction_schema, "friction", "kkkn"},
    {&friction_schema, "hysteresis", "kkkn"},
    {&friction_schema, "area_ratio", "kkkn"},
    {&friction_schema, "friction_with_layer", "kkkn"},
    {&layer_schema, "balance_thickness", "kkkn"},
    {&layer_schema, "wear_sensitivity", "nnnn"},
    {&layer_schema, "formation_wear_ratio", "kkkn"},
    {&layer_schema, "incubation_time", "kkkn"},
    {&layer_schema, "relaxation_time", "kkkn"},
    {&layer_schema, "critical_specific_wear_rate", "kkkn"},
    {&layer_schema, "critical_energy", "knnn"},
    {&layer_schema, "surface_power", "kkkn"},
    {&layer_schema, "time_to_90_percent", "kkkn"},
    {&layer_schema, "velocity", "0000"},
    {&layer_schema, "pressure", "knkn"},
    {&layer_schema, "specific_wear_rate", "knnn"},
    {&layer_schema, "observed_thickness", "...."}, /* not for a stated critical energy */
    {&layer_schema, "thickness", "kkkn"},
    {&layer_schema, "hysteresis_power", "...."}, /* error of the energy of shearing */
    {&layer_schema, "shear_power", "...."},
};

static wt_rubber rubber[WAYS];
static wt_friction_tables friction[WAYS];
static wt_layer_tables layer[WAYS];

static wt_estimate stated(double value, const char *unit, bool known)
{
    return (wt_estimate){value, known ? 0.05 * fabs(value) : 0, 0, unit};
}

static void make(int way)
{
    static const double velocity[2] = {1e-3, 0.1};
    static const fixture_change changes[] = {{"material_draws", .leave_out = true},
                                             {"series_draws", .leave_out = true}};
    const bool all = way == ALL, drawn = way == ALL || way == MATERIAL_ONLY;
    wt_result *result = fixture_changed(fixture_produced(), changes, drawn ? 0 : 2);
    wt_surface surface = {.self_affine = true, .q0 = 2e3, .qr = 4e3, .q1 = 2e4, .hurst = 0.8};
    wt_sliding sliding = wt_sliding_defaults();
    wt_job work = wt_job_defaults();
    wt_layer_observation observation = {.thickness = stated(3e-6, "m", all),
                                        .modulus_ratio = stated(0.6, "1", all)};
    wt_layer_job job = wt_layer_job_defaults();
    wt_error err = WT_ERROR_INIT;
    fixture_check(fixture_rubber(result, &rubber[way], NULL));
    wt_result_free(result);
    rubber[way].c1_error = rubber[way].c2_error = 0;
    if (way == NOTHING)
        rubber[way].prony.frequency_min = rubber[way].prony.frequency_max = (double)NAN;
    surface.c0 = stated(2e-17, "m^4", all);
    sliding.rubber = &rubber[way];
    sliding.surface = &surface;
    sliding.pressure = stated(0.8e6, "Pa", all || way == PRESSURE_ONLY);
    sliding.temperature = (wt_estimate){300, all ? 1 : 0, 0, "K"};
    sliding.shear_stress = stated(5e6, "Pa", all);
    sliding.velocity = velocity;
    sliding.n_velocity = 2;
    job.critical_energy = stated(1e9, "J/m^3", all);
    job.specific_wear_rate = stated(1e-13, "m^2/N", all);
    work.threads = 1;
    work.replicates = 8;
    if (wt_sliding_friction_compute(&sliding, &observation, &work, &friction[way], &err) != WT_OK ||
        wt_layer_thickness_compute(&sliding, &job, &work, &layer[way], &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
}

static char letter(double error)
{
    return isnan(error) ? 'n' : error > 0 ? 'k' : '0';
}

/* Value of a column in its last row. */
static char found(const wt_table *t, const table_schema *schema, size_t field, bool is_key)
{
    wt_estimate e;
    if (is_key)
        return wt_table_estimate(t, schema->keys[field].name, &e) ? letter(e.standard_error) : '.';
    const char *column = schema->columns[schema->columns[field].standard_error].name;
    return letter(cell(t, wt_table_n_rows(t) - 1, column));
}

static bool is_listed(const expectation *from, size_t n, const table_schema *schema,
                      const char *name, const char *words)
{
    for (size_t i = 0; i < n; i++)
        if (from[i].schema == schema && strcmp(from[i].name, name) == 0) {
            if (strcmp(from[i].expected, words) != 0)
                print_error("%s of %s: %s, not %s\n", name, schema->name, words, from[i].expected);
            return strcmp(from[i].expected, words) == 0;
        }
    print_error("%s of %s is not in the list: %s\n", name, schema->name, words);
    return false;
}

/* Every key and column with a standard error, in each of n runs. */
static bool check(const expectation *from, size_t n_listed, const table_schema *schema,
                  const wt_table *const *way, size_t n)
{
    bool good = true;
    for (size_t field = 0; field < schema->n_keys + schema->n_columns; field++) {
        const bool is_key = field < schema->n_keys;
        const size_t i = is_key ? field : field - schema->n_keys;
        if (is_key ? schema->keys[i].kind != SCHEMA_NUMBER : schema->columns[i].standard_error == 0)
            continue;
        char words[WAYS + 1] = "";
        for (size_t w = 0; w < n; w++)
            words[w] = found(way[w], schema, i, is_key);
        good = is_listed(from, n_listed, schema,
                         is_key ? schema->keys[i].name : schema->columns[i].name, words) &&
               good;
    }
    return good;
}

static void test_all(void **state)
{
    (void)state;
    const wt_table *of_friction[WAYS], *of_layer[WAYS];
    for (int way = 0; way < WAYS; way++) {
        make(way);
        of_friction[way] = friction[way].friction;
        of_layer[way] = layer[way].layer;
    }
    const bool good[] = {
        check(list, sizeof list / sizeof list[0], &friction_schema, of_friction, WAYS),
        check(list, sizeof list / sizeof list[0], &layer_schema, of_layer, WAYS)};
    assert_true(good[0] && good[1]);
}

/* ---- measured values ------------------------------------------------------------------------- */

/* The bundled case, and cases with less information: a material without draws, stated vertical
 * shifts, a spring constant without an error. */
static const expectation measured[] = {
    {&comparison_schema, "rate_slope", "kk"},
    {&comparison_schema, "interaction_p", "00"},
    {&comparison_schema, "modulus_ratio", "kk"},
    {&comparison_schema, "modulus_ratio_df", "00"},
    {&comparison_schema, "model_choices_low", "00"}, /* a range has no error */
    {&comparison_schema, "model_choices_high", "00"},
    {&comparison_schema, "rate_spread", ".."},       /* the ratio does not depend on the rate */
    {&comparison_schema, "calibration_share", "00"}, /* gain differences of one tip */
    {&comparison_schema, "spot_scatter", ".."},      /* the positions determine it */
    {&dma_comparison_schema, "temperature", "00"},
    {&dma_comparison_schema, "track_temperature", ".."}, /* not stated */
    {&dma_comparison_schema, "dma_complex_modulus", "kn"},
    {&indentation_schema, "tip_sides", "00"},
    /* it is part of half_angle_error and radius_error */
    {&indentation_schema, "tip_half_angle", "nn"},
    {&indentation_schema, "tip_radius", "nn"},
    {&indentation_schema, "tip_transition_radius", "nn"},
    {&indentation_schema, "sample_thickness", ".."}, /* a thick sample */
    {&indentation_schema, "spring_constant", "kn"},
    {&indentation_schema, "sensitivity", ".."}, /* error of the files */
    {&indentation_schema, "spring_constant_error", "0."},
    {&indentation_schema, "sensitivity_error", ".."}, /* not stated, like that of the tip */
    {&indentation_schema, "half_angle_error", ".."},
    {&indentation_schema, "radius_error", ".."},
    {&indentation_schema, "piezo_error", ".."},
    {&indentation_schema, "detector_error", ".."},
    {&indentation_schema, "sample_thickness_error", ".."},
    {&indentation_schema, "spring_constant_error_assumed", ".0"}, /* without a stated one */
    {&indentation_schema, "sensitivity_error_assumed", "00"},
    {&indentation_schema, "half_angle_error_assumed", "00"},
    {&indentation_schema, "radius_error_assumed", "00"},
    {&indentation_schema, "piezo_error_assumed", "00"},
    {&indentation_schema, "detector_error_assumed", "00"},
    {&indentation_schema, "sample_thickness_error_assumed", "00"},
    {&indentation_schema, "spring_constant_gain", "k0"}, /* 1, unless an error is stated */
    {&indentation_schema, "sensitivity_gain", "kk"},
    {&indentation_schema, "half_angle_gain", "kk"},
    {&indentation_schema, "radius_gain", "kk"},
    {&indentation_schema, "piezo_gain", "nn"}, /* of one curve */
    {&indentation_schema, "detector_gain", "nn"},
    {&indentation_schema, "sample_thickness_gain", "nn"},
    {&indentation_schema, "range_error", "00"},
    {&indentation_schema, "loss_error", "00"},
    {&indentation_schema, "bend_error", "00"},
    {&indentation_schema, "range_shift_shallow", "kk"},
    {&indentation_schema, "range_shift_deep", "kk"},
    {&indentation_schema, "range_shift_middle", "kk"},
    {&indentation_schema, "loss_shift", "00"},
    {&indentation_schema, "pull_shift", "00"},
    {&indentation_schema, "modulus", "kk"},
    {&indentation_schema, "indentation_temperature", "n."}, /* stated in the first run */
    {&indentation_schema, "spectrum_temperature", "0."},    /* the second run has no DMA */
    {&indentation_schema, "spectrum_factor", "kn"},         /* without a DMA there is no spectrum */
    {&indentation_schema, "contact_point", "kk"},
    {&indentation_schema, "work_of_adhesion", "nn"}, /* does not exist */
    {&indentation_schema, "retract_modulus", "nk"},  /* requested in the second run */
    {&shift_factors_schema, "wlf_c1", "kk"},
    {&shift_factors_schema, "wlf_c2", "kk"},
    {&shift_factors_schema, "strain_low", ".."}, /* no file states one */
    {&shift_factors_schema, "strain_high", ".."},
    {&shift_factors_schema, "activation_energy", ".."}, /* WLF has none, and no joint */
    {&shift_factors_schema, "joint", ".."},
    {&shift_factors_schema, "valid_from", ".."}, /* the law holds everywhere */
    {&shift_factors_schema, "valid_to", ".."},
    {&shift_factors_schema, "law_slope", "kk"},
    {&shift_factors_schema, "pole", "kk"},
    {&shift_factors_schema, "offset", "kk"},
    {&shift_factors_schema, "law_rms", "00"},
    {&shift_factors_schema, "temperature_spread", "nn"},
    {&shift_factors_schema, "reference_temperature", "00"},
    {&shift_factors_schema, "loss_factor", "kk"},
    {&shift_factors_schema, "log_a", "kk"},
    {&shift_factors_schema, "log_b", "k0"},
    {&prony_schema, "equilibrium_modulus", "kk"},
    {&prony_schema, "equilibrium_modulus_limit", ".."}, /* the modulus is known */
    {&prony_schema, "reference_temperature", "00"},
    {&prony_schema, "frequency_min", "00"},
    {&prony_schema, "frequency_max", "00"},
};
static wt_compare_tables compared;
static wt_master_tables mastered;
static wt_indent_tables indented;

static void measure_bare(void)
{
    const wt_result *result = fixture_produced();
    const char *const isotherms[] = {WT_SOURCE_DIR "/fixtures/case/dma.txt"};
    const char *const curves[] = {WT_SOURCE_DIR "/fixtures/case/bulk-1.jpk-force-map"};
    const wt_file_set sweep = {.patterns = isotherms, .n_patterns = 1, .read = wt_read_defaults()};
    const wt_file_set map = {.patterns = curves, .n_patterns = 1, .read = wt_read_defaults()};
    wt_compare_job compare = wt_compare_job_defaults();
    wt_master_job master = wt_master_job_defaults();
    wt_indent_job indent = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    work.threads = 1;
    compare.bulk = wt_result_find(result, "indentation/bulk");
    compare.track = wt_result_find(result, "indentation/track");
    compare.rubber = &rubber[PRESSURE_ONLY]; /* of test_all */
    fixture_check(wt_compare_groups(&compare, &work, &compared, NULL));
    master.sets = &sweep;
    master.n_sets = 1;
    master.fit.vertical = WT_VERTICAL_NONE;
    fixture_check(wt_master_compute(&master, &work, &mastered, NULL, NULL));
    indent.sets = &map;
    indent.n_sets = 1;
    indent.spring_constant = (wt_estimate){0.3, 0, 0, "N/m"};
    indent.options.fit_retract = true;
    fixture_check(wt_tip_parse("pyramid:half-angle=20deg,radius=20nm", &indent.tip, NULL));
    fixture_check(wt_indent_group(&indent, &work, &indented, NULL));
    wt_formats_free(formats);
}

static void test_measured(void **state)
{
    (void)state;
    measure_bare();
    const wt_result *result = fixture_produced();
    const struct {
        const table_schema *schema;
        const wt_table *table[2];
    } pairs[] = {
        {&comparison_schema, {wt_result_find(result, "comparison"), compared.comparison}},
        {&dma_comparison_schema,
         {wt_result_find(result, "dma_comparison"), compared.dma_comparison}},
        {&indentation_schema, {wt_result_find(result, "indentation/bulk"), indented.indentation}},
        {&shift_factors_schema, {wt_result_find(result, "shift_factors"), mastered.shift_factors}},
        {&prony_schema, {wt_result_find(result, "prony"), mastered.prony}},
    };
    bool good = true;
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; p++)
        good = check(measured, sizeof measured / sizeof measured[0], pairs[p].schema,
                     pairs[p].table, 2) &&
               good;
    assert_true(good);
}

/* Unknown errors are named. */
static void test_unknown_errors_are_named(void **state)
{
    (void)state;
#define BOTH "pressure, temperature, roughness, "
#define FRICTION "shear stress, thickness of the layer, modulus ratio of the layer"
#define LAYER "specific wear rate, critical energy"
    static const char *const of_friction[WAYS] = {NULL, BOTH FRICTION,
                                                  "material, temperature, roughness, " FRICTION,
                                                  "material, " BOTH FRICTION};
    static const char *const of_layer[WAYS] = {
        NULL, BOTH LAYER, "material, temperature, roughness, " LAYER, "material, " BOTH LAYER};
    for (int way = 0; way < WAYS; way++) {
        const char *a = wt_table_key(friction[way].friction, "standard_error_excludes"),
                   *b = wt_table_key(layer[way].layer, "standard_error_excludes");
        if (way == ALL) {
            assert_true(a == NULL && b == NULL);
            continue;
        }
        assert_string_equal(a, of_friction[way]);
        assert_string_equal(b, of_layer[way]);
    }
}

/* Without measured frequencies the share outside them is unknown. */
static void test_share(void **state)
{
    (void)state;
    for (int way = 0; way < WAYS; way++)
        assert_int_equal(isnan(cell(friction[way].friction, 0, "extrapolated_share")) != 0,
                         way == NOTHING);
}

/* Rows without a question. */
static void test_no_replicates(void **state)
{
    (void)state;
    static const double velocity = 0.1;
    wt_surface surface = {.self_affine = true, .q0 = 2e3, .qr = 4e3, .q1 = 2e4, .hurst = 0.8};
    wt_sliding sliding = wt_sliding_defaults();
    wt_job work = wt_job_defaults();
    wt_friction_tables tables = {0};
    surface.c0.value = 2e-17;
    sliding.rubber = &rubber[ALL];
    sliding.surface = &surface;
    sliding.pressure = stated(0.8e6, "Pa", true);
    sliding.velocity = &velocity;
    sliding.n_velocity = 1;
    work.replicates = 0;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &tables, NULL), WT_OK);
    assert_true(isnan(cell(tables.friction, 0, "hysteresis_standard_error")));
    assert_string_equal(wt_table_key(tables.friction, "standard_error_excludes"),
                        "material with its shift law, pressure, temperature, roughness");
    wt_table_free(tables.friction);
}

static int clear(void **state)
{
    (void)state;
    for (int way = 0; way < WAYS; way++) {
        wt_table_free(friction[way].friction);
        wt_table_free(layer[way].layer);
        wt_rubber_clear(&rubber[way]);
    }
    wt_tables_clear(&compared, sizeof compared);
    wt_master_tables_clear(&mastered);
    wt_indent_tables_clear(&indented);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),
        cmocka_unit_test(test_measured),
        cmocka_unit_test(test_unknown_errors_are_named),
        cmocka_unit_test(test_share),
        cmocka_unit_test(test_no_replicates),
    };
    return cmocka_run_group_tests_name("errors known", tests, NULL, clear);
}
