/* Hysteresis friction of several materials on a self-affine road, with set-up. The textbook method
 * is that of study/textbook_methods.h.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "bench/bench.h"
#include "study/textbook_methods.h"

enum { VELOCITIES = 100, TERMS = 12, NODES = 1000, ANGLES = 100, MOST_KNOTS = 1000 };

static const double pressure = 3e5;
static const double q0 = 500, qr = 2000, q1 = 1e6, hurst = 0.8, c0 = 6e-16;
static const double moduli[TERMS] = {1e6, 1.2e6, 1.6e6, 2.4e6, 4e6, 8e6,
                                     2e7, 6e7,   2e8,   5e8,   7e8, 4e8};
static const double equilibrium = 5e6;

/* Ambient temperature, at which the shift law gives the moduli. */
static const double temperature = 293.15;

typedef struct friction_case {
    double velocity[VELOCITIES], textbook[VELOCITIES];
    wt_friction_point points[VELOCITIES];
    wt_material *material;
    wt_roughness *roughness;
    double tolerance;
    bool flash;
} friction_case;

/* With the measured frequency range; NaN: all frequencies are known. */
static wt_material *prony_between(double lowest, double highest)
{
    wt_error err = WT_ERROR_INIT;
    wt_prony series = {0};
    wt_material *material = NULL;
    wt_prony_alloc(&series, TERMS);
    series.deformation = WT_TENSION;
    series.reference_temperature = (double)NAN;
    series.frequency_min = lowest;
    series.frequency_max = highest;
    series.equilibrium_modulus = equilibrium;
    for (int k = 0; k < TERMS; k++) {
        series.modulus[k] = moduli[k];
        series.relaxation_time[k] = pow(10, -k);
    }
    bench_check(wt_material_prony(&series, 0.5, &material, &err), &err);
    wt_prony_clear(&series);
    return material;
}

static wt_material *prony(void)
{
    return prony_between((double)NAN, (double)NAN);
}

/* Points of this series over 14 decades. */
static wt_material *table(size_t knots)
{
    static double omega[MOST_KNOTS], storage[MOST_KNOTS], loss[MOST_KNOTS];
    wt_error err = WT_ERROR_INIT;
    wt_material *of = prony(), *material = NULL;
    for (size_t i = 0; i < knots; i++)
        omega[i] = 1e-2 * pow(10, 14.0 * (double)i / (double)(knots - 1));
    of->law->modulus(of, omega, knots, storage, loss);
    bench_check(
        wt_material_table(omega, storage, loss, knots, 0.5, WT_EXTRAPOLATE_HOLD, &material, &err),
        &err);
    wt_material_free(of);
    return material;
}

static wt_material *zener(void)
{
    wt_error err = WT_ERROR_INIT;
    wt_material *material = NULL;
    bench_check(wt_material_fractional_zener(5e6, 2e9, 1e-6, 0.4, 0.5, &material, &err), &err);
    return material;
}

static wt_material *transverse(void)
{
    wt_error err = WT_ERROR_INIT;
    wt_material *material = NULL;
    wt_transverse t = wt_transverse_defaults();
    t.axial_storage = 2.5;
    bench_check(wt_material_transverse(prony(), NULL, NULL, &t, 0.49, &material, &err), &err);
    return material;
}

/* With all preparations. */
static void friction_weartrack(void *data)
{
    friction_case *c = data;
    wt_error err = WT_ERROR_INIT;
    wt_friction_options options = wt_friction_defaults();
    wt_friction_workspace *workspace = NULL;
    options.threads = 1;
    options.tolerance = c->tolerance;
    options.flash.on = c->flash;
    options.temperature = temperature;
    options.shift = (wt_shift_law){
        .kind = WT_LAW_WLF, .wlf = {.c1 = 7.4, .c2 = 121.6, .reference_temperature = temperature}};
    bench_check(wt_friction_workspace_new(c->material, c->roughness, &options, &workspace, &err),
                &err);
    bench_check(wt_friction_compute(workspace, pressure, c->velocity, VELOCITIES, c->points, &err),
                &err);
    wt_friction_workspace_free(workspace);
}

/* At every tenth velocity, because the method is slow. */
enum { EVERY = 10 };

