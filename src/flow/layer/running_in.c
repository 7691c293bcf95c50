/* The table of the friction in running-in: the layer grows, and friction with it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/layer/acts_back.h"
#include "flow/sliding/sliding_contact.h"
#include "flow/work/cost.h"

#include "data/tables/rows.h"

#include <math.h>
#include <stdlib.h>

/* Running-in is over when so much of the change of friction is left. */
static const double settled_share = 0.05;
/* Halves of a step of the time, to 1e-12 of it. */
enum { HALVES = 40 };

typedef struct running_task {
    acts_back back;
    wt_layer_job job; /* calibrated */
    double *time;
    size_t n;
    wt_layer_point *points;   /* [n] */
    layer_friction *friction; /* [n] */
    double thickness;         /* at balance; NaN or infinite: there is none */
    layer_friction bare, balance;
    char shear[256];
} running_task;

TABLE_ROW(running_in, RUNNING_IN, double time, thickness, hysteresis, area_ratio, shear_stress,
          friction;)
TABLE_KEYS(running_in, RUNNING_IN, double velocity, modulus_ratio;
           wt_estimate bare, balance, thickness, settled; const char *shear, *back, *errors;)

/* Not known where there is no balance, and where age has modified all rubber. */
static wt_status friction_of(const running_task *task, double thickness, layer_friction *friction,
                             wt_error *err)
{
    const double unknown = (double)NAN;
    *friction = (layer_friction){unknown, unknown, unknown, unknown};
    if (!isfinite(thickness))
        return WT_OK;
    layer_spot spot = layer_here();
    spot.layer = (wt_layer_state){thickness, thickness > 0 ? task->back.modulus_ratio : 1};
    return layer_friction_at(task->back.sliding, &task->job, task->back.work, spot, friction, err);
}

/* Friction, or hysteresis where no shear stress is known. */
static double known_friction(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis : f->total;
}

/* ---- thickness ------------------------------------------------------------------------------- */

/* The balance that a bare surface comes to, and the thickness in time. */
static wt_status grow_back(running_task *task, wt_error *err)
{
    wt_layer_loop loop;
    wt_status status = acts_back_find(&task->back, &loop, err);
    if (status != WT_OK)
        return status;
    task->thickness = loop.ratio > 1 ? (double)NAN : 0;
    for (size_t i = loop.n_roots; i-- > 0;)
        if (loop.root[i].stable)
            task->thickness = loop.root[i].thickness;
    return wt_layer_loop_history(acts_back_energy, &task->back, &loop, task->time, task->n,
                                 task->points, err);
}

static int by_time(const void *left, const void *right)
{
    const double *const a = left, *const b = right;
    return (*a > *b) - (*a < *b);
}

