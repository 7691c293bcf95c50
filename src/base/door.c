/* A process of its own for a library. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/door.h"

#include "base/array.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define MIB ((size_t)1 << 20)
enum { ANSWER_FD = 3, ANSWER_BUFFER = 1 << 16 };

door_limits door_limits_of(size_t size)
{
    /* A number is 8 bytes in the file and 25 as text at most; the shortest texts grow most. */
    const unsigned mib = size / MIB < 100000 ? (unsigned)(size / MIB) : 100000;
    return (door_limits){.memory = 256 * MIB + 16 * size,
                         .answer = 16 * MIB + 8 * size,
                         .cpu_time = 10 + mib,
                         .wall_time = 60 + 6 * mib};
}

/* ---- behind the door ------------------------------------------------------------------------- */

/* Never more than there was. */
static bool limit_resource(unsigned resource, size_t most)
{
    struct rlimit both;
    if (getrlimit(resource, &both) != 0)
        return false;
    /* One more second of processor time, else its end could not be told from any other. */
    const rlim_t last = most + (resource == RLIMIT_CPU ? 1 : 0);
    both.rlim_max = last < both.rlim_max ? last : both.rlim_max;
    both.rlim_cur = most < both.rlim_max ? most : both.rlim_max;
    return setrlimit(resource, &both) == 0;
}

/* The answer and the file get their numbers, whatever numbers they had. */
static int dup_apart(int to, int file)
{
    const int answer = fcntl(to, F_DUPFD, DOOR_FILE + 1);
    const int given = file >= 0 ? fcntl(file, F_DUPFD, DOOR_FILE + 1) : 0;
    const bool good = answer >= 0 && given >= 0 && dup2(answer, ANSWER_FD) == ANSWER_FD &&
                      (file < 0 || dup2(given, DOOR_FILE) == DOOR_FILE);
    return good ? 0 : -1;
}

/* Everything that the header says of the process. */
static bool shut_in(int to, const door_call *door, const door_limits *limits, size_t data,
                    pid_t parent)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    sigset_t none;
    (void)sigemptyset(&none);
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL); /* some cannot be set, nor need be */
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent ||
        dup_apart(to, door->file) != 0 || prctl(PR_SET_DUMPABLE, 0) != 0 ||
        sigprocmask(SIG_SETMASK, &none, NULL) != 0)
        return false;
    for (int i = 0; i < ANSWER_FD; i++)
        (void)close(i);
    closefrom(ANSWER_FD + 1 + (door->file >= 0));
    return limit_resource(RLIMIT_NOFILE, 0) && limit_resource(RLIMIT_FSIZE, 0) &&
           limit_resource(RLIMIT_CORE, 0) && limit_resource(RLIMIT_CPU, limits->cpu_time) &&
           (data == 0 || limit_resource(RLIMIT_DATA, data + limits->memory));
}

