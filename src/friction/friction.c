/* The friction job: hysteresis, contact area and total friction at every velocity, with and without
 * the modified layer, with standard errors from replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "dma/rubber.h"
#include "friction/replicates.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "job/random_draws.h"
#include "weartrack/core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Quantities that a replicate returns for each velocity. */
enum { HYSTERESIS, SHEARING, AREA, TOTAL, LAYERED, CHANGE, RELATIVE, N_KINDS };

typedef struct friction_task {
    const wt_sliding *sliding;
    const wt_layer_observation *layer; /* NULL = none */
    const wt_job *work;
    size_t n;                  /* number of velocities; the reference counts if it is not the
                                  only one */
    double *velocity;          /* [n] the reference is the last */
    double *centre;            /* [N_KINDS * n] */
    double worst;              /* relative numerical error at points that miss the tolerance */
    double strain;             /* largest strain, with softening */
    double numerical[2];       /* numerical error of the total friction at the reference: without
                                  and with the layer */
    wt_friction_point *points; /* [n] results for the stated values, without a layer */
    replicates replicates;
    size_t drawn;              /* number of velocities in all replicates */
    double layer_outside;      /* share of the hysteresis on a layer with its own moduli from
                                  extrapolated frequencies, at the reference */
    double zero_loss_range[2]; /* range in which the loss modulus of the layer is set to 0 [rad/s];
                             NaN if none */
} friction_task;

static double *kind_values(double *values, size_t n, int kind)
{
    return values + (size_t)kind * n;
}

static wt_layer_state replicate_layer(const friction_task *task, size_t replicate)
{
    return sliding_layer_state(task->layer, task->work->seed, replicate);
}

static wt_status compute_bulk(const friction_task *task, size_t replicate,
                              wt_friction_point *points, double *out, sliding_contact *c,
                              wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_status status = sliding_contact_create(task->sliding, task->work, replicate,
                                              task->replicates.drawn, none, c, err);
    if (status == WT_OK)
        status =
            wt_friction_compute(c->workspace, c->pressure, task->velocity, task->n, points, err);
    for (size_t i = 0; status == WT_OK && i < task->n; i++) {
        kind_values(out, task->n, HYSTERESIS)[i] = points[i].hysteresis.value;
        kind_values(out, task->n, AREA)[i] = points[i].area_ratio.value;
        const double shearing = c->shear_stress * points[i].area_ratio.value / c->pressure;
        kind_values(out, task->n, SHEARING)[i] = shearing;
        kind_values(out, task->n, TOTAL)[i] = points[i].hysteresis.value + shearing;
        kind_values(out, task->n, LAYERED)[i] = (double)NAN;
        kind_values(out, task->n, CHANGE)[i] = (double)NAN;
        kind_values(out, task->n, RELATIVE)[i] = (double)NAN;
    }
    return status;
}

static wt_status compute_layered(const friction_task *task, size_t replicate,
                                 wt_friction_point *points, double *out, wt_error *err)
{
    wt_layer_state layer = replicate_layer(task, replicate);
    sliding_contact c = {0};
    wt_status status = sliding_contact_create(task->sliding, task->work, replicate,
                                              task->replicates.drawn, layer, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, task->velocity, task->n, points, err);
    for (size_t i = 0; status == WT_OK && i < task->n; i++) {
        const wt_layer_state sheared = sliding_layer_at_shear_rate(&c, layer, task->velocity[i]);
        double with = points[i].hysteresis.value +
                      sliding_layer_shear_stress(task->layer, c.shear_stress, sheared) *
                          points[i].area_ratio.value / c.pressure;
        double without = kind_values(out, task->n, TOTAL)[i];
        kind_values(out, task->n, LAYERED)[i] = with;
        kind_values(out, task->n, CHANGE)[i] = with - without;
        kind_values(out, task->n, RELATIVE)[i] = with / without - 1;
    }
    sliding_contact_clear(&c);
    return status;
}

static wt_status compute_friction_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const friction_task *task = user;
    sliding_contact c = {0};
    wt_friction_point *points = wt_alloc(task->n, sizeof *points);
    wt_status status = compute_bulk(task, i, points, out, &c, err);
    if (status == WT_OK && task->layer != NULL)
        status = compute_layered(task, i, points, out, err);
    sliding_contact_clear(&c);
    free(points);
    return status;
}

/* Share of the hysteresis from extrapolated frequencies; NaN if the measured range is not stated.
 */
static double extrapolated_share(const wt_rubber *rubber, const wt_friction_point *p)
{
    const wt_prony *prony = &rubber->prony;
    return isnan(prony->frequency_min) || isnan(prony->frequency_max) ? (double)NAN
                                                                      : p->extrapolated_share;
}

