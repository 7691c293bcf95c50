/* The content of a store, apart from HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/store.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_status store_digest(const wt_result *result, const wt_table *inputs, char hex[65], wt_error *err)
{
    wt_status status = WT_OK;
    char *text = NULL;
    size_t length = 0, case_length = 0;
    const char *const case_file = wt_result_case(result, &case_length);
    FILE *const out = open_memstream(&text, &length);
    if (out == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i < wt_result_n_tables(result); i++)
        status = wt_stream_write(out, wt_result_table(result, i), NULL, err);
    if (status == WT_OK && inputs != NULL)
        status = wt_stream_write(out, inputs, NULL, err);
    if (status == WT_OK && case_file != NULL)
        (void)fwrite(case_file, 1, case_length, out);
    const bool written = !ferror(out);
    if (fclose(out) != 0 || (status == WT_OK && !written))
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        wt_digest(text, length, hex);
    free(text);
    return status;
}

enum { PATH, ROLE, FORMAT, BYTES, SHA256, N_COLUMNS };
static const char *const names[N_COLUMNS] = {"path", "role", "format", "bytes", "sha256"};

wt_status wt_provenance_table(const wt_provenance *provenance, const char *name, wt_table **table,
                              wt_error *err)
{
    static const char *const words[N_COLUMNS] = {"path as given", "what it was used for",
                                                 "format it was read as", "size of the file",
                                                 "SHA-256 digest of the file"};
    wt_table *const t = wt_table_new(name, "Files that were read");
    wt_status status = t != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i < N_COLUMNS; i++)
        status = i == BYTES ? wt_table_add_column(t, names[i], "byte", words[i], err)
                            : wt_table_add_text_column(t, names[i], words[i], err);
    for (size_t i = 0; status == WT_OK && i < wt_provenance_n_inputs(provenance); i++) {
        const wt_provenance_input *const input = wt_provenance_get_input(provenance, i);
        const char *const texts[N_COLUMNS] = {input->path, input->role, input->format, NULL,
                                              input->sha256};
        status = wt_table_add_row(t, err);
        for (size_t c = 0; status == WT_OK && c < N_COLUMNS; c++) {
            if (c == BYTES)
                wt_table_put(t, c, (double)input->bytes);
            else
                status = wt_table_put_text(t, c, texts[c], err);
        }
    }
    if (status == WT_OK)
        *table = t;
    else
        wt_table_free(t);
    return status;
}

wt_status store_inputs_read(const wt_table *table, wt_provenance *provenance, wt_error *err)
{
    size_t columns[N_COLUMNS];
    for (size_t i = 0; i < N_COLUMNS; i++) {
        const long found = wt_table_find(table, names[i]);
        const wt_column_kind kind = i == BYTES ? WT_COLUMN_NUMBER : WT_COLUMN_TEXT;
        if (found < 0 || wt_table_column_kind(table, (size_t)found) != kind)
            return wt_fail(err, WT_E_CORRUPT, "column \"%s\" of the inputs is missing or wrong",
                           names[i]);
        columns[i] = (size_t)found;
    }
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        wt_provenance_input input = {.path = wt_table_text(table, row, columns[PATH]),
                                     .role = wt_table_text(table, row, columns[ROLE]),
                                     .format = wt_table_text(table, row, columns[FORMAT])};
        const double bytes = wt_table_number(table, row, columns[BYTES]);
        const char *const sha256 = wt_table_text(table, row, columns[SHA256]);
        /* 2^63 is exact; what is larger, negative or NaN is no size. */
        if (!(bytes >= 0.0 && bytes < ldexp(1.0, 63)) || strlen(sha256) >= sizeof input.sha256)
            return wt_fail(err, WT_E_CORRUPT, "size or digest of an input is not one");
        input.bytes = (uint64_t)bytes;
        memcpy(input.sha256, sha256, strlen(sha256) + 1);
        if (wt_provenance_add_input(provenance, &input) != WT_OK)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    return WT_OK;
}
