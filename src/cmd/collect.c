/* weartrack collect: compares results of cases. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

/* Reads the results. A file that cannot be read is reported and skipped. Returns their number. */
static size_t read_collected_cases(cmd_session *s, wt_collected_result *cases, wt_result **results)
{
    const wt_progress *progress = &s->work.progress;
    size_t n = 0;
    for (size_t i = 0; i < s->n_files; i++) {
        const char *path = s->files[i];
        wt_result *result = NULL;
        if (progress->report != NULL)
            (void)progress->report(progress->user, "result", i + 1, s->n_files);
        wt_status read = wt_tables_read(
            path, path, &s->work, (wt_tables_role){"result", "result", "what weartrack run wrote"},
            &result, &s->err);
        if (read == WT_OK && wt_result_find(result, "answer") == NULL &&
            wt_result_find(result, "force_indentation") == NULL &&
            wt_result_find(result, "ramp") == NULL) {
            read = wt_fail(&s->err, WT_E_NOT_FOUND,
                           "this is no result of a case, and no curve of it has a modulus");
            wt_error_file(&s->err, path);
            wt_error_advice(&s->err, "give what weartrack run wrote or, for moduli against "
                                     "temperature, weartrack ramp; beside it, weartrack indent "
                                     "with --curves median; a hard particle needs a stiff "
                                     "cantilever for a modulus");
        }
        if (read != WT_OK) {
            wt_error_file(&s->err, path);
            cmd_report_failure(s);
            wt_result_free(result);
            continue;
        }
        cmd_apply_strict(s, path, cmd_count_remarks(result));
        results[n] = result;
        cases[n++] = (wt_collected_result){result, path};
    }
    return n;
}

int cmd_collect(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "collect",
        .arguments = "[OPTION]... RESULT...",
        .description =
            "Sets the results of cases side by side by their <sample> and <condition>: modulus "
            "of bulk and track against the indentation rate, friction against velocity, and "
            "whether the track of one condition or sample is more different from its bulk than "
            "that of another, corrected for the number of pairs. RESULT may be an output of "
            "weartrack indent, too, such as that of a particle of the filler, whose curve stands "
            "beside, or of weartrack ramp, whose moduli stand in one picture with those of "
            "others.",
        .common = "output files-from provenance",
        .notes = "The tables collection, collected_modulus, collected_friction, collected_ramp, "
                 "collected_force and ratio_pairs follow one another; weartrack report draws "
                 "them.",
        .n_files = CMD_ONE_OR_MORE,
        .files = "no result given"};
    wt_collect_job job = wt_collect_job_defaults();
    cmd_option_group part = {wt_collect_job_params(), &job, NULL, 0};
    cmd_session s = cmd_session_defaults();
    wt_collection_tables tables = {0};
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_begin(&s))
        return cmd_session_free(&s);
    wt_collected_result *cases = wt_alloc(s.n_files, sizeof *cases);
    wt_result **results = wt_alloc(s.n_files, sizeof *results);
    const size_t n = read_collected_cases(&s, cases, results);
    wt_status status = WT_OK;
    if (n == 0) {
        s.status = CMD_FAILED;
        cmd_end(&s, WT_OK);
    } else
        status = wt_collection_compute(cases, n, &job, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.collection,         &tables.collected_modulus,
                                      &tables.collected_friction, &tables.collected_ramp,
                                      &tables.collected_force,    &tables.ratio_pairs};
    if (n > 0 || status != WT_OK)
        cmd_finish(&s, status, made_tables, COUNT_OF(made_tables));
    for (size_t i = 0; i < n; i++)
        wt_result_free(results[i]);
    free(results);
    free(cases);
    return cmd_session_free(&s);
}
