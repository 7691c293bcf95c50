/* Runs a library in a separate process with limits and a system-call filter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/sandbox.h"

#include "core/base/array.h"
#include "core/base/resource_error.h"
#include "core/system/seccomp_filter.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define MIB ((size_t)1 << 20)
enum { ANSWER_FD = 3, ANSWER_BUFFER = 1 << 16 };

sandbox_limits sandbox_limits_for(size_t size)
{
    /* A number has 8 bytes in the file and at most 25 as text. Short texts grow most. */
    const unsigned mib = size / MIB < 100000 ? (unsigned)(size / MIB) : 100000;
    return (sandbox_limits){.memory = 256 * MIB + 16 * size,
                            .answer = 16 * MIB + 8 * size,
                            .cpu_time = 10 + mib,
                            .wall_time = 60 + 6 * mib};
}

/* ---- in the sandbox -------------------------------------------------------------------------- */

/* Sets a limit that never exceeds the current one. */
static bool limit_resource(unsigned resource, size_t most)
{
    struct rlimit both;
    if (getrlimit(resource, &both) != 0)
        return false;
    /* The hard limit has one more second of processor time, so that SIGXCPU is distinguished from
     * SIGKILL. */
    const rlim_t last = most + (resource == RLIMIT_CPU ? 1 : 0);
    both.rlim_max = last < both.rlim_max ? last : both.rlim_max;
    both.rlim_cur = most < both.rlim_max ? most : both.rlim_max;
    return setrlimit(resource, &both) == 0;
}

/* Moves the output and the file to fixed descriptors and closes all others. The others are closed
 * first, because the calling program may have used all descriptors. */
static bool keep_only(int to, int file)
{
    const int first = file < 0 || to < file ? to : file, last = to < file ? file : to;
    if (first > 0)
        (void)close_range(0, (unsigned)first - 1, 0);
    if (last > first + 1)
        (void)close_range((unsigned)first + 1, (unsigned)last - 1, 0);
    closefrom(last + 1);
    const int answer = fcntl(to, F_DUPFD, DOOR_FILE + 1);
    const int given = file >= 0 ? fcntl(file, F_DUPFD, DOOR_FILE + 1) : 0;
    if (answer < 0 || given < 0 || dup2(answer, ANSWER_FD) != ANSWER_FD ||
        (file >= 0 && dup2(given, DOOR_FILE) != DOOR_FILE))
        return false;
    (void)close_range(0, ANSWER_FD - 1, 0);
    closefrom(ANSWER_FD + 1 + (file >= 0));
    return true;
}

/* First byte of the output, written before the library reads the file: flags of missing
 * protections, or the reason why the sandbox failed. */
enum {
    SHUT_IN = 'P',
    NO_FILTER = 1,
    MEMORY_OPEN = 2,
    FEW_FILES = 'f',
    LOW_MEMORY = 'm',
    BAD = 'x'
};

/* Applies all restrictions that sandbox.h describes. */
static char enter_sandbox(int to, const sandbox_call *door, const sandbox_limits *limits,
                          size_t data, pid_t parent)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    sigset_t none;
    (void)sigemptyset(&none);
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL); /* some signals cannot be set and need not be */
    if (!keep_only(to, door->file))
        return FEW_FILES;
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent ||
        prctl(PR_SET_DUMPABLE, 0) != 0 || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        sigprocmask(SIG_SETMASK, &none, NULL) != 0 || !limit_resource(RLIMIT_NOFILE, 0) ||
        !limit_resource(RLIMIT_FSIZE, 0) || !limit_resource(RLIMIT_CORE, 0) ||
        !limit_resource(RLIMIT_NPROC, 0) || !limit_resource(RLIMIT_CPU, limits->cpu_time) ||
        (data != 0 && !limit_resource(RLIMIT_DATA, data + limits->memory)))
        return BAD;
    const door_filter filter = seccomp_filter_install(ANSWER_FD);
    if (filter == FILTER_NO_MEMORY)
        return LOW_MEMORY;
    return (char)(SHUT_IN + (filter == FILTER_SET ? 0 : NO_FILTER) + (data != 0 ? 0 : MEMORY_OPEN));
}

/* The output ends with the error object. Output without it is incomplete. */
_Noreturn static void run_in_sandbox(const sandbox_call *door)
{
    wt_error said = WT_ERROR_INIT;
    FILE *const answer = fdopen(ANSWER_FD, "w");
    if (answer == NULL || setvbuf(answer, NULL, _IOFBF, ANSWER_BUFFER) != 0)
        _exit(EXIT_FAILURE);
    resource_error_clear();
    said.status = resource_error_finish(door->reading(door, answer, &said), &said);
    const bool written = fwrite(&said, sizeof said, 1, answer) == 1 && fflush(answer) == 0;
    _exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
}

