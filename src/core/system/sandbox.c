/* Runs a library in a separate process with limits and a system-call filter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/sandbox.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/system/confinement.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
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

/* Moves the output and the file to fixed descriptors and closes all others. The others are closed
 * first, because the calling program may have used all descriptors. */
static bool close_other_descriptors(int to, int file)
{
    const int first = file < 0 || to < file ? to : file, last = to < file ? file : to;
    if (first > 0)
        (void)close_range(0, (unsigned)first - 1, 0);
    if (last > first + 1)
        (void)close_range((unsigned)first + 1, (unsigned)last - 1, 0);
    closefrom(last + 1);
    const int answer = fcntl(to, F_DUPFD, SANDBOX_FILE_FD + 1);
    const int given = file >= 0 ? fcntl(file, F_DUPFD, SANDBOX_FILE_FD + 1) : 0;
    if (answer < 0 || given < 0 || dup2(answer, ANSWER_FD) != ANSWER_FD ||
        (file >= 0 && dup2(given, SANDBOX_FILE_FD) != SANDBOX_FILE_FD))
        return false;
    (void)close_range(0, ANSWER_FD - 1, 0);
    closefrom(ANSWER_FD + 1 + (file >= 0));
    return true;
}

/* Applies all restrictions that sandbox.h describes. */
static char enter_sandbox(int to, const sandbox_call *request, const sandbox_limits *limits,
                          size_t data, pid_t parent)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    const confinement own = {.answer = ANSWER_FD,
                             .memory = data != 0 ? data + limits->memory : 0,
                             .cpu_time = limits->cpu_time};
    sigset_t none;
    (void)sigemptyset(&none);
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL); /* some signals cannot be set and need not be */
    if (!close_other_descriptors(to, request->file))
        return CONFINEMENT_NO_DESCRIPTORS;
    if (sigprocmask(SIG_SETMASK, &none, NULL) != 0)
        return CONFINEMENT_FAILED;
    const char report = confine(&own, parent);
    const bool unlimited = data == 0 && confinement_error(report) == 0;
    return (char)(report + (unlimited ? MEMORY_UNLIMITED : 0));
}

/* The output ends with the error object. Output without it is incomplete. */
_Noreturn static void run_in_sandbox(const sandbox_call *request)
{
    wt_error reported = WT_ERROR_INIT;
    FILE *const answer = fdopen(ANSWER_FD, "w");
    if (answer == NULL || setvbuf(answer, NULL, _IOFBF, ANSWER_BUFFER) != 0)
        _exit(EXIT_FAILURE);
    resource_error_clear();
    reported.status =
        resource_error_finish(request->reading(request, answer, &reported), &reported);
    const bool written = fwrite(&reported, sizeof reported, 1, answer) == 1 && fflush(answer) == 0;
    _exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
}

_Noreturn static void start_in_sandbox(int to, const sandbox_call *request,
                                       const sandbox_limits *limits, size_t data, pid_t parent)
{
    const char report = enter_sandbox(to, request, limits, data, parent);
    const ssize_t n = write(report == CONFINEMENT_NO_DESCRIPTORS ? to : ANSWER_FD, &report, 1);
    if (confinement_error(report) != 0 || n != 1)
        _exit(EXIT_FAILURE);
    run_in_sandbox(request);
}

/* ---- in the calling process ------------------------------------------------------------------ */

/* Determines the size of the data segment, which also counts for the fork; terabytes with a
 * sanitizer. 0 if it is unknown. Returns -1 with errno if no file can be opened. */
static int data_segment_size(size_t *size)
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
static pid_t start_child(int to, const sandbox_call *request, const sandbox_limits *limits,
                         size_t data)
{
    sigset_t all, before;
    const pid_t parent = getpid();
    if (request->enter != NULL)
        request->enter(request->hold);
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = fork();
    if (child == 0)
        start_in_sandbox(to, request, limits, data, parent);
    const int number = errno;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (request->leave != NULL)
        request->leave(request->hold);
    errno = number;
    return child;
}

/* State of the output; STREAM_OPEN means that it continues. */
typedef enum stream_state {
    STREAM_OPEN,
    STREAM_ENDED,
    STREAM_TIMED_OUT,
    STREAM_TOO_LONG,
    STREAM_BROKEN,
    STREAM_NO_MEMORY
} stream_state;

struct sandbox_stream {
    const char *what;
    sandbox_limits limits;
    pid_t child;
    int from;
    stream_state outcome;
    char *bytes; /* received bytes that are not yet consumed */
    size_t length, room;
    size_t taken;
    double waited; /* [s] */
};

/* Reads output until `want` bytes are available, the output ends or a limit is exceeded. Only the
 * waiting time counts, because the caller may process the output slowly. */
