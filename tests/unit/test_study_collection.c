/* Constants that cases share, from results created here: shared errors, duplicates, and missing
 * verdicts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "table_cells.h"

#include "core/table/registry.h"
#include "weartrack/case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values of a case; NaN or NULL: none. */
typedef struct told {
    const char *condition;
    double wear, wear_error, wear_df;
    double shear, shear_error; /* that of its logarithm */
    const char *source;        /* of all of its error */
    const char *lacks;
    const char *file, *role, *digest; /* of 100 bytes */
} told;

static void add(wt_result *to, wt_table *table)
{
    assert_int_equal(wt_result_add(to, table, NULL), WT_OK);
}

static void add_validation(const told *of, wt_result *to)
{
    wt_table *record = NULL, *sources = NULL, *friction = NULL;
    static const validation_key words[] = {VALIDATION_KEY_VERDICT, VALIDATION_KEY_WITHOUT,
                                           VALIDATION_KEY_JUDGED,  VALIDATION_KEY_TEST,
                                           VALIDATION_KEY_STEPS,   VALIDATION_KEY_LEFT_OUT};
    table_writer v = table_begin(&validation_schema, NULL);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        validation_set_text(&v, words[i], "1"); /* not read */
    validation_set_value(&v, VALIDATION_KEY_NEEDED, of->shear, 0, 0);
    validation_set_value(&v, VALIDATION_KEY_NEEDED_LOW,
                         of->shear * exp(-1.959964 * of->shear_error), 0, 0);
    validation_set_value(&v, VALIDATION_KEY_NEEDED_HIGH,
                         of->shear * exp(1.959964 * of->shear_error), 0, 0);
    assert_int_equal(table_end(&v, &record), WT_OK);
    add(to, record);
    table_writer s = table_begin(&validation_sources_schema, NULL);
    table_row(&s);
    validation_sources_put_text(&s, VALIDATION_SOURCES_SOURCE, of->source);
    validation_sources_put_text(&s, VALIDATION_SOURCES_REMEDY, "");
    for (validation_sources_column c = VALIDATION_SOURCES_ERROR; c <= VALIDATION_SOURCES_PULL_ERROR;
         c++)
        validation_sources_put(&s, c, c == VALIDATION_SOURCES_NEEDED_SHARE ? 1 : (double)NAN);
    validation_sources_set_text(&s, VALIDATION_SOURCES_KEY_ADVICE, "");
    assert_int_equal(table_end(&s, &sources), WT_OK);
    add(to, sources);
    if (of->lacks == NULL)
        return;
    table_writer f = table_begin(&friction_schema, NULL);
    for (friction_key k = FRICTION_KEY_PRESSURE; k <= FRICTION_KEY_REPLICATES; k++)
        if (k != FRICTION_KEY_ERROR_LACKS)
            friction_set_text(&f, k, "1"); /* not read */
    friction_set_text(&f, FRICTION_KEY_ERROR_LACKS, of->lacks);
    assert_int_equal(table_end(&f, &friction), WT_OK);
    add(to, friction);
}

static wt_result *result_of(const told *of)
{
    wt_result *to = wt_result_new();
    wt_table *answer = NULL, *wear = NULL, *inputs = NULL;
    table_writer a = table_begin(&answer_schema, NULL);
    answer_set_text(&a, ANSWER_KEY_CASE_SAMPLE, "HC");
    answer_set_text(&a, ANSWER_KEY_CASE_CONDITION, of->condition);
    assert_int_equal(table_end(&a, &answer), WT_OK);
    add(to, answer);
    if (!isnan(of->wear)) {
        table_writer w = table_begin(&wear_schema, NULL);
        wear_set_value(&w, WEAR_KEY_RATE, of->wear, of->wear_error, 0);
        wear_set_value(&w, WEAR_KEY_RATE_DF, of->wear_df, 0, 0);
        assert_int_equal(table_end(&w, &wear), WT_OK);
        add(to, wear);
    }
    if (!isnan(of->shear))
        add_validation(of, to);
    table_writer i = table_begin(&inputs_schema, NULL);
    if (of->file != NULL) {
        table_row(&i);
        inputs_put_text(&i, INPUTS_PATH, of->file);
        inputs_put_text(&i, INPUTS_ROLE, of->role);
        inputs_put_text(&i, INPUTS_FORMAT, "csv");
        inputs_put(&i, INPUTS_BYTES, 100);
        inputs_put_text(&i, INPUTS_SHA256, of->digest);
    }
    assert_int_equal(table_end(&i, &inputs), WT_OK);
    add(to, inputs);
    return to;
}

