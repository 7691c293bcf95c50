/* Reads the conditions that stand above or below the names row of a table.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_scanner.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

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
        if (!cells_split(&cells, s->line, all[i], s->d)) {
            cells_free(&cells);
            scan_no_memory(s);
            return false;
        }
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
