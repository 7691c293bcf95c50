/* Table of the modified bands: upper and lower edge of the modified rubber against time, through
 * successive loads, for the stated values and, for the standard errors, by replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"
#include "job/random_draws.h"
#include "layer/layer_energy.h"
#include "layer/monte_carlo.h"

#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of times of a load that precedes or follows another one. They have equal ratios and begin
 * at this share of its duration; for the last load, at this share of the time before it. */
enum { TIMES_OF_LOAD = 20 };
static const double first_part = 1e-3;
/* Largest number of events in the text, and text sizes of a load and of an event. */
enum { MAX_EVENTS = 12, LOAD_TEXT_SIZE = 192, EVENT_TEXT_SIZE = 96 };

/* Loads for one set of values. */
typedef struct loads {
    size_t n;
    layer_energy *energy; /* [n] */
    wt_layer_load *stage; /* [n] */
} loads;

typedef struct bands_task {
    layer_draws draws;
    wt_sliding range;   /* sliding with the velocity range of the loads */
    double velocity[2]; /* velocities of `range` [m/s] */
    layer_load *load;   /* [n] */
    size_t n;
    loads centre;
    double *time; /* [n_times] */
    size_t n_times;
    wt_layer_section *section; /* [n_times] */
    double latest;             /* latest of the times [s] */
    double first;              /* time at which rubber is first modified [s]; NaN if never */
    char *words;               /* [(n + 1) LOAD_TEXT_SIZE] */
    char events[(MAX_EVENTS + 1) * EVENT_TEXT_SIZE], known[200], errors[560];
} bands_task;

TABLE_ROW(layer_bands, LAYER_BANDS, double time, load, worn, band; wt_estimate upper, lower;
          double share;)
TABLE_KEYS(layer_bands, LAYER_BANDS, const char *loads, *events, *method;
           wt_estimate first, thickness; double first_low, first_high; const char *known, *errors;)

/* ---- loads ----------------------------------------------------------------------------------- */

static void clear_loads(loads *l)
{
    for (size_t i = 0; l->energy != NULL && i < l->n; i++)
        layer_energy_clear(&l->energy[i]);
    free(l->energy);
    free(l->stage);
    *l = (loads){0};
}

static void append_load(bands_task *task, size_t i)
{
    const layer_load *load = &task->load[i];
    const wt_layer_parameters *p = &task->centre.stage[i].parameters;
    const size_t used = strlen(task->words), size = (task->n + 1) * LOAD_TEXT_SIZE;
    char lasts[48] = "for ever", warm[32] = "";
    if (!isnan(load->temperature))
        clocale_print(warm, sizeof warm, ", %.1f degC", load->temperature - WT_ZERO_CELSIUS);
    if (!isnan(load->time))
        clocale_print(lasts, sizeof lasts, "%.4g s", load->time);
    clocale_print(task->words + used, size - used,
                  "%s%s at %.4g MPa, %.4g mm/s, k = %.3g mm^3/(N m)%s", used > 0 ? "; then " : "",
                  lasts, 1e-6 * p->pressure, 1e3 * p->velocity, 1e9 * p->specific_wear_rate, warm);
}

/* Draws the wear rate of a load. It has the relative error of that of the job and the same draw. */
static double draw_load_wear(const layer_context *context, double sliding_velocity)
{
    wt_estimate wear = context->job->specific_wear_rate;
    wear.standard_error *= wear.value > 0 ? sliding_velocity / wear.value : 0;
    wear.value = sliding_velocity;
    return flow_draw_positive(wear, context->work->seed, context->replicate, FLOW_DRAW_WEAR);
}

static wt_status create_loads(const bands_task *task, const layer_context *context, loads *l,
                              wt_error *err)
{
    *l = (loads){.energy = wt_alloc(task->n + 1, sizeof *l->energy),
                 .stage = wt_alloc(task->n + 1, sizeof *l->stage)};
    for (size_t i = 0; i < task->n; i++) {
        const layer_load *load = &task->load[i];
        const operating_point conditions = {load->pressure, load->velocity, load->temperature,
                                            operating_point_default().layer};
        wt_layer_load *stage = &l->stage[i];
        const wt_status status =
            layer_compute_energy(context, conditions, &l->energy[i], &stage->parameters, err);
        if (status != WT_OK)
            return status;
        l->n++;
        if (!isnan(load->specific_wear_rate))
            stage->parameters.specific_wear_rate =
                draw_load_wear(context, load->specific_wear_rate);
        stage->parameters.incubation = true;
        stage->source = &l->energy[i].source;
        stage->duration = isnan(load->time) ? 0 : load->time;
    }
    return WT_OK;
}

