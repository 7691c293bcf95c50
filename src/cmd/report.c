/* weartrack report: plots and one page from a result file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

static const wt_param rows[] = {
    {PARAM_TEXT_OF("output", cmd_common, output), .value = "PLACE", .letter = 'o',
     .flags = PARAM_REQUIRED,
     .help = "the page to write, if it ends in .html, or a folder with the page and the figures"},
};
PARAM_LOCAL_TABLE(own_params, cmd_common, rows, cmd_common_defaults, NO_PARTS)

int cmd_report(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "report",
        .arguments = "RESULT -o PLACE [OPTION]...",
        .what = "Writes one page that needs no other file and can be mailed, or a folder with that "
                "page, index.html, and for each figure its data, script and picture; the figures "
                "can be drawn again without weartrack. RESULT is HDF5 or a text stream, - is "
                "standard input.",
        .common = "provenance",
        .n_files = 1,
        .files = "one result file is needed"};
    cmd_session s = cmd_session_defaults();
    wt_report_options report_options = wt_report_defaults();
    cmd_part parts[] = {{own_params(), &s.common, NULL, 0},
                        {wt_report_params(), &report_options, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    report_options.with_provenance = s.common.provenance;
    const wt_progress progress = cmd_progress_start(&s);
    cmd_catch_interruptions();
    wt_status made = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (made == WT_OK)
        made = wt_report_write(s.result, s.common.output, &report_options, &progress, &s.err);
    cmd_progress_end(&s);
    if ((made == WT_E_MISSING || made == WT_E_UNIT) && s.err.file[0] == '\0')
        wt_error_file(&s.err, s.files[0]); // what a table of it lacks
    if (made != WT_OK)
        cmd_fail(&s);
    else
        cmd_tables_remarks(&s, s.files[0], s.result);
    if (made == WT_OK && !s.common.quiet)
        cmd_say_page(s.common.output);
    return cmd_session_free(&s);
}
