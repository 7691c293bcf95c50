/* Parses the names row of a table: the known columns, their quantities and their units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Limit on the columns of a table, which bounds the cost of a malicious line. */
#define COLUMNS_MAX ((size_t)1024)
#define MATRIX_COLUMNS_MAX ((size_t)1 << 16) /* limit for an image */
#define UNKNOWN_MAX ((size_t)256)

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

bool find_column_name(const text_description *d, text_span cell, name_match *known)
{
    char name[COLUMN_NAME_SIZE];
    known->unit = (text_span){"", 0};
    if (cell.length == 0 || cell.length >= COLUMN_NAME_SIZE)
        return false;
    name_normalise(cell, name);
    if (description_find_name(d, name, &known->first, &known->n))
        return true;
    if ((d->units != UNITS_NAME && d->units != UNITS_NAME_OR_ROW) ||
        !split_name_unit(&cell, &known->unit))
        return false;
    name_normalise(cell, name);
    return description_find_name(d, name, &known->first, &known->n);
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
    if (!cells_split(&names->names, line, separator, d)) {
        names->no_memory = true;
        return 0;
    }
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
        numbers += kind == CELL_NUMBER;
    }
    return numbers;
}

/* Sets a name for each cell. A separator at the end of the line adds no cell. */
static bool name_all_cells(names_row *names, const text_description *d)
{
    text_cells *const cells = &names->names;
    if (!d->matrix)
        return cells_split(cells, (text_span){d->names_are, strlen(d->names_are)},
                           SEPARATOR_WHITESPACE, d);
    cells->n -= cells->cells[cells->n - 1].length == 0;
    for (size_t i = 0; i < cells->n; i++)
        cells->cells[i] = (text_span){d->names[0].name, strlen(d->names[0].name)};
    return true;
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
        if (!cells_split(cells, line, all[i], d)) {
            names->no_memory = true;
            return false;
        }
        /* a single cell may be a line without this separator */
        const bool fits =
            d->matrix ? cells->n >= 2 && cells->n <= MATRIX_COLUMNS_MAX : cells->n == n_names;
        if (fits &&
            (count_numeric_cells(d, cells, '.') > 0 || count_numeric_cells(d, cells, ',') > 0)) {
            names->no_memory = !name_all_cells(names, d);
            return !names->no_memory;
        }
    }
    return false;
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
        if (all[i] == SEPARATOR_WHITESPACE && best > 0)
            break;
        size_t known = try_separator(names, d, line, all[i], kinds);
        if (known > best) {
            best = known;
            names->separator = all[i];
        }
    }
    return best > 0 && !names->no_memory &&
           try_separator(names, d, line, names->separator, kinds) > 0;
}

void names_free(names_row *names)
{
    free(names->names.cells);
    free(names->units.cells);
    *names = (names_row){0};
}

/* ---- units -------------------------------------------------------------------------------- */

/* Removes brackets and blanks around a unit; "-" means no unit. */
static text_span strip_unit(text_span unit)
{
    while (unit.length >= 2 && ((unit.text[0] == '[' && unit.text[unit.length - 1] == ']') ||
                                (unit.text[0] == '(' && unit.text[unit.length - 1] == ')'))) {
        unit.text++;
        unit.length -= 2;
    }
    while (unit.length > 0 && unit.text[0] == ' ') {
        unit.text++;
        unit.length--;
    }
    while (unit.length > 0 && unit.text[unit.length - 1] == ' ')
        unit.length--;
    if (unit.length == 1 && unit.text[0] == '-')
        unit.length = 0;
    return unit;
}

/* Returns the unit that the user states for a column, or NULL. */
static const char *option_unit(const wt_read_options *options, const char *normalised)
{
    char name[COLUMN_NAME_SIZE];
    for (size_t i = 0; i < options->n_units; i++) {
        const char *equal = strrchr(options->units[i], '=');
        if (equal == NULL)
            continue;
        name_normalise((text_span){options->units[i], (size_t)(equal - options->units[i])}, name);
        if (strcmp(name, normalised) == 0)
            return equal + 1;
    }
    return NULL;
}

