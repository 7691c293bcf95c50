/* Reads the JSON export of TRIOS (TA Instruments): the results of each step as rows of named cells.
 * It is converted to the text export, whose description reads it. SQLite parses the JSON in the
 * sandbox.
 *
 * The layout is that of the schema of the vendor and of the example of its own reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "core/base/text.h"
#include "core/system/sandbox.h"
#include "read/bytes/input.h"
#include "read/text/text.h"

#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

/* The parsed form takes up to ten times the memory of the file. */
#define LARGEST_JSON ((size_t)256 << 20)
#define SHOWN "Processed" /* the results that TRIOS shows */
#define BYTE_ORDER_MARK "\xef\xbb\xbf"

enum { PAIRS_MAX = 4096 };

/* Texts of a list of the file: name of a step and its id as the key, or name and unit of a column.
 */
typedef struct text_pair {
    char *first, *second, *key;
} text_pair;

typedef struct trios_json {
    sqlite3 *db;
    const char *bytes; /* the document */
    size_t length;
    const char *part; /* member of Results in use */
    text_pair *steps, *columns, *sample;
    size_t n_steps, n_columns, n_sample;
    wt_error *err;
} trios_json;

static wt_status fail_json(const trios_json *json, int code)
{
    if (code == SQLITE_NOMEM)
        return wt_fail(json->err, WT_E_MEMORY, "no memory for the JSON");
    (void)wt_fail(json->err, WT_E_CORRUPT, "the JSON is damaged");
    wt_error_found(json->err, "%s", sqlite3_errmsg(json->db));
    wt_error_advice(json->err, "export it again from TRIOS, or copy it again");
    return WT_E_CORRUPT;
}

/* Prepares a query of the document (?1) and of a path in the results in use (?2). */
static wt_status query(const trios_json *json, const char *sql, const char *member,
                       sqlite3_stmt **rows)
{
    char path[64];
    (void)snprintf(path, sizeof path, "$.Results.%s.%s", json->part, member);
    int code = sqlite3_prepare_v2(json->db, sql, -1, rows, NULL);
    if (code == SQLITE_OK)
        code = sqlite3_bind_text64(*rows, 1, json->bytes, json->length, SQLITE_STATIC, SQLITE_UTF8);
    if (code == SQLITE_OK)
        code = sqlite3_bind_text(*rows, 2, path, -1, SQLITE_TRANSIENT);
    return code == SQLITE_OK ? WT_OK : fail_json(json, code);
}

/* Returns a copy of a text in one line. */
static char *copy_text(sqlite3_stmt *rows, int column)
{
    const char *const text = (const char *)sqlite3_column_text(rows, column);
    char *const copy = wt_strdup(text != NULL ? text : "");
    utf8_sanitize(copy);
    return copy;
}

static wt_status read_pairs(const trios_json *json, const char *sql, const char *member,
                            text_pair **pairs, size_t *n)
{
    sqlite3_stmt *rows = NULL;
    wt_status status = query(json, sql, member, &rows);
    *pairs = wt_alloc(PAIRS_MAX, sizeof **pairs);
    while (status == WT_OK) {
        const int code = sqlite3_step(rows);
        if (code == SQLITE_DONE)
            break;
        if (code != SQLITE_ROW)
            status = fail_json(json, code);
        else if (*n == PAIRS_MAX)
            status = wt_fail(json->err, WT_E_RANGE, "more than %d entries of %s", (int)PAIRS_MAX,
                             member);
        else
            (*pairs)[(*n)++] = (text_pair){.first = copy_text(rows, 0),
                                           .second = copy_text(rows, 1),
                                           .key = copy_text(rows, 2)};
    }
    (void)sqlite3_finalize(rows);
    return status;
}

/* Returns the index of the pair whose key is this text, n if there is none. The search begins at
 * the likely one. */
static size_t find_key(const text_pair *pairs, size_t n, const char *key, size_t likely)
{
    for (size_t i = 0; i < n; i++) {
        const size_t at = (likely + i) % n;
        if (strcmp(pairs[at].key, key) == 0)
            return at;
    }
    return n;
}

