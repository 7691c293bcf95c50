/* The friction job: hysteresis, contact area and total friction at every velocity, with and without
 * the modified layer, with standard errors from replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/conditions.h"
#include "flow/job/draws.h"
#include "flow/job/tables.h"
#include "kernel/params.h"

#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What one replicate gives at the velocities (the reference one is the last). */
enum { HYSTERESIS, AREA, TOTAL, LAYERED, CHANGE, RELATIVE, N_KINDS };

typedef struct work {
    const wt_sliding *sliding;
    const wt_layer_known *layer; /* NULL = none */
    const wt_job *common;
    size_t n;                 /* velocities + 1 */
    double *velocity;         /* [n] */
    double *centre;           /* [N_KINDS * n] */
    double *replicate;        /* [replicates * N_KINDS * n] */
    double *error;            /* [N_KINDS * n] standard errors */
    double numerical[2];      /* of the total friction at the reference: without, with the layer */
    bool varies, bulk_varies; /* with, without the stated errors of the layer */
    char words[256], lacks[256];
    size_t n_replicates;
    wt_friction_point *points; /* [n] at the values themselves, without a layer */
} work;

static double *slot(double *values, size_t n, int kind)
{
    return values + (size_t)kind * n;
}

/* Total friction of the layer has its own shear stress: tau_s = tau_bulk x modulus ratio (L3). */
static wt_layer_state layer_of(const work *w, size_t replicate)
{
    wt_layer_state state = {.modulus_ratio = 1};
    if (w->layer == NULL)
        return state;
    uint64_t seed = w->common->seed;
    double thickness = flow_draw_value(w->layer->thickness, seed, replicate, FLOW_DRAW_THICKNESS);
    state.thickness = thickness > 0 ? thickness : 0;
    state.modulus_ratio = state.thickness > 0 ? flow_draw_positive(w->layer->modulus_ratio, seed,
                                                                   replicate, FLOW_DRAW_RATIO)
                                              : 1;
    return state;
}

static wt_status compute(const work *w, size_t replicate, double tolerance, unsigned threads,
                         wt_friction_point *points, double *out, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    flow_conditions c = {0};
    wt_status status = flow_conditions_make(w->sliding, w->common->seed, replicate, tolerance,
                                            threads, none, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, w->velocity, w->n, points, err);
    if (status != WT_OK)
        goto done;
    for (size_t i = 0; i < w->n; i++) {
        slot(out, w->n, HYSTERESIS)[i] = points[i].hysteresis.value;
        slot(out, w->n, AREA)[i] = points[i].area_ratio.value;
        slot(out, w->n, TOTAL)[i] =
            points[i].hysteresis.value + c.shear_stress * points[i].area_ratio.value / c.pressure;
        slot(out, w->n, LAYERED)[i] = (double)NAN;
        slot(out, w->n, CHANGE)[i] = (double)NAN;
        slot(out, w->n, RELATIVE)[i] = (double)NAN;
    }
done:
    flow_conditions_clear(&c);
    return status;
}

static wt_status compute_layered(const work *w, size_t replicate, double tolerance,
                                 unsigned threads, wt_friction_point *points, double *out,
                                 wt_error *err)
{
    wt_layer_state layer = layer_of(w, replicate);
    flow_conditions c = {0};
    wt_status status = flow_conditions_make(w->sliding, w->common->seed, replicate, tolerance,
                                            threads, layer, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, w->velocity, w->n, points, err);
    if (status != WT_OK)
        goto done;
    for (size_t i = 0; i < w->n; i++) {
        double with = points[i].hysteresis.value + layer.modulus_ratio * c.shear_stress *
                                                       points[i].area_ratio.value / c.pressure;
        double without = slot(out, w->n, TOTAL)[i];
        slot(out, w->n, LAYERED)[i] = with;
        slot(out, w->n, CHANGE)[i] = with - without;
        slot(out, w->n, RELATIVE)[i] = with / without - 1;
    }
done:
    flow_conditions_clear(&c);
    return status;
}

/* ---- replicates -------------------------------------------------------------------------------
 */