/* The answer ends with the error, so that one without it was cut off. */
_Noreturn static void behind_door(const door_call *door)
{
    wt_error said = WT_ERROR_INIT;
    FILE *const answer = fdopen(ANSWER_FD, "w");
    if (answer == NULL || setvbuf(answer, NULL, _IOFBF, ANSWER_BUFFER) != 0)
        _exit(EXIT_FAILURE);
    said.status = door->reading(door, answer, &said);
    const bool written = fwrite(&said, sizeof said, 1, answer) == 1 && fflush(answer) == 0;
    _exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* ---- in front of it -------------------------------------------------------------------------- */

/* Bytes of data that this process has, which its fork counts too (with a sanitizer, terabytes); 0:
 * not known. */
static size_t data_size(void)
{
    size_t pages = 0;
    FILE *const in = fopen("/proc/self/statm", "re");
    if (in == NULL)
        return 0;
    if (fscanf(in, "%*s %*s %*s %*s %*s %zu", &pages) != 1)
        pages = 0;
    (void)fclose(in);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* Signals wait until the new process has forgotten the handlers of this one. */
static pid_t start_child(int to, const door_call *door, const door_limits *limits)
{
    sigset_t all, before;
    const pid_t parent = getpid();
    const size_t data = data_size();
    if (door->enter != NULL)
        door->enter(door->hold);
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = fork();
    if (child == 0) {
        if (!shut_in(to, door, limits, data, parent))
            _exit(EXIT_FAILURE);
        behind_door(door);
    }
    const int number = errno;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (door->leave != NULL)
        door->leave(door->hold);
    errno = number;
    return child;
}

/* How the answer ended; COMING: it has not. */
typedef enum ending { COMING, ENDED, LATE, LONG, BROKEN, NO_MEMORY } ending;

struct door_flow {
    const char *what;
    door_limits limits;
    pid_t child;
    int from;
    ending how;
    char *bytes; /* that came and were not taken */
    size_t length, room;
    size_t taken;
    double waited; /* [s] */
};

/* Collects what comes until there is so much, it ends or takes too much. Only waiting counts as
 * time: the caller may be long about what it takes. */
static void collect_answer(door_flow *flow, size_t want)
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

/* Ends the process; its state as waitpid gives it, 0 if the caller's program took that. While the
 * pipe has not ended it lives, so that its number is its own. */
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

/* Why there is no whole answer. */
static wt_status explain_ending(const char *what, ending how, int state, const door_limits *limits,
                                wt_error *err)
{
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    if (how == NO_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (how == BROKEN)
        return wt_fail(err, WT_E_IO, "cannot hear from the process that reads %s", what);
    if (how == LONG)
        (void)wt_fail(err, WT_E_CORRUPT, "the %s file gives more than %zu MiB of tables", what,
                      limits->answer / MIB);
    else if (how == LATE || by == SIGXCPU)
        (void)wt_fail(err, WT_E_CORRUPT, "reading the %s file did not end within %u s%s", what,
                      how == LATE ? limits->wall_time : limits->cpu_time,
                      how == LATE ? "" : " of processor time");
    else if (by == SIGINT || by == SIGTERM || by == SIGHUP)
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    else
        (void)wt_fail(err, WT_E_CORRUPT, "the %s library fails on this file%s%s", what,
                      by != 0 ? ": SIG" : "", by != 0 ? sigabbrev_np(by) : "");
    return advise_damaged(err);
}

/* The error that the process reported, as far as it is one. */
static wt_status reported_error(const char *what, const char *bytes, const door_limits *limits,
                                wt_error *err)
{
    wt_error said;
    memcpy(&said, bytes, sizeof said);
    if (said.status == WT_OK)
        return WT_OK;
    if (said.status == WT_E_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "reading the %s file takes more than %zu MiB of memory",
                       what, limits->memory / MIB);
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

wt_status door_begin(const door_call *door, const door_limits *limits, door_flow **begun,
                     wt_error *err)
{
    int channel[2];
    door_flow *const flow = calloc(1, sizeof *flow);
    if (flow == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *flow = (door_flow){.what = door->what, .limits = *limits};
    if (pipe2(channel, O_CLOEXEC) != 0) {
        free(flow);
        return wt_fail(err, WT_E_IO, "no pipe for reading %s: %s", door->what, strerror(errno));
    }
    flow->from = channel[0];
    flow->child = start_child(channel[1], door, limits);
    const int number = errno;
    (void)close(channel[1]);
    if (flow->child < 0) {
        (void)close(flow->from);
        free(flow);
        return wt_fail(err, number == ENOMEM ? WT_E_MEMORY : WT_E_IO,
                       "no process for reading %s: %s", door->what, strerror(number));
    }
    *begun = flow;
    return WT_OK;
}

/* Ends the process, whose answer is over, and says what became of it. */
static wt_status end_process(door_flow *flow, wt_error *err)
{
    const int state = finish_child(flow->child, flow->how != ENDED);
    flow->child = -1;
    if (flow->how == ENDED && state == 0 && flow->length >= sizeof(wt_error))
        return reported_error(flow->what, flow->bytes + flow->length - sizeof(wt_error),
                              &flow->limits, err);
    return explain_ending(flow->what, flow->how, state, &flow->limits, err);
}

static wt_status fail_unexpected(const door_flow *flow, const char *how, wt_error *err)
{
    (void)wt_fail(err, WT_E_CORRUPT, "the %s file gives %s than it says", flow->what, how);
    return advise_damaged(err);
}

wt_status door_take(door_flow *flow, void *to, size_t n, wt_error *err)
{
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    /* The error that the answer ends with must not be taken for a part of it. */
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

wt_status door_pour(door_flow *flow, door_sink *sink, void *user, wt_error *err)
{
    wt_status status = WT_OK;
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    while (status == WT_OK && flow->how == COMING) {
        collect_answer(flow, ANSWER_BUFFER + sizeof(wt_error));
        /* The error at the end is not a part of it. */
        const size_t n = flow->length > sizeof(wt_error) ? flow->length - sizeof(wt_error) : 0;
        status = n > 0 ? sink(user, flow->bytes, n, err) : WT_OK;
        flow->length -= n;
        flow->taken += n;
        memmove(flow->bytes, flow->bytes + n, flow->length);
    }
    return status == WT_OK ? end_process(flow, err) : status;
}

wt_status door_end(door_flow *flow, wt_error *err)
{
    if (flow->child < 0)
        return fail_unexpected(flow, "less", err);
    collect_answer(flow, SIZE_MAX);
    const wt_status status = end_process(flow, err);
    return status == WT_OK && flow->length != sizeof(wt_error) ? fail_unexpected(flow, "more", err)
                                                               : status;
}

void door_close(door_flow *flow)
{
    if (flow == NULL)
        return;
    if (flow->child >= 0)
        (void)finish_child(flow->child, true);
    (void)close(flow->from);
    free(flow->bytes);
    free(flow);
}

wt_status door_read(const door_call *door, const door_limits *limits, char **answer, size_t *length,
                    wt_error *err)
{
    door_flow *flow = NULL;
    wt_status status = door_begin(door, limits, &flow, err);
    if (status != WT_OK)
        return status;
    collect_answer(flow, SIZE_MAX);
    status = end_process(flow, err);
    if (status == WT_OK) {
        *answer = flow->bytes;
        *length = flow->length - sizeof(wt_error);
        flow->bytes = NULL;
    }
    door_close(flow);
    return status;
}
