/* Hysteresis friction of a Prony material on a self-affine road. The textbook method: trapezoids in
 * ln q and Simpson's rule in the angle, P integrated along. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include <math.h>

#include "bench/bench.h"

enum { VELOCITIES = 100, TERMS = 12, NODES = 1000, ANGLES = 100 };

static const double pi = 3.14159265358979323846, pressure = 3e5;
static const double q0 = 500, qr = 2000, q1 = 1e6, hurst = 0.8, c0 = 6e-16;
static const double moduli[TERMS] = {1e6, 1.2e6, 1.6e6, 2.4e6, 4e6, 8e6,
                                     2e7, 6e7,   2e8,   5e8,   7e8, 4e8};
static const double equilibrium = 5e6;

typedef struct friction_case {
    double velocity[VELOCITIES], ours[VELOCITIES], textbook[VELOCITIES];
    wt_friction_point points[VELOCITIES];
    wt_friction_workspace *workspace;
} friction_case;

static void make_case(friction_case *c, wt_material **material, wt_roughness **roughness)
{
    wt_error err = WT_ERROR_INIT;
    wt_prony prony = {0};
    bench_check(wt_prony_alloc(&prony, TERMS, &err), &err);
    prony.deformation = WT_TENSION;
    prony.reference_temperature = prony.frequency_min = prony.frequency_max = (double)NAN;
    prony.equilibrium_modulus = equilibrium;
    for (int k = 0; k < TERMS; k++) {
        prony.modulus[k] = moduli[k];
        prony.relaxation_time[k] = pow(10, -k);
    }
    for (int i = 0; i < VELOCITIES; i++)
        c->velocity[i] = 1e-4 * pow(10, 5.0 * i / (VELOCITIES - 1));
    bench_check(wt_material_prony(&prony, 0.5, material, &err), &err);
    bench_check(wt_roughness_self_affine(q0, qr, q1, hurst, c0, roughness, &err), &err);
    wt_friction_options options = wt_friction_defaults();
    options.threads = 1;
    bench_check(wt_friction_workspace_new(*material, *roughness, &options, &c->workspace, &err),
                &err);
    wt_prony_clear(&prony);
}

static void friction_weartrack(void *data)
{
    friction_case *c = data;
    wt_error err = WT_ERROR_INIT;
    bench_check(
        wt_friction_compute(c->workspace, pressure, c->velocity, VELOCITIES, c->points, &err),
        &err);
}

/* Both angular integrals at w = q v by Simpson's rule over a quarter turn. */
static void angular(double w, double *j1, double *j2)
{
    *j1 = *j2 = 0;
    for (int a = 0; a <= ANGLES; a++) {
        const double phi = 0.5 * pi * a / ANGLES, omega = w * cos(phi);
        const double weight = a == 0 || a == ANGLES ? 1 : a % 2 == 1 ? 4 : 2;
        double storage = equilibrium, loss = 0;
        for (int k = 0; k < TERMS; k++) {
            const double z = omega * pow(10, -k);
            storage += moduli[k] * z * z / (1 + z * z);
            loss += moduli[k] * z / (1 + z * z);
        }
        *j1 += weight * cos(phi) * loss;
        *j2 += weight * (storage * storage + loss * loss);
    }
    const double step = 4 * 0.5 * pi / ANGLES / 3, effective = 1 / 0.75;
    *j1 *= step * effective;
    *j2 *= step * effective * effective;
}

static void friction_textbook(void *data)
{
    friction_case *c = data;
    for (int i = 0; i < VELOCITIES; i++) {
        double g = 0, mu = 0, last_g = 0, last_mu = 0;
        const double step = log(q1 / q0) / NODES;
        for (int n = 0; n <= NODES; n++) {
            const double q = q0 * exp(n * step);
            const double density = q < qr ? c0 : c0 * pow(q / qr, -2 * (1 + hurst));
            double j1 = 0, j2 = 0;
            angular(q * c->velocity[i], &j1, &j2);
            const double d_g = pow(q, 4) * density * j2 / (8 * pressure * pressure);
            if (n > 0)
                g += 0.5 * (d_g + last_g) * step;
            const double p = g > 0 ? erf(0.5 / sqrt(g)) : 1;
            const double d_mu = pow(q, 4) * density * p * j1 / (2 * pressure);
            if (n > 0)
                mu += 0.5 * (d_mu + last_mu) * step;
            last_g = d_g;
            last_mu = d_mu;
        }
        c->textbook[i] = mu;
    }
}

void bench_friction(void)
{
    static friction_case c;
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    char words[96];
    make_case(&c, &material, &roughness);
    const double ours = bench_time(friction_weartrack, &c);
    const double textbook = bench_time(friction_textbook, &c);
    double difference = 0, stated = 0;
    for (int i = 0; i < VELOCITIES; i++) {
        const wt_estimate mu = c.points[i].hysteresis;
        difference = fmax(difference, fabs(c.textbook[i] / mu.value - 1));
        stated = fmax(stated, mu.numerical_error / mu.value);
    }
    snprintf(words, sizeof words, "textbook %.1e off; stated error %.0e", difference, stated);
    bench_row("friction velocities", ours, textbook, 1e-3 * VELOCITIES, "per millisecond", words);
    wt_friction_workspace_free(c.workspace);
    wt_roughness_free(roughness);
    wt_material_free(material);
}