static wt_status one_replicate(void *user, size_t i, unsigned worker)
{
    (void)worker;
    work *w = user;
    double *out = w->replicate + i * N_KINDS * w->n;
    wt_friction_point *points = malloc(w->n * sizeof *points);
    if (points == NULL)
        return WT_E_MEMORY;
    wt_error ignored = WT_ERROR_INIT;
    wt_status status = compute(w, i, FLOW_REPLICATE_TOLERANCE, 1, points, out, &ignored);
    if (status == WT_OK && w->layer != NULL)
        status = compute_layered(w, i, FLOW_REPLICATE_TOLERANCE, 1, points, out, &ignored);
    free(points);
    if (status == WT_OK || status == WT_E_MEMORY)
        return status;
    for (size_t k = 0; k < N_KINDS * w->n; k++)
        out[k] = (double)NAN; /* a draw that has no solution is left out and counted */
    return WT_OK;
}

static wt_status replicate_all(work *w, wt_error *err)
{
    size_t stride = N_KINDS * w->n;
    for (size_t k = 0; k < stride; k++)
        w->error[k] = (double)NAN;
    if (!w->varies)
        return WT_OK;
    wt_status status = wt_parallel_for(w->n_replicates, w->common->threads, one_replicate, w,
                                       &w->common->progress, "friction replicates");
    if (status != WT_OK)
        return wt_fail(err, status, "the replicates of the friction failed");
    size_t lost = 0;
    for (size_t i = 0; i < w->n_replicates; i++)
        lost += isnan(w->replicate[i * stride]) != 0;
    if (lost > 0)
        wt_parselog_add(w->common->log, WT_WARNING, NULL, NULL,
                        "%zu of %zu replicates of the friction have no solution and are left out "
                        "of the standard errors",
                        lost, w->n_replicates);
    for (size_t k = 0; k < stride; k++)
        w->error[k] = flow_spread(w->replicate + k, w->n_replicates, stride);
    for (size_t i = 0; !w->bulk_varies && i < w->n; i++)
        slot(w->error, w->n, HYSTERESIS)[i] = slot(w->error, w->n, AREA)[i] =
            slot(w->error, w->n, TOTAL)[i] = (double)NAN;
    return WT_OK;
}

/* ---- tables -----------------------------------------------------------------------------------
 */

static void add_rows(work *w, table_writer *t)
{
    const wt_sliding *s = w->sliding;
    const wt_estimate shear = {s->shear_stress.value, 0, 0, "Pa"};
    for (size_t i = 0; i + 1 < w->n; i++) {
        const wt_friction_point *p = &w->points[i];
        wt_estimate hysteresis = {p->hysteresis.value, 0, p->hysteresis.numerical_error, "1"};
        wt_estimate area = {p->area_ratio.value, 0, p->area_ratio.numerical_error, "1"};
        wt_estimate total = wt_friction_total(hysteresis, area, shear, s->pressure.value);
        table_row(t);
        friction_put(t, FRICTION_VELOCITY, p->velocity);
        friction_put(t, FRICTION_TOTAL, total.value);
        friction_put(t, FRICTION_TOTAL_STANDARD_ERROR, slot(w->error, w->n, TOTAL)[i]);
        friction_put(t, FRICTION_TOTAL_NUMERICAL_ERROR, total.numerical_error);
        friction_put(t, FRICTION_HYSTERESIS, hysteresis.value);
        friction_put(t, FRICTION_HYSTERESIS_STANDARD_ERROR, slot(w->error, w->n, HYSTERESIS)[i]);
        friction_put(t, FRICTION_HYSTERESIS_NUMERICAL_ERROR, hysteresis.numerical_error);
        friction_put(t, FRICTION_ADHESION, total.value - hysteresis.value);
        friction_put(t, FRICTION_AREA_RATIO, area.value);
        friction_put(t, FRICTION_AREA_RATIO_STANDARD_ERROR, slot(w->error, w->n, AREA)[i]);
        friction_put(t, FRICTION_AREA_RATIO_NUMERICAL_ERROR, area.numerical_error);
        friction_put(t, FRICTION_WITH_LAYER, slot(w->centre, w->n, LAYERED)[i]);
        friction_put(t, FRICTION_WITH_LAYER_STANDARD_ERROR, slot(w->error, w->n, LAYERED)[i]);
        friction_put(t, FRICTION_EXTRAPOLATED_SHARE, p->extrapolated_share);
    }
}

