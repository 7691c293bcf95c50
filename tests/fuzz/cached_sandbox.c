/* Sandbox of the fuzz targets, in place of src/core/system/sandbox.c. One process reads many
 * files, because a new process with a sanitizer and a large corpus takes 10 ms. The last answers
 * are cached, because an HDF5 file is read several times. Both processes share the memory of the
 * request and the answer.
 *
 * The process ends at every error and after READINGS files, because libraries keep memory. A
 * signal is an error of the library: only its file fails, as in the real sandbox. The same holds
 * for a heap in which the sanitizer itself crashes, because a library is not built with it. An
 * error that the sanitizer reports in weartrack code ends the target.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <poll.h>
#include <sanitizer/asan_interface.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

/* Limit of processor time [us]. A valid seed needs 1000; in a damaged heap HDF5 may loop
 * forever. */
enum { PATIENCE = 50000, LONGEST_WAIT = 15000 /* ms */ };
enum { READINGS = 500, FOUND = 1, CANNOT = 2 }; /* exit status of the process */
#define MOST_FILE ((size_t)4 << 20)
#define MOST_ANSWER ((size_t)160 << 20)

/* Errors that the sanitizer finds within other libraries are ignored, and their allocations may
 * fail. */
const char *__asan_default_suppressions(void); // NOLINT(bugprone-reserved-identifier)
const char *__asan_default_suppressions(void)  // NOLINT(bugprone-reserved-identifier)
{
    return "interceptor_via_lib:libhdf5\n";
}

const char *__asan_default_options(void); // NOLINT(bugprone-reserved-identifier)
const char *__asan_default_options(void)  // NOLINT(bugprone-reserved-identifier)
{
    return "allocator_may_return_null=1:max_allocation_size_mb=1800:quarantine_size_mb=16:"
           "malloc_context_size=8";
}

typedef struct shared {
    sandbox_call call;
    sandbox_limits limits;
    const void *with; /* value of call.with, the only pointer that a reading gets */
    wt_error err;
    size_t length; /* length of the answer */
    unsigned char bytes[MOST_FILE];
    char answer[MOST_ANSWER];
} shared;

static shared *exchange;
static pid_t reader = -1;
static int to_reader, from_reader;
static unsigned n_readings;

struct sandbox_stream {
    const char *what;
    char *bytes;
    size_t length, at;
    wt_error err;
};

/* ---- in the sandbox process ------------------------------------------------------------------ */

static void close_hdf5(void)
{
    hid_t files[16];
    const ssize_t n = H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_FILE, 16, files);
    for (ssize_t i = 0; i < n; i++)
        (void)H5Fclose(files[i]);
}

static void read_one(void)
{
    sandbox_call call = exchange->call;
    call.bytes = exchange->bytes;
    call.with = call.with != NULL ? &exchange->with : NULL;
    exchange->err = (wt_error)WT_ERROR_INIT;
    const size_t most =
        exchange->limits.answer < MOST_ANSWER ? exchange->limits.answer : MOST_ANSWER;
    FILE *const answer = fmemopen(exchange->answer, most, "w");
    if (answer == NULL)
        _exit(CANNOT);
    exchange->err.status = call.reading(&call, answer, &exchange->err);
    const long length = fflush(answer) == 0 ? ftell(answer) : -1;
    if (length < 0) { /* longer than the limit */
        exchange->err.status = WT_E_CORRUPT;
        (void)snprintf(exchange->err.message, sizeof exchange->err.message, "more than it may");
    }
    exchange->length = length < 0 ? 0 : (size_t)length;
    (void)fclose(answer);
    close_hdf5();
}

static bool reported; /* A sanitizer reported an error in code that was built with it. */

void __ubsan_on_report(void); // NOLINT(bugprone-reserved-identifier)
void __ubsan_on_report(void)  // NOLINT(bugprone-reserved-identifier)
{
    reported = true;
}

/* A refused allocation is a warning. If a library damages the heap, its frame comes before the
 * first frame of weartrack. */
static void note_report(const char *text)
{
    const char *const library = strstr(text, "libhdf5"), *const source = strstr(text, "../../");
    const bool own = library == NULL || (source != NULL && source < library);
    reported |= own && strstr(text, "ERROR: ") != NULL;
}

static void die(void)
{
    _exit(reported ? FOUND : CANNOT);
}

static void serve_requests(int from, int to)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    const struct rlimit none = {0, 0};
    const struct itimerval patient = {.it_value = {0, PATIENCE}}, ever = {.it_value = {0, 0}};
    char word = 0;
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL);
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    (void)setrlimit(RLIMIT_CORE, &none);
    (void)H5set_free_list_limits(-1, -1, -1, -1, -1, -1); /* HDF5 reuses freed blocks. */
    __asan_set_error_report_callback(note_report);
    __sanitizer_set_death_callback(die);
    /* The callers of HDF5 also disable its messages. */
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    while (read(from, &word, 1) == 1) {
        (void)setitimer(ITIMER_PROF, &patient, NULL); /* The signal ends the process. */
        read_one();
        (void)setitimer(ITIMER_PROF, &ever, NULL);
        if (write(to, &word, 1) != 1)
            break;
    }
    _exit(EXIT_SUCCESS);
}

/* ---- in the fuzz target ---------------------------------------------------------------------- */

/* Ends the process. The target aborts if the sanitizer reported an error there. */
static void finish_reader(void)
{
    int state = 0;
    if (reader < 0)
        return;
    (void)close(to_reader);
    (void)close(from_reader);
    while (waitpid(reader, &state, 0) < 0 && errno == EINTR) {
    }
    reader = -1;
    if (WIFEXITED(state) && WEXITSTATUS(state) == FOUND)
        abort();
}

