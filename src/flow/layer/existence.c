/* The table of where a layer exists: balance thickness and what it does to friction against the
 * power that modifies the rubber, over velocities and pressures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/layer/acts_back.h"
#include "flow/work/cost.h"

#include "base/clocale.h"
#include "data/tables/rows.h"
#include "model/root.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* To so much of a velocity an edge is found. */
static const double edge_close = 1e-9;

typedef struct existence_task {
    const wt_sliding *sliding;
    wt_layer_job job;            /* calibrated */
    const wt_layer_known *known; /* or NULL */
    const wt_job *work;
    wt_status status; /* of a root */
    wt_error *err;
    double edge[2], power[2]; /* first and last, NaN: beyond the list */
    size_t n_edges;
    char words[256];
} existence_task;

TABLE_ROW(existence, EXISTENCE, double pressure, velocity, power, ratio, thickness, friction,
          with_layer, change;)
TABLE_KEYS(existence, EXISTENCE, double pressure;
           wt_estimate from_velocity, to_velocity, from_power, to_power; const char *words;)

/* Power, R and thickness there. */
static wt_status balance_at(const existence_task *task, layer_spot spot, wt_layer_balance *balance,
                            wt_error *err)
{
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    wt_status status = layer_at(task->sliding, &task->job, task->work, spot, &energy, &p, err);
    if (status != WT_OK)
        return status;
    p.balance_only = p.without_errors = true;
    status = wt_layer_balance_compute(&energy.source, &p, balance, err);
    layer_energy_clear(&energy);
    return status;
}

static wt_status row_at(const existence_task *task, layer_spot spot, existence_row *row,
                        wt_error *err)
{
    wt_layer_balance b;
    layer_friction f, with;
    wt_status status = balance_at(task, spot, &b, err);
    if (status == WT_OK)
        status = layer_friction_at(task->sliding, &task->job, task->work, spot, &f, err);
    if (status != WT_OK)
        return status;
    const bool total = !isnan(f.total);
    *row = (existence_row){.pressure = spot.pressure,
                           .velocity = spot.velocity,
                           .power = b.surface_power,
                           .ratio = b.ratio,
                           .thickness = b.thickness.value,
                           .friction = total ? f.total : f.hysteresis,
                           .with_layer = (double)NAN,
                           .change = (double)NAN};
    if (task->known == NULL || !isfinite(b.thickness.value))
        return WT_OK;
    if (b.thickness.value > 0)
        spot.layer = (wt_layer_state){b.thickness.value, task->known->modulus_ratio.value};
    status = layer_friction_at(task->sliding, &task->job, task->work, spot, &with, err);
    row->with_layer = total ? with.total : with.hysteresis;
    row->change = row->with_layer / row->friction - 1;
    return status;
}

/* ---- edges ----------------------------------------------------------------------------------- */

static double log_ratio_at(double log_velocity, void *user)
{
    existence_task *task = user;
    layer_spot spot = layer_here();
    wt_layer_balance b = {.ratio = (double)NAN};
    spot.velocity = exp(log_velocity);
    if (task->status == WT_OK)
        task->status = balance_at(task, spot, &b, task->err);
    return b.ratio > 0 ? log(b.ratio) : -HUGE_VAL;
}

/* The edge between two velocities, and the power there. */
static void add_edge(existence_task *task, double low, double high, bool begins)
{
    double at;
    const wt_status status =
        root_find(log_ratio_at, task, log(low), log(high), edge_close, &at, task->err);
    task->status = task->status == WT_OK ? status : task->status;
    layer_spot spot = layer_here();
    wt_layer_balance b;
    spot.velocity = exp(at);
    if (task->status == WT_OK)
        task->status = balance_at(task, spot, &b, task->err);
    if (task->status != WT_OK)
        return;
    const size_t used = strlen(task->words);
    clocale_print(task->words + used, sizeof task->words - used, "%s%s %.4g m/s (%.4g W/m^2)",
                  used > 0 ? ", " : "", begins ? "from" : "up to", spot.velocity, b.surface_power);
    const size_t k = begins ? 0 : 1;
    if (!begins || task->n_edges == 0) {
        task->edge[k] = spot.velocity;
        task->power[k] = b.surface_power;
    }
    if (begins) /* what ends before is not the last */
        task->edge[1] = task->power[1] = (double)NAN;
    task->n_edges++;
}

