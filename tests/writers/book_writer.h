/* Writes spreadsheets, .xlsx and .xls (BIFF8 in a compound file), of a few small sheets. The same
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
    bool hidden; /* of .xlsx */
} book_writer_sheet;

/* 0, or -1. Below 60 kB, and no character beyond ASCII in .xls. */
int xlsx_write(const char *path, const book_writer_sheet *sheets, size_t n, bool shared_strings);
int xls_write(const char *path, const book_writer_sheet *sheets, size_t n);

#endif