_Noreturn static void start_in_sandbox(int to, const sandbox_call *door,
                                       const sandbox_limits *limits, size_t data, pid_t parent)
{
    const char hello = enter_sandbox(to, door, limits, data, parent);
    const bool held = hello >= SHUT_IN && hello <= SHUT_IN + (NO_FILTER | MEMORY_OPEN);
    const ssize_t n = write(hello == FEW_FILES ? to : ANSWER_FD, &hello, 1);
    if (!held || n != 1)
        _exit(EXIT_FAILURE);
    run_in_sandbox(door);
}

/* ---- in the calling process ------------------------------------------------------------------ */

/* Protections that were missing in any process so far. */
static atomic_uint gaps;

const char *wt_sandbox_limitations(void)
{
    static const char *const words[] = {
        NULL,
        "this system refuses the filter of system calls (seccomp) behind which HDF5 files are "
        "read: a file made to do harm could do what you may; take files that you trust only",
        "without /proc the memory that reading HDF5 files takes has no limit",
        "this system refuses the filter of system calls (seccomp) behind which HDF5 files are "
        "read, and has no /proc, by which their memory is limited: a file made to do harm could do "
        "what "
        "you may; take files that you trust only"};
    return words[atomic_load(&gaps)];
}

/* Determines the size of the data segment, which also counts for the fork; terabytes with a
 * sanitizer. 0 if it is unknown. Returns -1 with errno if no file can be opened. */
static int data_size(size_t *size)
{
    size_t pages = 0;
    *size = 0;
    FILE *const in = fopen("/proc/self/statm", "re");
    if (in == NULL)
        return errno == EMFILE || errno == ENFILE || errno == ENOMEM ? -1 : 0;
    if (fscanf(in, "%*s %*s %*s %*s %*s %zu", &pages) == 1)
        *size = pages * (size_t)sysconf(_SC_PAGESIZE);
    (void)fclose(in);
    return 0;
}

/* Signals are blocked until the new process has reset its signal handlers. */
static pid_t start_child(int to, const sandbox_call *door, const sandbox_limits *limits,
                         size_t data)
{
    sigset_t all, before;
    const pid_t parent = getpid();
    if (door->enter != NULL)
        door->enter(door->hold);
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = fork();
    if (child == 0)
        start_in_sandbox(to, door, limits, data, parent);
    const int number = errno;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (door->leave != NULL)
        door->leave(door->hold);
    errno = number;
    return child;
}

/* State of the output; STREAM_OPEN means that it continues. */
typedef enum ending { COMING, ENDED, LATE, LONG, BROKEN, NO_MEMORY } ending;

struct sandbox_stream {
    const char *what;
    sandbox_limits limits;
    pid_t child;
    int from;
    ending how;
    char *bytes; /* received bytes that are not yet consumed */
    size_t length, room;
    size_t taken;
    double waited; /* [s] */
};

/* Reads output until `want` bytes are available, the output ends or a limit is exceeded. Only the
 * waiting time counts, because the caller may process the output slowly. */
static void collect_answer(sandbox_stream *flow, size_t want)
{
    const size_t most = flow->limits.answer + sizeof(wt_error);
    while (flow->how == COMING && flow->length < want) {
        if (flow->room - flow->length < ANSWER_BUFFER) {
            char *const bytes = realloc(flow->bytes, 2 * flow->room + ANSWER_BUFFER);
            if (bytes == NULL) {
                flow->how = NO_MEMORY;
                return;
            }
            flow->bytes = bytes;
            flow->room = 2 * flow->room + ANSWER_BUFFER;
        }
        struct pollfd ready = {.fd = flow->from, .events = POLLIN};
        const double begin = wt_time_wall(), left = flow->limits.wall_time - flow->waited;
        const int n_ready = poll(&ready, 1, left > 0.0 ? (int)(1000.0 * left) + 1 : 0);
        flow->waited += wt_time_wall() - begin;
        const ssize_t n =
            n_ready > 0 ? read(flow->from, flow->bytes + flow->length, flow->room - flow->length)
                        : -1;
        flow->length += n > 0 ? (size_t)n : 0;
        if (n_ready == 0)
            flow->how = LATE;
        else if (n == 0)
            flow->how = ENDED;
        else if (n < 0 && errno != EINTR)
            flow->how = BROKEN;
        else if (flow->taken + flow->length > most)
            flow->how = LONG;
    }
}

/* Kills the process if it `lives`. Returns its state as of waitpid, 0 if another part of the
 * program has reaped it. The process lives while the pipe is open, so that its number is valid. */
