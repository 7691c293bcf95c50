/* The declarations of the tables are consistent. The writer writes only declared columns and keeps
 * its first failure. A table is read by its declaration or refused by name.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/table/registry.h"
#include "core/table/table.h"

#include <string.h>

/* ---- the declarations ------------------------------------------------------------------------ */

static bool ends_in(const char *text, char c)
{
    return text[0] != '\0' && text[strlen(text) - 1] == c;
}

/* Unit that a table accepts, with its quantity. */
static void check_unit(const char *unit, const char *own, wt_quantity quantity)
{
    wt_table *table = wt_table_new("units", "");
    double factor = 0, offset = 1;
    assert_int_equal(wt_table_add_column(table, "x", unit, "", NULL), WT_OK);
    wt_table_free(table);
    if (own != NULL)
        return;
    assert_int_equal(wt_unit_to_si(unit, quantity, &factor, &offset, NULL), WT_OK);
    assert_near(factor, 1, 0);
    assert_near(offset, 0, 0);
}

/* A column of errors has the name of its value and its unit. */
static void check_errors(const table_schema *s, const schema_field *c)
{
    const struct {
        unsigned column;
        const char *suffix;
    } errors[] = {{c->standard_error, "_standard_error"}, {c->numerical_error, "_numerical_error"}};
    for (size_t i = 0; i < 2; i++) {
        char name[128];
        (void)snprintf(name, sizeof name, "%s%s", c->name, errors[i].suffix);
        for (unsigned k = 0; k < s->n_columns; k++)
            assert_int_equal(strcmp(s->columns[k].name, name) == 0, k == errors[i].column && k > 0);
        if (errors[i].column > 0)
            assert_string_equal(schema_unit(&s->columns[errors[i].column]), schema_unit(c));
    }
}

static void check_columns(const table_schema *s)
{
    assert_true(s->n_columns > 0);
    for (size_t i = 0; i < s->n_columns; i++) {
        const schema_field *c = &s->columns[i];
        assert_true(table_name_part_is_valid(c->name) && c->long_name[0] != '\0');
        assert_int_not_equal(c->kind, SCHEMA_PLAIN);
        if (c->kind == SCHEMA_NUMBER) {
            check_unit(schema_unit(c), c->unit, c->quantity);
            check_errors(s, c);
        }
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(c->name, s->columns[k].name);
    }
}

/* The names of all parts of an estimate in a stored file are different. */
static void check_keys(const table_schema *s)
{
    wt_table *table = wt_table_new("keys", "");
    for (size_t i = 0; i < s->n_keys; i++) {
        const schema_field *k = &s->keys[i];
        char name[SCHEMA_NAME_SIZE];
        schema_name(k->name, "bulk", name);
        assert_null(wt_table_key(table, name));
        if (k->kind == SCHEMA_NUMBER)
            check_unit(schema_unit(k), k->unit, k->quantity);
        const wt_estimate e = {1, 0, 0, schema_unit(k)};
        assert_int_equal(k->kind == SCHEMA_NUMBER ? wt_table_set_estimate(table, name, e, NULL)
                                                  : wt_table_set_key(table, name, "x", NULL),
                         WT_OK);
    }
    wt_table_free(table);
}

static void test_declarations(void **state)
{
    (void)state;
    for (size_t i = 0; i < table_n_schemas; i++) {
        const table_schema *s = table_schemas[i];
        char name[SCHEMA_NAME_SIZE];
        schema_name(s->name, "bulk", name);
        assert_true(table_name_is_valid(name) && s->title[0] != '\0' && s->made_by[0] != '\0');
        assert_int_equal(strcmp(name, s->name) != 0, ends_in(s->name, '/'));
        check_columns(s);
        check_keys(s);
        for (size_t k = 0; k < i; k++)
            assert_true(strcmp(s->name, table_schemas[k]->name) != 0 ||
                        (s == &spectrum_schema && table_schemas[k] == &roughness_schema));
    }
}

/* The example in weartrack-stream(5) is valid: its columns are those of the named table. */
static void test_example(void **state)
{
    (void)state;
    FILE *page = fopen(WT_SOURCE_DIR "/man/weartrack-stream.5", "r");
    const table_schema *s = NULL;
    char line[512], name[64], unit[64];
    size_t n_columns = 0;
    assert_non_null(page);
    while (fgets(line, sizeof line, page) != NULL) {
        if (sscanf(line, "## table: %63s", name) == 1)
            for (size_t i = 0; i < table_n_schemas; i++)
                s = strcmp(table_schemas[i]->name, name) == 0 ? table_schemas[i] : s;
        for (char *cell = strncmp(line, "# ", 2) == 0 ? line + 2 : NULL; cell != NULL;) {
            size_t k = 0;
            assert_int_equal(sscanf(cell, "%63[a-z_][%63[^]]", name, unit), 2);
            assert_non_null(s);
            while (k < s->n_columns && strcmp(s->columns[k].name, name) != 0)
                k++;
            assert_true(k < s->n_columns);
            assert_string_equal(
                unit, s->columns[k].kind == SCHEMA_TEXT ? "text" : schema_unit(&s->columns[k]));
            n_columns++;
            cell = strstr(cell, "<TAB>");
            cell = cell != NULL ? cell + 5 : NULL;
        }
    }
    fclose(page);
    assert_true(n_columns > 2);
}

