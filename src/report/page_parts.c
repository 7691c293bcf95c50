/* What the parts of the page share: headings, tables with lab units, values with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void page_heading(page_writer *page, const char *id, const char *words)
{
    text_format(&page->out, "<h2 id=\"%s\">", id);
    text_html(&page->out, words);
    text_add(&page->out, "</h2>\n");
    text_format(&page->contents, "<li><a href=\"#%s\">", id);
    text_html(&page->contents, words);
    text_add(&page->contents, "</a></li>\n");
}

static void begin_table(page_writer *page, const char *caption)
{
    // The wrapper scrolls on a narrow screen, also with the keyboard.
    text_add(&page->out, "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"");
    text_html(&page->out, caption);
    text_add(&page->out, "\">\n<table>\n<caption>");
    text_html(&page->out, caption);
    text_add(&page->out, "</caption>\n<thead><tr>");
}

static void end_table(page_writer *page)
{
    text_add(&page->out, "</tbody>\n</table>\n</div>\n");
}

static void heading_cell(page_writer *page, const char *words, const char *unit, bool number)
{
    text_format(&page->out, "<th scope=\"col\"%s>", number ? " class=\"n\"" : "");
    text_html(&page->out, words);
    if (unit[0] != '\0') {
        text_add(&page->out, " <span class=\"unit\">(");
        text_html(&page->out, unit);
        text_add(&page->out, ")</span>");
    }
    text_add(&page->out, "</th>");
}

/* ---- tables ---------------------------------------------------------------------------------- */

typedef struct shown_column {
    long source; /* -1: not in the table */
    bool text, whole;
    lab_unit lab;
    int digits, decimals; /* decimals < 0: so many digits */
} shown_column;

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool is_error(const char *name)
{
    return strstr(name, "_error") != NULL || strstr(name, "_spread") != NULL;
}

/* The median of the absolute values decides the unit; numbers over many decades stay in SI, and
 * moduli in MPa. */
static double typical_size(const wt_table *table, size_t column, const size_t *rows, size_t n_rows,
                           const char *unit)
{
    double *sizes = calloc(n_rows > 0 ? n_rows : 1, sizeof *sizes), median = 0;
    size_t n = 0;
    for (size_t i = 0; sizes != NULL && i < n_rows; i++) {
        double size = fabs(wt_table_number(table, rows != NULL ? rows[i] : i, column));
        if (isfinite(size) && size > 0)
            sizes[n++] = size;
    }
    if (n > 0) {
        qsort(sizes, n, sizeof *sizes, compare_numbers);
        double range = sizes[n - 1] / sizes[0];
        median = sizes[n / 2];
        if (strcmp(unit, "Pa") == 0 && range > 100)
            median = 1e6;
        else if (range > 1e4)
            median = 1;
    }
    free(sizes);
    return median;
}

static void choose_column(shown_column *shown, const wt_table *table, const page_column *column,
                          const size_t *rows, size_t n_rows)
{
    shown->source = wt_table_find(table, column->name);
    if (shown->source < 0)
        return;
    size_t source = (size_t)shown->source;
    shown->text = wt_table_column_kind(table, source) == WT_COLUMN_TEXT;
    if (shown->text)
        return;
    long like = column->like != NULL ? wt_table_find(table, column->like) : -1;
    if (like >= 0 && wt_table_column_kind(table, (size_t)like) == WT_COLUMN_TEXT)
        like = -1;
    size_t unit_of = like >= 0 ? (size_t)like : source;
    const char *unit = wt_table_column_unit(table, source);
    shown->lab = lab_unit_for(unit, column->name, typical_size(table, unit_of, rows, n_rows, unit));
    shown->digits = is_error(column->name) || strstr(column->name, "_p") != NULL ? 2 : 3;
    shown->decimals = -1;
    if (strncmp(column->name, "log_", 4) == 0 || strstr(column->name, "_log_") != NULL)
        shown->decimals = 3;
    else if (strcmp(column->name, "temperature") == 0)
        shown->decimals = 1;
    shown->whole = true;
    bool any = column->missing != NULL;
    for (size_t i = 0; i < n_rows; i++) {
        double value =
            lab_value(&shown->lab, wt_table_number(table, rows != NULL ? rows[i] : i, source));
        any = any || !isnan(value);
        shown->whole =
            shown->whole && (!isfinite(value) || (value == floor(value) && fabs(value) < 1e15));
    }
    if (!any) // nothing is known: no column for it
        shown->source = -1;
}

