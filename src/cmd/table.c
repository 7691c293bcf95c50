/* weartrack table: exports one table of a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"
#include "core/base/spell_suggest.h"

#include <string.h>

typedef struct table_options {
    bool list, keys;
} table_options;

static const wt_param rows[] = {
    {PARAM_FLAG_OF("list", table_options, list),
     .help = "the tables that there are, with their rows, columns and words"},
    {PARAM_FLAG_OF("keys", table_options, keys),
     .help = "the values that belong to the whole table, with their errors and units, in place of "
             "its rows"},
};
CMD_OPTIONS(table_option_params, table_options, rows)

/* Finds the table of that name; without a name the only table. */
static wt_status choose_table(const wt_result *result, const char *path, const char *name,
                              const wt_table **table, wt_error *err)
{
    const size_t n = wt_result_n_tables(result);
    *table = name != NULL ? wt_result_find(result, name)
             : n == 1     ? wt_result_table(result, 0)
                          : NULL;
    if (*table != NULL)
        return WT_OK;
    if (name != NULL)
        wt_fail(err, WT_E_NOT_FOUND, "there is no table '%s'", name);
    else
        wt_fail(err, WT_E_MISSING, "the name of the table is missing: the result has %zu tables",
                n);
    spell_suggestion near =
        spell_suggestion_begin(name != NULL ? name : "", name != NULL ? strlen(name) : 0);
    for (size_t i = 0; i < n; i++) {
        const char *const other = wt_table_name(wt_result_table(result, i));
        spell_suggestion_try(&near, other, strlen(other));
    }
    wt_error_file(err, path);
    if (near.name != NULL)
        wt_error_advice(err, "did you mean %s? `weartrack table --list %s` shows all", near.name,
                        path);
    else
        wt_error_advice(err, "`weartrack table --list %s` shows them", path);
    return err->status;
}

int cmd_table(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "table",
        .arguments = "[OPTION]... RESULT [NAME]",
        .description =
            "Writes the table NAME of a result (HDF5 or text stream; - is standard input) for "
            "other programs: rows of cells parted by tabs or commas under one header line, or "
            "JSON. In SI units, which stand in the header: modulus[Pa].",
        .common = "output",
        .exports = true,
        .notes = "NAME may be left out if there is one table only."};
    table_options own = {0};
    export_options form = {.form = WT_EXPORT_TSV};
    cmd_option_group parts[] = {{table_option_params(), &own, NULL, 0},
                                {export_params(), &form, NULL, 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL;
    const wt_table *table = NULL;
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        !cmd_require_text_output(&s, true))
        return cmd_session_free(&s);
    if (s.n_files < 1 || s.n_files > (own.list ? 1 : 2)) {
        cmd_usage_error(&s, "a result and the name of a table are needed");
        return cmd_session_free(&s);
    }
    wt_status read = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (read == WT_OK && !own.list)
        read =
            choose_table(s.result, s.files[0], s.n_files > 1 ? s.files[1] : NULL, &table, &s.err);
    if (read == WT_OK && own.list)
        read = wt_result_contents(s.result, &made, &s.err);
    else if (read == WT_OK && own.keys)
        read = wt_table_keys(table, &made, &s.err);
    if (read == WT_OK)
        read = export_table(&s, &parts[1], made != NULL ? made : table);
    if (read == WT_OK)
        cmd_apply_strict(&s, s.files[0], cmd_count_remarks(s.result));
    else
        cmd_fail(&s);
    wt_table_free(made);
    return cmd_session_free(&s);
}
