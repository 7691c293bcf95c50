/* Writes tables as a text stream and reads them. Nothing is taken on trust: a stream may have been
 * edited by hand or by another program. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/table.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Unit of a text column in the header line. */
#define STREAM_TEXT_UNIT "text"

/* Escaped characters, and their letters after a backslash. The last two are escaped only at the
 * start of a text. */
static const char raw[] = "\t\n\r\\#-", letters[] = "tnr\\#-";

enum { ALWAYS_ESCAPED = 4 };

/* Writes a text as one cell: "-" for an empty text, with escapes for control characters, bytes that
 * are not UTF-8, and a "#" or a single "-" at the start. */
static void stream_write_text(FILE *out, const char *text)
{
    const size_t length = strlen(text);
    if (length == 0) {
        (void)putc('-', out);
        return;
    }
    /* A row must differ from a comment, and a hyphen from the empty text. */
    if (text[0] == '#' || strcmp(text, "-") == 0)
        (void)putc('\\', out);
    size_t i = 0;
    while (i < length) {
        const size_t n = utf8_character_length(text + i, length - i);
        const unsigned char c = (unsigned char)text[i];
        const char *const escaped = memchr(raw, c, ALWAYS_ESCAPED);
        if (n > 1)
            (void)fwrite(text + i, 1, n, out);
        else if (escaped != NULL)
            (void)fprintf(out, "\\%c", letters[escaped - raw]);
        else if (n == 0 || c < ' ' || c == 0x7F)
            (void)fprintf(out, "\\x%02X", c);
        else
            (void)putc(c, out);
        i += n > 0 ? n : 1;
    }
}

static int hex_digit_value(char c)
{
    static const char digits[] = "0123456789ABCDEF";
    const char *const found = c != '\0' ? strchr(digits, c) : NULL;
    return found != NULL ? (int)(found - digits) : -1;
}

/* Decodes a cell in place and adds a terminating zero. False for an invalid escape. */
static bool stream_unescape(char *text, size_t length)
{
    if (length == 1 && text[0] == '-')
        length = 0;
    size_t to = 0;
    for (size_t from = 0; from < length; from++) {
        char c = text[from];
        if (c == '\\') {
            from++;
            const char escape = from < length ? text[from] : '\0';
            const char *const letter = memchr(letters, escape, sizeof letters - 1);
            if (letter != NULL) {
                c = raw[letter - letters];
            } else if (escape == 'x' && length - from > 2) {
                const int high = hex_digit_value(text[from + 1]),
                          low = hex_digit_value(text[from + 2]);
                if (high < 0 || low < 0 || (high == 0 && low == 0))
                    return false;
                c = (char)(high * 16 + low);
                from += 2;
            } else {
                return false;
            }
        }
        text[to++] = c;
    }
    text[to] = '\0';
    return true;
}

static void write_key_line(FILE *out, const char *key, const char *text)
{
    (void)fprintf(out, "## %s: ", key);
    stream_write_text(out, text);
    (void)putc('\n', out);
}

static void write_stream_provenance(FILE *out, const wt_provenance *provenance)
{
    (void)fprintf(out, "## weartrack: %s\n", wt_version());
    if (wt_provenance_command(provenance)[0] != '\0')
        write_key_line(out, "command", wt_provenance_command(provenance));
    for (size_t i = 0; i < wt_provenance_n_inputs(provenance); i++) {
        const wt_provenance_input *const input = wt_provenance_get_input(provenance, i);
        /* The fields are separated by tabs, so that a path may contain blanks. */
        (void)fprintf(out, "## input: ");
        stream_write_text(out, input->path);
        (void)putc('\t', out);
        stream_write_text(out, wt_provenance_input_role(input));
        (void)putc('\t', out);
        stream_write_text(out, input->format);
        (void)fprintf(out, "\t%" PRIu64 "\t%s\n", input->bytes,
                      input->sha256[0] != '\0' ? input->sha256 : "-");
    }
}

static void write_stream_columns(FILE *out, const wt_table *table)
{
    for (size_t i = 0; i < table->n_columns; i++) {
        const table_column *const column = &table->columns[i];
        if (column->long_name[0] != '\0') {
            (void)fprintf(out, "## column: %s\t", column->name);
            stream_write_text(out, column->long_name);
            (void)putc('\n', out);
        }
    }
    for (size_t i = 0; i < table->n_columns; i++) {
        const table_column *const column = &table->columns[i];
        (void)fprintf(out, "%s%s[%s]", i == 0 ? "# " : "\t", column->name,
                      column->kind == WT_COLUMN_TEXT ? STREAM_TEXT_UNIT : column->unit);
    }
    (void)putc('\n', out);
}

