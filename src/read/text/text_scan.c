/* Scans the lines of a text: header values, steps, names rows, units and rows. It can stop at the
 * beginning of a step.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_scanner.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TABLES_MAX ((size_t)100000)

/* Returns line i; false after the last line and on failure. */
static bool read_line(text_scanner *s, size_t i, text_span *line)
{
    if (s->status != WT_OK)
        return false;
    const wt_status got = feed_line(s->file->feed, i, line, s->err);
    if (got != WT_OK && got != WT_END)
        s->status = got;
    return got == WT_OK;
}

/* ---- beginning of a table ----------------------------------------------------------------- */

/* Adds a table without rows; false on failure. */
static bool add_table(text_scanner *s, const text_table *made)
{
    text_file *file = s->file;
    if (file->n_tables >= TABLES_MAX) {
        s->status = wt_fail(s->err, WT_E_RANGE, "more than %zu tables in one file", TABLES_MAX);
        return false;
    }
    const text_table copy = *made; /* may be one of the tables that are moved */
    file->tables = array_grow(file->tables, file->n_tables, sizeof *file->tables);
    s->table = &file->tables[file->n_tables++];
    *s->table = copy;
    s->table->has_own_condition = s->has_condition;
    s->has_condition = false;
    s->step_has_table = true;
    s->has_group = false;
    s->has_sample_name = false;
    s->snapshot = false;
    s->blank = false;
    s->last = (last_cell_stats){0};
    s->last_number = (double)NAN;
    s->unclosed = s->d->end_required;
    return true;
}

static void new_table(text_scanner *s)
{
    text_table made = {.names_line = s->i + 1,
                       .step_line = s->step_line,
                       .separator = s->names.separator,
                       .decimal = '.'};
    memcpy(made.title, s->title, sizeof s->title);
    /* a line between the tables began one without rows */
    s->has_condition = s->has_condition ||
                       (s->table != NULL && s->table->n_rows == 0 && s->table->has_own_condition);
    scan_apply_title(s);
    (void)add_table(s, &made);
}

/* Opens a table with the columns of the open one, if the line states the condition of further rows.
 * Returns true if the line states a condition. */
static bool read_condition_line(text_scanner *s)
{
    s->continues_table = false;
    const bool is_condition = scan_read_condition_line(s);
    if (!s->continues_table)
        return is_condition;
    text_table made = *s->table;
    made.names_line = s->i + 1;
    made.values = NULL;
    made.blocks = made.row_lines = made.samples = NULL;
    made.kinds = NULL;
    made.n_rows = made.n_grouped = 0;
    (void)add_table(s, &made);
    return true;
}

/* True if a number can be the unit of the quantity of a name: "1" of a loss factor. */
static bool is_unit_one(const text_description *d, const name_match *known, text_span cell)
{
    bool one = cell_equals(cell, "1");
    for (size_t k = known->first; k < known->first + known->n && one; k++)
        one = strcmp(wt_quantity_unit(d->rules[d->names[k].rule].quantity), "1") == 0;
    return one;
}

/* True if the row may contain units; a number in a known column excludes it. */
static bool is_units_row(text_scanner *s, const text_cells *cells)
{
    const text_description *d = s->d;
    if (d->row_prefix != NULL && cells->n > 0 && name_equals(cells->cells[0], d->row_prefix))
        return false;
    for (size_t i = 0; i < cells->n && i < s->names.names.n; i++) {
        const text_span cell = cells->cells[i];
        name_match known;
        double value;
        if (find_column_name(d, s->names.names.cells[i], &known) &&
            (wt_number_parse(cell.text, cell.length, '.', &value) ||
             wt_number_parse(cell.text, cell.length, ',', &value)) &&
            !is_unit_one(d, &known, cell))
            return false;
    }
    return true;
}

static bool names_have_units(const text_scanner *s)
{
    for (size_t i = 0; i < s->names.names.n; i++) {
        name_match known;
        if (find_column_name(s->d, s->names.names.cells[i], &known) && known.unit.length > 0)
            return true;
    }
    return false;
}

