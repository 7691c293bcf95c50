/* HDF5 in its sandbox: every failure inside is an error for the caller, and the program is
 * otherwise unaffected.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "address_sanitizer.h"
#include "assert_near.h"

#include "core/store/hdf5_sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char path[] = "/tmp/weartrack-door-XXXXXX";
static unsigned char *bytes;
static size_t size;
static const sandbox_limits usual = {(size_t)64 << 20, (size_t)1 << 20, 20, 60};

static int set_up(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (fd < 0 || file < 0 || H5Fclose(file) < 0)
        return -1;
    size = (size_t)lseek(fd, 0, SEEK_END);
    bytes = malloc(size);
    return pread(fd, bytes, size, 0) == (ssize_t)size ? close(fd) : -1;
}

static int clean(void **state)
{
    (void)state;
    free(bytes);
    return unlink(path);
}

/* Reads in the sandbox; sets the error on failure. */
static wt_status pass(hdf5_read_function *reading, sandbox_limits limits, char **answer,
                      wt_error *err)
{
    size_t length = 0;
    *err = (wt_error)WT_ERROR_INIT;
    const wt_status status =
        hdf5_sandbox_read(&(hdf5_bytes){.bytes = (const unsigned char *)bytes, .size = size},
                          &limits, reading, answer, &length, err);
    if (status == WT_OK)
        (*answer)[length > 0 ? length - 1 : 0] = '\0';
    else
        assert_true(err->status == status && err->message[0] != '\0');
    assert_true(waitpid(-1, NULL, WNOHANG) < 0 && errno == ECHILD); /* no process is left */
    return status;
}

static void refused(hdf5_read_function *reading, sandbox_limits limits, wt_status expected,
                    const char *words)
{
    wt_error err;
    char *answer = NULL;
    const wt_status status = pass(reading, limits, &answer, &err);
    if (status != expected || strstr(err.message, words) == NULL)
        fail_msg("%d, \"%s\" instead of \"%s\"", (int)status, err.message, words);
    assert_null(answer);
}

/* ---- possible failures ----------------------------------------------------------------------- */

static wt_status says(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)err;
    (void)fprintf(out, "%d %d.", n == size, H5Gget_num_objs(file, &(hsize_t){0}) >= 0);
    return WT_OK;
}

static wt_status fails(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)fputs("half", out);
    const wt_status status = wt_fail(err, WT_E_UNIT, "in its own words");
    wt_error_place(err, "there");
    return status;
}

static wt_status crashes(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)err;
    (void)fputs("half", out);
    (void)fflush(out);
    (void)raise(SIGSEGV);
    return WT_OK;
}

static wt_status leaves(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)out;
    (void)err;
    _exit(0);
}

static wt_status is_interrupted(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)out;
    (void)err;
    (void)raise(SIGTERM);
    return WT_OK;
}

static wt_status spins(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)out;
    (void)err;
    for (volatile size_t i = n; i >= n; i++) {
    }
    return WT_OK;
}

static wt_status sleeps(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)out;
    (void)err;
    (void)sleep(100);
    return WT_OK;
}

static wt_status babbles(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)err;
    while (fputs("much ado", out) >= 0) {
    }
    return WT_OK;
}

static wt_status swells(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    /* The steps leave space for the report of the address sanitizer, which would wait forever
     * without it. */
    const size_t step = (size_t)24 << 20;
    for (int i = 0; i < 100; i++) {
        char *const more = malloc(step);
        if (more == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        memset(more, 1, step);
        (void)fputc(more[i], out);
    }
    return WT_OK;
}

/* Invalid status and texts. */
static wt_status lies(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)out;
    memset(err, 'x', sizeof *err);
    return (wt_status)12345;
}

static wt_status opens(hid_t file, size_t n, FILE *out, wt_error *err)
{
    (void)file;
    (void)n;
    (void)err;
    struct sigaction action;
    (void)sigaction(SIGUSR1, NULL, &action);
    const int got = open("/etc/passwd", O_RDONLY);
    const bool others = fcntl(0, F_GETFD) >= 0 || fcntl(2, F_GETFD) >= 0 || fcntl(4, F_GETFD) >= 0;
    (void)fprintf(out, "%d %d %d.", got, others, action.sa_handler == SIG_DFL);
    return WT_OK;
}

static void every_exit_is_an_error(void **state)
{
    (void)state;
    char *answer = NULL;
    wt_error err;
    assert_int_equal(pass(says, usual, &answer, &err), WT_OK);
    assert_string_equal(answer, "1 1");
    free(answer);
    answer = NULL;
    assert_int_equal(pass(fails, usual, &answer, &err), WT_E_UNIT);
    assert_string_equal(err.message, "in its own words");
    assert_string_equal(err.place, "there");
    assert_null(answer);
    refused(crashes, usual, WT_E_CORRUPT, "fails on this file: SIGSEGV");
    refused(leaves, usual, WT_E_CORRUPT, "fails on this file");
    refused(is_interrupted, usual, WT_E_CANCELLED, "interrupted");
    refused(lies, usual, WT_E_CORRUPT, "xxx");
}

