/* Writes errors, warnings and progress on standard error. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include <signal.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "cmd/cmd.h"
#include "core/base/utf8.h"
#include "core/table/registry.h"

/* True for a control character of a terminal. */
static bool is_control(const char *text)
{
    const unsigned char c = (unsigned char)text[0];
    return (c < 0x20 && c != '\t') || c == 0x7f || (c == 0xc2 && (unsigned char)text[1] < 0xa0);
}

/* True if a progress line is displayed, which other messages replace. */
static bool progress_is_shown;

static void erase_progress(void)
{
    if (progress_is_shown)
        fputs("\r\033[K", stderr);
    progress_is_shown = false;
}

void cmd_message(const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    const int written = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (written < 0)
        cmd_exit_without_memory(strlen(format));
    size_t length = (size_t)written;
    if (cmd_log_is_json()) {
        text[length - (length > 0 && text[length - 1] == '\n')] = '\0';
        const cmd_json_member word = {"text", text, 0};
        cmd_log_event("message", &word, 1);
        free(text);
        return;
    }
    erase_progress();
    const bool line = *format != '\0' && format[strlen(format) - 1] == '\n';
    length -= line;
    for (size_t i = 0, n; i < length; i += n) {
        n = utf8_character_length(text + i, length - i);
        if (n > 0 && !is_control(text + i)) {
            fwrite(text + i, 1, n, stderr);
        } else {
            n = 1;
            fprintf(stderr, "\\x%02x", (unsigned char)text[i]);
        }
    }
    if (line)
        fputc('\n', stderr);
    free(text);
}

void cmd_print_page_location(const char *place)
{
    char *page = wt_report_page_path(place);
    if (page != NULL)
        cmd_message("report page: %s\n", page);
    free(page);
}

void cmd_check_font(cmd_session *s, const char *font)
{
    char instead[64];
    if (wt_report_font_is_available(font, instead, sizeof instead))
        return;
    if (!s->common.quiet || s->common.strict)
        cmd_message("weartrack %s: %s: no font '%s' on this computer: PDF and PNG have '%s' in its "
                    "place, SVG and the page what the reader's browser takes\n",
                    s->name, s->common.strict ? "exit status 1 (--strict)" : "warning", font,
                    instead);
    if (s->common.strict)
        s->status = CMD_FAILED;
}

void cmd_set_partial(cmd_session *s)
{
    s->status = s->status == CMD_OK ? CMD_PARTIAL : s->status;
}

void cmd_report_failure(cmd_session *s)
{
    const wt_error *e = &s->err;
    char line[2048];
    wt_error_format(e, line, sizeof line);
    const cmd_json_member words[] = {
        {"status", wt_status_text(e->status), 0},
        {"file", e->file, 0},
        {"place", e->place, 0},
        {"text", e->message[0] != '\0' ? e->message : wt_status_text(e->status), 0},
        {"expected", e->expected, 0},
        {"found", e->found, 0},
        {"advice", e->advice, 0}};
    if (cmd_log_is_json())
        cmd_log_event("error", words, COUNT_OF(words));
    else
        cmd_message("weartrack %s: %s\n", s->name, line);
    cmd_set_partial(s);
}

bool cmd_fail(cmd_session *s)
{
    cmd_report_failure(s);
    s->status = CMD_FAILED;
    return false;
}

/* Log entries with equal texts about several files. */
typedef struct log_group {
    wt_log_entry entry; /* the first of them */
    size_t first, n_files, n;
} log_group;

static int compare_log_text(const void *a, const void *b)
{
    const log_group *p = a, *q = b;
    if (p->entry.severity != q->entry.severity)
        return p->entry.severity < q->entry.severity ? -1 : 1;
    const int order = strcmp(p->entry.text, q->entry.text);
    return order != 0 ? order : p->first < q->first ? -1 : 1;
}

static int compare_first(const void *a, const void *b)
{
    return ((const log_group *)a)->first < ((const log_group *)b)->first ? -1 : 1;
}

/* Groups n entries with equal texts, in the order of the first of each; returns the number of
 * groups. */
static size_t group_equal_entries(log_group *folds, size_t n)
{
    size_t kept = 0;
    qsort(folds, n, sizeof *folds, compare_log_text);
    for (size_t i = 0; i < n; i++) {
        const log_group *last = &folds[kept > 0 ? kept - 1 : 0];
        if (kept > 0 && last->entry.severity == folds[i].entry.severity &&
            strcmp(last->entry.text, folds[i].entry.text) == 0) {
            folds[kept - 1].n_files++;
            folds[kept - 1].n += folds[i].n;
        } else {
            folds[kept++] = folds[i];
        }
    }
    qsort(folds, kept, sizeof *folds, compare_first);
    return kept;
}

static void print_log_group(const char *name, const log_group *f)
{
    const wt_log_entry *e = &f->entry;
    const cmd_json_member words[] = {{"file", e->file, 0},
                                     {"place", f->n_files > 1 ? "" : e->place, 0},
                                     {"text", e->text, 0},
                                     {"files", NULL, f->n_files},
                                     {"times", NULL, f->n}};
    if (cmd_log_is_json()) {
        cmd_log_event(wt_severity_name(e->severity), words, COUNT_OF(words));
        return;
    }
    cmd_message("weartrack %s: %s: %s", name, wt_severity_name(e->severity), e->file);
    if (f->n_files > 1)
        cmd_message(" and %zu more", f->n_files - 1);
    cmd_message("%s%s%s%s", *e->file ? ": " : "", f->n_files > 1 ? "" : e->place,
                *e->place && f->n_files == 1 ? ": " : "", e->text);
    if (f->n > f->n_files)
        cmd_message(" (%zu times)", f->n);
    cmd_message("\n");
}