/* ---- tables ---------------------------------------------------------------------------------- */

TABLE_ROW(friction, FRICTION, double velocity, adhesion, extrapolated_share;
          wt_estimate total, hysteresis, area, with_layer;)

TABLE_KEYS(friction, FRICTION, double gamma, reference_velocity;
           wt_estimate pressure, temperature, shear_stress, total, hysteresis, shearing, area,
           strain;
           wt_estimate layer_thickness, layer_modulus_ratio, with_layer, change;
           wt_estimate layer_slope, layer_outside; char layer_moduli[512];
           wt_estimate relative_change, relative_change_low, relative_change_high;
           size_t replicates; const char *includes, *lacks, *statement;
           char material[512], softening[512], numerical[512], flash[256];)

/* Result for the stated values with the standard error from the replicates. */
static wt_estimate estimate_with_error(friction_task *task, int kind, size_t i,
                                       double numerical_error)
{
    return (wt_estimate){kind_values(task->centre, task->n, kind)[i],
                         kind_values(task->replicates.error, task->n, kind)[i], numerical_error,
                         NULL};
}

static void add_friction_rows(friction_task *task, const sliding_contact *c, table_writer *t)
{
    const wt_sliding *s = task->sliding;
    for (size_t i = 0; i < s->n_velocity; i++) {
        const wt_friction_point *p = &task->points[i];
        const wt_estimate shear = {c->shear_stress, 0, 0, "Pa"};
        friction_row row = {
            .velocity = p->velocity,
            .extrapolated_share = extrapolated_share(s->rubber, p),
            .hysteresis = {p->hysteresis.value, 0, p->hysteresis.numerical_error, "1"},
            .area = {p->area_ratio.value, 0, p->area_ratio.numerical_error, "1"},
            .with_layer = estimate_with_error(task, LAYERED, i, 0)};
        row.total = wt_friction_total(row.hysteresis, row.area, shear, s->pressure.value);
        row.adhesion = row.total.value - row.hysteresis.value;
        row.total.standard_error = estimate_with_error(task, TOTAL, i, 0).standard_error;
        row.hysteresis.standard_error = estimate_with_error(task, HYSTERESIS, i, 0).standard_error;
        row.area.standard_error = estimate_with_error(task, AREA, i, 0).standard_error;
        friction_add_row(t, &row);
    }
}

static const wt_estimate unknown_estimate = {(double)NAN, (double)NAN, (double)NAN, NULL};

static void set_relative_change_keys(friction_task *task, friction_keys *keys)
{
    const size_t last = task->n - 1;
    const double *relative = kind_values(task->centre, task->n, RELATIVE);
    const double both = task->numerical[0] + task->numerical[1];
    keys->relative_change_low = keys->relative_change_high = unknown_estimate;
    keys->relative_change_low.value = keys->relative_change_high.value = relative[0];
    for (size_t i = 1; i < last; i++) {
        keys->relative_change_low.value = fmin(keys->relative_change_low.value, relative[i]);
        keys->relative_change_high.value = fmax(keys->relative_change_high.value, relative[i]);
    }
    keys->layer_thickness = flow_stated_estimate(task->layer->thickness);
    sliding_layer_describe(task->layer, task->zero_loss_range, task->work->log, keys->layer_moduli,
                           sizeof keys->layer_moduli);
    keys->layer_modulus_ratio = flow_stated_estimate(task->layer->modulus_ratio);
    if (keys->layer_moduli[0] != '\0') {
        keys->layer_outside.value = task->layer_outside;
        keys->layer_slope = flow_stated_estimate(task->layer->ratio_slope);
    }
    keys->with_layer = estimate_with_error(task, LAYERED, last, task->numerical[1]);
    keys->change = estimate_with_error(task, CHANGE, last, both);
    keys->relative_change = estimate_with_error(
        task, RELATIVE, last, both / kind_values(task->centre, task->n, TOTAL)[last]);
}

