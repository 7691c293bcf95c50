/* A tip on a cantilever indents a viscoelastic rubber and retracts at one rate. The approach uses
 * the integral of Lee and Radok (J. Appl. Mech. 27 (1960) 438), the retraction that of Ting (J.
 * Appl. Mech. 33 (1966) 845). Both are sums over the whole history with the mean of E(t) over each
 * time step. The steps are so many that their error is far below the noise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"

#include <math.h>

/* splitmix64 and Box-Muller. */
static double uniform(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
}

double truth_normal(uint64_t *state)
{
    double radius = sqrt(-2 * log(uniform(state)));
    return radius * cos(2 * 3.14159265358979323846 * uniform(state));
}

double truth_vertical(double temperature)
{
    return TRUTH_REFERENCE / temperature;
}

/* |E*| of the rubber at a frequency and the temperature of the curves. */
static double complex_modulus(const wt_material *material, double omega)
{
    double storage, loss;
    material->law->modulus(material, &omega, 1, &storage, &loss);
    return hypot(storage, loss);
}

double truth_travel(const wt_material *material, const truth_press *p, double depth)
{
    double travel = depth, g, slope;
    wt_contact_function(p->tip, depth, &g, &slope);
    for (int i = 0; i < 60; i++)
        travel = depth + p->factor * complex_modulus(material, p->rate / travel) / (1 - 0.25) * g /
                             p->spring_constant;
    return travel;
}

double truth_force_after(const double force[2 * TRUTH_STEPS + 1], double steps)
{
    const int i = (int)fmin(fmax(steps, 0), 2 * TRUTH_STEPS - 1);
    return force[i] + fmin(fmax(steps - i, 0), 1) * (force[i + 1] - force[i]);
}

/* Mean of E(t) between two times at a temperature. */
static double mean_relaxation(const wt_rubber *rubber, double temperature, double from, double to)
{
    const double a = pow(10, wt_wlf_log_shift(&rubber->law.wlf, temperature));
    double shear = rubber->prony.equilibrium_modulus;
    for (size_t k = 0; k < rubber->prony.n; k++) {
        const double tau = a * rubber->prony.relaxation_time[k];
        shear += rubber->prony.modulus[k] * tau / (to - from) * exp(-from / tau) *
                 -expm1((from - to) / tau);
    }
    return 2 * (1 + rubber->poisson_ratio) * shear / truth_vertical(temperature);
}

static double force_at(const truth_press *p, double depth)
{
    double g, slope;
    wt_contact_function(p->tip, depth, &g, &slope);
    return g;
}

/* k (travel - depth) = past + now f(depth) */
static double depth_at(const truth_press *p, double travel, double past, double now)
{
    double low = 0, high = fmax(travel, 0);
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        *(p->spring_constant * (travel - middle) > past + now * force_at(p, middle) ? &low
                                                                                    : &high) =
            middle;
    }
    return (low + high) / 2;
}

/* Integral of E dx over the steps after `from` up to `to`, at the end of step `to_time`. */
static double integral(const double *e, const double *x, int from, int to, int to_time)
{
    double sum = 0;
    for (int m = from + 1; m <= to; m++)
        sum += e[to_time - m] * (x[m] - x[m - 1]);
    return sum;
}

/* Force on retraction: that of the contact at t1, from which on the integral of E ddepth is zero.
 * *t1, which decreases, is the end of the last step where it is not negative; -1: no contact. */
static double retraction_force(const truth_press *p, const double *e, const double *f,
                               double *depth, double travel, int i, int *t1)
{
    double later = 0, force_later = 0;
    for (; *t1 >= 0; --*t1) {
        const double force = integral(e, f, 0, *t1, i);
        depth[i] = travel - force / p->spring_constant;
        const double open = integral(e, depth, *t1, i, i);
        if (open >= 0) {
            const double share = later < 0 ? open / (open - later) : 0;
            const double met = force + share * (force_later - force);
            depth[i] = travel - met / p->spring_constant;
            return met;
        }
        later = open;
        force_later = force;
    }
    depth[i] = travel;
    return 0;
}

void truth_indent(const truth_press *p, const wt_rubber *rubber, double force[2 * TRUTH_STEPS + 1])
{
    double e[2 * TRUTH_STEPS], depth[2 * TRUTH_STEPS + 1] = {0}, f[2 * TRUTH_STEPS + 1] = {0};
    const double factor = p->factor / (1 - rubber->poisson_ratio * rubber->poisson_ratio);
    const double step = p->travel / p->rate / TRUTH_STEPS;
    int top = 0, t1 = 0; /* number of steps of the approach, after its end */
    for (int i = 0; i < 2 * TRUTH_STEPS; i++)
        e[i] = factor * mean_relaxation(rubber, p->temperature, i * step, (i + 1) * step);
    force[0] = 0;
    for (int i = 1; i <= 2 * TRUTH_STEPS; i++) {
        const double travel = p->travel * (1 - fabs(1 - (double)i / TRUTH_STEPS));
        if (top == 0) { /* The cantilever increases the depth for a while after the piezo turns. */
            const double past = integral(e, f, 0, i - 1, i) - e[0] * f[i - 1];
            depth[i] = depth_at(p, travel, past, e[0]);
            f[i] = force_at(p, depth[i]);
            force[i] = past + e[0] * f[i];
            if (depth[i] >= depth[i - 1])
                continue;
            t1 = top = i - 1;
        }
        force[i] = retraction_force(p, e, f, depth, travel, i, &t1);
        t1 = t1 < 0 || t1 == top ? t1 : t1 + 1; /* start of the next search */
    }
}
