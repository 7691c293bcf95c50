/* Macros for the rows of the column and key lists. They expand to members of a schema_field. The
 * including file defines SHOWS(member). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_FIELD_MACROS_H
#define WT_CORE_TABLE_FIELD_MACROS_H

#include "core/table/schema.h"

/* Macros for a row of a list. */
/* AS replaces the name of a column by that of the member; IN does so for a member of a nested
 * structure. */
#define AS(own) SHOWS(own), .name = #own
#define IN(part, own) SHOWS(part.own), .name = #own
#define NUMBER .quantity = WT_Q_NONE
#define SI(q) .quantity = WT_Q_##q
#define UNIT(words) .unit = words
#define TEXT .kind = SCHEMA_TEXT
#define ENUM(name) .kind = SCHEMA_TEXT, .list = &name##_list
#define PLAIN .kind = SCHEMA_PLAIN
#define YES_NO .yes_no = true
#define LABEL(words) .label = words
#define HEADLINE(words) .headline = words
#define STANDARD_ERROR(id) .standard_error = id##_STANDARD_ERROR
#define NUMERICAL_ERROR(id) .numerical_error = id##_NUMERICAL_ERROR
#define BOTH_ERRORS(id) STANDARD_ERROR(id), NUMERICAL_ERROR(id)
#define INTERVAL(low_end, high_end) .low = low_end, .high = high_end
#define LIKE(column) .like = column
#define MISSING(words) .missing = words
#define DIGITS(n) .digits = n
#define DECIMALS(n) .decimals = n
#define SPARSE .sparse = true
#define PRECISION(n) .precision = n
#define OPTIONAL .optional = true

#define COLUMN(id, ...) {__VA_ARGS__},
#define KEY(id, ...) {__VA_ARGS__},

#endif