/* A number of the reference velocity, the last one. */
static void set_at_reference(work *w, table_writer *t, friction_key key, int kind,
                             double numerical_error)
{
    const size_t last = w->n - 1;
    friction_set_value(t, key, slot(w->centre, w->n, kind)[last], slot(w->error, w->n, kind)[last],
                       numerical_error);
}

static void set_layer_keys(work *w, table_writer *t)
{
    const size_t last = w->n - 1;
    const double *relative = slot(w->centre, w->n, RELATIVE);
    double low = relative[0], high = relative[0], both = w->numerical[0] + w->numerical[1];
    for (size_t i = 1; i < last; i++) {
        low = fmin(low, relative[i]);
        high = fmax(high, relative[i]);
    }
    friction_set(t, FRICTION_KEY_LAYER_THICKNESS, w->layer->thickness);
    friction_set(t, FRICTION_KEY_LAYER_MODULUS_RATIO, w->layer->modulus_ratio);
    set_at_reference(w, t, FRICTION_KEY_WITH_LAYER, LAYERED, w->numerical[1]);
    set_at_reference(w, t, FRICTION_KEY_CHANGE, CHANGE, both);
    set_at_reference(w, t, FRICTION_KEY_RELATIVE_CHANGE, RELATIVE,
                     both / slot(w->centre, w->n, TOTAL)[last]);
    friction_set_value(t, FRICTION_KEY_RELATIVE_CHANGE_LOW, low, (double)NAN, 0);
    friction_set_value(t, FRICTION_KEY_RELATIVE_CHANGE_HIGH, high, (double)NAN, 0);
}

static void set_keys(work *w, table_writer *t, const char *statement)
{
    const wt_sliding *s = w->sliding;
    const wt_friction_point *reference = &w->points[w->n - 1];
    wt_estimate temperature = s->temperature;
    if (isnan(temperature.value))
        temperature.value = s->rubber->prony.reference_temperature;
    friction_set(t, FRICTION_KEY_PRESSURE, s->pressure);
    friction_set(t, FRICTION_KEY_TEMPERATURE, temperature);
    if (isnan(s->shear_stress.value))
        friction_set_text(t, FRICTION_KEY_SHEAR_STRESS,
                          "not given: only the hysteresis part is known");
    else
        friction_set(t, FRICTION_KEY_SHEAR_STRESS, s->shear_stress);
    friction_set_print(t, FRICTION_KEY_GAMMA, "%g", s->gamma);
    friction_set_value(t, FRICTION_KEY_REFERENCE_VELOCITY, w->velocity[w->n - 1], 0, 0);
    set_at_reference(w, t, FRICTION_KEY_FRICTION, TOTAL, w->numerical[0]);
    set_at_reference(w, t, FRICTION_KEY_HYSTERESIS, HYSTERESIS,
                     reference->hysteresis.numerical_error);
    set_at_reference(w, t, FRICTION_KEY_AREA_RATIO, AREA, reference->area_ratio.numerical_error);
    friction_set_text(t, FRICTION_KEY_ERROR_INCLUDES,
                      w->varies ? w->words : "nothing, for no error was measured or stated");
    if (w->lacks[0] != '\0')
        friction_set_text(t, FRICTION_KEY_ERROR_LACKS, w->lacks);
    friction_set_print(t, FRICTION_KEY_REPLICATES, "%zu", w->varies ? w->n_replicates : 0);
    if (statement[0] != '\0')
        friction_set_text(t, FRICTION_KEY_MATERIAL_STATEMENT, statement);
    if (w->layer != NULL)
        set_layer_keys(w, t);
}

static wt_status friction_table(work *w, const char *statement, wt_table **out, wt_error *err)
{
    table_writer t = table_begin(&friction_schema, "", err);
    add_rows(w, &t);
    set_keys(w, &t, statement);
    return table_end(&t, out);
}

