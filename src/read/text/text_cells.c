/* Splits a line into cells and parses a cell. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Instruments write 1e99 or more for "no value"; real quantities are far smaller. */
static const double no_value = 1e99;

const char *separator_name(cell_separator separator)
{
    static const char *const names[] = {"auto",  "tab",        "semicolon",
                                        "comma", "whitespace", "fixed columns"};
    return names[separator];
}

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0';
}

/* Returns the length of the blank at the beginning or the end of a cell, 0 without one. A
 * spreadsheet also pads with no-break spaces. */
static size_t outer_blank_length(text_span cell, bool at_end)
{
    static const char *const no_break[] = {"\xc2\xa0", "\xe2\x80\xaf"};
    if (cell.length > 0 && is_blank(cell.text[at_end ? cell.length - 1 : 0]))
        return 1;
    for (size_t i = 0; i < COUNT_OF(no_break); i++) {
        const size_t n = strlen(no_break[i]);
        if (cell.length >= n &&
            memcmp(cell.text + (at_end ? cell.length - n : 0), no_break[i], n) == 0)
            return n;
    }
    return 0;
}

static void trim_cell(text_span *cell)
{
    size_t n;
    while ((n = outer_blank_length(*cell, false)) > 0) {
        cell->text += n;
        cell->length -= n;
    }
    while ((n = outer_blank_length(*cell, true)) > 0)
        cell->length -= n;
}

/* Provides space for the unquoted cells of a line, which never exceed it. It must not move while
 * cells point into it. */
static void reserve_unquoted(text_cells *cells, text_span line)
{
    if (memmem(line.text, line.length, "\"\"", 2) == NULL || cells->unquoted_size >= line.length)
        return;
    cells->unquoted = wt_realloc(cells->unquoted, line.length, 1);
    cells->unquoted_size = line.length;
}

/* Undoes the doubled quotes in a quoted cell: "it's ""x""" is it's "x". `at` is the position of the
 * cell in the line, which is also free in the unquoted text. */
static void undouble_quotes(text_cells *cells, text_span *cell, size_t at)
{
    size_t n = 0;
    if (cell->length < 2 || memmem(cell->text, cell->length, "\"\"", 2) == NULL)
        return;
    char *const to = cells->unquoted + at;
    for (size_t i = 0; i < cell->length; i++) {
        to[n++] = cell->text[i];
        i += cell->text[i] == '"' && i + 1 < cell->length && cell->text[i + 1] == '"';
    }
    *cell = (text_span){to, n};
}

static void append_cell(text_cells *cells, const char *text, size_t length)
{
    if (cells->n == cells->capacity) {
        cells->capacity = cells->capacity > 0 ? 2 * cells->capacity : 32;
        cells->cells = wt_realloc(cells->cells, cells->capacity, sizeof *cells->cells);
    }
    text_span cell = {text, length};
    trim_cell(&cell);
    if (cell.length >= 2 && cell.text[0] == '"' && cell.text[cell.length - 1] == '"') {
        cell.text++;
        cell.length -= 2;
        trim_cell(&cell);
    }
    cells->cells[cells->n++] = cell;
}

/* Returns the position of the quote that closes a quoted cell, or `length`. A doubled quote is part
 * of the text. */
static size_t find_closing_quote(const char *line, size_t from, size_t length)
{
    for (size_t i = from; i < length; i++) {
        if (line[i] != '"')
            continue;
        if (i + 1 == length || line[i + 1] != '"')
            return i;
        i++;
    }
    return length;
}

/* Returns the end of the cell at `from`. A separator inside quotes is ignored. A single quotation
 * mark (E" is the loss modulus) is an ordinary character. */
