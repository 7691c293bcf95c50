/* Writes headings, tables with display units, and values with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/table/result_value.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void page_heading(page_writer *page, const char *id, const char *words)
{
    text_html(&page->out, "<h2 id=\"%s\">%s</h2>\n", id, words);
    text_html(&page->contents, "<li><a href=\"#%s\">%s</a></li>\n", id, words);
}

void page_fold(page_writer *page, const char *id, const char *words, page_print_mode on_paper)
{
    // The anchor is inside of the folded part, so that a browser that jumps there unfolds it.
    text_html(&page->out,
              "<details class=\"part %s\">\n<summary><h2>%s</h2></summary>\n<div id=\"%s\">\n",
              on_paper == PAGE_PRINTED ? "printed" : "unprinted", words, id);
    text_html(&page->contents, "<li><a href=\"#%s\">%s</a></li>\n", id, words);
}

void page_fold_end(page_writer *page)
{
    text_add(&page->out, "</div>\n</details>\n");
}

/* Numbers of columns that do not fit on paper in the usual type, and in small type. */
enum {
    MANY_COLUMNS = 8,
    SMALL_TYPE_COLUMNS = 16 /* in small type; beyond it each row is a block */
};

static void begin_html_table(page_writer *page, const char *caption, size_t n_columns)
{
    // The wrapper scrolls if a table is wider than the page, also with the keyboard.
    text_html(&page->out,
              "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"%s\">\n"
              "<table class=\"%s\">\n<caption>%s</caption>\n<thead><tr>",
              caption,
              n_columns > SMALL_TYPE_COLUMNS ? "blocks"
              : n_columns > MANY_COLUMNS     ? "many"
                                             : "few",
              caption);
}

static void page_table_end(page_writer *page)
{
    text_add(&page->out, "</tbody>\n</table>\n</div>\n");
}

static void heading_cell(page_writer *page, const char *words, const char *unit, bool number)
{
    text_add(&page->out, number ? "<th scope=\"col\" class=\"n\">" : "<th scope=\"col\">");
    text_html(&page->out, unit[0] != '\0' ? "%s <span class=\"unit\">(%s)</span></th>" : "%s</th>",
              words, unit);
}

/* ---- tables ---------------------------------------------------------------------------------- */

typedef struct shown_column {
    unsigned place;
    const schema_field *column;
    bool text, whole;
    int digits;
    display_unit lab;
} shown_column;

/* Returns the table row of displayed row i. */
static size_t row_index(const size_t *rows, size_t i)
{
    return rows != NULL ? rows[i] : i;
}

/* Returns the magnitude that selects the unit: the median of the absolute values. Over many decades
 * numbers stay in SI units, and moduli in MPa. */
static double typical_size(const table_view *table, unsigned column, const size_t *rows,
                           size_t n_rows)
{
    double *sizes = calloc(n_rows > 0 ? n_rows : 1, sizeof *sizes), median = 1; /* for zeros */
    size_t n = 0;
    for (size_t i = 0; sizes != NULL && i < n_rows; i++) {
        double size = fabs(view_number(table, table->schema, row_index(rows, i), column));
        if (isfinite(size) && size > 0)
            sizes[n++] = size;
    }
    if (n > 0) {
        numbers_sort(sizes, n);
        double range = sizes[n - 1] / sizes[0];
        median = sizes[n / 2];
        if (range > 100 && strcmp(schema_unit(&table->schema->columns[column]), "Pa") == 0)
            median = 1e6;
        else if (range > 1e4)
            median = 1;
    }
    free(sizes);
    return median;
}

/* True if the column is the error of another column. */
static bool is_error(const table_schema *schema, unsigned column)
{
    for (size_t i = 0; i < schema->n_columns; i++)
        if (column != 0 && (schema->columns[i].standard_error == column ||
                            schema->columns[i].numerical_error == column))
            return true;
    return false;
}

/* Prepares a column; false if the table does not have it or it is empty. */
static bool choose_column(shown_column *shown, const table_view *table, unsigned place,
                          const size_t *rows, size_t n_rows)
{
    const table_schema *schema = table->schema;
    const schema_field *column = &schema->columns[place];
    *shown = (shown_column){.place = place,
                            .column = column,
                            .text = column->kind == SCHEMA_TEXT,
                            .whole = true,
                            .digits = column->digits};
    if (table->column[place] < 0)
        return false;
    bool any = column->missing != NULL;
    for (size_t i = 0; shown->text && i < n_rows; i++)
        any = any || view_text(table, schema, row_index(rows, i), place)[0] != '\0';
    if (shown->text)
        return any;
    if (column->digits == 0)
        shown->digits = is_error(schema, place) ? 2 : 3;
    shown->lab = select_display_unit(
        column->quantity, schema_unit(column),
        typical_size(table, column->like != 0 ? column->like : place, rows, n_rows));
    for (size_t i = 0; i < n_rows; i++) {
        double value =
            to_display_value(&shown->lab, view_number(table, schema, row_index(rows, i), place));
        any = any || !isnan(value);
        shown->whole =
            shown->whole && (!isfinite(value) || (value == floor(value) && fabs(value) < 1e15));
    }
    return any;
}