#define POINTS_PER_DECADE 20

static void add_area_block(const flow_conditions *c, double velocity, const double *q, size_t n,
                           wt_friction_node *nodes, table_writer *t)
{
    if (t->status == WT_OK)
        t->status = wt_friction_profile(c->workspace, c->pressure, velocity, q, n, nodes, t->err);
    table_block(t);
    for (size_t i = 0; t->status == WT_OK && i < n; i++) {
        table_row(t);
        contact_area_put(t, CONTACT_AREA_VELOCITY, velocity);
        contact_area_put(t, CONTACT_AREA_MAGNIFICATION, q[i] / c->roughness->q0);
        contact_area_put(t, CONTACT_AREA_WAVENUMBER, q[i]);
        contact_area_put(t, CONTACT_AREA_AREA_RATIO, nodes[i].area_ratio);
        contact_area_put(t, CONTACT_AREA_HYSTERESIS, nodes[i].hysteresis);
    }
}

/* Contact area against magnification at the slowest, the reference and the fastest velocity. */
static wt_status area_table(work *w, const flow_conditions *c, wt_table **out, wt_error *err)
{
    double first = w->velocity[0], last = w->velocity[w->n - 2], middle = w->velocity[w->n - 1];
    double decades = log10(c->roughness->q1 / c->roughness->q0);
    size_t n = 2 + (size_t)ceil(decades * POINTS_PER_DECADE);
    double *q = malloc(n * sizeof *q);
    wt_friction_node *nodes = malloc(n * sizeof *nodes);
    table_writer t = table_begin(&contact_area_schema, "", err);
    if (q == NULL || nodes == NULL) {
        t.status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    for (size_t i = 0; i < n; i++)
        q[i] = c->roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
    q[n - 1] = c->roughness->q1;
    add_area_block(c, first, q, n, nodes, &t);
    if (middle > first && middle < last)
        add_area_block(c, middle, q, n, nodes, &t);
    if (last > first)
        add_area_block(c, last, q, n, nodes, &t);
done:
    free(q);
    free(nodes);
    return table_end(&t, out);
}

/* ---- the job ----------------------------------------------------------------------------------
 */

static wt_status allocate(work *w, wt_error *err)
{
    size_t stride = N_KINDS * w->n;
    w->velocity = malloc(w->n * sizeof *w->velocity);
    w->centre = malloc(stride * sizeof *w->centre);
    w->error = malloc(stride * sizeof *w->error);
    w->points = malloc(w->n * sizeof *w->points);
    w->replicate = calloc(w->varies ? w->n_replicates : 1, stride * sizeof *w->replicate);
    if (w->velocity == NULL || w->centre == NULL || w->error == NULL || w->points == NULL ||
        w->replicate == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    memcpy(w->velocity, w->sliding->velocity, (w->n - 1) * sizeof *w->velocity);
    w->velocity[w->n - 1] = flow_reference_velocity(w->sliding);
    return WT_OK;
}

static void release(work *w)
{
    free(w->velocity);
    free(w->centre);
    free(w->error);
    free(w->points);
    free(w->replicate);
}

static wt_layer_known no_layer(void)
{
    return (wt_layer_known){.thickness = {0, 0, 0, "m"}, .modulus_ratio = {1, 0, 0, "1"}};
}

static const wt_param rows[] = {LAYER_STATE_ROWS(wt_layer_known, )};
PARAM_TABLE(wt_layer_known_params, wt_layer_known, rows, no_layer, NO_PARTS)

static wt_status check_layer(const wt_layer_known *layer, wt_error *err)
{
    if (layer == NULL)
        return WT_OK;
    if (isinf(layer->thickness.value)) {
        wt_fail(err, WT_E_RANGE, "friction needs a layer of finite thickness");
        wt_error_found(err, "%g m", layer->thickness.value);
        wt_error_advice(err, "without wear the layer grows without end: give a specific wear rate "
                             "or an observed thickness");
        return WT_E_RANGE;
    }
    return param_check(wt_layer_known_params(), layer, err);
}

/* Numerical error of hysteresis + shear x area. */
static double total_error(const wt_friction_point *point, double shear)
{
    return point->hysteresis.numerical_error + shear * point->area_ratio.numerical_error;
}

static void summarise(const work *w, wt_friction_tables *t)
{
    for (size_t i = 0; i < w->n; i++) {
        const wt_friction_point *p = &w->points[i];
        double relative = p->hysteresis.numerical_error / fabs(p->hysteresis.value);
        if (relative > t->error_reached)
            t->error_reached = relative;
        if (p->extrapolated_share > t->extrapolated_share)
            t->extrapolated_share = p->extrapolated_share;
    }
    t->n_points = w->n * (1 + (w->varies ? w->n_replicates : 0)) * (w->layer != NULL ? 2 : 1);
}

wt_status wt_friction_make(const wt_sliding *sliding, const wt_layer_known *layer,
                           const wt_job *common, wt_friction_tables *tables, wt_error *err)
{
    if (common == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no friction job");
    wt_friction_tables t = {0};
    flow_conditions c = {0};
    wt_friction_point *layered = NULL;
    work w = {.sliding = sliding, .layer = layer, .common = common};
    wt_status status = flow_sliding_check(sliding, common, err);
    if (status == WT_OK)
        status = check_layer(layer, err);
    if (status != WT_OK)
        return status;
    w.n = sliding->n_velocity + 1;
    w.n_replicates = common->replicates;
    w.bulk_varies = flow_conditions_vary(sliding, common, w.words, sizeof w.words);
    if (common->replicates > 1 && sliding->shear_stress.standard_error > 0) {
        flow_add_words(w.words, sizeof w.words, "shear stress");
        w.bulk_varies = true;
    }
    w.varies = w.bulk_varies;
    flow_conditions_lack(sliding, w.lacks, sizeof w.lacks);
    if (!isnan(sliding->shear_stress.value) && !(sliding->shear_stress.standard_error > 0))
        flow_add_words(w.lacks, sizeof w.lacks, "shear stress");
    if (layer != NULL && common->replicates > 1 &&
        (layer->thickness.standard_error > 0 || layer->modulus_ratio.standard_error > 0)) {
        flow_add_words(w.words, sizeof w.words, "thickness and modulus ratio of the layer");
        w.varies = true;
    }
    t.tolerance_asked = common->tolerance;
    status = allocate(&w, err);
    if (status == WT_OK)
        status =
            compute(&w, FLOW_CENTRE, common->tolerance, common->threads, w.points, w.centre, err);
    if (status == WT_OK && layer != NULL) {
        layered = malloc(w.n * sizeof *layered);
        status = layered == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                                 : compute_layered(&w, FLOW_CENTRE, common->tolerance,
                                                   common->threads, layered, w.centre, err);
    }
    if (status == WT_OK) {
        double shear = sliding->shear_stress.value / sliding->pressure.value;
        w.numerical[0] = total_error(&w.points[w.n - 1], shear);
        if (layered != NULL)
            w.numerical[1] =
                total_error(&layered[w.n - 1], shear * layer_of(&w, FLOW_CENTRE).modulus_ratio);
        status = replicate_all(&w, err);
    }
    if (status == WT_OK) {
        const wt_layer_state none = {.modulus_ratio = 1};
        status = flow_conditions_make(sliding, common->seed, FLOW_CENTRE, common->tolerance,
                                      common->threads, none, &c, err);
    }
    if (status == WT_OK)
        status = friction_table(&w, c.statement, &t.friction, err);
    if (status == WT_OK)
        status = area_table(&w, &c, &t.contact_area, err);
    if (status == WT_OK) {
        summarise(&w, &t);
        *tables = t;
        t = (wt_friction_tables){0};
    }
    free(layered);
    flow_conditions_clear(&c);
    wt_friction_tables_clear(&t);
    release(&w);
    return status;
}

void wt_friction_tables_clear(wt_friction_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->friction);
    wt_table_free(tables->contact_area);
    *tables = (wt_friction_tables){0};
}
