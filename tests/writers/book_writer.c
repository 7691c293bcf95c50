/* Spreadsheets for tests. SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/book_writer.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

/* ---- cells of a sheet's text ----------------------------------------------------------------- */

typedef struct cell {
    size_t row, column;
    const char *text;
    size_t length;
    bool is_number;
    double number;
} cell;

/* Returns the next non-empty cell; *at is the start of the next search. */
static bool next_cell(const char **at, cell *c)
{
    for (; **at != '\0'; (*at)++) {
        if (**at == '\n') {
            c->row++;
            c->column = 0;
        } else if (**at == '\t') {
            c->column++;
        } else {
            char copy[400], *end = NULL;
            c->text = *at;
            c->length = strcspn(*at, "\t\n");
            *at += c->length;
            snprintf(copy, sizeof copy, "%.*s", (int)c->length, c->text);
            c->number = strtod(copy, &end);
            c->is_number = *end == '\0';
            return true;
        }
    }
    return false;
}

/* ---- .xlsx ----------------------------------------------------------------------------------- */

#define HEAD "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
#define MAIN "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\""
#define RELATIONS "http://schemas.openxmlformats.org/officeDocument/2006/relationships"

static void put_escaped(FILE *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '<')
            fputs("&lt;", out);
        else if (text[i] == '&')
            fputs("&amp;", out);
        else if (text[i] == '"')
            fputs("&quot;", out);
        else
            fputc(text[i], out);
    }
}

static void put_sheet(FILE *out, const char *text, FILE *strings, size_t *n_strings)
{
    cell c = {.row = 0};
    size_t row = SIZE_MAX;
    fputs(HEAD "<worksheet " MAIN "><sheetData>", out);
    while (next_cell(&text, &c)) {
        if (c.row != row)
            fprintf(out, "%s<row r=\"%zu\">", row != SIZE_MAX ? "</row>" : "", c.row + 1);
        row = c.row;
        fprintf(out, "<c r=\"%c%zu\"", (char)('A' + c.column), c.row + 1);
        if (c.is_number) {
            fprintf(out, "><v>%.*s</v></c>", (int)c.length, c.text);
        } else if (strings != NULL) {
            fprintf(out, " t=\"s\"><v>%zu</v></c>", (*n_strings)++);
            fputs("<si><t>", strings);
            put_escaped(strings, c.text, c.length);
            fputs("</t></si>", strings);
        } else {
            fputs(" t=\"inlineStr\"><is><t>", out);
            put_escaped(out, c.text, c.length);
            fputs("</t></is></c>", out);
        }
    }
    fprintf(out, "%s</sheetData></worksheet>", row != SIZE_MAX ? "</row>" : "");
}

static int add_part(zip_t *zip, const char *name, char *bytes, size_t length)
{
    zip_source_t *source = zip_source_buffer(zip, bytes, length, 1); /* freed by libzip */
    const zip_int64_t i = source != NULL ? zip_file_add(zip, name, source, ZIP_FL_ENC_UTF_8) : -1;
    if (i < 0)
        return -1;
    return zip_set_file_compression(zip, (zip_uint64_t)i, ZIP_CM_STORE, 0) == 0 &&
                   zip_file_set_dostime(zip, (zip_uint64_t)i, 0, 0x5021, 0) == 0
               ? 0
               : -1;
}