static void number_cell(page_writer *page, const shown_column *shown, double value,
                        const page_column *column)
{
    text_add(&page->out, "<td class=\"n\">");
    if (isnan(value))
        text_html(&page->out, column->missing != NULL ? column->missing : "–");
    else if (column->yes_no)
        text_add(&page->out, value != 0 ? "yes" : "no");
    else if (shown->decimals >= 0)
        text_fixed(&page->out, lab_value(&shown->lab, value), shown->decimals);
    else if (shown->whole)
        text_fixed(&page->out, lab_value(&shown->lab, value), 0);
    else
        text_number(&page->out, lab_value(&shown->lab, value), shown->digits);
    text_add(&page->out, "</td>");
}

void page_table(page_writer *page, const wt_table *table, const char *caption,
                const page_column *columns, size_t n_columns, const size_t *rows, size_t n_rows)
{
    enum { MAX_COLUMNS = 20 };
    shown_column shown[MAX_COLUMNS] = {{0}};
    if (n_columns > MAX_COLUMNS)
        n_columns = MAX_COLUMNS;
    begin_table(page, caption);
    for (size_t c = 0; c < n_columns; c++) {
        choose_column(&shown[c], table, &columns[c], rows, n_rows);
        if (shown[c].source < 0)
            continue;
        const char *heading = columns[c].heading != NULL
                                  ? columns[c].heading
                                  : wt_table_column_long_name(table, (size_t)shown[c].source);
        heading_cell(page, heading, shown[c].lab.label, !shown[c].text);
    }
    text_add(&page->out, "</tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < n_rows; i++) {
        size_t row = rows != NULL ? rows[i] : i;
        bool first = true;
        text_add(&page->out, "<tr>");
        for (size_t c = 0; c < n_columns; c++) {
            if (shown[c].source < 0)
                continue;
            size_t source = (size_t)shown[c].source;
            if (!shown[c].text)
                number_cell(page, &shown[c], wt_table_number(table, row, source), &columns[c]);
            else { // the first text of a row names it
                text_add(&page->out, first ? "<th scope=\"row\">" : "<td>");
                text_html(&page->out, wt_table_text(table, row, source));
                text_add(&page->out, first ? "</th>" : "</td>");
            }
            first = false;
        }
        text_add(&page->out, "</tr>\n");
    }
    end_table(page);
}

/* ---- values with both errors ----------------------------------------------------------------- */

void page_estimates_begin(page_writer *page, const char *caption, bool remarks)
{
    begin_table(page, caption);
    heading_cell(page, "Quantity", "", false);
    heading_cell(page, "Value", "", true);
    heading_cell(page, "Statistical error", "", true);
    heading_cell(page, "Numerical error", "", true);
    if (remarks)
        heading_cell(page, "Remark", "", false);
    text_add(&page->out, "</tr></thead>\n<tbody>\n");
}

void page_estimates_end(page_writer *page)
{
    end_table(page);
}

static void add_unit(growing_text *text, const char *label)
{
    if (label[0] == '\0')
        return;
    text_add(text, " ");
    text_html(text, label);
}

/* As many decimals as the larger error has meaning, and no more than six digits in all. */
static void add_value(growing_text *text, const wt_estimate *e, const lab_unit *lab)
{
    double value = lab_value(lab, e->value), error = 0;
    if (isfinite(e->standard_error))
        error = fabs(e->standard_error) * lab->factor;
    if (isfinite(e->numerical_error))
        error = fmax(error, fabs(e->numerical_error) * lab->factor);
    int leading = value != 0 && isfinite(value) ? (int)floor(log10(fabs(value))) : 0;
    if (!(error > 0) || !isfinite(value) || leading > 5 || leading < -4)
        text_short(text, value, 4);
    else {
        int decimals = 1 - (int)floor(log10(error));
        decimals = decimals > 5 - leading ? 5 - leading : decimals;
        text_fixed(text, value, decimals < 0 ? 0 : decimals);
    }
}

static void add_error(growing_text *text, double error, const lab_unit *lab)
{
    if (isnan(error))
        text_add(text, "not known");
    else if (error == 0)
        text_add(text, "–");
    else {
        text_add(text, "± ");
        text_number(text, fabs(error) * lab->factor, 2);
        add_unit(text, strcmp(lab->label, "°C") == 0 ? "K" : lab->label);
    }
}

