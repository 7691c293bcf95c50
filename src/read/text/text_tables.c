/* Queries the tables of a scanned file, and formats the errors of incomplete tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

void text_list_add(text_file *file, text_list *list, size_t max_items, text_span text)
{
    if (list->n >= max_items)
        return;
    if (list->items == NULL)
        list->items = arena_alloc(&file->memory, max_items, sizeof *list->items);
    list->items[list->n++] = arena_text(&file->memory, text.text, text.length);
}

void text_table_free(text_table *t)
{
    free(t->values);
    free(t->blocks);
    free(t->kinds);
    free(t->row_lines);
    free(t->samples);
}

line_position_text format_line_position(size_t line)
{
    line_position_text place;
    snprintf(place.text, sizeof place.text, "line %zu", line);
    return place;
}

bool text_has_kind(const text_file *file, unsigned kind)
{
    const unsigned kinds = file->description->kinds;
    const bool many = (kinds & (kinds - 1)) != 0;
    return (kinds & kind) != 0 && (!many || quantities_suffice(file->quantities, kind));
}

const text_column *text_table_column(const text_table *table, wt_quantity quantity, int segment)
{
    for (size_t i = 0; i < table->n_columns; i++) {
        const column_rule *rule = table->columns[i].rule;
        if (rule->quantity == quantity &&
            (segment < 0 || !rule->has_segment || (int)rule->segment == segment))
            return &table->columns[i];
    }
    return NULL;
}

double text_table_value(const text_table *table, size_t row, const text_column *column)
{
    return table->values[row * table->n_columns + (size_t)(column - table->columns)];
}

/* Returns usual units of a quantity for messages; no column is assumed to have them. */
static const char *likely_units(wt_quantity quantity)
{
    switch (quantity) {
    case WT_Q_FREQUENCY:
    case WT_Q_ANGULAR_FREQUENCY:
        return "Hz or rad/s";
    case WT_Q_STORAGE_MODULUS:
    case WT_Q_LOSS_MODULUS:
    case WT_Q_COMPLEX_MODULUS:
    case WT_Q_SHEAR_COMPLEX_MODULUS:
    case WT_Q_SHEAR_STORAGE_MODULUS:
    case WT_Q_SHEAR_LOSS_MODULUS:
    case WT_Q_RELAXATION_MODULUS:
    case WT_Q_SHEAR_RELAXATION_MODULUS:
        return "MPa or Pa";
    case WT_Q_CREEP_COMPLIANCE:
    case WT_Q_SHEAR_CREEP_COMPLIANCE:
        return "1/MPa or 1/Pa";
    case WT_Q_TEMPERATURE:
        return "degC or K";
    case WT_Q_PHASE:
        return "deg or rad";
    case WT_Q_HEIGHT:
    case WT_Q_MEASURED_HEIGHT:
    case WT_Q_DEFLECTION:
        return "nm or um";
    case WT_Q_POSITION_X:
    case WT_Q_POSITION_Y:
        return "mm or um";
    case WT_Q_SURFACE_HEIGHT:
        return "um or nm";
    case WT_Q_FORCE:
        return "nN or uN";
    default:
        return wt_quantity_unit(quantity);
    }
}

/* Fails with all columns without a unit at once, so that the user can state them together. */
static wt_status fail_missing_units(const text_table *table, wt_quantity_set lacking, wt_error *err)
{
    char names[120] = "", options[200] = "", likely[200] = "";
    size_t n = 0, n_names = 0, n_options = 0, n_likely = 0;
    for (size_t i = 0; i < table->n_problems; i++) {
        const text_column *c = &table->problems[i];
        const wt_quantity q = c->rule->quantity;
        if (c->problem != COLUMN_NO_UNIT || (lacking & WT_Q_BIT(q)) == 0 ||
            n_names + 8 >= sizeof names || n_options + 8 >= sizeof options ||
            n_likely + 8 >= sizeof likely)
            continue;
        n_names += (size_t)snprintf(names + n_names, sizeof names - n_names, "%s\"%s\"",
                                    n > 0 ? ", " : "", c->name);
        n_options += (size_t)snprintf(options + n_options, sizeof options - n_options,
                                      "%s--units \"%s=UNIT\"", n > 0 ? " " : "", c->name);
        n_likely += (size_t)snprintf(likely + n_likely, sizeof likely - n_likely, "%s%s in %s?",
                                     n > 0 ? " " : "", c->name, likely_units(q));
        n++;
    }
    wt_fail(err, WT_E_UNIT, "the file does not say the unit%s of column%s %s", n > 1 ? "s" : "",
            n > 1 ? "s" : "", names);
    wt_error_advice(err, "give %s with %s, as the instrument exports it (%s)",
                    n > 1 ? "them" : "it", options, likely);
    wt_error_options(err, "units");
    return WT_E_UNIT;
}

