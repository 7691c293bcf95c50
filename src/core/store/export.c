/* Exports a table for other programs: text with separators, JSON, or an SQLite database. A missing
 * number is an empty cell, or null. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/utf8.h"
#include "core/system/file_signatures.h"
#include "core/table/registry.h"
#include "core/table/table.h"

#include <endian.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Additional tables: descriptions of the columns, and values that belong to the whole table. No
 * table of this program has these names, but a table of another program may. */
#define COLUMNS_TABLE "weartrack_columns"
#define KEYS_TABLE "weartrack_keys"
#define SQLITE_RESERVED_PREFIX "sqlite_" /* prefix that SQLite reserves */
#define BLOCK_COLUMN "block"

typedef struct database {
    sqlite3 *db;
    const wt_table *table;
    char **names; /* [n_columns] names of the columns in the database */
    bool blocks;  /* several blocks: the first column has the block number */
    wt_error *err;
} database;

static wt_status fail_sqlite(const database *d, int code)
{
    if (code == SQLITE_NOMEM)
        out_of_memory(0);
    return wt_fail(d->err, WT_E_INTERNAL, "SQLite: %s", sqlite3_errmsg(d->db));
}

static wt_status execute_sql(const database *d, const char *words)
{
    const int code = words == NULL ? SQLITE_NOMEM : sqlite3_exec(d->db, words, NULL, NULL, NULL);
    return code == SQLITE_OK ? WT_OK : fail_sqlite(d, code);
}

/* Creates a table and prepares the statement that adds a row. */
static wt_status begin_insert(const database *d, const char *create, const char *insert,
                              sqlite3_stmt **row)
{
    const wt_status status = execute_sql(d, create);
    if (status != WT_OK)
        return status;
    const int code =
        insert == NULL ? SQLITE_NOMEM : sqlite3_prepare_v2(d->db, insert, -1, row, NULL);
    return code == SQLITE_OK ? WT_OK : fail_sqlite(d, code);
}

/* Replaces each byte that is not UTF-8 by U+FFFD, because a text column must be UTF-8. The caller
 * frees the copy. */
static char *replace_invalid_utf8(const char *text)
{
    static const char replacement[] = "\xef\xbf\xbd";
    char *const whole = wt_alloc((sizeof replacement - 1) * strlen(text) + 1, 1);
    char *to = whole;
    for (size_t left = strlen(text), n; left > 0; text += n, left -= n) {
        n = utf8_character_length(text, left);
        to = n > 0 ? mempcpy(to, text, n) : mempcpy(to, replacement, sizeof replacement - 1);
        n += n == 0;
    }
    return whole;
}

/* An unknown value or an empty text becomes NULL. A value that cannot be bound because of a lack of
 * memory stays NULL, and sqlite3_step reports the error. */
static void bind_text(sqlite3_stmt *row, int place, const char *text)
{
    const size_t length = text != NULL ? strlen(text) : 0;
    if (length > 0 && utf8_valid_length(text, length) < length)
        (void)sqlite3_bind_text(row, place, replace_invalid_utf8(text), -1, free);
    else if (length > 0)
        (void)sqlite3_bind_text(row, place, text, -1, SQLITE_TRANSIENT);
    else
        (void)sqlite3_bind_null(row, place);
}

static void bind_number(sqlite3_stmt *row, int place, double value)
{
    if (isnan(value))
        (void)sqlite3_bind_null(row, place);
    else
        (void)sqlite3_bind_double(row, place, value);
}

static wt_status insert_row(const database *d, sqlite3_stmt *row)
{
    const int code = sqlite3_step(row);
    const int ready = sqlite3_reset(row);
    return code == SQLITE_DONE && ready == SQLITE_OK ? WT_OK : fail_sqlite(d, code);
}

/* ---- names ----------------------------------------------------------------------------------- */

