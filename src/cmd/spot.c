/* weartrack spot: roughness of a spot relative to the depth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_spot(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "spot",
        .arguments = "--tip TIP --depth D [OPTION]... IMAGE",
        .description =
            "Computes the roughness of a spot over the contact from a height image taken before an "
            "indentation, and reports whether the spot is too rough for that depth.",
        .common = "output formats columns provenance cost",
        .n_files = 1};
    wt_indent_job indent = wt_indent_job_defaults();
    wt_spot_job job = wt_spot_job_defaults();
    cmd_option_group parts[] = {
        {wt_indent_job_params(), &indent, "tip", 0},
        {wt_spot_job_params(), &job, NULL, 0},
        {wt_read_params(), &job.read, "units pixel-size height-unit format sheet", 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL, **const tables[] = {&made};
    if (cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) &&
        cmd_begin_reading(&s, job.read.format)) {
        job.tip = indent.tip;
        wt_cost_begin_stage(s.cost, "spot");
        const wt_status status = wt_spot_compute(&job, s.files[0], &s.work, &made, &s.err);
        cmd_finish(&s, status, tables, COUNT_OF(tables));
    }
    return cmd_session_free(&s);
}
