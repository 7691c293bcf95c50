/* One walk over the lines of a text: header values, steps, names rows, units, rows.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_scan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TABLES_MAX ((size_t)100000)

/* ---- beginning of a table ----------------------------------------------------------------- */

static wt_status new_table(text_scanner *s, size_t line_number)
{
    text_file *file = s->file;
    if (file->n_tables >= TABLES_MAX)
        return wt_fail(s->err, WT_E_RANGE, "more than %zu tables in one file", TABLES_MAX);
    if (file->n_tables == file->capacity) {
        size_t capacity = file->capacity > 0 ? 2 * file->capacity : 8;
        text_table *grown = realloc(file->tables, capacity * sizeof *grown);
        if (grown == NULL)
            return scan_no_memory(s);
        file->tables = grown;
        file->capacity = capacity;
    }
    s->table = &file->tables[file->n_tables];
    *s->table = (text_table){.names_line = line_number,
                             .step_line = s->step_line,
                             .separator = s->names.separator,
                             .decimal = '.'};
    memcpy(s->table->title, s->title, sizeof s->title);
    file->n_tables++;
    s->step_has_table = true;
    s->has_group = false;
    s->snapshot = false;
    s->blank = false;
    return WT_OK;
}

/* Could the row be units? Not if a known column holds a number. */
static bool units_row(text_scanner *s, const text_cells *cells)
{
    const text_description *d = s->d;
    if (d->row_prefix != NULL && cells->n > 0 &&
        name_is(cells->cells[0].text, cells->cells[0].length, d->row_prefix))
        return false;
    for (size_t i = 0; i < cells->n && i < s->names.names.n; i++) {
        size_t first, n;
        text_cell unit;
        double value;
        if (names_known(d, s->names.names.cells[i], &first, &n, &unit) &&
            (wt_number_parse(cells->cells[i].text, cells->cells[i].length, '.', &value) ||
             wt_number_parse(cells->cells[i].text, cells->cells[i].length, ',', &value)))
            return false;
    }
    return true;
}

static bool names_have_units(const text_scanner *s)
{
    for (size_t i = 0; i < s->names.names.n; i++) {
        size_t first, n;
        text_cell unit;
        if (names_known(s->d, s->names.names.cells[i], &first, &n, &unit) && unit.length > 0)
            return true;
    }
    return false;
}

/* Looks for the units row after the names row; *last is the last line that belongs to the two. */
static wt_status find_units(text_scanner *s, size_t *last)
{
    const text_lines *lines = &s->file->lines;
    if (s->d->units == UNITS_NAME_OR_ROW && names_have_units(s))
        return WT_OK;
    for (size_t i = *last + 1; i < lines->n && i <= *last + 4; i++) {
        size_t length;
        const char *line = lines_get(lines, i, &length);
        if (s->comment_names)
            (void)line_uncomment(s->d, &line, &length);
        if (!cells_split(&s->names.units, line, length, s->names.separator, s->d))
            return scan_no_memory(s);
        if (cells_blank(&s->names.units))
            continue;
        if (units_row(s, &s->names.units)) {
            *last = i;
            return WT_OK;
        }
        break;
    }
    s->names.units.n = 0;
    return WT_OK;
}

static cell_separator row_separator(const text_scanner *s)
{
    if (s->separator != SEPARATOR_AUTO)
        return s->separator;
    if (s->d->separator != SEPARATOR_AUTO)
        return s->d->separator;
    return s->names.separator;
}

static wt_status choose_decimal(text_scanner *s, size_t from, char *decimal)
{
    const text_lines *lines = &s->file->lines;
    size_t commas = 0, points = 0;
    if (s->decimal != '\0' || s->d->decimal != '\0') {
        *decimal = s->decimal != '\0' ? s->decimal : s->d->decimal;
        return WT_OK;
    }
    *decimal = '.';
    if (s->table->separator == SEPARATOR_COMMA)
        return WT_OK;
    for (size_t i = from; i < lines->n && i < from + 100 && commas + points < 64; i++) {
        size_t length;
        const char *line = lines_get(lines, i, &length);
        if (!cells_split(&s->row, line, length, s->table->separator, s->d))
            return scan_no_memory(s);
        cells_count_marks(&s->row, &commas, &points);
    }
    if (commas > points)
        *decimal = ',';
    return WT_OK;
}

/* Names and units are known: the rows begin after line `last` (counted from 0). */
static wt_status begin_rows(text_scanner *s, size_t last)
{
    wt_status status = names_resolve(&s->names, s->file, s->table, s->options, s->err);
    if (status != WT_OK)
        return status;
    s->table->separator = row_separator(s);
    s->state = SCAN_ROWS;
    return choose_decimal(s, last + 1, &s->table->decimal);
}

