/* weartrack ramp: glass transition and moduli of DMA temperature sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_ramp(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "ramp",
        .arguments = "[OPTION]... FILE...",
        .what = "Glass transition of DMA temperature sweeps: the temperatures at which tan delta "
                "and the loss modulus have their peaks, at each frequency, with their errors; with "
                "--at the moduli and tan delta at temperatures. Isotherms are taken apart by "
                "frequency. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables glass_transition, moduli_at (with --at) and ramp follow one another.",
        .n_files = CMD_SOME};
    wt_ramp_job job = wt_ramp_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_part parts[] = {
        {wt_ramp_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "units format sheet deformation strain sample sample-by", 0}};
    cmd_session s = cmd_session_defaults();
    wt_ramp_tables tables = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin_files(&s, &set))
        goto done;
    job.sets = &set;
    job.n_sets = 1;
    wt_cost_stage(s.cost, "ramp");
    const wt_status made = wt_ramp_make(&job, &s.work, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.glass_transition, &tables.moduli_at, &tables.ramp};
    cmd_finish(&s, made, made_tables, COUNT_OF(made_tables));
done:
    wt_ramp_tables_clear(&tables);
    return cmd_session_free(&s);
}
