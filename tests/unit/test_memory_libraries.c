/* Exhausted memory inside a library: UDUNITS, libxml2, the C library. The functions below count
 * every allocation of the process, and each one fails once, in its own process. There must be an
 * error, or the same result. UDUNITS and libxml2 may crash or exit, which no library can prevent
 * (the command can, see src/cmd/malloc_abort.c), but no wrong result is permitted.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "address_sanitizer.h"
#include "assert_near.h"
#include "weartrack/read.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- allocations ----------------------------------------------------------------------------- */

/* Other names of the functions in the C library. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *old, size_t size);

static size_t count, failing; /* 0 = none */

#if !WITH_ADDRESS_SANITIZER
static bool fails(void)
{
    if (++count != failing)
        return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    return fails() ? NULL : __libc_calloc(n, size);
}

void *realloc(void *old, size_t size)
{
    return fails() ? NULL : __libc_realloc(old, size);
}
#endif

/* ---- a job under failing memory -------------------------------------------------------------- */

/* Runs the job and compares its output with the right one. */
typedef wt_status job(bool *right, wt_error *err);

/* Unique exit statuses. */
enum { SAME = 90, SAID, OTHER_ERROR, OTHER_RESULT };

/* The library calls it if a small allocation fails. */
static void end_without_memory(size_t size)
{
    (void)size;
    _exit(SAID);
}

/* Runs the job in its own process; `n` receives the number of allocations. Otherwise describes its
 * end. */
static int run(job *j, size_t number, size_t *n)
{
    int channel[2], state = 0;
    assert_int_equal(pipe(channel), 0);
    const pid_t child = fork();
    if (child == 0) {
        bool right = false;
        wt_error err = WT_ERROR_INIT;
        for (int i = 1; i < NSIG; i++)
            (void)signal(i, SIG_DFL); /* cmocka goes on with the next test */
        alarm(10);
        close(STDERR_FILENO); /* assertions of a library */
        wt_memory_set_handler(end_without_memory);
        count = 0;
        failing = number;
        const wt_status status = j(&right, &err);
        failing = 0;
        if (write(channel[1], &count, sizeof count) != (ssize_t)sizeof count)
            _exit(OTHER_RESULT);
        if (status != WT_OK)
            _exit(status == WT_E_MEMORY ? SAID : OTHER_ERROR);
        _exit(right ? SAME : OTHER_RESULT);
    }
    close(channel[1]);
    size_t counted = 0;
    if (read(channel[0], &counted, sizeof counted) == (ssize_t)sizeof counted && n != NULL)
        *n = counted;
    close(channel[0]);
    assert_int_equal(waitpid(child, &state, 0), child);
    return WIFSIGNALED(state) ? -WTERMSIG(state) : WEXITSTATUS(state);
}

static void check_job(const char *name, job *j, size_t every, int worst)
{
    size_t n = 0, done = 0, said = 0, crashed = 0, wrong = 0;
    assert_int_equal(run(j, 0, &n), SAME);
    for (size_t i = 1; i <= n; i += every, done++) {
        const int end = run(j, i, NULL);
        said += end == SAID;
        crashed += end < SAME; /* UDUNITS also calls exit() */
        if (end > worst) {
            print_error("%s: allocation %zu fails: %s\n", name, i,
                        end == OTHER_ERROR ? "another error" : "another result");
            wrong++;
        }
    }
    print_message("%s: %zu of %zu allocations failed, %zu said so, %zu crashes of others\n", name,
                  done, n, said, crashed);
    assert_true(said > 0);
    assert_int_equal(wrong, 0);
}

/* ---- jobs ------------------------------------------------------------------------------------ */

static wt_formats *formats;

/* The first unit of the process that is not in the table: the database is read. */
static wt_status first_unit(bool *right, wt_error *err)
{
    double factor = 0, offset = 0, spelt = 0;
    wt_status status = wt_unit_to_si("(nm)", WT_Q_LENGTH, &factor, &offset, err);
    if (status == WT_OK)
        status = wt_unit_to_si("(deg)", WT_Q_ANGLE, &spelt, &offset, err);
    *right = fabs(factor - 1e-9) < 1e-24 && fabs(spelt - 0.0174532925199432957) < 1e-16;
    return status;
}

static wt_status sweep(bool *right, wt_error *err)
{
    static const char text[] = "f,E_stor,E_loss,T\nHz,MPa,kPa,C\n1,10,1000,20\n2,11,1100,20\n"
                               "4,12,1200,20\n";
    wt_input *input = NULL;
    wt_sweep s = {.n_isotherms = 0};
    wt_status status = wt_input_open_memory(text, sizeof text - 1, "text", &input, err);
    if (status == WT_OK)
        status = wt_sweep_read(formats, input, NULL, NULL, &s, err);
    if (status == WT_OK)
        *right = s.n_isotherms == 1 && s.isotherms[0].n == 3 &&
                 fabs(s.isotherms[0].storage_modulus[1] - 11e6) < 1e-3 &&
                 fabs(s.isotherms[0].loss_modulus[2] - 1.2e6) < 1e-4 &&
                 fabs(s.isotherms[0].temperature - 293.15) < 1e-9;
    wt_sweep_clear(&s);
    wt_input_close(input);
    return status;
}

static wt_status description(bool *right, wt_error *err)
{
    wt_formats *made = NULL;
    const wt_status status = wt_formats_new(NULL, &made, NULL, err);
    *right = status == WT_OK && wt_formats_count(made) == wt_formats_count(formats);
    wt_formats_free(made);
    return status;
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void test_units(void **state)
{
    (void)state;
    check_job("units", first_unit, 53, SAID);
}

static void test_sweep(void **state)
{
    (void)state;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    check_job("sweep", sweep, 1, SAID);
    /* libxml2 may silently omit a value from the schema, which the document then violates. */
    check_job("descriptions", description, 13, OTHER_ERROR);
    wt_formats_free(formats);
}

int main(void)
{
    if (WITH_ADDRESS_SANITIZER) /* it replaces the allocations of the process */
        return 77;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_units), cmocka_unit_test(test_sweep)};
    return cmocka_run_group_tests_name("memory of others", tests, NULL, NULL);
}
