/* Reads tables of an earlier call as input. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/job.h"

#include "core/base/memory.h"

#include <string.h>

static wt_status read_stream_tables(FILE *in, const char *name, wt_result *tables, wt_error *err)
{
    for (;;) {
        wt_table *table = NULL;
        wt_status status = wt_stream_read(in, name, &table, err);
        if (status == WT_END)
            return WT_OK;
        if (status == WT_OK)
            status = wt_result_add(tables, table, err);
        if (status != WT_OK)
            return status;
    }
}

/* Reads the tables of a text stream in memory. */
static wt_status read_stream_memory(const unsigned char *bytes, size_t length, const char *path,
                                    const char *instead, wt_result **tables, wt_error *err)
{
    wt_result *const read = wt_result_new();
    FILE *const in = fmemopen((void *)(uintptr_t)bytes, length, "r");
    if (in == NULL)
        out_of_memory(BUFSIZ);
    wt_status status = read_stream_tables(in, path, read, err);
    (void)fclose(in);
    if (status == WT_OK && wt_result_n_tables(read) == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no table");
        wt_error_expected(err, "a weartrack text stream or HDF5 result");
    }
    wt_error_file(err, path);
    if ((status == WT_E_FORMAT || status == WT_E_CORRUPT || status == WT_E_EMPTY) &&
        err->advice[0] == '\0')
        wt_error_advice(err, "give %s",
                        instead != NULL ? instead
                                        : "what weartrack indent or weartrack master wrote");
    if (status == WT_OK)
        *tables = read;
    else
        wt_result_free(read);
    return status;
}

static bool has_table_prefix(const wt_result *tables, const char *prefix)
{
    for (size_t i = 0; i < wt_result_n_tables(tables); i++)
        if (strncmp(wt_table_name(wt_result_table(tables, i)), prefix, strlen(prefix)) == 0)
            return true;
    return false;
}

wt_status wt_tables_read(const char *path, const char *name, const wt_job *work,
                         wt_tables_role role, wt_result **tables, wt_error *err)
{
    static const unsigned char hdf5_signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_input *input = NULL;
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK)
        status = wt_input_bytes(input, &bytes, &length, err);
    const bool store = length >= sizeof hdf5_signature &&
                       memcmp(bytes, hdf5_signature, sizeof hdf5_signature) == 0;
    if (status == WT_OK)
        status = store ? wt_store_read_memory(bytes, length, name, tables, err)
                       : read_stream_memory(bytes, length, name, role.instead, tables, err);
    if (status == WT_OK && work != NULL)
        status = wt_job_add_input(
            work,
            (wt_provenance_input){.path = name,
                                  .role = has_table_prefix(*tables, "indentation/")
                                              ? role.curve_role
                                              : role.other_role,
                                  .format = store ? "weartrack-hdf5" : "weartrack-stream"},
            input, err);
    wt_input_close(input);
    return status;
}
