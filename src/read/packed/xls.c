/* Reads old Excel files: the records of BIFF5 and BIFF8 in a compound file ([MS-XLS]; OpenOffice's
 * documentation of the Excel file format for BIFF5).
 *
 * Instruments write variants that Excel does not, such as BIFF5 under the stream name of BIFF8.
 * Values are read as stored; a formula has the value that was saved with it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/text.h"
#include "read/bytes/bytes.h"
#include "read/packed/packed.h"

#include <errno.h>
#include <iconv.h>
#include <limits.h>
#include <stdlib.h>

#define MIB ((size_t)1 << 20)

bool xls_is_workbook(const unsigned char *bytes, size_t length)
{
    return compound_is_file(bytes, length);
}

enum {
    R_FORMULA = 0x0006,
    R_EOF = 0x000A,
    R_FILEPASS = 0x002F,
    R_CONTINUE = 0x003C,
    R_CODEPAGE = 0x0042,
    R_BOUNDSHEET = 0x0085,
    R_MULRK = 0x00BD,
    R_RSTRING = 0x00D6,
    R_SST = 0x00FC,
    R_LABELSST = 0x00FD,
    R_NUMBER = 0x0203,
    R_LABEL = 0x0204,
    R_BOOLERR = 0x0205,
    R_STRING = 0x0207,
    R_RK = 0x027E,
    R_BOF = 0x0809,
    BIFF5 = 0x0500,
    BIFF8 = 0x0600,
    CODEPAGE_USUAL = 1252
};

/* A text as a range of the pool. */
typedef struct xls_text {
    size_t at, length;
} xls_text;

typedef struct xls_cell {
    size_t row, column, order; /* order: index of the record */
    bool is_text;
    double number;
    xls_text text;
} xls_cell;

typedef struct xls_book {
    unsigned char *stream;
    size_t length;
    unsigned version, codepage;
    iconv_t narrow, wide;
    char *texts; /* UTF-8 */
    size_t pool_length, pool_reserved;
    xls_text *shared; /* [n_shared] */
    size_t n_shared;
    size_t pool_shared; /* part of pool_length with the shared strings */
    xls_cell *cells;    /* cells of the current sheet */
    size_t n_cells;
    size_t used; /* bytes of the stream that were read for sheets */
} xls_book;

static wt_status fail_workbook(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "%s", what);
    wt_error_advice(err, "copy the file again; or save it as .xlsx, CSV or text");
    return WT_E_CORRUPT;
}

/* ---- records --------------------------------------------------------------------------------- */

/* A record and its unread part. Reading continues in the CONTINUE records after it. */
typedef struct biff_record {
    const unsigned char *stream;
    size_t stream_length;
    unsigned id;
    size_t at, end; /* offsets in the stream */
} biff_record;

/* Reads the header of the record at `at`; false if it is incomplete. */
static bool read_record(const xls_book *book, size_t at, biff_record *r)
{
    *r = (biff_record){.stream = book->stream, .stream_length = book->length};
    if (at > book->length || book->length - at < 4)
        return false;
    r->id = le16(book->stream + at);
    r->at = at + 4;
    r->end = r->at + le16(book->stream + at + 2);
    return r->end <= book->length;
}

static size_t bytes_left(const biff_record *r)
{
    return r->end - r->at;
}

/* Moves to the next CONTINUE record; false if there is none. */
static bool next_continue_record(biff_record *r)
{
    if (r->stream_length - r->end < 4 || le16(r->stream + r->end) != R_CONTINUE)
        return false;
    const size_t n = le16(r->stream + r->end + 2);
    if (n > r->stream_length - r->end - 4)
        return false;
    r->at = r->end + 4;
    r->end = r->at + n;
    return true;
}

static bool skip_bytes(biff_record *r, size_t n)
{
    while (n > bytes_left(r)) {
        n -= bytes_left(r);
        if (!next_continue_record(r))
            return false;
    }
    r->at += n;
    return true;
}

