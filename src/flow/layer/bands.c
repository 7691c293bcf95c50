/* The table of the modified bands: upper and lower edge of the modified rubber in time, through the
 * loads that follow one another. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/layer/layer_energy.h"
#include "flow/layer/layer_loads.h"
#include "flow/work/cost.h"

#include "base/clocale.h"
#include "base/quantity.h"
#include "data/tables/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Times of a load that another one follows, from this part of it on, in equal ratios. */
enum { TIMES_OF_LOAD = 20 };
static const double first_part = 1e-3;
/* Events that are told, and what the words of a load and of an event need at most. */
enum { MOST_EVENTS = 12, LOAD_WORDS = 192, EVENT_WORDS = 96 };

typedef struct bands_task {
    const wt_sliding *sliding;
    wt_layer_job job; /* calibrated */
    const wt_job *work;
    size_t n;
    layer_energy *energy;  /* [n] */
    wt_layer_stage *stage; /* [n] */
    double *time;          /* [n_times] */
    size_t n_times;
    char *loads; /* [(n + 1) LOAD_WORDS] */
    char events[(MOST_EVENTS + 1) * EVENT_WORDS];
} bands_task;

TABLE_ROW(layer_bands, LAYER_BANDS, double time, load, worn, band; wt_estimate upper, lower;)
TABLE_KEYS(layer_bands, LAYER_BANDS, const char *loads, *events, *method;)

/* ---- loads ----------------------------------------------------------------------------------- */

static void say_load(bands_task *task, const layer_load *load)
{
    const wt_layer_parameters *p = &task->stage[task->n].parameters;
    const size_t used = strlen(task->loads), size = (task->n + 1) * LOAD_WORDS;
    char lasts[48] = "for ever", warm[32] = "";
    if (!isnan(load->temperature))
        clocale_print(warm, sizeof warm, ", %.1f degC", load->temperature - WT_ZERO_CELSIUS);
    if (!isnan(load->time))
        clocale_print(lasts, sizeof lasts, "%.4g s", load->time);
    clocale_print(task->loads + used, size - used,
                  "%s%s at %.4g MPa, %.4g mm/s, k = %.3g mm^3/(N m)%s", used > 0 ? "; then " : "",
                  lasts, 1e-6 * p->pressure, 1e3 * p->velocity, 1e9 * p->specific_wear_rate, warm);
}

static wt_status add_load(bands_task *task, const layer_load *load, wt_error *err)
{
    const layer_spot spot = {load->pressure, load->velocity, load->temperature, {0, 1}};
    layer_energy *energy = &task->energy[task->n];
    wt_layer_stage *stage = &task->stage[task->n];
    const wt_status status =
        layer_at(task->sliding, &task->job, task->work, spot, energy, &stage->parameters, err);
    if (status != WT_OK)
        return status;
    if (!isnan(load->specific_wear_rate))
        stage->parameters.specific_wear_rate = load->specific_wear_rate;
    stage->parameters.incubation = true;
    stage->source = &energy->source;
    stage->duration = isnan(load->time) ? 0 : load->time;
    say_load(task, load);
    task->n++;
    return WT_OK;
}

static wt_status take_loads(bands_task *task, wt_error *err)
{
    const size_t n = task->job.n_loads;
    const double unset = (double)NAN;
    const layer_load only = {unset, unset, unset, unset, unset};
    task->energy = calloc(n + 1, sizeof *task->energy);
    task->stage = calloc(n + 1, sizeof *task->stage);
    task->loads = calloc(n + 1, LOAD_WORDS);
    if (task->energy == NULL || task->stage == NULL || task->loads == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = n == 0 ? add_load(task, &only, err) : WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        layer_load load;
        status = layer_load_parse(&task->job, i, &load, err);
        if (status == WT_OK)
            status = add_load(task, &load, err);
    }
    return status;
}

/* ---- times ----------------------------------------------------------------------------------- */

/* Those of the job, else of every load its own and of the last as long as it changes anything. */
static wt_status take_times(bands_task *task, wt_error *err)
{
    const wt_layer_stage *last = &task->stage[task->n - 1];
    wt_layer_balance balance;
    double *of_last = NULL, begin = 0;
    size_t n = 0;
    wt_status status = wt_layer_balance_compute(last->source, &last->parameters, &balance, err);
    if (status == WT_OK)
        status = layer_times_choose(&task->job, &balance, &of_last, &n, err);
    if (status != WT_OK)
        return status;
    const bool chosen = task->job.time == NULL;
    task->time = malloc((n + task->n * TIMES_OF_LOAD) * sizeof *task->time);
    if (task->time == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && chosen && i + 1 < task->n; i++) {
        for (size_t k = 0; k < TIMES_OF_LOAD; k++)
            task->time[task->n_times++] =
                begin + task->stage[i].duration *
                            pow(first_part, 1 - (double)k / (double)(TIMES_OF_LOAD - 1));
        begin += task->stage[i].duration;
    }
    for (size_t i = 0; status == WT_OK && i < n; i++)
        task->time[task->n_times++] = begin + of_last[i];
    free(of_last);
    return status;
}