static void write_stream_rows(FILE *out, const wt_table *table)
{
    size_t next_block = 1;
    for (size_t row = 0; row < table->n_rows; row++) {
        if (next_block < table->n_blocks && table->blocks[next_block] == row) {
            (void)putc('\n', out);
            next_block++;
        }
        for (size_t i = 0; i < table->n_columns; i++) {
            if (i > 0)
                (void)putc('\t', out);
            if (table->columns[i].kind == WT_COLUMN_TEXT) {
                stream_write_text(out, wt_table_text(table, row, i));
            } else {
                char number[32];
                (void)wt_number_format(table->columns[i].numbers[row], number);
                (void)fputs(number, out);
            }
        }
        (void)putc('\n', out);
    }
}

wt_status wt_stream_write(FILE *out, const wt_table *table, const wt_provenance *provenance,
                          wt_error *err)
{
    if (!table_name_is_valid(table->name) || table->n_columns == 0) {
        return wt_fail(err, WT_E_ARG, "table \"%s\" has no columns or no valid name", table->name);
    }
    if (provenance != NULL)
        write_stream_provenance(out, provenance);
    (void)fprintf(out, "## table: %s\n", table->name);
    write_key_line(out, "title", table->title);
    for (size_t i = 0; i < table->n_keys; i++)
        write_key_line(out, table->keys[i].name, table->keys[i].text);
    write_stream_columns(out, table);
    write_stream_rows(out, table);
    /* The end of a table is marked, so that a truncated stream is detected. */
    (void)fputs("##\n", out);
    if (ferror(out))
        return wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno));
    return WT_OK;
}

typedef struct stream_reader {
    FILE *in;
    char *line; /* without the line feed */
    size_t size, length;
    size_t number;     /* of the line, from 1 at the start of the table */
    char **long_names; /* of "## column:" lines: name, long name, name, long name, ... */
    size_t n_long_names;
    wt_table *table;
    bool named; /* the stream has a "## table:" line, and the end of the table must be marked */
} stream_reader;

static void stream_reader_free(stream_reader *r)
{
    free(r->line);
    wt_strings_free(r->long_names, r->n_long_names);
    wt_table_free(r->table);
}

/* Sets the place of the error; `column` counts from 1, 0 means the whole line. */
static void set_error_location(const stream_reader *r, size_t column, wt_error *err)
{
    char of_table[96] = "", of_column[96] = "";
    if (r->named)
        (void)snprintf(of_table, sizeof of_table, " of table %.64s", r->table->name);
    if (column > 0 && r->table != NULL && column <= r->table->n_columns)
        (void)snprintf(of_column, sizeof of_column, ", column %zu (%.48s)", column,
                       r->table->columns[column - 1].name);
    else if (column > 0)
        (void)snprintf(of_column, sizeof of_column, ", column %zu", column);
    wt_error_place(err, "line %zu%s%s", r->number, of_table, of_column);
}

/* Returns WT_OK, WT_END or an error. */
static wt_status read_stream_line(stream_reader *r, wt_error *err)
{
    errno = 0;
    const ssize_t n = getline(&r->line, &r->size, r->in);
    if (n < 0) {
        if (ferror(r->in) || !feof(r->in))
            return wt_fail(err, errno == ENOMEM ? WT_E_MEMORY : WT_E_IO, "cannot read: %s",
                           strerror(errno));
        return WT_END;
    }
    r->number++;
    r->length = (size_t)n;
    if (r->length > 0 && r->line[r->length - 1] == '\n')
        r->length--;
    if (r->length > 0 && r->line[r->length - 1] == '\r')
        r->length--;
    r->line[r->length] = '\0';
    if (r->number == 1 && r->length >= 3 && memcmp(r->line, "\xEF\xBB\xBF", 3) == 0) {
        r->length -= 3;
        memmove(r->line, r->line + 3, r->length + 1);
    }
    const size_t good = utf8_valid_length(r->line, r->length);
    if (good != r->length || memchr(r->line, '\0', r->length) != NULL) {
        (void)wt_fail(err, WT_E_CORRUPT, "the line is not UTF-8 text");
        wt_error_expected(err, "a text stream of weartrack");
        set_error_location(r, 0, err);
        return WT_E_CORRUPT;
    }
    return WT_OK;
}

