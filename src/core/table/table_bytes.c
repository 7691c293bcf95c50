/* Encodes tables as bytes. A number has 8 bytes in little-endian order; a text ends with a zero
 * byte. The order is: name and title; number of keys, and for each key its name, then 1 with value,
 * errors and unit of an estimate, or 0 with a text; number of columns, and for each column its
 * name, 1 for text or 0, unit and long name; numbers of rows and blocks, and the first row of each
 * block; the cells by column. SPDX-License-Identifier: GPL-3.0-or-later */

#include "core/base/memory.h"
#include "core/table/table.h"

#include <endian.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* ---- encoding -------------------------------------------------------------------------------- */

static void encode_count(FILE *out, uint64_t n)
{
    const uint64_t low_first = htole64(n);
    (void)fwrite(&low_first, sizeof low_first, 1, out);
}

static void encode_text(FILE *out, const char *text)
{
    (void)fwrite(text, 1, strlen(text) + 1, out);
}

static void encode_numbers(FILE *out, const double *numbers, size_t n)
{
    uint64_t piece[256];
    for (size_t from = 0; from < n;) {
        const size_t many = n - from < 256 ? n - from : 256;
        memcpy(piece, numbers + from, many * sizeof *piece);
        for (size_t i = 0; i < many; i++)
            piece[i] = htole64(piece[i]);
        (void)fwrite(piece, sizeof *piece, many, out);
        from += many;
    }
}

static void encode_keys(FILE *out, const wt_table *table)
{
    encode_count(out, table->n_keys);
    for (size_t i = 0; i < table->n_keys; i++) {
        const table_key *const key = &table->keys[i];
        const wt_estimate *const e = &key->parsed;
        encode_text(out, key->name);
        encode_count(out, key->is_estimate);
        if (key->is_estimate)
            encode_numbers(out, (double[]){e->value, e->standard_error, e->numerical_error}, 3);
        encode_text(out, key->is_estimate ? key->unit : key->text);
    }
}

static void encode_columns(FILE *out, const wt_table *table)
{
    encode_count(out, table->n_columns);
    for (size_t i = 0; i < table->n_columns; i++) {
        const table_column *const column = &table->columns[i];
        encode_text(out, column->name);
        encode_count(out, column->kind == WT_COLUMN_TEXT);
        encode_text(out, column->unit);
        encode_text(out, column->long_name);
    }
    /* The last block may be empty. */
    size_t n_blocks = table->n_blocks;
    n_blocks -= n_blocks > 0 && table->blocks[n_blocks - 1] == table->n_rows;
    encode_count(out, table->n_rows);
    encode_count(out, n_blocks);
    for (size_t i = 0; i < n_blocks; i++)
        encode_count(out, table->blocks[i]);
    for (size_t i = 0; i < table->n_columns; i++) {
        if (table->columns[i].kind == WT_COLUMN_NUMBER)
            encode_numbers(out, table->columns[i].numbers, table->n_rows);
        for (size_t row = 0; table->columns[i].kind == WT_COLUMN_TEXT && row < table->n_rows; row++)
            encode_text(out, wt_table_text(table, row, i));
    }
}

wt_status table_bytes_write(FILE *out, const wt_table *table, wt_error *err)
{
    if (!table_name_is_valid(table->name) || table->n_columns == 0)
        return wt_fail(err, WT_E_ARG, "table \"%s\" has no columns or no valid name", table->name);
    encode_text(out, table->name);
    encode_text(out, table->title);
    encode_keys(out, table);
    encode_columns(out, table);
    return ferror(out) ? wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno)) : WT_OK;
}

wt_status table_bytes_digest(const wt_table *table, char hex[65], wt_error *err)
{
    char *bytes = NULL;
    size_t length = 0;
    FILE *const out = text_stream_open(&bytes, &length);
    const wt_status status = table_bytes_write(out, table, err);
    text_stream_close(out);
    if (status == WT_OK)
        wt_sha256(bytes, length, hex);
    free(bytes);
    return status;
}

/* ---- decoding -------------------------------------------------------------------------------- */

typedef struct byte_reader {
    const char *at, *end;
    wt_table *table;
    wt_status status; /* of the first failure, after which the functions below return false */
    wt_error *err;
} byte_reader;

static bool fail_corrupt_bytes(byte_reader *r, const char *message)
{
    if (r->status == WT_OK)
        r->status = wt_fail(r->err, WT_E_CORRUPT, "%s", message);
    return false;
}

/* An invalid name is an error of the file, not of an argument. */
static bool bytes_accept_name(byte_reader *r, wt_status status)
{
    r->status = status == WT_E_ARG ? WT_E_CORRUPT : status;
    if (status == WT_E_ARG && r->err != NULL)
        r->err->status = WT_E_CORRUPT;
    return status == WT_OK;
}

/* Decodes a number, which must not exceed `most`. */
static bool decode_count(byte_reader *r, size_t most, size_t *n)
{
    uint64_t low_first = 0;
    if ((size_t)(r->end - r->at) < sizeof low_first)
        return fail_corrupt_bytes(r, "a table that is not whole");
    memcpy(&low_first, r->at, sizeof low_first);
    r->at += sizeof low_first;
    *n = (size_t)le64toh(low_first);
    return *n <= most || fail_corrupt_bytes(r, "a table with a number that is too large");
}

