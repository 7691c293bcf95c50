/* Energy source of sliding: the power that each wavenumber of the roughness dissipates.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"
#include "layer/numerics/energy_density_kernel.h"

#include <math.h>

/* Depths of the comparison of two sources, from 0.1 / q1 to the limit of double precision: exp(-2 q
 * z) underflows in products near q z = 710. */
enum { DEPTHS = 32 };
static const double last_depth = 710;
/* Number of cells towards q0, each a quarter of the previous one. They resolve the longest waves,
 * which dominate at the last depth. */
static const size_t min_level = 6;
/* Largest number of comparisons, each with one more halving of the subintervals. */
enum { MAX_HALVINGS = 4 };

/* Largest relative difference of w and of int w, for both profiles. */
static double compare_sources(const wt_energy_source *a, const wt_energy_source *b,
                              const wt_roughness *roughness)
{
    double worst = 0;
    const double from = 0.1 / roughness->q1;
    const double to = last_depth / roughness->q0;
    for (size_t i = 0; i <= DEPTHS; i++) {
        const double depth = i ? from * pow(to / from, (double)(i - 1) / (DEPTHS - 1)) : 0;
        double of_a[ENERGY_PROFILE_VALUES], of_b[ENERGY_PROFILE_VALUES];
        energy_log_profiles(a, depth, of_a);
        energy_log_profiles(b, depth, of_b);
        for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
            worst = fmax(worst, fabs(of_a[k] - of_b[k])); /* NaN if both have no power */
    }
    return worst;
}

wt_status wt_energy_source_from_friction(wt_friction_workspace *workspace, double pressure,
                                         double velocity, wt_energy_source *source, wt_error *err)
{
    if (workspace == NULL || source == NULL)
        return wt_fail(err, WT_E_ARG, "an energy source needs a friction workspace");
    wt_status status = friction_prepare(workspace, pressure, &velocity, 1, err);
    if (status != WT_OK)
        return status;
    friction_load at = friction_load_create(workspace, pressure, velocity);
    friction_scratch scratch;
    arena memory = {0};
    wt_energy_source pair[2] = {{0}, {0}};
    friction_scratch_init(&scratch, workspace, 0, &memory);
    status = friction_solve_heat(workspace, &scratch, &at, err);
    const subinterval_plan *plan =
        status == WT_OK ? friction_plan(workspace, &scratch, &at, NULL, 0) : NULL;
    size_t now = 0;
    double error = (double)INFINITY;
    for (size_t k = 0; status == WT_OK && k < MAX_HALVINGS && error > workspace->options.tolerance;
         k++) {
        now = 1 - now;
        node_contributions record = {0};
        friction_pass pass;
        const friction_effort effort = {
            .level = min_level, .halves = k, .accurate_everywhere = true};
        friction_evaluate(workspace, &scratch, plan, effort, at, false, &record, &pass);
        wt_energy_source *s = &pair[now];
        wt_energy_source_clear(s);
        *s = (wt_energy_source){.profile = WT_PROFILE_PERSSON,
                                .n = record.n,
                                .wavenumber = record.q,
                                .power = record.mu};
        for (size_t i = 0; i < s->n; i++)
            s->power[i] *= pressure * at.speed;
        if (k > 0)
            error = compare_sources(s, &pair[1 - now], workspace->roughness) +
                    pass.hysteresis_error / (pass.hysteresis > 0 ? pass.hysteresis : 1);
        s->numerical_error = error + friction_relative_error(workspace, &pass, at).hysteresis;
    }
    if (status == WT_OK)
        status = energy_check(&pair[now], err);
    if (status == WT_OK) {
        *source = pair[now];
        pair[now] = (wt_energy_source){0};
    }
    wt_energy_source_clear(&pair[0]);
    wt_energy_source_clear(&pair[1]);
    workspace->scratch[0].nodes += scratch.nodes;
    arena_free(&memory);
    return status;
}