/* True if the line states the condition of the rows below it, so that it is no row of units. */
static bool is_condition_line(const text_scanner *s, text_span line)
{
    text_condition c;
    return s->reads_conditions && condition_read_line(line, &c);
}

/* Splits the next line that is not blank, from line *i. False if it contains a number in a known
 * column. */
static bool split_text_row(text_scanner *s, size_t *i, text_cells *cells)
{
    text_span line;
    for (const size_t end = *i + 4; *i < end && read_line(s, *i, &line); ++*i) {
        if (s->comment_names)
            (void)line_uncomment(s->d, &line);
        cells_split(cells, line, s->names.separator, s->d);
        if (cells_are_blank(cells))
            continue;
        if (is_units_row(s, cells) && !is_condition_line(s, line))
            return true;
        break;
    }
    cells->n = 0;
    return false;
}

/* Adds the conditions in a row of cells to those of the cells above the names. False if the row has
 * fewer than two: it is a line about the rows below it. */
static bool add_conditions(text_scanner *s, const text_cells *cells)
{
    names_row *const names = &s->names;
    if (!s->reads_conditions || cells->n == 0)
        return false;
    text_condition *const conditions = wt_alloc(cells->n, sizeof *conditions);
    if (cells_read_conditions(s->d, cells, conditions) < 2) {
        free(conditions);
        return false;
    }
    for (size_t i = 0; i < cells->n && i < names->n_above; i++)
        condition_merge(&conditions[i], &names->above[i]);
    free(names->above);
    names->above = conditions;
    names->n_above = cells->n;
    return true;
}

/* Looks for the rows of qualifiers and of units after the names row, and moves to the last one. */
static void find_units(text_scanner *s)
{
    names_row *const names = &s->names;
    const bool have_units = s->d->units == UNITS_NAME_OR_ROW && names_have_units(s);
    size_t i = s->i + 1;
    names->qualifiers.n = 0;
    if (!split_text_row(s, &i, &names->units))
        return;
    const bool has_conditions = add_conditions(s, &names->units);
    if (has_conditions || !have_units)
        s->i = i;
    if (has_conditions || have_units)
        names->units.n = 0;
    if (have_units)
        return;
    i = s->i + 1;
    if (!split_text_row(s, &i, &names->qualifiers))
        return;
    const bool are_units = names_count_units(names, s->d, &names->qualifiers) >
                           names_count_units(names, s->d, &names->units);
    const text_cells last = names->qualifiers;
    if (are_units) {
        names->qualifiers = names->units;
        names->units = last;
        s->i = i;
    } else if (add_conditions(s, &names->qualifiers)) {
        s->i = i;
    }
    names->qualifiers.n = are_units ? names->qualifiers.n : 0;
}

static cell_separator row_separator(const text_scanner *s)
{
    if (s->separator != SEPARATOR_AUTO)
        return s->separator;
    if (s->d->separator != SEPARATOR_AUTO)
        return s->d->separator;
    return s->names.separator;
}

static char choose_decimal(text_scanner *s)
{
    text_span line;
    size_t commas = 0, points = 0;
    if (s->decimal != '\0' || s->d->decimal != '\0')
        return s->decimal != '\0' ? s->decimal : s->d->decimal;
    /* In rows separated by commas, a comma within a cell is quoted. The first row may be the names
     * row. */
    for (size_t i = s->i + !description_is_nameless(s->d);
         i < s->i + 101 && commas + points < 64 && read_line(s, i, &line); i++) {
        cells_split(&s->row, line, s->table->separator, s->d);
        cells_count_decimal_marks(&s->row, &commas, &points);
    }
    return commas > points ? ',' : '.';
}

/* Begins the rows after this line, since names and units are complete. */
static void begin_rows(text_scanner *s)
{
    names_resolve(&s->names, s->file, s->table, s->options);
    s->names.n_above = 0;
    s->names.qualifiers.n = 0;
    s->table->separator = row_separator(s);
    s->state = SCAN_ROWS;
    s->table->decimal = choose_decimal(s);
}

