/* Stores the sheets of a workbook as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/packed/packed.h"

#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

#define FIRST_CAPACITY ((size_t)4096)

static bool reserve_text(sheet_text *sheet, size_t n)
{
    if (n > sheet->max_length - sheet->length)
        return false;
    size_t capacity = sheet->capacity > 0 ? sheet->capacity : FIRST_CAPACITY;
    while (capacity < sheet->length + n)
        capacity *= 2;
    if (capacity == sheet->capacity)
        return true;
    sheet->bytes = wt_realloc(sheet->bytes, capacity, 1);
    sheet->capacity = capacity;
    return true;
}

static bool append_marks(sheet_text *sheet, char mark, size_t n)
{
    if (!reserve_text(sheet, n))
        return false;
    if (n > 0)
        memset(sheet->bytes + sheet->length, mark, n);
    sheet->length += n;
    return true;
}

bool sheet_add_cell(sheet_text *sheet, size_t row, size_t column, const char *text, size_t length)
{
    if (row > sheet->row) {
        if (!append_marks(sheet, '\n', row - sheet->row))
            return false;
        sheet->row = row;
        sheet->column = 0;
    }
    if (column > sheet->column) {
        if (!append_marks(sheet, '\t', column - sheet->column))
            return false;
        sheet->column = column;
    }
    if (!reserve_text(sheet, length))
        return false;
    char *to = sheet->bytes + sheet->length;
    for (size_t i = 0; i < length; i++)
        to[i] = text[i];
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)to[i] < 0x20)
            to[i] = ' ';
    sheet->length += length;
    return true;
}

wt_status sheet_fail(const char *name, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "a sheet gives more text than a file of this size can hold");
    wt_error_place(err, "sheet %s", name);
    wt_error_advice(err, "save the sheet as CSV");
    return WT_E_CORRUPT;
}

size_t workbook_text_limit(const workbook *book, size_t usual)
{
    const size_t left = MAX_WORKBOOK_TEXT - book->length;
    return usual < left ? usual : left;
}

wt_status workbook_add(workbook *book, const char *name, bool hidden, sheet_text *text,
                       wt_error *err)
{
    if (book->n >= MAX_SHEETS) {
        wt_fail(err, WT_E_UNSUPPORTED, "the spreadsheet has more than %zu sheets", MAX_SHEETS);
        wt_error_advice(err, "save the sheet with the data as CSV");
        return WT_E_UNSUPPORTED;
    }
    if (!append_marks(text, '\n', 1))
        return sheet_fail(name, err);
    book->sheets = array_grow(book->sheets, book->n, sizeof *book->sheets);
    book->sheets[book->n++] = (book_sheet){
        .name = wt_strdup(name), .text = text->bytes, .length = text->length, .hidden = hidden};
    book->length += text->length;
    *text = (sheet_text){.bytes = NULL};
    return WT_OK;
}

void workbook_clear(workbook *book)
{
    for (size_t i = 0; i < book->n; i++) {
        free(book->sheets[i].name);
        free(book->sheets[i].text);
    }
    free(book->sheets);
    *book = (workbook){.sheets = NULL};
}
