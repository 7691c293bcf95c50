/* The friction job: hysteresis, contact area and total friction at every velocity, with and without
 * the modified layer, with standard errors from replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/conditions.h"
#include "flow/job/draws.h"
#include "flow/job/tables.h"

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

static wt_status add_rows(work *w, wt_table *table, wt_error *err)
{
    const wt_sliding *s = w->sliding;
    const wt_estimate shear = {s->shear_stress.value, 0, 0, "Pa"};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i + 1 < w->n; i++) {
        const wt_friction_point *p = &w->points[i];
        wt_estimate hysteresis = {p->hysteresis.value, 0, p->hysteresis.numerical_error, "1"};
        wt_estimate area = {p->area_ratio.value, 0, p->area_ratio.numerical_error, "1"};
        wt_estimate total = wt_friction_total(hysteresis, area, shear, s->pressure.value);
        status = wt_table_add_row(table, err);
        if (status != WT_OK)
            break;
        const double row[] = {p->velocity,
                              total.value,
                              slot(w->error, w->n, TOTAL)[i],
                              total.numerical_error,
                              p->hysteresis.value,
                              slot(w->error, w->n, HYSTERESIS)[i],
                              p->hysteresis.numerical_error,
                              total.value - p->hysteresis.value,
                              p->area_ratio.value,
                              slot(w->error, w->n, AREA)[i],
                              p->area_ratio.numerical_error,
                              slot(w->centre, w->n, LAYERED)[i],
                              slot(w->error, w->n, LAYERED)[i],
                              p->extrapolated_share};
        for (size_t c = 0; c < FLOW_COUNT(row); c++)
            wt_table_put(table, c, row[c]);
    }
    return status;
}

static wt_status layer_keys(work *w, wt_table *table, wt_error *err)
{
    size_t last = w->n - 1;
    const double *relative = slot(w->centre, w->n, RELATIVE);
    double low = relative[0], high = relative[0];
    for (size_t i = 1; i < last; i++) {
        low = fmin(low, relative[i]);
        high = fmax(high, relative[i]);
    }
    wt_status status = wt_table_set_estimate(table, "layer_thickness", w->layer->thickness, err);
    if (status == WT_OK)
        status = wt_table_set_estimate(table, "layer_modulus_ratio", w->layer->modulus_ratio, err);
    if (status == WT_OK)
        status = flow_table_value(table, "friction_with_layer_at_reference",
                                  slot(w->centre, w->n, LAYERED)[last],
                                  slot(w->error, w->n, LAYERED)[last], w->numerical[1], "1", err);
    if (status == WT_OK)
        status = flow_table_value(
            table, "friction_change_at_reference", slot(w->centre, w->n, CHANGE)[last],
            slot(w->error, w->n, CHANGE)[last], w->numerical[0] + w->numerical[1], "1", err);
    if (status == WT_OK)
        status = flow_table_value(
            table, "relative_change_at_reference", relative[last],
            slot(w->error, w->n, RELATIVE)[last],
            (w->numerical[0] + w->numerical[1]) / slot(w->centre, w->n, TOTAL)[last], "1", err);
    if (status == WT_OK)
        status = flow_table_value(table, "relative_change_low", low, (double)NAN, 0, "1", err);
    if (status == WT_OK)
        status = flow_table_value(table, "relative_change_high", high, (double)NAN, 0, "1", err);
    return status;
}

static wt_status set_keys(work *w, wt_table *table, const char *statement, wt_error *err)
{
    const wt_sliding *s = w->sliding;
    size_t last = w->n - 1;
    wt_estimate temperature = s->temperature;
    if (isnan(temperature.value))
        temperature.value = s->rubber->prony.reference_temperature;
    wt_status status = wt_table_set_estimate(table, "pressure", s->pressure, err);
    if (status == WT_OK)
        status = wt_table_set_estimate(table, "temperature", temperature, err);
    if (status == WT_OK)
        status = isnan(s->shear_stress.value)
                     ? wt_table_set_key(table, "shear_stress",
                                        "not given: only the hysteresis part is known", err)
                     : wt_table_set_estimate(table, "shear_stress", s->shear_stress, err);
    if (status == WT_OK)
        status = flow_table_key(table, err, "gamma", "%g", s->gamma);
    if (status == WT_OK)
        status = flow_table_value(table, "reference_velocity", w->velocity[last], 0, 0, "m/s", err);
    if (status == WT_OK)
        status =
            flow_table_value(table, "friction_at_reference", slot(w->centre, w->n, TOTAL)[last],
                             slot(w->error, w->n, TOTAL)[last], w->numerical[0], "1", err);
    if (status == WT_OK)
        status =
            flow_table_value(table, "hysteresis_at_reference", w->points[last].hysteresis.value,
                             slot(w->error, w->n, HYSTERESIS)[last],
                             w->points[last].hysteresis.numerical_error, "1", err);
    if (status == WT_OK)
        status = flow_table_value(
            table, "area_ratio_at_reference", w->points[last].area_ratio.value,
            slot(w->error, w->n, AREA)[last], w->points[last].area_ratio.numerical_error, "1", err);
    if (status == WT_OK)
        status = wt_table_set_key(
            table, "standard_error_includes",
            w->varies ? w->words : "nothing, for no error was measured or stated", err);
    if (status == WT_OK && w->lacks[0] != '\0')
        status = wt_table_set_key(table, "standard_error_lacks", w->lacks, err);
    if (status == WT_OK)
        status = flow_table_key(table, err, "replicates", "%zu", w->varies ? w->n_replicates : 0);
    if (status == WT_OK && statement[0] != '\0')
        status = wt_table_set_key(table, "material_statement", statement, err);
    if (status == WT_OK && w->layer != NULL)
        status = layer_keys(w, table, err);
    return status;
}

static wt_status friction_table(work *w, const char *statement, wt_table **out, wt_error *err)
{
    static const flow_column columns[] = {
        {"velocity", "m/s", "sliding velocity"},
        {"friction", "1", "friction coefficient, hysteresis and shearing of the real contact"},
        {"friction_standard_error", "1", "its standard error"},
        {"friction_numerical_error", "1", "its numerical error"},
        {"hysteresis", "1", "hysteresis friction"},
        {"hysteresis_standard_error", "1", "its standard error"},
        {"hysteresis_numerical_error", "1", "its numerical error"},
        {"adhesion", "1", "friction of shearing the real contact"},
        {"area_ratio", "1", "real over nominal contact area"},
        {"area_ratio_standard_error", "1", "its standard error"},
        {"area_ratio_numerical_error", "1", "its numerical error"},
        {"friction_with_layer", "1", "friction coefficient with the modified layer"},
        {"friction_with_layer_standard_error", "1", "its standard error"},
        {"extrapolated_share", "1", "share of the hysteresis from frequencies not measured"},
    };
    wt_table *table = NULL;
    wt_status status = flow_table_new("friction", "Friction against velocity", columns,
                                      FLOW_COUNT(columns), &table, err);
    if (status == WT_OK)
        status = add_rows(w, table, err);
    if (status == WT_OK)
        status = set_keys(w, table, statement, err);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *out = table;
    return WT_OK;
}

#define POINTS_PER_DECADE 20

static wt_status area_block(const flow_conditions *c, double velocity, const double *q, size_t n,
                            wt_friction_node *nodes, wt_table *table, wt_error *err)
{
    wt_status status = wt_friction_profile(c->workspace, c->pressure, velocity, q, n, nodes, err);
    if (status == WT_OK && wt_table_n_rows(table) > 0)
        status = wt_table_new_block(table, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        status = wt_table_add_row(table, err);
        if (status != WT_OK)
            break;
        const double row[] = {velocity, q[i] / c->roughness->q0, q[i], nodes[i].area_ratio,
                              nodes[i].hysteresis};
        for (size_t k = 0; k < FLOW_COUNT(row); k++)
            wt_table_put(table, k, row[k]);
    }
    return status;
}

/* Contact area against magnification at the slowest, the reference and the fastest velocity. */
static wt_status area_table(work *w, const flow_conditions *c, wt_table **out, wt_error *err)
{
    static const flow_column columns[] = {
        {"velocity", "m/s", "sliding velocity"},
        {"magnification", "1", "wavenumber over the smallest one"},
        {"wavenumber", "rad/m", "wavenumber up to which roughness is seen"},
        {"area_ratio", "1", "contact area seen at this magnification over the nominal area"},
        {"hysteresis", "1", "hysteresis friction up to this wavenumber"},
    };
    wt_table *table = NULL;
    double first = w->velocity[0], last = w->velocity[w->n - 2], middle = w->velocity[w->n - 1];
    double decades = log10(c->roughness->q1 / c->roughness->q0);
    size_t n = 2 + (size_t)ceil(decades * POINTS_PER_DECADE);
    double *q = malloc(n * sizeof *q);
    wt_friction_node *nodes = malloc(n * sizeof *nodes);
    wt_status status = WT_OK;
    if (q == NULL || nodes == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    for (size_t i = 0; i < n; i++)
        q[i] = c->roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
    q[n - 1] = c->roughness->q1;
    status = flow_table_new("contact_area", "Contact area against magnification", columns,
                            FLOW_COUNT(columns), &table, err);
    if (status == WT_OK)
        status = area_block(c, first, q, n, nodes, table, err);
    if (status == WT_OK && middle > first && middle < last)
        status = area_block(c, middle, q, n, nodes, table, err);
    if (status == WT_OK && last > first)
        status = area_block(c, last, q, n, nodes, table, err);
done:
    free(q);
    free(nodes);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *out = table;
    return WT_OK;
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

static wt_status check_layer(const wt_layer_known *layer, wt_error *err)
{
    if (layer == NULL)
        return WT_OK;
    if (!isfinite(layer->thickness.value) || layer->thickness.value < 0) {
        wt_fail(err, WT_E_RANGE, "friction needs a layer of finite thickness");
        wt_error_found(err, "%g m", layer->thickness.value);
        wt_error_advice(err, "without wear the layer grows without end: give a specific wear rate "
                             "or an observed thickness");
        return WT_E_RANGE;
    }
    if (!(layer->modulus_ratio.value > 0) || !isfinite(layer->modulus_ratio.value))
        return wt_fail(err, WT_E_RANGE, "the modulus ratio %g is not positive",
                       layer->modulus_ratio.value);
    return WT_OK;
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
    wt_status status = flow_sliding_check(sliding, err);
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
    t.tolerance_asked =
        common->tolerance > 0 ? common->tolerance : wt_friction_defaults().tolerance;
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
