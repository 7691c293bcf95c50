/* Splits a table whose columns have different conditions, such as a pair of columns for each
 * temperature, into a table for each condition.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include "core/base/array.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_own_column(const text_column *c, size_t condition)
{
    return condition != ALL_CONDITIONS && c->condition == condition;
}

/* True if a shared column belongs to the table of a condition. The condition replaces a shared
 * column of its quantity, and an own column the shared one. */
static bool shares_column(const text_table *t, const text_column *c, size_t condition)
{
    if (c->condition != ALL_CONDITIONS)
        return false;
    if (condition == ALL_CONDITIONS)
        return true;
    const text_condition *const stated = &t->conditions[condition];
    const wt_quantity q = c->rule->quantity;
    if ((q == WT_Q_TEMPERATURE && !isnan(stated->temperature) && t->n_conditions > 1) ||
        ((q == WT_Q_FREQUENCY || q == WT_Q_ANGULAR_FREQUENCY) && !isnan(stated->angular_frequency)))
        return false;
    for (size_t i = 0; i < t->n_columns; i++)
        if (t->columns[i].condition == condition && t->columns[i].rule->quantity == q)
            return false;
    return true;
}

/* True if the row has a number in a column of the condition. */
static bool has_own_number(const text_table *t, size_t row, size_t condition)
{
    for (size_t i = 0; i < t->n_columns; i++)
        if ((condition == ALL_CONDITIONS || is_own_column(&t->columns[i], condition)) &&
            isfinite(text_table_value(t, row, &t->columns[i])))
            return true;
    return false;
}

/* Sets the header values and the title of the table of a condition. */
static void set_condition(text_table *to, const text_condition *c)
{
    char text[64], title[sizeof to->title];
    if (!isnan(c->temperature)) {
        to->header.value[HEADER_TEMPERATURE] = c->temperature;
        to->header.priority[HEADER_TEMPERATURE] = HEADER_YIELDS;
        to->has_own_condition = true;
    }
    if (!isnan(c->angular_frequency))
        to->header.value[HEADER_ANGULAR_FREQUENCY] = c->angular_frequency;
    condition_format(c, text, sizeof text);
    snprintf(title, sizeof title, "%.*s%s%s", (int)(sizeof title - sizeof text - 3), to->title,
             to->title[0] != '\0' ? ", " : "", text);
    memcpy(to->title, title, sizeof title);
}

static void alloc_rows(text_table *t, size_t n_rows)
{
    t->values = wt_alloc(n_rows, t->n_columns * sizeof *t->values);
    t->blocks = wt_alloc(n_rows, sizeof *t->blocks);
    t->kinds = wt_alloc(n_rows, sizeof *t->kinds);
    t->row_lines = wt_alloc(n_rows, sizeof *t->row_lines);
    t->samples = wt_alloc(n_rows, sizeof *t->samples);
}

/* Copies the rows of a condition. `cells` are the columns of `t` that `to` has. */
static void copy_rows(const text_table *t, size_t condition, const size_t *cells, text_table *to)
{
    to->n_rows = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        if (!has_own_number(t, row, condition))
            continue;
        const size_t n = to->n_rows++;
        for (size_t i = 0; i < to->n_columns; i++)
            to->values[n * to->n_columns + i] = t->values[row * t->n_columns + cells[i]];
        to->blocks[n] = t->blocks[row];
        to->kinds[n] = t->kinds[row];
        to->row_lines[n] = t->row_lines[row];
        to->samples[n] = t->samples[row];
    }
}

/* Creates the table of a condition. *to has no rows if its columns do not make a sweep. */
static void make_table(text_file *file, const text_table *t, size_t condition, text_table *to)
{
    size_t *const cells = wt_alloc(t->n_columns, sizeof *cells);
    *to = *t;
    to->values = NULL;
    to->blocks = to->row_lines = to->samples = NULL;
    to->kinds = NULL;
    to->conditions = NULL;
    to->n_conditions = to->n_rows = to->n_columns = 0;
    to->quantities = 0;
    to->columns = arena_alloc(&file->table_memory, t->n_columns, sizeof *to->columns);
    for (size_t i = 0; i < t->n_columns; i++) {
        const text_column *const c = &t->columns[i];
        if (!is_own_column(c, condition) && !shares_column(t, c, condition))
            continue;
        cells[to->n_columns] = i;
        to->columns[to->n_columns++] = *c;
        to->quantities |= WT_Q_BIT(c->rule->quantity);
    }
    const bool own_moduli =
        condition != ALL_CONDITIONS || quantities_suffice(to->quantities, WT_KIND_SWEEP);
    if (own_moduli) {
        alloc_rows(to, t->n_rows);
        copy_rows(t, condition, cells, to);
        if (condition != ALL_CONDITIONS)
            set_condition(to, &t->conditions[condition]);
    }
    free(cells);
}

/* Adds the tables of all conditions of a table to `tables`, which has space for them. */
static void split_table(text_file *file, const text_table *t, text_table *tables, size_t *n)
{
    for (size_t i = 0; i <= t->n_conditions; i++) {
        text_table made;
        make_table(file, t, i == 0 ? ALL_CONDITIONS : i - 1, &made);
        if (made.n_rows > 0)
            tables[(*n)++] = made;
        else
            text_table_free(&made);
    }
}

void tables_split_conditions(text_file *file)
{
    size_t n_max = file->n_tables, n = 0;
    for (size_t i = 0; i < file->n_tables; i++)
        n_max += file->tables[i].n_conditions;
    if (n_max == file->n_tables)
        return;
    text_table *const tables = wt_alloc(n_max, sizeof *tables);
    for (size_t i = 0; i < file->n_tables; i++) {
        text_table *const t = &file->tables[i];
        if (t->n_conditions == 0) {
            tables[n++] = *t;
            continue;
        }
        split_table(file, t, tables, &n);
        text_table_free(t);
    }
    free(file->tables);
    file->tables = tables;
    file->n_tables = n;
}
