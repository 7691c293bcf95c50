/* Starting gnuplot, and its end.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* The caller's environment with the locale replaced and without what changes gnuplot. The strings
 * are borrowed; freed with free(). */
static char **environment(void)
{
    static const char *const hidden[] = {"LC_", "LANG=", "LANGUAGE=", "GNU", "COLUMNS="};
    static char locale[] = "LC_ALL=C.UTF-8";
    size_t n = 0, kept = 0;
    while (environ[n] != NULL)
        n++;
    char **list = calloc(n + 2, sizeof *list);
    if (list == NULL)
        return NULL;
    list[kept++] = locale;
    for (size_t i = 0; i < n; i++) {
        bool hide = false;
        for (size_t k = 0; k < sizeof hidden / sizeof hidden[0] && !hide; k++)
            hide = strncmp(environ[i], hidden[k], strlen(hidden[k])) == 0;
        if (!hide)
            list[kept++] = environ[i];
    }
    return list;
}

/* The last line of what gnuplot says that is not blank: it repeats the command before it says what
 * is wrong with it. */
typedef struct last_line {
    char text[400];
    size_t length;
    bool ended; /* the next byte that is not blank begins a new line */
} last_line;

/* Reads what there is at once; false if there will be no more. */
static bool read_words(int fd, last_line *last)
{
    char chunk[4096];
    const ssize_t got = read(fd, chunk, sizeof chunk);
    for (ssize_t i = 0; i < got; i++) {
        const bool blank = chunk[i] == '\n' || chunk[i] == '\t' || chunk[i] == ' ';
        if (last->ended && !blank)
            last->length = 0;
        last->ended = chunk[i] == '\n' || (last->ended && blank);
        if (!last->ended && last->length + 1 < sizeof last->text && !(blank && last->length == 0))
            last->text[last->length++] = blank ? ' ' : chunk[i];
    }
    last->text[last->length] = '\0';
    return got > 0 || (got < 0 && errno == EINTR);
}

static wt_status cannot_start(const char *program, int code, wt_error *err)
{
    wt_status status = wt_fail(err, WT_E_TOOL, "gnuplot cannot be started");
    wt_error_file(err, program);
    wt_error_found(err, "%s", strerror(code));
    wt_error_advice(err, "install gnuplot (apt-get install gnuplot-nox) or name the program with "
                         "--gnuplot");
    return status;
}

static wt_status check_exit(const char *program, int state, const char *words, wt_error *err)
{
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return WT_OK;
    wt_status status;
    if (WIFSIGNALED(state))
        status = wt_fail(err, WT_E_TOOL, "gnuplot was ended by signal %d", WTERMSIG(state));
    else
        status = wt_fail(err, WT_E_TOOL, "gnuplot failed with exit status %d", WEXITSTATUS(state));
    wt_error_file(err, program);
    wt_error_found(err, "%s", words[0] != '\0' ? words : "no message");
    wt_error_advice(err, "check the plot style; gnuplot 5.4 or later is needed");
    return status;
}

/* The program may be given relative to the current folder, but it is started in another one. */
static char *program_path(const char *program)
{
    if (program[0] == '/' || strchr(program, '/') == NULL)
        return strdup(program);
    char *absolute = realpath(program, NULL);
    return absolute != NULL ? absolute : strdup(program);
}

/* What the child becomes gnuplot with. */
typedef struct start {
    const char *path;
    const gnuplot_call *call;
    char **environment;
    int words; /* for standard output and error */
    int told;  /* gets the error number if it cannot be started; closed if it can */
    pid_t parent;
} start;

/* In the child, where only what is safe after a fork may be called. It is the leader of a group, so
 * that what it starts ends with it, and it does not outlive the parent. */
_Noreturn static void become_gnuplot(const start *s)
{
    static char settings[] = "--default-settings";
    char *const arguments[] = {(char *)s->path, settings, (char *)s->call->script, NULL};
    const struct rlimit size = {GNUPLOT_PICTURE_LIMIT, GNUPLOT_PICTURE_LIMIT};
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == s->parent && setpgid(0, 0) == 0 &&
        setrlimit(RLIMIT_FSIZE, &size) == 0 && chdir(s->call->folder) == 0) {
        const int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
        // What a script prints must not end in the data of a pipe.
        if (none >= 0 && dup2(none, STDIN_FILENO) >= 0 && dup2(s->words, STDOUT_FILENO) >= 0 &&
            dup2(s->words, STDERR_FILENO) >= 0)
            (void)execvpe(s->path, arguments, s->environment);
    }
    const int code = errno;
    (void)!write(s->told, &code, sizeof code);
    _exit(127);
}

