/* Tables from files. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/tables.h"

bool cmd_tables_have(const wt_result *tables, const char *prefix)
{
    for (size_t i = 0; tables != NULL && i < wt_result_n_tables(tables); i++)
        if (strncmp(wt_table_name(wt_result_table(tables, i)), prefix, strlen(prefix)) == 0)
            return true;
    return false;
}

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err)
{
    return wt_tables_read(path, path, NULL, (wt_tables_role){NULL, NULL, NULL}, tables, err);
}

void cmd_tables_remarks(cmd_session *s, const char *path, const wt_result *tables)
{
    const wt_table *notes = wt_result_find(tables, "notes");
    const long severity = notes != NULL ? wt_table_find(notes, "severity") : -1;
    size_t n = 0;
    if (severity < 0 || !s->common.strict ||
        wt_table_column_kind(notes, (size_t)severity) != WT_COLUMN_TEXT)
        return;
    for (size_t row = 0; row < wt_table_n_rows(notes); row++)
        n += strcmp(wt_table_text(notes, row, (size_t)severity), wt_severity_name(WT_NOTE)) != 0;
    if (n == 0)
        return;
    cmd_say("weartrack %s: %s: %zu remark%s: exit status 1 (--strict)\n", s->name, path, n,
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

static wt_status several_samples(const wt_result *tables, wt_error *err)
{
    char found[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < wt_result_n_tables(tables) && used < sizeof found; i++) {
        const char *const name = wt_table_name(wt_result_table(tables, i));
        if (strncmp(name, "prony/", 6) == 0)
            used += (size_t)snprintf(found + used, sizeof found - used, "%s%s",
                                     used > 0 ? ", " : "", name + 6);
    }
    wt_fail(err, WT_E_AMBIGUOUS, "materials of several samples");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "make that of one with weartrack master --sample NAME");
    return WT_E_AMBIGUOUS;
}

wt_status cmd_rubber_of(const wt_result *tables, const char *path, double poisson_ratio,
                        wt_rubber *rubber, wt_error *err)
{
    wt_rubber_tables of = {.shift_factors = wt_result_find(tables, "shift_factors"),
                           .material_draws = wt_result_find(tables, "material_draws"),
                           .series_draws = wt_result_find(tables, "series_draws")};
    of.prony = wt_result_find(tables, "prony");
    wt_status status = WT_OK;
    if (of.prony == NULL && cmd_tables_have(tables, "prony/"))
        status = several_samples(tables, err);
    else if (of.prony == NULL)
        status = cmd_table_find(tables, path, "prony", "master", &of.prony, err);
    if (status == WT_OK)
        status = wt_rubber_from_tables(&of, poisson_ratio, rubber, err);
    wt_error_file(status != WT_OK ? err : NULL, path);
    return status;
}

wt_status cmd_rubber_read(const char *path, double poisson_ratio, const wt_job *work,
                          wt_result **tables, wt_rubber *rubber, wt_error *err)
{
    const wt_status status = wt_tables_read(
        path, path, work, (wt_tables_role){"material", "material", NULL}, tables, err);
    return status == WT_OK ? cmd_rubber_of(*tables, path, poisson_ratio, rubber, err) : status;
}
