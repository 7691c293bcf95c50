/* Starts another program and waits for its end. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/subprocess.h"
#include "core/base/memory.h"
#include "core/system/confinement.h"
#include "core/system/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
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

/* Returns an absolute path, because the program runs in another folder; or the name if there is no
 * such program. Relative folders in PATH are not searched. */
static char *find_program(const char *program)
{
    if (strchr(program, '/') != NULL) {
        char *const absolute = program[0] != '/' ? realpath(program, NULL) : NULL;
        return absolute != NULL ? absolute : wt_strdup(program);
    }
    const char *at = getenv("PATH");
    for (size_t n; at != NULL; at = at[n] != '\0' ? at + n + 1 : NULL) {
        n = strcspn(at, ":");
        char *const path = format_text("%.*s/%s", (int)n, at, program);
        struct stat info;
        if (path[0] == '/' && n > 0 && access(path, X_OK) == 0 && stat(path, &info) == 0 &&
            S_ISREG(info.st_mode))
            return path;
        free(path);
    }
    return wt_strdup(program);
}

/* Arguments for the child process. */
typedef struct program_start {
    const char *path;
    const program_call *call;
    const char **arguments, **environment;
    int words;  /* descriptor for standard output and standard error */
    int report; /* receives the report of the confinement, and errno if the program is not started;
                   closed by a successful exec */
    pid_t parent;
} program_start;

/* Runs in the child. The child leads a process group, so that its own children end with it. */
_Noreturn static void exec_program(const program_start *s)
{
    const program_call *const call = s->call;
    const confinement own = {.program = s->path,
                             .memory = call->memory,
                             .file_size = call->file_size,
                             .cpu_time = call->cpu_time};
    char report = CONFINED;
    bool ready = setpgid(0, 0) == 0 && chdir(call->folder) == 0;
    const int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
    // Output of the program must not mix with data in a pipe.
    ready = ready && none >= 0 && dup2(none, STDIN_FILENO) >= 0 &&
            dup2(s->words, STDOUT_FILENO) >= 0 && dup2(s->words, STDERR_FILENO) >= 0;
    if (ready && call->foreign) {
        (void)close_range(STDERR_FILENO + 1, UINT_MAX, CLOSE_RANGE_CLOEXEC);
        report = confine(&own, s->parent);
    } else if (ready && (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != s->parent)) {
        report = CONFINEMENT_FAILED;
    }
    int code = errno;
    if (write(s->report, &report, 1) == 1 && ready && confinement_error(report) == 0) {
        (void)execvpe(s->path, (char *const *)s->arguments, (char *const *)s->environment);
        code = errno;
    }
    (void)!write(s->report, &code, sizeof code);
    _exit(127);
}

/* Returns the error number of a program that was not started, or 0. */
static int receive_report(int from, pid_t child)
{
    char bytes[1 + sizeof(int)];
    size_t n = 0;
    for (ssize_t got = 1; n < sizeof bytes && got != 0; n += got > 0 ? (size_t)got : 0) {
        got = read(from, bytes + n, sizeof bytes - n);
        if (got < 0 && errno != EINTR)
            break;
    }
    int code = confinement_note(n > 0 ? bytes[0] : CONFINEMENT_FAILED);
    if (code == 0 && n == sizeof bytes)
        memcpy(&code, bytes + 1, sizeof code);
    while (code != 0 && waitpid(child, NULL, 0) < 0 && errno == EINTR)
        ;
    return code;
}

/* Starts the program and returns its process and the read end of its output pipe. *code is the
 * errno if it could not be started. */
static wt_status start_program(const program_call *call, pid_t *child, int *words, int *code,
                               wt_error *err)
{
    wt_status status = WT_OK;
    int output_pipe[2] = {-1, -1}, report[2] = {-1, -1};
    char *path = find_program(call->program);
    const char **list = environment(call), **line = create_argument_list(call, path);
    if (pipe2(output_pipe, O_CLOEXEC) != 0 || pipe2(report, O_CLOEXEC) != 0) {
        status = wt_fail(err, WT_E_IO, "no pipe for the messages of %s: %s", call->program,
                         strerror(errno));
        wt_error_advice(err, MORE_FILES_ADVICE);
    } else {
        const program_start s = {path, call, line, list, output_pipe[1], report[1], getpid()};
        *child = fork();
        if (*child == 0)
            exec_program(&s);
        *code = *child < 0 ? errno : 0;
        close(report[1]);
        report[1] = -1;
        if (*child > 0)
            *code = receive_report(report[0], *child);
    }
    if (status == WT_OK && *code == 0) {
        *words = output_pipe[0];
        output_pipe[0] = -1;
        (void)fcntl(*words, F_SETFL, O_NONBLOCK);
    }
    for (int i = 0; i < 2; i++) {
        if (output_pipe[i] >= 0)
            close(output_pipe[i]);
        if (report[i] >= 0)
            close(report[i]);
    }
    free(path);
    free(list);
    free(line);
    return status;
}

/* Waits for the end of the program, a limit or a cancellation. The state of the pipe does
 * not matter, because children of the program may keep it open. The process is not reaped yet. */
static wt_status wait_for_end(const program_call *call, size_t folder_limit, pid_t child, int fd,
                              last_line *last, program_outcome *outcome, wt_error *err)
{
    enum { POLL_OPEN_MS = 50, POLL_CLOSED_MS = 2 }; // ms
    static const double between = 0.05;             // time between two checks of the folder [s]
    const double end = wt_time_wall() + call->limit;
    double next = 0;
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
        const double now = wt_time_wall();
        *outcome = PROGRAM_TOO_LONG;
        if (now >= end)
            return WT_OK;
        *outcome = PROGRAM_TOO_LARGE;
        if (call->foreign && now >= next) {
            if (temporary_folder_size(call->folder, folder_limit) > folder_limit)
                return WT_OK;
            next = wt_time_wall() + between;
        }
    }
}

wt_status program_run(const program_call *call, program_result *end, wt_error *err)
{
    enum { READS_AFTER_END = 32 }; // more than a pipe contains, but finite
    last_line last = {.length = 0};
    pid_t child = 0;
    int words = -1, state = 0;
    *end = (program_result){.outcome = PROGRAM_NOT_STARTED};
    const size_t room = call->folder_size,
                 before = call->foreign ? temporary_folder_size(call->folder, SIZE_MAX - room) : 0;
    wt_status status = start_program(call, &child, &words, &end->code, err);
    if (status != WT_OK || end->code != 0)
        return status;
    status = wait_for_end(call, before + room, child, words, &last, &end->outcome, err);
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
