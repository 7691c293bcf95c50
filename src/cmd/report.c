/* weartrack report: plots and one page from a result file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

static const wt_param rows[] = {
    {PARAM_TEXT_OF("output", cmd_common, output), .value = "FOLDER", .letter = 'o',
     .flags = PARAM_REQUIRED, .help = "the folder to write"},
};
PARAM_LOCAL_TABLE(own_params, cmd_common, rows, cmd_common_defaults, NO_PARTS)

int cmd_report(int argc, char **argv)
{
    static const cmd_usage usage = {
        "report", "RESULT -o FOLDER [OPTION]...",
        "Writes a folder with one page, index.html, and for each figure its data, script and\n"
        "picture; the figures can be drawn again without weartrack. RESULT is HDF5 or a text\n"
        "stream, - is standard input.",
        "provenance", NULL};
    cmd_common common = cmd_common_defaults();
    wt_report_options report_options = wt_report_defaults();
    cmd_part parts[] = {{own_params(), &common, NULL, 0},
                        {wt_report_params(), &report_options, NULL, 0}};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_result *result = NULL;
    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &common, argc, argv, &first,
                   &status))
        goto done;
    if (argc - first != 1) {
        status = cmd_usage_error("report", "one result file is needed; %d given", argc - first);
        goto done;
    }
    report_options.with_provenance = common.provenance;
    cmd_progress state;
    const wt_progress progress = cmd_progress_start(&state, common.quiet);
    cmd_catch_interruptions();
    wt_status made = cmd_tables_read(argv[first], &result, &err);
    if (made == WT_OK)
        made = wt_report_write(result, common.output, &report_options, &progress, &err);
    cmd_progress_end(&state);
    if ((made == WT_E_MISSING || made == WT_E_UNIT) && err.file[0] == '\0')
        wt_error_file(&err, argv[first]); // what a table of it lacks
    status = made != WT_OK ? cmd_fail("report", &err)
                           : cmd_tables_remarks("report", &common, argv[first], result);
    if (made == WT_OK && !common.quiet)
        cmd_say("report page: %s/index.html\n", common.output);
done:
    wt_result_free(result);
    return status;
}
