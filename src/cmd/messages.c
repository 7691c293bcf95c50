/* Writes errors, warnings, progress and long text, as text or as lines of JSON for programs that
 * run many calls. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "cmd/cmd.h"
#include "core/base/text.h"
#include "core/table/registry.h"

#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* ---- lines of JSON --------------------------------------------------------------------------- */

static const char *subcommand_name; /* name of the subcommand; NULL: messages are plain text */

void cmd_log_json(const char *name)
{
    subcommand_name = name;
}

bool cmd_log_is_json(void)
{
    return subcommand_name != NULL;
}

static void write_json_member(const char *name, const char *text)
{
    fprintf(stderr, "\"%s\": ", name);
    json_write_text(stderr, text);
}

/* Writes the time in UTC (ISO 8601); nothing if the clock is invalid. */
static void write_time(void)
{
    char text[32];
    struct tm utc;
    const time_t now = time(NULL);
    if (gmtime_r(&now, &utc) == NULL ||
        strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
        return;
    fputs(", ", stderr);
    write_json_member("time", text);
}

static void begin_event(const char *event)
{
    fputc('{', stderr);
    write_json_member("event", event);
    write_time();
    fputs(", ", stderr);
    write_json_member("subcommand", subcommand_name);
}

/* A number that is not finite has no form in JSON and is left out. */
static void write_json_number(const char *name, double value)
{
    char text[32];
    if (!isfinite(value))
        return;
    (void)wt_number_format(value, text);
    fprintf(stderr, ", \"%s\": %s", name, text);
}

void cmd_log_row(const wt_result_row *row)
{
    if (subcommand_name == NULL)
        return;
    begin_event("row");
    fputs(", ", stderr);
    write_json_member("name", row->name);
    fputs(", ", stderr);
    write_json_member("text", row->text);
    write_json_number("value", row->value);
    write_json_number("low", row->low);
    write_json_number("high", row->high);
    write_json_number("range_low", row->range_low);
    write_json_number("range_high", row->range_high);
    if (isfinite(row->value)) {
        fputs(", ", stderr);
        write_json_member("unit", row->unit);
    }
    if (*row->note != '\0') {
        fputs(", ", stderr);
        write_json_member("note", row->note);
    }
    fputs("}\n", stderr);
}

void cmd_log_event(const char *event, const cmd_json_member *words, size_t n)
{
    if (subcommand_name == NULL)
        return;
    begin_event(event);
    for (size_t i = 0; i < n; i++) {
        if (words[i].text != NULL && words[i].text[0] == '\0')
            continue;
        fputs(", ", stderr);
        if (words[i].text != NULL)
            write_json_member(words[i].name, words[i].text);
        else
            fprintf(stderr, "\"%s\": %zu", words[i].name, words[i].number);
    }
    fputs("}\n", stderr);
}

/* ---- text ------------------------------------------------------------------------------------ */

/* True for a control character of a terminal. */
static bool is_control(const char *text)
{
    const unsigned char c = (unsigned char)text[0];
    return (c < 0x20 && c != '\t') || c == 0x7f || (c == 0xc2 && (unsigned char)text[1] < 0xa0);
}

/* True if a progress line is displayed, which other messages replace. */
static bool progress_is_shown;

void cmd_erase_progress(void)
{
    if (progress_is_shown)
        fputs("\r\033[K", stderr);
    fflush(stderr); /* standard output may follow */
    progress_is_shown = false;
}

void cmd_print_safely(FILE *out, const char *text, size_t length)
{
    for (size_t i = 0, n; i < length; i += n) {
        n = utf8_character_length(text + i, length - i);
        if (n > 0 && !is_control(text + i)) {
            fwrite(text + i, 1, n, out);
        } else {
            n = 1;
            fprintf(out, "\\x%02x", (unsigned char)text[i]);
        }
    }
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
    cmd_erase_progress();
    const bool line = *format != '\0' && format[strlen(format) - 1] == '\n';
    length -= line;
    cmd_print_safely(stderr, text, length);
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
    cmd_erase_progress();
    s->progress.active = false;
    restore_interruptions();
}

/* ---- screen ---------------------------------------------------------------------------------- */

enum {
    GAP = 2,
    LINES_SHOWN = CMD_SCREEN_LINES - 5 /* remarks, where the rest is, the next command */
};

/* Text that goes to the terminal up to a number of lines. */
typedef struct screen_text {
    cmd_session *session;
    size_t n_lines; /* of the whole text */
    bool is_cut;    /* a line is wider than the terminal */
    size_t used;
    char line[4 * CMD_SCREEN_WIDTH]; /* UTF-8: up to four bytes a character */
} screen_text;

bool cmd_shows_first_lines(const cmd_session *s)
{
    return s->common.output == NULL && !s->common.verbose && isatty(STDOUT_FILENO);
}

static void end_line(screen_text *t)
{
    enum { DOTS = 3 };
    const bool cut = cmd_text_width(t->line, t->used) > CMD_SCREEN_WIDTH;
    if (t->n_lines < LINES_SHOWN) {
        cmd_print_safely(stdout, t->line,
                         cut ? cmd_text_fit(t->line, t->used, CMD_SCREEN_WIDTH - DOTS) : t->used);
        fputs(cut ? "...\n" : "\n", stdout);
        t->is_cut = t->is_cut || cut;
    }
    t->n_lines++;
    t->used = 0;
}

static ssize_t write_screen(void *cookie, const char *bytes, size_t n)
{
    screen_text *const t = cookie;
    for (size_t i = 0; i < n; i++) {
        const size_t wide = bytes[i] == '\t' ? GAP : 1;
        if (bytes[i] == '\n')
            end_line(t);
        for (size_t k = 0; bytes[i] != '\n' && k < wide && t->used < sizeof t->line; k++)
            t->line[t->used++] = bytes[i] == '\t' ? ' ' : bytes[i];
    }
    return (ssize_t)n;
}

static int close_screen(void *cookie)
{
    screen_text *const t = cookie;
    if (t->used > 0)
        end_line(t);
    if (t->n_lines > LINES_SHOWN)
        printf("and %zu more lines: -o FILE, or -o - to print them\n", t->n_lines - LINES_SHOWN);
    else if (t->is_cut)
        puts("lines are cut: -o FILE, or -o - to print them");
    const size_t shown = t->n_lines < LINES_SHOWN ? t->n_lines : LINES_SHOWN;
    t->session->lines_left -= shown < t->session->lines_left ? shown : t->session->lines_left;
    free(t);
    return 0;
}

void cmd_show_first_lines(cmd_session *s, cmd_sink *sink)
{
    if (sink->file != NULL || !cmd_shows_first_lines(s))
        return;
    screen_text *const t = wt_alloc(1, sizeof *t);
    t->session = s;
    FILE *const stream =
        fopencookie(t, "w", (cookie_io_functions_t){.write = write_screen, .close = close_screen});
    if (stream == NULL)
        cmd_exit_without_memory(sizeof *t);
    sink->stream = sink->screen = stream;
}
