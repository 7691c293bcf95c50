/* weartrack table: one table of a result for other programs. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "cmd/export.h"
#include "cmd/tables.h"

typedef struct own_options {
    bool list, keys;
} own_options;

static own_options no_options(void)
{
    return (own_options){false, false};
}

static const wt_param rows[] = {
    {PARAM_FLAG_OF("list", own_options, list),
     .help = "the tables that there are, with their rows, columns and words"},
    {PARAM_FLAG_OF("keys", own_options, keys),
     .help = "the values that belong to the whole table, with their errors and units, in place of "
             "its rows"},
};
PARAM_LOCAL_TABLE(own_params, own_options, rows, no_options, NO_PARTS)

/* The table of that name; without a name the only one. */
static wt_status choose(const wt_result *result, const char *path, const char *name,
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
        wt_fail(err, WT_E_MISSING, "there are %zu tables: say which", n);
    wt_error_file(err, path);
    wt_error_advice(err, "`weartrack table --list %s` shows them", path);
    return err->status;
}

int cmd_table(int argc, char **argv)
{
    static const cmd_usage usage = {
        "table", "[OPTION]... RESULT [NAME]",
        "Writes the table NAME of a result (HDF5 or text stream; - is standard input) for other\n"
        "programs: rows of cells parted by tabs or commas under one header line, or JSON. In SI\n"
        "units, which stand in the header: modulus[Pa].",
        "output", "NAME may be left out if there is one table only."};
    cmd_common common = cmd_common_defaults();
    own_options own = no_options();
    export_options form = {WT_EXPORT_TSV};
    cmd_part parts[] = {{own_params(), &own, NULL, 0}, {export_params(), &form, NULL, 0}};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_result *result = NULL;
    wt_table *made = NULL;
    const wt_table *table = NULL;
    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &common, argc, argv, &first,
                   &status))
        return status;
    if (argc - first < 1 || argc - first > (own.list ? 1 : 2))
        return cmd_usage_error("table", "a result and the name of a table are needed");
    wt_status read = cmd_tables_read(argv[first], &result, &err);
    if (read == WT_OK && !own.list)
        read = choose(result, argv[first], argv[first + 1], &table, &err);
    if (read == WT_OK && own.list)
        read = wt_result_contents(result, &made, &err);
    else if (read == WT_OK && own.keys)
        read = wt_table_keys(table, &made, &err);
    if (read == WT_OK)
        read = export_table(&common, &parts[1], made != NULL ? made : table, &err);
    status = read != WT_OK ? cmd_fail("table", &err)
                           : cmd_tables_remarks("table", &common, argv[first], result);
    wt_table_free(made);
    wt_result_free(result);
    return status;
}
