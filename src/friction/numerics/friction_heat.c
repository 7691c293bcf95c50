/* Friction at self-consistent flash temperatures.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/root.h"
#include "core/math/simd.h"
#include "friction/numerics/friction_kernel.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* The rules of a pass adapt, those of the temperatures do not; their difference measures the error
 * of the heat. The factor allows for cancellation in the difference. */
static const double difference_factor = 3;

double friction_heat_error(const flash_solution *solution, const friction_pass *pass)
{
    const double mu = fabs(solution->hysteresis - pass->hysteresis);
    const double g = fabs(solution->variance - pass->variance);
    const double relative = fmax(pass->hysteresis > 0 ? mu / pass->hysteresis : 0,
                                 pass->variance > 0 ? g / pass->variance : 0);
    return solution->rise_error + difference_factor * solution->gain * relative * solution->rise;
}

void friction_shift_nodes(const flash_solution *solution, const double *q, size_t n, double *omega,
                          double *log_omega)
{
    double shift[GAUSS_NODES_MAX], factor[GAUSS_NODES_MAX];
    heat_log_shift(&solution->heat, q, n, shift);
    vector_exp(shift, n, factor);
    for (size_t i = 0; i < n; i++) {
        omega[i] *= factor[i];
        log_omega[i] += shift[i];
    }
}

/* Sets all results of a load without a solution to NaN. */
static void set_unsolved_point(wt_friction_point *point)
{
    const wt_estimate unknown = {(double)NAN, (double)NAN, (double)NAN, "1"};
    *point = (wt_friction_point){.stress_variance = unknown,
                                 .area_ratio = unknown,
                                 .one_minus_area = unknown,
                                 .hysteresis = unknown,
                                 .extrapolated_share = (double)NAN,
                                 .has_no_solution = true,
                                 .temperature = {(double)NAN, (double)NAN, (double)NAN, "K"}};
}

void friction_heated_point(const wt_friction_workspace *ws, friction_scratch *scratch,
                           friction_load at,
                           void (*compute)(const wt_friction_workspace *ws,
                                           friction_scratch *scratch, const friction_load *at,
                                           wt_friction_point *point),
                           wt_friction_point *point)
{
    const flash_solution heat = flash_solve(ws, scratch->flash, &at);
    set_unsolved_point(point);
    if (heat.found) {
        at.heat = &heat;
        point->has_no_solution = false;
        compute(ws, scratch, &at, point);
    }
    scratch->nodes += flash_reset_node_count(scratch->flash);
}

wt_status friction_solve_heat(const wt_friction_workspace *ws, friction_scratch *scratch,
                              friction_load *at, wt_error *err)
{
    if (ws->flash == NULL || !(at->speed > 0))
        return WT_OK;
    scratch->heat = flash_solve(ws, scratch->flash, at);
    scratch->nodes += flash_reset_node_count(scratch->flash);
    if (!scratch->heat.found) {
        wt_fail(err, WT_E_CONVERGENCE, "no flash temperature was found");
        wt_error_found(err, "none at %g m/s and %g Pa", at->speed, at->pressure);
        wt_error_advice(err, "the rubber there would get hotter than 573 K, or its temperature "
                             "does not settle: compute without a flash temperature");
        return WT_E_CONVERGENCE;
    }
    at->heat = &scratch->heat;
    return WT_OK;
}

/* ---- knots ----------------------------------------------------------------------------------- */

typedef struct knot_crossing {
    const wt_roughness *roughness;
    const heat_profile *heat;
    double knot;
} knot_crossing;

static double knot_distance(double t, void *user)
{
    const knot_crossing *c = user;
    const double q = fmin(c->roughness->q0 + c->roughness->q0 * expm1(t), c->roughness->q1);
    double shift;
    heat_log_shift(c->heat, &q, 1, &shift);
    return t + shift - c->knot;
}

/* Moves each knot to the scale where the shifted frequency crosses it. A knot without a crossing is
 * left outside the range. */
void friction_shift_knots(const wt_friction_workspace *ws, const heat_profile *heat, double *knots)
{
    const wt_roughness *r = ws->roughness;
    const double length = log1p((r->q1 - r->q0) / r->q0);
    const double at_low = knot_distance(0, &(knot_crossing){r, heat, 0});
    const double at_high = knot_distance(length, &(knot_crossing){r, heat, length});
    for (size_t k = 0; k < ws->n_knots; k++) {
        knot_crossing c = {r, heat, knots[k]};
        const bool inside = at_low < knots[k] && length + at_high > knots[k];
        double t = knots[k] - (knots[k] <= at_low ? at_low : at_high);
        if (inside && root_find(knot_distance, &c, 0, length, 0, &t, NULL) != WT_OK)
            t = 2 * length;
        knots[k] = t;
    }
    numbers_sort(knots, ws->n_knots);
}
