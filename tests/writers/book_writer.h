/* Writes spreadsheets, .xlsx and .xls (BIFF in a compound file), of a few small sheets. The same
 * input gives the same bytes. Shares no code with the reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_WRITERS_BOOK_WRITER_H
#define TESTS_WRITERS_BOOK_WRITER_H

#include <stdbool.h>
#include <stddef.h>

/* A sheet is text: cells parted by tabs, rows by line ends; what is a number as a whole becomes
 * one, an empty cell is left out. */
typedef struct book_writer_sheet {
    const char *name, *text;
    bool hidden;
} book_writer_sheet;

/* 0, or -1. Below 60 kB, and no character beyond ASCII in .xls. */
int xlsx_write(const char *path, const book_writer_sheet *sheets, size_t n, bool shared_strings);
/* BIFF8 as plain as it can be; with the texts apart, parted by records, and packed numbers; BIFF5
 * with every second cell computed and the last cell first, whose texts are of code page 1252. */
typedef enum xls_way { XLS_PLAIN, XLS_SHARED, XLS_OLD } xls_way;
int xls_write(const char *path, xls_way way, const book_writer_sheet *sheets, size_t n);

#endif
