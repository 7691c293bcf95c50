/* Reads tables from files and selects samples. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include <string.h>

bool cmd_tables_contain(const wt_result *tables, const char *prefix)
{
    for (size_t i = 0; tables != NULL && i < wt_result_n_tables(tables); i++)
        if (strncmp(wt_table_name(wt_result_table(tables, i)), prefix, strlen(prefix)) == 0)
            return true;
    return false;
}

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err)
{
    return wt_tables_read(path, path, NULL, (wt_tables_role){.role = WT_ROLE_INPUT}, tables, err);
}

size_t cmd_count_remarks(const wt_result *tables)
{
    const wt_table *notes = wt_result_find(tables, "notes");
    size_t n = 0;
    for (size_t row = 0; notes != NULL && row < wt_table_n_rows(notes); row++)
        n += wt_table_severity(notes, row) != WT_NOTE;
    return n;
}

void cmd_apply_strict(cmd_session *s, const char *path, size_t n)
{
    if (n == 0 || !s->common.strict)
        return;
    cmd_message("weartrack %s: %s: %zu remark%s: exit status 1 (--strict)\n", s->name, path, n,
                n == 1 ? "" : "s");
    s->status = CMD_FAILED;
}

wt_status cmd_table_find(const wt_result *tables, const char *path, const char *prefix,
                         const char *made_by, const wt_table **table, wt_error *err)
{
    for (size_t i = 0; i < wt_result_n_tables(tables); i++) {
        *table = wt_result_table(tables, i);
        if (strncmp(wt_table_name(*table), prefix, strlen(prefix)) == 0)
            return WT_OK;
    }
    wt_fail(err, WT_E_NOT_FOUND, "a table is missing");
    wt_error_file(err, path);
    wt_error_expected(err, "a table '%s'", prefix);
    wt_error_found(err, "'%s'", wt_table_name(wt_result_table(tables, 0)));
    wt_error_advice(err, "give the output of weartrack %s", made_by);
    return WT_E_NOT_FOUND;
}

/* ---- samples --------------------------------------------------------------------------------- */

/* Returns the part after the name of a table and a slash; NULL: another table. */
static const char *table_suffix(const wt_table *table, const char *name)
{
    const size_t n = strlen(name);
    const char *const own = wt_table_name(table);
    return strncmp(own, name, n) == 0 && own[n] == '/' ? own + n + 1 : NULL;
}

/* True if the shifts with a suffix, or without one, have the sample's name. */
static bool shifts_name_sample(const wt_result *tables, const char *suffix, const char *sample)
{
    for (size_t i = 0; i < wt_result_n_tables(tables); i++) {
        const wt_table *t = wt_result_table(tables, i);
        const char *const own = table_suffix(t, "shift_factors");
        const char *const named = wt_table_key(t, "sample");
        if (named != NULL && strcmp(named, sample) == 0 &&
            (suffix != NULL ? own != NULL && strcmp(own, suffix) == 0
                            : strcmp(wt_table_name(t), "shift_factors") == 0))
            return true;
    }
    return false;
}

const wt_table *cmd_sample_table(const wt_result *tables, const char *table, const char *sample)
{
    const wt_table *alone = tables != NULL ? wt_result_find(tables, table) : NULL;
    if (tables == NULL || sample == NULL)
        return alone;
    for (size_t i = 0; i < wt_result_n_tables(tables); i++) {
        const wt_table *t = wt_result_table(tables, i);
        const char *const suffix = table_suffix(t, table);
        if (suffix != NULL &&
            (strcmp(suffix, sample) == 0 || shifts_name_sample(tables, suffix, sample)))
            return t;
    }
    return alone != NULL && shifts_name_sample(tables, NULL, sample) ? alone : NULL;
}

