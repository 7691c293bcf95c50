/* Declares the reading of table rows. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_ROWS_H
#define WT_READ_TEXT_ROWS_H

#include "read/text/text_scanner.h"

typedef enum row_quality {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, at least one is not */
    ROW_TEXT,   /* no number in the columns that are read */
    ROW_UNUSED  /* the columns that are read are empty, as in rows of a waveform */
} row_quality;

/* Splits the line into s->row and reserves a row of the table; false on failure. */
bool scan_split_row(text_scanner *s);
/* Reads the cells of s->row into the next row of the table; *bad is the first invalid column. */
row_quality scan_read_row(text_scanner *s, size_t *bad);
/* Adds the row that was read to the table. */
void scan_add_row(text_scanner *s);
/* Returns the index of a name in the list of samples and adds it if necessary. NO_SAMPLE for a
 * blank name, a full list or a failure. */
size_t scan_find_sample(text_scanner *s, text_span name);
/* Fails for an unreadable row. */
void scan_fail_row(text_scanner *s, size_t bad);

#endif
