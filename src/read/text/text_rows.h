/* Rows of a table. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_ROWS_H
#define WT_READ_TEXT_ROWS_H

#include "read/text/text_scanner.h"

typedef enum row_quality {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, one is not */
    ROW_TEXT    /* no number where numbers belong */
} row_quality;

/* Splits the line into s->row and makes room for it in the table; false on failure. */
bool scan_split_row(text_scanner *s);
/* Reads the cells of s->row into the next row of the table; *bad is the first cell at fault. */
row_quality scan_read_row(text_scanner *s, size_t *bad);
/* Keeps the row that was read. */
void scan_add_row(text_scanner *s);
/* The place of a name in the list of samples, where it is put; NO_SAMPLE for a blank one, for
 * one too many, and on failure. */
size_t scan_sample(text_scanner *s, text_span name);
/* Fails for a row that cannot be read. */
void scan_bad_row(text_scanner *s, size_t bad);

#endif