/* Sets the keys of the table. The reference velocity is the last one. */
static void set_friction_keys(friction_task *task, const sliding_contact *c, table_writer *t)
{
    const wt_sliding *s = task->sliding;
    const size_t last = task->n - 1;
    const wt_friction_point *reference = &task->points[last];
    friction_keys keys = {
        .gamma = s->gamma,
        .reference_velocity = task->velocity[last],
        .pressure = flow_stated_estimate(s->pressure),
        .temperature = s->temperature,
        .shear_stress = flow_stated_estimate(s->shear_stress),
        .total = estimate_with_error(task, TOTAL, last, task->numerical[0]),
        .hysteresis =
            estimate_with_error(task, HYSTERESIS, last, reference->hysteresis.numerical_error),
        .shearing = estimate_with_error(task, SHEARING, last,
                                        c->shear_stress / s->pressure.value *
                                            reference->area_ratio.numerical_error),
        .area = estimate_with_error(task, AREA, last, reference->area_ratio.numerical_error),
        .strain = unknown_estimate,
        .layer_thickness = unknown_estimate,
        .layer_modulus_ratio = unknown_estimate,
        .layer_slope = unknown_estimate,
        .layer_outside = unknown_estimate,
        .with_layer = unknown_estimate,
        .change = unknown_estimate,
        .relative_change = unknown_estimate,
        .relative_change_low = unknown_estimate,
        .relative_change_high = unknown_estimate,
        .replicates = task->replicates.n,
        .includes = replicates_included_errors(&task->replicates),
        .lacks = task->replicates.lacks,
        .statement = c->statement};
    flash_describe(s, task->points, task->n, keys.flash);
    if (isnan(keys.temperature.value))
        keys.temperature.value = s->rubber->prony.reference_temperature;
    keys.temperature = flow_stated_estimate(keys.temperature);
    if (wt_rubber_describe(s->rubber, keys.material, sizeof keys.material) == 0)
        keys.material[0] = '\0';
    if (s->strain_softening != NULL) {
        strain_softening_describe(s->strain_softening, keys.softening, sizeof keys.softening);
        keys.strain.value = task->strain;
    }
    if (task->worst > 0)
        clocale_print(keys.numerical, sizeof keys.numerical, TOLERANCE_STATEMENT,
                      task->work->tolerance, task->worst);
    if (task->layer != NULL)
        set_relative_change_keys(task, &keys);
    friction_set_keys(t, &keys);
    if (isnan(s->shear_stress.value))
        friction_set_text(t, FRICTION_KEY_SHEAR_STRESS,
                          "not given: only the hysteresis part is known");
}

static wt_status make_friction_table(friction_task *task, const sliding_contact *c, wt_table **out,
                                     wt_error *err)
{
    table_writer t = table_begin(&friction_schema, err);
    add_friction_rows(task, c, &t);
    set_friction_keys(task, c, &t);
    return table_end(&t, out);
}

/* ---- the job --------------------------------------------------------------------------------- */

static bool is_only_reference(const wt_sliding *sliding)
{
    return sliding->n_velocity == 1 && sliding->velocity[0] == flow_reference_velocity(sliding);
}

static void allocate_results(friction_task *task)
{
    task->velocity = wt_alloc(task->n, sizeof *task->velocity);
    task->centre = wt_alloc(N_KINDS * task->n, sizeof *task->centre);
    task->points = wt_alloc(task->n, sizeof *task->points);
    memcpy(task->velocity, task->sliding->velocity,
           task->sliding->n_velocity * sizeof *task->velocity);
    task->velocity[task->n - 1] = flow_reference_velocity(task->sliding);
}

static void free_results(friction_task *task)
{
    free(task->velocity);
    free(task->centre);
    free(task->points);
    replicates_clear(&task->replicates);
}

static wt_status check_layer_thickness(const wt_layer_observation *layer, wt_error *err)
{
    if (layer != NULL && isinf(layer->thickness.value)) {
        wt_fail(err, WT_E_RANGE, "friction needs a layer of finite thickness");
        wt_error_found(err, "%g m", layer->thickness.value);
        wt_error_advice(err, "without wear the layer grows without end: give a specific wear rate "
                             "or an observed thickness");
        return WT_E_RANGE;
    }
    return sliding_layer_check(layer, err);
}

/* Numerical error of hysteresis friction plus shear factor times contact area. */
static double total_numerical_error(const wt_friction_point *point, double shear)
{
    return point->hysteresis.numerical_error + shear * point->area_ratio.numerical_error;
}

static double relative_numerical_error(wt_estimate e)
{
    return e.numerical_error > 0 ? e.numerical_error / fabs(e.value) : 0;
}

static void summarise_friction(const friction_task *task, wt_friction_tables *t)
{
    const bool total = !isnan(task->sliding->shear_stress.value);
    const int kind = total ? TOTAL : HYSTERESIS;
    const size_t contacts = task->layer != NULL ? 2 : 1;
    cost_summary cost = {.items = (double)((task->n + task->drawn) * contacts),
                         .tolerance_asked = task->work->tolerance,
                         .number = {.value = kind_values(task->centre, task->n, kind)[task->n - 1],
                                    .standard_error = kind_values(task->replicates.error, task->n,
                                                                  kind)[task->n - 1]}};
    for (size_t i = 0; i < task->n; i++) {
        const wt_friction_point *p = &task->points[i];
        cost.error_estimated = fmax(cost.error_estimated, relative_numerical_error(p->hysteresis));
        if (p->extrapolated_share > t->extrapolated_share)
            t->extrapolated_share = p->extrapolated_share;
    }
    cost_report(task->work, cost);
}