void cmd_print_log(cmd_session *s, const wt_log *log, bool notes)
{
    const bool quiet = s->common.quiet, strict = s->common.strict;
    const size_t n = wt_log_count(log);
    size_t n_folds = 0, n_remarks = 0, n_losses = 0;
    log_group *folds = wt_alloc(n + 1, sizeof *folds);
    for (size_t i = 0; i < n; i++) {
        const wt_log_entry e = wt_log_get(log, i);
        n_remarks += e.severity != WT_NOTE;
        n_losses += e.severity == WT_LOSS;
        if (e.severity == WT_LOSS || (!quiet && (e.severity == WT_WARNING || notes)))
            folds[n_folds++] = (log_group){e, i, 1, e.count};
    }
    n_folds = group_equal_entries(folds, n_folds);
    for (size_t i = 0; i < n_folds; i++)
        print_log_group(s->name, &folds[i]);
    free(folds);
    if (n_remarks > 0 && (strict || !quiet))
        cmd_message("weartrack %s: %zu remark%s%s\n", s->name, n_remarks, n_remarks == 1 ? "" : "s",
                    strict ? ": exit status 1 (--strict)" : "");
    if (n_losses > 0)
        cmd_set_partial(s);
    if (strict && n_remarks > 0)
        s->status = CMD_FAILED;
}

bool cmd_print_failures(cmd_session *s, const wt_table *failures)
{
    const size_t n = failures != NULL ? wt_table_n_rows(failures) : 0;
    if (n == 0)
        return false;
    if (!cmd_log_is_json())
        cmd_message("weartrack %s: %zu failed:\n", s->name, n);
    for (size_t i = 0; i < n; i++) {
        const char *where = wt_table_text(failures, i, FAILURES_FILE);
        const char *what = wt_table_text(failures, i, FAILURES_MESSAGE);
        const cmd_json_member words[] = {{"file", where, 0}, {"text", what, 0}};
        cmd_log_event("failed", words, COUNT_OF(words));
        if (cmd_log_is_json())
            continue;
        /* most messages begin with the file */
        if (strncmp(what, where, strlen(where)) == 0)
            cmd_message("  %s\n", what);
        else
            cmd_message("  %s: %s\n", where, what);
    }
    const char *answered = wt_table_key(failures, "status");
    cmd_set_partial(s);
    if (answered != NULL && atoi(answered) == CMD_FAILED)
        s->status = CMD_FAILED;
    return true;
}

static const int interruptions[] = {SIGINT, SIGTERM, SIGHUP};
enum { N_INTERRUPTIONS = COUNT_OF(interruptions) };
static volatile sig_atomic_t interrupted; /* number of the signal, written by the handler */

static void record_interruption(int number)
{
    interrupted = number;
}

void cmd_catch_interruptions(void)
{
    /* A second signal ends the program at once. A signal that the parent ignores stays ignored. */
    struct sigaction catch = {.sa_handler = record_interruption, .sa_flags = (int)SA_RESETHAND};
    struct sigaction before;
    sigemptyset(&catch.sa_mask);
    for (size_t i = 0; i < N_INTERRUPTIONS; i++)
        if (sigaction(interruptions[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(interruptions[i], &catch, NULL);
}

/* Unfinished files have been removed: the signal has its default action now. */
static void restore_interruptions(void)
{
    struct sigaction before;
    for (size_t i = 0; i < N_INTERRUPTIONS; i++)
        if (sigaction(interruptions[i], NULL, &before) == 0 &&
            before.sa_handler == record_interruption)
            signal(interruptions[i], SIG_DFL);
    if (interrupted != 0)
        raise(interrupted);
}

static bool print_progress(void *user, const char *what, size_t done, size_t total)
{
    cmd_progress *state = user;
    const double now = wt_time_wall();
    if (interrupted != 0)
        return false;
    /* Progress is shown after one second. */
    if (!state->active || now - state->start < 1 || now - state->shown < state->interval)
        return true;
    state->shown = now;
    if (cmd_log_is_json()) {
        const cmd_json_member words[] = {
            {"text", what, 0}, {"done", NULL, done}, {"total", NULL, total}};
        cmd_log_event("progress", words, total > 0 ? 3 : 2);
        return true;
    }
    progress_is_shown = true;
    if (total > 0)
        fprintf(stderr, "\r\033[K%s: %zu of %zu", what, done, total);
    else
        fprintf(stderr, "\r\033[K%s: %zu", what, done);
    fflush(stderr);
    return true;
}

wt_progress cmd_progress_start(cmd_session *s)
{
    const double now = wt_time_wall();
    const bool is_json = cmd_log_is_json();
    /* JSON has one line per second, a terminal ten updates */
    s->progress = (cmd_progress){now, now, is_json ? 1 : 0.1,
                                 !s->common.quiet && (is_json || isatty(STDERR_FILENO))};
    return (wt_progress){print_progress, &s->progress};
}

void cmd_progress_end(cmd_session *s)
{
    erase_progress();
    s->progress.active = false;
    restore_interruptions();
}
