/* Effect of strain softening: friction and contact area with and without it, and the share of the
 * friction from strains outside the softening table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/strain_softening.h"
#include "friction/friction_difference.h"

#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>

/* Row of the table: both results at one velocity. */
TABLE_ROW(softening, SOFTENING, wt_friction_point with, without; double below, above;
          /* shares of the hysteresis from strains below and above the table */)

TABLE_KEYS(softening, SOFTENING, char source[256], effect[192]; double strain_factor;
           wt_estimate strain, share_above;)

/* Results of the contact with softening. */
typedef struct effect {
    softening_row *rows; /* [n] one for each velocity; the last is the reference */
    double strain;       /* largest strain */
    double range[2];
} effect;

/* Computes the share of the friction up to the first and beyond the last strain of the table. */
static wt_status compute_shares(void *user, const friction_difference *of, const sliding_contact *c,
                                wt_error *err)
{
    effect *e = user;
    wt_status status = WT_OK;
    e->strain = wt_friction_strain(c->workspace, c->roughness->q1);
    wt_friction_strain_range(c->workspace, e->range);
    for (size_t i = 0; i < of->n && status == WT_OK; i++) {
        wt_friction_node nodes[2];
        softening_row *r = &e->rows[i];
        status = wt_friction_profile(c->workspace, c->pressure, of->velocity[i], e->range, 2, nodes,
                                     err);
        const double all = of->with[i].hysteresis.value;
        const double none = (double)NAN; /* the share is undefined without friction */
        r->below = all > 0 ? fmin(fmax(nodes[0].hysteresis / all, 0), 1) : none;
        r->above = all > 0 ? fmin(fmax(1 - nodes[1].hysteresis / all, 0), 1) : none;
        if (all > 0 && !(e->range[1] < c->roughness->q1))
            r->above = 0; /* the last strain is not reached */
    }
    return status;
}

static wt_status tabulate_softening(const friction_difference *c, const effect *e, wt_table **table,
                                    wt_error *err)
{
    table_writer t = table_begin(&softening_schema, err);
    double above = (double)NAN;
    size_t n_without = 0;
    for (size_t i = 0; i < c->n; i++) {
        e->rows[i].with = c->with[i];
        e->rows[i].without = c->without[i];
        above = fmax(above, e->rows[i].above);
        if (i + 1 == c->n)
            break;
        softening_add_row(&t, &e->rows[i]);
        n_without += isnan(e->rows[i].above) ? 1 : 0;
    }
    if (n_without > 0)
        softening_set_print(&t, SOFTENING_KEY_UNKNOWN,
                            "%zu of %zu velocities have no hysteresis friction, of which there "
                            "could be a share",
                            n_without, c->n - 1);
    softening_keys keys = {.strain_factor = c->sliding->strain_factor,
                           .strain = {e->strain, (double)NAN, (double)NAN, NULL},
                           .share_above = {above, (double)NAN, (double)NAN, NULL}};
    strain_softening_describe(c->sliding->strain_softening, keys.source, sizeof keys.source);
    friction_difference_describe(&c->with[c->n - 1], &c->without[c->n - 1],
                                 "the moduli at small strain", keys.effect, sizeof keys.effect);
    softening_set_keys(&t, &keys);
    return table_end(&t, table);
}

wt_status wt_softened_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no softening to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && sliding->strain_softening == NULL)
        status = wt_fail(err, WT_E_ARG, "the material does not soften with strain");
    if (status != WT_OK)
        return status;
    friction_difference c = {.n = 0};
    wt_sliding without = *sliding;
    without.strain_softening = NULL;
    effect e = {.rows = wt_alloc(sliding->n_velocity + 1, sizeof *e.rows)};
    status = friction_difference_compute(sliding, &without, work, compute_shares, &e, &c, err);
    if (status == WT_OK)
        status = tabulate_softening(&c, &e, table, err);
    friction_difference_clear(&c);
    free(e.rows);
    return status;
}