static bool decode_text(byte_reader *r, const char **text)
{
    const char *const zero = memchr(r->at, '\0', (size_t)(r->end - r->at));
    if (zero == NULL)
        return fail_corrupt_bytes(r, "a table that is not whole");
    *text = r->at;
    r->at = zero + 1;
    return true;
}

static bool decode_numbers(byte_reader *r, double *numbers, size_t n)
{
    if ((size_t)(r->end - r->at) / sizeof *numbers < n)
        return fail_corrupt_bytes(r, "a table that is not whole");
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, r->at + i * sizeof bits, sizeof bits);
        bits = le64toh(bits);
        memcpy(&numbers[i], &bits, sizeof bits);
    }
    r->at += n * sizeof *numbers;
    return true;
}

static bool decode_keys(byte_reader *r)
{
    size_t n = 0, is_estimate = 0;
    const char *name = NULL, *text = NULL;
    bool good = decode_count(r, TABLE_KEYS_MAX, &n);
    for (size_t i = 0; good && i < n; i++) {
        double number[3] = {0};
        good =
            decode_text(r, &name) && decode_count(r, 1, &is_estimate) &&
            decode_numbers(r, number, is_estimate ? 3 : 0) && decode_text(r, &text) &&
            (wt_table_key(r->table, name) == NULL || fail_corrupt_bytes(r, "a key is there twice"));
        const wt_estimate e = {number[0], number[1], number[2], text};
        good = good &&
               bytes_accept_name(r, is_estimate ? wt_table_set_estimate(r->table, name, e, r->err)
                                                : wt_table_set_key(r->table, name, text, r->err));
    }
    return good;
}

/* Decodes the columns without their rows. */
static bool decode_columns(byte_reader *r)
{
    size_t n = 0, is_text = 0;
    const char *name = NULL, *unit = NULL, *words = NULL;
    bool good = decode_count(r, TABLE_COLUMNS_MAX, &n);
    for (size_t i = 0; good && i < n; i++) {
        good = decode_text(r, &name) && decode_count(r, 1, &is_text) && decode_text(r, &unit) &&
               decode_text(r, &words);
        good = good && bytes_accept_name(
                           r, is_text ? wt_table_add_text_column(r->table, name, words, r->err)
                                      : wt_table_add_column(r->table, name, unit, words, r->err));
    }
    return good;
}

/* Returns the smallest size of an encoded row: 8 bytes for a number, the zero byte for a text. */
static size_t row_bytes_min(const wt_table *table)
{
    size_t least = 0;
    for (size_t i = 0; i < table->n_columns; i++)
        least += table->columns[i].kind == WT_COLUMN_NUMBER ? sizeof(double) : 1;
    return least;
}

/* Rows are allocated before their cells are decoded. Their number is limited by the number of
 * bytes. */
static bool decode_rows(byte_reader *r)
{
    size_t n = 0, n_blocks = 0, next = 0;
    const size_t least = row_bytes_min(r->table);
    const size_t most = least > 0 ? (size_t)(r->end - r->at) / least : 0;
    bool good = decode_count(r, most, &n) && decode_count(r, n, &n_blocks);
    for (size_t block = 0; good && block < n_blocks; block++) {
        const size_t first = next;
        good = decode_count(r, n - 1, &next) && ((block == 0 ? next == 0 : next > first) ||
                                                 fail_corrupt_bytes(r, "blocks without an order"));
        while (good && r->table->n_rows < next)
            good = bytes_accept_name(r, wt_table_add_row(r->table, r->err));
        if (good)
            wt_table_new_block(r->table);
    }
    while (good && r->table->n_rows < n)
        good = bytes_accept_name(r, wt_table_add_row(r->table, r->err));
    return good;
}

static bool decode_texts(byte_reader *r, char **texts, size_t n)
{
    const char *text = NULL;
    for (size_t row = 0; row < n; row++) {
        char *const above = row > 0 ? texts[row - 1] : NULL;
        if (!decode_text(r, &text))
            return false;
        if (text[0] == '\0')
            continue;
        texts[row] = above != NULL && strcmp(text, above) == 0 ? above : wt_strdup(text);
    }
    return true;
}

wt_status table_bytes_read(const char **at, const char *end, wt_table **table, wt_error *err)
{
    byte_reader r = {.at = *at, .end = end, .err = err};
    const char *name = NULL, *title = NULL;
    bool good = decode_text(&r, &name) && decode_text(&r, &title) &&
                (table_name_is_valid(name) || fail_corrupt_bytes(&r, "not a name for a table"));
    if (good)
        r.table = wt_table_new(name, title);
    good = good && decode_keys(&r) && decode_columns(&r) && decode_rows(&r);
    for (size_t i = 0; good && i < r.table->n_columns; i++) {
        const table_column *const column = &r.table->columns[i];
        good = column->kind == WT_COLUMN_NUMBER
                   ? decode_numbers(&r, column->numbers, r.table->n_rows)
                   : decode_texts(&r, column->texts, r.table->n_rows);
    }
    if (good) {
        *at = r.at;
        *table = r.table;
    } else {
        wt_error_place(err, "%s", r.table != NULL ? r.table->name : "");
        wt_error_advice(err, "make the file again");
        wt_table_free(r.table);
    }
    return r.status;
}
