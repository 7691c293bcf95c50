/* Tables of a job: those of an earlier call as input, and the notes of its log.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/job.h"

#include "core/base/memory.h"
#include "core/store/store.h"
#include "core/table/table_rows.h"
#include "job/inputs.h"
#include "weartrack/read.h"

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
    const bool of_group =
        status == WT_OK && role.group != NULL && has_table_prefix(*tables, "indentation/");
    if (status == WT_OK && work != NULL)
        status = wt_job_add_input(
            work,
            (wt_provenance_input){.path = name,
                                  .role = of_group ? WT_ROLE_GROUP : role.role,
                                  .group = of_group ? role.group : NULL,
                                  .format = store ? "weartrack-hdf5" : "weartrack-stream"},
            input, err);
    wt_input_close(input);
    return status;
}

wt_status wt_tables_read_main_values(const char *path, wt_result **tables, wt_error *err)
{
    return store_read(path, store_extract_main_values, tables, NULL) == WT_OK
               ? WT_OK /* a damaged file is read whole, for its message */
               : wt_tables_read(path, path, NULL, (wt_tables_role){.instead = NULL}, tables, err);
}

/* ---- notes of a log -------------------------------------------------------------------------- */

TABLE_ROW(notes, NOTES, const char *severity, *file; wt_log_entry entry;)

wt_status wt_notes_table(const wt_log *log, const char *folder, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&notes_schema, err);
    for (size_t i = 0; i < wt_log_count(log); i++) {
        wt_log_entry entry = wt_log_get(log, i);
        TABLE_ADD(notes, &t, wt_severity_name(entry.severity),
                  flow_relative_path(folder, entry.file), entry);
    }
    return table_end(&t, table);
}

wt_severity wt_table_severity(const wt_table *table, size_t row)
{
    const long column = wt_table_find(table, "severity");
    if (column < 0 || wt_table_column_kind(table, (size_t)column) != WT_COLUMN_TEXT)
        return WT_NOTE;
    return (wt_severity)closed_list_read(&severity_list, wt_table_text(table, row, (size_t)column))
        .value;
}

TABLE_ROW(data_quality, DATA_QUALITY, const char *file, *action; double n_values;
          wt_log_entry entry;)

wt_status wt_data_quality_table(const wt_log *log, const char *folder, wt_table **table,
                                wt_error *err)
{
    *table = NULL;
    table_writer t = table_begin(&data_quality_schema, err);
    size_t n = 0;
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry entry = wt_log_get(log, i);
        if (entry.action == WT_ACTION_NONE)
            continue;
        n++;
        TABLE_ADD(data_quality, &t, flow_relative_path(folder, entry.file),
                  action_text(entry.action),
                  entry.n_values > 0 ? (double)entry.n_values : (double)NAN, entry);
    }
    const wt_status status = table_end(&t, table);
    if (n == 0) {
        wt_table_free(*table);
        *table = NULL;
    }
    return status;
}