static void friction_plain(void *data)
{
    friction_case *c = data;
    for (int i = 0; i < VELOCITIES; i += EVERY) {
        textbook_friction point;
        bench_check(textbook_friction_compute(c->material, c->roughness, pressure, c->velocity[i],
                                              NODES, ANGLES, &point),
                    NULL);
        c->textbook[i] = point.hysteresis;
    }
}

/* Compared with the textbook time for all velocities. */
static void bench_tolerance(friction_case *c, const char *name, double tolerance, double textbook)
{
    char words[96];
    c->tolerance = tolerance;
    const double ours = bench_time(friction_weartrack, c);
    double difference = 0, stated = 0;
    for (int i = 0; i < VELOCITIES; i++) {
        const wt_estimate mu = c->points[i].hysteresis;
        if (i % EVERY == 0)
            difference = fmax(difference, fabs(c->textbook[i] / mu.value - 1));
        stated = fmax(stated, mu.numerical_error / mu.value);
    }
    snprintf(words, sizeof words, "textbook %.1e off; stated error %.0e", difference, stated);
    bench_row(name, ours, textbook, 1e-3 * VELOCITIES, "per millisecond", words);
}

/* Takes ownership of the material. `loose`: also at a tolerance of 1e-2, unless NULL. */
static void bench_material(const char *name, const char *loose, wt_material *material)
{
    static friction_case c;
    wt_error err = WT_ERROR_INIT;
    c.material = material;
    for (int i = 0; i < VELOCITIES; i++)
        c.velocity[i] = 1e-4 * pow(10, 5.0 * i / (VELOCITIES - 1));
    bench_check(wt_roughness_self_affine(q0, qr, q1, hurst, c0, &c.roughness, &err), &err);
    const double textbook = EVERY * bench_time(friction_plain, &c);
    bench_tolerance(&c, name, wt_friction_defaults().tolerance, textbook);
    if (loose != NULL)
        bench_tolerance(&c, loose, 1e-2, textbook);
    wt_roughness_free(c.roughness);
    wt_material_free(c.material);
}

/* Velocities from no heating to 30 K. The textbook method has no flash temperature; it computes the
 * same velocities without it. */
static void bench_flash(double tolerance)
{
    static friction_case c;
    static wt_friction_point rough[VELOCITIES];
    wt_error err = WT_ERROR_INIT;
    char name[64], words[96];
    c.material = prony();
    c.tolerance = tolerance;
    for (int i = 0; i < VELOCITIES; i++)
        c.velocity[i] = 1e-6 * pow(10, 7.0 * i / (VELOCITIES - 1));
    bench_check(wt_roughness_self_affine(q0, qr, q1, hurst, c0, &c.roughness, &err), &err);
    const double without = bench_time(friction_weartrack, &c);
    c.flash = true;
    const double ours = bench_time(friction_weartrack, &c);
    memcpy(rough, c.points, sizeof rough);
    c.tolerance = 1e-12;
    friction_weartrack(&c);
    double off = 0;
    for (int i = 0; i < VELOCITIES; i++)
        off = fmax(off, fabs(rough[i].hysteresis.value / c.points[i].hysteresis.value - 1));
    snprintf(name, sizeof name, "friction with flash temperature, tolerance %.0e", tolerance);
    snprintf(words, sizeof words, "beside it without; true error %.0e", off);
    bench_row(name, ours, without, 1e-3 * VELOCITIES, "per millisecond", words);
    wt_roughness_free(c.roughness);
    wt_material_free(c.material);
    c = (friction_case){0};
}

void bench_friction(void)
{
    bench_flash(1e-7);
    bench_flash(1e-10);
    bench_material("friction velocities, Prony", "the same, tolerance 1e-2", prony());
    bench_material("the same, known from 10 to 1e7 rad/s", NULL, prony_between(10, 1e7));
    bench_material("friction, table of 107 knots", "the same, tolerance 1e-2", table(107));
    bench_material("friction, table of 1,000 knots", NULL, table(MOST_KNOTS));
    bench_material("friction, fractional Zener", NULL, zener());
    bench_material("friction, with directions", NULL, transverse());
}
