/* Contact area and friction by length scale: against the magnification, and by decades of the
 * wavenumber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"

#include <math.h>
#include <stdlib.h>

/* ---- contact area ---------------------------------------------------------------------------- */

/* Resolution of a figure. */
#define CONTACT_POINTS_PER_DECADE 20

TABLE_ROW(contact_area, CONTACT_AREA, double velocity, magnification, wavenumber;
          wt_friction_node node; double isotropic;)

/* nodes: [2 n] The second half is of the isotropic rubber, if there is such a contact. */
static void add_area_block(const sliding_contact *c, const sliding_contact *isotropic,
                           double velocity, const double *q, size_t n, wt_friction_node *nodes,
                           table_writer *t, cost_summary *cost)
{
    if (t->status == WT_OK)
        t->status = wt_friction_profile(c->workspace, c->pressure, velocity, q, n, nodes, t->err);
    if (t->status == WT_OK && isotropic != NULL)
        t->status = wt_friction_profile(isotropic->workspace, c->pressure, velocity, q, n,
                                        nodes + n, t->err);
    table_block(t);
    for (size_t i = 0; t->status == WT_OK && i < n; i++) {
        TABLE_ADD(contact_area, t, velocity, q[i] / c->roughness->q0, q[i], nodes[i],
                  isotropic != NULL ? nodes[n + i].area_ratio : (double)NAN);
        cost->items++;
        cost->error_estimated =
            fmax(cost->error_estimated, nodes[i].numerical_error / nodes[i].area_ratio);
    }
}

static void add_area_blocks(const wt_sliding *sliding, const sliding_contact *c,
                            const sliding_contact *isotropic, table_writer *t, cost_summary *cost)
{
    const double first = sliding->velocity[0], last = sliding->velocity[sliding->n_velocity - 1],
                 middle = flow_reference_velocity(sliding);
    const double decades = log10(c->roughness->q1 / c->roughness->q0);
    const size_t n = 2 + (size_t)ceil(decades * CONTACT_POINTS_PER_DECADE);
    double *q = wt_alloc(n, sizeof *q);
    wt_friction_node *nodes = wt_alloc(2 * n, sizeof *nodes);
    for (size_t i = 0; i < n; i++)
        q[i] = c->roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
    q[n - 1] = c->roughness->q1;
    add_area_block(c, isotropic, first, q, n, nodes, t, cost);
    if (middle > first && middle < last)
        add_area_block(c, isotropic, middle, q, n, nodes, t, cost);
    if (last > first)
        add_area_block(c, isotropic, last, q, n, nodes, t, cost);
    free(q);
    free(nodes);
}

/* The same rubber without its factors along the directions. */
static wt_status create_isotropic_contact(const wt_sliding *sliding, const wt_job *work,
                                          sliding_contact *contact, wt_error *err)
{
    wt_rubber rubber = *sliding->rubber;
    wt_sliding isotropic = *sliding;
    wt_job own = *work;
    rubber.is_transverse = false;
    isotropic.rubber = &rubber;
    own.drawn = NULL; /* the cache is for another material */
    return sliding_contact_create_stated(&isotropic, &own, contact, err);
}

wt_status wt_contact_area_compute(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                  wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no contact area to make");
    sliding_contact c = {0}, isotropic = {0};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status != WT_OK)
        return status;
    const bool transverse = sliding->rubber->is_transverse;
    status = sliding_contact_create_stated(sliding, work, &c, err);
    if (status == WT_OK && transverse)
        status = create_isotropic_contact(sliding, work, &isotropic, err);
    if (status == WT_OK) {
        table_writer t = table_begin(&contact_area_schema, err);
        cost_summary cost = {.tolerance_asked = work->tolerance};
        add_area_blocks(sliding, &c, transverse ? &isotropic : NULL, &t, &cost);
        cost_report(work, cost);
        status = table_end(&t, table);
    }
    sliding_contact_clear(&isotropic);
    sliding_contact_clear(&c);
    return status;
}

/* ---- decades -------------------------------------------------------------------------------- */

TABLE_ROW(friction_decades, FRICTION_DECADES, double velocity, from, to, share;
          wt_estimate hysteresis, area_ratio; double shearing, total;)

TABLE_KEYS(friction_decades, FRICTION_DECADES, char strongest[160];)

/* Limits of the decades: q0, the powers of ten in between, q1. */
typedef struct decade_contributions {
    size_t n;
    double *q;               /* [n] */
    wt_friction_node *nodes; /* [n] */
    char strongest[160];
} decade_contributions;

