/* weartrack report: plots and one page from a result file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

static const wt_param rows[] = {
    {PARAM_TEXT_OF("output", cmd_common, output), .value = "FOLDER", .letter = 'o', .unset = "",
     .help = "the folder to write; required without --browse"},
};
PARAM_LOCAL_TABLE(own_params, cmd_common, rows, cmd_common_defaults, NO_PARTS)

typedef struct browse_options {
    const char *browse;
} browse_options;

static const wt_param browse_rows[] = {
    {PARAM_TEXT_OF("browse", browse_options, browse), .value = "FILE.html", .unset = "",
     .flags = PARAM_WRITTEN,
     .help = "write one page to go through the force curves of the result, of weartrack indent "
             "--curves all, with their fits; choices made on it are for indent --choices"},
};
CMD_OPTIONS(browse_params, browse_options, browse_rows)

/* What was asked for: the folder, the page with the curves, or both. */
static wt_status write_asked(cmd_session *s, const wt_report_options *options, const char *browse,
                             const wt_progress *progress)
{
    wt_status made = WT_OK;
    if (s->common.output != NULL)
        made = wt_report_write(s->result, s->common.output, options, progress, &s->err);
    if (made == WT_OK && browse != NULL)
        made = wt_browse_write(s->result, browse, s->common.provenance, &s->err);
    return made;
}

int cmd_report(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "report",
        .arguments = "RESULT -o FOLDER|--browse FILE.html [OPTION]...",
        .what = "Writes a folder with one page, index.html, and for each figure its data, script "
                "and picture; the figures can be drawn again without weartrack. RESULT is HDF5 or "
                "a text stream, - is standard input.",
        .common = "provenance",
        .n_files = 1,
        .files = "one result file is needed"};
    cmd_session s = cmd_session_defaults();
    wt_report_options report_options = wt_report_defaults();
    browse_options own = {0};
    cmd_part parts[] = {{own_params(), &s.common, NULL, 0},
                        {browse_params(), &own, NULL, 0},
                        {wt_report_params(), &report_options, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        (s.common.output == NULL && own.browse == NULL &&
         !cmd_usage_error(&s, "-o FOLDER or --browse FILE.html is needed")))
        return cmd_session_free(&s);
    report_options.with_provenance = s.common.provenance;
    const wt_progress progress = cmd_progress_start(&s);
    cmd_catch_interruptions();
    wt_status made = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (made == WT_OK)
        made = write_asked(&s, &report_options, own.browse, &progress);
    cmd_progress_end(&s);
    if ((made == WT_E_MISSING || made == WT_E_UNIT) && s.err.file[0] == '\0')
        wt_error_file(&s.err, s.files[0]); // what a table of it lacks
    if (made != WT_OK)
        cmd_fail(&s);
    else
        cmd_tables_remarks(&s, s.files[0], s.result);
    if (made == WT_OK && !s.common.quiet && s.common.output != NULL)
        cmd_say("report page: %s/index.html\n", s.common.output);
    if (made == WT_OK && !s.common.quiet && own.browse != NULL)
        cmd_say("page of curves: %s\n", own.browse);
    return cmd_session_free(&s);
}
