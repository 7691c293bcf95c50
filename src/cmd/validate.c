/* weartrack validate: compares measured friction with the prediction of a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

/* Requested tables in their order. */
static const char requested_tables[] = "validation validation_running_in validation_course "
                                       "validation_sources wear";

static wt_status fail_missing_validation(cmd_session *s)
{
    wt_fail(&s->err, WT_E_MISSING, "nothing could be compared with the record");
    wt_error_file(&s->err, s->files[0]);
    wt_error_expected(&s->err, "a case with a material, a counter surface and sliding conditions, "
                               "and a record");
    wt_error_advice(&s->err, "`weartrack run --plan` says what each stage lacks");
    return WT_E_MISSING;
}

static wt_status run_validation_case(cmd_session *s, wt_run_options *run, cmd_option_group *job)
{
    wt_case *c = NULL;
    size_t n_failed = 0;
    wt_status status =
        s->common.output != NULL ? wt_check_overwrite(s->common.output, &s->err) : WT_OK;
    if (status == WT_OK)
        status = cmd_check_output(s->common.output, &s->err);
    if (status == WT_OK)
        status = wt_case_read(s->files[0], &c, &s->err);
    if (status == WT_OK)
        status = wt_case_request_tables(c, requested_tables, &s->err);
    if (status == WT_OK)
        status = wt_case_set_validation(c, s->files + 1, s->n_files - 1, job->structure, job->given,
                                        &s->err);
    if (status == WT_OK)
        status = cmd_run_case(s, c, run, &n_failed);
    wt_case_free(c);
    if (s->result != NULL && n_failed > 0)
        cmd_print_failures(s, wt_result_find(s->result, "failures"));
    if (status == WT_OK && wt_result_find(s->result, "validation") == NULL)
        status = fail_missing_validation(s);
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
            "velocities, with and without the layer: explains, does not, or inconclusive; the "
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
