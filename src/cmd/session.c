/* Common start and end of all subcommands. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"
#include "core/base/text.h"

#include <string.h>
#include <unistd.h>

cmd_session cmd_session_defaults(void)
{
    return (cmd_session){.common = cmd_common_defaults(),
                         .err = WT_ERROR_INIT,
                         .work = wt_job_defaults(),
                         .lines_left =
                             CMD_SCREEN_LINES - 1 /* the last line says where the rest is */};
}

bool cmd_begin(cmd_session *s)
{
    s->log = s->log != NULL ? s->log : wt_log_new();
    s->result = wt_result_new();
    s->work.failures = wt_failures_new();
    if (cmd_check_output(s->common.output, &s->err) != WT_OK)
        return cmd_fail(s);
    s->work.log = s->log;
    s->work.provenance = wt_result_provenance(s->result);
    s->work.left_out = s->common.provenance ? 0 : WT_EXTRA_DIGESTS;
    s->work.progress = cmd_progress_start(s);
    if (s->common.cost)
        s->work.cost = s->cost = wt_cost_new(s->common.provenance, s->work.threads);
    return true;
}

bool cmd_read_formats(cmd_session *s)
{
    if (wt_formats_new(s->common.formats, &s->formats, s->log, &s->err) != WT_OK)
        return cmd_fail(s);
    const wt_status status =
        wt_formats_add_columns(s->formats, s->common.columns, s->common.n_columns, &s->err);
    if (status == WT_E_ARG)
        return cmd_usage_error(s, "--columns: %s; %s", s->err.message, s->err.found);
    return status == WT_OK || cmd_fail(s);
}

bool cmd_begin_reading(cmd_session *s, const char *format)
{
    s->log = wt_log_new();
    if (!cmd_read_formats(s))
        return false;
    if (format != NULL && wt_formats_find(s->formats, format) == NULL) {
        spell_suggestion near = spell_suggestion_begin(format, strlen(format));
        for (size_t i = 0; i < wt_formats_count(s->formats); i++) {
            const char *const id = wt_formats_get(s->formats, i)->id;
            spell_suggestion_try(&near, id, strlen(id));
        }
        return cmd_usage_error(
            s, "--format: there is no format '%s'%s%s, see weartrack formats list", format,
            near.name != NULL ? "; did you mean " : "", near.name != NULL ? near.name : "");
    }
    s->work.formats = s->formats;
    return cmd_begin(s);
}

bool cmd_begin_files(cmd_session *s, wt_file_set *set)
{
    set->patterns = s->files;
    set->n_patterns = s->n_files;
    return cmd_begin_reading(s, set->read.format);
}

bool cmd_begin_job(cmd_session *s, const cmd_usage *usage, cmd_option_group *parts, size_t n_parts,
                   wt_file_set *set, int argc, char **argv)
{
    if (!cmd_parse(s, usage, parts, n_parts, argc, argv) || !cmd_begin_files(s, set))
        return false;
    wt_cost_begin_stage(s->cost, usage->name);
    return true;
}

/* Warns of --columns that no file uses: the names are probably misspelled. */
static void warn_unused_columns(cmd_session *s)
{
    const wt_provenance *p = wt_result_provenance(s->result);
    for (size_t i = 0; i < wt_provenance_n_inputs(p); i++)
        if (wt_provenance_get_input(p, i)->given_columns)
            return;
    if (s->common.n_columns > 0)
        wt_log_add(s->log, WT_WARNING, NULL, NULL,
                   "no file was read by the columns of --columns: none has such names, or "
                   "its layout is known without them");
}

void cmd_share_unit_options(cmd_session *s, wt_read_options *read)
{
    read->unit_usage = wt_alloc(read->n_units + 1, sizeof *read->unit_usage);
    s->shared = read;
}

static void warn_unused_units(cmd_session *s)
{
    for (size_t u = 0; s->shared != NULL && u < s->shared->n_units; u++) {
        const wt_unit_usage *const use = &s->shared->unit_usage[u];
        if (use->used)
            continue;
        if (use->overruled)
            wt_log_add(s->log, WT_WARNING, NULL, NULL,
                       "--units %s does not apply: every file with such a column says its "
                       "unit, \"%s\"",
                       s->shared->units[u], use->stated);
        else
            wt_log_add(s->log, WT_WARNING, NULL, NULL, "--units %s: no file has such a column",
                       s->shared->units[u]);
    }
}

wt_status cmd_write_record(cmd_session *s, wt_table_sink sink, void *user)
{
    warn_unused_columns(s);
    warn_unused_units(s);
    wt_status status = WT_OK;
    wt_table *failures = s->work.failures, *quality = NULL, *notes = NULL;
    if (cmd_print_failures(s, failures)) {
        status = wt_failures_set_status(
            failures, s->status == CMD_FAILED ? WT_RESULT_EMPTY : WT_RESULT_PARTIAL, &s->err);
        s->work.failures = status == WT_OK ? NULL : failures;
        if (status == WT_OK)
            status = sink(user, failures, &s->err);
    }
    if (status == WT_OK && wt_log_count(s->log) > 0) {
        status = wt_data_quality_table(s->log, NULL, &quality, &s->err);
        if (status == WT_OK && quality != NULL)
            status = sink(user, quality, &s->err);
        if (status == WT_OK)
            status = wt_notes_table(s->log, NULL, &notes, &s->err);
        if (status == WT_OK)
            status = sink(user, notes, &s->err);
    }
    return status;
}

