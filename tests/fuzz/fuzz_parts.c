/* Fuzz target: any bytes as a text stream of this program, read at once and part by part. Both
 * readings find the same tables or the same error.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/formats.h"
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool good)
{
    if (!good)
        abort();
}

static void same_numbers(const double *a, const double *b, size_t n)
{
    check(n == 0 || memcmp(a, b, n * sizeof *a) == 0);
}

static void same_table(const text_table *a, const text_table *b)
{
    check(a->names_line == b->names_line && a->step_line == b->step_line);
    check(strcmp(a->title, b->title) == 0 && a->n_names == b->n_names);
    check(a->n_columns == b->n_columns && a->n_problems == b->n_problems);
    check(a->quantities == b->quantities && a->n_rows == b->n_rows);
    same_numbers(a->values, b->values, a->n_rows * a->n_columns);
    same_numbers(a->header.value, b->header.value, HEADER_COUNT);
    for (size_t i = 0; i < a->n_rows; i++)
        check(a->blocks[i] == b->blocks[i] && a->kinds[i] == b->kinds[i] &&
              a->row_lines[i] == b->row_lines[i] && a->samples[i] == b->samples[i]);
}

static void same_file(const text_file *a, const text_file *b)
{
    check(a->n_seen == b->n_seen && a->quantities == b->quantities);
    check(a->unknown.n == b->unknown.n && a->steps.n == b->steps.n && a->samples.n == b->samples.n);
    check(a->feed->n == b->feed->n && a->feed->n_replaced == b->feed->n_replaced);
    for (size_t i = 0; i < a->description->n_fields; i++)
        check(a->values[i].line == b->values[i].line &&
              strcmp(a->values[i].text, b->values[i].text) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static wt_formats *formats;
    wt_input *input = NULL;
    text_parts *parts = NULL;
    text_file whole;
    wt_error why = WT_ERROR_INIT, err = WT_ERROR_INIT;
    const wt_read_options options = wt_read_defaults();
    if (formats == NULL && wt_formats_new(NULL, &formats, NULL, &err) != WT_OK)
        abort();
    const file_reader *const reader = formats_find_reader(formats, "weartrack-stream");
    check(reader != NULL);
    const unsigned kinds = reader->description->kinds;
    if (size == 0 || wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        return 0;
    const wt_status all = text_scan(reader, input, kinds, &options, NULL, &whole, &why);
    wt_status status =
        text_parts_begin(reader, input, 1 + size % 97, kinds, &options, NULL, &parts, &err);
    const text_file *const part = parts != NULL ? text_parts_file(parts) : NULL;
    for (size_t n = 0; status == WT_OK && (status = text_parts_next(parts, &err)) == WT_OK;) {
        check(part->n_tables > 0);
        for (size_t i = 0; i < part->n_tables && all == WT_OK; i++, n++) {
            check(n < whole.n_tables);
            same_table(&part->tables[i], &whole.tables[n]);
        }
    }
    check(all == WT_OK ? status == WT_END : status == all);
    if (all == WT_OK) {
        same_file(part, &whole);
        text_file_free(&whole);
    } else {
        check(strcmp(err.message, why.message) == 0 && strcmp(err.place, why.place) == 0);
    }
    text_parts_free(parts);
    wt_input_close(input);
    return 0;
}