static void find_decade_edges(const wt_roughness *spectrum, decade_contributions *d)
{
    /* a power of ten that differs from a limit by rounding only is that limit */
    const double slack = 1e-9;
    const int first = (int)floor(log10(spectrum->q0) + slack) + 1,
              last = (int)ceil(log10(spectrum->q1) - slack) - 1;
    const size_t inner = last >= first ? (size_t)(last - first + 1) : 0;
    d->q = wt_alloc(inner + 2, sizeof *d->q);
    d->nodes = wt_alloc(inner + 2, sizeof *d->nodes);
    d->q[d->n++] = spectrum->q0;
    for (int k = first; k <= last; k++)
        d->q[d->n++] = pow(10, k);
    d->q[d->n++] = spectrum->q1;
}

static void describe_strongest(decade_contributions *d, double velocity, size_t i, double share)
{
    char speed[32];
    wt_format_si(velocity, "m/s", 3, speed, sizeof speed);
    clocale_print(d->strongest, sizeof d->strongest,
                  "%s rad/m, wavelengths of %s um, at %s: %.0f %% of the "
                  "hysteresis friction",
                  format_range(d->q[i - 1], d->q[i], 3).text,
                  format_range(2e6 * M_PI / d->q[i], 2e6 * M_PI / d->q[i - 1], 3).text, speed,
                  100 * share);
}

static void add_decade_rows(const sliding_contact *c, decade_contributions *d, double velocity,
                            bool is_reference, table_writer *t, cost_summary *cost)
{
    double most = -1;
    if (t->status == WT_OK)
        t->status =
            wt_friction_profile(c->workspace, c->pressure, velocity, d->q, d->n, d->nodes, t->err);
    table_block(t);
    for (size_t i = 1; t->status == WT_OK && i < d->n; i++) {
        const wt_friction_node *a = &d->nodes[i - 1], *b = &d->nodes[i];
        const double all = d->nodes[d->n - 1].hysteresis;
        const double part = b->hysteresis - a->hysteresis;
        const double share = all > 0 ? part / all : (double)NAN; /* the share is undefined without
                                                                    hysteresis friction */
        const double shearing = c->shear_stress * b->area_ratio / c->pressure;
        friction_decades_row row = {
            .velocity = velocity,
            .from = d->q[i - 1],
            .to = d->q[i],
            .share = share,
            .hysteresis = {part, (double)NAN, a->hysteresis_error + b->hysteresis_error, "1"},
            .area_ratio = {b->area_ratio, (double)NAN, b->numerical_error, "1"},
            .shearing = shearing,
            .total = b->hysteresis + shearing};
        friction_decades_add_row(t, &row);
        cost->items++;
        if (all > 0)
            cost->error_estimated = fmax(cost->error_estimated, b->hysteresis_error / all);
        if (is_reference && share > most) {
            most = share;
            describe_strongest(d, velocity, i, share);
        }
    }
}

static void add_velocity_blocks(const wt_sliding *sliding, const sliding_contact *c,
                                decade_contributions *d, table_writer *t, cost_summary *cost)
{
    const double first = sliding->velocity[0], last = sliding->velocity[sliding->n_velocity - 1],
                 reference = flow_reference_velocity(sliding);
    if (first < reference)
        add_decade_rows(c, d, first, false, t, cost);
    add_decade_rows(c, d, reference, true, t, cost);
    if (last > reference)
        add_decade_rows(c, d, last, false, t, cost);
}

wt_status wt_friction_by_scale_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no decades to make");
    sliding_contact c = {0};
    decade_contributions d = {.n = 0};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = sliding_contact_create_stated(sliding, work, &c, err);
    if (status == WT_OK) {
        find_decade_edges(c.roughness, &d);
        table_writer t = table_begin(&friction_decades_schema, err);
        cost_summary cost = {.tolerance_asked = work->tolerance};
        add_velocity_blocks(sliding, &c, &d, &t, &cost);
        friction_decades_keys keys;
        snprintf(keys.strongest, sizeof keys.strongest, "%s",
                 d.strongest[0] != '\0' ? d.strongest : "none: there is no hysteresis friction");
        friction_decades_set_keys(&t, &keys);
        cost_report(work, cost);
        status = table_end(&t, table);
    }
    sliding_contact_clear(&c);
    free(d.q);
    free(d.nodes);
    return status;
}
