/* Formats a number with its interval and its range over model choices for a table that people read.
 * This is the one place that decides about digits. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_ROW_NUMBER_H
#define WT_CORE_TABLE_ROW_NUMBER_H

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

#endif