/* What the child says that it could not become gnuplot for, or 0; closes its end of the pipe. */
static int why_not_started(int told[2], pid_t child)
{
    int code = 0;
    ssize_t got = 0;
    close(told[1]);
    told[1] = -1;
    do
        got = read(told[0], &code, sizeof code);
    while (got < 0 && errno == EINTR);
    if (got > 0)
        (void)waitpid(child, NULL, 0);
    return got > 0 ? code : 0;
}

/* Gives the process, and the end of the pipe that its words come from. */
static wt_status start_gnuplot(const gnuplot_call *call, pid_t *child, int *words, wt_error *err)
{
    wt_status status = WT_OK;
    int said[2] = {-1, -1}, told[2] = {-1, -1};
    char **list = environment(), *path = program_path(call->program);
    if (list == NULL || path == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    } else if (pipe2(said, O_CLOEXEC) != 0 || pipe2(told, O_CLOEXEC) != 0) {
        status = wt_fail(err, WT_E_IO, "no pipe for the messages of gnuplot: %s", strerror(errno));
    } else {
        const start s = {path, call, list, said[1], told[1], getpid()};
        *child = fork();
        if (*child == 0)
            become_gnuplot(&s);
        const int code = *child < 0 ? errno : why_not_started(told, *child);
        if (code != 0)
            status = cannot_start(call->program, code, err);
    }
    if (status == WT_OK) {
        *words = said[0];
        said[0] = -1;
        (void)fcntl(*words, F_SETFL, O_NONBLOCK);
    }
    for (int i = 0; i < 2; i++) {
        if (said[i] >= 0)
            close(said[i]);
        if (told[i] >= 0)
            close(told[i]);
    }
    free(path);
    free(list);
    return status;
}

/* Waits for the end, the limit or a cancellation, whatever becomes of the pipe: what gnuplot starts
 * may hold it open. The process is left to be reaped. */
static wt_status await_end(const gnuplot_call *call, pid_t child, int fd, last_line *last,
                           wt_error *err)
{
    enum { ASK = 50, SOON = 2 }; // ms
    const double end = wt_time_wall() + call->limit;
    bool open = true;
    for (;;) {
        struct pollfd words = {open ? fd : -1, POLLIN, 0};
        if (poll(&words, 1, open ? ASK : SOON) > 0)
            open = read_words(fd, last);
        siginfo_t info = {.si_pid = 0};
        if (waitid(P_PID, (id_t)child, &info, WEXITED | WNOHANG | WNOWAIT) != 0)
            return wt_fail(err, WT_E_TOOL, "the end of gnuplot was not seen: %s", strerror(errno));
        if (info.si_pid == child)
            return WT_OK;
        if (!call->go_on(call->user))
            return wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
        if (wt_time_wall() < end)
            continue;
        wt_status status = wt_fail(err, WT_E_TOOL, "gnuplot did not end within %g s", call->limit);
        wt_error_file(err, call->program);
        wt_error_found(err, "%s", last->length > 0 ? last->text : "no message");
        wt_error_advice(err, "check the plot style; `weartrack report --gnuplot-time` allows more");
        return status;
    }
}

wt_status gnuplot_run(const gnuplot_call *call, wt_error *err)
{
    enum { LEFT = 32 }; // more than a pipe holds, less than for ever
    last_line last = {.length = 0};
    pid_t child = 0;
    int words = -1, state = 0;
    wt_status status = start_gnuplot(call, &child, &words, err);
    if (status != WT_OK)
        return status;
    status = await_end(call, child, words, &last, err);
    (void)kill(-child, SIGKILL); // before it is reaped: until then the number is its own
    for (int i = 0; i < LEFT && read_words(words, &last); i++)
        ;
    close(words);
    while (waitpid(child, &state, 0) < 0 && errno == EINTR)
        ;
    return status == WT_OK ? check_exit(call->program, state, last.text, err) : status;
}
