/* weartrack sensitivity: deflection sensitivity from curves on a hard surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_sensitivity(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "sensitivity",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Deflection sensitivity (inverse optical lever sensitivity, nm/V) of force curves "
            "on a hard surface: slope in contact of each curve, approach and retract, their "
            "scatter, and whether the surface is hard and the detector straight. Of curves "
            "whose deflection is in metres, the factor that corrects them. Folders and "
            "patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables sensitivity and sensitivity_curves follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_sensitivity_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "spring-constant units format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_sensitivity_tables made = {0};
    wt_table **const tables[] = {&made.sensitivity, &made.sensitivity_curves};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_sensitivity_compute(&job, &s.work, &made, &s.err), tables,
                   COUNT_OF(tables));
    return cmd_session_free(&s);
}