/* Reads a number of up to 4 bytes, which is never split between records. */
static bool read_uint(biff_record *r, size_t width, uint32_t *value)
{
    if (bytes_left(r) == 0 && !next_continue_record(r))
        return false;
    if (bytes_left(r) < width)
        return false;
    *value = 0;
    for (size_t i = 0; i < width; i++)
        *value |= (uint32_t)r->stream[r->at + i] << (8 * i);
    r->at += width;
    return true;
}

/* ---- texts ----------------------------------------------------------------------------------- */

/* Reserves n bytes in the pool. A byte becomes at most 4 bytes of UTF-8 in any encoding. */
static void reserve_pool(xls_book *book, size_t n)
{
    if (book->pool_reserved - book->pool_length >= n)
        return;
    book->pool_reserved = 2 * (book->pool_reserved + n);
    book->texts = wt_realloc(book->texts, book->pool_reserved, 1);
}

/* Converts a text to UTF-8 in the pool; an invalid sequence becomes U+FFFD. */
static void pool_add(xls_book *book, iconv_t converter, const unsigned char *bytes, size_t n)
{
    static const char replacement[] = "\xef\xbf\xbd";
    char *in = (char *)(uintptr_t)bytes; /* iconv does not write to its input */
    size_t left = n;
    reserve_pool(book, 4 * n + 4);
    (void)iconv(converter, NULL, NULL, NULL, NULL);
    while (left > 0) {
        char *out = book->texts + book->pool_length;
        size_t space = book->pool_reserved - book->pool_length;
        const bool done = iconv(converter, &in, &left, &out, &space) != (size_t)-1;
        book->pool_length = book->pool_reserved - space;
        if (done || space < 4)
            break;
        memcpy(book->texts + book->pool_length, replacement, 3);
        book->pool_length += 3;
        const size_t unit = converter == book->wide && left >= 2 ? 2 : 1;
        in += unit;
        left -= unit;
    }
}

/* Reads n characters. Each continued record of BIFF8 states their width again. Returns false if
 * they are incomplete. */
static bool read_characters(xls_book *book, biff_record *r, size_t n, bool wide, xls_text *text)
{
    *text = (xls_text){.at = book->pool_length};
    while (n > 0) {
        const size_t width = wide ? 2 : 1, fit = bytes_left(r) / width, now = fit < n ? fit : n;
        if (now > 0)
            pool_add(book, wide ? book->wide : book->narrow, r->stream + r->at, now * width);
        r->at += now * width;
        n -= now;
        uint32_t flags = 0;
        if (n > 0 && (bytes_left(r) > 0 || !next_continue_record(r)))
            return false;
        if (n > 0 && book->version == BIFF8) {
            if (!read_uint(r, 1, &flags))
                return false;
            wide = (flags & 1) != 0;
        }
    }
    text->length = book->pool_length - text->at;
    return true;
}

/* Reads a text with its length (of `width` bytes) and, in BIFF8, its flags, as in cells and sheet
 * names. */
static wt_status read_counted_text(xls_book *book, biff_record *r, size_t width, xls_text *text,
                                   wt_error *err)
{
    uint32_t n = 0, flags = 0;
    return read_uint(r, width, &n) && (book->version != BIFF8 || read_uint(r, 1, &flags)) &&
                   read_characters(book, r, n, (flags & 1) != 0, text)
               ? WT_OK
               : fail_workbook("a text of the spreadsheet is cut off", err);
}

/* Reads the shared strings of BIFF8. Font runs and phonetic guides are skipped. */
static wt_status read_shared_strings(xls_book *book, biff_record *r, wt_error *err)
{
    uint32_t total = 0, n = 0;
    bool good = read_uint(r, 4, &total) && read_uint(r, 4, &n);
    for (uint32_t i = 0; i < n && good; i++) {
        uint32_t length = 0, flags = 0, runs = 0, phonetic = 0;
        xls_text text;
        good = read_uint(r, 2, &length) && read_uint(r, 1, &flags) &&
               ((flags & 8) == 0 || read_uint(r, 2, &runs)) &&
               ((flags & 4) == 0 || read_uint(r, 4, &phonetic)) &&
               read_characters(book, r, length, (flags & 1) != 0, &text) &&
               skip_bytes(r, 4 * (size_t)runs + phonetic);
        if (good) {
            book->shared = array_grow(book->shared, book->n_shared, sizeof text);
            book->shared[book->n_shared++] = text;
        }
    }
    return good ? WT_OK : fail_workbook("the texts of the spreadsheet are cut off", err);
}

