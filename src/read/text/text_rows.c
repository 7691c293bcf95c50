/* Reads the rows of a table: numbers, blocks and segment kinds. Detects truncated files: a last
 * line without a line end, an incomplete last row, or a table without its end line.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "read/text/text_scanner.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- truncated files ------------------------------------------------------------------------- */

/* The format of a cell. */
typedef struct cell_form {
    bool number, point, exponent;
    size_t length, digits, exponent_digits;
    size_t tail; /* characters from the decimal point on */
} cell_form;

static cell_form parse_cell_form(text_span cell, char decimal)
{
    cell_form form = {.length = cell.length};
    form.number =
        cell.length > 0 && number_prefix_length(cell.text, cell.length, decimal) == cell.length;
    for (size_t i = 0; form.number && i < cell.length; i++) {
        const char c = cell.text[i];
        if (c >= '0' && c <= '9')
            ++*(form.exponent ? &form.exponent_digits : &form.digits);
        form.point = form.point || c == decimal;
        form.tail += form.point;
        form.exponent = form.exponent || c == 'e' || c == 'E';
    }
    return form;
}

static size_t min_size(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* True if the row has no cell for a column that is read. */
static bool has_missing_cells(const text_scanner *s)
{
    const text_table *const t = s->table;
    size_t last = 0;
    for (size_t c = 0; c < t->n_columns; c++)
        last = t->columns[c].cell > last ? t->columns[c].cell : last;
    return s->row.n <= last;
}

static void truncation_track_row(text_scanner *s)
{
    last_cell_stats *const l = &s->last;
    const bool is_short = has_missing_cells(s);
    const text_span cell = s->row.n > 0 ? s->row.cells[s->row.n - 1] : (text_span){"", 0};
    const cell_form form = parse_cell_form(cell, s->table->decimal);
    s->last_is_short = is_short && l->short_rows == 0 && s->table->n_rows > 0;
    l->short_rows += is_short;
    if (is_short)
        wt_log_add(s->log, WT_NOTE, s->file->name, format_line_position(s->i + 1).text,
                   "row with fewer cells than columns; the missing ones are empty");
    l->cells_min = s->table->n_rows == 0 ? s->row.n : min_size(l->cells_min, s->row.n);
    l->empty = l->empty || cell.length == 0;
    if (cell.length == 0)
        return;
    const bool first = l->n++ == 0;
    l->shortest = first ? form.length : min_size(l->shortest, form.length);
    l->longest = form.length > l->longest ? form.length : l->longest;
    l->digits_min = first ? form.digits : min_size(l->digits_min, form.digits);
    if (form.exponent)
        l->exponent_min =
            l->exponents ? min_size(l->exponent_min, form.exponent_digits) : form.exponent_digits;
    l->tail_min = first ? form.tail : min_size(l->tail_min, form.tail);
    l->tail_max = form.tail > l->tail_max ? form.tail : l->tail_max;
    l->points = l->points || form.point;
    l->exponents = l->exponents || form.exponent;
}

/* A truncated number is shorter than the others, or lacks its decimal point or exponent. A number
 * without a point may have lost a digit if the lengths vary, and is not accepted. With a point only
 * decimals may be lost. */
bool truncation_row_is_complete(const text_scanner *s)
{
    const last_cell_stats *const l = &s->last;
    if (s->table->n_rows == 0)
        return !has_missing_cells(s);
    if (s->row.n < l->cells_min || s->row.n == 0)
        return false;
    const text_span cell = s->row.cells[s->row.n - 1];
    const cell_form form = parse_cell_form(cell, s->table->decimal);
    if (cell.length == 0 || l->n == 0)
        return l->empty;
    if (form.length < l->shortest)
        return false;
    if (!form.number)
        return true;
    if (!form.point && (l->points || l->shortest != l->longest || form.length != l->longest))
        return false;
    return form.digits >= l->digits_min &&
           (!l->exponents || (form.exponent && form.exponent_digits >= l->exponent_min));
}

/* True if the last number has lost no digit: all last numbers of the rows have the same decimals,
 * or the same length without decimals. */
static bool last_number_is_whole(const last_cell_stats *l)
{
    return l->n > 1 && !l->empty && l->tail_min == l->tail_max &&
           (l->points || l->shortest == l->longest);
}

/* True if the header shows that no row is missing: by the number of rows, or by the area of an
 * image, whose pixels are then square. */
static bool has_all_rows(const text_scanner *s)
{
    const double *const stated = s->header.value;
    if (s->n_declared > 0)
        return s->n_rows == s->n_declared;
    return s->d->matrix && s->table != NULL &&
           fabs(stated[HEADER_HEIGHT] / stated[HEADER_WIDTH] * (double)s->table->n_columns -
                (double)s->table->n_rows) < 0.5;
}

void truncation_check_table_end(text_scanner *s)
{
    if (s->unclosed)
        wt_log_add(s->log, WT_WARNING, s->file->name, format_line_position(s->i).text,
                   "the line that ends a table is not there: the file was cut off, and rows "
                   "are missing");
    s->unclosed = false;
}

void truncation_report(text_scanner *s)
{
    const line_position_text place = format_line_position(s->i);
    const line_end end = s->i > 0 ? feed_line_end(s->file->feed, s->i - 1) : END_WHOLE;
    if (end == END_HALF) {
        wt_log_add(s->log, WT_WARNING, s->file->name, place.text,
                   "the last line has half a line end: the file was cut off there, and what "
                   "follows is missing");
    } else if (end == END_NONE) {
        if (s->last_row == LAST_ROW_KEPT && last_number_is_whole(&s->last) && has_all_rows(s))
            wt_log_add(s->log, WT_NOTE, s->file->name, place.text,
                       "the last line has no line end; its row is complete");
        else if (s->last_row == LAST_ROW_DROPPED)
            wt_log_add(s->log, WT_WARNING, s->file->name, place.text,
                       "the last line has no line end and is no whole row: the file was cut "
                       "off; the row is left out, and rows may be missing behind it");
        else
            wt_log_add(s->log, WT_WARNING, s->file->name, place.text,
                       "the last line has no line end: if the file was cut off there, %s "
                       "missing; if it is whole, a line end put behind it says so",
                       s->last_row == LAST_ROW_KEPT ? "rows, or digits of its last number, are"
                                                    : "what follows is");
    } else if (s->last_is_short) {
        s->table->n_rows--;
        s->n_rows -= s->n_rows > 0;
        wt_log_add(s->log, WT_WARNING, s->file->name, place.text,
                   "the last row has fewer cells than all others: the file was cut off; the "
                   "row is left out, and rows may be missing behind it");
    }
    truncation_check_table_end(s);
}

/* ---- rows ---------------------------------------------------------------------------------- */

void scan_split_row(text_scanner *s)
{
    text_table *const t = s->table;
    const size_t width = t->n_columns > 0 ? t->n_columns : 1;
    cells_split(&s->row, s->line, t->separator, s->d);
    t->values = array_grow(t->values, t->n_rows, width * sizeof *t->values);
    t->blocks = array_grow(t->blocks, t->n_rows, sizeof *t->blocks);
    t->kinds = array_grow(t->kinds, t->n_rows, sizeof *t->kinds);
    t->row_lines = array_grow(t->row_lines, t->n_rows, sizeof *t->row_lines);
    t->samples = array_grow(t->samples, t->n_rows, sizeof *t->samples);
}

static size_t hash_cell(const text_cells *cells, size_t i, size_t hash)
{
    if (i >= cells->n)
        return hash;
    for (size_t k = 0; k < cells->cells[i].length; k++)
        hash = (hash ^ (unsigned char)cells->cells[i].text[k]) * (size_t)1099511628211u;
    return hash * 31 + 7;
}

/* Begins a new block where a group or curve cell changes. */
static void update_block(text_scanner *s)
{
    const text_table *t = s->table;
    size_t hash = (size_t)1469598103934665603u;
    if (t->group_cell == SIZE_MAX && t->curve_cell == SIZE_MAX)
        return;
    hash = hash_cell(&s->row, t->group_cell, hash);
    hash = hash_cell(&s->row, t->curve_cell, hash);
    s->block += s->has_group && hash != s->group_hash;
    s->group_hash = hash;
    s->has_group = true;
}

size_t scan_find_sample(text_scanner *s, text_span name)
{
    text_list *const list = &s->file->samples;
    char text[COLUMN_NAME_SIZE];
    while (name.length > 0 && strchr(" \t\r", name.text[name.length - 1]) != NULL)
        name.length--;
    text_copy(text, sizeof text, name);
    if (text[0] == '\0')
        return NO_SAMPLE;
    for (size_t i = list->n; i-- > 0;)
        if (strcmp(list->items[i], text) == 0)
            return i;
    if (list->n >= SAMPLES_MAX) /* then the column counts rows */
        return NO_SAMPLE;
    text_list_add(s->file, list, SAMPLES_MAX, (text_span){text, strlen(text)});
    return list->n - 1;
}

/* Returns the sample of the row. The sample of the previous row is tested first. */
static size_t find_row_sample(text_scanner *s)
{
    const text_table *t = s->table;
    const size_t i = t->sample_cell;
    if (i >= s->row.n || s->row.cells[i].length == 0)
        return s->sample;
    const size_t last = t->n_rows > 0 ? t->samples[t->n_rows - 1] : NO_SAMPLE;
    if (last != NO_SAMPLE && cell_equals(s->row.cells[i], s->file->samples.items[last]))
        return last;
    return scan_find_sample(s, s->row.cells[i]);
}

/* True if a cell has one of the marks that the instrument sets on rows outside of its limits. */
static bool has_flag(const text_scanner *s)
{
    static const char separators[] = ",; ";
    const size_t i = s->table->flag_cell;
    const text_span cell = i < s->row.n ? s->row.cells[i] : (text_span){"", 0};
    for (size_t at = 0, end; at < cell.length; at = end + 1) {
        char mark[COLUMN_NAME_SIZE];
        for (end = at; end < cell.length && strchr(separators, cell.text[end]) == NULL;)
            end++;
        name_normalise((text_span){cell.text + at, end - at}, mark);
        for (size_t k = 0; k < s->d->n_flags; k++)
            if (strcmp(mark, s->d->flags[k]) == 0)
                return true;
    }
    return false;
}

static unsigned char row_segment_kind(const text_scanner *s)
{
    if (has_flag(s))
        return ROW_KIND_FLAGGED;
    const size_t i = s->table->segment_cell;
    if (i == SIZE_MAX || i >= s->row.n)
        return s->kind;
    const text_span cell = s->row.cells[i];
    for (size_t v = 0; v < s->d->n_values; v++)
        if (cell_equals(cell, s->d->values[v].text))
            return (unsigned char)s->d->values[v].kind;
    return WT_SEGMENT_OTHER;
}

static void warn_ignored_cell(text_scanner *s, const text_column *column)
{
    char found[16];
    text_copy(found, sizeof found, s->row.cells[column->cell]);
    wt_log_action(s->log, WT_WARNING, WT_LEFT_OUT, 1, "--columns", s->file->name,
                  format_line_position(s->i + 1).text,
                  "\"%s\" in column %zu (%s) is no value and is left out", found, column->cell + 1,
                  column->name);
}

/* Counts the cells whose decimal mark may separate thousands, until one shows that it does not. */
static void track_decimal_mark(text_table *t, text_span cell)
{
    bool has_mark;
    if (t->has_decimals)
        return;
    const bool is_grouped = cell_is_grouped(cell, t->decimal, &has_mark);
    if (is_grouped && t->n_grouped++ == 0)
        text_copy(t->grouped, sizeof t->grouped, cell);
    t->has_decimals = has_mark && !is_grouped;
}

/* Continues clock times after midnight, where they fall by a day but for the time since the row
 * before, one hour at most. Another fall stays, as that of a clock that begins again. */
static double continue_clock(text_scanner *s, text_column *column, double seconds)
{
    static const double day = 86400, pause_max = 3600;
    if (column->clock < day && column->clock - seconds > day - pause_max &&
        s->options->conditioning != WT_CONDITIONING_KEEP) {
        column->days++;
        wt_log_action(
            s->log, WT_WARNING, WT_CORRECTED, 1, WT_KEEP_OPTION, s->file->name,
            format_line_position(s->i + 1).text,
            "the clock of column \"%s\" passes midnight: the times from here on are those "
            "of the next day",
            column->name);
    }
    column->clock = seconds;
    return seconds + day * (double)column->days;
}

row_quality scan_read_row(text_scanner *s, size_t *bad)
{
    text_table *t = s->table;
    double *values = t->values + t->n_rows * t->n_columns;
    size_t numbers = 0, texts = 0;
    for (size_t c = 0; c < t->n_columns; c++) {
        text_column *const column = &t->columns[c];
        double value;
        values[c] = (double)NAN;
        if (column->cell >= s->row.n)
            continue;
        cell_kind kind = cell_parse(s->row.cells[column->cell], t->decimal, s->d, &value);
        if (kind == CELL_CLOCK && column->rule->quantity != WT_Q_TIME)
            kind = CELL_TEXT;
        switch (kind) {
        case CELL_CLOCK:
            values[c] = continue_clock(s, column, value);
            numbers++;
            break;
        case CELL_NUMBER:
            values[c] = column->factor * value + column->offset;
            numbers++;
            track_decimal_mark(t, s->row.cells[column->cell]);
            if (!isfinite(values[c])) { /* overflow in SI units */
                values[c] = (double)NAN;
                warn_ignored_cell(s, column);
            }
            break;
        case CELL_MISSING:
            break;
        case CELL_NOT_FINITE:
            warn_ignored_cell(s, column);
            break;
        case CELL_TEXT:
            if (texts++ == 0)
                *bad = c;
            break;
        }
    }
    if (texts > 0)
        return numbers > 0 ? ROW_BROKEN : ROW_TEXT;
    if (numbers == 0 && t->has_qualifiers)
        return ROW_UNUSED;
    return numbers > 0 || s->row.n >= t->n_names ? ROW_GOOD : ROW_TEXT;
}

void scan_fail_row(text_scanner *s, size_t bad)
{
    char found[64];
    const text_table *t = s->table;
    s->status = wt_fail(s->err, WT_E_CORRUPT, "a cell of the table is not a number");
    if (bad < t->n_columns && t->columns[bad].cell < s->row.n) {
        const text_column *column = &t->columns[bad];
        wt_error_place(s->err, "line %zu, column %zu (%s)", s->i + 1, column->cell + 1,
                       column->name);
        text_copy(found, sizeof found, s->row.cells[column->cell]);
        wt_error_found(s->err, "\"%s\"", found);
    } else {
        wt_error_place(s->err, "line %zu", s->i + 1);
        wt_error_found(s->err, "a line of %zu cells", s->row.n);
    }
    wt_error_expected(s->err, "numbers with decimal %s, separated by %s",
                      t->decimal == ',' ? "comma" : "point", separator_name(t->separator));
}

/* Warns of a gap in the row numbers; a restart is allowed. The message is constant, so that the log
 * merges repetitions. */
static void check_row_number(text_scanner *s)
{
    const text_table *const t = s->table;
    double number = (double)NAN;
    if (t->number_cell < s->row.n)
        (void)cell_parse(s->row.cells[t->number_cell], t->decimal, s->d, &number);
    if (number > s->last_number + 1)
        wt_log_add(s->log, WT_WARNING, s->file->name, format_line_position(s->i + 1).text,
                   "the number of a row is not the next one: are rows missing before it?");
    s->last_number = number;
}

void scan_add_row(text_scanner *s)
{
    text_table *t = s->table;
    s->row_line = s->i + 1;
    truncation_track_row(s);
    check_row_number(s);
    update_block(s);
    if (!s->snapshot) {
        t->header = s->header;
        s->snapshot = true;
    }
    t->blocks[t->n_rows] = s->block;
    t->kinds[t->n_rows] = row_segment_kind(s);
    t->row_lines[t->n_rows] = s->i + 1;
    t->samples[t->n_rows] = find_row_sample(s);
    t->n_rows++;
    s->n_rows++;
    s->blank = false;
}