/* Rejects names that have another meaning in the database, and tables with too many columns. */
static wt_status check_database_table(const database *d)
{
    const char *const name = d->table->name;
    const int most = sqlite3_limit(d->db, SQLITE_LIMIT_COLUMN, -1);
    if (strcasecmp(name, COLUMNS_TABLE) == 0 || strcasecmp(name, KEYS_TABLE) == 0 ||
        strncasecmp(name, SQLITE_RESERVED_PREFIX, strlen(SQLITE_RESERVED_PREFIX)) == 0)
        (void)wt_fail(d->err, WT_E_UNSUPPORTED,
                      "a table \"%s\" cannot be in a database: the name has another meaning there",
                      name);
    else if (d->table->n_columns + d->blocks > (size_t)most)
        (void)wt_fail(d->err, WT_E_UNSUPPORTED,
                      "a table \"%s\" of %zu columns cannot be in a database: %d it may have", name,
                      d->table->n_columns + d->blocks, most);
    else
        return WT_OK;
    wt_error_advice(d->err, "write it as json or csv");
    return WT_E_UNSUPPORTED;
}

static bool is_name_used(const database *d, size_t n, const char *name)
{
    bool taken = d->blocks && strcasecmp(name, BLOCK_COLUMN) == 0;
    for (size_t i = 0; i < n && !taken; i++)
        taken = strcasecmp(d->names[i], name) == 0;
    return taken;
}

/* SQLite ignores case, so that modulus_A equals modulus_a: the later name gets a number. */
static void choose_column_names(database *d)
{
    const size_t n = d->table->n_columns;
    d->names = wt_alloc(n, sizeof *d->names);
    for (size_t i = 0; i < n; i++) {
        char *name = wt_strdup(d->table->columns[i].name);
        for (size_t number = 2; is_name_used(d, i, name); number++) {
            free(name);
            name = format_text("%s_%zu", d->table->columns[i].name, number);
        }
        d->names[i] = name;
    }
}

/* ---- tables ---------------------------------------------------------------------------------- */

/* Returns a CREATE TABLE statement, or an INSERT statement with a parameter for each column. The
 * caller frees it; NULL when out of memory. */
static char *format_table_statement(const database *d, bool create)
{
    sqlite3_str *const s = sqlite3_str_new(d->db);
    sqlite3_str_appendf(s, create ? "CREATE TABLE \"%w\"(" : "INSERT INTO \"%w\" VALUES(",
                        d->table->name);
    if (d->blocks)
        sqlite3_str_appendall(s, create ? BLOCK_COLUMN " INTEGER, " : "?, ");
    for (size_t i = 0; i < d->table->n_columns; i++) {
        const bool is_text = d->table->columns[i].kind == WT_COLUMN_TEXT;
        if (i > 0)
            sqlite3_str_appendall(s, ", ");
        if (create)
            sqlite3_str_appendf(s, "\"%w\" %s", d->names[i], is_text ? "TEXT" : "REAL");
        else
            sqlite3_str_appendall(s, "?");
    }
    sqlite3_str_appendall(s, ")");
    return sqlite3_str_finish(s);
}

static wt_status insert_table_rows(const database *d)
{
    sqlite3_stmt *row = NULL;
    char *const create = format_table_statement(d, true), *const insert =
                                                              format_table_statement(d, false);
    wt_status status = begin_insert(d, create, insert, &row);
    sqlite3_free(create);
    sqlite3_free(insert);
    for (size_t i = 0; status == WT_OK && i < d->table->n_rows; i++) {
        int place = 1;
        if (d->blocks)
            (void)sqlite3_bind_int64(row, place++, (sqlite3_int64)wt_table_block(d->table, i));
        for (size_t column = 0; column < d->table->n_columns; column++, place++)
            if (d->table->columns[column].kind == WT_COLUMN_TEXT)
                bind_text(row, place, wt_table_text(d->table, i, column));
            else
                bind_number(row, place, wt_table_number(d->table, i, column));
        status = insert_row(d, row);
    }
    (void)sqlite3_finalize(row);
    return status;
}

