/* Parts of the rows of a result, by the kinds of tables, and how a part adds its rows. Only
 * result_row*.c add rows; captions and cards format numbers alike. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_RESULT_ROWS_PARTS_H
#define WT_CORE_TABLE_RESULT_ROWS_PARTS_H

#include "core/table/result_row.h"

typedef struct rows_source {
    const wt_result *result;
    result_value_tables values;
    result_rows *rows;
} rows_source;

/* Add a row; the name is a printf format. The row is valid until the next one is added. */
result_row *rows_add_text(rows_source *s, int level, const char *text, const char *name, ...)
    WT_PRINTF(4, 5);
result_row *rows_add_number(rows_source *s, int level, row_number number, const char *name, ...)
    WT_PRINTF(4, 5);
/* Variant for a result value, with its interval, range and what the interval includes. */
result_row *rows_add_value(rows_source *s, int level, const result_value *value, const char *name);
/* Variant for a verdict "no: the reason": the row has the word, its reasons the whole. */
result_row *rows_add_verdict(rows_source *s, listed_text verdict, const char *name);
void rows_note(result_row *row, const char *format, ...) WT_PRINTF(2, 3);
/* Adds a reason; no effect without a text. */
void rows_reason(result_row *row, const char *heading, const char *text);
/* Appends a condition of the whole result to the heading. */
void rows_condition(rows_source *s, double value, const char *unit);

row_number rows_number(double value, double low, double high, const char *unit);
/* Number of a key and of the two that follow it, which are the limits of its interval. */
row_number rows_of_keys(const table_view *view, unsigned key);
/* Number with the 95 % interval of a normal error, if the error is known. The lower limit of a
 * positive number is at least 0: none of them has a sign. */
row_number rows_estimate(wt_estimate estimate);
/* The same of a temperature, which is shown in degrees Celsius. */
row_number rows_temperature(wt_estimate kelvin);
/* Number of a key that is stored as text; NaN without one. */
double rows_plain_key(const char *text);
/* Text of a number without its limits. */
row_number_text rows_short(double value, const char *unit);

/* The parts of one schema; the view has a table. */
void rows_of_friction(rows_source *s);
void rows_of_layer(rows_source *s);
void rows_of_errors(rows_source *s);
void rows_of_records(rows_source *s);
void rows_of_collection(rows_source *s);

/* Binds a table of the result. False without such a table. */
bool rows_bind(const rows_source *s, const table_schema *schema, table_view *view);

#endif
