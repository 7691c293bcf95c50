/* Runs gnuplot and reports its errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/gnuplot.h"

#include "core/base/memory.h"
#include "core/system/subprocess.h"

#include <errno.h>
#include <math.h>
#include <string.h>

/* Largest size of all that gnuplot writes [byte]. */
static size_t folder_size(const gnuplot_call *call)
{
    const size_t pictures = (size_t)1 << 30;
    return call->size > pictures ? call->size : pictures;
}

static wt_status fail_start(const char *program, int code, wt_error *err)
{
    wt_status status = wt_fail(err, WT_E_TOOL, "gnuplot cannot be started");
    wt_error_file(err, program);
    wt_error_found(err, "%s", strerror(code));
    wt_error_advice(err, code == EMFILE || code == ENFILE
                             ? MORE_FILES_ADVICE
                             : "install gnuplot (apt-get install gnuplot-nox) or name the program "
                               "with --gnuplot");
    return status;
}

/* Reports a failed run. gnuplot repeats a command before the message, so the last line is shown. */
static wt_status fail_run(const gnuplot_call *call, const program_result *end, wt_error *err)
{
    wt_status status = WT_E_TOOL;
    if (end->outcome == PROGRAM_SIGNALLED)
        wt_fail(err, status, "gnuplot was ended by signal %d", end->code);
    else if (*call->timed_out)
        wt_fail(err, status, "gnuplot did not end within %g s", call->limit);
    else if (end->outcome == PROGRAM_TOO_LARGE)
        wt_fail(err, status, "gnuplot wrote more than %zu MiB", folder_size(call) >> 20);
    else
        wt_fail(err, status, "gnuplot failed with exit status %d", end->code);
    wt_error_file(err, call->program);
    wt_error_found(err, "%s", end->words[0] != '\0' ? end->words : "no message");
    wt_error_advice(err, *call->timed_out
                             ? "check the plot style; `weartrack report --gnuplot-time` allows more"
                             : "check the plot style; gnuplot 5.4 or later is needed");
    return status;
}

wt_status gnuplot_run(const gnuplot_call *call, wt_error *err)
{
    // Environment variables that change gnuplot.
    static const char *const hidden[] = {"GNU", "COLUMNS=", "LD_PRELOAD=", NULL};
    const program_call run = {.program = call->program,
                              .arguments = call->arguments,
                              .folder = call->folder,
                              .hidden = hidden,
                              .limit = (double)INFINITY, // go_on enforces the limit
                              .foreign = true,
                              .file_size = call->size,
                              .folder_size = folder_size(call),
                              .go_on = call->go_on,
                              .user = call->user};
    program_result end;
    const wt_status status = program_run(&run, &end, err);
    if (status != WT_OK)
        return status;
    if (end.outcome == PROGRAM_NOT_STARTED)
        return fail_start(call->program, end.code, err);
    if (end.outcome == PROGRAM_CANCELLED && !*call->timed_out)
        return wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
    return end.outcome == PROGRAM_EXITED && end.code == 0 ? WT_OK : fail_run(call, &end, err);
}