static wt_status insert_column_rows(const database *d)
{
    sqlite3_stmt *row = NULL;
    wt_status status = begin_insert(
        d, "CREATE TABLE " COLUMNS_TABLE "(\"table\" TEXT, \"column\" TEXT, unit TEXT, words TEXT)",
        "INSERT INTO " COLUMNS_TABLE " VALUES(?, ?, ?, ?)", &row);
    for (size_t i = 0; status == WT_OK && i < d->table->n_columns; i++) {
        const table_column *const column = &d->table->columns[i];
        bind_text(row, 1, d->table->name);
        bind_text(row, 2, d->names[i]);
        bind_text(row, 3, column->kind == WT_COLUMN_TEXT ? NULL : column->unit);
        bind_text(row, 4, column->long_name);
        status = insert_row(d, row);
    }
    (void)sqlite3_finalize(row);
    return status;
}

static wt_status insert_key_rows(const database *d)
{
    sqlite3_stmt *row = NULL;
    if (d->table->n_keys == 0)
        return WT_OK;
    wt_status status =
        begin_insert(d,
                     "CREATE TABLE " KEYS_TABLE
                     "(\"table\" TEXT, \"key\" TEXT, value REAL, standard_error REAL, "
                     "numerical_error REAL, unit TEXT, words TEXT)",
                     "INSERT INTO " KEYS_TABLE " VALUES(?, ?, ?, ?, ?, ?, ?)", &row);
    for (size_t i = 0; status == WT_OK && i < d->table->n_keys; i++) {
        const table_key *const key = &d->table->keys[i];
        const double numbers[] = {key->parsed.value, key->parsed.standard_error,
                                  key->parsed.numerical_error};
        bind_text(row, 1, d->table->name);
        bind_text(row, 2, key->name);
        for (int k = 0; k < (int)COUNT_OF(numbers); k++)
            bind_number(row, 3 + k, key->is_estimate ? numbers[k] : (double)NAN);
        bind_text(row, 6, key->is_estimate ? key->unit : NULL);
        bind_text(row, 7, key->is_estimate ? NULL : key->text);
        status = insert_row(d, row);
    }
    (void)sqlite3_finalize(row);
    return status;
}

/* A later run identifies the file by the application id and may then overwrite it. */
static wt_status begin_database(const database *d)
{
    char words[64];
    uint32_t id;
    memcpy(&id, SQLITE_APPLICATION_ID, sizeof id);
    (void)snprintf(words, sizeof words, "BEGIN; PRAGMA application_id = %" PRIu32, be32toh(id));
    return execute_sql(d, words);
}

static wt_status write_database(const database *d, FILE *out)
{
    sqlite3_int64 size = 0;
    const wt_status status = execute_sql(d, "COMMIT");
    if (status != WT_OK)
        return status;
    unsigned char *const bytes = sqlite3_serialize(d->db, "main", &size, 0);
    if (bytes == NULL)
        return fail_sqlite(d, SQLITE_NOMEM);
    const bool written = fwrite(bytes, 1, (size_t)size, out) == (size_t)size;
    const int number = errno;
    sqlite3_free(bytes);
    return written ? WT_OK : wt_fail(d->err, WT_E_IO, "cannot write: %s", strerror(number));
}

/* Writes the table under its name. The table "weartrack_columns" describes its columns, and
 * "weartrack_keys" has its keys. With `blocks` the first column is the block number. */
static wt_status export_sqlite(FILE *out, const wt_table *table, bool blocks, wt_error *err)
{
    database d = {.table = table, .blocks = blocks, .err = err};
    const int opened = sqlite3_open_v2(
        ":memory:", &d.db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_MEMORY, NULL);
    static wt_status (*const steps[])(const database *d) = {begin_database, insert_table_rows,
                                                            insert_column_rows, insert_key_rows};
    wt_status status = opened == SQLITE_OK ? check_database_table(&d) : fail_sqlite(&d, opened);
    if (status == WT_OK)
        choose_column_names(&d);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(steps); i++)
        status = steps[i](&d);
    if (status == WT_OK)
        status = write_database(&d, out);
    (void)sqlite3_close(d.db);
    wt_strings_free(d.names, d.names != NULL ? table->n_columns : 0);
    return status;
}