static wt_status fail_corrupt_stream(const stream_reader *r, size_t column, const char *message,
                                     const char *expected, const char *found, wt_error *err)
{
    (void)wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_expected(err, "%s", expected);
    if (found != NULL)
        wt_error_found(err, "\"%s\"", found);
    set_error_location(r, column, err);
    return WT_E_CORRUPT;
}

/* An invalid name is an error of the file, not of an argument. */
static wt_status fail_refused_name(const stream_reader *r, size_t column, wt_status status,
                                   wt_error *err)
{
    if (status == WT_E_ARG) {
        status = WT_E_CORRUPT;
        if (err != NULL)
            err->status = status;
    }
    set_error_location(r, column, err);
    return status;
}

/* Copies a text, which is needed when the columns are created. */
static void store_long_name(stream_reader *r, const char *text)
{
    r->long_names = array_grow(r->long_names, r->n_long_names, sizeof *r->long_names);
    r->long_names[r->n_long_names++] = wt_strdup(text);
}

/* Parses "## key: value"; the line is changed in place. */
static wt_status read_key_line(stream_reader *r, wt_error *err)
{
    static const char form[] = "a line \"## key: value\"";
    char *const key = r->line + 3;
    char *const colon = strchr(key, ':');
    if (r->length < 4 || r->line[2] != ' ' || colon == NULL)
        return fail_corrupt_stream(r, 0, "not a line of a stream", form, r->line, err);
    char *value = colon + 1;
    if (*value == ' ')
        value++;
    *colon = '\0';
    const bool has_parts = strcmp(key, "input") == 0 || strcmp(key, "column") == 0;
    char *const tab = has_parts ? strchr(value, '\t') : NULL;
    char *const text = tab != NULL ? tab + 1 : value;
    if (strcmp(key, "input") == 0)
        return WT_OK; /* for people only: the table `inputs` has the same contents */
    if (!stream_unescape(text, strlen(text)))
        return fail_corrupt_stream(r, 0, "an escape that is not known",
                                   "\\t, \\n, \\r, \\\\, \\#, \\- or \\x41", text, err);
    if (strcmp(key, "weartrack") == 0 || strcmp(key, "command") == 0)
        return WT_OK;
    if (strcmp(key, "table") == 0) {
        if (r->table != NULL)
            return fail_corrupt_stream(r, 0, "the table has a name already, or its name comes late",
                                       "\"## table:\" once, before the other keys", text, err);
        if (!table_name_is_valid(text))
            return fail_corrupt_stream(r, 0, "not a name for a table",
                                       "a to z, digits, '_' and '/'", text, err);
        r->table = wt_table_new(text, "");
        r->named = true;
        return WT_OK;
    }
    if (strcmp(key, "column") == 0) {
        if (tab == NULL)
            return fail_corrupt_stream(r, 0, "not the words for a column",
                                       "\"## column: name<TAB>words\"", value, err);
        *tab = '\0';
        if (r->n_long_names >= 2 * TABLE_COLUMNS_MAX)
            return fail_corrupt_stream(r, 0, "words for too many columns",
                                       "one line for each column", NULL, err);
        store_long_name(r, value);
        store_long_name(r, text);
        return WT_OK;
    }
    if (r->table == NULL)
        r->table = wt_table_new("table", "");
    if (strcmp(key, "title") == 0) {
        free(r->table->title);
        r->table->title = wt_strdup(text);
        return WT_OK;
    }
    if (wt_table_key(r->table, key) != NULL)
        return fail_corrupt_stream(r, 0, "the key is there twice", "each key once", key, err);
    const wt_status status = wt_table_set_key(r->table, key, text, err);
    return status == WT_OK ? WT_OK : fail_refused_name(r, 0, status, err);
}

/* Terminates a cell at the next tab. Returns the next cell, NULL after the last one. */
static char *split_cell(char *cell)
{
    char *const tab = strchr(cell, '\t');
    if (tab == NULL)
        return NULL;
    *tab = '\0';
    return tab + 1;
}

static const char *find_long_name(const stream_reader *r, const char *name)
{
    for (size_t i = 0; i + 1 < r->n_long_names; i += 2) {
        if (strcmp(r->long_names[i], name) == 0)
            return r->long_names[i + 1];
    }
    return "";
}

