/* weartrack view: a case on a local page. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

#include <stdio.h>
#include <unistd.h>

typedef struct view_flags {
    bool no_open;
} view_flags;

static const wt_param flag_rows[] = {
    {PARAM_FLAG_OF("no-open", view_flags, no_open),
     .help = "only print the address of the page, do not open it in a browser"},
};
CMD_OPTIONS(view_flag_params, view_flags, flag_rows)

/* Returns the path of this program, which the server starts for whole runs. */
static const char *own_path(char *path, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", path, size - 1);
    path[length > 0 ? length : 0] = '\0';
    return length > 0 ? path : "weartrack";
}

int cmd_view(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "view",
        .arguments = "[OPTION]... [FOLDER|CASE.xml|RESULT.h5|FILE...]",
        .description =
            "Opens a page in the browser on which a case is looked at and changed: its files, "
            "force curves with their fits, master curve, surface, friction and answer. The page "
            "edits the case file and its manual overrides and computes nothing; weartrack run "
            "gives the same numbers. Only this computer can reach the page, through the address "
            "that is printed. The program ends with the last page, or with Ctrl-C.",
        .common = "formats"};
    cmd_session s = cmd_session_defaults();
    wt_view_options options = wt_view_defaults();
    view_flags own = {0};
    char path[4096];
    wt_view *view = NULL;
    cmd_option_group parts[] = {{wt_view_params(), &options, NULL, 0},
                                {view_flag_params(), &own, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    options.paths = s.files;
    options.n_paths = s.n_files;
    options.formats = s.common.formats;
    options.program = own_path(path, sizeof path);
    wt_status status = wt_view_open(&options, &view, &s.err);
    if (status == WT_OK) {
        printf("%s\n", wt_view_address(view));
        fflush(stdout);
        if (!own.no_open && !wt_view_show(view))
            cmd_message("weartrack view: no browser found; open the address by hand\n");
        s.common.quiet = true; /* serving has no progress */
        wt_progress progress = cmd_progress_start(&s);
        cmd_catch_interruptions();
        status = wt_view_serve(view, &progress, &s.err);
    }
    wt_view_close(view);
    cmd_progress_end(&s);
    if (status != WT_OK)
        cmd_fail(&s);
    return cmd_session_free(&s);
}
