/* What stands in a packed file: the bytes of a gzip archive, the sheets of a spreadsheet as text.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PACKED_H
#define WT_READ_PACKED_H

#include "weartrack/read.h"

/* A sheet as text: a line for each row, with the number that it has there, cells parted by tabs. */
typedef struct book_sheet {
    char *name;
    char *text;
    size_t length;
    bool hidden;
} book_sheet;

typedef struct workbook {
    book_sheet *sheets;
    size_t n, length; /* length: of all texts */
} workbook;

/* No measurement fills so many sheets or so much text; a made file could. */
#define MOST_SHEETS ((size_t)1024)
#define MOST_TEXT ((size_t)1 << 30)

/* Bytes that begin as these do: at least PACKED_PEEK of them, if there are as many. */
#define PACKED_PEEK ((size_t)256)
bool gzip_is(const unsigned char *bytes, size_t length);
bool xlsx_is(const unsigned char *bytes, size_t length);
bool xls_is(const unsigned char *bytes, size_t length);

/* All members of the archive, to be closed. */
wt_status gzip_unpack(wt_input *input, wt_input **content, wt_error *err) WT_NODISCARD;
/* ECMA-376, part 1, 18. Charts have no rows and are left out. */
wt_status xlsx_read(wt_input *input, workbook *book, wt_error *err) WT_NODISCARD;
/* BIFF, behind the door (core/system/sandbox.h). */
wt_status xls_read(wt_input *input, workbook *book, wt_error *err) WT_NODISCARD;
void workbook_clear(workbook *book);

/* Text that grows up to `most` bytes; zero-initialised but for `most` is empty. */
typedef struct sheet_text {
    char *bytes;
    size_t length, room, most;
    size_t row, column; /* of the next cell, from 0 */
    bool no_memory;     /* else it is too long */
} sheet_text;
/* A cell of a row not above that of the last one; tabs and line ends in it become blanks. False if
 * there is no room for it. */
bool sheet_put(sheet_text *sheet, size_t row, size_t column, const char *text, size_t length);
/* The failure of a text without room. */
wt_status sheet_refuse(const sheet_text *sheet, const char *name, wt_error *err);
/* What a sheet may add to the book, and `usual` at most. */
size_t workbook_room(const workbook *book, size_t usual);
/* Takes over name (copied) and text. */
wt_status workbook_add(workbook *book, const char *name, bool hidden, sheet_text *text,
                       wt_error *err) WT_NODISCARD;

#endif
