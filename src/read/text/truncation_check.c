/* Detects truncated files: a last line without a line end, an incomplete last row, or a table
 * without its end line.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_scanner.h"

#include "core/base/number.h"

#include <math.h>

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

void truncation_track_row(text_scanner *s)
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