/* ---- cells ----------------------------------------------------------------------------------- */

static void add_cell(xls_book *book, xls_cell cell)
{
    book->cells = array_grow(book->cells, book->n_cells, sizeof *book->cells);
    cell.order = book->n_cells;
    book->cells[book->n_cells++] = cell;
}

/* Decodes a number of 30 bits: an integer or the upper bits of a double, optionally divided by
 * 100. */
static double decode_packed_number(uint32_t rk)
{
    const double value = (rk & 2) != 0 ? (double)(signed32(rk & ~(uint32_t)3) / 4)
                                       : float64((uint64_t)(rk & ~(uint32_t)3) << 32);
    return (rk & 1) != 0 ? value / 100.0 : value;
}

static void add_packed_cells(xls_book *book, xls_cell cell, const unsigned char *at, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        cell.number = decode_packed_number(le32(at + 6 * i + 2));
        add_cell(book, cell);
        cell.column++;
    }
}

/* Adds the stored result of a formula. Returns true if a STRING record with the result follows. */
static bool add_formula(xls_book *book, xls_cell cell, const unsigned char *result)
{
    enum { RESULT_TEXT = 0, RESULT_BOOLEAN = 1 };
    const bool is_number = le16(result + 6) != 0xFFFF;
    cell.number = is_number ? float64(le64(result)) : result[2];
    if (is_number || result[0] == RESULT_BOOLEAN)
        add_cell(book, cell); /* else an error value, or an empty result */
    return !is_number && result[0] == RESULT_TEXT;
}

/* Returns the minimum size of a cell record without row, column and format; 0 for any other record
 * [byte]. */
static size_t min_cell_size(unsigned id)
{
    switch (id) {
    case R_NUMBER:
    case R_FORMULA:
        return 8;
    case R_RK:
    case R_LABELSST:
        return 4;
    case R_LABEL:
    case R_RSTRING:
    case R_BOOLERR:
    case R_MULRK:
        return 2;
    default:
        return 0;
    }
}

/* Reads a cell record. *formula is the cell whose text a STRING record contains; its row is
 * SIZE_MAX if there is none. */
static wt_status read_cell(xls_book *book, biff_record *r, xls_cell *formula, wt_error *err)
{
    const unsigned char *at = r->stream + r->at;
    const size_t need = min_cell_size(r->id);
    if (need > 0 && bytes_left(r) < 6 + need)
        return fail_workbook("a cell of the spreadsheet is cut off", err);
    xls_cell cell = {.row = 0};
    if (need > 0)
        cell = (xls_cell){.row = le16(at), .column = le16(at + 2)};
    switch (r->id) {
    case R_NUMBER:
        cell.number = float64(le64(at + 6));
        add_cell(book, cell);
        return WT_OK;
    case R_RK:
        add_packed_cells(book, cell, at + 4, 1);
        return WT_OK;
    case R_MULRK:
        add_packed_cells(book, cell, at + 4, (bytes_left(r) - 6) / 6);
        return WT_OK;
    case R_BOOLERR:
        cell.number = at[6];
        if (at[7] == 0)
            add_cell(book, cell);
        return WT_OK;
    case R_FORMULA:
        *formula = cell;
        formula->row = add_formula(book, cell, at + 6) ? cell.row : SIZE_MAX;
        return WT_OK;
    case R_LABELSST:
        if (le32(at + 6) >= book->n_shared)
            return fail_workbook("a cell names a text that is not there", err);
        cell.text = book->shared[le32(at + 6)];
        cell.is_text = true;
        add_cell(book, cell);
        return WT_OK;
    case R_LABEL:
    case R_RSTRING:
        r->at += 6;
        break;
    case R_STRING:
        if (formula->row == SIZE_MAX)
            return WT_OK;
        cell = *formula;
        formula->row = SIZE_MAX;
        break;
    default:
        return WT_OK;
    }
    cell.is_text = true;
    const wt_status status = read_counted_text(book, r, 2, &cell.text, err);
    if (status == WT_OK)
        add_cell(book, cell);
    return status;
}

