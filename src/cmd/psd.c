/* weartrack psd: the power spectrum of a measured surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_psd(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "psd",
        .next = "friction --roughness@ --material DMA",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Power spectrum C(q) of a surface from height maps and profiles of it, as "
            "friction and layer take it: with errors, the reliable range, "
            "a self-affine law and the roughness numbers of every scan. Scans of several sizes "
            "are stitched, several places averaged. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables power_spectrum, place_errors (of scans of several sizes), "
                 "angular_spectrum (of height maps), surfaces, height_map (of height maps) and "
                 "height_profile "
                 "(both with --heights) follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_topography_job job = wt_topography_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_topography_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "units pixel-size height-unit format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_topography_tables made = {0};
    wt_table **const tables[] = {&made.power_spectrum, &made.place_errors, &made.angular_spectrum,
                                 &made.surfaces,       &made.height_map,   &made.height_profile};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv))
        cmd_finish(&s, wt_topography_compute(&job, &s.work, &made, &s.err), tables,
                   COUNT_OF(tables));
    return cmd_session_free(&s);
}
