/* Schemas and their closed lists, and reading of tables according to them. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/table_view.h"
#include "core/table/schema.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* ---- schemas --------------------------------------------------------------------------------- */

const char *schema_unit(const schema_field *field)
{
    if (field->kind == SCHEMA_TEXT)
        return "";
    return field->unit != NULL ? field->unit : wt_quantity_unit(field->quantity);
}

void schema_name(const char *name, const char *suffix, char full[SCHEMA_NAME_SIZE])
{
    const size_t length = strlen(name);
    const bool open = length > 0 && strchr("/_", name[length - 1]) != NULL;
    (void)snprintf(full, SCHEMA_NAME_SIZE, "%s%s", name, open ? suffix : "");
}

/* True if a text of a list may end before this character. */
static bool is_end_of_text(char next)
{
    return next == '\0' || strchr(" :;,(", next) != NULL;
}

listed_text closed_list_read(const closed_list *list, const char *cell)
{
    size_t longest = 0;
    listed_text found = {list->n, cell != NULL ? cell : "", ""};
    for (int i = 0; cell != NULL && i < list->n; i++) {
        const size_t length = strlen(list->texts[i]);
        if (length > longest && strncmp(cell, list->texts[i], length) == 0 &&
            is_end_of_text(cell[length])) {
            longest = length;
            found = (listed_text){i, list->texts[i], cell + length + strspn(cell + length, ": ")};
        }
    }
    return found;
}

/* Returns the set of texts in a cell that lists several with commas; bit n for unknown texts. */
static uint64_t closed_list_find_items(const closed_list *list, const char *cell)
{
    uint64_t items = 0;
    for (const char *item = cell; item != NULL; item = strchr(item, ',')) {
        item += strspn(item, ", ");
        items |= SCHEMA_BIT(closed_list_read(list, item).value);
    }
    return items;
}

const char *closed_list_get(const closed_list *list, int value)
{
    return value >= 0 && value < list->n ? list->texts[value] : "";
}

/* ---- views ----------------------------------------------------------------------------------- */

static void advise_producer(const table_schema *schema, wt_error *err)
{
    wt_error_advice(err, "give the output of `weartrack %s`", schema->made_by);
}

static wt_status fail_missing_field(const wt_table *table, const table_schema *schema,
                                    const char *what, const char *name, wt_error *err)
{
    (void)wt_fail(err, WT_E_MISSING, "table \"%s\" has no %s \"%s\"", wt_table_name(table), what,
                  name);
    advise_producer(schema, err);
    return WT_E_MISSING;
}

static wt_status check_column(const wt_table *table, const table_schema *schema, size_t place,
                              const schema_field *c, wt_error *err)
{
    const char *const unit = wt_table_column_unit(table, place), *const si = schema_unit(c);
    const bool is_text = wt_table_column_kind(table, place) == WT_COLUMN_TEXT;
    if (is_text == (c->kind == SCHEMA_TEXT) && strcmp(unit, si) == 0)
        return WT_OK;
    (void)wt_fail(err, WT_E_UNIT, "column \"%s\" of table \"%s\"", c->name, wt_table_name(table));
    wt_error_expected(err, "%s%s", c->kind == SCHEMA_TEXT ? "text" : "numbers in ", si);
    wt_error_found(err, "%s%s", is_text ? "text" : "numbers in ", unit);
    advise_producer(schema, err);
    return WT_E_UNIT;
}

wt_status table_bind(const wt_table *table, const table_schema *schema, const char *suffix,
                     table_view *view, wt_error *err)
{
    *view = (table_view){
        .table = table, .schema = schema, .suffix = suffix, .n_rows = wt_table_n_rows(table)};
    for (size_t i = 0; i < schema->n_columns; i++) {
        const schema_field *const c = &schema->columns[i];
        wt_status status = WT_OK;
        view->column[i] = wt_table_find(table, c->name);
        if (view->column[i] >= 0)
            status = check_column(table, schema, (size_t)view->column[i], c, err);
        else if (!c->optional)
            status = fail_missing_field(table, schema, "column", c->name, err);
        if (status != WT_OK)
            return status;
    }
    for (size_t i = 0; i < schema->n_keys; i++)
        if (!schema->keys[i].optional && wt_table_key(table, schema->keys[i].name) == NULL)
            return fail_missing_field(table, schema, "key", schema->keys[i].name, err);
    return WT_OK;
}

wt_status table_bind_result(const wt_result *result, const table_schema *schema, const char *suffix,
                            table_view *view, wt_error *err)
{
    char name[SCHEMA_NAME_SIZE];
    schema_name(schema->name, suffix, name);
    const wt_table *const table = wt_result_find(result, name);
    if (table != NULL)
        return table_bind(table, schema, suffix, view, err);
    *view = (table_view){.schema = schema, .suffix = suffix};
    return WT_OK;
}

/* Returns the position of a column, -1 if the table lacks it. `of` must be the schema of the
 * view. */
static long column_position(const table_view *view, const table_schema *of, unsigned column)
{
    assert(view->schema == of && column < of->n_columns);
    return view->schema == of ? view->column[column] : -1;
}

bool view_has_column(const table_view *view, const table_schema *of, unsigned column)
{
    return column_position(view, of, column) >= 0;
}

double view_number(const table_view *view, const table_schema *of, size_t row, unsigned column)
{
    const long place = column_position(view, of, column);
    return place < 0 ? (double)NAN : wt_table_number(view->table, row, (size_t)place);
}

const char *view_text(const table_view *view, const table_schema *of, size_t row, unsigned column)
{
    const long place = column_position(view, of, column);
    return place < 0 ? "" : wt_table_text(view->table, row, (size_t)place);
}

wt_estimate view_key(const table_view *view, const table_schema *of, unsigned key)
{
    char name[SCHEMA_NAME_SIZE];
    wt_estimate e;
    assert(view->schema == of && key < of->n_keys);
    schema_name(of->keys[key].name, view->suffix, name);
    if (view->table == NULL || !wt_table_estimate(view->table, name, &e))
        return (wt_estimate){(double)NAN, (double)NAN, (double)NAN, schema_unit(&of->keys[key])};
    return e;
}

const char *view_key_text(const table_view *view, const table_schema *of, unsigned key)
{
    char name[SCHEMA_NAME_SIZE];
    assert(view->schema == of && key < of->n_keys);
    schema_name(of->keys[key].name, view->suffix, name);
    return view->table == NULL ? NULL : wt_table_key(view->table, name);
}

listed_text view_listed(const table_view *view, const table_schema *of, size_t row, unsigned column)
{
    assert(of->columns[column].list != NULL);
    return closed_list_read(of->columns[column].list, view_text(view, of, row, column));
}

listed_text view_key_listed(const table_view *view, const table_schema *of, unsigned key)
{
    assert(of->keys[key].list != NULL);
    return closed_list_read(of->keys[key].list, view_key_text(view, of, key));
}

uint64_t view_key_items(const table_view *view, const table_schema *of, unsigned key)
{
    assert(of->keys[key].list != NULL);
    return closed_list_find_items(of->keys[key].list, view_key_text(view, of, key));
}
