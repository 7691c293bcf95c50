/* Starting gnuplot.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* The caller's environment with the locale replaced and without what changes gnuplot. The strings
 * are borrowed; freed with free(). */
static char **environment(void)
{
    static const char *const hidden[] = {"LC_",          "LANG=",       "LANGUAGE=", "GNUTERM=",
                                         "GNUPLOT_LIB=", "GNUPLOT_FIT", "GNUHELP=",  "COLUMNS="};
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

/* Reads `fd` to its end and keeps the last line that is not blank: gnuplot repeats the command
 * before it says what is wrong with it. */
static void read_last_line(int fd, char *last, size_t size)
{
    size_t n = 0;
    bool ended = false; // the next byte that is not blank begins a new line
    char chunk[1024];
    for (;;) {
        ssize_t got = read(fd, chunk, sizeof chunk);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        for (ssize_t i = 0; i < got; i++) {
            bool blank = chunk[i] == '\n' || chunk[i] == '\t' || chunk[i] == ' ';
            if (ended && !blank)
                n = 0;
            ended = chunk[i] == '\n' || (ended && blank);
            if (!ended && n + 1 < size && !(blank && n == 0))
                last[n++] = blank ? ' ' : chunk[i];
        }
    }
    last[n] = '\0';
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
    if (WIFEXITED(state) && WEXITSTATUS(state) == 127 && words[0] == '\0')
        return cannot_start(program, ENOENT, err);
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

wt_status gnuplot_run(const char *program, const char *folder, const char *script, wt_error *err)
{
    wt_status status = WT_OK;
    posix_spawn_file_actions_t actions;
    bool have_actions = false;
    int channel[2] = {-1, -1};
    char **environment_list = environment();
    char *path = program_path(program);

    char settings[] = "--default-settings", *name = strdup(script);

    if (environment_list == NULL || path == NULL || name == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    if (pipe2(channel, O_CLOEXEC) != 0) {
        status = wt_fail(err, WT_E_IO, "no pipe for the messages of gnuplot: %s", strerror(errno));
        goto done;
    }
    int code = posix_spawn_file_actions_init(&actions);
    have_actions = code == 0;
    if (code == 0)
        code = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (code == 0)
        code = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (code == 0)
        code = posix_spawn_file_actions_adddup2(&actions, channel[1], STDERR_FILENO);
    if (code == 0) // what a script prints must not end in the data of a pipe
        code = posix_spawn_file_actions_adddup2(&actions, channel[1], STDOUT_FILENO);
    pid_t child = 0;
    char *arguments[] = {path, settings, name, NULL};
    if (code == 0)
        code = posix_spawnp(&child, path, &actions, NULL, arguments, environment_list);
    if (code != 0) {
        status = cannot_start(program, code, err);
        goto done;
    }
    close(channel[1]);
    channel[1] = -1;
    char words[400];
    read_last_line(channel[0], words, sizeof words);
    int state = 0;
    while (waitpid(child, &state, 0) < 0)
        if (errno != EINTR) {
            status =
                wt_fail(err, WT_E_TOOL, "the end of gnuplot was not seen: %s", strerror(errno));
            goto done;
        }
    status = check_exit(program, state, words, err);
done:
    if (channel[0] >= 0)
        close(channel[0]);
    if (channel[1] >= 0)
        close(channel[1]);
    if (have_actions)
        posix_spawn_file_actions_destroy(&actions);
    free(name);
    free(path);
    free(environment_list);
    return status;
}