/* Returns the column whose interval this one bounds, or itself. */
static const schema_field *estimate_column(const table_schema *schema, unsigned column)
{
    for (size_t i = 0; i < schema->n_columns && column != 0; i++)
        if (schema->columns[i].low == column || schema->columns[i].high == column)
            return &schema->columns[i];
    return &schema->columns[column];
}

/* Returns the digits that the interval of the row justifies, also for its bounds. */
static int row_digits(const table_view *table, size_t row, const shown_column *shown)
{
    const table_schema *schema = table->schema;
    const schema_field *of = estimate_column(schema, shown->place);
    if (shown->column->digits != 0 || of->low == 0)
        return shown->digits;
    const unsigned columns[] = {(unsigned)(of - schema->columns), of->low, of->high};
    double ends[3]; /* value, then bounds */
    for (size_t i = 0; i < 3; i++)
        ends[i] = to_display_value(&shown->lab, view_number(table, schema, row, columns[i]));
    return result_value_digits(ends[0], ends[1], ends[2]);
}

/* Begins a cell with the column heading as an attribute, as a row is a block on a small screen. */
static void begin_labelled_cell(page_writer *page, const char *words, const char *unit, bool number)
{
    text_add(&page->out, number ? "<td class=\"n\"" : "<td");
    text_html(&page->out, unit[0] != '\0' ? " data-label=\"%s (%s)\">" : " data-label=\"%s\">",
              words, unit);
}

static const char *column_label(const shown_column *shown)
{
    return shown->column->label != NULL ? shown->column->label : shown->column->long_name;
}

static void write_number_cell(page_writer *page, const shown_column *shown, double value,
                              int digits)
{
    const schema_field *column = shown->column;
    double lab = to_display_value(&shown->lab, value);
    begin_labelled_cell(page, column_label(shown), shown->lab.label, true);
    if (isnan(value))
        text_html(&page->out, "%s", column->missing != NULL ? column->missing : "–");
    else if (column->yes_no)
        text_add(&page->out, value != 0 ? "yes" : "no");
    else if (column->decimals > 0 || shown->whole)
        text_add(&page->out, FIXED(lab, column->decimals));
    else
        text_add(&page->out, NUMBER(lab, digits));
    text_add(&page->out, "</td>");
}

/* Writes a cell; the first one of a row is its heading. */
static void write_table_cell(page_writer *page, const table_view *table, size_t row,
                             const shown_column *shown, bool first)
{
    if (!shown->text) {
        write_number_cell(page, shown, view_number(table, table->schema, row, shown->place),
                          row_digits(table, row, shown));
        return;
    }
    const char *const words = view_text(table, table->schema, row, shown->place);
    if (first) {
        text_html(&page->out, "<th scope=\"row\">%s</th>", words);
        return;
    }
    begin_labelled_cell(page, column_label(shown), "", false);
    text_html(&page->out, "%s</td>", words);
}

void page_table(page_writer *page, const table_view *table, const char *caption,
                const unsigned *columns, size_t n_columns, const size_t *rows, size_t n_rows)
{
    const table_schema *schema = table->schema;
    unsigned labelled[SCHEMA_FIELDS_MAX];
    shown_column shown[SCHEMA_FIELDS_MAX];
    size_t n = 0;
    for (unsigned i = 0; columns == NULL && i < schema->n_columns; i++)
        if (schema->columns[i].label != NULL)
            labelled[n_columns++] = i;
    for (size_t i = 0; i < n_columns; i++)
        n += choose_column(&shown[n], table, columns != NULL ? columns[i] : labelled[i], rows,
                           n_rows);
    begin_html_table(page, caption, n);
    for (size_t c = 0; c < n; c++)
        heading_cell(page, column_label(&shown[c]), shown[c].lab.label, !shown[c].text);
    text_add(&page->out, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < n_rows; i++) {
        size_t row = row_index(rows, i);
        text_add(&page->out, "<tr>");
        for (size_t c = 0; c < n; c++)
            write_table_cell(page, table, row, &shown[c], c == 0);
        text_add(&page->out, "</tr>\n");
    }
    page_table_end(page);
}

void page_whole_table(page_writer *page, const table_view *table, const char *caption,
                      const unsigned *columns, size_t n_columns)
{
    if (table->n_rows > 0)
        page_table(page, table, caption, columns, n_columns, NULL, table->n_rows);
}

/* ---- values with both errors ----------------------------------------------------------------- */

static const char value_heading[] = "Value", standard_heading[] = "Standard error",
                  numerical_heading[] = "Numerical error";

static void add_unit_label(text_buffer *text, const char *label)
{
    if (label[0] != '\0')
        text_html(text, " %s", label);
}