static int compare_cell_positions(const void *a, const void *b)
{
    const xls_cell *x = a, *y = b;
    if (x->row != y->row)
        return x->row < y->row ? -1 : 1;
    if (x->column != y->column)
        return x->column < y->column ? -1 : 1;
    return x->order < y->order ? -1 : x->order > y->order;
}

static bool write_cell(const xls_book *book, const xls_cell *cell, sheet_text *text)
{
    char number[40];
    if (cell->is_text)
        return cell->text.length == 0 ||
               sheet_add_cell(text, cell->row, cell->column, book->texts + cell->text.at,
                              cell->text.length);
    int n = clocale_print(number, sizeof number, "%.15g", cell->number);
    if (strtod(number, NULL) < cell->number || strtod(number, NULL) > cell->number)
        n = clocale_print(number, sizeof number, "%.17g", cell->number);
    return sheet_add_cell(text, cell->row, cell->column, number, (size_t)n);
}

/* Writes the cells sorted by row and column, since not every program stores them so. Of two cells
 * at one position the later one counts, as in Excel. */
static wt_status write_cells(xls_book *book, const char *name, sheet_text *text, wt_error *err)
{
    bool space = true;
    if (book->n_cells > 1)
        qsort(book->cells, book->n_cells, sizeof *book->cells, compare_cell_positions);
    const locale_t previous = clocale_enter();
    for (size_t i = 0; i < book->n_cells && space; i++) {
        const xls_cell *cell = &book->cells[i], *next = cell + 1;
        const bool again =
            i + 1 < book->n_cells && next->row == cell->row && next->column == cell->column;
        space = again || write_cell(book, cell, text);
    }
    clocale_leave(previous);
    return space ? WT_OK : sheet_fail(name, err);
}

/* ---- sheets ---------------------------------------------------------------------------------- */

/* Reads the cells of the sheet at `at`. Embedded charts are nested sheets and are skipped. */
static wt_status read_sheet_cells(xls_book *book, size_t at, wt_error *err)
{
    biff_record r;
    size_t depth = 0;
    xls_cell formula = {.row = SIZE_MAX};
    wt_status status = WT_OK;
    free(book->cells);
    book->cells = NULL;
    book->n_cells = 0;
    book->pool_length = book->pool_shared;
    do {
        if (!read_record(book, at, &r) || (depth == 0 && r.id != R_BOF))
            return fail_workbook("a sheet of the spreadsheet is cut off", err);
        /* overlapping sheets would expand without end */
        book->used += r.end - at;
        if (book->used > book->length)
            return fail_workbook("sheets of the spreadsheet overlap", err);
        at = r.end;
        depth += r.id == R_BOF;
        if (depth == 1)
            status = read_cell(book, &r, &formula, err);
        depth -= r.id == R_EOF;
    } while (depth > 0 && status == WT_OK);
    return status;
}

/* Adds the sheet of a BOUNDSHEET record. Only worksheets have cells. */
static wt_status add_sheet(xls_book *book, biff_record *r, size_t max_length, workbook *made,
                           wt_error *err)
{
    uint32_t place = 0, hidden = 0, kind = 0;
    xls_text name;
    if (!read_uint(r, 4, &place) || !read_uint(r, 1, &hidden) || !read_uint(r, 1, &kind))
        return fail_workbook("a sheet of the spreadsheet has no place in it", err);
    wt_status status = read_counted_text(book, r, 1, &name, err);
    if (status != WT_OK || kind != 0)
        return status;
    char *copy = wt_strndup(name.length > 0 ? book->texts + name.at : "", name.length);
    sheet_text text = {.max_length = workbook_text_limit(made, max_length)};
    status = read_sheet_cells(book, place, err);
    if (status == WT_OK)
        status = write_cells(book, copy, &text, err);
    if (status == WT_OK)
        status = workbook_add(made, copy, (hidden & 3) != 0, &text, err);
    free(text.bytes);
    free(copy);
    return status;
}

/* Opens the converters. Narrow texts use the code page in BIFF5 and Latin-1 in BIFF8. An unknown
 * code page is read as Latin-1, since names and units are ASCII in all of them. */
