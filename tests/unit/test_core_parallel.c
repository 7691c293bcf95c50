/* Work on several threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/core.h"

#include <stdatomic.h>
#include <string.h>

enum { N = 1000, MAX_THREADS = 8 };

typedef struct scratch {
    double results[N];
    atomic_int runs[N];
    atomic_int workers_seen;
    unsigned threads;
} scratch;

static wt_status body(void *user, size_t i, unsigned worker)
{
    scratch *const s = user;
    double x = 1.0 + (double)i;
    for (int k = 0; k < 50; k++)
        x = sqrt(x + (double)k);
    s->results[i] = x;
    atomic_fetch_add(&s->runs[i], 1);
    if (worker >= s->threads)
        return WT_E_INTERNAL;
    return i == 700 ? WT_E_RANGE : i == 123 ? WT_E_CORRUPT : WT_OK;
}

static void same_result_for_any_number(void **state)
{
    (void)state;
    static scratch one;
    memset(&one, 0, sizeof one);
    one.threads = 1;
    assert_int_equal(wt_parallel_for(N, 1, body, &one, NULL, NULL), WT_E_CORRUPT);
    for (unsigned threads = 2; threads <= MAX_THREADS; threads++) {
        static scratch many;
        memset(&many, 0, sizeof many);
        many.threads = threads;
        /* Returns the error of the lowest item after all items have run. */
        assert_int_equal(wt_parallel_for(N, threads, body, &many, NULL, NULL), WT_E_CORRUPT);
        assert_memory_equal(one.results, many.results, sizeof one.results);
        for (size_t i = 0; i < N; i++)
            assert_int_equal(atomic_load(&many.runs[i]), 1);
    }
}

static wt_status nothing(void *user, size_t i, unsigned worker)
{
    (void)worker;
    atomic_int *const runs = user;
    atomic_fetch_add(runs, 1);
    return i > 5000 ? WT_E_RANGE : WT_OK;
}

typedef struct teller {
    size_t calls, last, stop_at;
    atomic_int inside;
    bool overlapped;
} teller;

static bool report_progress(void *user, const char *what, size_t done, size_t total)
{
    teller *const t = user;
    if (atomic_fetch_add(&t->inside, 1) != 0)
        t->overlapped = true;
    t->calls++;
    if (done != t->last + 1 || total != N || strcmp(what, "items") != 0)
        t->overlapped = true;
    t->last = done;
    atomic_fetch_sub(&t->inside, 1);
    return done != t->stop_at;
}

static void progress(void **state)
{
    (void)state;
    for (unsigned threads = 1; threads <= MAX_THREADS; threads++) {
        teller t = {0};
        atomic_int runs = 0;
        const wt_progress p = {report_progress, &t};
        assert_int_equal(wt_parallel_for(N, threads, nothing, &runs, &p, "items"), WT_OK);
        assert_int_equal(t.calls, N);
        assert_false(t.overlapped);
    }
}

static void cancelled(void **state)
{
    (void)state;
    for (unsigned threads = 1; threads <= MAX_THREADS; threads++) {
        teller t = {.stop_at = 10};
        atomic_int runs = 0;
        const wt_progress p = {report_progress, &t};
        assert_int_equal(wt_parallel_for(N, threads, nothing, &runs, &p, "items"), WT_E_CANCELLED);
        assert_int_equal(t.calls, 10);
        /* Started items are finished, and no new one starts. */
        assert_true((unsigned)atomic_load(&runs) <= 10 + threads);
    }
}

static void edges(void **state)
{
    (void)state;
    atomic_int runs = 0;
    const wt_progress none = {NULL, NULL};
    assert_int_equal(wt_parallel_for(0, 4, nothing, &runs, &none, "items"), WT_OK);
    assert_int_equal(atomic_load(&runs), 0);
    assert_int_equal(wt_parallel_for(3, 100000, nothing, &runs, &none, "items"), WT_OK);
    assert_int_equal(atomic_load(&runs), 3);
    assert_true(wt_thread_count(0) >= 1);
    assert_int_equal(wt_thread_count(5), 5);
}

static void times(void **state)
{
    (void)state;
    const double wall = wt_time_wall(), cpu = wt_time_cpu();
    volatile double x = 1.0;
    while (wt_time_cpu() - cpu < 0.01)
        x = sqrt(x + 1.0);
    assert_true(wt_time_wall() - wall > 0.0 && wt_time_wall() - wall < 60.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_result_for_any_number),
        cmocka_unit_test(progress),
        cmocka_unit_test(cancelled),
        cmocka_unit_test(edges),
        cmocka_unit_test(times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
