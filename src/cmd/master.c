/* weartrack master: shift factors, master curve, WLF and Prony series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

int cmd_master(int argc, char **argv)
{
    static const cmd_usage usage = {
        "master", "[OPTION]... FILE...",
        "Fits one relaxation spectrum to all isotherms of DMA frequency sweeps, with their shifts, "
        "the\n"
        "law of these and the errors of everything; says whether superposition holds. Folders and\n"
        "patterns are allowed.",
        "output formats files-from provenance",
        "The tables prony, shift_factors and master_curve follow one another; weartrack friction "
        "and\n"
        "weartrack compare read them as they are."};
    cmd_common common = cmd_common_defaults();
    wt_master_job job = wt_master_job_defaults();
    wt_file_set set = {.read = wt_read_defaults()};
    cmd_part parts[] = {{wt_master_job_params(), &job,
                         "reference-temperature vertical-shift expansion terms-per-decade liquid",
                         0},
                        {wt_read_params(), &set.read, "temperature units format", 0}};
    enum { N_PARTS = sizeof parts / sizeof parts[0] };
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    cmd_session s = cmd_session_defaults();
    wt_master_tables tables = {0};

    if (!cmd_parse(&usage, parts, N_PARTS, &common, argc, argv, &first, &status))
        goto done;
    if (common.n_files == 0) {
        status = cmd_usage_error("master", "no file given");
        goto done;
    }
    set.patterns = common.files;
    set.n_patterns = common.n_files;
    job.sets = &set;
    job.n_sets = 1;
    status = cmd_begin(&s, "master", &common, set.read.format);
    if (status != CMD_OK)
        goto done;
    const wt_status made = wt_master_make(&job, &s.work, &tables, NULL, &err);
    wt_table **const made_tables[] = {&tables.prony, &tables.shift_factors, &tables.master_curve};
    status = cmd_finish(&s, made, made_tables, sizeof made_tables / sizeof made_tables[0], &err);
done:
    wt_master_tables_clear(&tables);
    cmd_session_free(&s);
    cmd_parts_clear(parts, N_PARTS);
    return status;
}