/* Prints the call that follows, with the name of the result, which must be HDF5. */
static void print_next_call(const cmd_session *s)
{
    const char *const output = s->common.output, *text = s->next;
    char *whole = NULL;
    size_t size = 0;
    if (output != NULL && !cmd_is_hdf5_path(output))
        return;
    FILE *const out = open_memstream(&whole, &size);
    if (out == NULL)
        cmd_exit_without_memory(sizeof whole);
    const bool unwritten = output == NULL && strchr(text, CMD_NEXT_RESULT) != NULL;
    fputs(unwritten ? "repeat with -o RESULT.h5, then weartrack " : "weartrack ", out);
    for (const char *at; (at = strchr(text, CMD_NEXT_RESULT)) != NULL; text = at + 1) {
        fwrite(text, 1, (size_t)(at - text), out);
        cmd_print_argument(out, output != NULL ? output : "RESULT.h5");
    }
    fputs(text, out);
    fclose(out);
    fputs("next     ", stdout);
    cmd_wrap(stdout, CMD_LABEL_WIDTH, CMD_LABEL_WIDTH, whole);
    free(whole);
}

void cmd_end(cmd_session *s, wt_status status)
{
    cmd_progress_end(s);
    if (status == WT_OK)
        cmd_print_short_table(s, false);
    cmd_print_failures(s, s->work.failures);
    cmd_print_log(s, s->log, false);
    if (status != WT_OK)
        cmd_fail(s);
    else
        cmd_print_place_of_rest(s);
    /* a pipe gets tables only */
    if (status == WT_OK && s->next != NULL && isatty(STDOUT_FILENO) && !s->common.quiet &&
        !cmd_log_is_json())
        print_next_call(s);
}

static wt_status add_result_table(void *result, wt_table *table, wt_error *err)
{
    return wt_result_add(result, table, err);
}

void cmd_finish(cmd_session *s, wt_status status, wt_table **const tables[], size_t n)
{
    cmd_progress_end(s);
    for (size_t i = 0; i < n; i++) {
        wt_table *const table = *tables[i];
        *tables[i] = NULL;
        if (status == WT_OK && table != NULL)
            status = wt_result_add(s->result, table, &s->err);
        else
            wt_table_free(table);
    }
    if (status == WT_OK && s->cost != NULL) {
        wt_table *cost = NULL;
        status = wt_cost_table(s->cost, &cost, &s->err);
        if (status == WT_OK)
            status = wt_result_add(s->result, cost, &s->err);
    }
    if (status == WT_OK) {
        wt_result_log_remarks(s->result, s->log);
        status = cmd_write_record(s, add_result_table, s->result);
    }
    if (status == WT_OK && !cmd_shows_short_table(s))
        status = cmd_write_result(s);
    cmd_end(s, status);
}

wt_status cmd_run_case(cmd_session *s, const wt_case *c, wt_run_options *run, size_t *n_failed)
{
    *n_failed = 0;
    run->formats = s->common.formats;
    run->columns = s->common.columns;
    run->n_columns = s->common.n_columns;
    run->no_provenance = !s->common.provenance;
    run->progress = cmd_progress_start(s);
    const wt_status status = wt_run_case(c, run, s->log, &s->result, n_failed, &s->err);
    cmd_progress_end(s);
    return status;
}

wt_status cmd_run_case_tables(cmd_session *s, const cmd_case_tables *requested, wt_run_options *run)
{
    const cmd_option_group *job = requested->records;
    wt_case *c = NULL;
    size_t n_failed = 0;
    s->main_table = requested->main;
    wt_status status =
        s->common.output != NULL ? wt_check_overwrite(s->common.output, &s->err) : WT_OK;
    if (status == WT_OK)
        status = cmd_check_output(s->common.output, &s->err);
    if (status == WT_OK)
        status = wt_case_read(s->files[0], &c, &s->err);
    if (status == WT_OK)
        status = wt_case_request_tables(c, requested->tables, &s->err);
    if (status == WT_OK && job != NULL)
        status = wt_case_set_validation(c, s->files + 1, s->n_files - 1, job->structure, job->given,
                                        &s->err);
    if (status == WT_OK)
        status = cmd_run_case(s, c, run, &n_failed);
    wt_case_free(c);
    if (s->result != NULL && n_failed > 0)
        cmd_print_failures(s, wt_result_find(s->result, "failures"));
    if (status == WT_OK && wt_result_find(s->result, requested->main) == NULL) {
        status = wt_fail(&s->err, WT_E_MISSING, "%s", requested->missing);
        wt_error_file(&s->err, s->files[0]);
        wt_error_expected(&s->err, "%s", requested->expected);
        wt_error_advice(&s->err, "`weartrack run --plan` says what each stage lacks");
    }
    return status;
}

int cmd_session_free(cmd_session *s)
{
    for (size_t i = 0; i < s->n_parts; i++)
        wt_params_clear(s->parts[i].params, s->parts[i].structure, &s->parts[i].given);
    wt_strings_free((char **)s->common.columns, s->common.n_columns);
    if (s->shared != NULL) {
        free(s->shared->unit_usage);
        s->shared->unit_usage = NULL;
    }
    free(s->files);
    free(s->names);
    wt_table_free(s->work.failures);
    wt_result_free(s->result);
    wt_cost_free(s->cost);
    wt_log_free(s->log);
    wt_formats_free(s->formats);
    return s->status;
}