/* Collects names that are listed one per line, up to the line above the rows. If one name does not
 * fit, none is used, since later names would shift to other columns. */
static bool collect_names(text_scanner *s, text_span *line)
{
    text_span name = *line;
    if (pattern_extract(&s->d->names_lines, &name)) {
        if (s->n_gathered + name.length + 1 < sizeof s->gathered) {
            s->gathered[s->n_gathered] = '\t';
            s->n_gathered += s->n_gathered > 0;
            memcpy(s->gathered + s->n_gathered, name.text, name.length);
            s->n_gathered += name.length;
        } else {
            s->n_gathered = sizeof s->gathered;
        }
        return false;
    }
    if (!pattern_match(&s->d->names_line, *line, NULL, 0))
        return false;
    const bool all = s->n_gathered < sizeof s->gathered;
    *line = (text_span){s->gathered, all ? s->n_gathered : 0};
    s->n_gathered = 0;
    return all;
}

static void scan_table_line(text_scanner *s);

/* Opens a table if the line is its first row and the file has no names. */
static bool match_row(text_scanner *s)
{
    if (s->comment || s->state != SCAN_HEADER ||
        !names_match_row(&s->names, s->d, s->line, s->separator))
        return false;
    new_table(s);
    if (s->status == WT_OK) {
        begin_rows(s);
        scan_table_line(s);
    }
    return true;
}

/* Opens a table if the line is a names row, and moves to the last line of names and units. */
static bool match_names(text_scanner *s)
{
    const text_description *d = s->d;
    text_span line = s->line;
    if (description_is_nameless(d))
        return match_row(s);
    const cell_separator separator =
        d->names_separator != SEPARATOR_AUTO ? d->names_separator : s->separator;
    if (!(d->names_lines.compiled ? collect_names(s, &line) : names_extract(d, &line)) ||
        !names_match(&s->names, d, line, separator, s->kinds))
        return false;
    s->comment_names = s->comment && !d->has_names_line;
    new_table(s);
    if (s->status == WT_OK && (d->units == UNITS_ROW || d->units == UNITS_NAME_OR_ROW))
        find_units(s);
    if (s->status == WT_OK && d->units == UNITS_LINE)
        s->state = SCAN_UNITS;
    else if (s->status == WT_OK)
        begin_rows(s);
    return true;
}

/* True if the line is the title of a table, with its temperature, and the next one its names. */
static bool is_table_title(text_scanner *s)
{
    text_condition c;
    text_span line;
    names_row names = {.separator = SEPARATOR_AUTO};
    bool found = s->reads_conditions && s->d->n_steps == 0 && condition_read_title(s->line, &c);
    for (size_t i = s->i + 1; found && (found = read_line(s, i, &line)) && line.length == 0;)
        i++;
    found = found && names_extract(s->d, &line) &&
            names_match(&names, s->d, line, s->table->separator, s->kinds);
    names_free(&names);
    return found;
}

/* ---- the scan -------------------------------------------------------------------------------- */

static void scan_header_line(text_scanner *s)
{
    if (s->title_next && !s->comment) {
        text_copy(s->title, sizeof s->title, s->line);
        s->title_next = false;
        return;
    }
    const bool mark = scan_match_markers(s);
    scan_header_fields(s);
    if (s->status == WT_OK && !mark && !match_names(s))
        (void)read_condition_line(s);
}

/* Warns of rows after the end of a table, which would be lost otherwise. */
static void warn_orphan_row(text_scanner *s)
{
    size_t bad = 0;
    text_table *t = s->table;
    if (t == NULL || t->n_columns == 0 || t->n_rows == 0 || s->d->row_prefix != NULL ||
        s->step_line != t->step_line)
        return;
    scan_split_row(s);
    if (s->row.n >= t->n_names && scan_read_row(s, &bad) == ROW_GOOD)
        wt_log_add(s->log, WT_WARNING, s->file->name, format_line_position(s->i + 1).text,
                   "row of numbers after the end of its table, not read");
}

