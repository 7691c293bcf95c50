/* Stores the sheets of a workbook as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "read/bytes/input.h"
#include "read/packed/packed.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define GZIP_PIECE ((size_t)1 << 18)

/* Maximum unpacked size, more than days of force curves; it stops an archive that is made to expand
 * without end [byte]. */
#define MAX_UNPACKED_SIZE ((uint64_t)8 << 30)

bool gzip_is_archive(const unsigned char *bytes, size_t length)
{
    return length >= 3 && bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == Z_DEFLATED;
}

typedef struct gzip_state {
    z_stream z;
    wt_input *input;
    size_t at, n;            /* next byte and size of the archive */
    unsigned char *in, *out; /* [PIECE] */
    spool content;
} gzip_state;

static wt_status fail_gzip(wt_error *err, const gzip_state *u, const char *code)
{
    wt_fail(err, WT_E_CORRUPT, "%s", code);
    wt_error_place(err, "gzip archive, after %zu bytes of its content", u->content.length);
    wt_error_advice(err, "copy the file again, or unpack it with gunzip and look at what comes");
    return WT_E_CORRUPT;
}

static wt_status read_packed_piece(gzip_state *u, wt_error *err)
{
    const size_t left = u->n - u->at, n = left < GZIP_PIECE ? left : GZIP_PIECE;
    if (u->z.avail_in > 0 || n == 0)
        return WT_OK;
    const wt_status status = wt_input_copy(u->input, u->at, u->in, n, err);
    u->at += n;
    u->z.next_in = u->in;
    u->z.avail_in = status == WT_OK ? (uInt)n : 0;
    return status;
}

/* Moves the unpacked bytes to the content. */
static wt_status store_piece(gzip_state *u, wt_error *err)
{
    const size_t n = GZIP_PIECE - u->z.avail_out;
    const wt_status status = spool_add(&u->content, u->out, n, wt_input_name(u->input), err);
    u->z.next_out = u->out;
    u->z.avail_out = (uInt)GZIP_PIECE;
    if (status == WT_OK && u->content.length > MAX_UNPACKED_SIZE)
        return fail_gzip(err, u, "the archive unpacks to more than 8 GiB");
    return status;
}

/* Ends a member; *more is true if another one follows. Zeros after the last member are padding;
 * other data are an error, since they would be lost. */
static wt_status finish_member(gzip_state *u, bool *more, wt_error *err)
{
    unsigned char head[3];
    size_t from = u->at - u->z.avail_in;
    const size_t n = u->n - from < sizeof head ? u->n - from : sizeof head;
    wt_status status = wt_input_copy(u->input, from, head, n, err);
    *more = status == WT_OK && gzip_is_archive(head, n);
    if (*more)
        return inflateReset(&u->z) == Z_OK ? WT_OK
                                           : fail_gzip(err, u, "the archive cannot be unpacked");
    while (status == WT_OK && from < u->n) {
        const size_t left = u->n - from, step = left < GZIP_PIECE ? left : GZIP_PIECE;
        status = wt_input_copy(u->input, from, u->in, step, err);
        for (size_t i = 0; status == WT_OK && i < step; i++)
            if (u->in[i] != 0)
                status = fail_gzip(err, u, "something else stands behind the archive");
        from += step;
    }
    return status;
}

/* Unpacks all members. */
static wt_status unpack_members(gzip_state *u, wt_error *err)
{
    bool more = true;
    wt_status status = WT_OK;
    u->z.next_out = u->out;
    u->z.avail_out = (uInt)GZIP_PIECE;
    while (status == WT_OK && more) {
        status = read_packed_piece(u, err);
        const bool at_end = u->at == u->n && u->z.avail_in == 0;
        const int code = status == WT_OK ? inflate(&u->z, Z_NO_FLUSH) : Z_OK;
        if (status == WT_OK && (u->z.avail_out == 0 || code == Z_STREAM_END))
            status = store_piece(u, err);
        if (status != WT_OK)
            break;
        if (code == Z_STREAM_END)
            status = finish_member(u, &more, err);
        else if (code == Z_MEM_ERROR)
            out_of_memory(GZIP_PIECE);
        else if (code == Z_BUF_ERROR && at_end)
            status = fail_gzip(err, u, "the end of the archive is missing");
        else if (code != Z_OK && code != Z_BUF_ERROR)
            status = fail_gzip(err, u, "the archive is damaged");
    }
    return status;
}

wt_status gzip_unpack(wt_input *input, wt_input **content, wt_error *err)
{
    gzip_state u = {.input = input};
    wt_status status = wt_input_size(input, &u.n, err);
    if (status != WT_OK)
        return status;
    u.in = wt_alloc(GZIP_PIECE, 1);
    u.out = wt_alloc(GZIP_PIECE, 1);
    /* 16 selects the gzip format alone */
    if (inflateInit2(&u.z, 16 + MAX_WBITS) != Z_OK)
        out_of_memory(GZIP_PIECE);
    status = unpack_members(&u, err);
    (void)inflateEnd(&u.z);
    free(u.in);
    free(u.out);
    if (status == WT_OK)
        return spool_to_input(&u.content, wt_input_name(input), content, err);
    spool_discard(&u.content);
    return status;
}

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
