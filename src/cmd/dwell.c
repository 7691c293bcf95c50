/* weartrack dwell: relaxation and creep behind the approach of force curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_dwell(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "dwell",
        .arguments = "--tip TIP [OPTION]... FILE...",
        .what = "Relaxation at constant height and creep at constant force of the dwell (pause) "
                "behind the approach of force curves, and modulation in it: storage and loss "
                "modulus at the "
                "frequencies that a dwell tells, with their errors. Folders and patterns are "
                "allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables dwell, dwell_moduli and dwell_points follow one another.",
        .n_files = CMD_SOME};
    wt_indent_job job = wt_indent_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_part parts[] = {
        {wt_indent_job_params(), &job, "tip poisson-ratio sample-thickness unbonded", 0},
        {wt_read_params(), &set.read, "spring-constant sensitivity units format", 0}};
    cmd_session s = cmd_session_defaults();
    wt_dwell_tables tables = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin_files(&s, &set))
        goto done;
    job.sets = &set;
    job.n_sets = 1;
    wt_cost_stage(s.cost, "dwell");
    const wt_status made = wt_dwell_make(&job, &s.work, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.dwell, &tables.dwell_moduli, &tables.dwell_points};
    cmd_finish(&s, made, made_tables, COUNT_OF(made_tables));
done:
    wt_dwell_tables_clear(&tables);
    return cmd_session_free(&s);
}
