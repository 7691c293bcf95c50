/* Declares the output of force curves as text that the description weartrack-stream reads. It
 * serves readers that decode in the sandbox, which returns only text, and readers of tables
 * without names.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_CURVE_TEXT_H
#define WT_READ_CURVE_TEXT_H

#include "weartrack/core.h"

#include <stdio.h>

enum { CURVE_TEXT_COLUMNS = 8 };

typedef struct curve_text {
    size_t number;
    double x, y;              /* [m], NaN if unknown */
    wt_cantilever cantilever; /* NaN if unknown */
    struct {
        wt_quantity quantity; /* quantity of a force curve, in its SI unit */
        const double *values;
    } columns[CURVE_TEXT_COLUMNS];
    size_t n_columns;
} curve_text;

void curve_text_begin(FILE *out, const curve_text *curve);
/* Writes the names of the columns again, for rows with other columns. curve_text_begin writes the
 * first ones. */
void curve_text_names(FILE *out, const curve_text *curve);
/* Writes the rows [from, from + n); with `backwards` in reverse order. */
void curve_text_rows(FILE *out, const curve_text *curve, wt_segment_kind kind, size_t from,
                     size_t n, bool backwards);
void curve_text_end(FILE *out);

#endif