static int put_books(zip_t *zip, const book_writer_sheet *sheets, size_t n)
{
    char *book = NULL, *relations = NULL;
    size_t n_book = 0, n_relations = 0;
    FILE *b = open_memstream(&book, &n_book), *r = open_memstream(&relations, &n_relations);
    if (b == NULL || r == NULL)
        return -1;
    fputs(HEAD "<workbook " MAIN " xmlns:r=\"" RELATIONS "\"><sheets>", b);
    fputs(HEAD "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/"
               "relationships\">",
          r);
    for (size_t i = 0; i < n; i++) {
        fprintf(b, "<sheet name=\"%s\" sheetId=\"%zu\"%s r:id=\"rId%zu\"/>", sheets[i].name, i + 1,
                sheets[i].hidden ? " state=\"hidden\"" : "", i + 1);
        fprintf(r,
                "<Relationship Id=\"rId%zu\" Type=\"" RELATIONS
                "/worksheet\" Target=\"worksheets/sheet%zu.xml\"/>",
                i + 1, i + 1);
    }
    fputs("</sheets></workbook>", b);
    fputs("</Relationships>", r);
    if (fclose(b) != 0 || fclose(r) != 0)
        return -1;
    return add_part(zip, "xl/workbook.xml", book, n_book) == 0 &&
                   add_part(zip, "xl/_rels/workbook.xml.rels", relations, n_relations) == 0
               ? 0
               : -1;
}

int xlsx_write(const char *path, const book_writer_sheet *sheets, size_t n, bool shared_strings)
{
    char *strings = NULL;
    size_t n_bytes = 0, n_strings = 0;
    FILE *s = open_memstream(&strings, &n_bytes);
    zip_t *zip = zip_open(path, ZIP_CREATE | ZIP_TRUNCATE, NULL);
    if (s == NULL || zip == NULL)
        return -1;
    fputs(HEAD "<sst " MAIN ">", s);
    int bad = put_books(zip, sheets, n);
    for (size_t i = 0; i < n; i++) {
        char *bytes = NULL, name[64];
        size_t length = 0;
        FILE *out = open_memstream(&bytes, &length);
        if (out == NULL)
            return -1;
        put_sheet(out, sheets[i].text, shared_strings ? s : NULL, &n_strings);
        snprintf(name, sizeof name, "xl/worksheets/sheet%zu.xml", i + 1);
        bad |= fclose(out) != 0 || add_part(zip, name, bytes, length) != 0;
    }
    fputs("</sst>", s);
    bad |= fclose(s) != 0;
    if (shared_strings)
        bad |= add_part(zip, "xl/sharedStrings.xml", strings, n_bytes) != 0;
    else
        free(strings);
    return zip_close(zip) == 0 && !bad ? 0 : -1;
}

/* ---- .xls: [MS-XLS] in [MS-CFB] -------------------------------------------------------------- */

enum { SECTOR = 512, FAT_SECTORS = 128, MOST = SECTOR * (FAT_SECTORS - 3) };

typedef struct bytes {
    uint8_t data[MOST];
    size_t n;
} bytes;

static void put(uint8_t *to, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        to[i] = (uint8_t)(value >> (8 * i) & 0xff);
}

static uint8_t *record(bytes *b, unsigned id, size_t length)
{
    if (b->n + 4 + length > MOST)
        abort();
    uint8_t *at = b->data + b->n;
    put(at, id, 2);
    put(at + 2, length, 2);
    b->n += 4 + length;
    return at + 4;
}

static void put_bof(bytes *b, xls_way way, unsigned kind)
{
    uint8_t *at = record(b, 0x0809, way == XLS_OLD ? 8 : 16);
    put(at, way == XLS_OLD ? 0x0500 : 0x0600, 2);
    put(at + 2, kind, 2);
    put(at + 4, 0x0dbb07cc, 4);
    if (way == XLS_OLD)
        return;
    put(at + 8, 0x00000041, 4);
    put(at + 12, 6, 4);
}

static void put_length(uint8_t *to, const cell *c, xls_way way)
{
    put(to, c->length, 2);
    memcpy(to + (way == XLS_OLD ? 2 : 3), c->text, c->length);
}

/* Upper bits of a number whose other bits are zero, or an integer in hundredths. */
static bool pack_number(double x, uint32_t *packed)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    *packed = (uint32_t)(bits >> 32);
    if ((bits & 0x3ffffffff) == 0)
        return true;
    const int hundredths = x > 0 && x < 1e6 ? (int)(100 * x + 0.5) : 0;
    *packed = (uint32_t)hundredths << 2 | 3;
    return hundredths > 0 && !(hundredths / 100.0 < x) && !(hundredths / 100.0 > x);
}

