/* Contact area against magnification for one contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "job/cost.h"

#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>

/* Creates the contact for the stated values, without a layer and without the extrapolated share. */
static wt_status create_contact(const wt_sliding *sliding, const wt_job *work, sliding_contact *c,
                                wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_job local_job = *work;
    local_job.left_out = WT_EXTRA_ALL;
    return sliding_contact_create(sliding, &local_job, WT_NO_REPLICATE, NULL, none, c, err);
}

/* ---- contact area ---------------------------------------------------------------------------- */

/* Resolution of a figure. */
#define CONTACT_POINTS_PER_DECADE 20

TABLE_ROW(contact_area, CONTACT_AREA, double velocity, magnification, wavenumber;
          wt_friction_node node;)

static void add_area_block(const sliding_contact *c, double velocity, const double *q, size_t n,
                           wt_friction_node *nodes, table_writer *t, cost_summary *cost)
{
    if (t->status == WT_OK)
        t->status = wt_friction_profile(c->workspace, c->pressure, velocity, q, n, nodes, t->err);
    table_block(t);
    for (size_t i = 0; t->status == WT_OK && i < n; i++) {
        TABLE_ADD(contact_area, t, velocity, q[i] / c->roughness->q0, q[i], nodes[i]);
        cost->items++;
        cost->error_estimated =
            fmax(cost->error_estimated, nodes[i].numerical_error / nodes[i].area_ratio);
    }
}

static void add_area_blocks(const wt_sliding *sliding, const sliding_contact *c, table_writer *t,
                            cost_summary *cost)
{
    const double first = sliding->velocity[0], last = sliding->velocity[sliding->n_velocity - 1],
                 middle = flow_reference_velocity(sliding);
    const double decades = log10(c->roughness->q1 / c->roughness->q0);
    const size_t n = 2 + (size_t)ceil(decades * CONTACT_POINTS_PER_DECADE);
    double *q = wt_alloc(n, sizeof *q);
    wt_friction_node *nodes = wt_alloc(n, sizeof *nodes);
    for (size_t i = 0; i < n; i++)
        q[i] = c->roughness->q0 * pow(10, decades * (double)i / (double)(n - 1));
    q[n - 1] = c->roughness->q1;
    add_area_block(c, first, q, n, nodes, t, cost);
    if (middle > first && middle < last)
        add_area_block(c, middle, q, n, nodes, t, cost);
    if (last > first)
        add_area_block(c, last, q, n, nodes, t, cost);
    free(q);
    free(nodes);
}

wt_status wt_contact_area_compute(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                  wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no contact area to make");
    sliding_contact c = {0};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = create_contact(sliding, work, &c, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&contact_area_schema, err);
    cost_summary cost = {.tolerance_asked = work->tolerance};
    add_area_blocks(sliding, &c, &t, &cost);
    cost_report(work, cost);
    sliding_contact_clear(&c);
    return table_end(&t, table);
}