/* Parses the loads of the job; without any, the sliding conditions are the only load. */
static wt_status parse_loads(bands_task *task, const wt_layer_job *job, wt_error *err)
{
    const double unset = (double)NAN;
    task->n = job->n_loads > 0 ? job->n_loads : 1;
    task->load = wt_alloc(task->n, sizeof *task->load);
    task->words = wt_alloc(task->n + 1, LOAD_TEXT_SIZE);
    task->load[0] = (layer_load){unset, unset, unset, unset, unset};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < job->n_loads; i++)
        status = layer_load_parse(job, i, &task->load[i], err);
    return status;
}

/* Sets the range of velocities, for the materials of the replicates. */
static void set_velocity_range(bands_task *task, const wt_sliding *sliding)
{
    const double sliding_velocity = layer_sliding_velocity(sliding, &task->draws.stated);
    double *const v = task->velocity;
    v[0] = v[1] = sliding_velocity;
    for (size_t i = 0; i < task->n; i++)
        if (!isnan(task->load[i].velocity)) {
            v[0] = fmin(v[0], task->load[i].velocity);
            v[1] = fmax(v[1], task->load[i].velocity);
        }
    task->range = *sliding;
    task->range.velocity = v;
    task->range.n_velocity = 2;
    task->range.reference_velocity = sliding_velocity;
    task->draws.replicates.sliding = &task->range;
}

/* ---- times ----------------------------------------------------------------------------------- */

/* Adds times from a share of the length to `to`, in equal ratios. */
static void add_log_times(bands_task *task, double begin, double length, double to)
{
    const double from = first_part * length;
    for (size_t k = 0; k < TIMES_OF_LOAD; k++)
        task->time[task->n_times++] =
            begin + from * pow(to / from, (double)k / (double)(TIMES_OF_LOAD - 1));
}

/* Chooses the times: those of the job, else those of each load, and for the last load as long as it
 * changes the layer. Each load includes its start, where the layer is that of the previous load. */
static wt_status choose_band_times(bands_task *task, wt_error *err)
{
    const wt_layer_load *last = &task->centre.stage[task->n - 1];
    const wt_layer_job *job = &task->draws.calibrated;
    wt_layer_steady_state balance;
    double *last_load_times = NULL, begin = 0;
    size_t n = 0;
    wt_status status =
        wt_layer_steady_state_compute(last->source, &last->parameters, &balance, err);
    if (status == WT_OK)
        last_load_times = layer_times_choose(job, &balance, &n);
    if (status != WT_OK)
        return status;
    const bool chosen = job->time == NULL;
    task->time = wt_alloc(n + (task->n + 1) * (TIMES_OF_LOAD + 1), sizeof *task->time);
    for (size_t i = 0; chosen && i + 1 < task->n; i++) {
        const double length = task->centre.stage[i].duration;
        if (length > 0)
            add_log_times(task, begin, length, length);
        begin += length;
    }
    /* The times of the last load begin where that load alone would have an effect. */
    if (begin > 0 && last_load_times[0] > first_part * begin)
        add_log_times(task, begin, begin, last_load_times[0]);
    for (size_t i = 0; i < n; i++)
        task->time[task->n_times++] = begin + last_load_times[i];
    free(last_load_times);
    return status;
}

/* ---- events ---------------------------------------------------------------------------------- */

static void append_event(const wt_layer_event *e, char *text, size_t size)
{
    static const char *const words[] = {"a band opens below the surface", "the surface is modified",
                                        "a band reaches the surface", "two bands merge",
                                        "a band is worn off"};
    const size_t used = strlen(text);
    const bool deep = e->depth > 0;
    clocale_print(text + used, size - used, "%s%s at %.4g s", used > 0 ? "; " : "", words[e->kind],
                  e->time);
    if (deep)
        clocale_print(text + strlen(text), size - strlen(text), ", %.4g um deep", 1e6 * e->depth);
}

