/* Numbers in headers of files, and the table of metadata that a reader fills for `info`. A number
 * that goes on behind its end ("1.234,5"), and two numbers that differ, are named and not used.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_HEADER_VALUES_H
#define WT_READ_HEADER_VALUES_H

#include "core/table/table_writer.h"
#include "weartrack/core.h"

typedef enum header_number {
    HEADER_NUMBER_NONE, /* the text does not begin with a number */
    HEADER_NUMBER_ONE,  /* or the same number twice, as in "512 512" */
    HEADER_NUMBER_GOES_ON,
    HEADER_NUMBER_DIFFER
} header_number;

/* Parses the number at the beginning of a text with the decimal mark, point or comma, that takes
 * more of the text. Returns its length, 0 without one. */
size_t header_number_parse(const char *text, size_t length, double *value);
/* Reads the number at the beginning of a value such as "0.25 N/m", after blanks, with a decimal
 * point or comma. *end is the length of the blanks and the number. *value is NaN unless there is
 * one number. */
header_number header_number_read(const char *text, size_t length, double *value, size_t *end);
/* Reads the error behind a number or its unit, as in "0.12 +- 0.01 N/m". Returns the length of the
 * mark and the error, 0 without one. */
size_t header_number_error(const char *text, size_t length, double *error);
/* Warns of a value that is more than one number, and of an error, which is not read. `place` is the
 * line, `name` what the number is and `option` the option that states it, or NULL. */
void header_number_warn(header_number found, const char *text, size_t length, const char *name,
                        const char *option, const char *file, const char *place, wt_log *log);
/* Returns the option that states a value of the cantilever; NULL for another quantity. */
const char *header_number_option(wt_quantity quantity);

/* Table of metadata. The writer keeps the first failure. */
/* Adds a row; the value is formatted as with printf. */
void metadata_add(table_writer *metadata, const char *item, const char *unit, const char *source,
                  const char *format, ...) WT_PRINTF(5, 6);
/* Adds a row with the text of a key of the file, unless it is NULL or empty. */
void metadata_add_text(table_writer *metadata, const char *item, const char *key, const char *text);
/* Adds a row with a number; NaN is written as "unknown". */
void metadata_add_number(table_writer *metadata, const char *item, double value, const char *unit,
                         const char *source);

#endif
