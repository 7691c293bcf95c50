/* The door to HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/hdf5_door.h"
#include "data/hdf5_scope.h"

#include "base/array.h"

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

#define MIB ((size_t)1 << 20)
enum { ANSWER_FD = 3, ANSWER_BUFFER = 1 << 16 };

hdf5_limits hdf5_limits_of(size_t size)
{
    /* A number is 8 bytes in the file and 25 as text at most; the shortest texts grow most. */
    const unsigned mib = size / MIB < 100000 ? (unsigned)(size / MIB) : 100000;
    return (hdf5_limits){.memory = 256 * MIB + 16 * size,
                         .answer = 16 * MIB + 8 * size,
                         .cpu_time = 10 + mib,
                         .wall_time = 60 + 6 * mib};
}

/* ---- behind the door ------------------------------------------------------------------------- */

/* HDF5 asks for copies of the image in memory and gets the image itself: it only reads. The process
 * has one thread and reads one file. */
static const unsigned char *image;

static void *take_image(size_t size, H5FD_file_image_op_t operation, void *user)
{
    (void)size;
    (void)operation;
    (void)user;
    return (void *)(uintptr_t)image;
}

static void *copy_image(void *to, const void *from, size_t size, H5FD_file_image_op_t operation,
                        void *user)
{
    (void)from;
    (void)size;
    (void)operation;
    (void)user;
    return to;
}

static herr_t leave_image(void *bytes, H5FD_file_image_op_t operation, void *user)
{
    (void)bytes;
    (void)operation;
    (void)user;
    return 0;
}

/* HDF5 begins at 0, 512, 1024, 2048, ... */
static bool has_signature(size_t size)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1A, '\n'};
    for (size_t at = 0; at + sizeof signature <= size; at = at > 0 ? 2 * at : 512) {
        if (memcmp(image + at, signature, sizeof signature) == 0)
            return true;
    }
    return false;
}

static hid_t open_image(size_t size)
{
    H5FD_file_image_callbacks_t callbacks = {
        .image_malloc = take_image, .image_memcpy = copy_image, .image_free = leave_image};
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access < 0 || H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) < 0 ||
        H5Pset_fapl_core(access, MIB, false) < 0 ||
        H5Pset_file_image_callbacks(access, &callbacks) < 0 ||
        H5Pset_file_image(access, (void *)(uintptr_t)image, size) < 0)
        return -1;
    return H5Fopen("weartrack.h5", H5F_ACC_RDONLY, access);
}

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

/* Everything that the header says of the process. */
static bool shut_in(int to, const hdf5_limits *limits, size_t data, pid_t parent)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    sigset_t none;
    (void)sigemptyset(&none);
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL); /* some cannot be set, nor need be */
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent ||
        prctl(PR_SET_DUMPABLE, 0) != 0 || dup2(to, ANSWER_FD) < 0 ||
        sigprocmask(SIG_SETMASK, &none, NULL) != 0)
        return false;
    for (int i = 0; i < ANSWER_FD; i++)
        (void)close(i);
    closefrom(ANSWER_FD + 1);
    return limit(RLIMIT_NOFILE, 0) && limit(RLIMIT_FSIZE, 0) &&
           limit(RLIMIT_CPU, limits->cpu_time) &&
           (data == 0 || limit(RLIMIT_DATA, data + limits->memory));
}

/* The answer ends with the error, so that one without it was cut off. */
_Noreturn static void behind_door(const void *bytes, size_t size, hdf5_reading *reading)
{
    image = bytes;
    wt_error said = WT_ERROR_INIT;
    FILE *const answer = fdopen(ANSWER_FD, "w");
    if (answer == NULL || setvbuf(answer, NULL, _IOFBF, ANSWER_BUFFER) != 0)
        _exit(EXIT_FAILURE);
    const hid_t file = has_signature(size) ? open_image(size) : -1;
    if (file >= 0) {
        said.status = reading(file, size, answer, &said);
    } else if (has_signature(size)) {
        said.status = wt_fail(&said, WT_E_CORRUPT, "the HDF5 file is damaged or cut off");
        wt_error_advice(&said, "make the file again");
    } else {
        said.status =
            wt_fail(&said, WT_E_FORMAT, "not an HDF5 file, or its first bytes are damaged");
    }
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
static pid_t start(int to, const void *bytes, size_t size, const hdf5_limits *limits,
                   hdf5_reading *reading)
{
    sigset_t all, before;
    hdf5_scope scope;
    const pid_t parent = getpid();
    const size_t data = data_size();
    hdf5_enter(&scope);
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = fork();
    if (child == 0) {
        if (!shut_in(to, limits, data, parent))
            _exit(EXIT_FAILURE);
        behind_door(bytes, size, reading);
    }
    const int number = errno;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    hdf5_leave(&scope);
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
static ending collect(int from, const hdf5_limits *limits, buffer *b)
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
static wt_status explain(ending how, int state, const hdf5_limits *limits, wt_error *err)
{
    const int by = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
    if (how == NO_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (how == BROKEN)
        return wt_fail(err, WT_E_IO, "cannot hear from the process that reads HDF5");
    if (how == LONG)
        (void)wt_fail(err, WT_E_CORRUPT, "the HDF5 file gives more than %zu MiB of tables",
                      limits->answer / MIB);
    else if (how == LATE || by == SIGXCPU)
        (void)wt_fail(err, WT_E_CORRUPT, "reading the HDF5 file did not end within %u s%s",
                      how == LATE ? limits->wall_time : limits->cpu_time,
                      how == LATE ? "" : " of processor time");
    else if (by == SIGINT || by == SIGTERM || by == SIGHUP)
        return wt_fail(err, WT_E_CANCELLED, "reading was interrupted");
    else
        (void)wt_fail(err, WT_E_CORRUPT, "the HDF5 library fails on this file%s%s",
                      by != 0 ? ": SIG" : "", by != 0 ? sigabbrev_np(by) : "");
    return refuse(err);
}

/* The error that the process reported, as far as it is one. */
static wt_status reported(const char *bytes, const hdf5_limits *limits, wt_error *err)
{
    wt_error said;
    memcpy(&said, bytes, sizeof said);
    if (said.status == WT_OK)
        return WT_OK;
    if (said.status == WT_E_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "reading the HDF5 file takes more than %zu MiB of memory",
                       limits->memory / MIB);
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

wt_status hdf5_door_read(const void *bytes, size_t size, const hdf5_limits *limits,
                         hdf5_reading *reading, char **answer, size_t *length, wt_error *err)
{
    int channel[2];
    buffer b = {NULL, 0, 0};
    wt_status status = WT_OK;
    if (pipe2(channel, O_CLOEXEC) != 0)
        return wt_fail(err, WT_E_IO, "no pipe for reading HDF5: %s", strerror(errno));
    const pid_t child = start(channel[1], bytes, size, limits, reading);
    const int number = errno;
    (void)close(channel[1]);
    if (child < 0) {
        status = wt_fail(err, number == ENOMEM ? WT_E_MEMORY : WT_E_IO,
                         "no process for reading HDF5: %s", strerror(number));
    } else {
        const ending how = collect(channel[0], limits, &b);
        const int state = finish(child, how != ENDED);
        if (how == ENDED && state == 0 && b.length >= sizeof(wt_error))
            status = reported(b.bytes + b.length - sizeof(wt_error), limits, err);
        else
            status = explain(how, state, limits, err);
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