static int finish_child(pid_t child, bool lives)
{
    int state = 0;
    if (lives)
        (void)kill(child, SIGKILL);
    while (waitpid(child, &state, 0) < 0) {
        if (errno != EINTR)
            return 0;
    }
    return state;
}

static wt_status advise_damaged(wt_error *err)
{
    wt_error_advice(err, "the file is damaged or was made to do harm: nothing of it was used; make "
                         "it again from the measured data");
    return WT_E_CORRUPT;
}

/* Reports a forbidden system call of the process. Its name is unknown if the process blocked all
 * signals. */
static void explain_call(const sandbox_stream *flow, bool told, wt_error *err)
{
    int call = -1;
    char name[64] = "its name is not known";
    if (told && flow->length >= sizeof call) {
        memcpy(&call, flow->bytes + flow->length - sizeof call, sizeof call);
        seccomp_syscall_name(call, name, sizeof name);
    }
    (void)wt_fail(err, WT_E_CORRUPT,
                  "reading the %s file led to a call of the system that reading does not need (%s) "
                  "and was stopped before it",
                  flow->what, name);
}

static wt_status fail_starved(const char *what, const sandbox_limits *limits, wt_error *err)
{
    return wt_fail(err, WT_E_MEMORY, "reading the %s file takes more than %zu MiB of memory", what,
                   limits->memory / MIB);
}

/* Exit status of the UDUNITS scanner when it is out of memory. */
enum { SCANNER_EXIT = 2 };

