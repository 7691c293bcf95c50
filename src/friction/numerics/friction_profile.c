/* Running friction profile: G, P and mu up to given wavenumbers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include "friction/numerics/persson_contact.h"

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

/* Computes running sums to each wavenumber, with subintervals that end there. The capacity of cuts
 * is n. */
static void fill_nodes(const wt_friction_workspace *workspace, friction_load at, double sign,
                       friction_scratch *scratch, const double *wavenumber, size_t n, double *cuts,
                       wt_friction_node *nodes)
{
    const wt_roughness *roughness = workspace->roughness;
    for (size_t i = 0; i < n; i++)
        cuts[i] = log1p((wavenumber[i] - roughness->q0) / roughness->q0);
    const subinterval_plan *plan = friction_plan(workspace, scratch, &at, cuts, n);
    friction_pass pass;
    const friction_effort effort = {.accurate_everywhere = true};
    friction_evaluate(workspace, scratch, plan, effort, at, false, NULL, &pass);

    const friction_relative relative = friction_relative_error(workspace, &pass, at);
    const double slack = 1e-13 * fmax(1, log(roughness->q1 / roughness->q0));
    const size_t first = plan->levels - pass.level;
    double variance = 0, difference = 0, hysteresis = 0, error = 0;
    size_t part = 0; /* the next part; part p ends at end[p] */
    for (size_t i = 0; i < n; i++) {
        while (part < pass.parts) {
            const double end = part == 0 ? plan->core[pass.level].t_high
                                         : plan->subintervals[first + part - 1].t_high;
            if (end > cuts[i] + slack * (cuts[i] > slack))
                break;
            variance += scratch->subinterval_g[part];
            hysteresis += scratch->subinterval_mu[part];
            difference += scratch->error_g[part];
            error += scratch->error_mu[part];
            part++;
        }
        nodes[i] = (wt_friction_node){.wavenumber = wavenumber[i],
                                      .stress_variance = variance,
                                      .area_ratio = contact_area(variance),
                                      .hysteresis = sign * hysteresis,
                                      .numerical_error = contact_area_error(
                                          variance, difference + relative.variance * variance),
                                      .hysteresis_error = error + relative.hysteresis * hysteresis,
                                      .temperature = (double)NAN};
        if (at.heat != NULL) {
            heat_rise(&at.heat->heat, &wavenumber[i], 1, &nodes[i].temperature);
            nodes[i].temperature += workspace->options.temperature;
        }
    }
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

    friction_load at = friction_load_create(workspace, pressure, velocity);
    friction_scratch scratch;
    arena memory = {0};
    double *cuts = arena_alloc(&memory, n, sizeof *cuts);
    friction_scratch_init(&scratch, workspace, n, &memory);
    status = friction_solve_heat(workspace, &scratch, &at, err);
    if (status == WT_OK)
        fill_nodes(workspace, at,
                   velocity < 0   ? -1
                   : velocity > 0 ? 1
                                  : 0,
                   &scratch, wavenumber, n, cuts, nodes);
    workspace->scratch[0].nodes += scratch.nodes;
    arena_free(&memory);
    return status;
}
