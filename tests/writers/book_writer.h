/* Writes spreadsheets of a few small sheets: .xlsx and .xls (BIFF in a compound file). The same
 * input gives the same bytes. The writer shares no code with the reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_BOOK_WRITER_H
#define TESTS_WRITERS_BOOK_WRITER_H

#include <stdbool.h>
#include <stddef.h>

/* A sheet is text: tabs separate cells, line ends separate rows. A cell that is a number becomes
 * one; an empty cell is omitted. */
typedef struct book_writer_sheet {
    const char *name, *text;
    bool hidden;
} book_writer_sheet;

/* Returns 0 or -1. The file is smaller than 60 kB; .xls has ASCII characters only. */
int xlsx_write(const char *path, const book_writer_sheet *sheets, size_t n, bool shared_strings);
/* Variants: plain BIFF8; BIFF8 with shared texts split over records and packed numbers; BIFF5 in
 * code page 1252 with every second cell a formula and the last cell first. */
typedef enum xls_way { XLS_PLAIN, XLS_SHARED, XLS_OLD } xls_way;
int xls_write(const char *path, xls_way way, const book_writer_sheet *sheets, size_t n);

#endif