/* Creates the error of incomplete output. */
static wt_status explain_ending(const sandbox_stream *flow, int state, wt_error *err)
{
    const char *const what = flow->what;
    const sandbox_limits *const limits = &flow->limits;
    const ending how = flow->how;
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    if (how == NO_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (how == ENDED && by == 0 && WEXITSTATUS(state) == SCANNER_EXIT)
        return fail_starved(what, limits, err);
    if (how == BROKEN)
        return wt_fail(err, WT_E_IO, "cannot hear from the process that reads %s", what);
    if (how == LONG)
        (void)wt_fail(err, WT_E_CORRUPT, "the %s file gives more than %zu MiB of tables", what,
                      limits->answer / MIB);
    else if (how == LATE || by == SIGXCPU)
        (void)wt_fail(err, WT_E_CORRUPT, "reading the %s file did not end within %u s%s", what,
                      how == LATE ? limits->wall_time : limits->cpu_time,
                      how == LATE ? "" : " of processor time");
    else if (by == SIGSYS || (how == ENDED && by == 0 && WEXITSTATUS(state) == FILTER_EXIT))
        explain_call(flow, by == 0, err);
    else if (by == SIGINT || by == SIGTERM || by == SIGHUP)
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    else
        (void)wt_fail(err, WT_E_CORRUPT, "the %s library fails on this file%s%s", what,
                      by != 0 ? ": SIG" : "", by != 0 ? sigabbrev_np(by) : "");
    return advise_damaged(err);
}

/* Copies and validates the error that the process reported. */
static wt_status reported_error(const char *what, const char *bytes, const sandbox_limits *limits,
                                wt_error *err)
{
    wt_error said;
    memcpy(&said, bytes, sizeof said);
    if (said.status == WT_OK)
        return WT_OK;
    if (said.status == WT_E_MEMORY)
        return fail_starved(what, limits, err);
    char *const texts[] = {said.message,  said.file,  said.place,
                           said.expected, said.found, said.advice};
    const size_t sizes[] = {sizeof said.message,  sizeof said.file,  sizeof said.place,
                            sizeof said.expected, sizeof said.found, sizeof said.advice};
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        texts[i][sizes[i] - 1] = '\0';
    if (said.status <= WT_END || said.status > WT_E_INTERNAL)
        said.status = WT_E_CORRUPT;
    if (err != NULL)
        *err = said;
    return said.status;
}

static wt_status fail_to_make(const char *what, int number, wt_error *err)
{
    (void)wt_fail(err, number == ENOMEM ? WT_E_MEMORY : WT_E_IO, "no process for reading %s: %s",
                  what, strerror(number));
    if (number == EMFILE || number == ENFILE)
        wt_error_advice(err, MORE_FILES_ADVICE);
    return err != NULL ? err->status : number == ENOMEM ? WT_E_MEMORY : WT_E_IO;
}

/* Receives the first byte of the process, which states whether the sandbox is active. */
static wt_status hear_hello(sandbox_stream *flow, wt_error *err)
{
    collect_answer(flow, 1);
    const char hello = flow->length > 0 ? flow->bytes[0] : BAD;
    if (hello >= SHUT_IN && hello <= SHUT_IN + (NO_FILTER | MEMORY_OPEN)) {
        atomic_fetch_or(&gaps, (unsigned)(hello - SHUT_IN));
        flow->length--;
        memmove(flow->bytes, flow->bytes + 1, flow->length);
        return WT_OK;
    }
    const ending how = flow->how;
    const int state = finish_child(flow->child, how != ENDED);
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    flow->child = -1;
    if (how == ENDED && (by == SIGINT || by == SIGTERM || by == SIGHUP))
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    return fail_to_make(flow->what,
                        hello == FEW_FILES                        ? EMFILE
                        : hello == LOW_MEMORY || how == NO_MEMORY ? ENOMEM
                                                                  : EPERM,
                        err);
}

wt_status sandbox_start(const sandbox_call *door, const sandbox_limits *limits,
                        sandbox_stream **begun, wt_error *err)
{
    int channel[2];
    size_t data = 0;
    sandbox_stream *const flow = calloc(1, sizeof *flow);
    if (flow == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *flow = (sandbox_stream){.what = door->what, .limits = *limits};
    if (data_size(&data) != 0 || pipe2(channel, O_CLOEXEC) != 0) {
        free(flow);
        return fail_to_make(door->what, errno, err);
    }
    flow->from = channel[0];
    flow->child = start_child(channel[1], door, limits, data);
    const int number = errno;
    (void)close(channel[1]);
    const wt_status status =
        flow->child < 0 ? fail_to_make(door->what, number, err) : hear_hello(flow, err);
    if (status == WT_OK)
        *begun = flow;
    else
        sandbox_close(flow);
    return status;
}

/* Ends the process, whose output is complete or broken, and returns its result. */
static wt_status end_process(sandbox_stream *flow, wt_error *err)
{
    const int state = finish_child(flow->child, flow->how != ENDED);
    flow->child = -1;
    if (flow->how == ENDED && state == 0 && flow->length >= sizeof(wt_error))
        return reported_error(flow->what, flow->bytes + flow->length - sizeof(wt_error),
                              &flow->limits, err);
    return explain_ending(flow, state, err);
}

static wt_status fail_unexpected(const sandbox_stream *flow, const char *how, wt_error *err)
{
    (void)wt_fail(err, WT_E_CORRUPT, "the %s file gives %s than it says", flow->what, how);
    return advise_damaged(err);
}

wt_status sandbox_receive(sandbox_stream *flow, void *to, size_t n, wt_error *err)
{
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    /* The error object at the end must not be taken as output. */
    collect_answer(flow, n + sizeof(wt_error));
    if (flow->length < n + sizeof(wt_error)) {
        const wt_status status = end_process(flow, err);
        return status != WT_OK ? status : fail_unexpected(flow, "less", err);
    }
    memcpy(to, flow->bytes, n);
    flow->length -= n;
    flow->taken += n;
    memmove(flow->bytes, flow->bytes + n, flow->length);
    return WT_OK;
}

wt_status sandbox_drain(sandbox_stream *flow, sandbox_sink *sink, void *user, wt_error *err)
{
    wt_status status = WT_OK;
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    while (status == WT_OK && flow->how == COMING) {
        collect_answer(flow, ANSWER_BUFFER + sizeof(wt_error));
        /* The error object at the end is not output. */
        const size_t n = flow->length > sizeof(wt_error) ? flow->length - sizeof(wt_error) : 0;
        status = n > 0 ? sink(user, flow->bytes, n, err) : WT_OK;
        flow->length -= n;
        flow->taken += n;
        memmove(flow->bytes, flow->bytes + n, flow->length);
    }
    return status == WT_OK ? end_process(flow, err) : status;
}

wt_status sandbox_finish(sandbox_stream *flow, wt_error *err)
{
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    collect_answer(flow, SIZE_MAX);
    const wt_status status = end_process(flow, err);
    return status == WT_OK && flow->length != sizeof(wt_error) ? fail_unexpected(flow, "more", err)
                                                               : status;
}

void sandbox_close(sandbox_stream *flow)
{
    if (flow == NULL)
        return;
    if (flow->child >= 0)
        (void)finish_child(flow->child, true);
    (void)close(flow->from);
    free(flow->bytes);
    free(flow);
}

wt_status sandbox_read(const sandbox_call *door, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err)
{
    sandbox_stream *flow = NULL;
    wt_status status = sandbox_start(door, limits, &flow, err);
    if (status != WT_OK)
        return status;
    collect_answer(flow, SIZE_MAX);
    status = end_process(flow, err);
    if (status == WT_OK) {
        *answer = flow->bytes;
        *length = flow->length - sizeof(wt_error);
        flow->bytes = NULL;
    }
    sandbox_close(flow);
    return status;
}
