/* Accuracy of the steady-state thickness and of the growth of the modified layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/precision.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { WAVES = 400, MOST_TIMES = 64 }; /* of the problem */

typedef struct layer_problem {
    wt_energy_source source;
    wt_layer_parameters parameters;
    double truth[MOST_TIMES], found[MOST_TIMES], stated;
    double time[MOST_TIMES];
    size_t n;
} layer_problem;

static wt_status alloc_source(layer_problem *p, size_t n, wt_error *err)
{
    p->source = (wt_energy_source){.profile = WT_PROFILE_PERSSON, .n = n};
    p->source.wavenumber = malloc(n * sizeof *p->source.wavenumber);
    p->source.power = malloc(n * sizeof *p->source.power);
    p->parameters = wt_layer_defaults();
    p->parameters.pressure = 4e5;
    p->parameters.velocity = 0.1;
    p->parameters.critical_energy = 2e10;
    return p->source.wavenumber == NULL || p->source.power == NULL
               ? wt_fail(err, WT_E_MEMORY, "out of memory")
               : WT_OK;
}

static void finish_layer(void *problem)
{
    layer_problem *p = problem;
    wt_energy_source_clear(&p->source);
}

static precision_errors layer_errors(const void *problem)
{
    const layer_problem *p = problem;
    precision_errors e = {0, p->stated};
    for (size_t i = 0; i < p->n; i++)
        e.true_error = fmax(e.true_error, precision_relative(p->found[i], p->truth[i]));
    return e;
}

/* ---- steady-state thickness ------------------------------------------------------------------ */

/* Computes Qf(z) / Qw - 1 at a depth in long double. */
static long double formation_excess(const layer_problem *p, long double z)
{
    const wt_layer_parameters *q = &p->parameters;
    const long double wear =
        (long double)q->specific_wear_rate * (long double)q->pressure * (long double)q->velocity;
    long double power = 0;
    for (size_t i = 0; i < p->source.n; i++)
        power +=
            (long double)p->source.power[i] * expl(-2 * (long double)p->source.wavenumber[i] * z);
    return power / ((long double)q->critical_energy * wear) - 1;
}

static bool is_growing(const void *problem, long double z)
{
    return formation_excess(problem, z) > 0;
}

static long double bisect_thickness(const layer_problem *p, int steps)
{
    return precision_bisect(is_growing, p, 0, 1e-2L, steps);
}

static wt_status begin_balance(void *problem, double *reference_error, wt_error *err)
{
    layer_problem *p = problem;
    const wt_status status = alloc_source(p, WAVES, err);
    if (status != WT_OK)
        return status;
    p->parameters.specific_wear_rate = 1e-12;
    for (int i = 0; i < WAVES; i++) {
        p->source.wavenumber[i] = 1e3 * pow(1e3, i / (WAVES - 1.0));
        p->source.power[i] = 5e3 / WAVES;
    }
    p->n = 1;
    p->truth[0] = (double)bisect_thickness(p, 70);
    *reference_error = LDBL_EPSILON * WAVES;
    return WT_OK;
}

static wt_status solve_balance(void *problem, double value, wt_error *err)
{
    layer_problem *p = problem;
    wt_layer_steady_state balance;
    (void)value;
    const wt_status status =
        wt_layer_steady_state_compute(&p->source, &p->parameters, &balance, err);
    p->found[0] = balance.thickness.value;
    p->stated = balance.thickness.numerical_error / balance.thickness.value;
    return status;
}

static wt_status solve_balance_bisection(void *problem, double value, wt_error *err)
{
    layer_problem *p = problem;
    (void)err;
    p->found[0] = (double)bisect_thickness(p, (int)value);
    p->stated = (double)NAN;
    return WT_OK;
}

/* ---- growth ---------------------------------------------------------------------------------- */

static wt_status begin_history(void *problem, double *reference_error, wt_error *err)
{
    layer_problem *p = problem;
    const wt_status status = alloc_source(p, 1, err);
    if (status != WT_OK)
        return status;
    const double q = 1e5, power = 2e3;
    p->source.wavenumber[0] = q;
    p->source.power[0] = power;
    wt_layer_parameters *l = &p->parameters;
    l->specific_wear_rate = 1e-13;
    l->start_thickness = 1e-8;
    const double wear = l->specific_wear_rate * l->pressure * l->velocity;
    const double formation = power / l->critical_energy;
    p->n = MOST_TIMES;
    for (size_t i = 0; i < p->n; i++) {
        p->time[i] = pow(1e4, (double)i / (double)(p->n - 1)) / (2 * q * formation);
        p->truth[i] =
            wt_layer_exponential_thickness(l->start_thickness, 2 * q, formation, wear, p->time[i]);
    }
    *reference_error = 1e-15; /* closed form: a few rounding errors */
    return WT_OK;
}

static wt_status solve_history(void *problem, double value, wt_error *err)
{
    layer_problem *p = problem;
    wt_layer_point points[MOST_TIMES];
    (void)value;
    const wt_status status =
        wt_layer_history(&p->source, &p->parameters, p->time, p->n, points, err);
    p->stated = 0;
    for (size_t i = 0; i < p->n && status == WT_OK; i++) {
        p->found[i] = points[i].thickness.value;
        p->stated = fmax(p->stated, points[i].thickness.numerical_error / p->found[i]);
    }
    return status;
}

static double growth_rate(const layer_problem *p, double thickness)
{
    const wt_layer_parameters *l = &p->parameters;
    return p->source.power[0] / l->critical_energy * exp(-2 * p->source.wavenumber[0] * thickness) -
           l->specific_wear_rate * l->pressure * l->velocity;
}

/* Fourth-order Runge-Kutta method with a number of steps between two times. */
static wt_status solve_runge_kutta(void *problem, double value, wt_error *err)
{
    layer_problem *p = problem;
    double thickness = p->parameters.start_thickness, time = 0;
    (void)err;
    for (size_t i = 0; i < p->n; i++) {
        const double h = (p->time[i] - time) / value;
        for (double k = 0; k < value; k++) {
            const double a = growth_rate(p, thickness), b = growth_rate(p, thickness + h / 2 * a),
                         c = growth_rate(p, thickness + h / 2 * b),
                         d = growth_rate(p, thickness + h * c);
            thickness += h / 6 * (a + 2 * b + 2 * c + d);
        }
        time = p->time[i];
        p->found[i] = thickness;
    }
    p->stated = (double)NAN;
    return WT_OK;
}

const precision_part precision_layer[] = {
    {.name = "layer-balance",
     "Thickness at balance of an energy that 400 wavenumbers bring; reference: bisection in long "
     "double",
     sizeof(layer_problem),
     begin_balance,
     layer_errors,
     finish_layer,
     {{"weartrack", "safeguarded Newton", {1}, solve_balance},
      {"textbook", "bisections", {10, 20, 30, 40, 50}, solve_balance_bisection}},
     .is_bound = true},
    {.name = "layer-history",
     "Thickness at 64 times, one wavenumber; reference: closed form",
     sizeof(layer_problem),
     begin_history,
     layer_errors,
     finish_layer,
     {{"weartrack", "quadrature of the time", {1}, solve_history},
      {"textbook", "Runge-Kutta steps between two times", {1, 4, 16, 64, 256}, solve_runge_kutta}},
     .is_bound = true},
    {.name = NULL},
};
