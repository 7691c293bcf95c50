/* Adds rows to those of a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/result_rows_parts.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static result_row *add_row(rows_source *s, int level, const char *name, va_list list)
    WT_PRINTF(3, 0);
static result_row *add_row(rows_source *s, int level, const char *name, va_list list)
{
    result_rows *r = s->rows;
    r->rows = array_grow(r->rows, r->n, sizeof *r->rows);
    result_row *row = &r->rows[r->n++];
    const double none = (double)NAN;
    *row = (result_row){.level = level, .number = {none, none, none, none, none, "1"}};
    clocale_vprint(row->name, sizeof row->name, name, list);
    return row;
}

result_row *rows_add_text(rows_source *s, int level, const char *text, const char *name, ...)
{
    va_list list;
    va_start(list, name);
    result_row *row = add_row(s, level, name, list);
    va_end(list);
    row->kind = RESULT_ROW_TEXT;
    snprintf(row->text, sizeof row->text, "%s", text);
    return row;
}

result_row *rows_add_number(rows_source *s, int level, row_number number, const char *name, ...)
{
    va_list list;
    va_start(list, name);
    result_row *row = add_row(s, level, name, list);
    va_end(list);
    row->number = number;
    return row;
}

result_row *rows_add_value(rows_source *s, int level, const result_value *value, const char *name)
{
    const char *unit = value->neutral == 0 ? "%" : value->number.unit;
    result_row *row = rows_add_number(
        s, level, rows_number(value->number.value, value->low, value->high, unit), "%s", name);
    row->number.range_low = value->range.low;
    row->number.range_high = value->range.high;
    rows_reason(row, "the interval includes", value->includes);
    rows_reason(row, "no error known of", value->lacks);
    rows_reason(row, "widest choice of the model", value->range.widest);
    return row;
}

result_row *rows_add_verdict(rows_source *s, int level, const char *verdict, const char *name)
{
    result_row *row = rows_add_text(s, level, "", "%s", name);
    const size_t n = length_without_reason(verdict);
    snprintf(row->text, sizeof row->text, "%.*s", (int)n, verdict);
    if (verdict[n] != '\0')
        rows_reason(row, name, verdict);
    return row;
}

void rows_note(result_row *row, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    clocale_vprint(row->note, sizeof row->note, format, list);
    va_end(list);
}

void rows_reason(result_row *row, const char *heading, const char *text)
{
    size_t i = 0;
    while (i < RESULT_ROW_REASONS && row->reasons[i].text != NULL)
        i++;
    if (text != NULL && text[0] != '\0' && i < RESULT_ROW_REASONS)
        row->reasons[i] = (result_row_reason){heading, text};
}

void rows_condition(rows_source *s, double value, const char *unit)
{
    char *heading = s->rows->heading;
    if (!isnan(value))
        clocale_append(heading, sizeof s->rows->heading, "%s%s", heading[0] != '\0' ? ", " : "",
                       rows_short(value, unit).value);
}

row_number rows_number(double value, double low, double high, const char *unit)
{
    const double none = (double)NAN;
    return (row_number){value, low, high, none, none, unit};
}

row_number rows_estimate(wt_estimate e)
{
    const double half = NORMAL_95 * e.standard_error;
    const bool known = half > 0 && isfinite(half);
    const double none = (double)NAN;
    return rows_number(e.value, known ? e.value - half : none, known ? e.value + half : none,
                       e.unit);
}

row_number rows_temperature(wt_estimate kelvin)
{
    row_number number = rows_estimate(kelvin);
    number.unit = "degC";
    return number;
}

double rows_plain_key(const char *text)
{
    double number = (double)NAN;
    if (text == NULL || !wt_number_parse(text, strlen(text), '.', &number))
        return (double)NAN;
    return number;
}

row_number_text rows_short(double value, const char *unit)
{
    const double none = (double)NAN;
    const row_number number = rows_number(value, none, none, unit);
    return row_number_format(&number);
}

bool rows_bind(const rows_source *s, const table_schema *schema, table_view *view)
{
    return table_bind_result(s->result, schema, "", view, NULL) == WT_OK && view->table != NULL;
}
