/* Friction on the way: G, P and mu up to given wavenumbers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/friction.h"

#include "kernel/contact.h"

#include <math.h>

static wt_status check_wavenumbers(const wt_roughness *roughness, const double *q, size_t n,
                                   wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!(q[i] >= (i ? q[i - 1] : roughness->q0) && q[i] <= roughness->q1)) {
            wt_fail(err, WT_E_RANGE, "wavenumber %zu of %zu of a friction profile is out of range",
                    i + 1, n);
            wt_error_expected(err, "rising, from q0 = %g to q1 = %g rad/m", roughness->q0,
                              roughness->q1);
            wt_error_found(err, "%g", q[i]);
            return WT_E_RANGE;
        }
    return WT_OK;
}

/* Runs the two rules of a profile and leaves their parts in the slots 0 (lower) and 1. */
static friction_pass run_pair(const wt_friction_workspace *ws, friction_scratch *scratch,
                              const panel_plan *plan, size_t level, friction_load at, size_t rule)
{
    friction_pass pass;
    for (unsigned slot = 0; slot < 2; slot++)
        friction_evaluate(ws, scratch, friction_grid(ws, scratch, plan, rule + slot), level, at,
                          slot, false, NULL, &pass);
    return pass;
}

static bool pair_reached(const wt_friction_workspace *ws, const friction_scratch *scratch,
                         const friction_pass *pass)
{
    double difference_g = 0, difference_mu = 0;
    for (size_t p = 0; p < pass->parts; p++) {
        difference_g += fabs(scratch->panel_g[0][p] - scratch->panel_g[1][p]);
        difference_mu += fabs(scratch->panel_mu[0][p] - scratch->panel_mu[1][p]);
    }
    return difference_g <= ws->options.tolerance * pass->variance &&
           difference_mu <= ws->options.tolerance * pass->hysteresis;
}

wt_status wt_friction_profile(wt_friction_workspace *workspace, double pressure, double velocity,
                              const double *wavenumber, size_t n, wt_friction_node *nodes,
                              wt_error *err)
{
    if (workspace == NULL || (n && (wavenumber == NULL || nodes == NULL)))
        return wt_fail(err, WT_E_ARG, "a friction profile needs wavenumbers and a place for it");
    const wt_roughness *roughness = workspace->roughness;
    wt_status status = friction_prepare(workspace, pressure, &velocity, 1, err);
    if (status == WT_OK)
        status = check_wavenumbers(roughness, wavenumber, n, err);
    if (status != WT_OK || n == 0)
        return status;

    const friction_load at = {.pressure = pressure, .speed = fabs(velocity)};
    const double sign = velocity < 0 ? -1 : velocity > 0 ? 1 : 0;
    friction_scratch scratch;
    pool memory = {0};
    double *cuts = pool_alloc(&memory, n, sizeof *cuts);
    status = friction_scratch_init(&scratch, workspace, n, &memory, err);
    if (status != WT_OK)
        goto done;
    for (size_t i = 0; i < n; i++)
        cuts[i] = log1p((wavenumber[i] - roughness->q0) / roughness->q0);
    const panel_plan *plan = friction_plan(workspace, &scratch, at.speed, cuts, n);
    const size_t level =
        friction_level(workspace, &scratch, friction_grid(workspace, &scratch, plan, 0), at);
    size_t rule = 1;
    friction_pass pass = run_pair(workspace, &scratch, plan, level, at, rule);
    while (!pair_reached(workspace, &scratch, &pass) && rule + 2 < FRICTION_RULES)
        pass = run_pair(workspace, &scratch, plan, level, at, ++rule);

    const double relative = friction_relative_error(workspace, at, &pass).variance;
    const double slack = 1e-13 * fmax(1, log(roughness->q1 / roughness->q0));
    const size_t first = plan->levels - level;
    double variance = 0, difference = 0, hysteresis = 0;
    size_t part = 0; /* the next one; part p ends at end[p] */
    for (size_t i = 0; i < n; i++) {
        while (part < pass.parts) {
            const double end =
                part == 0 ? plan->core[level].t_high : plan->panels[first + part - 1].t_high;
            if (end > cuts[i] + slack * (cuts[i] > slack))
                break;
            variance += scratch.panel_g[1][part];
            hysteresis += scratch.panel_mu[1][part];
            difference += fabs(scratch.panel_g[0][part] - scratch.panel_g[1][part]);
            part++;
        }
        nodes[i] = (wt_friction_node){
            .wavenumber = wavenumber[i],
            .stress_variance = variance,
            .area_ratio = contact_area(variance),
            .hysteresis = sign * hysteresis,
            .numerical_error = friction_area_error(variance, difference + relative * variance)};
    }
done:
    pool_free(&memory);
    return status;
}
