/* Starts another program and waits for its end. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/subprocess.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static size_t list_length(const char *const *list)
{
    size_t n = 0;
    while (list != NULL && list[n] != NULL)
        n++;
    return n;
}

/* True if `text` begins with one of `beginnings`, or sets a locale. */
static bool is_hidden(const char *text, const char *const *beginnings)
{
    bool hide = strncmp(text, "LC_", 3) == 0 || strncmp(text, "LANG=", 5) == 0 ||
                strncmp(text, "LANGUAGE=", 9) == 0;
    for (size_t k = 0; k < list_length(beginnings) && !hide; k++)
        hide = strncmp(text, beginnings[k], strlen(beginnings[k])) == 0;
    return hide;
}

/* Creates the environment of the program: that of the caller with another locale, without the
 * hidden variables and with the added ones. The strings are borrowed; the list is freed with
 * free(). */
static const char **environment(const program_call *call)
{
    const size_t n = list_length((const char *const *)environ), added = list_length(call->added);
    size_t kept = 0;
    const char **list = wt_alloc(n + added + 2, sizeof *list);
    list[kept++] = "LC_ALL=C.UTF-8";
    for (size_t i = 0; i < added; i++)
        list[kept++] = call->added[i];
    for (size_t i = 0; i < n; i++)
        if (!is_hidden(environ[i], call->hidden))
            list[kept++] = environ[i];
    return list;
}

/* Creates the argument list for exec, freed with free(). */
static const char **create_argument_list(const program_call *call, const char *path)
{
    const size_t n = list_length(call->arguments);
    const char **list = wt_alloc(n + 2, sizeof *list);
    list[0] = path;
    for (size_t i = 0; i < n; i++)
        list[i + 1] = call->arguments[i];
    return list;
}

/* Last line of the output that is not blank. */
typedef struct last_line {
    char text[400];
    size_t length;
    bool ended; /* the next byte that is not blank begins a new line */
} last_line;

/* Reads the available output. False at its end. */
static bool read_output(int fd, last_line *last)
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

/* A relative path is resolved, because the program runs in another folder. */
static char *resolve_program_path(const char *program)
{
    if (program[0] == '/' || strchr(program, '/') == NULL)
        return wt_strdup(program);
    char *absolute = realpath(program, NULL);
    return absolute != NULL ? absolute : wt_strdup(program);
}

/* Arguments for the child process. */
typedef struct program_start {
    const char *path;
    const program_call *call;
    const char **arguments, **environment;
    int words;       /* descriptor for standard output and standard error */
    int start_error; /* receives errno if exec fails; closed by a successful exec */
    pid_t parent;
} program_start;

/* 0 means no limit. */
static bool set_resource_limit(int resource, size_t most)
{
    const struct rlimit limit = {most, most};
    return most == 0 || setrlimit((__rlimit_resource_t)resource, &limit) == 0;
}

/* Runs in the child, where only async-signal-safe functions are allowed. The child leads a process
 * group, so that its own children end with it. It does not outlive the parent. */
_Noreturn static void exec_program(const program_start *s)
{
    const program_call *const call = s->call;
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == s->parent && setpgid(0, 0) == 0 &&
        set_resource_limit(RLIMIT_FSIZE, call->file_size) &&
        set_resource_limit(RLIMIT_DATA, call->memory) &&
        set_resource_limit(RLIMIT_CPU, call->cpu_time) && chdir(call->folder) == 0) {
        const int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
        // Output of the program must not mix with data in a pipe.
        if (none >= 0 && dup2(none, STDIN_FILENO) >= 0 && dup2(s->words, STDOUT_FILENO) >= 0 &&
            dup2(s->words, STDERR_FILENO) >= 0)
            (void)execvpe(s->path, (char *const *)s->arguments, (char *const *)s->environment);
    }
    const int code = errno;
    (void)!write(s->start_error, &code, sizeof code);
    _exit(127);
}

/* Returns the errno of a failed exec, or 0. Closes the write end of the pipe. */
static int read_start_error(int start_error[2], pid_t child)
{
    int code = 0;
    ssize_t got = 0;
    close(start_error[1]);
    start_error[1] = -1;
    do
        got = read(start_error[0], &code, sizeof code);
    while (got < 0 && errno == EINTR);
    if (got > 0)
        (void)waitpid(child, NULL, 0);
    return got > 0 ? code : 0;
}

/* Starts the program and returns its process and the read end of its output pipe. *code is the
 * errno if it could not be started. */
