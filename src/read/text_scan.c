/* One walk over the lines of a text: header values, steps, names rows, units, rows.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TABLES_MAX ((size_t)100000)
#define STEPS_MAX ((size_t)64)

typedef enum scan_state {
    SCAN_HEADER, /* no table is open */
    SCAN_UNITS,  /* the names row was read, the line of units comes */
    SCAN_ROWS
} scan_state;

typedef struct scan {
    wt_text_file *file;
    const wt_description *d;
    const wt_read_options *options;
    wt_parselog *log;
    wt_error *err;
    unsigned kinds;
    scan_state state;
    wt_names names;
    wt_cells row;
    wt_text_table *table; /* the open one, or the last one; NULL before the first */
    wt_text_header header;
    char decimal;           /* as declared by the file, or '\0' */
    wt_separator separator; /* as declared by the file, or WT_SEPARATOR_AUTO */
    char title[96];
    size_t step_line;
    bool title_next;     /* the next line is the title of the step */
    bool step_has_table; /* the current step has shown its names row */
    bool blank;          /* the line before was blank */
    bool comment_names;  /* the names row stands in a comment */
    bool snapshot;       /* the header values are in the table */
    unsigned char kind;  /* of the rows after a marker */
    size_t block;
    size_t group_hash; /* of the cells whose change begins a block */
    bool has_group;
} scan;

static wt_status no_memory(scan *s)
{
    return wt_fail(s->err, WT_E_MEMORY, "no memory for the tables of the file");
}

static const char *cut(char buffer[64], const char *text, size_t length)
{
    snprintf(buffer, 64, "%.*s", (int)(length < 48 ? length : 48), text);
    return buffer;
}

/* ---- header lines ------------------------------------------------------------------------- */

static bool starts_with(const char *line, size_t length, const char *prefix)
{
    size_t n = strlen(prefix);
    return length >= n && memcmp(line, prefix, n) == 0;
}

static bool same_word(const char *text, size_t length, const char *word)
{
    char name[WT_NAME_MAX];
    wt_name_normalise(text, length, name);
    return strcmp(name, word) == 0;
}

static void set_declared(scan *s, wt_field_sets sets, const char *text, size_t length)
{
    static const struct {
        const char *word;
        wt_separator separator;
    } separators[] = {{"tab", WT_SEPARATOR_TAB},          {"semicolon", WT_SEPARATOR_SEMICOLON},
                      {";", WT_SEPARATOR_SEMICOLON},      {"comma", WT_SEPARATOR_COMMA},
                      {",", WT_SEPARATOR_COMMA},          {"space", WT_SEPARATOR_WHITESPACE},
                      {"blank", WT_SEPARATOR_WHITESPACE}, {"whitespace", WT_SEPARATOR_WHITESPACE}};
    if (sets == WT_FIELD_SETS_DECIMAL) {
        if (same_word(text, length, "comma") || same_word(text, length, ","))
            s->decimal = ',';
        else if (same_word(text, length, "point") || same_word(text, length, "dot") ||
                 same_word(text, length, "."))
            s->decimal = '.';
    } else if (sets == WT_FIELD_SETS_SEPARATOR) {
        for (size_t i = 0; i < sizeof separators / sizeof *separators; i++)
            if (same_word(text, length, separators[i].word))
                s->separator = separators[i].separator;
    }
}

