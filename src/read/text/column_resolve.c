/* Resolves the names row of a table: the quantities, units and conditions of its columns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UNKNOWN_MAX ((size_t)256)

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

/* True for an angular frequency in 1/s: its name says that radians are meant. */
static bool is_angular_per_second(wt_quantity quantity, const char *unit)
{
    double factor = 0, offset = 0;
    return quantity == WT_Q_ANGULAR_FREQUENCY && strstr(unit, "Hz") == NULL &&
           wt_unit_to_si(unit, WT_Q_FREQUENCY, &factor, &offset, NULL) == WT_OK && factor == 1;
}

bool description_unit_to_si(const text_description *d, wt_quantity quantity, const char *unit,
                            double *factor, double *offset)
{
    for (size_t i = 0; i < d->n_aliases; i++)
        if (strcmp(d->aliases[i].found, unit) == 0 &&
            wt_unit_to_si(d->aliases[i].means, quantity, factor, offset, NULL) == WT_OK)
            return true;
    *factor = 1;
    *offset = 0;
    return is_angular_per_second(quantity, unit) ||
           wt_unit_to_si(unit, quantity, factor, offset, NULL) == WT_OK;
}

static bool rule_unit_to_si(const text_description *d, const column_rule *rule, const char *unit,
                            double *factor, double *offset)
{
    return description_unit_to_si(d, rule->quantity, unit, factor, offset);
}

size_t names_count_units(const names_row *names, const text_description *d, const text_cells *cells)
{
    size_t n = 0;
    for (size_t i = 0; i < cells->n && i < names->names.n; i++) {
        name_match known;
        char unit[32];
        bool fits = false;
        double factor, offset;
        if (cells->cells[i].length == 0 || !find_column_name(d, names->names.cells[i], &known))
            continue;
        text_copy(unit, sizeof unit, strip_unit(cells->cells[i]));
        for (size_t k = known.first; k < known.first + known.n && !fits; k++)
            fits = rule_unit_to_si(d, &d->rules[d->names[k].rule], unit, &factor, &offset);
        n += fits;
    }
    return n;
}

/* ---- columns ------------------------------------------------------------------------------ */

typedef struct column_resolver {
    const text_description *d;
    const names_row *names;
    char (*normalised)[COLUMN_NAME_SIZE];
    text_table *table;
    const wt_read_options *options;
    bool uses_cells; /* true if cells above or below the names state conditions of the columns */
} column_resolver;

