/* weartrack thermal: spring constant from the thermal noise of the cantilever.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_thermal(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "thermal",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Spring constant of a cantilever by the spectrum of its thermal noise (thermal "
            "tune): a simple harmonic oscillator on a white floor by maximum likelihood, with "
            "the errors of the fit and, of several spectra, their scatter, beside the value "
            "of the file. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .n_files = CMD_ONE_OR_MORE};
    wt_thermal_job job = wt_thermal_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_thermal_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "sensitivity units format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL;
    wt_table **const tables[] = {&made};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_thermal_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    return cmd_session_free(&s);
}
