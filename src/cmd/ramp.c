/* weartrack ramp: glass transition and moduli of DMA temperature sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_ramp(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "ramp",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Determines the glass transition from DMA temperature sweeps: the temperatures of the "
            "peaks of tan delta and of the loss modulus at each frequency, with their errors. With "
            "--at it also reports the moduli and tan delta at these temperatures. Isotherms are "
            "split by frequency. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables glass_transition, moduli_at (with --at) and ramp follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_ramp_job job = wt_ramp_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_ramp_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read,
         "temperature-in-name frequency units format sheet deformation strain sample sample-by "
         "conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_ramp_tables made = {0};
    wt_table **const tables[] = {&made.glass_transition, &made.moduli_at, &made.ramp};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_ramp_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
