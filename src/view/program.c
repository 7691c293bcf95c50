/* Runs weartrack on a thread of its own, so that the server answers meanwhile.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/program.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct view_program {
    const char *path;
    char *folder;
    char **arguments; /* ends with NULL */
    size_t n_arguments;
    double start;
    pthread_t thread;
    bool has_thread;
    pthread_mutex_t lock; /* of the members below */
    bool running, stopped;
    size_t n_ended;
    double time;
    program_result end;
};

view_program *view_program_new(const char *path)
{
    view_program *p = wt_alloc(1, sizeof *p);
    *p = (view_program){.path = path, .lock = PTHREAD_MUTEX_INITIALIZER};
    return p;
}

static bool may_go_on(void *user)
{
    view_program *p = user;
    (void)pthread_mutex_lock(&p->lock);
    const bool stopped = p->stopped;
    (void)pthread_mutex_unlock(&p->lock);
    return !stopped;
}

static void *run_program(void *user)
{
    enum { DAY = 86400 };
    view_program *p = user;
    program_result end;
    wt_error err = WT_ERROR_INIT;
    const program_call call = {.program = p->path,
                               .arguments = (const char *const *)p->arguments,
                               .folder = p->folder,
                               .limit = DAY,
                               .go_on = may_go_on,
                               .user = p};
    if (program_run(&call, &end, &err) != WT_OK) {
        end = (program_result){.outcome = PROGRAM_NOT_STARTED};
        (void)snprintf(end.words, sizeof end.words, "%.300s", err.message);
    }
    (void)pthread_mutex_lock(&p->lock);
    p->end = end;
    p->time = wt_time_wall() - p->start;
    p->n_ended++;
    p->running = false;
    (void)pthread_mutex_unlock(&p->lock);
    return NULL;
}

static void join_thread(view_program *p)
{
    if (p->has_thread)
        (void)pthread_join(p->thread, NULL);
    p->has_thread = false;
    wt_strings_free(p->arguments, p->n_arguments);
    free(p->folder);
    p->arguments = NULL;
    p->folder = NULL;
    p->n_arguments = 0;
}

wt_status view_program_start(view_program *p, const char *folder, const char *const *arguments,
                             size_t n, wt_error *err)
{
    if (view_program_get(p).running)
        return wt_fail(err, WT_E_ARG, "another run has not ended yet");
    join_thread(p);
    p->folder = wt_strdup(folder);
    p->arguments = wt_alloc(n + 1, sizeof *p->arguments);
    for (size_t i = 0; i < n; i++)
        p->arguments[i] = wt_strdup(arguments[i]);
    p->arguments[n] = NULL;
    p->n_arguments = n;
    p->start = wt_time_wall();
    p->running = true;
    p->stopped = false;
    p->has_thread = pthread_create(&p->thread, NULL, run_program, p) == 0;
    p->running = p->has_thread;
    return p->has_thread ? WT_OK : wt_fail(err, WT_E_IO, "no thread for the run");
}

void view_program_stop(view_program *p)
{
    (void)pthread_mutex_lock(&p->lock);
    p->stopped = true;
    (void)pthread_mutex_unlock(&p->lock);
}

view_program_state view_program_get(view_program *p)
{
    (void)pthread_mutex_lock(&p->lock);
    const view_program_state state = {.running = p->running,
                                      .n_ended = p->n_ended,
                                      .time = p->running ? wt_time_wall() - p->start : p->time,
                                      .end = p->end,
                                      .arguments = (const char *const *)p->arguments,
                                      .n_arguments = p->n_arguments};
    (void)pthread_mutex_unlock(&p->lock);
    return state;
}

void view_program_free(view_program *p)
{
    if (p == NULL)
        return;
    view_program_stop(p);
    join_thread(p);
    (void)pthread_mutex_destroy(&p->lock);
    free(p);
}
