/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dwell_sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double share = 1 / 0.75, load = 0.5, held = 8; /* 1/(1 - nu^2), [s] */
enum { FINE = 4 };

/* Four terms a decade over ten decades. */
static relaxation power_law(double exponent)
{
    relaxation r = {.n = 41};
    for (size_t i = 0; i < r.n; i++) {
        r.tau[i] = pow(10, -5 + 0.25 * (double)i);
        r.e[i] = pow(r.tau[i], -exponent);
    }
    r.rest = exponent < 0.3 ? pow(1e5, -exponent) / exponent : 0; /* the terms that relax later */
    return r;
}

relaxation dwell_relaxation(const dwell_scene *s, random_source *random)
{
    dwell_rubber rubber = s->rubber;
    double exponent = rubber == RUBBER_STEEP ? 0.35 : 0.12, alpha = 0.4, tan_delta = 0.5, found;
    relaxation r = {0};
    if (rubber == RUBBER_ANY) {
        rubber = random_uniform(random) < 0.5 ? RUBBER_POWER : RUBBER_COLE_COLE;
        exponent = 0.03 + 0.37 * random_uniform(random);
        alpha = 0.3 + 0.3 * random_uniform(random);
        tan_delta = 0.03 * pow(15, random_uniform(random));
    }
    if (rubber == RUBBER_MAXWELL) {
        r.n = 7;
        r.rest = 1;
        for (size_t i = 0; i < r.n; i++) {
            r.tau[i] = pow(10, -4 + (double)i);
            r.e[i] = 0.4 * pow(r.tau[i], -0.1);
        }
    } else if (rubber == RUBBER_COLE_COLE) {
        r = relaxation_cole_cole(alpha, tan_delta, 0);
    } else if (rubber == RUBBER_PLATEAU) {
        r = relaxation_power(0.25, 0.03);
    } else {
        r = power_law(exponent);
    }
    const double scale = 1e6 / relaxation_modulus(&r, 1, &found);
    r.rest *= scale;
    for (size_t i = 0; i < r.n; i++)
        r.e[i] *= scale;
    return r;
}

/* Rubber under the tip: the present value of each term. */
typedef struct state {
    const relaxation *r;
    const afm_tip *tip;
    double k, f, memory[RELAXATIONS];
} state;

/* A time step with the base at a position (hold_force: at its present force); returns the force. */
static double go(state *s, double step, double *base, int hold_force, double force)
{
    const relaxation *r = s->r;
    double past = 0, now = r->rest, gain[RELAXATIONS], low = 0, high = 1e-9;
    for (size_t i = 0; i < r->n; i++) {
        const double x = step / r->tau[i];
        gain[i] = r->e[i] * -expm1(-x) / x;
        s->memory[i] *= exp(-x);
        past += s->memory[i] - gain[i] * s->f;
        now += gain[i];
    }
#define FORCE(a) (share * (past + now * tip_force(s->tip, a)))
#define OVER(a) (hold_force ? FORCE(a) - force : tip_depth(s->tip, a) + FORCE(a) / s->k - *base)
    double f = 0, depth = 0;
    if (!(OVER(0.0) > 0)) {
        while (OVER(high) < 0)
            high *= 2;
        for (int i = 0; i < 60; i++) {
            const double middle = 0.5 * (low + high);
            *(OVER(middle) > 0 ? &high : &low) = middle;
        }
        f = tip_force(s->tip, high);
        depth = tip_depth(s->tip, high);
    }
    const double found = f > 0 ? FORCE(high) : 0;
#undef OVER
#undef FORCE
    for (size_t i = 0; i < r->n; i++)
        s->memory[i] += gain[i] * (f - s->f);
    s->f = f;
    if (hold_force)
        *base = depth + found / s->k;
    return found;
}

/* Correlated in time: a process of 20 ms, or one for each octave from 1 ms. */
enum { OCTAVES = 14 };
static double noise_after(afm_noise kind, double step, double *slow, random_source *random)
{
    const int n = kind == NOISE_FLICKER ? OCTAVES : 1;
    double sum = 0;
    if (kind == NOISE_WHITE)
        return random_normal(random);
    for (int k = 0; k < n; k++) {
        const double rho = exp(-step / (kind == NOISE_FLICKER ? ldexp(1e-3, k) : 0.02));
        slow[k] = rho * slow[k] + sqrt(1 - rho * rho) * random_normal(random);
        sum += slow[k] / sqrt(n);
    }
    return sqrt(0.7) * sum + sqrt(0.3) * random_normal(random);
}

