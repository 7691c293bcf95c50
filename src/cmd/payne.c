/* weartrack payne: softening with strain, of DMA strain sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_payne(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "payne",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Determines from DMA strain sweeps how a filled rubber softens with the strain "
            "amplitude (Payne effect), at each frequency and temperature: moduli relative to those "
            "of the smallest amplitudes, the amplitudes at which the storage modulus has lost a "
            "tenth and half, and the maximum of the loss modulus. Folders and patterns are "
            "allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables payne and payne_sweep follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_payne_job job = wt_payne_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_read_params(), &set.read,
         "units format sheet temperature temperature-in-name frequency deformation "
         "sample sample-by conditioning",
         0}};
    cmd_session s = cmd_session_defaults();
    wt_payne_tables made = {0};
    wt_table **const tables[] = {&made.payne, &made.payne_sweep};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_payne_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