/* ---- text with separators -------------------------------------------------------------------- */

/* True if a spreadsheet would execute the text as a formula; numbers are harmless. */
static bool is_formula(const char *text)
{
    double number;
    return text[0] != '\0' && strchr("=+-@\t\r", text[0]) != NULL && text[1] != '\0' &&
           !wt_number_parse(text, strlen(text), '.', &number);
}

/* Writes a cell with quotes as in RFC 4180, also between tabs. `mark` precedes the text. */
static void write_cell(FILE *out, const char *mark, const char *text, char separator)
{
    const char special[] = {separator, '"', '\n', '\r', '\0'};
    if (strpbrk(text, special) == NULL) {
        (void)fprintf(out, "%s%s", mark, text);
        return;
    }
    (void)fprintf(out, "\"%s", mark);
    for (const char *p = text; *p != '\0'; p++) {
        if (*p == '"')
            (void)putc('"', out);
        (void)putc(*p, out);
    }
    (void)putc('"', out);
}

static const char *format_cell_number(double value, char buffer[32])
{
    buffer[0] = '\0';
    if (!isnan(value))
        (void)wt_number_format(value, buffer);
    return buffer;
}

static void write_separated_header(FILE *out, const wt_table *table, bool blocks, char separator)
{
    if (blocks)
        (void)fprintf(out, "block%c", separator);
    for (size_t i = 0; i < wt_table_n_columns(table); i++) {
        char name[256];
        const char *unit = wt_table_column_unit(table, i);
        const bool has_unit = *unit != '\0' && strcmp(unit, "1") != 0;
        (void)snprintf(name, sizeof name, has_unit ? "%s[%s]" : "%s",
                       wt_table_column_name(table, i), unit);
        if (i > 0)
            (void)putc(separator, out);
        write_cell(out, "", name, separator);
    }
    (void)putc('\n', out);
}

/* A table with several blocks has a first column with the block number. */
static bool has_blocks(const wt_table *table)
{
    const size_t n = wt_table_n_rows(table);
    return n > 0 && wt_table_block(table, n - 1) > 0;
}

static void write_separated(FILE *out, const wt_table *table, char separator, bool formulas)
{
    char number[32];
    const bool blocks = has_blocks(table);
    write_separated_header(out, table, blocks, separator);
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        if (blocks)
            (void)fprintf(out, "%zu%c", wt_table_block(table, row), separator);
        for (size_t i = 0; i < wt_table_n_columns(table); i++) {
            if (i > 0)
                (void)putc(separator, out);
            if (wt_table_column_kind(table, i) == WT_COLUMN_TEXT)
                write_cell(out, !formulas && is_formula(wt_table_text(table, row, i)) ? "'" : "",
                           wt_table_text(table, row, i), separator);
            else
                (void)fputs(format_cell_number(wt_table_number(table, row, i), number), out);
        }
        (void)putc('\n', out);
    }
}

/* ---- JSON ------------------------------------------------------------------------------------ */

/* JSON has no infinite numbers: they are strings. */
static void write_json_number(FILE *out, double value)
{
    char number[32];
    if (isnan(value))
        (void)fputs("null", out);
    else
        (void)fprintf(out, isinf(value) ? "\"%s\"" : "%s", format_cell_number(value, number));
}

static void write_json_member(FILE *out, const char *before, const char *name, const char *text)
{
    (void)fprintf(out, "%s\"%s\": ", before, name);
    json_write_text(out, text);
}