wt_status text_table_problem(const text_table *table, wt_quantity_set quantities, wt_error *err)
{
    for (size_t i = 0; i < table->n_problems; i++) {
        const text_column *c = &table->problems[i];
        const wt_quantity q = c->rule->quantity;
        if ((quantities & ~table->quantities & WT_Q_BIT(q)) == 0)
            continue;
        wt_status status = WT_E_UNIT;
        switch (c->problem) {
        case COLUMN_NO_UNIT:
            status = fail_missing_units(table, quantities & ~table->quantities, err);
            wt_error_expected(err, "a unit of %s", wt_quantity_id(q));
            break;
        case COLUMN_BAD_UNIT:
            wt_fail(err, status, "the unit of column \"%s\" does not fit", c->name);
            wt_error_expected(err, "a unit of %s", wt_quantity_id(q));
            wt_error_found(err, "\"%s\"", c->unit);
            wt_error_advice(err, "if the file is wrong, give it with --units \"%s=UNIT\" (%s?)",
                            c->name, likely_units(q));
            wt_error_options(err, "units");
            break;
        default:
            status = WT_E_MISSING;
            wt_fail(err, status, "column \"%s\" may be tension or shear", c->name);
            wt_error_expected(err, "a column that decides it, such as \"%s\"",
                              c->rule->required_name);
            wt_error_advice(err, "export that column too, or say it with --deformation tension or "
                                 "--deformation shear");
            wt_error_options(err, "deformation");
            break;
        }
        wt_error_place(err, "line %zu, column %zu", table->names_line, c->cell + 1);
        return status;
    }
    return WT_OK;
}

/* Returns the moduli that a sweep can lack, but not if the file has such a column that is not
 * understood. */
static wt_quantity_set unread_moduli(const text_table *table)
{
    static const wt_quantity_set pairs[] = {
        WT_Q_BIT(WT_Q_STORAGE_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_STORAGE_MODULUS),
        WT_Q_BIT(WT_Q_LOSS_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_LOSS_MODULUS)};
    wt_quantity_set set = 0;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        set |= (table->quantities & pairs[i]) == 0 ? pairs[i] : 0;
    /* the phase angle replaces a loss modulus */
    if ((set & pairs[1]) != 0 && (table->quantities & WT_Q_BIT(WT_Q_LOSS_FACTOR)) == 0)
        set |= WT_Q_BIT(WT_Q_PHASE);
    return set;
}

wt_status text_table_require(const text_table *table, unsigned kind, wt_error *err)
{
    const bool suffices = quantities_suffice(table->quantities, kind);
    wt_status status = text_table_problem(
        table,
        suffices ? unread_moduli(table) : kind_quantities(kind) & ~WT_Q_BIT(WT_Q_LOSS_FACTOR), err);
    if (suffices)
        return status;
    if (status != WT_OK)
        return status;
    wt_fail(err, WT_E_MISSING, "columns are missing");
    wt_error_place(err, "line %zu", table->names_line);
    wt_error_expected(err, "%s", describe_required_columns(kind));
    return WT_E_MISSING;
}

