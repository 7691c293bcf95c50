/* Of every number of friction and layer that has a standard error: known, not known or without one,
 * by where the material and its errors come from. 0 is for what has no error; what is not known is
 * nan, and is named. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "truth.h"

/* With the errors of all inputs; without any; a material without draws, with the error of the
 * pressure; without draws, errors and measured frequencies. */
enum { ALL, MATERIAL_ONLY, PRESSURE_ONLY, NOTHING, WAYS };

/* For the four ways: known, not known, 0 because there is none. A column or key with a standard
 * error that is not here fails the test. */
static const struct {
    const table_schema *schema;
    const char *name, *expected;
} list[] = {
    {&friction_schema, "pressure", "knkn"},
    {&friction_schema, "temperature", "knnn"},
    {&friction_schema, "shear_stress", "knnn"},
    {&friction_schema, "reference_velocity", "0000"},
    {&friction_schema, "friction_at_reference", "kkkn"},
    {&friction_schema, "hysteresis_at_reference", "kkkn"},
    {&friction_schema, "area_ratio_at_reference", "kkkn"},
    {&friction_schema, "layer_thickness", "knnn"},
    {&friction_schema, "layer_modulus_ratio", "knnn"},
    {&friction_schema, "friction_with_layer_at_reference", "kkkn"},
    {&friction_schema, "friction_change_at_reference", "kkkn"},
    {&friction_schema, "relative_change_at_reference", "kkkn"},
    {&friction_schema, "relative_change_low", "nnnn"},
    {&friction_schema, "relative_change_high", "nnnn"},
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
    {&layer_schema, "removal_time", "...."}, /* there is a layer */
    {&layer_schema, "critical_energy", "knnn"},
    {&layer_schema, "surface_power", "kkkn"},
    {&layer_schema, "time_to_90_percent", "kkkn"},
    {&layer_schema, "velocity", "0000"},
    {&layer_schema, "pressure", "knkn"},
    {&layer_schema, "specific_wear_rate", "knnn"},
    {&layer_schema, "observed_thickness", "...."}, /* not of a given critical energy */
    {&layer_schema, "thickness", "kkkn"},
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
    wt_layer_known known = {.thickness = stated(3e-6, "m", all),
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
    if (wt_friction_make(&sliding, &known, &work, &friction[way], &err) != WT_OK ||
        wt_layer_make(&sliding, &job, &work, &layer[way], &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
}

static const wt_table *table_of(const table_schema *schema, int way)
{
    return schema == &friction_schema ? friction[way].friction : layer[way].layer;
}

static char letter(double error)
{
    return isnan(error) ? 'n' : error > 0 ? 'k' : '0';
}

/* Of a column: in its last row. */
static char found(const table_schema *schema, size_t field, bool is_key, int way)
{
    const wt_table *t = table_of(schema, way);
    wt_estimate e;
    if (is_key)
        return wt_table_estimate(t, schema->keys[field].name, &e) ? letter(e.standard_error) : '.';
    const char *column = schema->columns[schema->columns[field].standard_error].name;
    return letter(cell(t, wt_table_n_rows(t) - 1, column));
}

static bool check(const table_schema *schema, size_t field, bool is_key)
{
    const char *name = is_key ? schema->keys[field].name : schema->columns[field].name;
    char words[WAYS + 1] = "";
    for (int way = 0; way < WAYS; way++)
        words[way] = found(schema, field, is_key, way);
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        if (list[i].schema == schema && strcmp(list[i].name, name) == 0) {
            if (strcmp(list[i].expected, words) != 0)
                print_error("%s of %s: %s, not %s\n", name, schema->name, words, list[i].expected);
            return strcmp(list[i].expected, words) == 0;
        }
    print_error("%s of %s is not in the list: %s\n", name, schema->name, words);
    return false;
}

static void test_all(void **state)
{
    (void)state;
    static const table_schema *const schemas[] = {&friction_schema, &layer_schema};
    bool good = true;
    for (int way = 0; way < WAYS; way++)
        make(way);
    for (size_t s = 0; s < 2; s++) {
        for (size_t i = 0; i < schemas[s]->n_keys; i++)
            if (schemas[s]->keys[i].kind == SCHEMA_NUMBER)
                good = check(schemas[s], i, true) && good;
        for (size_t i = 0; i < schemas[s]->n_columns; i++)
            if (schemas[s]->columns[i].standard_error != 0)
                good = check(schemas[s], i, false) && good;
    }
    assert_true(good);
}

/* What is not known is named. */
static void test_named(void **state)
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
        const char *a = wt_table_key(friction[way].friction, "standard_error_lacks"),
                   *b = wt_table_key(layer[way].layer, "standard_error_lacks");
        if (way == ALL) {
            assert_true(a == NULL && b == NULL);
            continue;
        }
        assert_string_equal(a, of_friction[way]);
        assert_string_equal(b, of_layer[way]);
    }
}

/* Where the measured frequencies are not known, neither is the share outside them. */
static void test_share(void **state)
{
    (void)state;
    for (int way = 0; way < WAYS; way++)
        assert_int_equal(isnan(cell(friction[way].friction, 0, "extrapolated_share")) != 0,
                         way == NOTHING);
}

/* An answer to none that were asked for. */
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
    assert_int_equal(wt_friction_make(&sliding, NULL, &work, &tables, NULL), WT_OK);
    assert_true(isnan(cell(tables.friction, 0, "hysteresis_standard_error")));
    assert_string_equal(wt_table_key(tables.friction, "standard_error_lacks"),
                        "material with its shift law, pressure, temperature, roughness");
    wt_friction_tables_clear(&tables);
}

static int clear(void **state)
{
    (void)state;
    for (int way = 0; way < WAYS; way++) {
        wt_friction_tables_clear(&friction[way]);
        wt_layer_tables_clear(&layer[way]);
        wt_rubber_clear(&rubber[way]);
    }
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),
        cmocka_unit_test(test_named),
        cmocka_unit_test(test_share),
        cmocka_unit_test(test_no_replicates),
    };
    return cmocka_run_group_tests_name("errors known", tests, NULL, clear);
}
