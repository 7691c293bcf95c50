/* What every subcommand that calls a job sets up before it and says after it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

cmd_session cmd_session_defaults(void)
{
    return (cmd_session){.work = wt_job_defaults()};
}

int cmd_check_format(const char *name, const char *format, const wt_formats *formats)
{
    if (format == NULL || wt_formats_find(formats, format) != NULL)
        return CMD_OK;
    return cmd_usage_error(name, "--format: there is no format '%s', see weartrack formats list",
                           format);
}

int cmd_begin(cmd_session *s, const char *name, const cmd_common *common, const char *format)
{
    wt_error err = WT_ERROR_INIT;
    s->name = name;
    s->common = common;
    s->log = wt_parselog_new();
    s->result = wt_result_new();
    s->work.failures = wt_failures_new();
    if (s->log == NULL || s->result == NULL || s->work.failures == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        return cmd_fail(name, &err);
    }
    if (wt_formats_new(common->formats, &s->formats, s->log, &err) != WT_OK ||
        (common->output != NULL && wt_guard_write(common->output, &err) != WT_OK))
        return cmd_fail(name, &err);
    const int status = cmd_check_format(name, format, s->formats);
    if (status != CMD_OK)
        return status;
    s->work.formats = s->formats;
    s->work.log = s->log;
    s->work.provenance = wt_result_provenance(s->result);
    s->work.progress = cmd_progress_start(&s->progress, common->quiet);
    return CMD_OK;
}

wt_status cmd_record(cmd_session *s, wt_table **failures, wt_table **notes, wt_error *err)
{
    *failures = *notes = NULL;
    s->n_failed = cmd_print_failures(s->name, s->work.failures);
    if (s->n_failed > 0) {
        *failures = s->work.failures;
        s->work.failures = NULL;
    }
    return wt_parselog_count(s->log) > 0 ? wt_notes_table(s->log, NULL, notes, err) : WT_OK;
}

int cmd_end(cmd_session *s, wt_status made, const wt_error *err)
{
    char sentence[1024];
    cmd_progress_end(&s->progress);
    s->n_failed += cmd_print_failures(s->name, s->work.failures);
    const int said = cmd_say_log(s->name, s->common, s->log, false);
    if (made != WT_OK)
        return cmd_fail(s->name, err);
    if (!s->common->quiet && wt_result_sentence(s->result, sentence, sizeof sentence) > 0)
        cmd_say("weartrack %s: %s\n", s->name, sentence);
    return s->n_failed > 0 ? CMD_FAILED : said;
}

int cmd_finish(cmd_session *s, wt_status made, wt_table **const tables[], size_t n, wt_error *err)
{
    wt_table *failures = NULL, *notes = NULL;
    wt_table **const record[] = {&failures, &notes};
    cmd_progress_end(&s->progress);
    if (made == WT_OK)
        made = cmd_collect(s->result, tables, n, err);
    if (made == WT_OK) {
        wt_result_remarks(s->result, s->work.tolerance, s->log);
        made = cmd_record(s, &failures, &notes, err);
    }
    if (made == WT_OK)
        made = cmd_collect(s->result, record, sizeof record / sizeof *record, err);
    if (made == WT_OK)
        made = cmd_write(s->common, s->result, err);
    return cmd_end(s, made, err);
}

void cmd_session_free(cmd_session *s)
{
    wt_table_free(s->work.failures);
    wt_result_free(s->result);
    wt_parselog_free(s->log);
    wt_formats_free(s->formats);
}