/* ---- what happens ---------------------------------------------------------------------------- */

static void say_event(const wt_layer_event *e, char *text, size_t size)
{
    static const char *const words[] = {"a band opens below the surface", "the surface is modified",
                                        "a band reaches the surface", "two bands merge"};
    const size_t used = strlen(text);
    const bool deep = e->depth > 0;
    clocale_print(text + used, size - used, "%s%s at %.4g s", used > 0 ? "; " : "", words[e->kind],
                  e->time);
    if (deep)
        clocale_print(text + strlen(text), size - strlen(text), ", %.4g um deep", 1e6 * e->depth);
}

static wt_status find_events(bands_task *task, wt_error *err)
{
    wt_layer_event events[MOST_EVENTS];
    size_t n = 0;
    if (task->n > 1)
        return WT_OK;
    const wt_status status = wt_layer_events(task->stage->source, &task->stage->parameters, events,
                                             MOST_EVENTS, &n, err);
    for (size_t i = 0; status == WT_OK && i < n && i < MOST_EVENTS; i++)
        say_event(&events[i], task->events, sizeof task->events);
    const size_t used = strlen(task->events);
    if (status == WT_OK && n > MOST_EVENTS)
        snprintf(task->events + used, sizeof task->events - used, "; and %zu more",
                 n - MOST_EVENTS);
    if (status == WT_OK && n == 0)
        snprintf(task->events, sizeof task->events, "nothing is ever modified");
    return status;
}

/* ---- the table ------------------------------------------------------------------------------- */

static double load_at(const bands_task *task, double time)
{
    size_t i = 0;
    for (double end = 0; i + 1 < task->n; i++) {
        end += task->stage[i].duration;
        if (time < end)
            break;
    }
    return (double)(i + 1);
}

static void add_section(const bands_task *task, const wt_layer_section *s, table_writer *t)
{
    const wt_estimate none = {(double)NAN, (double)NAN, (double)NAN, NULL};
    const double load = load_at(task, s->time);
    if (s->n == 0)
        TABLE_ADD(layer_bands, t, s->time, load, s->worn, 0, none, none);
    for (size_t i = 0; i < s->n && i < WT_LAYER_BANDS; i++)
        TABLE_ADD(layer_bands, t, s->time, load, s->worn, (double)(i + 1), s->band[i].upper,
                  s->band[i].lower);
}

static wt_status make_table(const bands_task *task, wt_table **table, wt_error *err)
{
    wt_layer_section *sections = malloc((task->n_times + 1) * sizeof *sections);
    if (sections == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status =
        wt_layer_sections(task->stage, task->n, task->time, task->n_times, sections, err);
    if (status == WT_OK) {
        table_writer t = table_begin(&layer_bands_schema, err);
        for (size_t i = 0; i < task->n_times; i++)
            add_section(task, &sections[i], &t);
        TABLE_SET(layer_bands, &t, task->loads, task->events[0] != '\0' ? task->events : NULL,
                  "exact transport of damage (derived); an observed layer at the start is worn "
                  "from the top");
        status = table_end(&t, table);
    }
    free(sections);
    return status;
}

wt_status wt_layer_bands_make(const wt_sliding *sliding, const wt_layer_job *job,
                              const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no bands of a layer to make");
    bands_task task = {.sliding = sliding, .work = work};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status == WT_OK)
        status = layer_job_calibrated(sliding, job, work, &task.job, err);
    if (status == WT_OK)
        status = take_loads(&task, err);
    if (status == WT_OK)
        status = take_times(&task, err);
    if (status == WT_OK)
        status = find_events(&task, err);
    if (status == WT_OK)
        status = make_table(&task, table, err);
    cost_say(work,
             (cost_summary){.items = (double)task.n_times, .tolerance_asked = work->tolerance});
    for (size_t i = 0; i < task.n; i++)
        layer_energy_clear(&task.energy[i]);
    free(task.energy);
    free(task.stage);
    free(task.loads);
    free(task.time);
    return status;
}
