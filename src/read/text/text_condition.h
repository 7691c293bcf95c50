/* Declares the measurement conditions that a text states outside of columns: the temperature and
 * the frequency in a column name, in a line above a table or in the name of a sheet.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_CONDITION_H
#define WT_READ_TEXT_CONDITION_H

#include "read/description/description.h"

typedef struct text_condition {
    double temperature;       /* [K]; NaN if absent */
    double angular_frequency; /* [rad/s]; NaN if absent */
    bool is_sign_unclear;     /* true if the minus sign may be a hyphen, as in "E'-20 °C" */
} text_condition;

text_condition condition_none(void);
bool condition_is_empty(const text_condition *c);
/* True if both state the same values, or neither states them. */
bool condition_is_same(const text_condition *a, const text_condition *b);
/* Adds the values of `more` that `c` lacks. */
void condition_merge(text_condition *c, const text_condition *more);
/* Formats "20 degC", "1 Hz" or "20 degC, 1 Hz". */
void condition_format(const text_condition *c, char *text, size_t size);

/* Copies a text without the conditions in it: "E' 20 °C (MPa)" becomes "E' (MPa)". False if it
 * states none, or different ones of one quantity. */
bool condition_extract(text_span text, char rest[COLUMN_NAME_SIZE], text_condition *c);
/* The following functions set *c to no condition where they return false. */
/* True if a line or cell states conditions and nothing else, such as "Temperature: 20 °C",
 * "T (°C);20" or "Isotherm at 20 °C, 1 Hz". */
bool condition_read_line(text_span line, text_condition *c);
/* True if a title, such as the name of a sheet, states the temperature of the data: "SBR 20 °C".
 * It can contain other words, but none that names another temperature. */
bool condition_read_title(text_span title, text_condition *c);
/* True if a name matches the pattern of --temperature-in-name, which states the temperature. */
bool condition_match_name(const char *pattern, const char *name, text_condition *c);

#endif
