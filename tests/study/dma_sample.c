/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma_sample.h"

#include <math.h>
#include <stdio.h>

static double sign(random_source *random)
{
    return random_uniform(random) < 0.5 ? -1 : 1;
}

static void draw_frequencies(const dma_scene *s, random_source *random, isotherm *to)
{
    double first = s->lg_first, last = s->lg_last;
    int n = s->frequencies;
    if (s->ragged) {
        first += 0.7 * random_uniform(random);
        last -= 0.7 * random_uniform(random);
        n = 7 + (int)(10 * random_uniform(random));
    }
    to->n = 0;
    for (int k = 0; k < n; k++)
        if (!(random_uniform(random) < s->missing) || k == 0 || k == n - 1)
            to->frequency[to->n++] = pow(10, first + (last - first) * k / (n - 1));
}

/* Noise of this point relative to that of the scene. */
static double loudness(const dma_scene *s, const isotherm *at, int k)
{
    const double u = at->n > 1 ? 2.0 * k / (at->n - 1) - 1 : 0;
    return s->bathtub > 0 ? 1 + (s->bathtub - 1) * u * u : 1;
}

static void crystallise(isotherm *at, int k, double strength)
{
    const double below = strength * fmax(0, 10 - at->temperature);
    at->storage[k] *= pow(10, 0.02 * below);
    at->loss[k] *= pow(10, 0.008 * below);
}

/* What the instrument makes of E*: a spring in series, the inertia, a phase lag. */
static void distort(const dma_scene *s, double omega, double *storage, double *loss)
{
    const double re = 1 + s->compliance * *storage, im = s->compliance * *loss,
                 square = re * re + im * im;
    const double soft = (*storage * re + *loss * im) / square - s->inertia * omega * omega,
                 lost = (*loss * re - *storage * im) / square,
                 angle = s->phase_lag * omega / (2 * M_PI * pow(10, s->lg_last));
    *storage = soft * cos(angle) - lost * sin(angle);
    *loss = soft * sin(angle) + lost * cos(angle);
}

static void draw_isotherm(const dma_scene *s, const rubber *r, random_source *random, int number,
                          bool bad, double oven, isotherm *to)
{
    const bool loud = s->loud > 0 && (number == 3 || number == 8);
    const double noise[2] = {loud ? s->loud : s->noise_storage, loud ? s->loud : s->noise_loss};
    to->true_temperature = to->temperature + oven + s->temperature_error * random_normal(random) +
                           (bad ? s->bad_temperature : 0);
    const double geometry = exp(s->geometry_error * random_normal(random));
    rubber_state state = dma_state(s, r, to->true_temperature);
    state.factor = pow(10, -dma_vertical(s, to->temperature)) / geometry;
    draw_frequencies(s, random, to);
    double before[2];
    before[0] = random_normal(random);
    before[1] = random_normal(random);
    for (int k = 0; k < to->n; k++) {
        double *to_modulus[2] = {&to->storage[k], &to->loss[k]};
        to->drift[k] = s->ramp ? s->step * k / to->n : 0;
        if (s->ramp)
            state = dma_state(s, r, to->true_temperature + to->drift[k]);
        if (s->ramp)
            state.factor = pow(10, -dma_vertical(s, to->temperature + to->drift[k])) / geometry;
        state_moduli(&state, 2 * M_PI * to->frequency[k], &to->storage[k], &to->loss[k]);
        crystallise(to, k, s->crystallises);
        if (s->relaxation)
            to->storage[k] = state_relaxation(&state, 1 / (2 * M_PI * to->frequency[k]));
        distort(s, 2 * M_PI * to->frequency[k], &to->storage[k], &to->loss[k]);
        to->storage[k] *= bad ? 1 + s->bad_stiffness : 1;
        to->loss[k] *= bad ? (1 + s->bad_stiffness) * (1 + s->bad_loss) : 1;
        for (int q = 0; q < 2; q++) {
            double e = random_normal(random);
            if (s->correlation > 0)
                e = s->correlation * before[q] + sqrt(1 - s->correlation * s->correlation) * e;
            before[q] = e;
            if (random_uniform(random) < s->outliers)
                e += s->outlier_size / noise[q] * sign(random);
            *to_modulus[q] *= exp(noise[q] * loudness(s, to, k) * e);
        }
        if (s->exchanged) {
            const double kept = to->storage[k];
            to->storage[k] = to->loss[k];
            to->loss[k] = kept;
        }
    }
}

void sample_draw(const dma_scene *s, const rubber *r, random_source *random, sample *to)
{
    const double oven = s->oven > 0 ? s->oven * random_normal(random) : 0;
    to->n = 0;
    for (int i = 0; to->n < ISOTHERMS_MAX && s->first + s->step * i <= s->last + 1e-9; i++)
        for (int again = i == 4 && s->twice ? 0 : 1; again < 2; again++) {
            isotherm *const at = &to->isotherms[to->n++];
            at->temperature = s->first + s->step * i;
            draw_isotherm(s, r, random, i + 1, i == 4 && again == 1, oven, at);
        }
}

int sample_write(const dma_scene *s, const sample *from, const char *path)
{
    FILE *file = fopen(path, "w");
    const double unit = (s->other_layout ? 1e-6 : 1) * dma_part_of_e(s);
    if (file == NULL)
        return -1;
    if (s->relaxation)
        fputs("T (degC),t (s),E(t) (Pa)\n", file);
    else if (s->other_layout)
        fputs("T\tf\tE'\tE''\ndegC\tHz\tMPa\tMPa\n", file);
    else
        fputs(s->shear ? "T_C,f_Hz,G_storage_Pa,G_loss_Pa\n" : "T_C,f_Hz,E_storage_Pa,E_loss_Pa\n",
              file);
    for (int i = 0; i < from->n; i++) {
        const isotherm *at = &from->isotherms[i];
        for (int k = 0; k < at->n; k++)
            if (s->relaxation)
                fprintf(file, "%g,%.7g,%.6g\n", at->temperature, 1 / (2 * M_PI * at->frequency[k]),
                        unit * at->storage[k]);
            else
                fprintf(file, s->other_layout ? "%.2f\t%.6g\t%.6g\t%.6g\n" : "%g,%.7g,%.6g,%.6g\n",
                        at->temperature + at->drift[k], at->frequency[k], unit * at->storage[k],
                        unit * at->loss[k]);
    }
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}
