/* weartrack validate: compares measured friction with the prediction of a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

static wt_status run_validation_case(cmd_session *s, wt_run_options *run,
                                     const cmd_option_group *job)
{
    const cmd_case_tables requested = {
        .tables = "validation validation_running_in validation_course validation_sources wear",
        .main = "validation",
        .missing = "nothing could be compared with the record",
        .expected = "a case with a material, a counter surface and sliding conditions, "
                    "and a record",
        .records = job};
    const wt_status status = cmd_run_case_tables(s, &requested, run);
    return status == WT_OK && !cmd_shows_short_table(s) ? cmd_write_result(s) : status;
}

int cmd_validate(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "validate",
        .arguments = "[OPTION]... CASE.xml [RECORD]...",
        .description =
            "Does the theory explain the friction that was measured? Records of a tribometer, "
            "or results of weartrack record, are compared with what a case predicts at their "
            "velocities, with and without the layer: yes, no, or inconclusive; the "
            "shear stress that the record asks for; and where the error comes from.",
        .common = "output formats columns provenance",
        .notes = "Without a RECORD those of the case (<record>) are taken."};
    cmd_session s = cmd_session_defaults();
    wt_run_options run = wt_run_defaults();
    wt_validation_job job = wt_validation_job_defaults();
    cmd_option_group parts[] = {{wt_validation_job_params(), &job, NULL, 0},
                                {wt_run_params(), &run, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    bool good = s.n_files > 0 || cmd_usage_error(&s, "one case file is needed");
    good = good && (s.common.n_columns == 0 || cmd_read_formats(&s));
    if (good) {
        s.log = wt_log_new();
        cmd_end(&s, run_validation_case(&s, &run, &parts[0]));
    }
    return cmd_session_free(&s);
}
