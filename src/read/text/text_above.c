/* Reads the conditions that stand above or below the names row of a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "read/text/text.h"
#include "read/text/text_scanner.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reads a row whose first cell names a quantity with its unit, and whose other cells are numbers:
 * "T (°C);0;0;20;20". */
static size_t read_numbers(const text_description *d, const text_cells *cells,
                           text_condition *conditions)
{
    size_t n = 0, first = 0;
    name_match known;
    double factor = 1, offset = 0;
    while (first < cells->n && cells->cells[first].length == 0)
        first++;
    if (first == cells->n || !find_column_name(d, cells->cells[first], &known) ||
        known.unit.length == 0)
        return 0;
    const wt_quantity quantity = d->rules[d->names[known.first].rule].quantity;
    char unit[32];
    text_copy(unit, sizeof unit, known.unit);
    if ((quantity != WT_Q_TEMPERATURE && quantity != WT_Q_FREQUENCY) ||
        !description_unit_to_si(d, quantity, unit, &factor, &offset))
        return 0;
    for (size_t i = first + 1; i < cells->n; i++) {
        double number;
        if (cells->cells[i].length == 0)
            continue;
        if (!wt_number_parse(cells->cells[i].text, cells->cells[i].length, '.', &number) &&
            !wt_number_parse(cells->cells[i].text, cells->cells[i].length, ',', &number))
            return 0;
        if (quantity == WT_Q_TEMPERATURE)
            conditions[i].temperature = factor * number + offset;
        else
            conditions[i].angular_frequency = 2 * M_PI * factor * number;
        n++;
    }
    return n;
}

/* Reads a row whose cells state conditions. The first cell may be a label. */
static size_t read_texts(const text_cells *cells, text_condition *conditions)
{
    size_t n = 0, texts = 0;
    for (size_t i = 0; i < cells->n; i++) {
        if (cells->cells[i].length == 0)
            continue;
        if (condition_read_line(cells->cells[i], &conditions[i]))
            n++;
        else if (n > 0 || texts++ > 0)
            return 0;
        else
            conditions[i] = condition_none();
    }
    return n;
}

/* Extends a condition over the empty cells after it, as in merged cells of a spreadsheet. The last
 * one covers no more cells than the others. */
static void fill_merged_cells(const text_cells *cells, text_condition *conditions)
{
    size_t span = SIZE_MAX, last = SIZE_MAX;
    for (size_t i = 0; i < cells->n; i++) {
        if (condition_is_empty(&conditions[i]))
            continue;
        span = last != SIZE_MAX && i - last < span ? i - last : span;
        last = i;
    }
    last = SIZE_MAX;
    for (size_t i = 0; i < cells->n; i++) {
        if (cells->cells[i].length > 0)
            last = condition_is_empty(&conditions[i]) ? SIZE_MAX : i;
        else if (last != SIZE_MAX && i - last < span)
            conditions[i] = conditions[last];
    }
}

size_t cells_read_conditions(const text_description *d, const text_cells *cells,
                             text_condition *conditions)
{
    for (size_t i = 0; i < cells->n; i++)
        conditions[i] = condition_none();
    size_t n = read_numbers(d, cells, conditions);
    if (n == 0) {
        for (size_t i = 0; i < cells->n; i++)
            conditions[i] = condition_none();
        n = read_texts(cells, conditions);
    }
    fill_merged_cells(cells, conditions);
    return n;
}

/* True if at least two cells of the line have conditions, for the columns below them. */
static bool read_condition_cells(text_scanner *s)
{
    static const cell_separator all[] = {SEPARATOR_TAB, SEPARATOR_SEMICOLON, SEPARATOR_COMMA};
    bool found = false;
    if (s->line.length > PATTERN_LINE_MAX)
        return false;
    for (size_t i = 0; i < sizeof all / sizeof *all && !found; i++) {
        text_cells cells = {0};
        cells_split(&cells, s->line, all[i], s->d);
        text_condition *const conditions = wt_alloc(cells.n, sizeof *conditions);
        found = cells_read_conditions(s->d, &cells, conditions) >= 2;
        if (found) {
            free(s->names.above);
            s->names.above = conditions;
            s->names.n_above = cells.n;
        } else {
            free(conditions);
        }
        cells_free(&cells);
    }
    return found;
}

static void set_condition(text_scanner *s, const text_condition *c)
{
    const double values[] = {c->temperature, c->angular_frequency};
    static const header_value headers[] = {HEADER_TEMPERATURE, HEADER_ANGULAR_FREQUENCY};
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        if (isnan(values[i]))
            continue;
        s->header.value[headers[i]] = values[i];
        s->header.priority[headers[i]] = HEADER_YIELDS;
    }
}

bool scan_read_condition_line(text_scanner *s)
{
    text_condition c;
    if (!s->reads_conditions || s->status != WT_OK || s->line.length == 0)
        return false;
    if (!condition_read_line(s->line, &c)) {
        if (read_condition_cells(s)) {
            s->state = SCAN_HEADER;
            return true;
        }
        if (s->state != SCAN_ROWS)
            (void)condition_read_title(s->line, &s->title_condition);
        return false;
    }
    set_condition(s, &c);
    s->has_condition = s->state != SCAN_ROWS || s->table->n_rows > 0;
    s->continues_table = s->state == SCAN_ROWS && s->table->n_rows > 0;
    if (s->state == SCAN_ROWS && !s->continues_table)
        s->table->has_own_condition = true;
    return true;
}

void scan_apply_title(text_scanner *s)
{
    if (!s->has_condition && !condition_is_empty(&s->title_condition)) {
        set_condition(s, &s->title_condition);
        s->has_condition = true;
    }
    s->title_condition = condition_none();
}

/* ---- tables of several conditions ------------------------------------------------------------ */

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
static void set_table_condition(text_table *to, const text_condition *c)
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
            set_table_condition(to, &t->conditions[condition]);
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