wt_status cmd_check_sample(const wt_result *tables, const char *path, const char *table,
                           const char *sample, wt_error *err)
{
    char found[256] = "";
    size_t used = 0;
    if (cmd_sample_table(tables, table, sample) != NULL)
        return WT_OK;
    for (size_t i = 0; i < wt_result_n_tables(tables) && used < sizeof found; i++) {
        const char *const suffix = table_suffix(wt_result_table(tables, i), table);
        if (suffix != NULL)
            used += (size_t)snprintf(found + used, sizeof found - used, "%s%s",
                                     used > 0 ? ", " : "", suffix);
    }
    if (used == 0 && (sample == NULL || wt_result_find(tables, table) == NULL))
        return WT_OK; /* the tables have no samples */
    const wt_table *const shifts = wt_result_find(tables, "shift_factors");
    const char *const alone = shifts != NULL ? wt_table_key(shifts, "sample") : NULL;
    if (sample == NULL)
        wt_fail(err, WT_E_AMBIGUOUS, "results of several samples");
    else
        wt_fail(err, WT_E_NOT_FOUND, "no result is of the sample \"%s\"", sample);
    wt_error_file(err, path);
    wt_error_found(err, "%s", used > 0 ? found : alone != NULL ? alone : "one without a name");
    if (sample == NULL)
        wt_error_advice(err, "choose one with --sample NAME, here or of weartrack master");
    return err->status;
}

static wt_status create_rubber(const wt_result *tables, const char *path, const char *sample,
                               double poisson_ratio, wt_rubber *rubber, wt_error *err)
{
    wt_rubber_tables of = {.prony = cmd_sample_table(tables, "prony", sample),
                           .shift_factors = cmd_sample_table(tables, "shift_factors", sample),
                           .material_draws = cmd_sample_table(tables, "material_draws", sample),
                           .series_draws = cmd_sample_table(tables, "series_draws", sample)};
    wt_status status = cmd_check_sample(tables, path, "prony", sample, err);
    if (status == WT_OK && of.prony == NULL)
        status = cmd_table_find(tables, path, "prony", "master", &of.prony, err);
    if (status == WT_OK)
        status = wt_rubber_from_tables(&of, poisson_ratio, rubber, err);
    wt_error_file(status != WT_OK ? err : NULL, path);
    return status;
}

wt_status cmd_rubber_read(const char *path, const char *sample, double poisson_ratio,
                          const wt_job *work, wt_result **tables, wt_rubber *rubber, wt_error *err)
{
    wt_status status =
        wt_tables_read(path, path, work, (wt_tables_role){.role = WT_ROLE_MATERIAL}, tables, err);
    if (status == WT_OK)
        status = create_rubber(*tables, path, sample, poisson_ratio, rubber, err);
    if (status == WT_OK && rubber->superposition != WT_SUPERPOSITION_HOLDS)
        wt_log_add(
            work->log, WT_WARNING, path, NULL,
            rubber->superposition == WT_SUPERPOSITION_FAILS
                ? "time-temperature superposition of this material fails: its moduli at "
                  "other temperatures and frequencies than the measured ones are doubtful"
                : "whether time-temperature superposition of this material holds is not "
                  "known: its moduli at other temperatures than the measured ones may be off");
    return status;
}

static export_options export_options_defaults(void)
{
    return (export_options){.form = WT_EXPORT_TSV};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("format", export_options, form, "tsv|csv|json|stream"), .former = "as",
     .help = "how it is written; without it, a name after -o that ends in .csv, .tsv or .json "
             "chooses the form"},
    {PARAM_FLAG_OF("formulas", export_options, formulas),
     .help = "leave a text of tsv and csv that begins with = + - or @ as it is; without this an "
             "apostrophe before it keeps a spreadsheet from taking it for a formula"},
};
PARAM_TABLE(export_params, export_options, rows, export_options_defaults, NO_PARTS)

static wt_export_form select_export_form(const char *output, const cmd_option_group *part)
{
    const export_options *options = part->structure;
    return cmd_option_is_set(part, "format") ? options->form
                                             : export_form_of_suffix(output, options->form);
}

wt_status export_table(cmd_session *s, const cmd_option_group *part, const wt_table *table)
{
    cmd_sink sink;
    const wt_export_form form = select_export_form(s->common.output, part);
    wt_status status = cmd_sink_open(s->common.output, &sink, &s->err);
    if (status == WT_OK)
        cmd_show_first_lines(s, &sink);
    if (status == WT_OK)
        status = wt_table_export(sink.stream, table, form,
                                 ((const export_options *)part->structure)->formulas, &s->err);
    return cmd_sink_close(&sink, status, &s->err);
}