static void every_limit(void **state)
{
    (void)state;
    sandbox_limits limits = usual;
    const double start = wt_time_wall();
    limits.cpu_time = 1;
    refused(spins, limits, WT_E_CORRUPT, "did not end within 1 s of processor time");
    limits = usual;
    limits.wall_time = 1;
    refused(sleeps, limits, WT_E_CORRUPT, "did not end within 1 s");
    refused(babbles, usual, WT_E_CORRUPT, "more than 1 MiB of tables");
    refused(swells, usual, WT_E_MEMORY, "more than 64 MiB of memory");
    assert_true(wt_time_wall() - start < 60.0);
}

static void not_hdf5(void **state)
{
    (void)state;
    const sandbox_limits limits = sandbox_limits_for(8);
    char *answer = NULL;
    size_t length = 0;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(
        hdf5_sandbox_read(&(hdf5_bytes){.bytes = (const unsigned char *)"no HDF5!", .size = 8},
                          &limits, says, &answer, &length, &err),
        WT_E_FORMAT);
    assert_int_equal(hdf5_sandbox_read(&(hdf5_bytes){.bytes = (const unsigned char *)"", .size = 0},
                                       &limits, says, &answer, &length, &err),
                     WT_E_FORMAT);
    assert_int_equal(
        hdf5_sandbox_read(
            &(hdf5_bytes){.bytes = (const unsigned char *)"\211HDF\r\n\032\n", .size = 8}, &limits,
            says, &answer, &length, &err),
        WT_E_CORRUPT);
}

/* ---- effects on the program ------------------------------------------------------------------ */

static volatile sig_atomic_t handled;

static void handle(int number)
{
    (void)number;
    handled++;
}

static void take_all(int number)
{
    (void)number;
    while (waitpid(-1, NULL, WNOHANG) > 0)
        handled++;
}

static void callers_children_are_unaffected(void **state)
{
    (void)state;
    char *answer = NULL;
    wt_error err;
    struct sigaction action = {.sa_handler = handle}, before;
    assert_int_equal(sigaction(SIGUSR1, &action, NULL), 0);
    const int secret = open("/etc/passwd", O_RDONLY | O_CLOEXEC);
    assert_int_equal(pass(opens, usual, &answer, &err), WT_OK);
    assert_string_equal(answer, "-1 0 1");
    free(answer);
    (void)close(secret);
    /* A program that ignores its children, or waits for all of them. */
    for (int i = 0; i < 2; i++) {
        action.sa_handler = i == 0 ? SIG_IGN : take_all;
        assert_int_equal(sigaction(SIGCHLD, &action, &before), 0);
        assert_int_equal(pass(says, usual, &answer, &err), WT_OK);
        free(answer);
        answer = NULL;
        refused(crashes, usual, WT_E_CORRUPT, "fails on this file");
        struct sigaction after;
        assert_int_equal(sigaction(SIGCHLD, &before, &after), 0);
        assert_true(after.sa_handler == action.sa_handler);
    }
}

/* Other threads allocate and print meanwhile. */
static volatile bool busy = true;

static void *work(void *unused)
{
    while (busy) {
        char *text = NULL;
        size_t n = 0;
        FILE *const out = open_memstream(&text, &n);
        (void)fprintf(out, "%g", 0.1);
        (void)fclose(out);
        free(text);
    }
    return unused;
}

static void *read_often(void *failures)
{
    for (int i = 0; i < 40; i++) {
        char *answer = NULL;
        size_t length = 0;
        if (hdf5_sandbox_read(&(hdf5_bytes){.bytes = (const unsigned char *)bytes, .size = size},
                              &usual, says, &answer, &length, NULL) != WT_OK)
            ++*(int *)failures;
        free(answer);
    }
    return NULL;
}

static void with_threads(void **state)
{
    (void)state;
    enum { READERS = 3 };
    /* another thread may have locked its allocator at the fork, which blocks the child */
    if (WITH_ADDRESS_SANITIZER)
        skip();
    pthread_t worker, readers[READERS];
    int failures[READERS] = {0};
    assert_int_equal(pthread_create(&worker, NULL, work, NULL), 0);
    for (int i = 0; i < READERS; i++)
        assert_int_equal(pthread_create(&readers[i], NULL, read_often, &failures[i]), 0);
    for (int i = 0; i < READERS; i++) {
        assert_int_equal(pthread_join(readers[i], NULL), 0);
        assert_int_equal(failures[i], 0);
    }
    busy = false;
    assert_int_equal(pthread_join(worker, NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_exit_is_an_error),
        cmocka_unit_test(every_limit),
        cmocka_unit_test(not_hdf5),
        cmocka_unit_test(callers_children_are_unaffected),
        cmocka_unit_test(with_threads),
    };
    return cmocka_run_group_tests_name("hdf5 door", tests, set_up, clean);
}