static wt_status set_field(scan *s, size_t f, size_t line_number, const char *line,
                           const regmatch_t groups[WT_GROUPS])
{
    const wt_field *field = &s->d->fields[f];
    wt_text_value *value = &s->file->values[f];
    char place[32];
    const regmatch_t *found = &groups[field->group];
    const char *text = line + found->rm_so;
    const size_t length = (size_t)(found->rm_eo - found->rm_so);
    char *copy = strndup(text, length < 200 ? length : 200);
    if (copy == NULL)
        return no_memory(s);
    free(value->text);
    value->text = copy;
    value->line = line_number;
    value->unit[0] = '\0';
    if (field->unit_group > 0 && groups[field->unit_group].rm_so >= 0)
        snprintf(value->unit, sizeof value->unit, "%.*s",
                 (int)(groups[field->unit_group].rm_eo - groups[field->unit_group].rm_so),
                 line + groups[field->unit_group].rm_so);
    else if (field->unit != NULL)
        snprintf(value->unit, sizeof value->unit, "%s", field->unit);
    set_declared(s, field->sets, text, length);
    if (field->quantity == WT_Q_NONE)
        return WT_OK;
    double number, factor, offset;
    const char *unit = value->unit;
    for (size_t i = 0; i < s->d->n_aliases; i++)
        if (strcmp(s->d->aliases[i].found, unit) == 0)
            unit = s->d->aliases[i].means;
    snprintf(place, sizeof place, "line %zu", line_number);
    if (!wt_number_parse(text, length, '.', &number) &&
        !wt_number_parse(text, length, ',', &number)) {
        wt_parselog_add(s->log, WT_NOTE, s->file->name, place, "%s: \"%s\" is not a number",
                        field->name, value->text);
        return WT_OK;
    }
    if (wt_unit_to_si(unit, field->quantity, &factor, &offset, NULL) != WT_OK) {
        wt_parselog_add(s->log, WT_WARNING, s->file->name, place,
                        "%s: \"%s\" is not a unit of %s; the value is left out", field->name, unit,
                        wt_quantity_id(field->quantity));
        return WT_OK;
    }
    const wt_header_value h = wt_header_of(field->quantity);
    if (h < WT_HEADER_COUNT) {
        s->header.value[h] = factor * number + offset;
        s->header.fallback[h] = field->fallback;
    }
    return WT_OK;
}

static wt_status match_fields(scan *s, size_t line_number, const char *line, size_t length)
{
    wt_status status = WT_OK;
    for (size_t f = 0; f < s->d->n_fields && status == WT_OK; f++) {
        regmatch_t groups[WT_GROUPS];
        for (size_t g = 0; g < WT_GROUPS; g++)
            groups[g].rm_so = groups[g].rm_eo = -1;
        if (wt_pattern_match(&s->d->fields[f].pattern, line, length, groups, WT_GROUPS) &&
            groups[s->d->fields[f].group].rm_so >= 0)
            status = set_field(s, f, line_number, line, groups);
    }
    return status;
}

/* A step that never showed a names row is remembered by its title. */
static wt_status finish_step(scan *s)
{
    wt_text_file *file = s->file;
    if (s->step_line == 0 || s->step_has_table || file->n_steps >= STEPS_MAX)
        return WT_OK;
    if (file->steps == NULL)
        file->steps = calloc(STEPS_MAX, sizeof *file->steps);
    char *copy = file->steps != NULL ? strdup(s->title[0] != '\0' ? s->title : "(no title)") : NULL;
    if (copy == NULL)
        return no_memory(s);
    file->steps[file->n_steps++] = copy;
    return WT_OK;
}

static void close_table(scan *s)
{
    s->state = SCAN_HEADER;
}

/* Step, end and segment markers. *is says whether the line is one. */
static wt_status match_marks(scan *s, size_t line_number, const char *line, size_t length, bool *is)
{
    const wt_description *d = s->d;
    *is = false;
    for (size_t i = 0; i < d->n_steps; i++) {
        regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
        if (!wt_pattern_match(&d->steps[i].pattern, line, length, groups,
                              d->steps[i].title_next ? 0 : 2))
            continue;
        wt_status status = finish_step(s);
        close_table(s);
        s->step_line = line_number;
        s->step_has_table = false;
        s->title_next = d->steps[i].title_next;
        s->title[0] = '\0';
        if (groups[1].rm_so >= 0)
            snprintf(s->title, sizeof s->title, "%.*s", (int)(groups[1].rm_eo - groups[1].rm_so),
                     line + groups[1].rm_so);
        s->block++;
        *is = true;
        return status;
    }
    for (size_t i = 0; i < d->n_ends; i++)
        if (wt_pattern_match(&d->ends[i], line, length, NULL, 0)) {
            close_table(s);
            *is = true;
            return WT_OK;
        }
    for (size_t i = 0; i < d->n_markers; i++)
        if (wt_pattern_match(&d->markers[i].pattern, line, length, NULL, 0)) {
            s->kind = (unsigned char)d->markers[i].kind;
            *is = true;
            return WT_OK;
        }
    return WT_OK;
}

/* ---- beginning of a table ----------------------------------------------------------------- */

