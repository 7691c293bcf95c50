/* Hysteresis friction of a Prony material on a self-affine road; the textbook method is that of
 * friction_textbook.h. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include <math.h>

#include "bench/bench.h"
#include "flow/accuracy/textbook.h"

enum { VELOCITIES = 100, TERMS = 12, NODES = 1000, ANGLES = 100 };

static const double pressure = 3e5;
static const double q0 = 500, qr = 2000, q1 = 1e6, hurst = 0.8, c0 = 6e-16;
static const double moduli[TERMS] = {1e6, 1.2e6, 1.6e6, 2.4e6, 4e6, 8e6,
                                     2e7, 6e7,   2e8,   5e8,   7e8, 4e8};
static const double equilibrium = 5e6;

typedef struct friction_case {
    double velocity[VELOCITIES], ours[VELOCITIES], textbook[VELOCITIES];
    wt_friction_point points[VELOCITIES];
    wt_friction_workspace *workspace;
    wt_material *material;
    wt_roughness *roughness;
} friction_case;

static void make_case(friction_case *c)
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
    bench_check(wt_material_prony(&prony, 0.5, &c->material, &err), &err);
    bench_check(wt_roughness_self_affine(q0, qr, q1, hurst, c0, &c->roughness, &err), &err);
    wt_friction_options options = wt_friction_defaults();
    options.threads = 1;
    bench_check(wt_friction_workspace_new(c->material, c->roughness, &options, &c->workspace, &err),
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

static void friction_plain(void *data)
{
    friction_case *c = data;
    for (int i = 0; i < VELOCITIES; i++) {
        textbook_friction point;
        bench_check(friction_textbook(c->material, c->roughness, pressure, c->velocity[i], NODES,
                                      ANGLES, &point),
                    NULL);
        c->textbook[i] = point.hysteresis;
    }
}

void bench_friction(void)
{
    static friction_case c;
    char words[96];
    make_case(&c);
    const double ours = bench_time(friction_weartrack, &c);
    const double textbook = bench_time(friction_plain, &c);
    double difference = 0, stated = 0;
    for (int i = 0; i < VELOCITIES; i++) {
        const wt_estimate mu = c.points[i].hysteresis;
        difference = fmax(difference, fabs(c.textbook[i] / mu.value - 1));
        stated = fmax(stated, mu.numerical_error / mu.value);
    }
    snprintf(words, sizeof words, "textbook %.1e off; stated error %.0e", difference, stated);
    bench_row("friction velocities", ours, textbook, 1e-3 * VELOCITIES, "per millisecond", words);
    wt_friction_workspace_free(c.workspace);
    wt_roughness_free(c.roughness);
    wt_material_free(c.material);
}