static void write_step(const trios_json *json, size_t step, FILE *out)
{
    fprintf(out, "[Step]\nStep name\t%s\nVariables",
            step < json->n_steps ? json->steps[step].first : "");
    for (size_t i = 0; i < json->n_columns; i++)
        fprintf(out, "\t%s", json->columns[i].first);
    fputs("\nUnits", out);
    for (size_t i = 0; i < json->n_columns; i++)
        fprintf(out, "\t%s", json->columns[i].second);
    fputc('\n', out);
}

/* The row that is collected: its numbers, and the step that a cell of it names. */
typedef struct json_row {
    double *values; /* [n_columns], NaN if absent */
    long long number;
    size_t step, written; /* index of the step, and of the step of the row before */
} json_row;

static void write_row(const trios_json *json, json_row *row, FILE *out)
{
    if (row->number >= 0 && row->step != row->written)
        write_step(json, row->step, out);
    row->written = row->step;
    if (row->number >= 0)
        fputs("Data point", out);
    for (size_t i = 0; i < json->n_columns; i++) {
        char text[32] = "";
        if (!isnan(row->values[i]))
            (void)wt_number_format(row->values[i], text);
        if (row->number >= 0)
            fprintf(out, "\t%s", text);
        row->values[i] = (double)NAN;
    }
    if (row->number >= 0)
        fputc('\n', out);
}

static wt_status write_rows(const trios_json *json, FILE *out)
{
    sqlite3_stmt *cells = NULL;
    size_t column = 0;
    json_row row = {.values = wt_alloc(json->n_columns, sizeof *row.values),
                    .number = -1,
                    .step = json->n_steps,
                    .written = SIZE_MAX};
    wt_status status = query(json,
                             "SELECT r.key, c.key, c.type, c.value FROM json_each(?1, ?2) AS r, "
                             "json_each(r.value) AS c WHERE r.type = 'object'",
                             "Rows", &cells);
    while (status == WT_OK) {
        const int code = sqlite3_step(cells);
        if (code != SQLITE_ROW && code != SQLITE_DONE)
            status = fail_json(json, code);
        if (code != SQLITE_ROW || sqlite3_column_int64(cells, 0) != row.number)
            write_row(json, &row, out);
        if (code != SQLITE_ROW)
            break;
        row.number = sqlite3_column_int64(cells, 0);
        const char *const key = (const char *)sqlite3_column_text(cells, 1);
        const char *const text = (const char *)sqlite3_column_text(cells, 3);
        const int type = sqlite3_column_type(cells, 3);
        column = find_key(json->columns, json->n_columns, key != NULL ? key : "", column + 1);
        if (column < json->n_columns && (type == SQLITE_INTEGER || type == SQLITE_FLOAT))
            row.values[column] = sqlite3_column_double(cells, 3);
        else if (type == SQLITE_TEXT && text != NULL) {
            const size_t step = find_key(json->steps, json->n_steps, text, 0);
            row.step = step < json->n_steps ? step : row.step;
        }
    }
    (void)sqlite3_finalize(cells);
    free(row.values);
    return status;
}

/* Chooses the results in use: those that TRIOS shows, or the original ones without those. */
static wt_status choose_part(trios_json *json)
{
    static const char *const parts[] = {SHOWN, "Original"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        sqlite3_stmt *rows = NULL;
        json->part = parts[i];
        const wt_status status = query(json, "SELECT json_array_length(?1, ?2)", "Rows", &rows);
        const int code = status == WT_OK ? sqlite3_step(rows) : SQLITE_ERROR;
        const bool has_rows = code == SQLITE_ROW && sqlite3_column_int64(rows, 0) > 0;
        const wt_status read =
            status == WT_OK && code != SQLITE_ROW ? fail_json(json, code) : status;
        (void)sqlite3_finalize(rows);
        if (read != WT_OK || has_rows)
            return read;
    }
    (void)wt_fail(json->err, WT_E_EMPTY, "the export has no results");
    wt_error_expected(json->err, "rows in Results, Processed or Original");
    wt_error_advice(json->err, "export it again from TRIOS, with the data of the steps");
    return WT_E_EMPTY;
}

static void free_pairs(text_pair *pairs, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        free(pairs[i].first);
        free(pairs[i].second);
        free(pairs[i].key);
    }
    free(pairs);
}