/* ---- writing --------------------------------------------------------------------------------- */

static void put_prony_row(table_writer *t)
{
    table_row(t);
    prony_put(t, PRONY_RELAXATION_TIME, 0.5);
    prony_put(t, PRONY_MODULUS, 3e6);
}

static void set_prony_keys(table_writer *t)
{
    prony_set_value(t, PRONY_KEY_EQUILIBRIUM_MODULUS, 1e6, 1e4, 0);
    prony_set_text(t, PRONY_KEY_DEFORMATION, "shear");
}

static wt_table *make_prony(void)
{
    wt_table *table = NULL;
    table_writer t = table_begin(&prony_schema, NULL);
    put_prony_row(&t);
    table_block(&t);
    put_prony_row(&t);
    set_prony_keys(&t);
    prony_set_print(&t, PRONY_KEY_RMS_LOSS, "%.3g", 0.25);
    assert_int_equal(table_end(&t, &table), WT_OK);
    return table;
}

static void test_written(void **state)
{
    (void)state;
    wt_table *table = make_prony();
    wt_estimate e;
    assert_string_equal(wt_table_name(table), "prony");
    assert_string_equal(wt_table_title(table), "Prony series");
    assert_int_equal(wt_table_n_columns(table), 2);
    assert_string_equal(wt_table_column_name(table, 1), "modulus");
    assert_string_equal(wt_table_column_unit(table, 1), "Pa");
    assert_string_equal(wt_table_column_long_name(table, 1), "modulus of the term");
    assert_near(wt_table_number(table, 1, 0), 0.5, 0);
    assert_int_equal(wt_table_block(table, 1), 1);
    assert_true(wt_table_estimate(table, "equilibrium_modulus", &e));
    assert_string_equal(e.unit, "Pa");
    assert_near(e.standard_error, 1e4, 0);
    assert_string_equal(wt_table_key(table, "rms_loss"), "0.25");
    wt_table_free(table);
}

/* Input that the writer refuses, with the name of the fault. */
typedef enum wrong { NO_CELL, NO_KEY, OTHER_TABLE, TEXT_IN_NUMBER, LEFT_OUT } wrong;

static void check_refused(wrong what, const char *named)
{
    wt_error err = WT_ERROR_INIT;
    wt_table *table = make_prony(), *none = table;
    const uint64_t left_out = what == LEFT_OUT ? SCHEMA_BIT(PRONY_MODULUS) : 0;
    table_writer t =
        table_begin_variant(&prony_schema, (table_variant){.left_out = left_out}, &err);
    table_row(&t);
    prony_put(&t, PRONY_RELAXATION_TIME, 1);
    if (what != NO_CELL)
        prony_put(&t, PRONY_MODULUS, 1);
    if (what == OTHER_TABLE)
        layer_put(&t, LAYER_TIME, 1);
    if (what == TEXT_IN_NUMBER)
        prony_put_text(&t, PRONY_MODULUS, "1");
    put_prony_row(&t);
    if (what != NO_KEY)
        set_prony_keys(&t);
    const size_t rows = wt_table_n_rows(t.table);
    const wt_status status = t.status;
    put_prony_row(&t); /* nothing is written after the first failure */
    if (status != WT_OK)
        assert_int_equal(wt_table_n_rows(t.table), rows);
    assert_int_equal(table_end(&t, &none), WT_E_INTERNAL);
    assert_null(none);
    if (strstr(err.message, named) == NULL)
        fail_msg("%s: %s", named, err.message);
    wt_table_free(table);
}

static void test_refused(void **state)
{
    (void)state;
    check_refused(NO_CELL, "\"prony\": \"modulus\"");
    check_refused(NO_KEY, "\"prony\": \"equilibrium_modulus\"");
    check_refused(OTHER_TABLE, "layer");
    check_refused(TEXT_IN_NUMBER, "prony");
    check_refused(LEFT_OUT, "prony");
}

/* A table of the caller gets more rows; an open name is completed. */
static void test_continued(void **state)
{
    (void)state;
    wt_table *table = NULL;
    table_writer t = table_begin(&force_displacement_schema, NULL);
    assert_int_equal(table_end(&t, &table), WT_OK);
    for (int i = 0; i < 2; i++) {
        t = table_continue(table, &force_displacement_schema, i == 0 ? "bulk" : "track", NULL);
        table_row(&t);
        force_displacement_put_text(&t, FORCE_DISPLACEMENT_GROUP, t.suffix);
        force_displacement_put_text(&t, FORCE_DISPLACEMENT_SEGMENT, "approach");
        force_displacement_put(&t, FORCE_DISPLACEMENT_DISPLACEMENT, 1);
        force_displacement_put(&t, FORCE_DISPLACEMENT_FORCE, 2);
        force_displacement_set_text(&t, FORCE_DISPLACEMENT_KEY_CURVE, "a");
        assert_int_equal(table_end(&t, NULL), WT_OK);
    }
    assert_int_equal(wt_table_n_rows(table), 2);
    assert_non_null(wt_table_key(table, "curve_bulk"));
    assert_non_null(wt_table_key(table, "curve_track"));
    wt_table_free(table);
}