static void collect_output(sandbox_stream *stream, size_t want)
{
    const size_t most = stream->limits.answer + sizeof(wt_error);
    while (stream->outcome == STREAM_OPEN && stream->length < want) {
        if (stream->room - stream->length < ANSWER_BUFFER) {
            char *const bytes = realloc(stream->bytes, 2 * stream->room + ANSWER_BUFFER);
            if (bytes == NULL) {
                stream->outcome = STREAM_NO_MEMORY;
                return;
            }
            stream->bytes = bytes;
            stream->room = 2 * stream->room + ANSWER_BUFFER;
        }
        struct pollfd ready = {.fd = stream->from, .events = POLLIN};
        const double begin = wt_time_wall(), left = stream->limits.wall_time - stream->waited;
        const int n_ready = poll(&ready, 1, left > 0.0 ? (int)(1000.0 * left) + 1 : 0);
        stream->waited += wt_time_wall() - begin;
        const ssize_t n = n_ready > 0 ? read(stream->from, stream->bytes + stream->length,
                                             stream->room - stream->length)
                                      : -1;
        stream->length += n > 0 ? (size_t)n : 0;
        if (n_ready == 0)
            stream->outcome = STREAM_TIMED_OUT;
        else if (n == 0)
            stream->outcome = STREAM_ENDED;
        else if (n < 0 && errno != EINTR)
            stream->outcome = STREAM_BROKEN;
        else if (stream->taken + stream->length > most)
            stream->outcome = STREAM_TOO_LONG;
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
static void explain_forbidden_call(const sandbox_stream *stream, bool told, wt_error *err)
{
    int call = -1;
    char name[64] = "its name is not known";
    if (told && stream->length >= sizeof call) {
        memcpy(&call, stream->bytes + stream->length - sizeof call, sizeof call);
        system_call_name(call, name, sizeof name);
    }
    (void)wt_fail(err, WT_E_CORRUPT,
                  "reading the %s file led to a call of the system that reading does not need (%s) "
                  "and was stopped before it",
                  stream->what, name);
}

static wt_status fail_memory_limit(const char *what, const sandbox_limits *limits, wt_error *err)
{
    return wt_fail(err, WT_E_MEMORY, "reading the %s file takes more than %zu MiB of memory", what,
                   limits->memory / MIB);
}

/* Exit status of the UDUNITS scanner when it is out of memory. */
enum { SCANNER_EXIT = 2 };

/* Creates the error of incomplete output. */
static wt_status explain_failure(const sandbox_stream *stream, int state, wt_error *err)
{
    const char *const what = stream->what;
    const sandbox_limits *const limits = &stream->limits;
    const stream_state outcome = stream->outcome;
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    if (outcome == STREAM_NO_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (outcome == STREAM_ENDED && by == 0 && WEXITSTATUS(state) == SCANNER_EXIT)
        return fail_memory_limit(what, limits, err);
    if (outcome == STREAM_BROKEN)
        return wt_fail(err, WT_E_IO, "cannot hear from the process that reads %s", what);
    if (outcome == STREAM_TOO_LONG)
        (void)wt_fail(err, WT_E_CORRUPT, "the %s file gives more than %zu MiB of tables", what,
                      limits->answer / MIB);
    else if (outcome == STREAM_TIMED_OUT || by == SIGXCPU)
        (void)wt_fail(err, WT_E_CORRUPT, "reading the %s file did not end within %u s%s", what,
                      outcome == STREAM_TIMED_OUT ? limits->wall_time : limits->cpu_time,
                      outcome == STREAM_TIMED_OUT ? "" : " of processor time");
    else if (by == SIGSYS ||
             (outcome == STREAM_ENDED && by == 0 && WEXITSTATUS(state) == FORBIDDEN_CALL_EXIT))
        explain_forbidden_call(stream, by == 0, err);
    else if (by == SIGINT || by == SIGTERM || by == SIGHUP)
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    else
        (void)wt_fail(err, WT_E_CORRUPT, "the %s library fails on this file%s%s", what,
                      by != 0 ? ": SIG" : "", by != 0 ? sigabbrev_np(by) : "");
    return advise_damaged(err);
}

/* Copies and validates the error that the process reported. */
static wt_status sandbox_reported_error(const char *what, const char *bytes,
                                        const sandbox_limits *limits, wt_error *err)
{
    wt_error reported;
    memcpy(&reported, bytes, sizeof reported);
    if (reported.status == WT_OK)
        return WT_OK;
    if (reported.status == WT_E_MEMORY)
        return fail_memory_limit(what, limits, err);
    char *const texts[] = {reported.message, reported.file,   reported.place,  reported.expected,
                           reported.found,   reported.advice, reported.options};
    const size_t sizes[] = {sizeof reported.message,  sizeof reported.file,  sizeof reported.place,
                            sizeof reported.expected, sizeof reported.found, sizeof reported.advice,
                            sizeof reported.options};
    for (size_t i = 0; i < COUNT_OF(texts); i++)
        texts[i][sizes[i] - 1] = '\0';
    if (reported.status <= WT_END || reported.status > WT_E_INTERNAL)
        reported.status = WT_E_CORRUPT;
    if (err != NULL)
        *err = reported;
    return reported.status;
}

static wt_status fail_to_start(const char *what, int number, wt_error *err)
{
    (void)wt_fail(err, number == ENOMEM ? WT_E_MEMORY : WT_E_IO, "no process for reading %s: %s",
                  what, strerror(number));
    if (number == EMFILE || number == ENFILE)
        wt_error_advice(err, MORE_FILES_ADVICE);
    return err != NULL ? err->status : number == ENOMEM ? WT_E_MEMORY : WT_E_IO;
}

/* Receives the first byte of the process, which states whether the sandbox is active. */
static wt_status receive_start_report(sandbox_stream *stream, wt_error *err)
{
    collect_output(stream, 1);
    const char report = stream->length > 0 ? stream->bytes[0] : CONFINEMENT_FAILED;
    const int number = confinement_note(report);
    if (number == 0) {
        stream->length--;
        memmove(stream->bytes, stream->bytes + 1, stream->length);
        return WT_OK;
    }
    const stream_state outcome = stream->outcome;
    const int state = finish_child(stream->child, outcome != STREAM_ENDED);
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    stream->child = -1;
    if (outcome == STREAM_ENDED && (by == SIGINT || by == SIGTERM || by == SIGHUP))
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    return fail_to_start(stream->what, outcome == STREAM_NO_MEMORY ? ENOMEM : number, err);
}

wt_status sandbox_start(const sandbox_call *request, const sandbox_limits *limits,
                        sandbox_stream **opened, wt_error *err)
{
    int channel[2];
    size_t data = 0;
    sandbox_stream *const stream = wt_alloc(1, sizeof *stream);
    *stream = (sandbox_stream){.what = request->what, .limits = *limits};
    if (data_segment_size(&data) != 0 || pipe2(channel, O_CLOEXEC) != 0) {
        free(stream);
        return fail_to_start(request->what, errno, err);
    }
    stream->from = channel[0];
    stream->child = start_child(channel[1], request, limits, data);
    const int number = errno;
    (void)close(channel[1]);
    const wt_status status = stream->child < 0 ? fail_to_start(request->what, number, err)
                                               : receive_start_report(stream, err);
    if (status == WT_OK)
        *opened = stream;
    else
        sandbox_close(stream);
    return status;
}

/* Ends the process, whose output is complete or broken, and returns its result. */
static wt_status end_child(sandbox_stream *stream, wt_error *err)
{
    const int state = finish_child(stream->child, stream->outcome != STREAM_ENDED);
    stream->child = -1;
    if (stream->outcome == STREAM_ENDED && state == 0 && stream->length >= sizeof(wt_error))
        return sandbox_reported_error(
            stream->what, stream->bytes + stream->length - sizeof(wt_error), &stream->limits, err);
    return explain_failure(stream, state, err);
}

wt_status sandbox_drain(sandbox_stream *stream, sandbox_sink *sink, void *user, wt_error *err)
{
    wt_status status = WT_OK;
    while (status == WT_OK && stream->outcome == STREAM_OPEN) {
        collect_output(stream, ANSWER_BUFFER + sizeof(wt_error));
        /* The error object at the end is not output. */
        const size_t n = stream->length > sizeof(wt_error) ? stream->length - sizeof(wt_error) : 0;
        status = n > 0 ? sink(user, stream->bytes, n, err) : WT_OK;
        stream->length -= n;
        stream->taken += n;
        memmove(stream->bytes, stream->bytes + n, stream->length);
    }
    return status == WT_OK ? end_child(stream, err) : status;
}

void sandbox_close(sandbox_stream *stream)
{
    if (stream == NULL)
        return;
    if (stream->child >= 0)
        (void)finish_child(stream->child, true);
    (void)close(stream->from);
    free(stream->bytes);
    free(stream);
}

wt_status sandbox_read(const sandbox_call *request, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err)
{
    sandbox_stream *stream = NULL;
    wt_status status = sandbox_start(request, limits, &stream, err);
    if (status != WT_OK)
        return status;
    collect_output(stream, SIZE_MAX);
    status = end_child(stream, err);
    if (status == WT_OK) {
        *answer = stream->bytes;
        *length = stream->length - sizeof(wt_error);
        stream->bytes = NULL;
    }
    sandbox_close(stream);
    return status;
}
