/* The doors of a fuzz target (core/system/sandbox.h), in the place of src/core/system/sandbox.c:
 * one process for many files, because a new one of a program with a sanitizer and a large corpus
 * takes 10 ms, and a file of HDF5 is read several times: the last answers are kept. What it is told
 * lies in memory that both share.
 *
 * It ends with every fault, or after READINGS files, for libraries keep what they open. A signal is
 * a fault of the library: no more than its file fails, as behind the real door; so is a heap in
 * which the sanitizer itself is lost, for a library is not built with it. What the sanitizer
 * reports there, in the code of weartrack, ends the target. SPDX-License-Identifier:
 * GPL-3.0-or-later
 */
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

/* PATIENCE [us] of processor time: a sound seed takes a thousand, and in a damaged heap HDF5
 * looks for ever. */
enum { PATIENCE = 50000, LONGEST_WAIT = 15000 /* ms */ };
enum { READINGS = 500, FOUND = 1, CANNOT = 2 }; /* FOUND: the status of a sanitizer */
#define MOST_FILE ((size_t)4 << 20)
#define MOST_ANSWER ((size_t)160 << 20)

/* Errors that the sanitizer finds within other libraries are theirs, and what a file has them ask
 * for they may be refused. */
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
    sandbox_call door;
    sandbox_limits limits;
    const void *with; /* what door.with points to; all that any reading is given */
    wt_error said;
    size_t length; /* of the answer */
    unsigned char bytes[MOST_FILE];
    char answer[MOST_ANSWER];
} shared;

static shared *between;
static pid_t reader = -1;
static int ask, hear;
static unsigned done;

struct sandbox_stream {
    const char *what;
    char *bytes;
    size_t length, at;
    wt_error said;
};

/* ---- behind the door ------------------------------------------------------------------------- */

static void close_hdf5(void)
{
    hid_t files[16];
    const ssize_t n = H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_FILE, 16, files);
    for (ssize_t i = 0; i < n; i++)
        (void)H5Fclose(files[i]);
}

static void read_one(void)
{
    sandbox_call door = between->door;
    door.bytes = between->bytes;
    door.with = door.with != NULL ? &between->with : NULL;
    between->said = (wt_error)WT_ERROR_INIT;
    const size_t most = between->limits.answer < MOST_ANSWER ? between->limits.answer : MOST_ANSWER;
    FILE *const answer = fmemopen(between->answer, most, "w");
    if (answer == NULL)
        _exit(CANNOT);
    between->said.status = door.reading(&door, answer, &between->said);
    const long length = fflush(answer) == 0 ? ftell(answer) : -1;
    if (length < 0) { /* more than it may say */
        between->said.status = WT_E_CORRUPT;
        (void)snprintf(between->said.message, sizeof between->said.message, "more than it may");
    }
    between->length = length < 0 ? 0 : (size_t)length;
    (void)fclose(answer);
    close_hdf5();
}

static bool reported; /* by a sanitizer, of code that was built with it */

void __ubsan_on_report(void); // NOLINT(bugprone-reserved-identifier)
void __ubsan_on_report(void)  // NOLINT(bugprone-reserved-identifier)
{
    reported = true;
}

/* Memory that is refused is a warning. What a library does to the heap by its own calls shows a
 * frame of it before any of the sources. */
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

static void stay(int from, int to)
{
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    const struct rlimit none = {0, 0};
    const struct itimerval patient = {.it_value = {0, PATIENCE}}, ever = {.it_value = {0, 0}};
    char word = 0;
    for (int i = 1; i < NSIG; i++)
        (void)sigaction(i, &usual, NULL);
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    (void)setrlimit(RLIMIT_CORE, &none);
    (void)H5set_free_list_limits(-1, -1, -1, -1, -1, -1); /* its blocks are used again */
    __asan_set_error_report_callback(note_report);
    __sanitizer_set_death_callback(die);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* as who enters HDF5 has it */
    while (read(from, &word, 1) == 1) {
        (void)setitimer(ITIMER_PROF, &patient, NULL); /* its signal is the end */
        read_one();
        (void)setitimer(ITIMER_PROF, &ever, NULL);
        if (write(to, &word, 1) != 1)
            break;
    }
    _exit(EXIT_SUCCESS);
}

/* ---- in front of it -------------------------------------------------------------------------- */

/* Ends the reader; what the sanitizer found in it ends the target. */
static void finish_reader(void)
{
    int state = 0;
    if (reader < 0)
        return;
    (void)close(ask);
    (void)close(hear);
    while (waitpid(reader, &state, 0) < 0 && errno == EINTR) {
    }
    reader = -1;
    if (WIFEXITED(state) && WEXITSTATUS(state) == FOUND)
        abort();
}