/* Adds a value with the digits that its larger error justifies: at least three, at most six. */
static void add_value_text(text_buffer *text, const wt_estimate *e, const display_unit *lab)
{
    double value = to_display_value(lab, e->value), error = 0;
    if (isfinite(e->standard_error))
        error = fabs(e->standard_error) * lab->factor;
    if (isfinite(e->numerical_error))
        error = fmax(error, fabs(e->numerical_error) * lab->factor);
    int leading = value != 0 && isfinite(value) ? (int)floor(log10(fabs(value))) : 0;
    if (!(error > 0) || !isfinite(value) || leading > 5 || leading < -4)
        text_add(text, SHORT_NUMBER(value, 4));
    else {
        const int digits = result_value_digits(value, value - error, value + error);
        const int decimals = value != 0 ? digits - 1 - leading /* zero: digits of the error */
                                        : (int)fmin(5, 1 - floor(log10(error)));
        text_add(text, FIXED(round_to_power_of_ten(value, decimals), decimals));
    }
    if (isfinite(e->value))
        add_unit_label(text, lab->label);
}

static void write_error_cell(page_writer *page, const char *heading, double error,
                             const display_unit *lab)
{
    begin_labelled_cell(page, heading, "", true);
    if (isnan(error))
        text_add(&page->out, "error not known");
    else if (error == 0)
        text_add(&page->out, "–");
    else {
        const double size = fabs(error) * lab->factor;
        const int decimals = 1 - (int)floor(log10(size));
        text_add(&page->out, NUMBER(round_to_power_of_ten(size, decimals), 2));
        add_unit_label(&page->out, lab->offset != 0 ? "K" : lab->label);
    }
    text_add(&page->out, "</td>");
}

/* Writes value, standard error and numerical error. */
static void write_estimate_cells(page_writer *page, const wt_estimate *estimate,
                                 wt_quantity quantity)
{
    const display_unit lab = select_display_unit(quantity, estimate->unit, estimate->value);
    begin_labelled_cell(page, value_heading, "", true);
    add_value_text(&page->out, estimate, &lab);
    text_add(&page->out, "</td>");
    write_error_cell(page, standard_heading, estimate->standard_error, &lab);
    write_error_cell(page, numerical_heading, estimate->numerical_error, &lab);
}

/* ---- keys ------------------------------------------------------------------------------------ */

/* Returns the label of a key; without a schema it is the name with blanks. */
static void key_label(const char *name, const schema_field *key, char *label, size_t size)
{
    const char *words = key == NULL ? NULL : key->label != NULL ? key->label : key->headline;
    const bool known = words != NULL;
    (void)snprintf(label, size, "%s", known ? words : name);
    for (char *s = label; *s != '\0' && !known; s++)
        *s = *s == '_' ? ' ' : *s;
    if (!known && label[0] >= 'a')
        label[0] = (char)(label[0] - 'a' + 'A');
}

static const schema_field *find_schema_key(const table_view *table, const char *name)
{
    char full[SCHEMA_NAME_SIZE];
    for (size_t i = 0; i < table->schema->n_keys; i++) {
        schema_name(table->schema->keys[i].name, table->suffix, full);
        if (strcmp(full, name) == 0)
            return &table->schema->keys[i];
    }
    return NULL;
}

/* Adds a plain key: a number is rounded, a count or a text is unchanged. */
static void add_plain_value(page_writer *page, const schema_field *key, const char *text)
{
    double value;
    const bool rounded = key != NULL && key->kind == SCHEMA_PLAIN && strpbrk(text, ".e") != NULL &&
                         parse_stored_number(text, strlen(text), &value);
    text_html(&page->out, "%s", rounded ? SHORT_NUMBER(value, 3) : text);
}

void page_keys(page_writer *page, const table_view *table, const char *caption)
{
    const size_t n = table->table != NULL ? wt_table_n_keys(table->table) : 0;
    if (n == 0)
        return;
    begin_html_table(page, caption, 4);
    heading_cell(page, "Quantity", "", false);
    heading_cell(page, value_heading, "", true);
    heading_cell(page, standard_heading, "", true);
    heading_cell(page, numerical_heading, "", true);
    text_add(&page->out, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < n; i++) {
        const char *name = wt_table_key_name(table->table, i);
        const schema_field *key = find_schema_key(table, name);
        char label[128];
        wt_estimate estimate;
        key_label(name, key, label, sizeof label);
        text_html(&page->out, "<tr><th scope=\"row\">%s</th>", label);
        if (wt_table_estimate(table->table, name, &estimate))
            write_estimate_cells(page, &estimate, key != NULL ? key->quantity : WT_Q_NONE);
        else {
            text_html(&page->out, "<td data-label=\"%s\" colspan=\"3\">", value_heading);
            add_plain_value(page, key, wt_table_key(table->table, name));
            text_add(&page->out, "</td>");
        }
        text_add(&page->out, "</tr>\n");
    }
    page_table_end(page);
}