static bool rule_unit_to_si(const text_description *d, const column_rule *rule, const char *unit,
                            double *factor, double *offset)
{
    for (size_t i = 0; i < d->n_aliases; i++)
        if (strcmp(d->aliases[i].found, unit) == 0 &&
            wt_unit_to_si(d->aliases[i].means, rule->quantity, factor, offset, NULL) == WT_OK)
            return true;
    return wt_unit_to_si(unit, rule->quantity, factor, offset, NULL) == WT_OK;
}

/* ---- columns ------------------------------------------------------------------------------ */

typedef struct column_resolver {
    const text_description *d;
    const names_row *names;
    char (*normalised)[COLUMN_NAME_SIZE];
    text_table *table;
    const wt_read_options *options;
} column_resolver;

static size_t find_cell(const column_resolver *r, const char *name)
{
    if (name != NULL)
        for (size_t i = 0; i < r->names->names.n; i++)
            if (strcmp(r->normalised[i], name) == 0)
                return i;
    return SIZE_MAX;
}

/* Returns the first cell with one of the names; SIZE_MAX if there is none. */
static size_t find_first_cell(const column_resolver *r, char *const *names, size_t n)
{
    size_t cell = SIZE_MAX;
    for (size_t i = 0; i < n && cell == SIZE_MAX; i++)
        cell = find_cell(r, names[i]);
    return cell;
}

/* Returns the column that a rule with the same quantity and segment reads, or NULL. */
static const text_column *find_read_column(const text_table *table, const column_rule *rule)
{
    for (size_t i = 0; i < table->n_columns; i++) {
        const column_rule *other = table->columns[i].rule;
        if (other->quantity == rule->quantity && other->has_segment == rule->has_segment &&
            (!rule->has_segment || other->segment == rule->segment))
            return &table->columns[i];
    }
    return NULL;
}

/* True if a modulus has a second column of the same name, as in a table with columns for each
 * temperature. */
static bool is_repeated_modulus(const names_row *names, const text_column *first, size_t cell)
{
    const text_span one = names->names.cells[first->cell], other = names->names.cells[cell];
    const wt_quantity_set moduli = TENSION_MODULI | SHEAR_MODULI;
    return (moduli & WT_Q_BIT(first->rule->quantity)) != 0 && one.length == other.length &&
           memcmp(one.text, other.text, one.length) == 0;
}

typedef enum deformation_match {
    DEFORMATION_STATED,
    DEFORMATION_MATCHES,
    DEFORMATION_DIFFERS
} deformation_match;

/* Compares the deformation of a rule with that of the user, if the name of the modulus leaves it
 * open. */
static deformation_match deformation_answer(const column_resolver *r, const name_match *known,
                                            const column_rule *rule)
{
    const wt_quantity_set bit = WT_Q_BIT(rule->quantity);
    wt_quantity_set all = 0;
    for (size_t k = known->first; k < known->first + known->n; k++) {
        const column_rule *const other = &r->d->rules[r->d->names[k].rule];
        all |= WT_Q_BIT(other->quantity);
        if (other->required_name != NULL && find_cell(r, other->required_name) != SIZE_MAX)
            return DEFORMATION_STATED; /* that column states the deformation */
    }
    if (r->options->deformation == WT_DEFORMATION_FROM_FILE || (all & TENSION_MODULI) == 0 ||
        (all & SHEAR_MODULI) == 0 || ((TENSION_MODULI | SHEAR_MODULI) & bit) == 0)
        return DEFORMATION_STATED;
    const bool shear = r->options->deformation == WT_DEFORMATION_SHEAR;
    return ((shear ? SHEAR_MODULI : TENSION_MODULI) & bit) != 0 ? DEFORMATION_MATCHES
                                                                : DEFORMATION_DIFFERS;
}

/* True if the unit fits a quantity of that name. */
static bool unit_fits_name(const column_resolver *r, const name_match *known, const char *unit)
{
    double factor, offset;
    for (size_t k = known->first; k < known->first + known->n; k++)
        if (rule_unit_to_si(r->d, &r->d->rules[r->d->names[k].rule], unit, &factor, &offset))
            return true;
    return false;
}

/* Begins a column with its name and its unit in the file. A unit that fits no quantity of the name
 * is dropped if the user states another one. */
