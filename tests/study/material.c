/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "material.h"

#include <math.h>
#include <stdio.h>

static double vogel(double b, double t_inf, double reference, double temperature)
{
    return -b * (1 / (reference - t_inf) - 1 / (temperature - t_inf));
}

double law_shift(const shift_law *law, double reference, double temperature)
{
    if (!(temperature < law->glass))
        return vogel(law->b, law->t_inf, reference, temperature);
    const double kelvin = law->glass + 273.15, above = law->glass - law->t_inf;
    const double slope = law->slope_below * law->b * kelvin * kelvin / (above * above);
    return vogel(law->b, law->t_inf, reference, law->glass) +
           slope * (1 / (temperature + 273.15) - 1 / kelvin);
}

static double bell(double x)
{
    return exp(-x * x / 2);
}

static double tail(double l)
{
    return 1e6 * pow(10, -(l + 4) / 4) / (1 + pow(10, -2 * (l + 6)));
}

static double cole_cole(double l, double strength, double tau, double alpha)
{
    const double x = pow(10, alpha * (l - log10(tau)));
    return strength * sin(M_PI * alpha) / M_PI / (x + 1 / x + 2 * cos(M_PI * alpha));
}

/* Spectrum H of one process at lg tau. */
static double spectrum(rubber_kind kind, int process, double l)
{
    const double glass = 3e8 * bell((l + 9.5) / 2.2);
    const double broad = glass + tail(l) / (1 + pow(10, 2 * (l - 5)));
    switch (kind) {
    case RUBBER_BROAD:
        return broad;
    case RUBBER_RIPPLE:
        return broad * (1 + 0.5 * sin(2 * M_PI * l / 1.5) * exp(-fabs(l + 3) / 4));
    case RUBBER_SHARP:
        return cole_cole(l, 1.5e9, pow(10, -4.5), 0.75) + cole_cole(l, 3e6, 0.1, 0.4);
    case RUBBER_TERMINAL:
        return glass + tail(l) * exp(-pow(10, l - 1));
    case RUBBER_PLATEAU:
        return cole_cole(l, 1.2e9, 1e-8, 0.6) + 2e4 * bell(l / 3);
    case RUBBER_TWO:
        return process == 0 ? cole_cole(l, 2e9, 1e-10, 0.5) : cole_cole(l, 6e6, 0.01, 0.35);
    default:
        return 0;
    }
}

static void add_term(rubber *r, double strength, double tau, double alpha, double gamma)
{
    r->strength[r->n] = strength;
    r->tau[r->n] = tau;
    r->alpha[r->n] = alpha;
    r->gamma[r->n++] = gamma;
}

rubber rubber_make(rubber_kind kind)
{
    rubber r = {.equilibrium = 2e6};
    switch (kind) {
    case RUBBER_HAVRILIAK_NEGAMI:
        add_term(&r, 1.2e9, 1e-7, 0.7, 0.45);
        add_term(&r, 4e6, 0.02, 0.45, 0.8);
        return r;
    case RUBBER_FRACTIONAL_ZENER:
        add_term(&r, 1.5e9, 1e-9, 0.42, 1);
        return r;
    case RUBBER_LINES:
        for (int k = 0; k < 16; k++)
            add_term(&r, 3e6 * pow(10, 0.2 * k) * (k % 3 == 1 ? 1.4 : 1), pow(10, 4.3 - k), 1, 1);
        return r;
    case RUBBER_WIDE:
        add_term(&r, 2e9, 1e-6, 0.12, 1);
        return r;
    default:
        break;
    }
    if (kind == RUBBER_TERMINAL)
        r.equilibrium = 0;
    if (kind == RUBBER_TWO)
        r.equilibrium = 4e6;
    for (int p = 0; p < (kind == RUBBER_TWO ? 2 : 1); p++)
        for (int k = 0; k < SPECTRUM_TIMES; k++) {
            const double l = -17 + 0.1 * k;
            r.process[r.n] = p;
            add_term(&r, 0.1 * log(10) * spectrum(kind, p, l), pow(10, l), 1, 1);
        }
    return r;
}

void rubber_moduli(const rubber *r, const double omega[2], double *storage, double *loss)
{
    *storage = r->equilibrium;
    *loss = 0;
    for (size_t k = 0; k < r->n; k++) {
        const double z = omega[r->process[k]] * r->tau[k];
        if (r->alpha[k] < 1 || r->gamma[k] < 1) {
            /* 1 - (1 + (i z)^alpha)^-gamma, in polar form */
            const double power = pow(z, r->alpha[k]), angle = r->alpha[k] * M_PI / 2;
            const double x = 1 + power * cos(angle), y = power * sin(angle);
            const double size = pow(hypot(x, y), -r->gamma[k]);
            const double turn = -r->gamma[k] * atan2(y, x);
            *storage += r->strength[k] * (1 - size * cos(turn));
            *loss -= r->strength[k] * size * sin(turn);
        } else {
            const double share = r->strength[k] * z / (1 + z * z);
            *storage += share * z;
            *loss += share;
        }
    }
}

void state_moduli(const rubber_state *state, double omega, double *storage, double *loss)
{
    const double reduced[2] = {omega * state->a[0], omega * state->a[1]};
    rubber_moduli(state->rubber, reduced, storage, loss);
    *storage *= state->factor;
    *loss *= state->factor;
}

double state_relaxation(const rubber_state *state, double time)
{
    const rubber *r = state->rubber;
    double sum = r->equilibrium;
    for (size_t i = 0; i < r->n; i++)
        sum += r->strength[i] * exp(-time / (r->tau[i] * state->a[r->process[i]]));
    return state->factor * sum;
}

bool rubber_write(const rubber *r, const char *path)
{
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return false;
    fprintf(out,
            "## table: prony\n## title: Prony series\n"
            "## equilibrium_modulus: %.12g standard_error=0 numerical_error=0 unit=Pa\n"
            "## reference_temperature: 293.15 standard_error=0 numerical_error=0 unit=K\n"
            "## frequency_min: 1e-6 standard_error=0 numerical_error=0 unit=rad/s\n"
            "## frequency_max: 1e13 standard_error=0 numerical_error=0 unit=rad/s\n"
            "## deformation: tension\n# relaxation_time[s]\tmodulus[Pa]\n",
            r->equilibrium);
    for (size_t i = r->n; i-- > 0;) /* increasing times */
        fprintf(out, "%.12g\t%.12g\n", r->tau[i], r->strength[i]);
    fprintf(out, "##\n");
    return ferror(out) == 0 && fclose(out) == 0;
}