/* True if no table row follows, only text such as a signature or remarks. It is called once for
 * each table. */
static bool rest_is_text(text_scanner *s)
{
    const text_span line = s->line;
    bool words = true;
    for (size_t i = s->i + 1; words && read_line(s, i, &s->line); i++) {
        size_t bad = 0;
        scan_split_row(s);
        words = cells_are_blank(&s->row) || scan_read_row(s, &bad) == ROW_TEXT;
    }
    s->line = line;
    scan_split_row(s);
    return words && s->status == WT_OK;
}

static void skip_rest(text_scanner *s)
{
    char found[48];
    text_copy(found, sizeof found, s->line);
    wt_log_add(s->log, WT_WARNING, s->file->name, format_line_position(s->i + 1).text,
               "the lines from here on are no rows of the table and are left out: \"%s\"", found);
    s->state = SCAN_HEADER;
    scan_header_line(s);
}

static void scan_table_line(text_scanner *s)
{
    const text_description *d = s->d;
    const text_table *t = s->table;
    size_t bad = SIZE_MAX;
    scan_split_row(s);
    if (cells_are_blank(&s->row)) {
        s->block += d->blank_is_block && t->n_rows > 0 && !s->blank;
        s->blank = true;
        return;
    }
    if (d->row_prefix != NULL && !name_equals(s->row.cells[0], d->row_prefix)) {
        scan_header_line(s);
        return;
    }
    if (d->row_prefix == NULL && scan_match_markers(s)) {
        scan_header_fields(s);
        return;
    }
    const row_quality row = scan_read_row(s, &bad);
    const line_end end = feed_line_end(s->file->feed, s->i);
    if (end == END_NONE && (row != ROW_GOOD || !truncation_row_is_complete(s))) {
        s->last_row = LAST_ROW_DROPPED;
    } else if (row == ROW_GOOD) {
        s->last_row = end == END_NONE ? LAST_ROW_KEPT : LAST_ROW_NONE;
        scan_add_row(s);
    } else if (row != ROW_UNUSED && !match_names(s) && !read_condition_line(s) &&
               s->status == WT_OK) {
        if (row == ROW_TEXT && !s->blank && t->n_rows > 0 && d->row_prefix == NULL &&
            rest_is_text(s))
            skip_rest(s);
        else if ((!s->blank && !is_table_title(s)) ||
                 (row == ROW_BROKEN && s->row.n == t->n_names) || d->row_prefix != NULL) {
            scan_fail_row(s, bad);
        } else {
            s->state = SCAN_HEADER;
            scan_header_line(s);
        }
    }
}

static void units_line(text_scanner *s)
{
    text_span units = s->line;
    if (pattern_extract(&s->d->units_line, &units)) {
        cells_split(&s->names.units, units, s->names.separator, s->d);
        begin_rows(s);
    } else if (s->comment) {
        scan_header_line(s);
    } else if (s->line.length > 0) {
        begin_rows(s);
        scan_table_line(s);
    }
}

void scan_lines(text_scanner *s)
{
    for (; read_line(s, s->i, &s->line); s->i++) {
        text_span rest = s->line;
        s->last_is_short = s->last_is_short && s->line.length == 0;
        s->comment = line_uncomment(s->d, &rest);
        if (s->state == SCAN_UNITS) {
            units_line(s);
        } else if (s->state == SCAN_ROWS && !s->comment) {
            scan_table_line(s);
        } else {
            scan_header_line(s);
            if (s->state == SCAN_HEADER && s->status == WT_OK && !s->comment)
                warn_orphan_row(s);
        }
        if (!s->halts)
            continue;
        feed_discard(s->file->feed, s->i);
        if (s->step_line == s->i + 1 && s->table != NULL && s->status == WT_OK) {
            s->i++;
            return;
        }
    }
    s->ended = true;
    if (s->status == WT_OK)
        truncation_report(s);
    if (s->status == WT_OK)
        scan_finish_step(s);
    if (s->status == WT_OK)
        scan_check_row_count(s);
}
