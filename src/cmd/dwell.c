/* weartrack dwell: relaxation and creep after the approach of force curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_dwell(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "dwell",
        .arguments = "--tip TIP [OPTION]... FILE...",
        .description = "Analyses the dwell (pause) after the approach of force curves: relaxation "
                       "at constant height, creep at constant force, and modulation. It reports "
                       "storage and loss modulus with their errors at the frequencies that a dwell "
                       "determines. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables dwell, dwell_moduli and dwell_points follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_indent_job job = wt_indent_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_indent_job_params(), &job, "tip poisson-ratio sample-thickness unbonded", 0},
        {wt_read_params(), &set.read, "spring-constant sensitivity units format sheet conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_dwell_tables made = {0};
    wt_table **const tables[] = {&made.dwell, &made.dwell_moduli, &made.dwell_points};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_dwell_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