/* Is the line a names row? Then opens a table; *i moves to the last line of names and units. */
static wt_status match_names(text_scanner *s, size_t *i, const char *line, size_t length,
                             bool comment, bool *is)
{
    const text_description *d = s->d;
    wt_status status;
    cell_separator separator = d->names_separator;
    *is = false;
    if (separator == SEPARATOR_AUTO)
        separator = s->separator;
    if (!names_part(d, &line, &length))
        return WT_OK;
    if (!names_match(&s->names, d, line, length, separator, s->kinds))
        return s->names.no_memory ? scan_no_memory(s) : WT_OK;
    *is = true;
    s->comment_names = comment && !d->has_names_line;
    status = new_table(s, *i + 1);
    if (status != WT_OK)
        return status;
    if (d->units == UNITS_LINE) {
        s->state = SCAN_UNITS;
        return WT_OK;
    }
    if (d->units == UNITS_ROW || d->units == UNITS_NAME_OR_ROW)
        status = find_units(s, i);
    return status == WT_OK ? begin_rows(s, *i) : status;
}

/* ---- the walk ----------------------------------------------------------------------------- */

static wt_status header_line(text_scanner *s, size_t *i, const char *line, size_t length,
                             bool comment)
{
    bool is = false;
    if (s->title_next && !comment) {
        text_copy(s->title, sizeof s->title, line, length);
        s->title_next = false;
        return WT_OK;
    }
    wt_status status = scan_marks(s, *i + 1, line, length, &is);
    scan_fields(s, *i + 1, line, length);
    if (status == WT_OK && !is)
        status = match_names(s, i, line, length, comment, &is);
    return status;
}

/* Rows that come back after the table seemed to end would be lost without a word. */
static wt_status watch_orphan(text_scanner *s, size_t line_number, const char *line, size_t length)
{
    size_t bad = 0;
    text_table *t = s->table;
    if (t == NULL || t->n_columns == 0 || t->n_rows == 0 || s->d->row_prefix != NULL ||
        s->step_line != t->step_line)
        return WT_OK;
    wt_status status = scan_grow(s);
    if (status != WT_OK)
        return status;
    if (!cells_split(&s->row, line, length, t->separator, s->d))
        return scan_no_memory(s);
    if (s->row.n < t->n_names || scan_read_row(s, &bad) != ROW_GOOD)
        return WT_OK;
    wt_parselog_add(s->log, WT_WARNING, s->file->name, line_place(line_number).words,
                    "row of numbers after the end of its table, not read");
    return WT_OK;
}

static wt_status table_line(text_scanner *s, size_t *i, const char *line, size_t length)
{
    const text_description *d = s->d;
    text_table *t = s->table;
    bool is = false;
    size_t bad = SIZE_MAX;
    if (!cells_split(&s->row, line, length, t->separator, d))
        return scan_no_memory(s);
    if (cells_blank(&s->row)) {
        s->block += d->blank_is_block && t->n_rows > 0 && !s->blank;
        s->blank = true;
        return WT_OK;
    }
    if (d->row_prefix != NULL &&
        !name_is(s->row.cells[0].text, s->row.cells[0].length, d->row_prefix))
        return header_line(s, i, line, length, false);
    wt_status status = d->row_prefix == NULL ? scan_marks(s, *i + 1, line, length, &is) : WT_OK;
    if (status != WT_OK)
        return status;
    if (is) {
        scan_fields(s, *i + 1, line, length);
        return WT_OK;
    }
    status = scan_grow(s);
    if (status != WT_OK)
        return status;
    row_quality row = scan_read_row(s, &bad);
    if (row == ROW_GOOD)
        return scan_add_row(s, *i + 1);
    status = match_names(s, i, line, length, false, &is);
    if (status != WT_OK || is)
        return status;
    if (!s->blank || (row == ROW_BROKEN && s->row.n == t->n_names) || d->row_prefix != NULL)
        return scan_bad_row(s, *i + 1, bad);
    scan_close(s);
    return header_line(s, i, line, length, false);
}

static wt_status units_line(text_scanner *s, size_t *i, const char *line, size_t length,
                            bool comment)
{
    const char *units = line;
    size_t n = length;
    if (pattern_part(&s->d->units_line, &units, &n)) {
        if (!cells_split(&s->names.units, units, n, s->names.separator, s->d))
            return scan_no_memory(s);
        return begin_rows(s, *i);
    }
    if (comment)
        return header_line(s, i, line, length, true);
    if (length == 0)
        return WT_OK;
    wt_status status = begin_rows(s, *i);
    return status == WT_OK ? table_line(s, i, line, length) : status;
}

