/* weartrack accuracy: error budget and error against run time of a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

static void print_text_keys(const cmd_session *s, const wt_table *table)
{
    for (size_t i = 0; i < wt_table_n_keys(table) && !s->common.quiet; i++) {
        const char *name = wt_table_key_name(table, i);
        wt_estimate number;
        if (!wt_table_estimate(table, name, &number))
            cmd_message("%s: %s\n", name, wt_table_key(table, name));
    }
}

/* Runs a case with requests for only its error budget and error against run time. */
static wt_status run_accuracy_case(cmd_session *s, wt_run_options *run)
{
    static const cmd_case_tables requested = {
        .tables = "error_budget work_precision",
        .main = "error_budget",
        .missing = "the case has no error budget",
        .expected = "a material, a counter surface and sliding conditions"};
    const wt_status status = cmd_run_case_tables(s, &requested, run);
    if (status == WT_OK && !cmd_is_brief(s)) {
        print_text_keys(s, wt_result_find(s->result, "error_budget"));
        if (wt_result_find(s->result, "work_precision") != NULL)
            print_text_keys(s, wt_result_find(s->result, "work_precision"));
    }
    return status == WT_OK && !cmd_shows_short_table(s) ? cmd_write_result(s) : status;
}

int cmd_accuracy(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "accuracy",
        .arguments = "CASE.xml [OPTION]...",
        .description = "Reports which error costs each number of a case most, what would make it "
                       "smaller, and the error against run time for several tolerances, numbers of "
                       "replicates and numbers of isotherms.",
        .common = "output formats columns provenance"};
    cmd_session s = cmd_session_defaults();
    wt_accuracy_job job = wt_accuracy_job_defaults();
    wt_run_options run = wt_run_defaults();
    cmd_option_group parts[] = {{wt_accuracy_job_params(), &job, NULL, 0},
                                {wt_run_params(), &run, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    bool good = true;
    if (s.n_files != 1)
        good = cmd_usage_error(&s, "give the case file");
    good = good && (s.common.n_columns == 0 || cmd_read_formats(&s));
    if (good) {
        s.log = wt_log_new();
        run.precision = job;
        cmd_end(&s, run_accuracy_case(&s, &run));
    }
    return cmd_session_free(&s);
}