/* Writes one cell; `shared` is the number of earlier texts. */
static void put_cell(bytes *b, xls_way way, const cell *c, size_t shared)
{
    const size_t flag = way == XLS_OLD ? 0 : 1;
    const bool computed = way == XLS_OLD && (c->row + c->column) % 2 == 1;
    uint32_t packed = 0;
    uint8_t *to = NULL;
    if (c->is_number && way == XLS_SHARED && pack_number(c->number, &packed)) {
        to = record(b, 0x00bd, 12); /* several packed numbers: one record, and the last column */
        put(to + 6, packed, 4);
        put(to + 10, c->column, 2);
    } else if (c->is_number) {
        uint64_t bits;
        memcpy(&bits, &c->number, sizeof bits);
        to = computed ? record(b, 0x0006, 22) : record(b, 0x0203, 14);
        put(to + 6, bits, 8);
    } else if (way == XLS_SHARED) {
        to = record(b, 0x00fd, 10);
        put(to + 6, shared, 4);
    } else if (computed) {
        to = record(b, 0x0006, 22);
        put(to + 12, 0xffff, 2);
        put_length(record(b, 0x0207, 2 + flag + c->length), c, way);
    } else {
        to = record(b, 0x0204, 8 + flag + c->length);
        put_length(to + 6, c, way);
    }
    put(to, c->row, 2);
    put(to + 2, c->column, 2);
}

static void put_cells(bytes *b, xls_way way, const char *text, size_t *shared)
{
    cell cells[400] = {{.row = 0}};
    cell c = {.row = 0};
    size_t n = 0;
    while (next_cell(&text, &c)) {
        if (n == sizeof cells / sizeof *cells)
            abort();
        cells[n++] = c;
    }
    for (size_t i = 0; i < n; i++) { /* The old program writes its sheets from the last row. */
        const cell *now = &cells[way == XLS_OLD ? n - 1 - i : i];
        put_cell(b, way, now, *shared);
        *shared += !now->is_number;
    }
}

/* Texts of all sheets. Each begins in one record and ends in the next, which uses two bytes per
 * character. */
static void put_shared(bytes *b, const book_writer_sheet *sheets, size_t n)
{
    uint8_t *to = record(b, 0x00fc, 8);
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        const char *text = sheets[i].text;
        cell c = {.row = 0};
        while (next_cell(&text, &c)) {
            if (c.is_number)
                continue;
            const size_t first = c.length / 2, rest = c.length - first;
            uint8_t *at = record(b, 0x003c, 5 + first); /* with two font runs */
            put(at, c.length, 2);
            at[2] = 8;
            put(at + 3, 2, 2);
            memcpy(at + 5, c.text, first);
            at = record(b, 0x003c, 1 + 2 * rest + 3);
            at[0] = 1;
            for (size_t k = 0; k < rest; k++)
                put(at + 1 + 2 * k, (uint8_t)c.text[first + k], 2);
            (void)record(b, 0x003c, 5);
            count++;
        }
    }
    put(to, count, 4);
    put(to + 4, count, 4);
}

static void put_stream(bytes *b, xls_way way, const book_writer_sheet *sheets, size_t n)
{
    size_t place[16], shared = 0;
    const size_t flag = way == XLS_OLD ? 0 : 1;
    put_bof(b, way, 5);
    put(record(b, 0x0042, 2), way == XLS_OLD ? 1252 : 1200, 2); /* code page */
    for (size_t i = 0; i < n; i++) {
        const size_t length = strlen(sheets[i].name);
        uint8_t *to = record(b, 0x0085, 7 + flag + length);
        place[i] = (size_t)(to - b->data);
        to[4] = sheets[i].hidden;
        to[6] = (uint8_t)length;
        memcpy(to + 7 + flag, sheets[i].name, length);
    }
    if (way == XLS_SHARED)
        put_shared(b, sheets, n);
    (void)record(b, 0x000a, 0);
    for (size_t i = 0; i < n; i++) {
        put(b->data + place[i], b->n, 4);
        put_bof(b, way, 0x10);
        put_bof(b, way, 0x20); /* a chart in the sheet, with a number that is not a cell */
        memset(record(b, 0x0203, 14), 0, 14);
        (void)record(b, 0x000a, 0);
        put_cells(b, way, sheets[i].text, &shared);
        (void)record(b, 0x000a, 0);
    }
}

