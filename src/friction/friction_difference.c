/* Friction of two variants of a contact at one list of velocities.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/friction_difference.h"

#include "job/cost.h"

#include "core/base/clocale.h"

#include <math.h>
#include <stdlib.h>

static wt_status compute_points(const friction_difference *c, const wt_sliding *sliding,
                                const wt_job *work, wt_friction_point *points,
                                sliding_contact *contact, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_job local_job = *work;
    local_job.left_out = WT_EXTRA_ALL;
    wt_status status =
        sliding_contact_create(sliding, &local_job, WT_NO_REPLICATE, NULL, none, contact, err);
    if (status == WT_OK)
        status = wt_friction_compute(contact->workspace, contact->pressure, c->velocity, c->n,
                                     points, err);
    return status;
}

static void report_difference_cost(const friction_difference *c, const wt_job *work)
{
    cost_summary cost = {.tolerance_asked = work->tolerance, .items = 2 * (double)c->n};
    for (size_t i = 0; i < c->n; i++) {
        const wt_estimate *h = &c->with[i].hysteresis;
        if (h->value > 0)
            cost.error_estimated = fmax(cost.error_estimated, h->numerical_error / h->value);
    }
    cost_report(work, cost);
}

wt_status friction_difference_compute(const wt_sliding *with, const wt_sliding *without,
                                      const wt_job *work, friction_difference_fn *extend,
                                      void *user, friction_difference *c, wt_error *err)
{
    sliding_contact contact = {0}, other = {0};
    *c = (friction_difference){.sliding = with, .n = with->n_velocity + 1};
    c->velocity = wt_alloc(c->n, sizeof *c->velocity);
    c->with = wt_alloc(c->n, sizeof *c->with);
    c->without = wt_alloc(c->n, sizeof *c->without);
    for (size_t i = 0; i < with->n_velocity; i++)
        c->velocity[i] = with->velocity[i];
    c->velocity[c->n - 1] = flow_reference_velocity(with);
    wt_status status = compute_points(c, with, work, c->with, &contact, err);
    c->temperature = contact.temperature;
    if (status == WT_OK && extend != NULL)
        status = extend(user, c, &contact, err);
    sliding_contact_clear(&contact);
    if (status == WT_OK)
        status = compute_points(c, without, work, c->without, &other, err);
    sliding_contact_clear(&other);
    if (status == WT_OK)
        report_difference_cost(c, work);
    return status;
}

void friction_difference_clear(friction_difference *c)
{
    free(c->velocity);
    free(c->with);
    free(c->without);
    *c = (friction_difference){.n = 0};
}

void friction_difference_describe(const wt_friction_point *with, const wt_friction_point *without,
                                  const char *against, char *text, size_t size)
{
    char velocity[32];
    wt_format_si(with->velocity, "m/s", 3, velocity, sizeof velocity);
    clocale_print(text, size,
                  "at %s hysteresis friction %+.1f %%, contact area %+.1f %% against %s", velocity,
                  100 * (with->hysteresis.value / without->hysteresis.value - 1),
                  100 * (with->area_ratio.value / without->area_ratio.value - 1), against);
}
