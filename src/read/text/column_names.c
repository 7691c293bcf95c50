/* Recognises the names row of a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

/* Limit on the columns of a table, which bounds the cost of a malicious line. */
#define COLUMNS_MAX ((size_t)1024)
#define MATRIX_COLUMNS_MAX ((size_t)1 << 16) /* limit for an image */

bool split_name_unit(text_span *name, text_span *unit)
{
    const char *const text = name->text;
    const size_t n = name->length;
    if (n == 0)
        return false;
    const char last = text[n - 1];
    if (last == ')' || last == ']') {
        /* find the matching bracket: units like N/(m s) contain brackets */
        const char begin = last == ')' ? '(' : '[';
        size_t depth = 0, open = n;
        while (open-- > 0) {
            depth += text[open] == last;
            if (text[open] == begin && --depth == 0)
                break;
        }
        if (open == SIZE_MAX || open == 0)
            return false;
        *unit = (text_span){text + open + 1, n - open - 2};
        name->length = open;
        return true;
    }
    for (size_t i = n; i-- > 2;)
        if (text[i] == ' ' && text[i - 1] == '/' && text[i - 2] == ' ') {
            *unit = (text_span){text + i + 1, n - i - 1};
            name->length = i - 2;
            return name->length > 0;
        }
    const char *const slash = memchr(text, '/', n); /* as in f/Hz or w/rad/s */
    if (slash == NULL || slash == text || slash + 1 == text + n)
        return false;
    *unit = (text_span){slash + 1, (size_t)(text + n - slash) - 1};
    name->length = (size_t)(slash - text);
    return true;
}

bool names_extract(const text_description *d, text_span *line)
{
    if (d->names_are != NULL && d->has_names_line) {
        const text_span names = {d->names_are, strlen(d->names_are)};
        const bool found = pattern_match(&d->names_line, *line, NULL, 0);
        *line = found ? names : *line;
        return found;
    }
    if (description_is_nameless(d))
        return !line_uncomment(d, line);
    if (d->has_names_line)
        return pattern_extract(&d->names_line, line);
    (void)line_uncomment(d, line);
    return true;
}

/* Finds a name that contains no condition. */
static bool find_plain_name(const text_description *d, text_span cell, name_match *known)
{
    char name[COLUMN_NAME_SIZE];
    known->unit = (text_span){"", 0};
    name_normalise(cell, name);
    if (description_find_name(d, name, &known->first, &known->n))
        return true;
    if ((d->units != UNITS_NAME && d->units != UNITS_NAME_OR_ROW) ||
        !split_name_unit(&cell, &known->unit))
        return false;
    name_normalise(cell, name);
    return description_find_name(d, name, &known->first, &known->n);
}

bool find_column_name(const text_description *d, text_span cell, name_match *known)
{
    known->condition = condition_none();
    known->rest[0] = '\0';
    if (cell.length == 0 || cell.length >= COLUMN_NAME_SIZE)
        return false;
    if (find_plain_name(d, cell, known))
        return true;
    return (d->kinds & WT_KIND_SWEEP) != 0 &&
           condition_extract(cell, known->rest, &known->condition) && known->rest[0] != '\0' &&
           find_plain_name(d, (text_span){known->rest, strlen(known->rest)}, known);
}

/* Counts the known names. *set is the set of quantities that they may measure. */
static size_t count_recognised_names(const text_description *d, const text_cells *cells,
                                     wt_quantity_set *set)
{
    size_t known = 0;
    *set = 0;
    for (size_t i = 0; i < cells->n; i++) {
        name_match name;
        if (!find_column_name(d, cells->cells[i], &name))
            continue;
        known++;
        for (size_t k = name.first; k < name.first + name.n; k++)
            *set |= WT_Q_BIT(d->rules[d->names[k].rule].quantity);
    }
    return known;
}

static size_t try_separator(names_row *names, const text_description *d, text_span line,
                            cell_separator separator, unsigned kinds)
{
    wt_quantity_set set;
    cells_split(&names->names, line, separator, d);
    if (names->names.n > COLUMNS_MAX)
        return 0;
    size_t known = count_recognised_names(d, &names->names, &set);
    return quantities_suffice(set, kinds) ? known : 0;
}