static wt_collection_tables collected(const told *first, const told *second)
{
    const wt_collect_job job = wt_collect_job_defaults();
    wt_collection_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    wt_result *results[] = {result_of(first), result_of(second)};
    const wt_collected_result cases[] = {{results[0], "first.h5"}, {results[1], "second.h5"}};
    if (wt_collection_compute(cases, 2, &job, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    wt_result_free(results[0]);
    wt_result_free(results[1]);
    return tables;
}

static const told wear = {.condition = "a",
                          .wear = 1e-12,
                          .wear_error = 1e-14,
                          .wear_df = (double)NAN,
                          .shear = (double)NAN},
                  shear = {.condition = "a",
                           .wear = (double)NAN,
                           .shear = 1e6,
                           .shear_error = 0.05,
                           .source = "roughness",
                           .file = "road.gsf",
                           .role = "topography",
                           .digest = "d"};

static void check(told first, told second, const char *suffices, const char *key, const char *words)
{
    first.condition = "a";
    second.condition = "b";
    wt_collection_tables t = collected(&first, &second);
    assert_non_null(t.shared_constants);
    if (suffices == NULL)
        assert_int_equal(wt_table_n_rows(t.shared_constants), 0);
    else
        assert_string_equal(text_cell(t.shared_constants, 0, "suffices"), suffices);
    const char *said = wt_table_key(t.shared_constants, key);
    if (words != NULL && (said == NULL || strstr(said, words) == NULL))
        fail_msg("%s: %s", key, said != NULL ? said : "not said");
    wt_tables_clear(&t, sizeof t);
}

/* The error of the scans is shared and no reason for a difference. Without shared errors both
 * differ by four of their errors of 0.07, or by one and a half. */
static void test_shared_file(void **state)
{
    (void)state;
    told other = shear;
    other.shear = 1.33e6;
    check(shear, other, "differs", "includes", "scans of a surface");
    other.shear = 1.11e6;
    check(shear, other, "one", "includes", "strain sweeps");
    /* the error of the shared value includes that a shared error does not average out */
    other.shear = shear.shear;
    other.condition = "b";
    static const char *const sources[] = {"roughness", "shift law", "softening with strain",
                                          "material, and scatter of the measured spectrum"},
                             *const roles[] = {"topography", "dma", "softening", "dma"};
    for (size_t i = 0; i < 4; i++) {
        told one = shear;
        one.source = other.source = sources[i];
        one.role = other.role = roles[i];
        wt_collection_tables t = collected(&one, &other);
        assert_near(log(number_cell(t.shared_constants, 0, "value_high") / 1e6), 0.05 * 1.959964,
                    1e-5);
        wt_tables_clear(&t, sizeof t);
        other.digest = "another";
        t = collected(&one, &other);
        assert_near(log(number_cell(t.shared_constants, 0, "value_high") / 1e6),
                    0.05 * 1.959964 / sqrt(2), 1e-5);
        wt_tables_clear(&t, sizeof t);
        other.digest = shear.digest;
    }
}

static void test_partly_known(void **state)
{
    (void)state;
    told other = shear;
    other.shear = 2e6;
    other.lacks = "roughness";
    check(shear, other, "inconclusive", "settled_by", "until that of roughness is known");
    other.shear = shear.shear;
    check(other, shear, "inconclusive", "settled_by", "shear stress of HC, a");
}

/* One record of two cases counts once, with a message; without digests by names and sizes. */
static void test_counts_once(void **state)
{
    (void)state;
    told one = wear, other = wear;
    one.file = other.file = "slide.csv";
    one.role = other.role = "record";
    one.digest = other.digest = "d";
    check(one, other, NULL, "left_out",
          "specific wear rate of HC, b: its files are those of HC, a");
    one.digest = other.digest = "";
    check(one, other, NULL, "left_out", "no digest distinguishes them");
    other.file = "other.csv";
    check(one, other, "one", "includes", "");
}

/* Values without a logarithm; few runs with an interval by Student's t. */
static void test_left_out(void **state)
{
    (void)state;
    told other = wear;
    other.wear_error = 0.6e-12;
    check(wear, other, NULL, "left_out", "HC, b: its interval reaches zero");
    other.wear = -1e-12;
    check(wear, other, NULL, "left_out", "HC, b: it is not above zero");
    other.wear = 1e-12;
    other.wear_error = (double)NAN;
    check(wear, other, NULL, "left_out", "HC, b: no error is stated");
    other.wear_error = 0.1e-12; /* 12.7 of which exceed the total */
    other.wear_df = 1;
    check(wear, other, NULL, "left_out", "HC, b: its interval reaches zero");
}

/* Two values with errors of 20 %: the intervals reach 0.317 to either side. It is divided by the
 * remainder of ln 1.5 or by the distance from the mean, whichever is less. */
static void test_advice(void **state)
{
    (void)state;
    told one = wear, other = wear;
    one.wear_error = 0.2e-12;
    other.wear = 1e-12 * exp(0.2);
    other.wear_error = 0.2 * other.wear;
    check(one, other, "inconclusive", "settled_by", "by a factor of about 1.1,");
    other.wear = 1e-12 * exp(0.55); /* 0.317 over ln 1.5 - 0.275, and over 0.275 */
    other.wear_error = 0.2 * other.wear;
    check(one, other, "inconclusive", "settled_by", "by a factor of about 1.2,");
    one.wear_error = 0.4e-12; /* 0.634 over 0.405 - 0.15, and over 0.15 */
    other.wear = 1e-12 * exp(0.3);
    other.wear_error = 0.4 * other.wear;
    check(one, other, "inconclusive", "settled_by", "by a factor of about 2.5,");
}

/* ---- moduli against rate --------------------------------------------------------------------- */

/* Two positions per group, at two rates a decade apart, with moduli that double. `wide`: interval
 * of the loss factor of their DMA, NaN: none. */
static void add_curves(const char *group, double wide, wt_result *to)
{
    wt_table *curves = NULL;
    wt_error err = WT_ERROR_INIT;
    const table_schema *schema = &indentation_schema;
    table_writer t = table_begin_variant(schema, (table_variant){.suffix = group}, &err);
    for (int i = 0; i < 4; i++) {
        table_row(&t);
        for (unsigned c = 0; c < schema->n_columns; c++)
            if (schema->columns[c].kind == SCHEMA_TEXT)
                indentation_put_text(&t, (indentation_column)c,
                                     c == INDENTATION_SPOT      ? (i < 2 ? "a" : "b")
                                     : c == INDENTATION_VERDICT ? "accepted"
                                                                : group);
            else
                indentation_put(&t, (indentation_column)c,
                                c == INDENTATION_MODULUS     ? 1e6 * (1 + i % 2)
                                : c == INDENTATION_RATE      ? (i % 2 > 0 ? 1e-5 : 1e-6)
                                : c == INDENTATION_LOAD_TIME ? (i % 2 > 0 ? 0.01 : 0.1)
                                                             : 0);
    }
    if (!isnan(wide))
        indentation_set_value(&t, INDENTATION_KEY_SPECTRUM_TEMPERATURE, 293.15, 0, 0);
    if (table_end(&t, &curves) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    add(to, curves);
}

static void add_master(double wide, double reference, wt_result *to)
{
    wt_table *master = NULL;
    wt_error err = WT_ERROR_INIT;
    table_writer t = table_begin(&master_curve_schema, &err);
    for (int i = 0; i < 3; i++) { /* the last one is at no rate of the curves */
        const double half = i < 2 ? wide / 2 : 10 * wide;
        table_row(&t);
        for (unsigned c = 0; c < master_curve_schema.n_columns; c++)
            master_curve_put(&t, (master_curve_column)c,
                             c == MASTER_CURVE_ANGULAR_FREQUENCY         ? pow(10, i + 1)
                             : c == MASTER_CURVE_FITTED_LOSS_FACTOR      ? 0.5
                             : c == MASTER_CURVE_FITTED_LOSS_FACTOR_LOW  ? 0.5 - half
                             : c == MASTER_CURVE_FITTED_LOSS_FACTOR_HIGH ? 0.5 + half
                                                                         : 1);
    }
    for (master_curve_key k = MASTER_CURVE_KEY_NOISE_STORAGE; k <= MASTER_CURVE_KEY_DEFORMATION;
         k++)
        if (k == MASTER_CURVE_KEY_REFERENCE_TEMPERATURE)
            master_curve_set_value(&t, k, reference, 0, 0);
        else
            master_curve_set_text(&t, k, "0");
    if (table_end(&t, &master) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    add(to, master);
}

static wt_collection_tables rates_of(double wide, double reference)
{
    wt_collect_job job = wt_collect_job_defaults();
    wt_collection_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    wt_result *both = wt_result_new();
    wt_table *answer = NULL;
    table_writer a = table_begin(&answer_schema, NULL);
    answer_set_text(&a, ANSWER_KEY_CASE_SAMPLE, "HC");
    assert_int_equal(table_end(&a, &answer), WT_OK);
    add(both, answer);
    add_curves("bulk", wide, both);
    add_curves("track", wide, both);
    if (!isnan(wide))
        add_master(wide, reference, both);
    const wt_collected_result cases[] = {{both, "first.h5"}};
    if (wt_collection_compute(cases, 1, &job, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    wt_result_free(both);
    return tables;
}

/* Positions without scatter: the remaining error is that of the shared spectrum, equal for bulk and
 * track. */
static void test_spectrum(void **state)
{
    (void)state;
    const double wide = 0.01, exponent = wide / (2 * 1.959964) * M_2_PI / 1.25, /* 1 + tan^2 */
        error = 0.9228 * exponent * M_SQRT2;
    wt_collection_tables t = rates_of(wide, 293.15);
    assert_int_equal(wt_table_n_rows(t.shared_constants), 1);
    assert_near(number_cell(t.shared_constants, 0, "value"), 2, 1e-12);
    assert_near(log(number_cell(t.shared_constants, 0, "value_high") / 2), 1.959964 * error, 1e-6);
    wt_tables_clear(&t, sizeof t);
    t = rates_of(wide, 303.15); /* the frequency of the curves in it is unknown */
    assert_near(log(number_cell(t.shared_constants, 0, "value_high") / 2), 20 * 1.959964 * error,
                1e-5);
    wt_tables_clear(&t, sizeof t);
    t = rates_of((double)NAN, 0);
    assert_null(t.shared_constants);
    wt_tables_clear(&t, sizeof t);
}

/* ---- critical energy and wear rate ----------------------------------------------------------- */

/* A case that determines both by thickness and wear rate. */
static wt_result *pair_of(const char *condition, double u_c, double k, double correlation,
                          const char *lacks)
{
    wt_result *to = wt_result_new();
    wt_table *answer = NULL, *found = NULL;
    table_writer a = table_begin(&answer_schema, NULL);
    answer_set_text(&a, ANSWER_KEY_CASE_SAMPLE, "HC");
    answer_set_text(&a, ANSWER_KEY_CASE_CONDITION, condition);
    assert_int_equal(table_end(&a, &answer), WT_OK);
    add(to, answer);
    wt_error err = WT_ERROR_INIT;
    table_writer t = table_begin(&identification_schema, &err);
    table_row(&t);
    for (identification_column c = IDENTIFICATION_BY; c <= IDENTIFICATION_NOTE; c++)
        if (c == IDENTIFICATION_BY || c == IDENTIFICATION_LOOSE || c == IDENTIFICATION_NOTE)
            identification_put_text(&t, c, c == IDENTIFICATION_BY ? "thickness and wear rate" : "");
        else
            identification_put(&t, c,
                               c == IDENTIFICATION_ENERGY                  ? u_c
                               : c == IDENTIFICATION_ENERGY_STANDARD_ERROR ? 0.2 * u_c
                               : c == IDENTIFICATION_WEAR                  ? k
                               : c == IDENTIFICATION_WEAR_STANDARD_ERROR   ? 0.2 * k
                               : c == IDENTIFICATION_CORRELATION           ? correlation
                                                                           : 0);
    static const identification_key numbers[] = {
        IDENTIFICATION_KEY_PRODUCT, IDENTIFICATION_KEY_RATIO, IDENTIFICATION_KEY_VELOCITY,
        IDENTIFICATION_KEY_PRESSURE, IDENTIFICATION_KEY_THICKNESS};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        identification_set_value(&t, numbers[i], 1, 0, 0); /* not read */
    identification_set_text(&t, IDENTIFICATION_KEY_INCLUDES, "1");
    if (lacks != NULL)
        identification_set_text(&t, IDENTIFICATION_KEY_LACKS, lacks);
    if (table_end(&t, &found) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    add(to, found);
    return to;
}

static wt_collection_tables pairs(double u_c, double k, double correlation, double margin,
                                  const char *lacks)
{
    wt_collect_job job = wt_collect_job_defaults();
    wt_collection_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    wt_result *results[] = {pair_of("mild", 1e10, 1e-12, correlation, lacks),
                            pair_of("severe", u_c, k, correlation, lacks)};
    const wt_collected_result cases[] = {{results[0], "first.h5"}, {results[1], "second.h5"}};
    job.constant_margin = margin;
    if (wt_collection_compute(cases, 2, &job, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    wt_result_free(results[0]);
    wt_result_free(results[1]);
    assert_int_equal(wt_table_n_rows(tables.collected_constants), 2);
    return tables;
}

static void says(const wt_collection_tables *t, const char *one_u_c, const char *one_k,
                 const char *both)
{
    assert_int_equal(wt_table_n_rows(t->shared_pairs), 1); /* the sample is all cases */
    assert_string_equal(text_cell(t->shared_pairs, 0, "one_energy"), one_u_c);
    assert_string_equal(text_cell(t->shared_pairs, 0, "one_wear"), one_k);
    assert_string_equal(text_cell(t->shared_pairs, 0, "one_pair"), both);
    assert_string_equal(wt_table_key(t->shared_pairs, "one_layer_constants"), both);
}

/* Rows of both: verdict and constants; frees the table. */
static void prints(wt_collection_tables *t, const char *both, const char *energy, const char *rate)
{
    char line[3][300];
    wt_result *result = wt_result_new();
    add(result, t->shared_pairs);
    t->shared_pairs = NULL;
    wt_result_rows *rows = wt_result_rows_new(result, false);
    assert_int_equal(wt_result_rows_count(rows), 3);
    for (size_t i = 0; i < 3; i++) {
        const wt_result_row row = wt_result_rows_get(rows, i);
        snprintf(line[i], sizeof line[i], "%s|%s|%s|%s", row.name, row.text, row.interval,
                 row.note);
    }
    assert_string_equal(line[0], both);
    assert_string_equal(line[1], energy);
    assert_string_equal(line[2], rate);
    wt_result_rows_free(rows);
    wt_result_free(result);
}

/* Half as much again is within the errors of each, but not for a pair whose product is known to 2
 * %: the correlation decides. */
static void test_pairs(void **state)
{
    (void)state;
    wt_collection_tables t = pairs(1.5e10, 1.5e-12, -0.99, 3, NULL);
    says(&t, "one", "one", "differs");
    assert_near(number_cell(t.shared_pairs, 0, "correlation"), -0.99, 1e-9);
    assert_near(number_cell(t.shared_pairs, 0, "critical_energy"), 1e10 * sqrt(1.5), 1e-6);
    assert_near(number_cell(t.shared_pairs, 0, "df"), 2, 1e-12);
    assert_string_equal(text_cell(t.shared_pairs, 0, "loose"), "U_c k^-1.00");
    wt_tables_clear(&t, sizeof t);
    t = pairs(1.5e10, 1e-12 / 1.5, -0.99, 3, NULL); /* along the direction of the largest error */
    says(&t, "one", "one", "one");
    prints(&t, "one U_c and k of 2 cases|one||by thickness and wear rate",
           "critical energy U_c|12.2 GJ/m^3|9.28 to 16.2|one",
           "specific wear rate|0.000816 mm^3/(N m)|0.000619 to 0.001077|one; correlation -0.99");
    wt_tables_clear(&t, sizeof t);
    t = pairs(1e11, 1e-12, 0, 0.5, NULL);
    says(&t, "differs", "one", "differs");
    prints(&t, "one U_c and k of 2 cases|differs||by thickness and wear rate",
           "critical energy U_c|not known||differs", "specific wear rate|not known||one");
    wt_tables_clear(&t, sizeof t);
    t = pairs(1e10, 1e-12, -0.5, 0.1, NULL); /* equal, but too inaccurate for "one" */
    says(&t, "inconclusive", "inconclusive", "inconclusive");
    assert_non_null(strstr(wt_table_key(t.shared_pairs, "settled_by"), "is known least"));
    wt_tables_clear(&t, sizeof t);
    t = pairs(1e11, 1e-12, 0, 0.5, "temperature");
    says(&t, "inconclusive", "inconclusive", "inconclusive");
    assert_non_null(strstr(wt_table_key(t.shared_pairs, "settled_by"), "temperature"));
    wt_tables_clear(&t, sizeof t);
    t = pairs(1e11, 1e-12, (double)NAN, 0.5, NULL); /* no replicates */
    assert_null(t.shared_pairs);
    wt_tables_clear(&t, sizeof t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared_file), cmocka_unit_test(test_partly_known),
        cmocka_unit_test(test_counts_once), cmocka_unit_test(test_left_out),
        cmocka_unit_test(test_advice),      cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_spectrum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
