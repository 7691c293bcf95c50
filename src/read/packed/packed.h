/* Declares the unpacking of files: a gzip archive to bytes, the sheets of a spreadsheet to text.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_PACKED_H
#define WT_READ_PACKED_H

#include "weartrack/read.h"

/* A sheet as text: a line for each row with the same row number, cells separated by tabs. */
typedef struct book_sheet {
    char *name;
    char *text;
    size_t length;
    bool hidden;
} book_sheet;

typedef struct workbook {
    book_sheet *sheets;
    size_t n, length; /* number of sheets; size of all texts */
} workbook;

/* Limits on sheets and text, above any measurement, against files made to exhaust memory. */
#define MAX_SHEETS ((size_t)1024)
#define MAX_WORKBOOK_TEXT ((size_t)1 << 30)

/* True if the bytes begin such a file. `bytes` has at least PACKED_PEEK bytes, or the whole
 * file. */
#define PACKED_PEEK ((size_t)256)
bool gzip_is_archive(const unsigned char *bytes, size_t length);
bool xlsx_is_workbook(const unsigned char *bytes, size_t length);
bool xls_is_workbook(const unsigned char *bytes, size_t length);

/* Unpacks all members of an archive; the caller closes *content. */
wt_status gzip_unpack(wt_input *input, wt_input **content, wt_error *err) WT_NODISCARD;
/* Reads an .xlsx workbook (ECMA-376, part 1, 18). Charts have no rows and are skipped. */
wt_status xlsx_read(wt_input *input, workbook *book, wt_error *err) WT_NODISCARD;
/* Reads an .xls workbook (BIFF). */
wt_status xls_read(wt_input *input, workbook *book, wt_error *err) WT_NODISCARD;
void workbook_clear(workbook *book);

/* ---- compound files (OLE2), the container of streams in old Office files: [MS-CFB], versions 3
 * and 4 ----
 */

bool compound_is_file(const unsigned char *bytes, size_t length);

/* Reads the first stream of the root folder that has one of the names, in their order, without
 * regard to the case of ASCII letters. The caller frees *stream. Returns WT_E_NOT_FOUND without a
 * message if there is none, WT_E_CORRUPT if the file is damaged or truncated. */
wt_status compound_read_stream(const unsigned char *bytes, size_t length, const char *const *names,
                               size_t n_names, unsigned char **stream, size_t *n,
                               wt_error *err) WT_NODISCARD;

/* A text that grows up to its maximum length; it is empty if all other members are zero. */
typedef struct sheet_text {
    char *bytes;
    size_t length, capacity, max_length;
    size_t row, column; /* position of the next cell, from 0 */
} sheet_text;
/* Adds a cell at or below the last row; tabs and line ends in it become blanks. False if it does
 * not fit. */
bool sheet_add_cell(sheet_text *sheet, size_t row, size_t column, const char *text, size_t length);
/* Returns the failure of a text that does not fit. */
wt_status sheet_fail(const char *name, wt_error *err);
/* Returns the maximum text of the next sheet, `usual` at most. */
size_t workbook_text_limit(const workbook *book, size_t usual);
/* Adds a sheet: the name is copied, and the book takes ownership of the text. */
wt_status workbook_add(workbook *book, const char *name, bool hidden, sheet_text *text,
                       wt_error *err) WT_NODISCARD;

#endif