static wt_status list_events(bands_task *task, wt_error *err)
{
    wt_layer_event events[MAX_EVENTS];
    size_t n = 0;
    const wt_status status =
        wt_layer_load_events(task->centre.stage, task->n, events, MAX_EVENTS, &n, err);
    for (size_t i = 0; status == WT_OK && i < n && i < MAX_EVENTS; i++)
        append_event(&events[i], task->events, sizeof task->events);
    task->first = n > 0 ? events[0].time : (double)NAN;
    const size_t used = strlen(task->events);
    if (status == WT_OK && n > MAX_EVENTS)
        snprintf(task->events + used, sizeof task->events - used, "; and %zu more", n - MAX_EVENTS);
    if (status == WT_OK && n == 0)
        snprintf(task->events, sizeof task->events, "nothing is ever modified");
    return status;
}

static wt_status compute_sections(bands_task *task, wt_error *err)
{
    task->section = wt_alloc(task->n_times + 1, sizeof *task->section);
    for (size_t i = 0; i < task->n_times; i++)
        task->latest = fmax(task->latest, task->time[i]);
    return wt_layer_sections(task->centre.stage, task->n, task->time, task->n_times, task->section,
                             err);
}

/* ---- replicates ------------------------------------------------------------------------------ */

/* Quantities of a replicate. Those of each time follow: the number of bands and their edges, NaN if
 * that number differs from the stated values. */
enum { SOLVED, FIRST, LN_FIRST, THICKNESS, N_NUMBERS };
enum { AT_BANDS, AT_EDGES, N_AT = AT_EDGES + 2 * WT_LAYER_MAX_BANDS };

/* Depth of the modified rubber at the latest time [m]. */
static wt_estimate final_depth(const wt_layer_section *section, size_t n)
{
    wt_estimate depth = {(double)NAN, (double)NAN, (double)NAN, "m"};
    double latest = -1;
    for (size_t i = 0; i < n; i++) {
        const wt_layer_section *s = &section[i];
        if (!(s->time > latest))
            continue;
        latest = s->time;
        depth = s->n > 0 ? s->band[0].lower : (wt_estimate){.unit = "m"};
    }
    return depth;
}

static void store_band_depths(const wt_layer_section *s, const wt_layer_section *centre,
                              double *out)
{
    const size_t n = s->n == centre->n && s->n <= WT_LAYER_MAX_BANDS ? s->n : 0;
    out[AT_BANDS] = (double)s->n;
    for (size_t i = 0; i < WT_LAYER_MAX_BANDS; i++) {
        out[AT_EDGES + 2 * i] = i < n ? s->band[i].upper.value : (double)NAN;
        out[AT_EDGES + 2 * i + 1] = i < n ? s->band[i].lower.value : (double)NAN;
    }
}

static wt_status bands_replicate(const void *user, size_t k, double *out, wt_error *err)
{
    const bands_task *task = user;
    wt_layer_job job;
    layer_context context;
    loads l = {0};
    wt_layer_event first = {.time = (double)NAN};
    const size_t rows = k < LAYER_ROW_REPLICATES ? task->n_times : 0;
    wt_layer_section *section = wt_alloc(task->n_times + 1, sizeof *section);
    wt_status status = layer_draws_replicate_context(&task->draws, k, &job, &context, err);
    if (status == WT_OK)
        status = create_loads(task, &context, &l, err);
    if (status == WT_OK)
        status = wt_layer_first_event(l.stage, l.n, &first, err);
    if (status == WT_OK)
        status = rows > 0 ? wt_layer_sections(l.stage, l.n, task->time, rows, section, err)
                 : task->n_times > 0
                     ? wt_layer_sections(l.stage, l.n, &task->latest, 1, section, err)
                     : WT_OK;
    if (status == WT_OK) {
        out[SOLVED] = 1;
        out[FIRST] = first.time;
        out[LN_FIRST] = log(first.time);
        out[THICKNESS] = final_depth(section, rows > 0 || task->n_times == 0 ? rows : 1).value;
        for (size_t i = 0; i < N_AT * task->n_times; i++)
            out[N_NUMBERS + i] = (double)NAN;
        for (size_t i = 0; i < rows; i++)
            store_band_depths(&section[i], &task->section[i], out + N_NUMBERS + N_AT * i);
    }
    clear_loads(&l);
    free(section);
    return status;
}