static wt_status new_table(scan *s, size_t line_number)
{
    wt_text_file *file = s->file;
    if (file->n_tables >= TABLES_MAX)
        return wt_fail(s->err, WT_E_RANGE, "more than %zu tables in one file", TABLES_MAX);
    if (file->n_tables == file->capacity) {
        size_t capacity = file->capacity > 0 ? 2 * file->capacity : 8;
        wt_text_table *grown = realloc(file->tables, capacity * sizeof *grown);
        if (grown == NULL)
            return no_memory(s);
        file->tables = grown;
        file->capacity = capacity;
    }
    s->table = &file->tables[file->n_tables];
    *s->table = (wt_text_table){.names_line = line_number,
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

/* Text without the comment mark in front. */
static void uncomment(const scan *s, const char **line, size_t *length)
{
    if (s->d->comment != NULL && starts_with(*line, *length, s->d->comment)) {
        size_t n = strlen(s->d->comment);
        *line += n;
        *length -= n;
    }
}

/* Could the row be units? Not if a known column holds a number. */
static bool units_row(scan *s, const wt_cells *cells)
{
    const wt_description *d = s->d;
    if (d->row_prefix != NULL && cells->n > 0 &&
        same_word(cells->cells[0].text, cells->cells[0].length, d->row_prefix))
        return false;
    for (size_t i = 0; i < cells->n && i < s->names.names.n; i++) {
        size_t first, n;
        wt_cell unit;
        double value;
        if (wt_names_known(d, s->names.names.cells[i], &first, &n, &unit) &&
            (wt_number_parse(cells->cells[i].text, cells->cells[i].length, '.', &value) ||
             wt_number_parse(cells->cells[i].text, cells->cells[i].length, ',', &value)))
            return false;
    }
    return true;
}

static bool names_have_units(const scan *s)
{
    for (size_t i = 0; i < s->names.names.n; i++) {
        size_t first, n;
        wt_cell unit;
        if (wt_names_known(s->d, s->names.names.cells[i], &first, &n, &unit) && unit.length > 0)
            return true;
    }
    return false;
}

/* Looks for the units row after the names row; *last is the last line that belongs to the two. */
static wt_status find_units(scan *s, size_t *last)
{
    const wt_lines *lines = &s->file->lines;
    if (s->d->units == WT_UNITS_NAME_OR_ROW && names_have_units(s))
        return WT_OK;
    for (size_t i = *last + 1; i < lines->n && i <= *last + 4; i++) {
        size_t length;
        const char *line = wt_lines_get(lines, i, &length);
        if (s->comment_names)
            uncomment(s, &line, &length);
        if (!wt_cells_split(&s->names.units, line, length, s->names.separator, s->d))
            return no_memory(s);
        if (wt_cells_blank(&s->names.units))
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

static wt_separator row_separator(const scan *s)
{
    if (s->separator != WT_SEPARATOR_AUTO)
        return s->separator;
    if (s->d->separator != WT_SEPARATOR_AUTO)
        return s->d->separator;
    return s->names.separator;
}

static wt_status choose_decimal(scan *s, size_t from, char *decimal)
{
    const wt_lines *lines = &s->file->lines;
    size_t commas = 0, points = 0;
    if (s->decimal != '\0' || s->d->decimal != '\0') {
        *decimal = s->decimal != '\0' ? s->decimal : s->d->decimal;
        return WT_OK;
    }
    *decimal = '.';
    if (s->table->separator == WT_SEPARATOR_COMMA)
        return WT_OK;
    for (size_t i = from; i < lines->n && i < from + 100 && commas + points < 64; i++) {
        size_t length;
        const char *line = wt_lines_get(lines, i, &length);
        if (!wt_cells_split(&s->row, line, length, s->table->separator, s->d))
            return no_memory(s);
        wt_cells_count_marks(&s->row, &commas, &points);
    }
    if (commas > points)
        *decimal = ',';
    return WT_OK;
}

/* Names and units are known: the rows begin after line `last` (counted from 0). */
static wt_status begin_rows(scan *s, size_t last)
{
    wt_status status = wt_names_resolve(&s->names, s->file, s->table, s->options, s->err);
    if (status != WT_OK)
        return status;
    s->table->separator = row_separator(s);
    s->state = SCAN_ROWS;
    return choose_decimal(s, last + 1, &s->table->decimal);
}

/* Is the line a names row? Then opens a table; *i moves to the last line of names and units. */
static wt_status match_names(scan *s, size_t *i, const char *line, size_t length, bool comment,
                             bool *is)
{
    const wt_description *d = s->d;
    wt_status status;
    wt_separator separator = d->names_separator;
    *is = false;
    if (d->has_names_line) {
        regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
        if (!wt_pattern_match(&d->names_line, line, length, groups, 2) || groups[1].rm_so < 0)
            return WT_OK;
        line += groups[1].rm_so;
        length = (size_t)(groups[1].rm_eo - groups[1].rm_so);
    } else if (comment) {
        uncomment(s, &line, &length);
    }
    if (separator == WT_SEPARATOR_AUTO)
        separator = s->separator;
    if (!wt_names_match(&s->names, d, line, length, separator, s->kinds))
        return WT_OK;
    *is = true;
    s->comment_names = comment && !d->has_names_line;
    status = new_table(s, *i + 1);
    if (status != WT_OK)
        return status;
    if (d->units == WT_UNITS_LINE) {
        s->state = SCAN_UNITS;
        return WT_OK;
    }
    if (d->units == WT_UNITS_ROW || d->units == WT_UNITS_NAME_OR_ROW)
        status = find_units(s, i);
    return status == WT_OK ? begin_rows(s, *i) : status;
}

/* ---- rows --------------------------------------------------------------------------------- */

static wt_status grow_rows(scan *s)
{
    wt_text_table *t = s->table;
    if (t->n_rows < t->capacity)
        return WT_OK;
    size_t capacity = t->capacity > 0 ? 2 * t->capacity : 64;
    const size_t width = t->n_columns > 0 ? t->n_columns : 1;
    if (capacity > SIZE_MAX / sizeof(double) / width)
        return no_memory(s);
    double *values = realloc(t->values, capacity * width * sizeof *values);
    if (values == NULL)
        return no_memory(s);
    t->values = values;
    size_t *blocks = realloc(t->blocks, capacity * sizeof *blocks);
    if (blocks == NULL)
        return no_memory(s);
    t->blocks = blocks;
    unsigned char *kinds = realloc(t->kinds, capacity);
    if (kinds == NULL)
        return no_memory(s);
    t->kinds = kinds;
    t->capacity = capacity;
    return WT_OK;
}

static size_t hash_cell(const wt_cells *cells, size_t i, size_t hash)
{
    if (i >= cells->n)
        return hash;
    for (size_t k = 0; k < cells->cells[i].length; k++)
        hash = (hash ^ (unsigned char)cells->cells[i].text[k]) * (size_t)1099511628211u;
    return hash * 31 + 7;
}

/* A new block where a group or curve cell changes. */
static void follow_groups(scan *s)
{
    const wt_text_table *t = s->table;
    size_t hash = (size_t)1469598103934665603u;
    if (t->group_cell == SIZE_MAX && t->curve_cell == SIZE_MAX)
        return;
    hash = hash_cell(&s->row, t->group_cell, hash);
    hash = hash_cell(&s->row, t->curve_cell, hash);
    s->block += s->has_group && hash != s->group_hash;
    s->group_hash = hash;
    s->has_group = true;
}

static unsigned char row_kind(const scan *s)
{
    const size_t i = s->table->segment_cell;
    if (i == SIZE_MAX || i >= s->row.n)
        return s->kind;
    const wt_cell cell = s->row.cells[i];
    for (size_t v = 0; v < s->d->n_values; v++)
        if (strlen(s->d->values[v].text) == cell.length &&
            memcmp(s->d->values[v].text, cell.text, cell.length) == 0)
            return (unsigned char)s->d->values[v].kind;
    return WT_SEGMENT_OTHER;
}

typedef enum row_is {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, one is not */
    ROW_TEXT    /* no number where numbers belong */
} row_is;

/* Reads the cells of s->row into the next row of the table; *bad is the first cell at fault. */
static row_is read_row(scan *s, size_t *bad)
{
    wt_text_table *t = s->table;
    double *values = t->values + t->n_rows * t->n_columns;
    size_t numbers = 0, texts = 0;
    for (size_t c = 0; c < t->n_columns; c++) {
        const wt_text_column *column = &t->columns[c];
        double value;
        values[c] = NAN;
        if (column->cell >= s->row.n)
            continue;
        switch (wt_cell_read(s->row.cells[column->cell], t->decimal, s->d, &value)) {
        case WT_CELL_NUMBER:
            values[c] = column->factor * value + column->offset;
            numbers++;
            break;
        case WT_CELL_MISSING:
            break;
        case WT_CELL_TEXT:
            if (texts++ == 0)
                *bad = c;
            break;
        }
    }
    if (texts > 0)
        return numbers > 0 ? ROW_BROKEN : ROW_TEXT;
    return numbers > 0 || s->row.n >= t->n_names ? ROW_GOOD : ROW_TEXT;
}

static wt_status bad_row(scan *s, size_t line_number, size_t bad)
{
    char found[64];
    const wt_text_table *t = s->table;
    wt_fail(s->err, WT_E_CORRUPT, "a cell of the table is not a number");
    if (bad < t->n_columns && t->columns[bad].cell < s->row.n) {
        const wt_text_column *column = &t->columns[bad];
        const wt_cell cell = s->row.cells[column->cell];
        wt_error_place(s->err, "line %zu, column %zu (%s)", line_number, column->cell + 1,
                       column->name);
        wt_error_found(s->err, "\"%s\"", cut(found, cell.text, cell.length));
    } else {
        wt_error_place(s->err, "line %zu", line_number);
        wt_error_found(s->err, "a line of %zu cells", s->row.n);
    }
    wt_error_expected(s->err, "numbers with decimal %s, separated by %s",
                      t->decimal == ',' ? "comma" : "point", wt_separator_name(t->separator));
    return WT_E_CORRUPT;
}

static wt_status add_row(scan *s, size_t line_number)
{
    wt_text_table *t = s->table;
    size_t last = 0;
    for (size_t c = 0; c < t->n_columns; c++)
        last = t->columns[c].cell > last ? t->columns[c].cell : last;
    if (s->row.n <= last) {
        char place[32];
        snprintf(place, sizeof place, "line %zu", line_number);
        wt_parselog_add(s->log, WT_NOTE, s->file->name, place,
                        "row with fewer cells than columns; the missing ones are empty");
    }
    follow_groups(s);
    if (!s->snapshot) {
        t->header = s->header;
        s->snapshot = true;
    }
    t->blocks[t->n_rows] = s->block;
    t->kinds[t->n_rows] = row_kind(s);
    t->n_rows++;
    s->blank = false;
    return WT_OK;
}

/* ---- the walk ----------------------------------------------------------------------------- */

static wt_status header_line(scan *s, size_t *i, const char *line, size_t length, bool comment)
{
    bool is = false;
    if (s->title_next && !comment) {
        snprintf(s->title, sizeof s->title, "%.*s", (int)(length < 95 ? length : 95), line);
        s->title_next = false;
        return WT_OK;
    }
    wt_status status = match_marks(s, *i + 1, line, length, &is);
    if (status == WT_OK)
        status = match_fields(s, *i + 1, line, length);
    if (status == WT_OK && !is)
        status = match_names(s, i, line, length, comment, &is);
    return status;
}

/* Rows that come back after the table seemed to end would be lost without a word. */
static wt_status watch_orphan(scan *s, size_t line_number, const char *line, size_t length)
{
    size_t bad = 0;
    wt_text_table *t = s->table;
    if (t == NULL || t->n_columns == 0 || t->n_rows == 0 || s->d->row_prefix != NULL ||
        s->step_line != t->step_line)
        return WT_OK;
    wt_status status = grow_rows(s);
    if (status != WT_OK)
        return status;
    if (!wt_cells_split(&s->row, line, length, t->separator, s->d))
        return no_memory(s);
    if (s->row.n < t->n_names || read_row(s, &bad) != ROW_GOOD)
        return WT_OK;
    char place[32];
    snprintf(place, sizeof place, "line %zu", line_number);
    wt_parselog_add(s->log, WT_WARNING, s->file->name, place,
                    "row of numbers after the end of its table, not read");
    return WT_OK;
}

static wt_status table_line(scan *s, size_t *i, const char *line, size_t length)
{
    const wt_description *d = s->d;
    wt_text_table *t = s->table;
    bool is = false;
    size_t bad = SIZE_MAX;
    if (!wt_cells_split(&s->row, line, length, t->separator, d))
        return no_memory(s);
    if (wt_cells_blank(&s->row)) {
        s->block += d->blank_is_block && t->n_rows > 0 && !s->blank;
        s->blank = true;
        return WT_OK;
    }
    if (d->row_prefix != NULL &&
        !same_word(s->row.cells[0].text, s->row.cells[0].length, d->row_prefix))
        return header_line(s, i, line, length, false);
    wt_status status = d->row_prefix == NULL ? match_marks(s, *i + 1, line, length, &is) : WT_OK;
    if (status != WT_OK)
        return status;
    if (is)
        return match_fields(s, *i + 1, line, length);
    status = grow_rows(s);
    if (status != WT_OK)
        return status;
    row_is row = read_row(s, &bad);
    if (row == ROW_GOOD)
        return add_row(s, *i + 1);
    status = match_names(s, i, line, length, false, &is);
    if (status != WT_OK || is)
        return status;
    if (!s->blank || (row == ROW_BROKEN && s->row.n == t->n_names) || d->row_prefix != NULL)
        return bad_row(s, *i + 1, bad);
    close_table(s);
    return header_line(s, i, line, length, false);
}

static wt_status units_line(scan *s, size_t *i, const char *line, size_t length, bool comment)
{
    regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
    if (wt_pattern_match(&s->d->units_line, line, length, groups, 2) && groups[1].rm_so >= 0) {
        if (!wt_cells_split(&s->names.units, line + groups[1].rm_so,
                            (size_t)(groups[1].rm_eo - groups[1].rm_so), s->names.separator, s->d))
            return no_memory(s);
        return begin_rows(s, *i);
    }
    if (comment)
        return header_line(s, i, line, length, true);
    if (length == 0)
        return WT_OK;
    wt_status status = begin_rows(s, *i);
    return status == WT_OK ? table_line(s, i, line, length) : status;
}

static wt_status walk(scan *s)
{
    const wt_lines *lines = &s->file->lines;
    wt_status status = WT_OK;
    for (size_t i = 0; i < lines->n && status == WT_OK; i++) {
        size_t length;
        const char *line = wt_lines_get(lines, i, &length);
        bool comment = s->d->comment != NULL && starts_with(line, length, s->d->comment);
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
    return status == WT_OK ? finish_step(s) : status;
}

static void free_table(wt_text_table *t)
{
    free(t->columns);
    free(t->problems);
    free(t->values);
    free(t->blocks);
    free(t->kinds);
}

/* Tables without a row carry nothing. */
static void drop_empty_tables(wt_text_file *file)
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

static void log_text(const wt_text_file *file, wt_parselog *log)
{
    const wt_lines *lines = &file->lines;
    char names[256] = "";
    size_t used = 0;
    if (lines->odd_byte)
        wt_parselog_add(log, WT_NOTE, file->name, NULL,
                        "half a character at the end of the file was dropped");
    if (lines->n_replaced > 0)
        wt_parselog_add(log, WT_WARNING, file->name, NULL,
                        "%zu byte sequences are no characters of %s", lines->n_replaced,
                        lines->encoding);
    for (size_t i = 0; i < file->n_unknown; i++) {
        int n = snprintf(names + used, sizeof names - used, "%s%s", i > 0 ? ", " : "",
                         file->unknown[i]);
        if (n < 0 || used + (size_t)n >= sizeof names - 4) {
            memcpy(names + used, "...", 4);
            break;
        }
        used += (size_t)n;
    }
    if (file->n_unknown > 0)
        wt_parselog_add(log, WT_NOTE, file->name, NULL, "columns not used: %s", names);
}

wt_status wt_text_scan(const wt_description *description, wt_input *input, unsigned kinds,
                       const wt_read_options *options, wt_parselog *log, wt_text_file *file,
                       wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_text_file made = {.description = description, .name = wt_input_name(input)};
    scan s = {.file = &made,
              .d = description,
              .options = options,
              .log = log,
              .err = err,
              .kinds = kinds & description->kinds,
              .kind = WT_ROW_KIND_NONE};
    for (size_t i = 0; i < WT_HEADER_COUNT; i++)
        s.header.value[i] = NAN;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = wt_lines_decode(bytes, length, description->encoding, &made.lines, err);
    if (status == WT_OK) {
        made.values = calloc(description->n_fields + 1, sizeof *made.values);
        status = made.values != NULL ? walk(&s) : no_memory(&s);
    }
    wt_names_free(&s.names);
    free(s.row.cells);
    if (status != WT_OK) {
        wt_error_file(err, made.name);
        wt_text_file_free(&made);
        return status;
    }
    drop_empty_tables(&made);
    log_text(&made, log);
    *file = made;
    return WT_OK;
}

void wt_text_file_free(wt_text_file *file)
{
    for (size_t i = 0; i < file->n_tables; i++)
        free_table(&file->tables[i]);
    for (size_t i = 0; file->values != NULL && i < file->description->n_fields; i++)
        free(file->values[i].text);
    for (size_t i = 0; i < file->n_unknown; i++)
        free(file->unknown[i]);
    for (size_t i = 0; i < file->n_steps; i++)
        free(file->steps[i]);
    free(file->tables);
    free(file->values);
    free(file->unknown);
    free(file->steps);
    wt_lines_free(&file->lines);
    *file = (wt_text_file){0};
}
