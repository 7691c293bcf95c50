/* weartrack record: evaluates friction records and wear of a tribometer. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_record(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "record",
        .next = "validate CASE.xml@",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Records of pin-on-disc, linear and reciprocating tribometers: where the running-in "
            "ends, the friction coefficient behind it, and its drift, each with "
            "its error, at every velocity, load and temperature of the record; with the loss "
            "of the track the specific wear rate. Folders and patterns are allowed.",
        .common = "output formats columns files-from provenance cost",
        .notes = "The tables record, record_cycles and (where something of the wear is given) wear "
                 "follow one another.",
        .n_files = CMD_ONE_OR_MORE};
    wt_record_job job = wt_record_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_option_group parts[] = {
        {wt_record_job_params(), &job, NULL, 0},
        {wt_read_params(), &set.read, "units format sheet conditioning", 0}};
    cmd_session s = cmd_session_defaults();
    wt_record_tables made = {0};
    wt_table **const tables[] = {&made.record, &made.record_cycles, &made.wear};
    job.sets = &set;
    job.n_sets = 1;
    if (cmd_begin_job(&s, &usage, parts, COUNT_OF(parts), &set, argc, argv)) {
        if (job.profile != NULL)
            cmd_share_unit_options(&s, &set.read);
        cmd_finish(&s, wt_record_compute(&job, &s.work, &made, &s.err), tables, COUNT_OF(tables));
    }
    return cmd_session_free(&s);
}