/* True if the schema of the table declares the key as a number that is stored as text. */
static bool is_plain_number(const wt_table *table, const char *key)
{
    const char *name = wt_table_name(table);
    for (size_t i = 0; i < table_n_schemas; i++) {
        const table_schema *schema = table_schemas[i];
        const size_t length = strlen(schema->name);
        if (strcmp(schema->name, name) != 0 && (length == 0 || schema->name[length - 1] != '/' ||
                                                strncmp(schema->name, name, length) != 0))
            continue;
        for (size_t k = 0; k < schema->n_keys; k++) {
            const schema_field *field = &schema->keys[k];
            const size_t own = strlen(field->name);
            if (field->kind == SCHEMA_PLAIN &&
                (strcmp(field->name, key) == 0 ||
                 (field->name[own - 1] == '_' && strncmp(field->name, key, own) == 0)))
                return true;
        }
    }
    return false;
}

static void write_json_keys(FILE *out, const wt_table *table)
{
    double plain;
    (void)fputs(",\n \"keys\": {", out);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *name = wt_table_key_name(table, i);
        wt_estimate e;
        (void)fputs(i > 0 ? ",\n  " : "\n  ", out);
        json_write_text(out, name);
        (void)fputs(": ", out);
        if (!wt_table_estimate(table, name, &e)) {
            const char *text = wt_table_key(table, name);
            if (is_plain_number(table, name) && wt_number_parse(text, strlen(text), '.', &plain)) {
                write_json_number(out, plain);
                continue;
            }
            json_write_text(out, wt_table_key(table, name));
            continue;
        }
        (void)fputs("{\"value\": ", out);
        write_json_number(out, e.value);
        (void)fputs(", \"standard_error\": ", out);
        write_json_number(out, e.standard_error);
        (void)fputs(", \"numerical_error\": ", out);
        write_json_number(out, e.numerical_error);
        write_json_member(out, ", ", "unit", e.unit);
        (void)putc('}', out);
    }
    (void)putc('}', out);
}

static void write_json_columns(FILE *out, const wt_table *table)
{
    (void)fputs(",\n \"columns\": [", out);
    for (size_t i = 0; i < wt_table_n_columns(table); i++) {
        write_json_member(out, i > 0 ? ",\n  {" : "\n  {", "name", wt_table_column_name(table, i));
        if (wt_table_column_kind(table, i) == WT_COLUMN_NUMBER)
            write_json_member(out, ", ", "unit", wt_table_column_unit(table, i));
        write_json_member(out, ", ", "long_name", wt_table_column_long_name(table, i));
        (void)putc('}', out);
    }
    (void)putc(']', out);
}

static void write_json(FILE *out, const wt_table *table)
{
    const bool blocks = has_blocks(table);
    write_json_member(out, "{", "table", wt_table_name(table));
    write_json_member(out, ",\n ", "title", wt_table_title(table));
    write_json_keys(out, table);
    write_json_columns(out, table);
    (void)fputs(",\n \"rows\": [", out);
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        (void)fputs(row > 0 ? ",\n  {" : "\n  {", out);
        if (blocks)
            (void)fprintf(out, "\"block\": %zu, ", wt_table_block(table, row));
        for (size_t i = 0; i < wt_table_n_columns(table); i++) {
            (void)fprintf(out, "%s\"%s\": ", i > 0 ? ", " : "", wt_table_column_name(table, i));
            if (wt_table_column_kind(table, i) == WT_COLUMN_TEXT)
                json_write_text(out, wt_table_text(table, row, i));
            else
                write_json_number(out, wt_table_number(table, row, i));
        }
        (void)putc('}', out);
    }
    (void)fputs("]}\n", out);
}

wt_status wt_table_export(FILE *out, const wt_table *table, wt_export_form form, bool formulas,
                          wt_error *err)
{
    if (form == WT_EXPORT_STREAM)
        return wt_stream_write(out, table, NULL, err);
    if (form == WT_EXPORT_SQLITE)
        return export_sqlite(out, table, has_blocks(table), err);
    if (form == WT_EXPORT_JSON)
        write_json(out, table);
    else
        write_separated(out, table, form == WT_EXPORT_CSV ? ',' : '\t', formulas);
    return ferror(out) ? wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno)) : WT_OK;
}