static bool spans_equal(text_span a, text_span b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

static size_t find_cell(const column_resolver *r, const char *name)
{
    if (name != NULL)
        for (size_t i = 0; i < r->names->names.n; i++)
            if (strcmp(r->normalised[i], name) == 0)
                return i;
    return SIZE_MAX;
}

/* Returns the unit that the user states for a column, or NULL. Names that differ in case alone,
 * such as t and T, must be given exactly. */
static const char *option_unit(const column_resolver *r, size_t cell)
{
    const text_cells *const names = &r->names->names;
    const char *unit = NULL;
    for (size_t i = 0; i < r->options->n_units; i++) {
        const char *const text = r->options->units[i], *const equal = strrchr(text, '=');
        char name[COLUMN_NAME_SIZE];
        if (equal == NULL)
            continue;
        const text_span given = {text, (size_t)(equal - text)};
        size_t exact = 0;
        while (exact < names->n && !spans_equal(names->cells[exact], given))
            exact++;
        name_normalise(given, name);
        if (exact < names->n && spans_equal(names->cells[exact], names->cells[cell]))
            return equal + 1;
        if (unit == NULL && exact == names->n && strcmp(name, r->normalised[cell]) == 0)
            unit = equal + 1;
    }
    return unit;
}

/* Returns the first cell with one of the names; SIZE_MAX if there is none. */
static size_t find_first_cell(const column_resolver *r, char *const *names, size_t n)
{
    size_t cell = SIZE_MAX;
    for (size_t i = 0; i < n && cell == SIZE_MAX; i++)
        cell = find_cell(r, names[i]);
    return cell;
}

/* Returns the column that reads the quantity, segment and condition of a column, or NULL. */
static text_column *find_read_column(const text_table *table, const text_column *column)
{
    const column_rule *const rule = column->rule;
    for (size_t i = 0; i < table->n_columns; i++) {
        const column_rule *other = table->columns[i].rule;
        if (table->columns[i].condition == column->condition && other->quantity == rule->quantity &&
            other->has_segment == rule->has_segment &&
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
    return (moduli & WT_Q_BIT(first->rule->quantity)) != 0 && spans_equal(one, other);
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
    text_column column = {
        .cell = cell, .condition = ALL_CONDITIONS, .problem = COLUMN_UNCLEAR, .factor = 1};
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
    const char *const given = option_unit(r, cell);
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
        if (unit != NULL && is_angular_per_second(rule->quantity, unit))
            column.assumed = "the angular frequency is in 1/s: taken as rad/s; if cycles are "
                             "meant, give --columns \"NAME=frequency:Hz\"";
        column.problem = COLUMN_GOOD;
        column.factor = rule->negate ? -factor : factor;
        column.offset = rule->negate ? -offset : offset;
        break;
    }
    if (column.problem == COLUMN_BAD_UNIT && column.unit[0] == '\0' && given != NULL)
        snprintf(column.unit, sizeof column.unit, "%s", given);
    return column;
}

static void add_unknown_name(text_file *file, text_span cell)
{
    for (size_t i = 0; i < file->unknown.n; i++)
        if (cell_equals(cell, file->unknown.items[i]))
            return;
    text_list_add(file, &file->unknown, UNKNOWN_MAX, cell);
}

/* Drops problems of columns whose quantity another column provides, such as F in newton in addition
 * to f in hertz. */
static void drop_redundant_problems(const names_row *names, text_file *file, text_table *table)
{
    size_t kept = 0;
    for (size_t i = 0; i < table->n_problems; i++) {
        const text_column column = table->problems[i];
        if ((table->quantities & WT_Q_BIT(column.rule->quantity)) != 0)
            add_unknown_name(file, names->names.cells[column.cell]);
        else
            table->problems[kept++] = column;
    }
    table->n_problems = kept;
}

/* Resolves a matrix, whose cells all belong to one column. The header may state its unit. */
static void resolve_matrix(const names_row *names, text_file *file, text_table *table,
                           const wt_read_options *options)
{
    char normalised[1][COLUMN_NAME_SIZE];
    const column_resolver r = {file->description, names, normalised, table, options, false};
    const text_span cell = names->names.cells[0];
    name_match known;
    const size_t n = names->names.n;
    table->columns = arena_alloc(&file->table_memory, n, sizeof *table->columns);
    table->problems = arena_alloc(&file->table_memory, 1, sizeof *table->problems);
    name_normalise(cell, normalised[0]);
    (void)find_column_name(file->description, cell, &known);
    known.unit = (text_span){names->value_unit, strlen(names->value_unit)};
    const text_column column = resolve_column(&r, 0, &known);
    table->n_names = table->n_columns = n;
    table->group_cell = table->segment_cell = table->curve_cell = SIZE_MAX;
    table->sample_cell = table->number_cell = table->flag_cell = SIZE_MAX;
    for (size_t i = 0; i < n; i++) {
        table->columns[i] = column;
        table->columns[i].cell = i;
    }
    if (column.problem == COLUMN_GOOD)
        table->quantities = WT_Q_BIT(column.rule->quantity);
    else
        table->problems[table->n_problems++] = column;
}

static wt_quantity cell_quantity(const column_resolver *r, size_t cell)
{
    name_match known;
    return find_column_name(r->d, r->names->names.cells[cell], &known)
               ? r->d->rules[r->d->names[known.first].rule].quantity
               : WT_Q_NONE;
}

/* True for the only column of frequencies, times or temperatures. All conditions share it, although
 * a row of conditions may repeat the first one above it. */
static bool is_shared_axis(const column_resolver *r, size_t cell)
{
    const wt_quantity_set axes = WT_Q_BIT(WT_Q_FREQUENCY) | WT_Q_BIT(WT_Q_ANGULAR_FREQUENCY) |
                                 WT_Q_BIT(WT_Q_TIME) | WT_Q_BIT(WT_Q_TEMPERATURE);
    const wt_quantity quantity = cell_quantity(r, cell);
    bool is_only = quantity != WT_Q_NONE && (axes & WT_Q_BIT(quantity)) != 0;
    for (size_t i = 0; is_only && i < r->names->names.n; i++)
        is_only = i == cell || cell_quantity(r, i) != quantity;
    return is_only;
}

/* Sets the condition of a column, by its name and by the cells above and below it. */
static void set_condition(const column_resolver *r, text_file *file, const name_match *known,
                          text_column *column)
{
    text_table *const t = r->table;
    const size_t cell = column->cell;
    text_condition c = known->condition;
    if (r->uses_cells && cell < r->names->n_above && !is_shared_axis(r, cell))
        condition_merge(&c, &r->names->above[cell]);
    if (condition_is_empty(&c))
        return;
    if (t->conditions == NULL)
        t->conditions = arena_alloc(&file->table_memory, r->names->names.n, sizeof *t->conditions);
    if (c.is_sign_unclear && file->unclear_sign == NULL)
        file->unclear_sign = arena_text(&file->memory, column->name, strlen(column->name));
    size_t i = 0;
    while (i < t->n_conditions && !condition_is_same(&t->conditions[i], &c))
        i++;
    if (i == t->n_conditions)
        t->conditions[t->n_conditions++] = c;
    column->condition = i;
}

/* The quantities below one condition. */
typedef struct condition_set {
    const text_condition *condition;
    wt_quantity_set quantities;
} condition_set;

/* Sets uses_cells if each condition in the cells is above the same quantities. Otherwise the cells
 * are a list that has nothing to do with the columns. */
static void compare_cells(column_resolver *r)
{
    const names_row *const names = r->names;
    condition_set *const sets = wt_alloc(names->n_above, sizeof *sets);
    size_t n = 0;
    for (size_t i = 0; i < names->n_above && i < names->names.n; i++) {
        const wt_quantity quantity = cell_quantity(r, i);
        size_t k = 0;
        if (condition_is_empty(&names->above[i]) || quantity == WT_Q_NONE || is_shared_axis(r, i))
            continue;
        while (k < n && !condition_is_same(sets[k].condition, &names->above[i]))
            k++;
        n = k == n ? n + 1 : n;
        sets[k].condition = &names->above[i];
        sets[k].quantities |= WT_Q_BIT(quantity);
    }
    r->uses_cells = n > 0;
    for (size_t k = 1; k < n; k++)
        r->uses_cells = r->uses_cells && sets[k].quantities == sets[0].quantities;
    free(sets);
}

static bool has_qualifier(const column_resolver *r, size_t cell)
{
    const text_cells *const q = &r->names->qualifiers;
    return cell < q->n && q->cells[cell].length > 0;
}

/* True if the names row has the name again without a qualifier: the raw waveform or the deviation
 * of a quantity is not the quantity. */
static bool is_qualified_twin(const column_resolver *r, size_t cell)
{
    if (!has_qualifier(r, cell))
        return false;
    for (size_t i = 0; i < r->names->names.n; i++)
        if (i != cell && !has_qualifier(r, i) && strcmp(r->normalised[i], r->normalised[cell]) == 0)
            return true;
    return false;
}

/* Normalises the names for comparison, without their conditions and units. */
static void normalise_names(const column_resolver *r)
{
    for (size_t i = 0; i < r->names->names.n; i++) {
        text_span cell = r->names->names.cells[i];
        name_match known;
        /* a name that contains its unit is compared without it */
        const bool is_known = find_column_name(r->d, cell, &known);
        if (is_known && known.rest[0] != '\0')
            cell = (text_span){known.rest, strlen(known.rest)};
        if (is_known ? known.unit.length > 0 : r->d->units != UNITS_ROW)
            (void)split_name_unit(&cell, &known.unit);
        name_normalise(cell, r->normalised[i]);
    }
}

bool text_column_is_of_sample(const text_column *column)
{
    static const char *const words[] = {"sample", "specimen", "proben", "\u00e9chantillon"};
    char name[COLUMN_NAME_SIZE];
    name_normalise((text_span){column->name, strlen(column->name)}, name);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strstr(name, words[i]) != NULL)
            return true;
    return false;
}

/* Adds a second column of temperature. The first one is read, so that of the sample becomes the
 * first; the other remains for a comparison. */
static void add_temperature(text_table *table, text_column *first, const text_column *second)
{
    text_column *const last = &table->columns[table->n_columns++];
    *last = *second;
    if (text_column_is_of_sample(second) && !text_column_is_of_sample(first)) {
        *last = *first;
        *first = *second;
    }
}

static bool is_special_cell(const text_table *t, size_t i)
{
    return i == t->group_cell || i == t->segment_cell || i == t->curve_cell ||
           i == t->sample_cell || i == t->number_cell || i == t->flag_cell;
}

void names_resolve(const names_row *names, text_file *file, text_table *table,
                   const wt_read_options *options)
{
    const text_description *d = file->description;
    const size_t n_cells = names->names.n;
    column_resolver r = {.d = d, .names = names, .table = table, .options = options};
    if (d->matrix) {
        resolve_matrix(names, file, table, options);
        return;
    }
    r.normalised = wt_alloc(n_cells, sizeof *r.normalised);
    table->columns = arena_alloc(&file->table_memory, n_cells, sizeof *table->columns);
    table->problems = arena_alloc(&file->table_memory, n_cells, sizeof *table->problems);
    normalise_names(&r);
    compare_cells(&r);
    table->n_names = n_cells;
    table->has_qualifiers = names->qualifiers.n > 0;
    table->group_cell = find_cell(&r, d->group);
    table->segment_cell = find_cell(&r, d->segment_column);
    table->curve_cell = find_cell(&r, d->curve_column);
    table->sample_cell = find_first_cell(&r, d->samples, d->n_samples);
    if (table->sample_cell == SIZE_MAX) {
        table->sample_cell = find_first_cell(&r, d->repeating, d->n_repeating);
        table->is_sample_guessed = table->sample_cell != SIZE_MAX;
        if (table->is_sample_guessed)
            text_copy(table->sample_name, sizeof table->sample_name,
                      names->names.cells[table->sample_cell]);
    }
    table->number_cell = find_first_cell(&r, d->row_numbers, d->n_row_numbers);
    table->flag_cell = find_cell(&r, d->flag_column);
    for (size_t i = 0; i < n_cells; i++) {
        const text_span cell = names->names.cells[i];
        name_match known;
        if (!find_column_name(d, cell, &known)) {
            if (cell.length > 0 && !is_special_cell(table, i) && !(i == 0 && d->row_prefix != NULL))
                add_unknown_name(file, cell);
            continue;
        }
        text_column column = resolve_column(&r, i, &known);
        text_column *taken = NULL;
        set_condition(&r, file, &known, &column);
        if (is_qualified_twin(&r, i))
            add_unknown_name(file, cell);
        else if (column.problem != COLUMN_GOOD) {
            table->problems[table->n_problems++] = column;
        } else if ((taken = find_read_column(table, &column)) != NULL &&
                   column.rule->quantity == WT_Q_TEMPERATURE) {
            add_temperature(table, taken, &column);
        } else if (taken != NULL) {
            file->has_repeated_moduli =
                file->has_repeated_moduli || is_repeated_modulus(names, taken, i);
            add_unknown_name(file, cell);
        } else {
            table->quantities |= WT_Q_BIT(column.rule->quantity);
            table->columns[table->n_columns++] = column;
        }
    }
    free(r.normalised);
    drop_redundant_problems(names, file, table);
}
