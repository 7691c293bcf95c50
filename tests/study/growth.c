/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth.h"

#include <math.h>

/* Number of wavenumber intervals; number of thicknesses at which friction is computed. */
enum { INTERVALS = 60, SOLVED = 100 };
/* First thickness, and distance of the last one from the steady state, relative to the steady
 * state. */
static const double nearest = 1e-4;

typedef struct growing {
    const contact *c;
    const contact_power *power;
    double balance, wear, needed; /* Qw [m/s]; U_c Qw */
} growing;

/* Thicknesses between 0 and the steady state, denser at both: equal steps of ln (d / (balance -
 * d)). */
static double place(const growing *g, double u)
{
    return g->balance / (1 + exp(log(nearest) * (2 * u - 1)));
}

/* By rates: integral of d thickness / (Qf - Qw). */
static double rate_step(const growing *g, double u)
{
    const double there = place(g, u),
                 speed = contact_power_below(g->power, there) / g->c->critical_energy - g->wear;
    return -2 * log(nearest) * there * (1 - there / g->balance) / speed;
}

/* By transport: wear until the damage at this depth is 1, J(d) - J(d + worn) = U_c Qw. */
static double worn_until(const growing *g, double depth)
{
    const double wanted = contact_power_below(g->power, depth) - g->needed;
    double low = 0, high = g->balance;
    while (contact_power_below(g->power, depth + high) > wanted)
        high *= 2;
    for (int k = 0; k < 80; k++) {
        const double middle = (low + high) / 2;
        *(contact_power_below(g->power, depth + middle) > wanted ? &low : &high) = middle;
    }
    return low;
}

static void find_times(const growing *g, bool transport, growth_truth *t)
{
    /* reaches the first thickness at the rate of the bare surface */
    const double at_once = contact_power_below(g->power, 0) / g->c->critical_energy - g->wear;
    double time = place(g, 0) / at_once;
    t->begins = transport ? worn_until(g, 0) / g->wear : 0;
    for (int i = 0; i < GROWTH_POINTS; i++) {
        const double u = (i + 1.0) / GROWTH_POINTS, half = 0.5 / GROWTH_POINTS;
        time +=
            (rate_step(g, u - 2 * half) + 4 * rate_step(g, u - half) + rate_step(g, u)) * half / 3;
        t->time[i] = transport ? worn_until(g, place(g, u)) / g->wear : time;
    }
}

/* Friction of a layer with its own shear stress. */
static double friction_with(const growing *g, double thickness, double ratio)
{
    contact c = *g->c;
    c.layer_thickness = thickness;
    c.layer_ratio = thickness > 0 ? ratio : 0;
    return contact_power_friction(g->power, &c);
}

static double interpolate(const double *x, const double *y, int n, double at)
{
    int k = 1;
    while (k < n - 1 && x[k] < at)
        k++;
    return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

static void find_friction(const growing *g, double ratio, growth_truth *t)
{
    double log_depth[SOLVED], friction[SOLVED];
    const double first = log(place(g, 0)), last = log(g->balance);
    for (int i = 0; i < SOLVED; i++) {
        log_depth[i] = first + (last - first) * i / (SOLVED - 1);
        friction[i] = friction_with(g, exp(log_depth[i]), ratio);
    }
    for (int i = 0; i < GROWTH_POINTS; i++)
        t->friction[i] =
            interpolate(log_depth, friction, SOLVED, log(place(g, (i + 1.0) / GROWTH_POINTS)));
    t->start = friction_with(g, 0, 1);
    t->end = friction[SOLVED - 1];
}

static void find_settled(growth_truth *t)
{
    double most = t->begins > 0 ? fabs(t->start - t->end) : 0;
    for (int i = 0; i < GROWTH_POINTS; i++)
        most = fmax(most, fabs(t->friction[i] - t->end));
    int k = GROWTH_POINTS - 1;
    while (k > 0 && fabs(t->friction[k] - t->end) < 0.05 * most)
        k--;
    if (k == 0) { /* layer from the start */
        t->settled = t->time[0];
        return;
    }
    const double here = fabs(t->friction[k] - t->end), next = fabs(t->friction[k + 1] - t->end);
    t->settled = t->time[k] + (t->time[k + 1] - t->time[k]) * (here - 0.05 * most) / (here - next);
}

bool growth_solve(const contact *c, const rubber_state *state, double ratio, bool transport,
                  growth_truth *truth)
{
    contact one = *c;
    one.velocities = 1;
    one.layer_compute_energy = 0;
    const contact_truth bare = contact_solve(&one, state, INTERVALS);
    growing g = {
        .c = c, .balance = bare.thickness, .wear = c->wear_rate * c->pressure * c->velocity[0]};
    if (!(g.balance > 0))
        return false;
    g.needed = c->critical_energy * g.wear;
    contact_power *power = contact_power_make(c, state, INTERVALS);
    g.power = power;
    find_times(&g, transport, truth);
    find_friction(&g, ratio, truth);
    find_settled(truth);
    contact_power_free(power);
    return true;
}

double growth_friction(const growth_truth *t, double time)
{
    if (time < t->begins)
        return t->start;
    if (time >= t->time[GROWTH_POINTS - 1])
        return t->end;
    if (time <= t->time[0])
        return t->friction[0];
    return interpolate(t->time, t->friction, GROWTH_POINTS, time);
}
