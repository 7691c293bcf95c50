/* Force curves with known truth: a cantilever of spring constant k on a sample with known modulus
 * and law, with baseline, noise of the force and other instrument effects.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_SYNTHETIC_CURVE_H
#define WT_TESTS_SYNTHETIC_CURVE_H

#include "weartrack/indentation.h"

#include <math.h>
#include <stdint.h>

enum { CURVE_MAX = 40000 };

typedef struct curve_truth {
    wt_tip tip;
    double modulus, poisson_ratio, spring_constant;
    size_t n;
    double travel;        /* travel of the piezo [m] */
    double contact_point; /* contact position from the start [m] */
    double offset, tilt;  /* baseline at the start [N], and its tilt [N/m] */
    double noise;         /* standard deviation [N] */
    double correlation;   /* correlation of neighbours: first-order autoregression */
    double direction;     /* sign of the height: +1 or -1 */
    double height0;       /* height at the start [m] */
} curve_truth;

typedef struct curve_data {
    double height[CURVE_MAX], force[CURVE_MAX], time[CURVE_MAX];
} curve_data;

/* splitmix64: the same numbers on every machine. */
static inline double curve_uniform(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return ((double)((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
}

static inline double curve_normal(uint64_t *state)
{
    double u = curve_uniform(state), v = curve_uniform(state);
    return sqrt(-2.0 * log(u)) * cos(2.0 * M_PI * v);
}

/* Force of the contact at piezo travel z beyond the contact point: k d = E* G(z - d). */
static inline double curve_contact_force(const curve_truth *t, double z)
{
    if (z <= 0.0)
        return 0.0;
    const double reduced = t->modulus / (1.0 - t->poisson_ratio * t->poisson_ratio);
    double lo = 0.0, hi = z;
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (lo + hi), g, slope;
        wt_contact_function(&t->tip, middle, &g, &slope);
        if (t->spring_constant * (z - middle) > reduced * g)
            lo = middle;
        else
            hi = middle;
    }
    return t->spring_constant * (z - 0.5 * (lo + hi));
}

static inline void curve_make(const curve_truth *t, uint64_t seed, curve_data *data)
{
    double noise = t->noise > 0.0 ? t->noise * curve_normal(&seed) : 0.0;
    for (size_t i = 0; i < t->n; i++) {
        double z = t->travel * (double)i / (double)(t->n - 1);
        data->time[i] = 0.5 * (double)i / (double)(t->n - 1);
        data->height[i] = t->height0 + t->direction * z;
        data->force[i] =
            t->offset + t->tilt * z + curve_contact_force(t, z - t->contact_point) + noise;
        if (t->noise > 0.0)
            noise = t->correlation * noise +
                    sqrt(1.0 - t->correlation * t->correlation) * t->noise * curve_normal(&seed);
    }
}

/* 20 MPa rubber under a 1 N/m cantilever with a pyramid: 53.6 nN at 70 nm. */
static inline curve_truth curve_standard(void)
{
    curve_truth t = {.tip = {.sides = 4, .half_angle = 20 * M_PI / 180, .radius = 10e-9},
                     .modulus = 20e6,
                     .poisson_ratio = 0.5,
                     .spring_constant = 1.0,
                     .n = 2000,
                     .travel = 600e-9,
                     .contact_point = 476.43e-9,
                     .offset = 3e-9,
                     .tilt = 1e-3,
                     .noise = 50e-12,
                     .correlation = 0.0,
                     .direction = 1.0,
                     .height0 = 2e-6};
    t.tip.transition_radius = wt_tip_tangent_transition(t.tip.radius, t.tip.half_angle);
    return t;
}

#endif
