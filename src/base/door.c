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
static bool limit(unsigned resource, size_t most)
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
    /* A file that is opened again has one number more; so have the tables of old encodings. */
    const size_t n_files = door->file >= 0 ? DOOR_FILE + 12 : 0;
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    sigset_t none;
    (void)sigemptyset(&none);
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL); /* some cannot be set, nor need be */
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent ||
        dup_apart(to, door->file) != 0 || prctl(PR_SET_DUMPABLE, door->file >= 0) != 0 ||
        sigprocmask(SIG_SETMASK, &none, NULL) != 0)
        return false;
    for (int i = 0; i < ANSWER_FD; i++)
        (void)close(i);
    closefrom(ANSWER_FD + 1 + (door->file >= 0));
    return limit(RLIMIT_NOFILE, n_files) && limit(RLIMIT_FSIZE, 0) && limit(RLIMIT_CORE, 0) &&
           limit(RLIMIT_CPU, limits->cpu_time) &&
           (data == 0 || limit(RLIMIT_DATA, data + limits->memory));
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
static pid_t start(int to, const door_call *door, const door_limits *limits)
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

/* How the answer ended. */
typedef enum ending { ENDED, LATE, LONG, BROKEN, NO_MEMORY } ending;

typedef struct buffer {
    char *bytes;
    size_t length, room;
} buffer;

/* Collects what comes, until it ends or takes too much. */
static ending collect(int from, const door_limits *limits, buffer *b)
{
    const size_t most = limits->answer + sizeof(wt_error);
    const double deadline = wt_time_wall() + limits->wall_time;
    for (;;) {
        if (b->room - b->length < ANSWER_BUFFER) {
            char *const bytes = realloc(b->bytes, 2 * b->room + ANSWER_BUFFER);
            if (bytes == NULL)
                return NO_MEMORY;
            b->bytes = bytes;
            b->room = 2 * b->room + ANSWER_BUFFER;
        }
        struct pollfd ready = {.fd = from, .events = POLLIN};
        const double left = deadline - wt_time_wall();
        const int n_ready = poll(&ready, 1, left > 0.0 ? (int)(1000.0 * left) + 1 : 0);
        if (n_ready == 0)
            return LATE;
        const ssize_t n = n_ready > 0 ? read(from, b->bytes + b->length, b->room - b->length) : -1;
        if (n == 0)
            return ENDED;
        if (n < 0 && errno != EINTR)
            return BROKEN;
        b->length += n > 0 ? (size_t)n : 0;
        if (b->length > most)
            return LONG;
    }
}

/* Ends the process; its state as waitpid gives it, 0 if the caller's program took that. While the
 * pipe has not ended it lives, so that its number is its own. */
static int finish(pid_t child, bool lives)
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

static wt_status refuse(wt_error *err)
{
    wt_error_advice(err, "the file is damaged or was made to do harm: nothing of it was used; make "
                         "it again from the measured data");
    return WT_E_CORRUPT;
}

/* Why there is no whole answer. */
static wt_status explain(const char *what, ending how, int state, const door_limits *limits,
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
    return refuse(err);
}

/* The error that the process reported, as far as it is one. */
static wt_status reported(const char *what, const char *bytes, const door_limits *limits,
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

wt_status door_read(const door_call *door, const door_limits *limits, char **answer, size_t *length,
                    wt_error *err)
{
    int channel[2];
    buffer b = {NULL, 0, 0};
    wt_status status = WT_OK;
    if (pipe2(channel, O_CLOEXEC) != 0)
        return wt_fail(err, WT_E_IO, "no pipe for reading %s: %s", door->what, strerror(errno));
    const pid_t child = start(channel[1], door, limits);
    const int number = errno;
    (void)close(channel[1]);
    if (child < 0) {
        status = wt_fail(err, number == ENOMEM ? WT_E_MEMORY : WT_E_IO,
                         "no process for reading %s: %s", door->what, strerror(number));
    } else {
        const ending how = collect(channel[0], limits, &b);
        const int state = finish(child, how != ENDED);
        if (how == ENDED && state == 0 && b.length >= sizeof(wt_error))
            status = reported(door->what, b.bytes + b.length - sizeof(wt_error), limits, err);
        else
            status = explain(door->what, how, state, limits, err);
    }
    (void)close(channel[0]);
    if (status == WT_OK) {
        *answer = b.bytes;
        *length = b.length - sizeof(wt_error);
    } else {
        free(b.bytes);
    }
    return status;
}