static wt_status start_program(const program_call *call, pid_t *child, int *words, int *code,
                               wt_error *err)
{
    wt_status status = WT_OK;
    int output_pipe[2] = {-1, -1}, start_error[2] = {-1, -1};
    char *path = resolve_program_path(call->program);
    const char **list = environment(call), **line = create_argument_list(call, path);
    if (pipe2(output_pipe, O_CLOEXEC) != 0 || pipe2(start_error, O_CLOEXEC) != 0) {
        status = wt_fail(err, WT_E_IO, "no pipe for the messages of %s: %s", call->program,
                         strerror(errno));
    } else {
        const program_start s = {path, call, line, list, output_pipe[1], start_error[1], getpid()};
        *child = fork();
        if (*child == 0)
            exec_program(&s);
        *code = *child < 0 ? errno : read_start_error(start_error, *child);
    }
    if (status == WT_OK && *code == 0) {
        *words = output_pipe[0];
        output_pipe[0] = -1;
        (void)fcntl(*words, F_SETFL, O_NONBLOCK);
    }
    for (int i = 0; i < 2; i++) {
        if (output_pipe[i] >= 0)
            close(output_pipe[i]);
        if (start_error[i] >= 0)
            close(start_error[i]);
    }
    free(path);
    free(list);
    free(line);
    return status;
}

/* Waits for the end of the program, the time limit or a cancellation. The state of the pipe does
 * not matter, because children of the program may keep it open. The process is not reaped yet. */
static wt_status wait_for_end(const program_call *call, pid_t child, int fd, last_line *last,
                              program_outcome *outcome, wt_error *err)
{
    enum { POLL_OPEN_MS = 50, POLL_CLOSED_MS = 2 }; // ms
    const double end = wt_time_wall() + call->limit;
    bool open = true;
    for (;;) {
        struct pollfd words = {open ? fd : -1, POLLIN, 0};
        if (poll(&words, 1, open ? POLL_OPEN_MS : POLL_CLOSED_MS) > 0)
            open = read_output(fd, last);
        siginfo_t info = {.si_pid = 0};
        if (waitid(P_PID, (id_t)child, &info, WEXITED | WNOHANG | WNOWAIT) != 0)
            return wt_fail(err, WT_E_TOOL, "the end of %s was not seen: %s", call->program,
                           strerror(errno));
        *outcome = PROGRAM_EXITED;
        if (info.si_pid == child)
            return WT_OK;
        *outcome = PROGRAM_CANCELLED;
        if (call->go_on != NULL && !call->go_on(call->user))
            return WT_OK;
        *outcome = PROGRAM_TOO_LONG;
        if (wt_time_wall() >= end)
            return WT_OK;
    }
}

wt_status program_run(const program_call *call, program_result *end, wt_error *err)
{
    enum { READS_AFTER_END = 32 }; // more than a pipe contains, but finite
    last_line last = {.length = 0};
    pid_t child = 0;
    int words = -1, state = 0;
    *end = (program_result){.outcome = PROGRAM_NOT_STARTED};
    wt_status status = start_program(call, &child, &words, &end->code, err);
    if (status != WT_OK || end->code != 0)
        return status;
    status = wait_for_end(call, child, words, &last, &end->outcome, err);
    (void)kill(-child, SIGKILL); // before it is reaped, while its number is valid
    for (int i = 0; i < READS_AFTER_END && read_output(words, &last); i++)
        ;
    close(words);
    while (waitpid(child, &state, 0) < 0 && errno == EINTR)
        ;
    memcpy(end->words, last.text, sizeof end->words);
    if (end->outcome == PROGRAM_EXITED && WIFSIGNALED(state))
        end->outcome = PROGRAM_SIGNALLED;
    if (end->outcome == PROGRAM_SIGNALLED)
        end->code = WTERMSIG(state);
    else if (end->outcome == PROGRAM_EXITED)
        end->code = WEXITSTATUS(state);
    return status;
}

bool program_detach(const char *program, const char *argument)
{
    /* posix_spawn does not change the arguments. */
    char *const line[] = {(char *)(size_t)program, (char *)(size_t)argument, NULL};
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t files;
    pid_t child = 0;
    if (posix_spawnattr_init(&attributes) != 0)
        return false;
    if (posix_spawn_file_actions_init(&files) != 0) {
        (void)posix_spawnattr_destroy(&attributes);
        return false;
    }
    const bool started =
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID) == 0 &&
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0) == 0 &&
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
        posix_spawnp(&child, program, &files, &attributes, line, environ) == 0;
    (void)posix_spawn_file_actions_destroy(&files);
    (void)posix_spawnattr_destroy(&attributes);
    return started;
}