static void update_worst_error(friction_task *task, const wt_friction_point *points)
{
    for (size_t i = 0; i < task->n; i++) {
        const wt_friction_point *p = &points[i];
        if (!p->meets_tolerance && !p->has_no_solution)
            task->worst =
                fmax(task->worst, fmax(relative_numerical_error(p->hysteresis),
                                       fmax(relative_numerical_error(p->area_ratio),
                                            relative_numerical_error(p->stress_variance))));
    }
}

/* Computes the results for the stated values. `c` receives the contact without a layer. */
static wt_status compute_nominal_friction(friction_task *task, sliding_contact *c, wt_error *err)
{
    const size_t last = task->n - 1;
    wt_status status = compute_bulk(task, WT_NO_REPLICATE, task->points, task->centre, c, err);
    if (status != WT_OK)
        return status;
    const double pressure = task->sliding->pressure.value, shear = c->shear_stress;
    task->strain = wt_friction_strain(c->workspace, c->roughness->q1);
    task->numerical[0] = total_numerical_error(&task->points[last], shear / pressure);
    update_worst_error(task, task->points);
    if (task->layer == NULL)
        return WT_OK;
    wt_friction_point *layered = wt_alloc(task->n, sizeof *layered);
    status = compute_layered(task, WT_NO_REPLICATE, layered, task->centre, err);
    if (status == WT_OK)
        status = sliding_layer_zero_loss_range(task->sliding, task->layer, task->work,
                                               task->zero_loss_range, err);
    if (status == WT_OK) {
        task->layer_outside = layered[last].extrapolated_share;
        task->numerical[1] = total_numerical_error(
            &layered[last],
            sliding_layer_shear_stress(task->layer, shear, replicate_layer(task, WT_NO_REPLICATE)) /
                pressure);
        update_worst_error(task, layered);
    }
    free(layered);
    return status;
}

/* Draws the replicates. If only inputs of the layer vary, results without the layer have no
 * standard error. */
static wt_status draw_friction_replicates(friction_task *task, wt_error *err)
{
    replicates *r = &task->replicates;
    const wt_layer_observation *layer = task->layer;
    if (!isnan(task->sliding->shear_stress.value))
        replicates_add(r, task->sliding->shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    const bool bulk_varies = r->varies;
    if (layer != NULL) {
        replicates_add(r, layer->thickness.standard_error, FLOW_DRAW_THICKNESS,
                       "thickness of the layer");
        replicates_add_layer(r, layer, "modulus ratio of the layer");
    }
    wt_status status = replicates_draw(r, N_KINDS * task->n, compute_friction_replicate, task, err);
    task->drawn = r->n * task->n;
    for (size_t i = 0; status == WT_OK && !bulk_varies && i < task->n; i++)
        kind_values(r->error, task->n, HYSTERESIS)[i] = kind_values(r->error, task->n, AREA)[i] =
            kind_values(r->error, task->n, SHEARING)[i] = kind_values(r->error, task->n, TOTAL)[i] =
                (double)NAN;
    return status;
}

wt_status wt_sliding_friction_compute(const wt_sliding *sliding, const wt_layer_observation *layer,
                                      const wt_job *work, wt_friction_tables *tables, wt_error *err)
{
    if (work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no friction job");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = check_layer_thickness(layer, err);
    if (status != WT_OK)
        return status;
    friction_task task = {.sliding = sliding,
                          .layer = layer,
                          .work = work,
                          .n = sliding->n_velocity + !is_only_reference(sliding),
                          .zero_loss_range = {(double)NAN, (double)NAN},
                          .replicates = replicates_create(sliding, work, "friction")};
    wt_friction_tables t = {0};
    sliding_contact c = {0};
    allocate_results(&task);
    status = compute_nominal_friction(&task, &c, err);
    if (status == WT_OK)
        status = draw_friction_replicates(&task, err);
    if (status == WT_OK)
        status = make_friction_table(&task, &c, &t.friction, err);
    if (status == WT_OK) {
        summarise_friction(&task, &t);
        *tables = t;
        t = (wt_friction_tables){0};
    }
    sliding_contact_clear(&c);
    wt_table_free(t.friction);
    free_results(&task);
    return status;
}
