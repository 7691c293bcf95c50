/* Writes tables as a text stream. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/stream.h"
#include "core/table/table.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

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
        stream_write_text(out, input->role);
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