static void start_reader(void)
{
    int there[2], back[2];
    if (exchange == NULL)
        exchange =
            mmap(NULL, sizeof *exchange, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (exchange == MAP_FAILED || pipe2(there, O_CLOEXEC) != 0 || pipe2(back, O_CLOEXEC) != 0)
        abort();
    reader = fork();
    if (reader < 0)
        abort();
    if (reader == 0) {
        (void)close(there[1]);
        (void)close(back[0]);
        serve_requests(there[0], back[1]);
    }
    (void)close(there[0]);
    (void)close(back[1]);
    to_reader = there[1];
    from_reader = back[0];
    n_readings = 0;
}

sandbox_limits sandbox_limits_for(size_t size)
{
    return (sandbox_limits){.memory = (size_t)256 << 20,
                            .answer = ((size_t)16 << 20) + 8 * size,
                            .cpu_time = 10,
                            .wall_time = 15};
}

/* Returns false if the process ended or exceeded the time limit. */
static bool reading_succeeds(void)
{
    char word = 'r';
    struct pollfd ready = {.fd = from_reader, .events = POLLIN};
    if (write(to_reader, &word, 1) == 1 && poll(&ready, 1, LONGEST_WAIT) == 1 &&
        read(from_reader, &word, 1) == 1)
        return true;
    (void)kill(reader, SIGKILL); /* A process that has ended keeps its exit status. */
    return false;
}

static bool send_request(const sandbox_call *call, const sandbox_limits *limits)
{
    exchange->call = *call;
    exchange->limits = *limits;
    exchange->with = call->with != NULL ? *(const void *const *)call->with : NULL;
    return call->bytes != NULL
               ? memcpy(exchange->bytes, call->bytes, call->size) != NULL
               : pread(call->file, exchange->bytes, call->size, 0) == (ssize_t)call->size;
}

/* Cached answers of the last files, because each quantity is read from the file separately. */
typedef struct cached_answer {
    const void *reading, *with;
    unsigned char *bytes;
    size_t size;
    char *answer;
    size_t length;
    wt_error err;
} cached_answer;
static cached_answer last[4];

static const cached_answer *find_answer(const void *reading)
{
    for (size_t i = 0; i < sizeof last / sizeof *last; i++)
        if (last[i].bytes != NULL && last[i].reading == reading && last[i].with == exchange->with &&
            last[i].size == exchange->call.size &&
            memcmp(last[i].bytes, exchange->bytes, last[i].size) == 0)
            return &last[i];
    return NULL;
}

static void *duplicate_file(const void *bytes, size_t size)
{
    void *const copy = malloc(size + 1);
    if (copy == NULL)
        abort();
    return memcpy(copy, bytes, size);
}

static const cached_answer *store_answer(const void *reading, bool read_it)
{
    static size_t next;
    cached_answer *const one = &last[next++ % (sizeof last / sizeof *last)];
    free(one->bytes);
    free(one->answer);
    if (!read_it) {
        exchange->length = 0;
        exchange->err = (wt_error)WT_ERROR_INIT;
        exchange->err.status = WT_E_CORRUPT;
        (void)snprintf(exchange->err.message, sizeof exchange->err.message, "the library fails");
    }
    *one = (cached_answer){reading,
                           exchange->with,
                           duplicate_file(exchange->bytes, exchange->call.size),
                           exchange->call.size,
                           duplicate_file(exchange->answer, exchange->length),
                           exchange->length,
                           exchange->err};
    return one;
}

wt_status sandbox_start(const sandbox_call *call, const sandbox_limits *limits,
                        sandbox_stream **begun, wt_error *err)
{
    const void *reading = NULL;
    memcpy(&reading, &call->reading, sizeof reading);
    if (call->size > MOST_FILE)
        return wt_fail(err, WT_E_CORRUPT, "too long");
    if (exchange == NULL)
        start_reader();
    if (!send_request(call, limits))
        return wt_fail(err, WT_E_IO, "cannot be read");
    const cached_answer *answer = find_answer(reading);
    if (answer == NULL) {
        if (n_readings++ >= READINGS)
            finish_reader();
        if (reader < 0)
            start_reader();
        const bool read_it = reading_succeeds();
        if (!read_it)
            finish_reader();
        answer = store_answer(reading, read_it);
    }
    sandbox_stream *const stream = calloc(1, sizeof *stream);
    if (stream == NULL)
        abort();
    *stream = (sandbox_stream){call->what, duplicate_file(answer->answer, answer->length),
                               answer->length, 0, answer->err};
    *begun = stream;
    return WT_OK;
}

/* Returns the error of the reading, after all data. */
static wt_status final_status(const sandbox_stream *stream, wt_error *err)
{
    if (stream->err.status != WT_OK && err != NULL)
        *err = stream->err;
    return stream->err.status;
}

wt_status sandbox_drain(sandbox_stream *stream, sandbox_sink *sink, void *user, wt_error *err)
{
    const size_t n = stream->length - stream->at;
    const wt_status status = n > 0 ? sink(user, stream->bytes + stream->at, n, err) : WT_OK;
    stream->at = stream->length;
    return status == WT_OK ? final_status(stream, err) : status;
}

void sandbox_close(sandbox_stream *stream)
{
    if (stream == NULL)
        return;
    free(stream->bytes);
    free(stream);
}

wt_status sandbox_read(const sandbox_call *call, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err)
{
    sandbox_stream *stream = NULL;
    wt_status status = sandbox_start(call, limits, &stream, err);
    if (status == WT_OK)
        status = final_status(stream, err);
    if (status == WT_OK) {
        *answer = stream->bytes;
        *length = stream->length;
        stream->bytes = NULL;
    }
    sandbox_close(stream);
    return status;
}