static wt_status walk(text_scanner *s)
{
    const text_lines *lines = &s->file->lines;
    wt_status status = WT_OK;
    for (size_t i = 0; i < lines->n && status == WT_OK; i++) {
        size_t length;
        const char *line = lines_get(lines, i, &length);
        const char *rest = line;
        size_t rest_length = length;
        const bool comment = line_uncomment(s->d, &rest, &rest_length);
        if (s->state == SCAN_UNITS) {
            status = units_line(s, &i, line, length, comment);
        } else if (comment) {
            status = header_line(s, &i, line, length, true);
        } else if (s->state == SCAN_ROWS) {
            status = table_line(s, &i, line, length);
        } else {
            const size_t before = i;
            status = header_line(s, &i, line, length, false);
            if (status == WT_OK && s->state == SCAN_HEADER)
                status = watch_orphan(s, before + 1, line, length);
        }
    }
    return status == WT_OK ? scan_finish_step(s) : status;
}

static void free_table(text_table *t)
{
    free(t->values);
    free(t->blocks);
    free(t->kinds);
}

/* Tables without a row carry nothing. */
static void drop_empty_tables(text_file *file)
{
    size_t kept = 0;
    for (size_t i = 0; i < file->n_tables; i++) {
        if (file->tables[i].n_rows == 0)
            free_table(&file->tables[i]);
        else
            file->tables[kept++] = file->tables[i];
    }
    file->n_tables = kept;
}

static void log_text(const text_file *file, wt_parselog *log)
{
    const text_lines *lines = &file->lines;
    if (lines->odd_byte)
        wt_parselog_add(log, WT_NOTE, file->name, NULL,
                        "half a character at the end of the file was dropped");
    if (lines->n_replaced > 0)
        wt_parselog_add(log, WT_WARNING, file->name, NULL,
                        "%zu byte sequences are no characters of %s", lines->n_replaced,
                        lines->encoding);
}

static bool has_column(const text_column *columns, size_t n, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (name_is(columns[i].name, strlen(columns[i].name), name))
            return true;
    return false;
}

/* A unit that is given for a column that is not there is most likely misspelled. */
static wt_status check_given_units(const text_file *file, const wt_read_options *options,
                                   wt_parselog *log, wt_error *err)
{
    for (size_t u = 0; u < options->n_units; u++) {
        char name[NAME_MAX];
        const char *equal = strrchr(options->units[u], '=');
        bool found = false;
        if (equal == NULL || equal == options->units[u] || equal[1] == '\0') {
            wt_fail(err, WT_E_ARG, "a unit is not given as NAME=UNIT");
            wt_error_found(err, "\"%s\"", options->units[u]);
            wt_error_advice(err, "for example --units \"E'=MPa\"");
            return WT_E_ARG;
        }
        name_normalise(options->units[u], (size_t)(equal - options->units[u]), name);
        for (size_t i = 0; i < file->n_tables && !found; i++)
            found = has_column(file->tables[i].columns, file->tables[i].n_columns, name) ||
                    has_column(file->tables[i].problems, file->tables[i].n_problems, name);
        if (!found)
            wt_parselog_add(log, WT_WARNING, file->name, NULL,
                            "a unit is given for \"%.*s\", but there is no such column",
                            (int)(equal - options->units[u]), options->units[u]);
    }
    return WT_OK;
}

wt_status text_scan(const text_description *description, wt_input *input, unsigned kinds,
                    const wt_read_options *options, wt_parselog *log, text_file *file,
                    wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    text_file made = {.description = description, .name = wt_input_name(input)};
    text_scanner s = {.file = &made,
                      .d = description,
                      .options = options,
                      .log = log,
                      .err = err,
                      .kinds = kinds & description->kinds,
                      .kind = ROW_KIND_NONE};
    for (size_t i = 0; i < HEADER_COUNT; i++)
        s.header.value[i] = (double)NAN;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = lines_decode(bytes, length, description->encoding, &made.lines, err);
    if (status == WT_OK) {
        made.values = pool_alloc(&made.memory, description->n_fields, sizeof *made.values);
        status = made.values != NULL ? walk(&s) : scan_no_memory(&s);
    }
    if (status == WT_OK)
        status = check_given_units(&made, options, log, err);
    names_free(&s.names);
    free(s.row.cells);
    if (status != WT_OK) {
        wt_error_file(err, made.name);
        text_file_free(&made);
        return status;
    }
    drop_empty_tables(&made);
    log_text(&made, log);
    *file = made;
    return WT_OK;
}

void text_file_free(text_file *file)
{
    for (size_t i = 0; i < file->n_tables; i++)
        free_table(&file->tables[i]);
    free(file->tables);
    pool_free(&file->memory);
    lines_free(&file->lines);
    *file = (text_file){0};
}
