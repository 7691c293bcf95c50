/* Effect of transverse isotropy: friction and contact area with and without the directional factors
 * of the moduli.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "job/cost.h"

#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE, LOSS, STORAGE, BOTH, N_FACTOR_SETS };

static const struct {
    const char *words;
    bool storage, loss;
    transverse_isotropy_key key;
} factor_sets[N_FACTOR_SETS] = {
    [NONE] = {"none", false, false, TRANSVERSE_ISOTROPY_KEY_LEFT_OUT},
    [LOSS] = {"loss", false, true, TRANSVERSE_ISOTROPY_KEY_LOSS},
    [STORAGE] = {"storage", true, false, TRANSVERSE_ISOTROPY_KEY_STORAGE},
    [BOTH] = {"both", true, true, TRANSVERSE_ISOTROPY_KEY_BOTH}};

typedef struct directions {
    const wt_sliding *sliding;
    wt_job work;
    wt_friction_point
        *points; /* [N_FACTOR_SETS * n] the last of each n is the reference velocity */
    size_t n;
    bool is_computed[N_FACTOR_SETS];
    char left_out[256];
} directions;

static wt_transverse select_factors(const wt_transverse *given, size_t k)
{
    wt_transverse t = *given;
    if (!factor_sets[k].storage)
        t.axial_storage = t.plane_storage = t.shear_storage = 1;
    if (!factor_sets[k].loss)
        t.axial_loss = t.plane_loss = t.shear_loss = 1;
    return t;
}

static wt_status compute_factor_set(directions *d, size_t k, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_rubber rubber = *d->sliding->rubber;
    wt_sliding sliding = *d->sliding;
    wt_friction_point *points = d->points + k * d->n;
    const double reference = flow_reference_velocity(&sliding);
    sliding_contact c = {0};
    rubber.transverse = select_factors(&rubber.transverse, k);
    sliding.rubber = &rubber;
    wt_status status =
        sliding_contact_create(&sliding, &d->work, WT_NO_REPLICATE, NULL, none, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, sliding.velocity, sliding.n_velocity,
                                     points, err);
    if (status == WT_OK)
        status =
            wt_friction_compute(c.workspace, c.pressure, &reference, 1, &points[d->n - 1], err);
    sliding_contact_clear(&c);
    return status;
}

/* Computes all sets of factors. The full set must be a valid material; a partial set may be
 * invalid. */
static wt_status compute_factor_sets(directions *d, wt_error *err)
{
    for (size_t k = N_FACTOR_SETS; k-- > 0;) {
        wt_error failure = WT_ERROR_INIT;
        const wt_status status = compute_factor_set(d, k, &failure);
        d->is_computed[k] = status == WT_OK;
        if (status == WT_OK)
            continue;
        if (k == BOTH || status == WT_E_MEMORY) {
            if (err != NULL)
                *err = failure;
            return status;
        }
        const size_t used = strlen(d->left_out);
        snprintf(d->left_out + used, sizeof d->left_out - used, "%s%s: %.100s",
                 used > 0 ? "; " : "", factor_sets[k].words, failure.message);
    }
    return WT_OK;
}

TABLE_ROW(transverse_isotropy, TRANSVERSE_ISOTROPY, const char *factors; wt_friction_point point;)

static void add_points(const directions *d, size_t k, table_writer *t)
{
    table_block(t);
    for (size_t i = 0; i + 1 < d->n; i++)
        TABLE_ADD(transverse_isotropy, t, factor_sets[k].words, d->points[k * d->n + i]);
}

static void describe_factor_change(const directions *d, size_t k, table_writer *t)
{
    const wt_friction_point *p = &d->points[k * d->n + d->n - 1], *none = &d->points[d->n - 1];
    char text[192], velocity[32];
    wt_format_si(p->velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, sizeof text,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against the isotropic "
                  "material",
                  velocity, 100 * (p->hysteresis.value / none->hysteresis.value - 1),
                  100 * (p->area_ratio.value / none->area_ratio.value - 1));
    transverse_isotropy_set_text(t, factor_sets[k].key, text);
}

static wt_status tabulate_transverse_isotropy(const directions *d, wt_table **table, wt_error *err)
{
    char material[512];
    table_writer t = table_begin(&transverse_isotropy_schema, err);
    for (size_t k = 0; k < N_FACTOR_SETS; k++)
        if (d->is_computed[k])
            add_points(d, k, &t);
    (void)wt_rubber_describe(d->sliding->rubber, material, sizeof material);
    transverse_isotropy_set_text(&t, TRANSVERSE_ISOTROPY_KEY_MATERIAL, material);
    for (size_t k = LOSS; k < N_FACTOR_SETS; k++)
        if (d->is_computed[NONE] && d->is_computed[k])
            describe_factor_change(d, k, &t);
    if (d->left_out[0] != '\0')
        transverse_isotropy_set_text(&t, TRANSVERSE_ISOTROPY_KEY_LEFT_OUT, d->left_out);
    return table_end(&t, table);
}

static void report_directions_cost(const directions *d, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance};
    for (size_t k = 0; k < N_FACTOR_SETS; k++)
        for (size_t i = 0; d->is_computed[k] && i < d->n; i++) {
            const wt_estimate *h = &d->points[k * d->n + i].hysteresis;
            cost.items++;
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / fabs(h->value));
        }
    cost_report(work, cost);
}

wt_status wt_transverse_isotropy_compute(const wt_sliding *sliding, const wt_job *work,
                                         wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no directions to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !sliding->rubber->is_transverse)
        status = wt_fail(err, WT_E_ARG, "the material has no directions");
    if (status != WT_OK)
        return status;
    directions d = {.sliding = sliding, .work = *work, .n = sliding->n_velocity + 1};
    d.work.left_out = WT_EXTRA_ALL;
    d.work.drawn = NULL; /* the cache is for another material */
    d.points = wt_alloc(N_FACTOR_SETS * d.n, sizeof *d.points);
    status = compute_factor_sets(&d, err);
    if (status == WT_OK)
        status = tabulate_transverse_isotropy(&d, table, err);
    if (status == WT_OK)
        report_directions_cost(&d, work);
    free(d.points);
    return status;
}
