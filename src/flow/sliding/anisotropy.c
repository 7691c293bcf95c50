/* What the direction of sliding over anisotropic roughness does: friction, contact area and the
 * force to the side with it, and the first two without. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "flow/sliding/anisotropy.h"
#include "flow/sliding/sliding_contact.h"
#include "flow/work/cost.h"
#include "kernel/angular_weight.h"

#include "base/clocale.h"
#include "data/tables/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* At one velocity. */
TABLE_ROW(anisotropy, ANISOTROPY, wt_friction_point with, without;)

TABLE_KEYS(anisotropy, ANISOTROPY, char texture[192], effect[320]; wt_estimate side;)

typedef struct sides {
    const wt_sliding *sliding;
    wt_job work;
    double *velocity;     /* [n] the reference last */
    anisotropy_row *rows; /* [n] */
    wt_friction_point *points;
    size_t n;
} sides;

static wt_status compute_sides(sides *s, bool anisotropic, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_sliding sliding = *s->sliding;
    sliding_contact c = {0};
    if (!anisotropic)
        sliding.anisotropy = (wt_anisotropy){{0}, {0}};
    wt_status status =
        sliding_contact_make(&sliding, &s->work, WT_NO_REPLICATE, NULL, none, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, s->velocity, s->n, s->points, err);
    for (size_t i = 0; status == WT_OK && i < s->n; i++)
        *(anisotropic ? &s->rows[i].with : &s->rows[i].without) = s->points[i];
    sliding_contact_clear(&c);
    return status;
}

void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS && used < size; k++)
        if (anisotropy->amplitude[k] != 0) {
            clocale_print(text + used, size - used, "%s%.4g cos %zu(phi - %.4g deg)",
                          used > 0 ? " + " : "", anisotropy->amplitude[k], 2 * (k + 1),
                          anisotropy->angle[k] * 180 / M_PI);
            used = strlen(text);
        }
}

static void say_effect(const anisotropy_row *r, char *text, size_t size)
{
    char velocity[32];
    const double mu = r->with.hysteresis.value, side = r->with.side.value;
    wt_format_si(r->with.velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(
        text, size,
        "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against roughness that "
        "is the same in all directions; the force of the hysteresis turns by %.1f deg to "
        "the side",
        velocity, 100 * (mu / r->without.hysteresis.value - 1),
        100 * (r->with.area_ratio.value / r->without.area_ratio.value - 1),
        atan2(side, mu) * 180 / M_PI);
}

static wt_status make_table(const sides *s, wt_table **table, wt_error *err)
{
    const anisotropy_row *reference = &s->rows[s->n - 1];
    table_writer t = table_begin(&anisotropy_schema, err);
    for (size_t i = 0; i + 1 < s->n; i++)
        anisotropy_add_row(&t, &s->rows[i]);
    anisotropy_keys keys = {.side = reference->with.side};
    keys.side.standard_error = (double)NAN; /* no replicates are drawn here */
    anisotropy_describe(&s->sliding->anisotropy, keys.texture, sizeof keys.texture);
    say_effect(reference, keys.effect, sizeof keys.effect);
    anisotropy_set_keys(&t, &keys);
    return table_end(&t, table);
}

static void say_cost(const sides *s, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance, .items = 2 * (double)s->n};
    for (size_t i = 0; i < s->n; i++) {
        const wt_estimate *h = &s->rows[i].with.hysteresis;
        if (h->value > 0)
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / h->value);
    }
    cost_say(work, cost);
}

wt_status wt_anisotropy_make(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                             wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no anisotropy to compute");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK && !anisotropy_is_any(&sliding->anisotropy))
        status = wt_fail(err, WT_E_ARG, "the roughness is the same in all directions");
    if (status != WT_OK)
        return status;
    sides s = {.sliding = sliding, .work = *work, .n = sliding->n_velocity + 1};
    s.work.left_out = WT_EXTRAS;
    s.velocity = malloc(s.n * sizeof *s.velocity);
    s.rows = calloc(s.n, sizeof *s.rows);
    s.points = malloc(s.n * sizeof *s.points);
    if (s.velocity == NULL || s.rows == NULL || s.points == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i + 1 < s.n; i++)
        s.velocity[i] = sliding->velocity[i];
    if (status == WT_OK) {
        s.velocity[s.n - 1] = flow_reference_velocity(sliding);
        status = compute_sides(&s, true, err);
    }
    if (status == WT_OK)
        status = compute_sides(&s, false, err);
    if (status == WT_OK)
        status = make_table(&s, table, err);
    if (status == WT_OK)
        say_cost(&s, work);
    free(s.velocity);
    free(s.rows);
    free(s.points);
    return status;
}