/* Parses "# name[unit]<TAB>name[unit]". */
static wt_status read_stream_header(stream_reader *r, wt_error *err)
{
    static const char form[] = "a result, which -o NAME.h5 writes, or a header line \"# "
                               "name[unit]<TAB>name[unit]...\", as "
                               "`weartrack table --format stream` writes";
    if (r->length < 3 || r->line[0] != '#' || r->line[1] != ' ')
        return fail_corrupt_stream(r, 0, "the header line is missing", form, r->line, err);
    wt_status status = WT_OK;
    if (r->table == NULL)
        r->table = wt_table_new("table", "");
    size_t column = 0;
    char *next = NULL;
    for (char *cell = r->line + 2; status == WT_OK && cell != NULL; cell = next) {
        column++;
        next = split_cell(cell);
        const size_t length = strlen(cell);
        char *const bracket = strchr(cell, '[');
        if (bracket == NULL || cell[length - 1] != ']')
            return fail_corrupt_stream(r, column, "a column without a unit", form, cell, err);
        cell[length - 1] = '\0';
        *bracket = '\0';
        const char *const unit = bracket + 1;
        if (strcmp(unit, STREAM_TEXT_UNIT) == 0)
            status = wt_table_add_text_column(r->table, cell, find_long_name(r, cell), err);
        else
            status = wt_table_add_column(r->table, cell, unit, find_long_name(r, cell), err);
        if (status != WT_OK)
            status = fail_refused_name(r, column, status, err);
    }
    return status;
}

static wt_status read_stream_row(stream_reader *r, wt_error *err)
{
    wt_table *const table = r->table;
    wt_status status = wt_table_add_row(table, err);
    size_t n_cells = 0;
    char *next = NULL;
    for (char *cell = r->line; status == WT_OK && cell != NULL; cell = next) {
        next = split_cell(cell);
        const size_t column = n_cells++;
        if (column >= table->n_columns)
            continue;
        if (table->columns[column].kind == WT_COLUMN_TEXT) {
            if (!stream_unescape(cell, strlen(cell)))
                return fail_corrupt_stream(r, column + 1, "an escape that is not known",
                                           "\\t, \\n, \\r, \\\\, \\#, \\- or \\x41", cell, err);
            wt_table_set_text(table, column, cell);
        } else {
            double value;
            if (!parse_stored_number(cell, strlen(cell), &value))
                return fail_corrupt_stream(r, column + 1, "not a number",
                                           "a number with a decimal point, or nan", cell, err);
            wt_table_set_number(table, column, value);
        }
    }
    if (status == WT_OK && n_cells != table->n_columns) {
        status = wt_fail(err, WT_E_CORRUPT, "the row does not fit the header line");
        wt_error_expected(err, "%zu cells parted by tabs", table->n_columns);
        wt_error_found(err, "%zu", n_cells);
        set_error_location(r, 0, err);
    }
    return status;
}

wt_status wt_stream_read(FILE *in, const char *name, wt_table **table, wt_error *err)
{
    stream_reader r = {.in = in};
    bool header = false, ended = false, begun = false;
    wt_status status = WT_OK;
    while (status == WT_OK && !ended) {
        status = read_stream_line(&r, err);
        if (status != WT_OK)
            break;
        if (r.length > 0 && strcmp(r.line, "##") != 0)
            begun = true;
        if (strcmp(r.line, "##") == 0)
            ended = begun; /* "##" before a table is ignored */
        else if (r.length == 0 && header)
            wt_table_new_block(r.table);
        else if (r.length == 0)
            continue;
        else if (!header && strncmp(r.line, "##", 2) == 0)
            status = read_key_line(&r, err);
        else if (!header) {
            status = read_stream_header(&r, err);
            header = true;
        } else if (r.line[0] == '#')
            status =
                fail_corrupt_stream(&r, 0, "a comment among the rows",
                                    "a row, or \"##\" alone where the table ends", r.line, err);
        else
            status = read_stream_row(&r, err);
    }
    if (status == WT_END && begun) {
        status = WT_OK;
        if (r.named) {
            status = wt_fail(err, WT_E_CORRUPT, "the stream ends before the table does");
            wt_error_expected(err, "a line \"##\" alone at its end");
            wt_error_advice(err, "the program that wrote it may have failed: look at its message");
            set_error_location(&r, 0, err);
        }
    }
    if (status == WT_OK && !header)
        status = fail_corrupt_stream(&r, 0, "a table without a header line",
                                     "a header line \"# name[unit]<TAB>name[unit]...\"", NULL, err);
    if (status == WT_OK && r.named)
        table_use_current_names(r.table);
    if (status == WT_OK) {
        *table = r.table;
        r.table = NULL;
    }
    if (status != WT_OK && status != WT_END)
        wt_error_file(err, name);
    stream_reader_free(&r);
    return status;
}