static text_column begin_column(const column_resolver *r, size_t cell, const name_match *known,
                                const char *given)
{
    text_span name = r->names->names.cells[cell];
    text_column column = {.cell = cell, .problem = COLUMN_UNCLEAR, .factor = 1};
    text_span unit = known->unit, ignored;
    if (unit.length == 0 && cell < r->names->units.n)
        unit = r->names->units.cells[cell];
    unit = strip_unit(unit);
    if (known->unit.length > 0)
        (void)split_name_unit(&name, &ignored);
    while (name.length > 0 && name.text[name.length - 1] == ' ')
        name.length--;
    text_copy(column.name, sizeof column.name, name);
    text_copy(column.unit, sizeof column.unit, unit);
    if (given != NULL && column.unit[0] != '\0' && !unit_fits_name(r, known, column.unit))
        column.unit[0] = '\0';
    return column;
}

/* Returns the unit of a column: that of the file, else of the rule, else of the user; NULL if there
 * is none. */
static const char *column_unit(const text_column *column, const column_rule *rule,
                               const char *given)
{
    if (column->unit[0] != '\0')
        return column->unit;
    return rule->unit != NULL ? rule->unit : given;
}

/* True if the unit of the user differs from that of the column. */
static bool is_other_unit(const column_resolver *r, const column_rule *rule, const char *given,
                          double factor, double offset)
{
    double other = 1, begin = 0;
    /* two spellings of a unit differ by rounding */
    const double same = 1e-9;
    return !rule_unit_to_si(r->d, rule, given, &other, &begin) ||
           fabs(other - factor) > same * fabs(factor) || fabs(begin - offset) > same * fabs(begin);
}

/* Resolves a column by the first rule of its name whose condition holds and whose quantity has the
 * unit. */
static text_column resolve_column(const column_resolver *r, size_t cell, const name_match *known)
{
    const char *const given = option_unit(r->options, r->normalised[cell]);
    text_column column = begin_column(r, cell, known, given);
    for (size_t k = known->first; k < known->first + known->n; k++) {
        const column_rule *rule = &r->d->rules[r->d->names[k].rule];
        const char *const unit = column_unit(&column, rule, given);
        double factor = 1, offset = 0;
        const deformation_match answer = deformation_answer(r, known, rule);
        const bool is_absent =
            rule->required_name != NULL && find_cell(r, rule->required_name) == SIZE_MAX;
        if (answer == DEFORMATION_DIFFERS || (answer == DEFORMATION_STATED && is_absent)) {
            if (column.rule == NULL)
                column.rule = rule;
            continue;
        }
        if (unit == NULL ? rule->quantity != WT_Q_LOSS_FACTOR
                         : !rule_unit_to_si(r->d, rule, unit, &factor, &offset)) {
            if (column.problem == COLUMN_UNCLEAR) {
                column.rule = rule;
                column.problem = unit == NULL ? COLUMN_NO_UNIT : COLUMN_BAD_UNIT;
            }
            continue;
        }
        if (given != NULL && is_other_unit(r, rule, given, factor, offset))
            column.overruled = given;
        if (unit != NULL && unit != column.unit)
            snprintf(column.unit, sizeof column.unit, "%s", unit);
        column.rule = rule;
        column.assumed = answer == DEFORMATION_STATED ? rule->assumed : NULL;
        column.problem = COLUMN_GOOD;
        column.factor = rule->negate ? -factor : factor;
        column.offset = rule->negate ? -offset : offset;
        break;
    }
    if (column.problem == COLUMN_BAD_UNIT && column.unit[0] == '\0' && given != NULL)
        snprintf(column.unit, sizeof column.unit, "%s", given);
    return column;
}

static wt_status add_unknown_name(text_file *file, text_span cell, wt_error *err)
{
    for (size_t i = 0; i < file->unknown.n; i++)
        if (cell_equals(cell, file->unknown.items[i]))
            return WT_OK;
    return text_list_add(file, &file->unknown, UNKNOWN_MAX, cell, err);
}

/* Drops problems of columns whose quantity another column provides, such as F in newton in addition
 * to f in hertz. */
static wt_status drop_redundant_problems(const names_row *names, text_file *file, text_table *table,
                                         wt_error *err)
{
    wt_status status = WT_OK;
    size_t kept = 0;
    for (size_t i = 0; i < table->n_problems && status == WT_OK; i++) {
        const text_column column = table->problems[i];
        if ((table->quantities & WT_Q_BIT(column.rule->quantity)) != 0)
            status = add_unknown_name(file, names->names.cells[column.cell], err);
        else
            table->problems[kept++] = column;
    }
    table->n_problems = kept;
    return status;
}