void page_interval(growing_text *text, double low, double high, double value, const char *unit,
                   const char *quantity)
{
    lab_unit lab = lab_unit_for(unit, quantity, value);
    text_number(text, lab_value(&lab, low), 3);
    text_add(text, " to ");
    text_number(text, lab_value(&lab, high), 3);
    if (lab.label[0] != '\0')
        text_format(text, " %s", lab.label);
}

void page_estimate(page_writer *page, const char *words, const wt_estimate *estimate,
                   const char *quantity, const char *interval, const char *remark)
{
    lab_unit lab = lab_unit_for(estimate->unit, quantity, estimate->value);
    text_add(&page->out, "<tr><th scope=\"row\">");
    text_html(&page->out, words);
    text_add(&page->out, "</th><td class=\"n\">");
    add_value(&page->out, estimate, &lab);
    if (isfinite(estimate->value))
        add_unit(&page->out, lab.label);
    text_add(&page->out, "</td><td class=\"n\">");
    if (interval != NULL)
        text_html(&page->out, interval);
    else
        add_error(&page->out, estimate->standard_error, &lab);
    text_add(&page->out, "</td><td class=\"n\">");
    add_error(&page->out, estimate->numerical_error, &lab);
    text_add(&page->out, "</td>");
    if (remark != NULL) {
        text_add(&page->out, "<td>");
        text_html(&page->out, remark);
        text_add(&page->out, "</td>");
    }
    text_add(&page->out, "</tr>\n");
}

/* ---- keys ------------------------------------------------------------------------------------ */

static const char *const key_words[][2] = {
    {"wlf_c1", "WLF constant C₁"},
    {"wlf_c2", "WLF constant C₂"},
    {"wlf_correlation", "Correlation of C₁ and C₂"},
    {"wlf_rms", "Residual of the WLF law, rms (decades)"},
    {"wlf_floor", "Systematic error of each shift that the errors of C1 and C2 include [decade]"},
    {"wlf_straight", "Shift factors on a straight line"},
    {"frequency_min", "Lowest angular frequency measured"},
    {"frequency_max", "Highest angular frequency measured"},
    {"hurst", "Hurst exponent"},
    {"roll_off", "Roll-off wavenumber"},
    {"pole", "Pole of the WLF law"},
    {"rms_storage", "Residual of the storage modulus, rms"},
    {"rms_loss", "Residual of the loss modulus, rms"},
    {"formation_wear_ratio", "Formation rate over wear rate, R"},
    {"n_accepted", "Curves accepted"},
    {"n_rejected", "Curves rejected"},
    {"rms_height", "Root-mean-square height"},
    {"rms_slope", "Root-mean-square slope"},
    {"c0", "C₀"},
    {"relative_change_at_reference", "Relative change at reference"},
    {"relative_change_low", "Relative change, lowest of all velocities"},
    {"relative_change_high", "Relative change, highest of all velocities"},
    {"vertical", "Vertical shift"},
    {"standard_error_includes", "Standard errors include"},
    {"standard_error_lacks", "No error stated for"},
    {"time_to_90_percent", "Time to 90 % of the balance thickness"},
    {"wear_sensitivity", "Relative change of the thickness per relative change of the wear rate"},
    {"shear_stress", "Shear stress of the real contact"},
};

static void key_label(const char *key, char *label, size_t size)
{
    for (size_t i = 0; i < sizeof key_words / sizeof key_words[0]; i++)
        if (strcmp(key_words[i][0], key) == 0) {
            (void)snprintf(label, size, "%s", key_words[i][1]);
            return;
        }
    (void)snprintf(label, size, "%s", key);
    for (char *s = label; *s != '\0'; s++)
        if (*s == '_')
            *s = ' ';
    if (label[0] >= 'a' && label[0] <= 'z')
        label[0] = (char)(label[0] - 'a' + 'A');
}

void page_keys(page_writer *page, const wt_table *table, const char *caption)
{
    if (wt_table_n_keys(table) == 0)
        return;
    page_estimates_begin(page, caption, false);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *key = wt_table_key_name(table, i), *text = wt_table_key(table, key);
        char label[128];
        wt_estimate estimate;
        key_label(key, label, sizeof label);
        if (wt_table_estimate(table, key, &estimate)) {
            page_estimate(page, label, &estimate, key, NULL, NULL);
            continue;
        }
        text_add(&page->out, "<tr><th scope=\"row\">");
        text_html(&page->out, label);
        text_add(&page->out, "</th><td colspan=\"3\">");
        text_html(&page->out, text != NULL ? text : "");
        text_add(&page->out, "</td></tr>\n");
    }
    end_table(page);
}
