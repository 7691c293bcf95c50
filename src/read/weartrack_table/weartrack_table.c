/* Reads measurements in HDF5 files of this program, weartrack-hdf5(5), which `weartrack convert`
 * writes. The tables are converted to a text stream, which its description reads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "core/store/store.h"
#include "core/table/registry.h"
#include "read/bytes/input.h"
#include "read/header_values.h"
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

/* The attributes of the root, among them the version, follow the signature. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(PEEK_BEGINS(peek, HDF5_SIGNATURE) && PEEK_CONTAINS(peek, "weartrack"),
                              90);
}

/* True for a table of measured data. Results such as a master curve have columns of the same names.
 * If a file has a measured spectrum, its table "roughness" repeats it. */
static bool is_measurement(const wt_result *result, const char *name)
{
    if (strcmp(name, "roughness") == 0 && wt_result_find(result, "power_spectrum") != NULL)
        return false;
    static const char *const names[] = {"force_curve/", "image/", "sweep", "roughness",
                                        "power_spectrum"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strncmp(name, names[i], strlen(names[i])) == 0)
            return true;
    return false;
}

/* Warns of tables that are not read. Tables about the file itself are no loss. */
static void warn_skipped_tables(wt_log *log, const char *name, const wt_result *result)
{
    char names[160] = "";
    size_t n = 0, used = 0;
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const char *table = wt_table_name(wt_result_table(result, i));
        if (is_measurement(result, table) || strcmp(table, "notes") == 0 ||
            strcmp(table, "failures") == 0)
            continue;
        n++;
        if (used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", n > 1 ? ", " : "",
                                     table);
    }
    /* the output of weartrack psd has its spectrum read, and tables about it */
    const bool spectrum = wt_result_find(result, "power_spectrum") != NULL &&
                          wt_result_find(result, "answer") == NULL;
    if (n > 0)
        wt_log_add(log, spectrum ? WT_NOTE : WT_WARNING, name, NULL,
                   "tables that are no measurements are left out, %zu (%s%s); `weartrack "
                   "table` writes them",
                   n, names, used < sizeof names ? "" : "...");
}

static wt_status read_stored_result(wt_input *input, wt_result **result, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    const wt_status status = wt_input_bytes(input, &bytes, &length, err);
    return status == WT_OK ? wt_store_read_memory(bytes, length, wt_input_name(input), result, err)
                           : status;
}

/* Converts the tables of measurements to a text stream in memory. */
static wt_status convert_tables_to_text(const file_reader *self, wt_input *input, wt_log *log,
                                        wt_input **text, wt_error *err)
{
    wt_result *result = NULL;
    char *bytes = NULL;
    size_t length = 0, n_measured = 0;
    (void)self;
    wt_status status = read_stored_result(input, &result, err);
    if (status != WT_OK)
        return status;
    FILE *const stream = text_stream_open(&bytes, &length);
    for (size_t i = 0; i < wt_result_n_tables(result) && status == WT_OK; i++) {
        const wt_table *table = wt_result_table(result, i);
        if (!is_measurement(result, wt_table_name(table)))
            continue;
        n_measured++;
        status = wt_stream_write(stream, table, NULL, err);
    }
    text_stream_close(stream);
    if (status == WT_OK && n_measured == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no force curve, sweep, spectrum or image in it");
        wt_error_expected(err, "what `weartrack convert` writes of measurements");
        wt_error_advice(err, "`weartrack table --list` shows what is in it");
        if (wt_result_n_tables(result) > 0)
            wt_error_found(err, "other tables, the first is \"%s\"",
                           wt_table_name(wt_result_table(result, 0)));
    }
    if (status == WT_OK)
        warn_skipped_tables(log, wt_input_name(input), result);
    wt_result_free(result);
    if (status == WT_OK)
        *text = input_from_bytes(bytes, length, wt_input_name(input));
    else
        free(bytes);
    return status;
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    wt_result *result = NULL;
    bool measured = false;
    wt_status status = read_stored_result(input, &result, metadata->err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const wt_table *table = wt_result_table(result, i);
        char item[128];
        snprintf(item, sizeof item, "%s %s", fact_item_text(FACT_TABLE), wt_table_name(table));
        metadata_add(metadata, item, "", "", "%zu rows", wt_table_n_rows(table));
        measured = measured || is_measurement(result, wt_table_name(table));
    }
    wt_result_free(result);
    return measured ? text_describe_converted(self, input, options, log, metadata) : WT_OK;
}

const file_reader reader_stored = {
    .info = {.id = "weartrack-hdf5",
             .title = "weartrack-hdf5(5): sweeps, spectra, images and force curves of this program",
             .kinds = WT_KIND_FORCE | WT_KIND_SWEEP | WT_KIND_IMAGE | WT_KIND_SPECTRUM,
             .verified = true,
             .evidence = "the HDF5 file that this program writes",
             .version = "1"},
    CURVE_TEXT_READER(convert_tables_to_text),
    .detect = detect,
    .read_sweep = text_read_sweep,
    .read_images = text_read_images,
    .read_spectrum = text_read_spectrum,
    .describe = describe,
};