static void find_edges(existence_task *task)
{
    const wt_sliding *s = task->sliding;
    double before = log_ratio_at(log(s->velocity[0]), task);
    bool any = before > 0;
    for (size_t i = 1; task->status == WT_OK && i < s->n_velocity; i++) {
        const double now = log_ratio_at(log(s->velocity[i]), task);
        if ((now > 0) != (before > 0))
            add_edge(task, s->velocity[i - 1], s->velocity[i], now > 0);
        any = any || now > 0;
        before = now;
    }
    if (task->status == WT_OK && task->n_edges == 0)
        snprintf(task->words, sizeof task->words, "%s",
                 any ? "at every velocity of the list" : "at no velocity of the list");
}

/* ---- the table ------------------------------------------------------------------------------- */

static wt_status add_block(const existence_task *task, double pressure, table_writer *t,
                           wt_error *err)
{
    wt_status status = WT_OK;
    table_block(t);
    for (size_t i = 0; status == WT_OK && i < task->sliding->n_velocity; i++) {
        layer_spot spot = layer_here();
        existence_row row;
        spot.pressure = pressure;
        spot.velocity = task->sliding->velocity[i];
        status = row_at(task, spot, &row, err);
        if (status == WT_OK)
            existence_add_row(t, &row);
    }
    return status;
}

static wt_status make_table(existence_task *task, wt_table **table, wt_error *err)
{
    const wt_sliding *s = task->sliding;
    table_writer t = table_begin(&existence_schema, err);
    wt_status status = WT_OK;
    if (s->n_pressures == 0)
        status = add_block(task, s->pressure.value, &t, err);
    for (size_t i = 0; status == WT_OK && i < s->n_pressures; i++)
        status = add_block(task, s->pressures[i], &t, err);
    if (t.status == WT_OK)
        t.status = status;
    TABLE_SET(existence, &t, s->pressure.value, layer_alone(task->edge[0]),
              layer_alone(task->edge[1]), layer_alone(task->power[0]), layer_alone(task->power[1]),
              task->words);
    return table_end(&t, table);
}

static int by_value(const void *left, const void *right)
{
    const double *const a = left, *const b = right;
    return (*a > *b) - (*a < *b);
}

/* The same with its velocities from the least on, between which edges are looked for. */
static wt_status order_velocities(const wt_sliding *sliding, wt_sliding *own, double **velocity,
                                  wt_error *err)
{
    *velocity = malloc((sliding->n_velocity + 1) * sizeof **velocity);
    if (*velocity == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    memcpy(*velocity, sliding->velocity, sliding->n_velocity * sizeof **velocity);
    qsort(*velocity, sliding->n_velocity, sizeof **velocity, by_value);
    *own = *sliding;
    own->velocity = *velocity;
    return WT_OK;
}

wt_status wt_existence_make(const wt_sliding *sliding, const wt_layer_job *job,
                            const wt_layer_known *known, const wt_job *work, wt_table **table,
                            wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no existence of a layer to make");
    const double unset = (double)NAN;
    wt_sliding own;
    double *velocity = NULL;
    existence_task task = {.sliding = &own,
                           .known = known,
                           .work = work,
                           .err = err,
                           .edge = {unset, unset},
                           .power = {unset, unset}};
    wt_status status = layer_job_known(sliding, job, known, work, &task.job, err);
    if (status == WT_OK)
        status = order_velocities(sliding, &own, &velocity, err);
    if (status == WT_OK) {
        find_edges(&task);
        status = task.status;
    }
    if (status == WT_OK)
        status = make_table(&task, table, err);
    const size_t blocks = status == WT_OK && sliding->n_pressures > 0 ? sliding->n_pressures : 1;
    free(velocity);
    cost_say(work, (cost_summary){.items = (double)blocks, .tolerance_asked = work->tolerance});
    return status;
}