/* Counts the numeric cells of a row of numbers and missing values; 0 if another text occurs. */
static size_t count_numeric_cells(const text_description *d, const text_cells *cells, char decimal)
{
    size_t numbers = 0;
    for (size_t i = 0; i < cells->n; i++) {
        double value;
        const cell_kind kind = cell_parse(cells->cells[i], decimal, d, &value);
        if (kind == CELL_TEXT)
            return 0;
        numbers += kind == CELL_NUMBER || kind == CELL_CLOCK;
    }
    return numbers;
}

/* Sets a name for each cell. A separator at the end of the line adds no cell. */
static void name_all_cells(text_cells *cells, const text_description *d)
{
    if (!d->matrix) {
        cells_split(cells, (text_span){d->names_are, strlen(d->names_are)}, SEPARATOR_WHITESPACE,
                    d);
        return;
    }
    cells->n -= cells->cells[cells->n - 1].length == 0;
    for (size_t i = 0; i < cells->n; i++)
        cells->cells[i] = (text_span){d->names[0].name, strlen(d->names[0].name)};
}

static size_t count_names(const char *text)
{
    size_t n = 1;
    for (const char *c = text; *c != '\0'; c++)
        n += *c == ' ';
    return n;
}

bool names_match_row(names_row *names, const text_description *d, text_span line,
                     cell_separator separator)
{
    static const cell_separator all[] = {SEPARATOR_TAB, SEPARATOR_SEMICOLON, SEPARATOR_WHITESPACE,
                                         SEPARATOR_COMMA};
    text_cells *const cells = &names->names;
    const size_t n_names = d->matrix ? 0 : count_names(d->names_are);
    separator = separator != SEPARATOR_AUTO ? separator : d->separator;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (separator != SEPARATOR_AUTO && separator != all[i])
            continue;
        names->separator = all[i];
        cells_split(cells, line, all[i], d);
        /* a single cell may be a line without this separator */
        const bool fits =
            d->matrix ? cells->n >= 2 && cells->n <= MATRIX_COLUMNS_MAX : cells->n == n_names;
        if (fits &&
            (count_numeric_cells(d, cells, '.') > 0 || count_numeric_cells(d, cells, ',') > 0)) {
            name_all_cells(cells, d);
            return true;
        }
    }
    return false;
}

/* True if tabs separate names of several words, such as "Friction power". */
static bool has_names_of_words(text_span line)
{
    bool blank = false;
    for (size_t i = 1; i + 1 < line.length; i++)
        blank = blank || (line.text[i] == ' ' && strchr(" \t", line.text[i - 1]) == NULL &&
                          strchr(" \t", line.text[i + 1]) == NULL);
    return blank && memchr(line.text, '\t', line.length) != NULL;
}

bool names_match(names_row *names, const text_description *d, text_span line,
                 cell_separator separator, unsigned kinds)
{
    static const cell_separator all[] = {SEPARATOR_TAB, SEPARATOR_SEMICOLON, SEPARATOR_COMMA,
                                         SEPARATOR_WHITESPACE};
    size_t best = 0;
    names->units.n = 0;
    if (description_is_nameless(d))
        return names_match_row(names, d, line, separator);
    if (line.length > PATTERN_LINE_MAX)
        return false;
    if (separator != SEPARATOR_AUTO) {
        names->separator = separator;
        return try_separator(names, d, line, separator, kinds) > 0;
    }
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        /* names of several words would give too many matches with blanks as separators */
        if (all[i] == SEPARATOR_WHITESPACE && (best > 0 || has_names_of_words(line)))
            break;
        size_t known = try_separator(names, d, line, all[i], kinds);
        if (known > best) {
            best = known;
            names->separator = all[i];
        }
    }
    return best > 0 && try_separator(names, d, line, names->separator, kinds) > 0;
}

void names_free(names_row *names)
{
    cells_free(&names->names);
    cells_free(&names->units);
    cells_free(&names->qualifiers);
    free(names->above);
    *names = (names_row){0};
}
