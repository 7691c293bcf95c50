/* Processes independent items on several threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static double clock_seconds(clockid_t clock)
{
    struct timespec t = {0, 0};
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double wt_time_wall(void)
{
    return clock_seconds(CLOCK_MONOTONIC);
}

double wt_time_cpu(void)
{
    return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

typedef struct parallel_job {
    size_t n;
    wt_parallel_fn body;
    void *user;
    const wt_progress *progress;
    const char *what;
    atomic_size_t next;
    atomic_bool cancelled;
    pthread_mutex_t lock; /* protects the members below and serialises progress reports */
    size_t done;
    size_t first_failed; /* n if none failed */
    wt_status status;
} parallel_job;

typedef struct worker {
    parallel_job *parallel_job;
    unsigned number;
    pthread_t thread;
} worker;

static void *worker_main(void *argument)
{
    const worker *const w = argument;
    parallel_job *const j = w->parallel_job;
    while (!atomic_load(&j->cancelled)) {
        const size_t i = atomic_fetch_add(&j->next, 1);
        if (i >= j->n)
            break;
        const wt_status status = j->body(j->user, i, w->number);
        const bool failed = status != WT_OK;
        const bool reports = j->progress != NULL && j->progress->report != NULL;
        if (!failed && !reports)
            continue;
        (void)pthread_mutex_lock(&j->lock);
        if (failed && i < j->first_failed) {
            j->first_failed = i;
            j->status = status;
        }
        j->done++;
        if (reports && !atomic_load(&j->cancelled) &&
            !j->progress->report(j->progress->user, j->what, j->done, j->n))
            atomic_store(&j->cancelled, true);
        (void)pthread_mutex_unlock(&j->lock);
    }
    return NULL;
}

unsigned wt_thread_count(unsigned threads)
{
    if (threads > 0)
        return threads;
    cpu_set_t set; /* processors that this process may use, not all of the machine */
    if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0)
        return (unsigned)CPU_COUNT(&set);
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (unsigned)online : 1;
}

wt_status wt_parallel_for(size_t n, unsigned threads, wt_parallel_fn body, void *user,
                          const wt_progress *progress, const char *what)
{
    parallel_job j = {.n = n,
                      .body = body,
                      .user = user,
                      .progress = progress,
                      .what = what,
                      .lock = PTHREAD_MUTEX_INITIALIZER,
                      .first_failed = n,
                      .status = WT_OK};
    worker self = {.parallel_job = &j, .number = 0};
    size_t n_threads = wt_thread_count(threads);
    if (n_threads > n)
        n_threads = n;
    /* If a thread cannot be created, the other threads do its work. */
    worker *const helpers = n_threads > 1 ? wt_alloc(n_threads - 1, sizeof *helpers) : NULL;
    size_t started = 0;
    while (n_threads > 1 && started < n_threads - 1) {
        worker *const w = &helpers[started];
        w->parallel_job = &j;
        w->number = (unsigned)started + 1;
        if (pthread_create(&w->thread, NULL, worker_main, w) != 0)
            break;
        started++;
    }
    (void)worker_main(&self);
    for (size_t i = 0; i < started; i++)
        (void)pthread_join(helpers[i].thread, NULL);
    free(helpers);
    (void)pthread_mutex_destroy(&j.lock);
    return atomic_load(&j.cancelled) ? WT_E_CANCELLED : j.status;
}
