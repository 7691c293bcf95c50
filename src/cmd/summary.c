/* weartrack summary: one row for each result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/export.h"
#include "cmd/tables.h"

/* The headlines of the files that can be read, which are then the first of the files. */
static size_t read_all(cmd_session *s, wt_table **headlines)
{
    size_t n_read = 0;
    const wt_progress progress = cmd_progress_start(s);
    for (size_t i = 0; i < s->n_files; i++) {
        const char *path = s->files[i];
        (void)progress.report(progress.user, "result", i + 1, s->n_files);
        wt_result *result = NULL;
        wt_status read = wt_tables_read_headlines(path, &result, &s->err);
        if (read == WT_OK)
            read = wt_result_headlines(result, &headlines[n_read], &s->err);
        if (read == WT_OK) {
            s->files[n_read++] = path;
            cmd_tables_remarks(s, path, result);
        } else {
            wt_error_file(&s->err, path);
            cmd_fail_one(s);
        }
        wt_result_free(result);
    }
    cmd_progress_end(s);
    if (n_read == 0)
        s->status = CMD_FAILED;
    return n_read;
}

int cmd_summary(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "summary",
        .arguments = "[OPTION]... RESULT...",
        .what = "One row for each result (HDF5 or text stream) with its main numbers, their errors "
                "or intervals, and verdicts. A column is there if one of the results has it.",
        .common = "output files-from",
        .notes =
            "Exit status 3 if a file could not be read, which then has no row; 1 if none could.",
        .n_files = CMD_SOME,
        .files = "no result given"};
    export_options form = {.form = WT_EXPORT_TSV};
    cmd_part part = {export_params(), &form, NULL, 0};
    cmd_session s = cmd_session_defaults();
    wt_table *summary = NULL;
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_is_text(&s))
        return cmd_session_free(&s);
    wt_table **headlines = calloc(s.n_files, sizeof *headlines);
    const size_t n_read = headlines != NULL ? read_all(&s, headlines) : 0;
    wt_status made = headlines != NULL ? WT_OK : wt_fail(&s.err, WT_E_MEMORY, "out of memory");
    if (n_read > 0)
        made = wt_summary(s.files, (const wt_table *const *)headlines, n_read, &summary, &s.err);
    if (n_read > 0 && made == WT_OK)
        made = export_table(&s, &part, summary);
    if (made != WT_OK)
        cmd_fail(&s);
    for (size_t i = 0; i < n_read; i++)
        wt_table_free(headlines[i]);
    free(headlines);
    wt_table_free(summary);
    return cmd_session_free(&s);
}