static wt_status grow(running_task *task, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    wt_layer_balance balance;
    wt_status status = acts_back_energy(0, &task->back, &source, &p, err);
    if (status == WT_OK)
        status = wt_layer_balance_compute(&source, &p, &balance, err);
    if (status == WT_OK)
        status = layer_times_choose(&task->job, &balance, &task->time, &task->n, err);
    if (status == WT_OK) { /* what is left is looked for from the last time on */
        qsort(task->time, task->n, sizeof *task->time, by_time);
        task->points = calloc(task->n + 1, sizeof *task->points);
        task->friction = calloc(task->n + 1, sizeof *task->friction);
        if (task->points == NULL || task->friction == NULL)
            status = wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    if (status == WT_OK && task->job.acts_back)
        status = grow_back(task, err);
    else if (status == WT_OK) {
        task->thickness = balance.thickness.value;
        status = wt_layer_history(&source, &p, task->time, task->n, task->points, err);
    }
    wt_energy_source_clear(&source);
    return status;
}

/* ---- friction -------------------------------------------------------------------------------- */

/* Between two times the thickness is linear in the logarithm of the time. */
static wt_status settle_between(const running_task *task, size_t i, double limit, double *settled,
                                wt_error *err)
{
    double low = 0, high = 1;
    const double end = known_friction(&task->balance);
    const double from = task->points[i].thickness.value, to = task->points[i + 1].thickness.value;
    for (int k = 0; k < HALVES; k++) {
        const double middle = 0.5 * (low + high);
        layer_friction f;
        const wt_status status = friction_of(task, from + middle * (to - from), &f, err);
        if (status != WT_OK)
            return status;
        if (fabs(known_friction(&f) - end) > limit)
            low = middle;
        else
            high = middle;
    }
    *settled = task->time[i] * pow(task->time[i + 1] / task->time[i], high);
    return WT_OK;
}

/* NaN where the times do not hold it. */
static wt_status find_settled(const running_task *task, double *settled, wt_error *err)
{
    const double end = known_friction(&task->balance);
    const double limit = settled_share * fabs(known_friction(&task->bare) - end);
    *settled = (double)NAN;
    for (size_t i = task->n; isfinite(limit) && i-- > 1;)
        if (fabs(known_friction(&task->friction[i - 1]) - end) > limit)
            return fabs(known_friction(&task->friction[i]) - end) <= limit && task->time[i - 1] > 0
                       ? settle_between(task, i - 1, limit, settled, err)
                       : WT_OK;
    return WT_OK;
}

static wt_status follow_friction(running_task *task, wt_error *err)
{
    wt_status status = friction_of(task, 0, &task->bare, err);
    if (status == WT_OK)
        status = friction_of(task, task->thickness, &task->balance, err);
    for (size_t i = 0; status == WT_OK && i < task->n; i++)
        status = friction_of(task, task->points[i].thickness.value, &task->friction[i], err);
    return status;
}

/* ---- the table ------------------------------------------------------------------------------- */

static void say_shear(running_task *task)
{
    if (isnan(task->back.sliding->shear_stress.value))
        snprintf(task->shear, sizeof task->shear, "not known: hysteresis alone");
    else
        sliding_layer_shear_describe(&task->job.shear, task->shear, sizeof task->shear);
}

static wt_status make_table(running_task *task, double velocity, wt_table **table, wt_error *err)
{
    double settled;
    const wt_status status = find_settled(task, &settled, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&running_in_schema, err);
    for (size_t i = 0; i < task->n; i++) {
        const layer_friction *f = &task->friction[i];
        TABLE_ADD(running_in, &t, task->time[i], task->points[i].thickness.value, f->hysteresis,
                  f->area_ratio, f->shear_stress, f->total);
    }
    say_shear(task);
    const bool ages = task->job.closure == WT_CLOSURE_ACTIVATED && task->job.activation.ageing;
    TABLE_SET(running_in, &t, velocity, task->back.modulus_ratio,
              layer_alone(known_friction(&task->bare)), layer_alone(known_friction(&task->balance)),
              layer_alone(task->thickness), layer_alone(settled), task->shear,
              task->job.acts_back
                  ? "the layer acts back on the energy that makes it; by the rate balance "
                    "(reconstructed)"
              : ages
                  ? "the energy is that of the bulk, friction that with the layer (reconstructed); "
                    "not known (nan) once age has modified rubber of every depth"
                  : "the energy is that of the bulk, friction that with the layer (reconstructed)",
              "of the values themselves: the standard errors are in the tables layer and friction");
    return table_end(&t, table);
}

wt_status wt_running_in_make(const wt_sliding *sliding, const wt_layer_job *job,
                             const wt_layer_known *known, const wt_job *work, wt_table **table,
                             wt_error *err)
{
    if (job == NULL || known == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no running-in of a layer to make");
    if (job->acts_back && job->start_thickness > 0) {
        wt_fail(err, WT_E_ARG, "a layer that acts back is followed from a bare surface alone");
        wt_error_place(err, "start-thickness");
        wt_error_found(err, "%g m", job->start_thickness);
        wt_error_advice(err, "leave out start-thickness, or acts-back");
        return WT_E_ARG;
    }
    running_task task = {.n = 0};
    wt_status status = layer_job_known(sliding, job, known, work, &task.job, err);
    task.back = (acts_back){sliding, &task.job, work, known->modulus_ratio.value};
    if (status == WT_OK)
        status = grow(&task, err);
    if (status == WT_OK)
        status = follow_friction(&task, err);
    if (status == WT_OK)
        status = make_table(&task, flow_layer_velocity(sliding, job), table, err);
    cost_say(work, (cost_summary){.items = (double)task.n, .tolerance_asked = work->tolerance});
    free(task.time);
    free(task.points);
    free(task.friction);
    return status;
}
