/* Words on standard error: errors, warnings, progress. SPDX-License-Identifier: GPL-3.0-or-later */
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "cmd/cmd.h"

int cmd_fail(const char *name, const wt_error *err)
{
    char line[2048];
    wt_error_format(err, line, sizeof line);
    fprintf(stderr, "weartrack %s: %s\n", name, line);
    return CMD_FAILED;
}

void cmd_print_log(const char *name, const wt_parselog *log, bool notes, bool quiet)
{
    if (quiet)
        return;
    for (size_t i = 0; i < wt_parselog_count(log); i++) {
        const wt_log_entry e = wt_parselog_get(log, i);
        if (e.severity == WT_NOTE && !notes)
            continue;
        fprintf(stderr, "weartrack %s: %s: %s%s%s%s%s", name,
                e.severity == WT_NOTE ? "note" : "warning", e.file, *e.file ? ": " : "", e.place,
                *e.place ? ": " : "", e.text);
        if (e.count > 1)
            fprintf(stderr, " (%zu times)", e.count);
        fputc('\n', stderr);
    }
    if (wt_parselog_lost(log) > 0)
        fprintf(stderr, "weartrack %s: warning: %zu notes were lost for lack of memory\n", name,
                wt_parselog_lost(log));
}

size_t cmd_print_failures(const char *name, const wt_table *failures)
{
    if (failures == NULL || wt_table_n_rows(failures) == 0)
        return 0;
    const size_t n = wt_table_n_rows(failures);
    const long file = wt_table_find(failures, "file"), message = wt_table_find(failures, "message");
    fprintf(stderr, "weartrack %s: %zu failed:\n", name, n);
    for (size_t i = 0; i < n; i++) {
        const char *where = wt_table_text(failures, i, (size_t)file);
        const char *what = wt_table_text(failures, i, (size_t)message);
        /* most messages begin with the file they are about */
        if (strncmp(what, where, strlen(where)) == 0)
            fprintf(stderr, "  %s\n", what);
        else
            fprintf(stderr, "  %s: %s\n", where, what);
    }
    return n;
}

static const int interruptions[] = {SIGINT, SIGTERM, SIGHUP};
enum { N_INTERRUPTIONS = sizeof interruptions / sizeof interruptions[0] };
static volatile sig_atomic_t interrupted; /* number of the signal; all that a handler may write */

static void note_interruption(int number)
{
    interrupted = number;
}

void cmd_catch_interruptions(void)
{
    /* The second one ends the program at once. A signal that the parent ignores stays ignored. */
    struct sigaction catch = {.sa_handler = note_interruption, .sa_flags = (int)SA_RESETHAND};
    struct sigaction before;
    sigemptyset(&catch.sa_mask);
    for (size_t i = 0; i < N_INTERRUPTIONS; i++)
        if (sigaction(interruptions[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(interruptions[i], &catch, NULL);
}

/* What was begun has been removed: now the signal does what it always does. */
static void release_interruptions(void)
{
    struct sigaction before;
    for (size_t i = 0; i < N_INTERRUPTIONS; i++)
        if (sigaction(interruptions[i], NULL, &before) == 0 &&
            before.sa_handler == note_interruption)
            signal(interruptions[i], SIG_DFL);
    if (interrupted != 0)
        raise(interrupted);
}

static bool report_progress(void *user, const char *what, size_t done, size_t total)
{
    cmd_progress *state = user;
    const double now = wt_time_wall();
    if (interrupted != 0)
        return false;
    /* Only work over a second is worth a line, and ten lines a second are enough. */
    if (!state->active || now - state->start < 1 || now - state->shown < 0.1)
        return true;
    state->shown = now;
    state->printed = true;
    if (total > 0)
        fprintf(stderr, "\r\033[K%s: %zu of %zu", what, done, total);
    else
        fprintf(stderr, "\r\033[K%s: %zu", what, done);
    fflush(stderr);
    return true;
}

wt_progress cmd_progress_start(cmd_progress *state, bool quiet)
{
    const double now = wt_time_wall();
    *state = (cmd_progress){now, now, !quiet && isatty(STDERR_FILENO), false};
    return (wt_progress){report_progress, state};
}

void cmd_progress_end(cmd_progress *state)
{
    if (state->printed)
        fputs("\r\033[K", stderr);
    state->active = false;
    release_interruptions();
}
