/* The first lines of long text on a terminal. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <unistd.h>

#include "cmd/cmd.h"

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