/* ---- reading --------------------------------------------------------------------------------- */

static void test_read_by_declaration(void **state)
{
    (void)state;
    wt_table *table = make_prony();
    table_view v;
    assert_int_equal(table_bind(table, &prony_schema, "", &v, NULL), WT_OK);
    assert_int_equal(v.n_rows, 2);
    assert_near(prony_get(&v, 1, PRONY_MODULUS), 3e6, 0);
    assert_near(prony_value(&v, PRONY_KEY_EQUILIBRIUM_MODULUS).value, 1e6, 0);
    assert_near(prony_value(&v, PRONY_KEY_FREQUENCY_MIN).value, (double)NAN, 0);
    assert_string_equal(prony_value(&v, PRONY_KEY_FREQUENCY_MIN).unit, "rad/s");
    assert_string_equal(prony_key_text(&v, PRONY_KEY_DEFORMATION), "shear");
    assert_null(prony_key_text(&v, PRONY_KEY_RMS_STORAGE));
    wt_table_free(table);
}

/* A Prony table with one change. */
static void check_unbound(const char *column, const char *unit, const char *key, wt_status expected,
                          const char *named)
{
    wt_error err = WT_ERROR_INIT;
    table_view v;
    wt_table *table = wt_table_new("prony", "");
    assert_int_equal(wt_table_add_column(table, "relaxation_time", "s", "", NULL), WT_OK);
    assert_int_equal(unit != NULL ? wt_table_add_column(table, column, unit, "", NULL)
                                  : wt_table_add_text_column(table, column, "", NULL),
                     WT_OK);
    assert_int_equal(wt_table_set_key(table, key, "shear", NULL), WT_OK);
    assert_int_equal(
        wt_table_set_estimate(table, "equilibrium_modulus", (wt_estimate){1, 0, 0, "Pa"}, NULL),
        WT_OK);
    assert_int_equal(table_bind(table, &prony_schema, "", &v, &err), expected);
    if (expected != WT_OK &&
        (strstr(err.message, named) == NULL || strstr(err.message, "\"prony\"") == NULL ||
         strstr(err.advice, "weartrack master") == NULL))
        fail_msg("%s; %s", err.message, err.advice);
    wt_table_free(table);
}

static void test_refused_tables(void **state)
{
    (void)state;
    check_unbound("modulus", "Pa", "deformation", WT_OK, "");
    check_unbound("moduli", "Pa", "deformation", WT_E_MISSING, "column \"modulus\"");
    check_unbound("modulus", "MPa", "deformation", WT_E_UNIT, "column \"modulus\"");
    check_unbound("modulus", NULL, "deformation", WT_E_UNIT, "column \"modulus\"");
    check_unbound("modulus", "Pa", "deform", WT_E_MISSING, "key \"deformation\"");
}

/* Optional values of a table written by hand are NaN or "", and reported as missing. */
static void test_optional(void **state)
{
    (void)state;
    table_view v;
    wt_result *result = wt_result_new();
    wt_table *table = wt_table_new("indentation/bulk", "");
    assert_int_equal(wt_table_add_text_column(table, "verdict", "", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(table, "modulus", "Pa", "", NULL), WT_OK);
    assert_int_equal(wt_table_add_row(table, NULL), WT_OK);
    assert_int_equal(wt_result_add(result, table, NULL), WT_OK);
    assert_int_equal(table_bind_result(result, &indentation_schema, "bulk", &v, NULL), WT_OK);
    assert_ptr_equal(v.table, table);
    assert_true(indentation_has(&v, INDENTATION_VERDICT));
    assert_false(indentation_has(&v, INDENTATION_SPOT));
    assert_string_equal(indentation_text(&v, 0, INDENTATION_SPOT), "");
    assert_near(indentation_get(&v, 0, INDENTATION_NOISE), (double)NAN, 0);
    assert_int_equal(table_bind_result(result, &indentation_schema, "track", &v, NULL), WT_OK);
    assert_null(v.table);
    assert_int_equal(v.n_rows, 0);
    assert_near(indentation_value(&v, INDENTATION_KEY_SPRING_CONSTANT).value, (double)NAN, 0);
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_declarations),   cmocka_unit_test(test_example),
        cmocka_unit_test(test_written),        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_continued),      cmocka_unit_test(test_read_by_declaration),
        cmocka_unit_test(test_refused_tables), cmocka_unit_test(test_optional),
    };
    return cmocka_run_group_tests_name("data tables", tests, NULL, NULL);
}
