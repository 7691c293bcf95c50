/* Runs gnuplot and reports its errors, and tests if a font exists.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/gnuplot.h"
#include "core/base/memory.h"
#include "core/base/text.h"
#include "core/system/subprocess.h"
#include "weartrack/report.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <strings.h>

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

/* ---- fonts ----------------------------------------------------------------------------------- */

/* Time limit of fc-match [s], which may first build its cache of fonts. */
static const double match_time = 10;

/* Escapes a name as a pattern, where a size would follow a hyphen. */
static void escape_font_pattern(const char *font, char pattern[2 * FONT_NAME_LIMIT + 1])
{
    for (; *font != '\0'; *pattern++ = *font++)
        if (*font == '-')
            *pattern++ = '\\';
    *pattern = '\0';
}

/* True if the font is one of the names of a family, "Noto Sans,Noto Sans Light". */
static bool family_contains(const char *names, const char *font)
{
    const size_t length = strlen(font);
    for (const char *name = names; name != NULL; name = strchr(name, ',')) {
        name += *name == ',';
        if (strcspn(name, ",") == length && strncasecmp(name, font, length) == 0)
            return true;
    }
    return false;
}

bool wt_report_font_is_available(const char *font, char *instead, size_t size)
{
    char pattern[2 * FONT_NAME_LIMIT + 1];
    if (font == NULL || strlen(font) > FONT_NAME_LIMIT || size == 0)
        return true;
    escape_font_pattern(font, pattern);
    const char *const arguments[] = {"-f", "%{family}\\n", pattern, NULL};
    const program_call call = {
        .program = "fc-match", .arguments = arguments, .folder = "/", .limit = match_time};
    program_result end;
    if (program_run(&call, &end, NULL) != WT_OK || end.outcome != PROGRAM_EXITED || end.code != 0 ||
        end.words[0] == '\0' || family_contains(end.words, font))
        return true;
    const size_t first = utf8_truncated_length(end.words, strcspn(end.words, ","), size - 1);
    memcpy(instead, end.words, first);
    instead[first] = '\0';
    return false;
}
