/* Exhausted memory: the handler is called at every small allocation that fails, and a size that
 * only a file states is refused. The linker puts the functions here before those of the C library
 * (see CMakeLists.txt).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "core/base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { HANDLED = 90, DONE, WRONG };

static size_t count, failing; /* number of the failing allocation, from 1; 0 = none */

void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *old, size_t size);

void *__wrap_calloc(size_t n, size_t size)
{
    return ++count == failing ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return ++count == failing ? NULL : __real_realloc(old, size);
}

static void exit_handled(size_t size)
{
    _exit(size > 0 ? HANDLED : WRONG);
}

/* Creates a result of one table, with a log and a provenance. */
static bool make_result(void)
{
    char *const arguments[] = {(char *)(uintptr_t) "weartrack", (char *)(uintptr_t) "indent"};
    const wt_provenance_input input = {
        .path = "curve.txt", .role = WT_ROLE_GROUP, .group = "force", .format = "tidy"};
    double *values = NULL;
    size_t n = 0;
    wt_log *const log = wt_log_new();
    wt_result *const result = wt_result_new();
    wt_table *const table = wt_table_new("energy_density", "Energy density");
    wt_log_add(log, WT_WARNING, "curve.txt", NULL, "a remark");
    bool good = wt_list_parse("1mm/s,1cm/s,0.3m/s", WT_Q_VELOCITY, &values, &n, NULL) == WT_OK &&
                wt_table_add_column(table, "velocity", "m/s", "velocity", NULL) == WT_OK &&
                wt_table_add_text_column(table, "verdict", "verdict", NULL) == WT_OK &&
                wt_table_set_key(table, "sample", "A", NULL) == WT_OK;
    for (size_t i = 0; good && i < n; i++) {
        good = wt_table_add_row(table, NULL) == WT_OK;
        wt_table_set_text(table, 1, i == 0 ? "good" : "poor");
        wt_table_set_number(table, 0, values[i]);
    }
    wt_provenance *const provenance = wt_result_provenance(result);
    wt_provenance_set_command(provenance, 2, arguments);
    wt_provenance_add_input(provenance, &input);
    good = good && wt_result_add(result, table, NULL) == WT_OK && wt_log_count(log) == 1;
    free(values);
    wt_log_free(log);
    wt_result_free(result);
    return good;
}

/* Returns the exit status of a child process in which one allocation fails. */
static int run_with_failure(size_t number)
{
    int state = 0;
    const pid_t child = fork();
    if (child == 0) {
        (void)wt_memory_set_handler(exit_handled);
        count = 0;
        failing = number;
        _exit(make_result() ? DONE : WRONG);
    }
    assert_int_equal(waitpid(child, &state, 0), child);
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

static void test_handler_is_called(void **state)
{
    (void)state;
    count = failing = 0;
    assert_true(make_result());
    const size_t n = count;
    assert_true(n > 20);
    for (size_t i = 1; i <= n; i++)
        assert_int_equal(run_with_failure(i), HANDLED);
    assert_int_equal(run_with_failure(0), DONE);
}

static void test_handler_is_set(void **state)
{
    (void)state;
    wt_memory_handler *const before = wt_memory_set_handler(exit_handled);
    assert_ptr_equal(wt_memory_set_handler(before), exit_handled);
}

static void test_stated_size(void **state)
{
    (void)state;
    assert_null(try_alloc(SIZE_MAX / 2, 1));
    assert_null(try_alloc(SIZE_MAX / 2, 8)); /* the product overflows */
    char *const bytes = try_alloc(4, 2);
    assert_non_null(bytes);
    for (size_t i = 0; i < 8; i++)
        assert_int_equal(bytes[i], 0);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_handler_is_called),
        cmocka_unit_test(test_handler_is_set),
        cmocka_unit_test(test_stated_size),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