void text_format_unknown(const text_file *file, char *names, size_t size)
{
    size_t used = 0;
    names[0] = '\0';
    for (size_t i = 0; i < file->unknown.n; i++) {
        const size_t length = strlen(file->unknown.items[i]) + (i > 0 ? 2 : 0);
        /* space for the mark of omission */
        if (used + length + 5 > size) {
            memcpy(names + used, " ...", 5);
            return;
        }
        used += (size_t)snprintf(names + used, size - used, "%s%s", i > 0 ? ", " : "",
                                 file->unknown.items[i]);
    }
}

void text_log_assumed(const text_file *file, wt_log *log)
{
    for (size_t t = 0; t < file->n_tables; t++)
        for (size_t i = 0; i < file->tables[t].n_columns; i++) {
            const text_column *column = &file->tables[t].columns[i];
            if (column->assumed != NULL)
                wt_log_add(log, WT_WARNING, file->name, NULL, "%s", column->assumed);
        }
}

/* Warns if each decimal mark of a table may separate thousands. A few numbers have three decimals
 * by chance. */
static void log_grouped(const text_file *file, wt_log *log)
{
    enum { CELLS_MIN = 6 };
    size_t n = 0;
    const text_table *first = NULL;
    if ((file->description->kinds & (WT_KIND_SWEEP | WT_KIND_RECORD)) == 0)
        return;
    for (size_t t = 0; t < file->n_tables; t++) {
        if (file->tables[t].has_decimals)
            return;
        n += file->tables[t].n_grouped;
        first = first == NULL && file->tables[t].n_grouped > 0 ? &file->tables[t] : first;
    }
    if (first != NULL && n >= CELLS_MIN)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(first->names_line).text,
                   "each number with a %s has three digits after it, such as \"%s\", which is read "
                   "as a decimal; if the %s separates thousands, the values are 1000 times too "
                   "small: export the table without a separator of thousands",
                   first->decimal == ',' ? "comma" : "point", first->grouped,
                   first->decimal == ',' ? "comma" : "point");
}

void text_log_unknown(const text_file *file, wt_log *log)
{
    char names[256];
    text_format_unknown(file, names, sizeof names);
    if (file->unknown.n > 0)
        wt_log_add(log, WT_NOTE, file->name, NULL, "columns not used: %s", names);
    if (file->unclear_sign != NULL)
        wt_log_add(log, WT_WARNING, file->name, NULL,
                   "the temperature in the column name \"%s\" is read as negative; if the mark "
                   "before it is a hyphen, write a blank instead",
                   file->unclear_sign);
    if (file->has_repeated_moduli)
        wt_log_add(log, WT_WARNING, file->name, NULL,
                   "a modulus has several columns of one name: only the first is read; of a "
                   "table with columns for each temperature make one for each of them");
}

void text_log_columns(const text_file *file, wt_log *log)
{
    text_log_assumed(file, log);
    log_grouped(file, log);
    text_log_unknown(file, log);
}

/* Returns the first unread test of the description that the file contains, or NULL. */
static const char *find_unread_test(const text_file *file)
{
    const text_description *d = file->description;
    text_span line;
    for (size_t k = 0; k < d->n_unread_tests; k++)
        for (size_t i = 0; feed_line(file->feed, i, &line, NULL) == WT_OK; i++)
            if (pattern_match(&d->unread_tests[k].pattern, line, NULL, 0))
                return d->unread_tests[k].label;
    return NULL;
}

wt_status text_fail_empty(const text_file *file, const char *what, wt_error *err)
{
    const char *const other = find_unread_test(file);
    char steps[160] = "";
    size_t used = 0;
    for (size_t i = 0; i < file->steps.n && used < sizeof steps; i++) {
        int n = snprintf(steps + used, sizeof steps - used, "%s\"%s\"", i > 0 ? ", " : "",
                         file->steps.items[i]);
        used += n > 0 ? (size_t)n : 0;
    }
    wt_fail(err, WT_E_EMPTY, "no %s in it", what);
    if (other != NULL) {
        wt_error_found(err, "%s%s%s", other, file->steps.n > 0 ? ": " : "", steps);
        wt_error_advice(err, "such files are known but not read; sweeps of frequency, temperature "
                             "or strain are");
    } else if (file->steps.n > 0) {
        wt_error_found(err, "%s", steps);
    }
    return WT_E_EMPTY;
}
