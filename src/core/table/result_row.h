/* Rows of a result: its main numbers and verdicts, one list for every kind of result. The command
 * prints it as a table; it computes nothing. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_RESULT_ROW_H
#define WT_CORE_TABLE_RESULT_ROW_H

#include "core/table/finding.h"
#include "core/table/result_value.h"
#include "weartrack/core.h"

/* A number in SI units with the limits of its 95 % interval and of its range over model choices.
 * NaN: unknown. */
typedef struct row_number {
    double value, low, high, range_low, range_high;
    const char *unit; /* SI; "degC" for a temperature [K], "%" for a share or relative change */
} row_number;

/* ASCII texts, "" for limits that are unknown. The value has three significant digits or more, up
 * to two digits of a narrow interval. Limits of the scale of the value have its unit, which is then
 * not repeated: "7.98 MPa", "7.67 to 8.30". */
typedef struct row_number_text {
    char value[48], interval[80], range[80];
} row_number_text;

row_number_text row_number_format(const row_number *number);
/* SI unit of the numbers: "K" for "degC", "1" for "%". */
const char *row_number_unit(const row_number *number);
/* A ratio without a unit that has the neutral value 0 is a relative change, in percent. */
row_number row_number_of_value(const result_value *value);

typedef enum result_row_kind { RESULT_ROW_NUMBER, RESULT_ROW_TEXT } result_row_kind;

/* A whole text behind a row, such as the reason of a verdict; borrowed from the result or
 * the rows. */
typedef struct result_row_reason {
    const char *heading, *text;
} result_row_reason;
enum { RESULT_ROW_REASONS = 4 };

typedef struct result_row {
    char name[64]; /* of the quantity */
    int level;     /* 1: part of the row before that has level 0 */
    result_row_kind kind;
    row_number number; /* of RESULT_ROW_NUMBER */
    char text[64];     /* of RESULT_ROW_TEXT: a verdict or a count */
    char note[480];
    bool missing;                                  /* of an answer: its first reason says why */
    bool open;                                     /* a verdict that does not answer the question */
    result_row_reason reasons[RESULT_ROW_REASONS]; /* unused ones have no text */
} result_row;

typedef struct result_rows {
    char heading[160]; /* "0.3 m/s, 400 kPa, 30.0 degC", or "" */
    result_row *rows;
    size_t n;
    finding findings[FINDING_QUESTIONS]; /* of a result that has some */
} result_rows;

/* Subjects of rows, in the order of the rows of a result. The answers of validate and accuracy come
 * before the numbers that they are made of. */
typedef enum result_subject {
    SUBJECT_RECORDS,
    SUBJECT_ERRORS,
    SUBJECT_CURVES,
    SUBJECT_MATERIAL,
    SUBJECT_SURFACE,
    SUBJECT_FRICTION,
    SUBJECT_LAYER,
    SUBJECT_COLLECTION,
    RESULT_SUBJECTS
} result_subject;

/* Computes the rows of a result, which must exist as long as the rows. A table that lacks a
 * required column adds no row. */
void result_rows_compute(const wt_result *result, result_rows *rows);
/* Variant for one subject. */
void result_rows_of_subject(const wt_result *result, result_subject subject, result_rows *rows);
/* Variant with a row for each finding of the result and its number. False without findings. */
bool result_rows_of_findings(const wt_result *result, result_rows *rows);
void result_rows_clear(result_rows *rows);

#endif