static void put_entry(uint8_t *to, const char *name, unsigned kind, unsigned child, unsigned start,
                      size_t size)
{
    const size_t length = strlen(name);
    for (size_t i = 0; i < length; i++)
        to[2 * i] = (uint8_t)name[i];
    put(to + 64, 2 * (length + 1), 2);
    to[66] = (uint8_t)kind;
    to[67] = 1;
    put(to + 68, 0xffffffff, 4);
    put(to + 72, 0xffffffff, 4);
    put(to + 76, child, 4);
    put(to + 116, start, 4);
    put(to + 120, size, 8);
}

static void put_chain(uint8_t *table, size_t first, size_t n)
{
    for (size_t i = first; i < first + n; i++)
        put(table + 4 * i, i + 1 < first + n ? i + 1 : 0xfffffffe, 4);
}

/* Sectors: table, directory, table of small sectors, the stream. A stream below 4096 bytes uses
 * small sectors, which are the stream of the root. */
int xls_write(const char *path, xls_way way, const book_writer_sheet *sheets, size_t n)
{
    static const uint8_t signature[8] = {0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1};
    static bytes b;
    uint8_t head[SECTOR] = {0}, fat[SECTOR], folder[SECTOR] = {0}, small[SECTOR];
    memset(&b, 0, sizeof b);
    if (n > 16)
        return -1;
    put_stream(&b, way, sheets, n);
    const bool is_small = b.n < 4096;
    const size_t sectors = (b.n + SECTOR - 1) / SECTOR;
    memcpy(head, signature, sizeof signature);
    put(head + 24, 0x003e, 2);
    put(head + 26, 3, 2);
    put(head + 28, 0xfffe, 2);
    put(head + 30, 9, 2); /* 2^9 bytes per sector */
    put(head + 32, 6, 2);
    put(head + 44, 1, 4); /* number of FAT sectors */
    put(head + 48, 1, 4); /* The directory is sector 1. */
    put(head + 56, 4096, 4);
    put(head + 60, 2, 4);
    put(head + 64, 1, 4);
    put(head + 68, 0xfffffffe, 4);
    memset(head + 76, 0xff, SECTOR - 76);
    put(head + 76, 0, 4); /* The FAT is sector 0. */
    memset(fat, 0xff, sizeof fat);
    memset(small, 0xff, sizeof small);
    put(fat, 0xfffffffd, 4);
    put_chain(fat, 1, 1);
    put_chain(fat, 2, 1);
    put_chain(fat, 3, sectors);
    if (is_small)
        put_chain(small, 0, (b.n + 63) / 64);
    put_entry(folder, "Root Entry", 5, 1, is_small ? 3 : 0xfffffffe, is_small ? b.n : 0);
    put_entry(folder + 128, "Workbook", 2, 0xffffffff, is_small ? 0 : 3, b.n);
    FILE *out = fopen(path, "wb");
    if (out == NULL)
        return -1;
    const bool good = fwrite(head, sizeof head, 1, out) == 1 &&
                      fwrite(fat, sizeof fat, 1, out) == 1 &&
                      fwrite(folder, sizeof folder, 1, out) == 1 &&
                      fwrite(small, sizeof small, 1, out) == 1 && fwrite(b.data, b.n, 1, out) == 1;
    return fclose(out) == 0 && good ? 0 : -1;
}
