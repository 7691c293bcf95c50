/* Records the cost of each stage of a job. SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"

#include "core/base/array.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct cost_row {
    char stage[64], because[256];
    bool runs;
    double wall, cpu;
    cost_summary reported;
    size_t nodes, files, bytes;
} cost_row;

typedef struct cost_part_row {
    const char *words;
    double seconds;
} cost_part_row;

struct wt_cost {
    bool timed, open; /* open: the last stage has not ended */
    unsigned threads;
    double wall, cpu; /* clocks at the beginning */
    atomic_size_t nodes, files, bytes;
    cost_row *rows;
    size_t n_rows;
    cost_part_row *parts;
    size_t n_parts;
};

wt_cost *wt_cost_new(bool timed, unsigned threads)
{
    wt_cost *cost = wt_alloc(1, sizeof *cost);
    cost->timed = timed;
    cost->threads = wt_thread_count(threads);
    cost->wall = cost_clock(cost);
    cost->cpu = timed ? wt_time_cpu() : (double)NAN;
    return cost;
}

void wt_cost_free(wt_cost *cost)
{
    if (cost == NULL)
        return;
    free(cost->rows);
    free(cost->parts);
    free(cost);
}

/* ---- counters -------------------------------------------------------------------------------- */

void cost_add_nodes(wt_cost *cost, size_t nodes)
{
    if (cost != NULL)
        atomic_fetch_add_explicit(&cost->nodes, nodes, memory_order_relaxed);
}

void cost_add_file(wt_cost *cost, size_t bytes)
{
    if (cost == NULL)
        return;
    atomic_fetch_add_explicit(&cost->files, 1, memory_order_relaxed);
    atomic_fetch_add_explicit(&cost->bytes, bytes, memory_order_relaxed);
}

void cost_report(const wt_job *work, cost_summary summary)
{
    if (work->cost != NULL && work->cost->open && (work->left_out & WT_EXTRA_SUMMARY) == 0)
        work->cost->rows[work->cost->n_rows - 1].reported = summary;
}

/* ---- stages ---------------------------------------------------------------------------------- */

static cost_row *add_cost_row(wt_cost *cost, const char *stage, const char *because)
{
    cost->rows = array_grow(cost->rows, cost->n_rows, sizeof *cost->rows);
    cost_row *const row = &cost->rows[cost->n_rows++];
    *row = (cost_row){.runs = false};
    snprintf(row->stage, sizeof row->stage, "%s", stage);
    snprintf(row->because, sizeof row->because, "%s", because);
    return row;
}

void cost_begin(wt_cost *cost, const char *stage, const char *because)
{
    cost_end(cost);
    cost_row *row = cost != NULL ? add_cost_row(cost, stage, because) : NULL;
    if (row == NULL)
        return;
    cost->open = row->runs = true;
    row->wall = cost_clock(cost);
    row->cpu = cost->timed ? wt_time_cpu() : (double)NAN;
}

void cost_end(wt_cost *cost)
{
    if (cost == NULL || !cost->open)
        return;
    cost_row *row = &cost->rows[cost->n_rows - 1];
    cost->open = false;
    row->wall = cost_clock(cost) - row->wall;
    row->cpu = (cost->timed ? wt_time_cpu() : (double)NAN) - row->cpu;
    row->nodes = atomic_exchange(&cost->nodes, 0);
    row->files = atomic_exchange(&cost->files, 0);
    row->bytes = atomic_exchange(&cost->bytes, 0);
}

void cost_set_reason(wt_cost *cost, const char *because)
{
    cost_row *row = cost->n_rows > 0 ? &cost->rows[cost->n_rows - 1] : NULL;
    if (row != NULL)
        snprintf(row->because, sizeof row->because, "%s", because);
}

void cost_skip_stage(wt_cost *cost, const char *stage, const char *because)
{
    (void)add_cost_row(cost, stage, because);
}

void wt_cost_begin_stage(wt_cost *cost, const char *stage)
{
    cost_begin(cost, stage, "runs because it is asked for");
}

/* ---- parts ----------------------------------------------------------------------------------- */

double cost_clock(const wt_cost *cost)
{
    return cost != NULL && cost->timed ? wt_time_wall() : (double)NAN;
}

void cost_set_part(wt_cost *cost, const char *words, double seconds)
{
    cost_part_row *parts =
        cost != NULL ? array_grow(cost->parts, cost->n_parts, sizeof *parts) : NULL;
    if (parts == NULL)
        return; /* reported like a part without times */
    cost->parts = parts;
    parts[cost->n_parts++] = (cost_part_row){words, seconds};
}

double cost_part_seconds(const wt_cost *cost, const char *words)
{
    for (size_t i = 0; cost != NULL && i < cost->n_parts; i++)
        if (strcmp(cost->parts[i].words, words) == 0)
            return cost->parts[i].seconds;
    return (double)NAN;
}

stage_cost_sum cost_sum_stages(const wt_cost *cost, const char *beginning)
{
    stage_cost_sum sum = {(double)NAN, (double)NAN};
    const size_t ended = cost != NULL ? cost->n_rows - cost->open : 0;
    for (size_t i = 0; i < ended; i++) {
        const cost_row *row = &cost->rows[i];
        if (!row->runs || strncmp(row->stage, beginning, strlen(beginning)) != 0)
            continue;
        sum.seconds = isnan(sum.seconds) ? row->wall : sum.seconds + row->wall;
        if (row->reported.tolerance_asked > 0)
            sum.error = fmax(sum.error, row->reported.error_estimated);
    }
    return sum;
}

/* ---- table ----------------------------------------------------------------------------------- */

static const double unknown = (double)NAN;

TABLE_ROW_OF(cost, COST, struct cost_row)
TABLE_KEYS(cost, COST, wt_estimate wall, cpu, threads;)

static void write_cost_row(table_writer *t, bool timed, cost_row row)
{
    cost_summary *s = &row.reported;
    const double error = s->number.standard_error / fabs(s->number.value);
    if (!timed)
        row.wall = row.cpu = unknown;
    if (!(s->items > 0) && row.runs)
        s->items = unknown;
    if (!(s->tolerance_asked > 0))
        s->tolerance_asked = s->error_estimated = unknown;
    s->number.standard_error = error > 0 && isfinite(error) ? error : unknown;
    cost_add_row(t, &row);
}

wt_status wt_cost_table(wt_cost *cost, wt_table **table, wt_error *err)
{
    if (cost == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no cost to write down");
    cost_end(cost);
    table_writer t = table_begin(&cost_schema, err);
    for (size_t i = 0; i < cost->n_rows; i++)
        write_cost_row(&t, cost->timed, cost->rows[i]);
    if (cost->timed)
        TABLE_SET(cost, &t, {wt_time_wall() - cost->wall, unknown, unknown, NULL},
                  {wt_time_cpu() - cost->cpu, unknown, unknown, NULL},
                  {cost->threads, unknown, unknown, NULL});
    return table_end(&t, table);
}
