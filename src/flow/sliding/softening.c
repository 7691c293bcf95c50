/* What softening with strain does: friction and contact area with it and without it, and how much
 * of the friction comes from strains that its table does not know. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "flow/sliding/sliding_contact.h"
#include "flow/strain/softness.h"
#include "flow/work/cost.h"

#include "base/clocale.h"
#include "data/tables/rows.h"

#include <math.h>
#include <stdlib.h>

/* At one velocity. */
TABLE_ROW(softening, SOFTENING, wt_friction_point with, without; double below, above;
          /* shares of the hysteresis */)

TABLE_KEYS(softening, SOFTENING, char source[256], effect[192]; double strain_factor;
           wt_estimate strain, share_above;)

typedef struct effect {
    const wt_sliding *sliding;
    wt_job work;
    double *velocity;    /* [n] the reference last */
    softening_row *rows; /* [n] */
    wt_friction_point *points;
    size_t n;
    double strain; /* the largest */
    double range[2];
} effect;

static wt_status open_contact(const effect *e, bool softened, sliding_contact *c, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_sliding sliding = *e->sliding;
    if (!softened)
        sliding.softness = NULL;
    return sliding_contact_make(&sliding, &e->work, WT_NO_REPLICATE, NULL, none, c, err);
}

/* How much of the friction is there where the first strain of the table is met, and the last. */
static wt_status find_shares(effect *e, const sliding_contact *c, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < e->n && status == WT_OK; i++) {
        wt_friction_node nodes[2];
        softening_row *r = &e->rows[i];
        status =
            wt_friction_profile(c->workspace, c->pressure, e->velocity[i], e->range, 2, nodes, err);
        const double all = r->with.hysteresis.value;
        const double none = (double)NAN; /* of no friction there is no share */
        r->below = all > 0 ? fmin(fmax(nodes[0].hysteresis / all, 0), 1) : none;
        r->above = all > 0 ? fmin(fmax(1 - nodes[1].hysteresis / all, 0), 1) : none;
        if (all > 0 && !(e->range[1] < c->roughness->q1))
            r->above = 0; /* not met */
    }
    return status;
}

static wt_status compute_contact(effect *e, bool softened, wt_error *err)
{
    sliding_contact c = {0};
    wt_status status = open_contact(e, softened, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, e->velocity, e->n, e->points, err);
    for (size_t i = 0; status == WT_OK && i < e->n; i++)
        *(softened ? &e->rows[i].with : &e->rows[i].without) = e->points[i];
    if (status == WT_OK && softened) {
        e->strain = wt_friction_strain(c.workspace, c.roughness->q1);
        wt_friction_strained(c.workspace, e->range);
        status = find_shares(e, &c, err);
    }
    sliding_contact_clear(&c);
    return status;
}

static void say_change(const softening_row *r, char text[192])
{
    char velocity[32];
    wt_format_si(r->with.velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, 192,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against the moduli at "
                  "small strain",
                  velocity, 100 * (r->with.hysteresis.value / r->without.hysteresis.value - 1),
                  100 * (r->with.area_ratio.value / r->without.area_ratio.value - 1));
}

static wt_status make_table(const effect *e, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&softening_schema, err);
    double above = (double)NAN;
    size_t n_without = 0;
    for (size_t i = 0; i + 1 < e->n; i++) {
        softening_add_row(&t, &e->rows[i]);
        n_without += isnan(e->rows[i].above) ? 1 : 0;
    }
    for (size_t i = 0; i < e->n; i++)
        above = fmax(above, e->rows[i].above);
    if (n_without > 0)
        softening_set_print(&t, SOFTENING_KEY_UNKNOWN,
                            "%zu of %zu velocities have no hysteresis friction, of which there "
                            "could be a share",
                            n_without, e->n - 1);
    softening_keys keys = {.strain_factor = e->sliding->strain_factor,
                           .strain = {e->strain, (double)NAN, (double)NAN, NULL},
                           .share_above = {above, (double)NAN, (double)NAN, NULL}};
    softness_describe(e->sliding->softness, keys.source, sizeof keys.source);
    say_change(&e->rows[e->n - 1], keys.effect);
    softening_set_keys(&t, &keys);
    return table_end(&t, table);
}

static void say_cost(const effect *e, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance, .items = 2 * (double)e->n};
    for (size_t i = 0; i < e->n; i++) {
        const wt_estimate *h = &e->rows[i].with.hysteresis;
        if (h->value > 0)
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / h->value);
    }
    cost_say(work, cost);
}

wt_status wt_softening_make(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                            wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no softening to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && sliding->softness == NULL)
        status = wt_fail(err, WT_E_ARG, "the material does not soften with strain");
    if (status != WT_OK)
        return status;
    effect e = {.sliding = sliding, .work = *work, .n = sliding->n_velocity + 1};
    e.work.left_out = WT_EXTRAS;
    e.velocity = malloc(e.n * sizeof *e.velocity);
    e.rows = calloc(e.n, sizeof *e.rows);
    e.points = malloc(e.n * sizeof *e.points);
    if (e.velocity == NULL || e.rows == NULL || e.points == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i + 1 < e.n; i++)
        e.velocity[i] = sliding->velocity[i];
    if (status == WT_OK) {
        e.velocity[e.n - 1] = flow_reference_velocity(sliding);
        status = compute_contact(&e, true, err);
    }
    if (status == WT_OK)
        status = compute_contact(&e, false, err);
    if (status == WT_OK)
        status = make_table(&e, table, err);
    if (status == WT_OK)
        say_cost(&e, work);
    free(e.velocity);
    free(e.rows);
    free(e.points);
    return status;
}
