/* Columns and keys of the tables show the members of the structures that are their rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "core/store/store.h"
#include "core/table/registry.h"

#include <string.h>

/* clang-format off */
#define ROWS(X) \
    X(indentation) X(curves) X(overrides) X(force_displacement) X(force_indentation) X(modulus_depth) X(modulus_budget) \
    X(payne_sweep) X(payne) X(ramp) X(glass_transition) X(moduli_at) X(spot) \
    X(modulus_groups) X(modulus_rate) X(dma_comparison) X(comparison) X(track_layer) X(friction) X(transverse_isotropy) \
    X(softening) X(contact_area) X(layer) \
    X(error_budget) X(work_precision) X(cost) X(notes) X(data_quality) X(limits) X(answer) \
    X(shift_factors) X(master_curve) X(relaxation_spectrum) X(influences) X(material_draws) \
    X(power_spectrum) X(place_errors) X(angular_spectrum) X(surfaces) X(height_map) X(height_profile) X(prony) X(series_draws) X(prony_reduced) X(roughness) X(energy_density) \
    X(failures) X(methods) X(record) X(record_cycles) X(wear) \
    X(identification) X(validation) X(validation_running_in) X(validation_course) X(validation_sources) \
    X(friction_decades) X(flash) X(collection) X(collected_modulus) \
    X(collected_friction) X(collected_ramp) X(collected_force) X(ratio_pairs) \
   
#define KEYS(X) \
    X(modulus_depth) X(modulus_budget) X(glass_transition) X(spot) X(dma_comparison) \
    X(comparison) X(track_layer) X(friction) X(softening) X(layer) X(master_curve) X(prony) \
    X(cost) X(power_spectrum) X(angular_spectrum) X(surfaces) X(friction_decades) X(flash) \
    X(collection) X(collected_friction) X(collected_ramp) X(ratio_pairs)
/* clang-format on */

typedef struct binding {
    const table_schema *schema;
    const schema_field *shown;
    bool keys;
} binding;

#define ROW_FIELDS(table) const schema_field *table##_row_shows(void);
#define KEY_FIELDS(table) const schema_field *table##_keys_shows(void);
#define ROW_BINDING(table) {&table##_schema, table##_row_shows(), false},
#define KEY_BINDING(table) {&table##_schema, table##_keys_shows(), true},
ROWS(ROW_FIELDS)
KEYS(KEY_FIELDS)

static size_t fields_of(const binding *b, const schema_field **fields)
{
    *fields = b->keys ? b->schema->keys : b->schema->columns;
    return b->keys ? b->schema->n_keys : b->schema->n_columns;
}

static bool is_words(schema_form form)
{
    return form == FORM_TEXT || form == FORM_CHARACTERS || form == FORM_ENUM;
}

/* Columns of a number with several parts, 0 for missing parts. */
static void parts_of(const schema_field *f, unsigned parts[4])
{
    const bool interval = f->form == FORM_INTERVAL, errors = interval || f->form == FORM_ESTIMATE;
    parts[0] = errors ? f->standard_error : 0;
    parts[1] = errors ? f->numerical_error : 0;
    parts[2] = interval ? f->low : 0;
    parts[3] = interval ? f->high : 0;
}

static void check_binding(const binding *b)
{
    const schema_field *declared = NULL;
    const size_t n = fields_of(b, &declared);
    size_t shows = 0;
    unsigned times[SCHEMA_FIELDS_MAX] = {0};
    for (size_t i = 0; i < n; i++) {
        const schema_field *f = &b->shown[i];
        unsigned parts[4];
        assert_string_equal(f->name, declared[i].name);
        assert_int_equal(f->form != FORM_NONE, declared[i].member != NULL);
        if (f->form == FORM_NONE)
            continue;
        shows++;
        /* a missing number is NaN */
        const bool flag = f->form == FORM_YES_NO || (f->form == FORM_NUMBER && f->sparse);
        if ((f->kind == SCHEMA_TEXT) != is_words(f->form) || (f->yes_no && !flag) ||
            (f->form == FORM_YES_NO && !f->yes_no))
            fail_msg("%s: %s is not what %s is", b->schema->name, f->name, f->member);
        for (size_t j = 0; j < i; j++)
            if (b->shown[j].form != FORM_NONE && b->shown[j].offset == f->offset)
                fail_msg("%s: %s and %s both show %s", b->schema->name, b->shown[j].name, f->name,
                         f->member);
        times[i]++;
        parts_of(f, parts);
        for (size_t k = 0; k < 4 && !b->keys; k++)
            times[parts[k]] += parts[k] != 0;
    }
    for (size_t i = 0; i < n; i++)
        if (times[i] > 1)
            fail_msg("%s: %s is put twice", b->schema->name, declared[i].name);
    assert_true(shows > 0);
}

static const binding *binding_of(const binding *all, size_t n, const table_schema *schema,
                                 bool keys)
{
    for (size_t i = 0; i < n; i++)
        if (all[i].schema == schema && all[i].keys == keys)
            return &all[i];
    return NULL;
}

static void test_bindings(void **state)
{
    (void)state;
    const binding all[] = {ROWS(ROW_BINDING) KEYS(KEY_BINDING)};
    const size_t n = sizeof all / sizeof *all;
    for (size_t i = 0; i < n; i++)
        check_binding(&all[i]);
    for (size_t s = 0; s < table_n_schemas; s++)
        for (int keys = 0; keys < 2; keys++) {
            const binding wanted = {table_schemas[s], NULL, keys};
            const schema_field *fields = NULL;
            const size_t n_fields = fields_of(&wanted, &fields);
            bool bound = false;
            for (size_t i = 0; i < n_fields; i++)
                bound = bound || fields[i].member != NULL;
            if (bound != (binding_of(all, n, table_schemas[s], keys) != NULL))
                fail_msg("%s: its %s are not those of the lists above", table_schemas[s]->name,
                         keys ? "keys" : "columns");
        }
}

/* Errors and limits of an interval have the unit of their number. */
static void test_parts(void **state)
{
    (void)state;
    for (size_t s = 0; s < table_n_schemas; s++)
        for (size_t i = 0; i < table_schemas[s]->n_columns; i++) {
            const schema_field *columns = table_schemas[s]->columns, *f = &columns[i];
            const unsigned parts[] = {f->standard_error, f->numerical_error, f->low, f->high};
            for (size_t k = 0; k < 4; k++)
                if (parts[k] != 0 && strcmp(schema_unit(f), schema_unit(&columns[parts[k]])) != 0)
                    fail_msg("%s: %s has another unit than %s", table_schemas[s]->name,
                             columns[parts[k]].name, f->name);
        }
}

/* A program error is found where it occurs. */
static void test_writer(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_table *table = NULL;
    table_writer t = table_begin(&force_indentation_schema, &err);
    table_row(&t);
    force_indentation_put(&t, FORCE_INDENTATION_FORCE, 1);
    force_indentation_put(&t, FORCE_INDENTATION_FORCE, 2);
    assert_int_equal(table_end(&t, &table), WT_E_INTERNAL);
    assert_non_null(strstr(err.message, "twice"));
    t = table_begin(&force_indentation_schema, &err);
    table_row(&t);
    force_indentation_put(&t, FORCE_INDENTATION_FORCE, 1);
    assert_int_equal(table_end(&t, &table), WT_E_INTERNAL);
    assert_non_null(strstr(err.message, "was not put"));
    assert_null(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bindings),
                                       cmocka_unit_test(test_parts), cmocka_unit_test(test_writer)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