/* Writes the name of the results in use as the first line, then the text export. */
static wt_status write_json_as_text(trios_json *json, FILE *out)
{
    const int code =
        sqlite3_open_v2(":memory:", &json->db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, NULL);
    wt_status status = code == SQLITE_OK ? choose_part(json) : fail_json(json, code);
    if (status == WT_OK)
        status = read_pairs(json,
                            "SELECT json_extract(value, '$.Name'), '', json_extract(value, '$.Id') "
                            "FROM json_each(?1, ?2) WHERE type = 'object'",
                            "ResultsSteps", &json->steps, &json->n_steps);
    if (status == WT_OK)
        status = read_pairs(json,
                            "SELECT json_extract(value, '$.DisplayName'), "
                            "json_extract(value, '$.Unit.Name'), key "
                            "FROM json_each(?1, ?2) WHERE type = 'object'",
                            "ColumnHeaders", &json->columns, &json->n_columns);
    if (status == WT_OK)
        status = read_pairs(json, "SELECT json_extract(?1, '$.Sample.Name'), ?2, ''", "Rows",
                            &json->sample, &json->n_sample);
    fprintf(out, "%s\n[Version]\nTA Instruments LIMS export format version\t0\n", json->part);
    if (status == WT_OK) {
        fprintf(out, "Name\t%s\n", json->sample->first);
        status = write_rows(json, out);
    }
    free_pairs(json->steps, json->n_steps);
    free_pairs(json->columns, json->n_columns);
    free_pairs(json->sample, json->n_sample);
    (void)sqlite3_close(json->db);
    return status;
}

static wt_status read_in_sandbox(const sandbox_call *request, FILE *answer, wt_error *err)
{
    trios_json json = {.bytes = request->bytes, .length = request->size, .err = err};
    return write_json_as_text(&json, answer);
}

static wt_status convert_json_to_text(const file_reader *self, wt_input *input, wt_log *log,
                                      wt_input **text, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0, n_text = 0;
    char *made = NULL;
    (void)self;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    const size_t mark = length >= 3 && memcmp(bytes, BYTE_ORDER_MARK, 3) == 0 ? 3 : 0;
    const sandbox_call call = {.what = "TRIOS JSON",
                               .reading = read_in_sandbox,
                               .bytes = bytes + mark,
                               .size = length - mark,
                               .file = -1};
    if (call.size > LARGEST_JSON) {
        (void)wt_fail(err, WT_E_RANGE, "the JSON is too large");
        wt_error_expected(err, "%zu MiB at most", LARGEST_JSON >> 20);
        wt_error_advice(err, "export it as text from TRIOS");
        return WT_E_RANGE;
    }
    const sandbox_limits limits = sandbox_limits_for(call.size);
    status = sandbox_read(&call, &limits, &made, &n_text, err);
    if (status != WT_OK)
        return status;
    if (n_text > strlen(SHOWN) && memcmp(made, SHOWN "\n", strlen(SHOWN) + 1) == 0)
        wt_log_add(log, WT_NOTE, wt_input_name(input), NULL,
                   "the results are those that TRIOS shows, with changes by its user, if any");
    const char *const end = memchr(made, '\n', n_text);
    const size_t head = end != NULL ? (size_t)(end - made) + 1 : n_text;
    memmove(made, made + head, n_text - head);
    *text = input_from_bytes(made, n_text - head, wt_input_name(input));
    return WT_OK;
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result((PEEK_BEGINS(peek, "{") || PEEK_BEGINS(peek, BYTE_ORDER_MARK "{")) &&
                                  PEEK_CONTAINS(peek, "/schemas/TRIOSJSONExportSchema"),
                              95);
}

const file_reader reader_trios = {
    .info = {.id = "trios-json",
             .title = "TA Instruments TRIOS, JSON export",
             .kinds = WT_KIND_SWEEP,
             .verified = false,
             .evidence = "the vendor's schema and the example of its reader; not tried on a "
                         "measured file",
             .version = "1"},
    .runs = "trios-lims",
    .as_text = convert_json_to_text,
    .read_sweep = text_read_sweep,
    .detect = detect,
    .describe = text_describe_converted,
};