static wt_status open_converters(xls_book *book, wt_error *err)
{
    char name[24] = "ISO-8859-1";
    if (book->version == BIFF5)
        (void)snprintf(name, sizeof name, "CP%u", book->codepage);
    if (book->narrow == (iconv_t)-1)
        book->narrow = iconv_open("UTF-8", name);
    if (book->narrow == (iconv_t)-1 && errno == EINVAL)
        book->narrow = iconv_open("UTF-8", "ISO-8859-1");
    if (book->wide == (iconv_t)-1)
        book->wide = iconv_open("UTF-8", "UTF-16LE");
    if (book->narrow != (iconv_t)-1 && book->wide != (iconv_t)-1)
        return WT_OK;
    return resource_error_fail(errno == EMFILE || errno == ENFILE ? errno : ENOMEM, err);
}

/* Reads the global records: first the encodings and shared strings (`made` is NULL), then the
 * sheets. */
static wt_status read_globals(xls_book *book, size_t max_length, workbook *made, wt_error *err)
{
    biff_record r;
    size_t at = 0;
    wt_status status = WT_OK;
    for (r.id = 0; r.id != R_EOF && status == WT_OK; at = r.end) {
        if (!read_record(book, at, &r))
            return fail_workbook("the spreadsheet is cut off", err);
        if (r.id == R_FILEPASS) {
            wt_fail(err, WT_E_UNSUPPORTED, "the spreadsheet is protected by a password");
            wt_error_advice(err, "save it without one");
            return WT_E_UNSUPPORTED;
        }
        if (r.id == R_CODEPAGE && bytes_left(&r) >= 2)
            book->codepage = le16(r.stream + r.at);
        if (r.id == R_SST && made == NULL)
            status = open_converters(book, err);
        if (r.id == R_SST && made == NULL && status == WT_OK)
            status = read_shared_strings(book, &r, err);
        if (r.id == R_BOUNDSHEET && made != NULL)
            status = add_sheet(book, &r, max_length, made, err);
    }
    if (made == NULL)
        book->pool_shared = book->pool_length;
    return status == WT_OK ? open_converters(book, err) : status;
}

static wt_status fail_unknown_book(const char *found, wt_error *err)
{
    wt_fail(err, WT_E_FORMAT, "no spreadsheet that can be read");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "save it as .xlsx, CSV or text");
    return WT_E_FORMAT;
}

static wt_status read_workbook(xls_book *book, size_t max_length, workbook *made, wt_error *err)
{
    biff_record r;
    if (!read_record(book, 0, &r) || r.id != R_BOF || bytes_left(&r) < 4)
        return fail_unknown_book("a stream that is no Excel file", err);
    book->version = le16(r.stream + r.at);
    if (book->version != BIFF5 && book->version != BIFF8)
        return fail_unknown_book("an Excel file from before 1993", err);
    wt_status status = read_globals(book, max_length, NULL, err);
    return status == WT_OK ? read_globals(book, max_length, made, err) : status;
}

static void close_converter(iconv_t converter)
{
    if (converter != (iconv_t)-1)
        (void)iconv_close(converter);
}

wt_status xls_read(wt_input *input, workbook *made, wt_error *err)
{
    /* a file with both versions has the newer one under the first name */
    static const char *const names[] = {"Workbook", "Book"};
    const unsigned char *bytes = NULL;
    size_t length = 0;
    xls_book book = {.codepage = CODEPAGE_USUAL, .narrow = (iconv_t)-1, .wide = (iconv_t)-1};
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = compound_read_stream(bytes, length, names, COUNT_OF(names), &book.stream,
                                      &book.length, err);
    if (status == WT_E_NOT_FOUND)
        status = fail_unknown_book("an old Office file without a spreadsheet", err);
    if (status == WT_OK)
        status = read_workbook(&book, 16 * MIB + 8 * length, made, err);
    close_converter(book.narrow);
    close_converter(book.wide);
    free(book.cells);
    free(book.shared);
    free(book.texts);
    free(book.stream);
    if (status != WT_OK)
        workbook_clear(made);
    return status;
}