static void start_reader(void)
{
    int there[2], back[2];
    if (between == NULL)
        between =
            mmap(NULL, sizeof *between, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (between == MAP_FAILED || pipe2(there, O_CLOEXEC) != 0 || pipe2(back, O_CLOEXEC) != 0)
        abort();
    reader = fork();
    if (reader < 0)
        abort();
    if (reader == 0) {
        (void)close(there[1]);
        (void)close(back[0]);
        stay(there[0], back[1]);
    }
    (void)close(there[0]);
    (void)close(back[1]);
    ask = there[1];
    hear = back[0];
    done = 0;
}

sandbox_limits sandbox_limits_for(size_t size)
{
    return (sandbox_limits){.memory = (size_t)256 << 20,
                            .answer = ((size_t)16 << 20) + 8 * size,
                            .cpu_time = 10,
                            .wall_time = 15};
}

/* False if it ended or took too long. */
static bool have_read(void)
{
    char word = 'r';
    struct pollfd ready = {.fd = hear, .events = POLLIN};
    if (write(ask, &word, 1) == 1 && poll(&ready, 1, LONGEST_WAIT) == 1 &&
        read(hear, &word, 1) == 1)
        return true;
    (void)kill(reader, SIGKILL); /* of one that has ended its status stays */
    return false;
}

static bool give(const sandbox_call *door, const sandbox_limits *limits)
{
    between->door = *door;
    between->limits = *limits;
    between->with = door->with != NULL ? *(const void *const *)door->with : NULL;
    return door->bytes != NULL
               ? memcpy(between->bytes, door->bytes, door->size) != NULL
               : pread(door->file, between->bytes, door->size, 0) == (ssize_t)door->size;
}

/* What the last files gave, for one is read for each thing that is asked of it. */
typedef struct answered {
    const void *reading, *with;
    unsigned char *bytes;
    size_t size;
    char *answer;
    size_t length;
    wt_error said;
} answered;
static answered last[4];

static const answered *find_answer(const void *reading)
{
    for (size_t i = 0; i < sizeof last / sizeof *last; i++)
        if (last[i].bytes != NULL && last[i].reading == reading && last[i].with == between->with &&
            last[i].size == between->door.size &&
            memcmp(last[i].bytes, between->bytes, last[i].size) == 0)
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

static const answered *keep_answer(const void *reading, bool read_it)
{
    static size_t next;
    answered *const one = &last[next++ % (sizeof last / sizeof *last)];
    free(one->bytes);
    free(one->answer);
    if (!read_it) {
        between->length = 0;
        between->said = (wt_error)WT_ERROR_INIT;
        between->said.status = WT_E_CORRUPT;
        (void)snprintf(between->said.message, sizeof between->said.message, "the library fails");
    }
    *one = (answered){reading,
                      between->with,
                      duplicate_file(between->bytes, between->door.size),
                      between->door.size,
                      duplicate_file(between->answer, between->length),
                      between->length,
                      between->said};
    return one;
}

wt_status sandbox_start(const sandbox_call *door, const sandbox_limits *limits,
                        sandbox_stream **begun, wt_error *err)
{
    const void *reading = NULL;
    memcpy(&reading, &door->reading, sizeof reading);
    if (door->size > MOST_FILE)
        return wt_fail(err, WT_E_CORRUPT, "too long");
    if (between == NULL)
        start_reader();
    if (!give(door, limits))
        return wt_fail(err, WT_E_IO, "cannot be read");
    const answered *answer = find_answer(reading);
    if (answer == NULL) {
        if (done++ >= READINGS)
            finish_reader();
        if (reader < 0)
            start_reader();
        const bool read_it = have_read();
        if (!read_it)
            finish_reader();
        answer = keep_answer(reading, read_it);
    }
    sandbox_stream *const flow = calloc(1, sizeof *flow);
    if (flow == NULL)
        abort();
    *flow = (sandbox_stream){door->what, duplicate_file(answer->answer, answer->length),
                             answer->length, 0, answer->said};
    *begun = flow;
    return WT_OK;
}

/* As the error was said, once all is taken. */
static wt_status end_of(const sandbox_stream *flow, wt_error *err)
{
    if (flow->said.status != WT_OK && err != NULL)
        *err = flow->said;
    return flow->said.status;
}

wt_status sandbox_receive(sandbox_stream *flow, void *to, size_t n, wt_error *err)
{
    if (n > flow->length - flow->at) {
        const wt_status status = end_of(flow, err);
        return status != WT_OK ? status : wt_fail(err, WT_E_CORRUPT, "less than it says");
    }
    memcpy(to, flow->bytes + flow->at, n);
    flow->at += n;
    return WT_OK;
}

wt_status sandbox_drain(sandbox_stream *flow, sandbox_sink *sink, void *user, wt_error *err)
{
    const size_t n = flow->length - flow->at;
    const wt_status status = n > 0 ? sink(user, flow->bytes + flow->at, n, err) : WT_OK;
    flow->at = flow->length;
    return status == WT_OK ? end_of(flow, err) : status;
}

wt_status sandbox_finish(sandbox_stream *flow, wt_error *err)
{
    const wt_status status = end_of(flow, err);
    return status == WT_OK && flow->at < flow->length
               ? wt_fail(err, WT_E_CORRUPT, "more than it says")
               : status;
}

void sandbox_close(sandbox_stream *flow)
{
    if (flow == NULL)
        return;
    free(flow->bytes);
    free(flow);
}

wt_status sandbox_read(const sandbox_call *door, const sandbox_limits *limits, char **answer,
                       size_t *length, wt_error *err)
{
    sandbox_stream *flow = NULL;
    wt_status status = sandbox_start(door, limits, &flow, err);
    if (status == WT_OK)
        status = end_of(flow, err);
    if (status == WT_OK) {
        *answer = flow->bytes;
        *length = flow->length;
        flow->bytes = NULL;
    }
    sandbox_close(flow);
    return status;
}
