/* Results: the tables of one run. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/former_names.h"
#include "core/table/table.h"

#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

struct wt_result {
    wt_table **tables;
    size_t n;
    wt_provenance *provenance;
    char *case_file; /* with a terminating zero that the length does not count */
    size_t case_length;
};

wt_result *wt_result_new(void)
{
    wt_result *const result = wt_alloc(1, sizeof *result);
    result->provenance = wt_provenance_new();
    return result;
}

void wt_result_free(wt_result *result)
{
    if (result == NULL)
        return;
    for (size_t i = 0; i < result->n; i++)
        wt_table_free(result->tables[i]);
    free(result->tables);
    wt_provenance_free(result->provenance);
    free(result->case_file);
    free(result);
}

/* True if one name equals the other or is a folder of it: a table cannot contain tables. */
static bool names_collide(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return (*a == '\0' && (*b == '\0' || *b == '/')) || (*b == '\0' && *a == '/');
}

wt_status wt_result_add(wt_result *result, wt_table *table, wt_error *err)
{
    wt_status status = WT_OK;
    if (!table_name_is_valid(table->name) || names_collide(table->name, "case") ||
        names_collide(table->name, "provenance")) {
        status = wt_fail(err, WT_E_ARG, "not a name for a table");
        wt_error_expected(err, "a to z, digits and '_' in parts joined by '/', but not \"case\" "
                               "or \"provenance\"");
        wt_error_found(err, "\"%s\"", table->name);
    } else if (result->n >= RESULT_TABLES_MAX) {
        status = wt_fail(err, WT_E_ARG, "more than %d tables", (int)RESULT_TABLES_MAX);
    }
    for (size_t i = 0; status == WT_OK && i < result->n; i++)
        if (names_collide(result->tables[i]->name, table->name))
            status = wt_fail(err, WT_E_ARG, "tables \"%s\" and \"%s\" collide",
                             result->tables[i]->name, table->name);
    if (status == WT_OK) {
        result->tables = array_grow(result->tables, result->n, sizeof *result->tables);
        result->tables[result->n++] = table;
    } else {
        wt_table_free(table);
    }
    return status;
}

size_t wt_result_n_tables(const wt_result *result)
{
    return result->n;
}

const wt_table *wt_result_table(const wt_result *result, size_t i)
{
    return result->tables[i];
}

const wt_table *wt_result_find(const wt_result *result, const char *name)
{
    const char *current = table_current_name(name);
    for (size_t i = 0; i < result->n; i++) {
        if (strcmp(result->tables[i]->name, current) == 0)
            return result->tables[i];
    }
    return NULL;
}

wt_provenance *wt_result_provenance(wt_result *result)
{
    return result->provenance;
}

const wt_provenance *wt_result_provenance_const(const wt_result *result)
{
    return result->provenance;
}

wt_status wt_result_set_case(wt_result *result, const char *xml, size_t length, wt_error *err)
{
    char *const copy = length > 0 ? wt_strndup(xml, length) : NULL;
    (void)err;
    free(result->case_file);
    result->case_file = copy;
    result->case_length = length;
    return WT_OK;
}

const char *wt_result_case(const wt_result *result, size_t *length)
{
    if (length != NULL)
        *length = result->case_length;
    return result->case_file;
}
