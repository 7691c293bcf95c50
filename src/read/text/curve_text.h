/* Force curves as the text that the description weartrack-stream reads: for readers whose curves
 * are decoded where nothing but text comes back from, or whose file is a table without names.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_CURVE_TEXT_H
#define WT_READ_CURVE_TEXT_H

#include "weartrack/data.h"

#include <stdio.h>

enum { CURVE_TEXT_COLUMNS = 8 };

typedef struct curve_text {
    size_t number;
    double x, y;              /* [m], NaN if unknown */
    wt_cantilever cantilever; /* NaN if unknown */
    struct {
        wt_quantity quantity; /* one that a force curve has, in its SI unit */
        const double *values;
    } columns[CURVE_TEXT_COLUMNS];
    size_t n_columns;
} curve_text;

void curve_text_begin(FILE *out, const curve_text *curve);
/* The names of the columns, which curve_text_begin has written, once more: those that follow are
 * others. */
void curve_text_names(FILE *out, const curve_text *curve);
/* Rows [from, from + n) of the columns; backwards, the last of them first. */
void curve_text_rows(FILE *out, const curve_text *curve, wt_segment_kind kind, size_t from,
                     size_t n, bool backwards);
void curve_text_end(FILE *out);

#endif
