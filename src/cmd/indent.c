/* weartrack indent: contact point and modulus of every force curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_indent(int argc, char **argv)
{
    static const cmd_usage usage = {
        "indent", "--tip TIP [OPTION]... FILE...",
        "Fits baseline, contact point and modulus of every approach curve of the files (folders "
        "and\n"
        "patterns are allowed). One row per curve; a curve without a modulus says why.",
        "output formats files-from provenance",
        "Exit status 1 if a file could not be read; the others are answered all the same."};
    cmd_common common = cmd_common_defaults();
    wt_indent_job job = wt_indent_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_session s = cmd_session_defaults();
    cmd_part parts[] = {
        {wt_indent_job_params(), &job, NULL, 0},
        {wt_file_set_params(), &set, "spot spring-constant sensitivity units format", 0},
        {wt_job_params(), &s.work, "threads", 0}};
    enum { N_PARTS = sizeof parts / sizeof parts[0] };
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_indent_tables tables = {0};
    wt_table *groups = NULL;

    if (!cmd_parse(&usage, parts, N_PARTS, &common, argc, argv, &first, &status))
        goto done;
    if (common.n_files == 0) {
        status = cmd_usage_error("indent", "no file given");
        goto done;
    }
    set.patterns = common.files;
    set.n_patterns = common.n_files;
    job.sets = &set;
    job.n_sets = 1;
    status = cmd_begin(&s, "indent", &common, set.read.format);
    if (status != CMD_OK)
        goto done;
    wt_status made = wt_indent_group(&job, &s.work, &tables, &err);
    const wt_table *const indentation[] = {tables.indentation};
    if (made == WT_OK)
        made = wt_modulus_groups(indentation, 1, &groups, &err);
    wt_table **const made_tables[] = {&tables.indentation, &groups, &tables.force_displacement,
                                      &tables.force_indentation};
    status = cmd_finish(&s, made, made_tables, sizeof made_tables / sizeof made_tables[0], &err);
done:
    wt_table_free(groups);
    wt_indent_tables_clear(&tables);
    cmd_session_free(&s);
    cmd_parts_clear(parts, N_PARTS);
    return status;
}