typedef struct clean {
    double time[DWELL_SAMPLES], base[DWELL_SAMPLES], force[DWELL_SAMPLES];
} clean;

static void make_clean(const dwell_scene *s, const relaxation *r, clean *to)
{
    const afm_tip tip =
        s->pyramid ? afm_pyramid(20e-9, 35, 4) : (afm_tip){.radius = 5e-6, .b = (double)INFINITY};
    const double depth = s->pyramid ? 150e-9 : 400e-9, hold = s->hold > 0 ? s->hold : held;
    state at = {.r = r,
                .tip = &tip,
                .k = s->spring_constant > 0 ? s->spring_constant
                     : s->pyramid           ? 0.5
                                            : 5};
    const double top =
        /* approximate */
        depth + 1e6 * share * tip_force(&tip, tip_contact_radius(&tip, depth)) / at.k;
    const double rate = top / load, step_in = load / DWELL_IN, step_held = hold / DWELL_HELD;
    double time = 0, stop = 0, base = -rate * step_in * (DWELL_FREE - 0.3), force = 0;
    for (int i = 0; i < DWELL_SAMPLES; i++) {
        const int in = i < DWELL_FREE + DWELL_IN,
                  dwells = !in && i < DWELL_FREE + DWELL_IN + DWELL_HELD;
        const double step = (dwells ? step_held : step_in) / FINE;
        for (int k = 0; k < FINE; k++) {
            if (dwells && s->modulation > 0)
                base += 0.01 * depth *
                        (sin(2 * M_PI * s->modulation * (time - stop + step)) -
                         sin(2 * M_PI * s->modulation * (time - stop)));
            base += in ? rate * step : dwells ? 0 : -1.6 * rate * step;
            time += step;
            stop = in ? time : stop;
            if (base > 0 || at.f > 0)
                force = go(&at, step, &base, dwells && s->creep, force);
        }
        to->time[i] = time;
        to->base[i] = base;
        to->force[i] = force;
    }
}

int dwell_sample_write(const dwell_scene *s, const relaxation *r, random_source *random,
                       const char *path)
{
    static const char *const kinds[] = {"approach", "dwell", "retract"};
    clean *c = calloc(1, sizeof *c);
    FILE *file = c != NULL ? fopen(path, "w") : NULL;
    double slow[OCTAVES];
    if (file == NULL) {
        free(c);
        return -1;
    }
    make_clean(s, r, c);
    for (int k = 0; k < OCTAVES; k++)
        slow[k] = random_normal(random);
    const double largest = c->force[DWELL_FREE + DWELL_IN - 1];
    const double drift = s->drift * random_normal(random) * largest,
                 tilt = s->tilt * random_normal(random) * largest;
    fprintf(file,
            "## table: force_curve/0\n"
            "## spring_constant: %.9g standard_error=0 numerical_error=0 unit=N/m\n"
            "## curve: 0\n# segment[text]\theight[m]\tforce[N]\ttime[s]\n",
            s->spring_constant > 0 ? s->spring_constant
            : s->pyramid           ? 0.5
                                   : 5);
    for (int i = 0; i < DWELL_SAMPLES - (s->no_retract ? DWELL_OUT : 0); i++) {
        const int part = (i >= DWELL_FREE + DWELL_IN) + (i >= DWELL_FREE + DWELL_IN + DWELL_HELD);
        const double force =
            c->force[i] + drift * c->time[i] / c->time[DWELL_SAMPLES - 1] +
            tilt * c->base[i] / -c->base[0] +
            s->noise * largest *
                noise_after(s->kind, c->time[i] - (i > 0 ? c->time[i - 1] : 0), slow, random);
        if (i == DWELL_FREE + DWELL_IN || i == DWELL_FREE + DWELL_IN + DWELL_HELD)
            fputs("\n", file);
        fprintf(file, "%s\t%.9g\t%.9g\t%.9g\n",
                part == 1 && s->modulation > 0 ? "modulation" : kinds[part],
                5e-6 - c->base[i] + s->height_noise * random_normal(random), force, c->time[i]);
    }
    fputs("##\n", file);
    free(c);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}