/* Resolves a matrix, whose cells all belong to one column. The header may state its unit. */
static wt_status resolve_matrix(const names_row *names, text_file *file, text_table *table,
                                const wt_read_options *options, wt_error *err)
{
    char normalised[1][COLUMN_NAME_SIZE];
    const column_resolver r = {file->description, names, normalised, table, options};
    const text_span cell = names->names.cells[0];
    name_match known;
    const size_t n = names->names.n;
    table->columns = arena_alloc(&file->table_memory, n, sizeof *table->columns);
    table->problems = arena_alloc(&file->table_memory, 1, sizeof *table->problems);
    if (table->columns == NULL || table->problems == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the columns of a table");
    name_normalise(cell, normalised[0]);
    (void)find_column_name(file->description, cell, &known);
    known.unit = (text_span){names->value_unit, strlen(names->value_unit)};
    const text_column column = resolve_column(&r, 0, &known);
    table->n_names = table->n_columns = n;
    table->group_cell = table->segment_cell = table->curve_cell = SIZE_MAX;
    table->sample_cell = table->number_cell = SIZE_MAX;
    for (size_t i = 0; i < n; i++) {
        table->columns[i] = column;
        table->columns[i].cell = i;
    }
    if (column.problem == COLUMN_GOOD)
        table->quantities = WT_Q_BIT(column.rule->quantity);
    else
        table->problems[table->n_problems++] = column;
    return WT_OK;
}

wt_status names_resolve(const names_row *names, text_file *file, text_table *table,
                        const wt_read_options *options, wt_error *err)
{
    const text_description *d = file->description;
    const size_t n_cells = names->names.n;
    column_resolver r = {.d = d, .names = names, .table = table, .options = options};
    wt_status status = WT_OK;
    if (d->matrix)
        return resolve_matrix(names, file, table, options, err);
    r.normalised = calloc(n_cells, sizeof *r.normalised);
    table->columns = arena_alloc(&file->table_memory, n_cells, sizeof *table->columns);
    table->problems = arena_alloc(&file->table_memory, n_cells, sizeof *table->problems);
    if (r.normalised == NULL || table->columns == NULL || table->problems == NULL) {
        free(r.normalised);
        return wt_fail(err, WT_E_MEMORY, "no memory for the columns of a table");
    }
    for (size_t i = 0; i < n_cells; i++) {
        text_span cell = names->names.cells[i];
        name_match known;
        /* a name that contains its unit is compared without it */
        if (find_column_name(d, cell, &known) ? known.unit.length > 0 : d->units != UNITS_ROW)
            (void)split_name_unit(&cell, &known.unit);
        name_normalise(cell, r.normalised[i]);
    }
    table->n_names = n_cells;
    table->group_cell = find_cell(&r, d->group);
    table->segment_cell = find_cell(&r, d->segment_column);
    table->curve_cell = find_cell(&r, d->curve_column);
    table->sample_cell = find_first_cell(&r, d->samples, d->n_samples);
    table->number_cell = find_first_cell(&r, d->row_numbers, d->n_row_numbers);
    for (size_t i = 0; i < n_cells && status == WT_OK; i++) {
        const text_span cell = names->names.cells[i];
        name_match known;
        if (!find_column_name(d, cell, &known)) {
            if (cell.length > 0 && i != table->group_cell && i != table->segment_cell &&
                i != table->curve_cell && i != table->sample_cell && i != table->number_cell &&
                !(i == 0 && d->row_prefix != NULL))
                status = add_unknown_name(file, cell, err);
            continue;
        }
        text_column column = resolve_column(&r, i, &known);
        const text_column *taken = NULL;
        if (column.problem != COLUMN_GOOD) {
            table->problems[table->n_problems++] = column;
        } else if ((taken = find_read_column(table, column.rule)) != NULL) {
            file->has_repeated_moduli =
                file->has_repeated_moduli || is_repeated_modulus(names, taken, i);
            status = add_unknown_name(file, cell, err);
        } else {
            table->quantities |= WT_Q_BIT(column.rule->quantity);
            table->columns[table->n_columns++] = column;
        }
    }
    free(r.normalised);
    return status == WT_OK ? drop_redundant_problems(names, file, table, err) : status;
}
