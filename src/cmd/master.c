/* weartrack master: shift factors, master curve, WLF and Prony series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_master(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "master",
        .arguments = "[OPTION]... FILE...",
        .what = "Fits one relaxation spectrum to all isotherms of DMA frequency sweeps, with their "
                "shifts, the law of these and the errors of everything; says whether superposition "
                "holds. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables prony, shift_factors and master_curve follow one another, then draws "
                 "of all that is not known of the material, material_draws and series_draws; "
                 "weartrack friction, layer and compare read them as they are.",
        .n_files = CMD_SOME};
    wt_master_job job = wt_master_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_part parts[] = {{wt_master_job_params(), &job,
                         "reference-temperature vertical-shift expansion terms-per-decade liquid",
                         0},
                        {wt_read_params(), &set.read, "temperature units format sheet", 0}};
    cmd_session s = cmd_session_defaults();
    wt_master_tables tables = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin_files(&s, &set))
        goto done;
    job.sets = &set;
    job.n_sets = 1;
    wt_cost_stage(s.cost, "master_curve");
    const wt_status made = wt_master_make(&job, &s.work, &tables, NULL, &s.err);
    wt_table **const made_tables[] = {&tables.prony, &tables.shift_factors, &tables.master_curve,
                                      &tables.material_draws, &tables.series_draws};
    cmd_finish(&s, made, made_tables, COUNT_OF(made_tables));
done:
    wt_master_tables_clear(&tables);
    return cmd_session_free(&s);
}