static size_t find_cell_end(const char *line, size_t from, size_t length, char mark, bool *quoted)
{
    size_t i = from;
    *quoted = false;
    while (i < length && line[i] == ' ')
        i++;
    if (i < length && line[i] == '"') {
        size_t after = find_closing_quote(line, i + 1, length) + 1;
        while (after < length && line[after] == ' ')
            after++;
        *quoted = after <= length && (after == length || line[after] == mark);
        if (*quoted)
            return after;
    }
    const char *end = memchr(line + from, mark, length - from);
    return end != NULL ? (size_t)(end - line) : length;
}

static void split_separated(text_cells *cells, const char *line, size_t length, char mark)
{
    reserve_unquoted(cells, (text_span){line, length});
    for (size_t from = 0;;) {
        bool quoted;
        size_t end = find_cell_end(line, from, length, mark, &quoted);
        append_cell(cells, line + from, end - from);
        if (quoted)
            undouble_quotes(cells, &cells->cells[cells->n - 1], from);
        if (end >= length)
            return;
        from = end + 1;
    }
}

/* Returns the end of a quoted cell at `from`, if a blank or the line end follows; 0 otherwise. */
static size_t find_quoted_end(const char *line, size_t from, size_t length)
{
    const char mark = line[from];
    if (mark != '\'' && mark != '"')
        return 0;
    const char *close = memchr(line + from + 1, mark, length - from - 1);
    const size_t end = close != NULL ? (size_t)(close - line) + 1 : 0;
    return end > from + 2 && (end == length || is_blank(line[end])) ? end : 0;
}

static void split_whitespace(text_cells *cells, const char *line, size_t length)
{
    for (size_t i = 0; i < length;) {
        while (i < length && is_blank(line[i]))
            i++;
        size_t from = i;
        const size_t quoted = i < length ? find_quoted_end(line, i, length) : 0;
        if (quoted > 0) {
            append_cell(cells, line + from + 1, quoted - from - 2);
            i = quoted;
            continue;
        }
        while (i < length && !is_blank(line[i]))
            i++;
        if (i > from)
            append_cell(cells, line + from, i - from);
    }
}

/* Widths count characters, not bytes. */
static void split_fixed(text_cells *cells, const char *line, size_t length,
                        const text_description *d)
{
    size_t column = 0;
    for (size_t i = 0; i < length;) {
        size_t from = i;
        size_t width = d->widths[column < d->n_widths ? column : d->n_widths - 1];
        for (size_t c = 0; c < width && i < length; c++) {
            i++;
            while (i < length && ((unsigned char)line[i] & 0xc0u) == 0x80u)
                i++;
        }
        append_cell(cells, line + from, i - from);
        column++;
    }
}

void cells_split(text_cells *cells, text_span line, cell_separator separator,
                 const text_description *description)
{
    static const char marks[] = {
        [SEPARATOR_TAB] = '\t', [SEPARATOR_SEMICOLON] = ';', [SEPARATOR_COMMA] = ','};
    cells->n = 0;
    if (separator == SEPARATOR_FIXED)
        split_fixed(cells, line.text, line.length, description);
    else if (separator < COUNT_OF(marks) && marks[separator] != '\0')
        split_separated(cells, line.text, line.length, marks[separator]);
    else
        split_whitespace(cells, line.text, line.length);
}

void cells_free(text_cells *cells)
{
    free(cells->cells);
    free(cells->unquoted);
    *cells = (text_cells){0};
}

bool cells_are_blank(const text_cells *cells)
{
    for (size_t i = 0; i < cells->n; i++)
        if (cells->cells[i].length > 0)
            return false;
    return true;
}

bool cell_equals(text_span cell, const char *text)
{
    return strlen(text) == cell.length && memcmp(text, cell.text, cell.length) == 0;
}

static bool is_listed_text(text_span cell, const char *const words[], size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strlen(words[i]) == cell.length && strncasecmp(words[i], cell.text, cell.length) == 0)
            return true;
    return false;
}

static bool is_declared_missing(text_span cell, const text_description *d)
{
    for (size_t i = 0; i < d->n_missing; i++)
        if (cell_equals(cell, d->missing[i]))
            return true;
    return false;
}

