/* weartrack summary: one row for each result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/export.h"
#include "cmd/tables.h"

/* The headlines of the files that can be read, which are then the first of `files`. */
static int read_all(const cmd_common *common, wt_table **headlines, size_t *n_read)
{
    const char **files = common->files;
    int status = CMD_OK;
    for (size_t i = 0; i < common->n_files; i++) {
        wt_error err = WT_ERROR_INIT;
        wt_result *result = NULL;
        wt_status read = cmd_tables_read(files[i], &result, &err);
        if (read == WT_OK)
            read = wt_result_headlines(result, &headlines[*n_read], &err);
        wt_error_file(&err, files[i]);
        const int good = read != WT_OK ? cmd_fail("summary", &err)
                                       : cmd_tables_remarks("summary", common, files[i], result);
        if (read == WT_OK)
            files[(*n_read)++] = files[i];
        status = good != CMD_OK ? good : status;
        wt_result_free(result);
    }
    return status;
}

int cmd_summary(int argc, char **argv)
{
    static const cmd_usage usage = {
        "summary", "[OPTION]... RESULT...",
        "One row for each result (HDF5 or text stream) with its main numbers, their errors or\n"
        "intervals, and verdicts. A column is there if one of the results has it.",
        "output files-from", "Exit status 1 if a file could not be read; it has no row."};
    cmd_common common = cmd_common_defaults();
    export_options form = {WT_EXPORT_TSV};
    cmd_part part = {export_params(), &form, NULL, 0};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_table *summary = NULL;
    size_t n_read = 0;
    if (!cmd_parse(&usage, &part, 1, &common, argc, argv, &first, &status))
        return status;
    if (common.n_files == 0)
        return cmd_usage_error("summary", "no result given");
    wt_table **headlines = calloc(common.n_files, sizeof *headlines);
    if (headlines == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        return cmd_fail("summary", &err);
    }
    status = read_all(&common, headlines, &n_read);
    if (n_read > 0 && (wt_summary(common.files, (const wt_table *const *)headlines, n_read,
                                  &summary, &err) != WT_OK ||
                       export_table(&common, &part, summary, &err) != WT_OK))
        status = cmd_fail("summary", &err);
    for (size_t i = 0; i < n_read; i++)
        wt_table_free(headlines[i]);
    free(headlines);
    wt_table_free(summary);
    return status;
}