/* Share of the replicates with this number of bands at a time; NaN without replicates. */
static double matching_share(const replicates *r, size_t bands, size_t time)
{
    size_t solved = 0, same = 0;
    for (size_t i = 0; i < r->n && i < LAYER_ROW_REPLICATES; i++) {
        const double *const out = r->value + i * r->stride;
        solved += out[SOLVED] > 0;
        same += out[N_NUMBERS + N_AT * time + AT_BANDS] == (double)bands;
    }
    return solved > 0 ? (double)same / (double)solved : (double)NAN;
}

/* ---- the table ------------------------------------------------------------------------------- */

static double load_number(const bands_task *task, double time)
{
    size_t i = 0;
    for (double end = 0; i + 1 < task->n; i++) {
        end += task->centre.stage[i].duration;
        if (time < end)
            break;
    }
    return (double)(i + 1);
}

static wt_estimate edge_with_error(wt_estimate edge, double error)
{
    edge.standard_error = error;
    return edge;
}

static void add_section_rows(const bands_task *task, size_t at, table_writer *t)
{
    const wt_layer_section *s = &task->section[at];
    const wt_estimate none = {(double)NAN, (double)NAN, (double)NAN, NULL};
    const double load = load_number(task, s->time),
                 share = matching_share(&task->draws.replicates, s->n, at);
    const double *const e = task->draws.replicates.error + N_NUMBERS + N_AT * at + AT_EDGES;
    if (s->n == 0)
        TABLE_ADD(layer_bands, t, s->time, load, s->worn, 0, none, none, share);
    for (size_t i = 0; i < s->n && i < WT_LAYER_MAX_BANDS; i++)
        TABLE_ADD(layer_bands, t, s->time, load, s->worn, (double)(i + 1),
                  edge_with_error(s->band[i].upper, e[2 * i]),
                  edge_with_error(s->band[i].lower, e[2 * i + 1]), share);
}

static wt_status tabulate_bands(bands_task *task, wt_table **table, wt_error *err)
{
    const double *const e = task->draws.replicates.error;
    const wt_interval first = layer_draws_interval(&task->draws, LN_FIRST, task->first);
    wt_estimate thickness = final_depth(task->section, task->n_times);
    thickness.standard_error = e[THICKNESS];
    layer_draws_describe(&task->draws, task->errors, sizeof task->errors);
    layer_draws_assess(&task->draws, LN_FIRST, task->first, "nothing is ever modified",
                       "something is modified", task->known, sizeof task->known);
    table_writer t = table_begin(&layer_bands_schema, err);
    for (size_t i = 0; i < task->n_times; i++)
        add_section_rows(task, i, &t);
    TABLE_SET(
        layer_bands, &t, task->words, task->events,
        "exact transport of damage (derived); an observed layer at the start is worn from "
        "the top",
        (wt_estimate){task->first, isnan(first.low) ? (double)NAN : e[FIRST], (double)NAN, NULL},
        thickness, first.low, first.high, task->known, task->errors);
    return table_end(&t, table);
}

/* ---- the job --------------------------------------------------------------------------------- */

static wt_status compute_nominal_bands(bands_task *task, wt_error *err)
{
    wt_status status = create_loads(task, &task->draws.values, &task->centre, err);
    for (size_t i = 0; status == WT_OK && i < task->n; i++)
        append_load(task, i);
    if (status == WT_OK)
        status = choose_band_times(task, err);
    if (status == WT_OK)
        status = list_events(task, err);
    return status == WT_OK ? compute_sections(task, err) : status;
}

wt_status wt_layer_bands_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                 const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no bands of a layer to make");
    bands_task task = {.n = 0};
    wt_status status = layer_draws_init(&task.draws, sliding, job, NULL, work, "bands", false, err);
    if (status == WT_OK)
        status = parse_loads(&task, job, err);
    if (status == WT_OK)
        status = compute_nominal_bands(&task, err);
    if (status == WT_OK) {
        set_velocity_range(&task, sliding);
        status = replicates_draw(&task.draws.replicates, N_NUMBERS + N_AT * task.n_times,
                                 bands_replicate, &task, err);
    }
    if (status == WT_OK)
        status = tabulate_bands(&task, table, err);
    cost_report(work,
                (cost_summary){.items = (double)(task.n_times * (1 + task.draws.replicates.n)),
                               .tolerance_asked = work->tolerance});
    layer_draws_clear(&task.draws);
    clear_loads(&task.centre);
    free(task.load);
    free(task.words);
    free(task.time);
    free(task.section);
    return status;
}
