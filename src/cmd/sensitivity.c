/* weartrack sensitivity: deflection sensitivity of curves on a hard surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_sensitivity(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "sensitivity",
        .arguments = "[OPTION]... FILE...",
        .what = "Deflection sensitivity (inverse optical lever sensitivity, nm/V) of force curves "
                "on a hard surface: slope in contact of each curve, approach and retract, their "
                "scatter, and whether the surface is hard and the detector straight. Of curves "
                "whose deflection is in metres, the factor that corrects them. Folders and "
                "patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables sensitivity and sensitivity_curves follow one another.",
        .n_files = CMD_SOME};
    wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_part parts[] = {{wt_sensitivity_job_params(), &job, NULL, 0},
                        {wt_read_params(), &set.read, "spring-constant units format", 0}};
    cmd_session s = cmd_session_defaults();
    wt_sensitivity_tables tables = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin_files(&s, &set))
        goto done;
    job.sets = &set;
    job.n_sets = 1;
    wt_cost_stage(s.cost, "sensitivity");
    const wt_status made = wt_sensitivity_make(&job, &s.work, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.sensitivity, &tables.sensitivity_curves};
    cmd_finish(&s, made, made_tables, COUNT_OF(made_tables));
done:
    wt_sensitivity_tables_clear(&tables);
    return cmd_session_free(&s);
}