/* Parses a time such as 1:05:30.5, hours, minutes and seconds, to seconds. */
static bool parse_clock_time(text_span cell, char decimal, double *seconds)
{
    double parts[3];
    const char *at = cell.text, *const end = at + cell.length;
    for (size_t i = 0; i < COUNT_OF(parts); i++) {
        const char *const colon = i < 2 ? memchr(at, ':', (size_t)(end - at)) : end;
        if (colon == NULL || colon == at || *at < '0' || *at > '9' ||
            !wt_number_parse(at, (size_t)(colon - at), i < 2 ? '.' : decimal, &parts[i]) ||
            (i < 2 && floor(parts[i]) != parts[i]) || (i > 0 && parts[i] >= 60))
            return false;
        at = colon + (i < 2);
    }
    *seconds = 3600 * parts[0] + 60 * parts[1] + parts[2];
    return *seconds < no_value;
}

cell_kind cell_parse(text_span cell, char decimal, const text_description *description,
                     double *value)
{
    *value = (double)NAN;
    if (cell.length > 0 && wt_number_parse(cell.text, cell.length, decimal, value)) {
        if (!(fabs(*value) < no_value))
            *value = (double)NAN;
        else if (!is_declared_missing(cell, description))
            return CELL_NUMBER;
        *value = (double)NAN;
        return CELL_MISSING;
    }
    if (cell.length > 0 && parse_clock_time(cell, decimal, value))
        return CELL_CLOCK;
    static const char *const none[] = {"-",
                                       "--",
                                       "---",
                                       "n/a",
                                       "na",
                                       "#n/a",
                                       "bad", /* a point that the instrument did not measure */
                                       "\xe2\x88\x92", /* minus sign, en dash and em dash */
                                       "\xe2\x80\x93",
                                       "\xe2\x80\x94"};
    static const char *const not_finite[] = {"nan",  "inf",     "-inf",   "+inf",
                                             "-nan", "1.#qnan", "1.#inf", "-1.#ind"};
    if (cell.length == 0 || is_listed_text(cell, none, COUNT_OF(none)) ||
        is_declared_missing(cell, description))
        return CELL_MISSING;
    return is_listed_text(cell, not_finite, COUNT_OF(not_finite)) ? CELL_NOT_FINITE : CELL_TEXT;
}

void text_copy(char *to, size_t size, text_span text)
{
    const size_t n = utf8_truncated_length(text.text, text.length, size - 1);
    memcpy(to, text.text, n);
    to[n] = '\0';
    utf8_sanitize(to);
}

void cells_count_decimal_marks(const text_cells *cells, size_t *commas, size_t *points)
{
    for (size_t i = 0; i < cells->n; i++) {
        const text_span cell = cells->cells[i];
        const char *comma = memchr(cell.text, ',', cell.length);
        const char *point = memchr(cell.text, '.', cell.length);
        if (comma != NULL && point == NULL)
            *commas += number_prefix_length(cell.text, cell.length, ',') == cell.length;
        else if (point != NULL && comma == NULL)
            *points += number_prefix_length(cell.text, cell.length, '.') == cell.length;
    }
}

bool cell_is_grouped(text_span cell, char decimal, bool *has_mark)
{
    const char *const mark = memchr(cell.text, decimal, cell.length);
    *has_mark = mark != NULL;
    if (mark == NULL)
        return false;
    const size_t sign = cell.text[0] == '-' || cell.text[0] == '+',
                 before = (size_t)(mark - cell.text) - sign;
    size_t after = 0;
    while (after < 4 && mark + 1 + after < cell.text + cell.length &&
           strchr("0123456789", mark[1 + after]) != NULL)
        after++;
    return before >= 1 && before <= 3 && cell.text[sign] != '0' && after == 3 &&
           mark + 4 == cell.text + cell.length;
}
