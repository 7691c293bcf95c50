/* Logarithmic sensitivities of friction to its inputs.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include <math.h>

/* Step of a five-point difference. Its truncation error is step^4 / 30 of a fifth derivative of the
 * order of 1; rounding and tolerance are divided by the step. */
static const double step = 0.01;

typedef enum factor { OF_MODULUS, OF_DENSITY, OF_PRESSURE } factor;

static wt_status log_hysteresis(wt_friction_workspace *ws, friction_scratch *scratch,
                                friction_load at, double *log_mu, wt_error *err)
{
    friction_pass pass;
    const wt_status status = friction_solve_heat(ws, scratch, &at, err);
    if (status != WT_OK)
        return status;
    const subinterval_plan *plan = friction_plan(ws, scratch, &at, NULL, 0);
    friction_evaluate(ws, scratch, plan, (friction_effort){0}, at, false, NULL, &pass);
    *log_mu = log(pass.hysteresis);
    return WT_OK;
}

static wt_status factor_sensitivity(wt_friction_workspace *ws, friction_scratch *scratch,
                                    friction_load at, factor which, double *slope, wt_error *err)
{
    /* positions and weights of the central difference of fourth order */
    static const double rule[][2] = {
        {-2, 1.0 / 12}, {-1, -8.0 / 12}, {1, 8.0 / 12}, {2, -1.0 / 12}};
    wt_status status = WT_OK;
    double sum = 0;
    for (size_t i = 0; status == WT_OK && i < 4; i++) {
        friction_load moved = at;
        double value = (double)NAN;
        const double ratio = exp(rule[i][0] * step);
        *(which == OF_MODULUS   ? &moved.modulus
          : which == OF_DENSITY ? &moved.density
                                : &moved.pressure) *= ratio;
        status = log_hysteresis(ws, scratch, moved, &value, err);
        sum += rule[i][1] * value;
    }
    *slope = sum / step;
    return status;
}

/* Contribution of the last waves to mu, with the temperatures of the full range up to q1. */
static wt_status cutoff_sensitivity(wt_friction_workspace *ws, double pressure, double velocity,
                                    double *slope, wt_error *err)
{
    /* positions and weights of the one-sided difference of fourth order */
    static const double rule[][2] = {
        {4, 3.0 / 12}, {3, -16.0 / 12}, {2, 36.0 / 12}, {1, -48.0 / 12}, {0, 25.0 / 12}};
    enum { POINTS = sizeof rule / sizeof *rule };
    const double q1 = ws->roughness->q1, length = log(q1 / ws->roughness->q0);
    const double short_step = fmin(step, 0.1 * length);
    double q[POINTS], sum = 0;
    wt_friction_node node[POINTS];
    for (size_t i = 0; i < POINTS; i++)
        q[i] = rule[i][0] > 0 ? q1 * exp(-rule[i][0] * short_step) : q1;
    const wt_status status = wt_friction_profile(ws, pressure, velocity, q, POINTS, node, err);
    for (size_t i = 0; status == WT_OK && i < POINTS; i++)
        sum += rule[i][1] * node[i].hysteresis;
    *slope = status == WT_OK ? sum / (short_step * node[POINTS - 1].hysteresis) : (double)NAN;
    return status;
}

wt_status wt_friction_sensitivities(wt_friction_workspace *workspace, double pressure,
                                    double velocity, wt_friction_sensitivity *sensitivity,
                                    wt_error *err)
{
    if (workspace == NULL || sensitivity == NULL)
        return wt_fail(err, WT_E_ARG, "sensitivities need a friction workspace");
    wt_status status = friction_prepare(workspace, pressure, &velocity, 1, err);
    if (status != WT_OK)
        return status;
    const friction_load at = friction_load_create(workspace, pressure, velocity);
    friction_scratch *scratch = &workspace->scratch[0];
    wt_friction_sensitivity s = {0};
    status = factor_sensitivity(workspace, scratch, at, OF_MODULUS, &s.modulus, err);
    if (status == WT_OK)
        status = factor_sensitivity(workspace, scratch, at, OF_DENSITY, &s.density, err);
    if (status == WT_OK)
        status = factor_sensitivity(workspace, scratch, at, OF_PRESSURE, &s.pressure, err);
    if (status == WT_OK)
        status = cutoff_sensitivity(workspace, pressure, velocity, &s.cutoff, err);
    if (status == WT_OK)
        *sensitivity = s;
    return status;
}
