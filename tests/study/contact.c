/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values of the integrals over the wavenumber at one wavenumber. */
typedef struct wave {
    double weight; /* weight of Simpson's rule in ln q, and q itself */
    double q, variance_density, loss_angle;
    double bare_density, bare_loss; /* the same without a layer */
    double power;                   /* j(q) */
} wave;

static double density(const contact *c, double q)
{
    return q <= c->qr ? c->c0 : c->c0 * pow(q / c->qr, -2 * (1 + c->hurst));
}

/* J1 and J2 of the angle. With cos(phi) = 1/cosh(u) the integrand is smooth and decays at both
 * limits, so that equal steps are exact to rounding. */
static void angular(const contact *c, const rubber_state *state, double omega, double *j1,
                    double *j2)
{
    const double step = 0.25, kappa = 1 / (1 - c->poisson * c->poisson);
    *j1 = *j2 = 0;
    for (int k = 0; k <= 150; k++) {
        const double u = step * k, cosine = 1 / cosh(u), weight = k == 0 ? step / 2 : step;
        double storage, loss;
        state_moduli(state, omega * cosine, &storage, &loss);
        *j1 += 4 * weight * cosine * cosine * kappa * loss;
        *j2 += 4 * weight * cosine * kappa * kappa * (storage * storage + loss * loss);
    }
}

/* Modulus of a bonded layer on rubber for a wave, relative to the rubber; both incompressible
 * (Burmister 1943). */
static double layer_modulus_ratio(const contact *c, double q)
{
    if (!(c->layer_ratio > 0) || !(c->layer_thickness > 0))
        return 1;
    const double x = q * c->layer_thickness, n = (c->layer_ratio - 1) / (c->layer_ratio + 1),
                 e = exp(-2 * x);
    return c->layer_ratio * (1 - 2 * n * (1 + 2 * x * x) * e + n * n * e * e) /
           (1 + 4 * n * x * e - n * n * e * e);
}

/* Waves of one segment, in steps of half an interval; returns their number. */
static int add_piece(const contact *c, const rubber_state *state, double velocity, double from,
                     double to, int steps, wave *waves)
{
    const double half = log(to / from) / (2 * steps);
    for (int k = 0; k <= 2 * steps; k++) {
        const double q = from * exp(half * k);
        /* the density at the end of a segment is that of this segment */
        const double cq = q * q * q * density(c, fmin(q, to));
        double j1, j2;
        angular(c, state, q * velocity, &j1, &j2);
        const double simpson = k == 0 || k == 2 * steps ? 1 : k % 2 == 1 ? 4 : 2;
        waves[k] = (wave){.weight = q * simpson * half / 3,
                          .q = q,
                          .bare_density = q * cq * j2 / (8 * c->pressure * c->pressure),
                          .bare_loss = cq * j1};
    }
    return 2 * steps + 1;
}

/* Running integral of the variance over a segment, with the contact area and j(q). */
static double run_piece(double variance, double velocity, double half, int n, wave *waves,
                        double *area)
{
    for (int k = 0; k < n; k++) {
        double g = variance;
        if (k % 2 == 1) { /* parabola through three points, up to its middle */
            const double *a = &waves[k - 1].variance_density, *b = &waves[k].variance_density,
                         *c = &waves[k + 1].variance_density;
            g = variance + half / 12 * (5 * *a + 8 * *b - *c);
            variance += half / 3 * (*a + 4 * *b + *c);
        }
        *area = g > 0 ? erf(1 / (2 * sqrt(g))) : 1;
        waves[k].power = velocity / 2 * waves[k].loss_angle * *area;
    }
    *area = variance > 0 ? erf(1 / (2 * sqrt(variance))) : 1;
    return variance;
}

/* Dissipated power per area below a depth. */
static double power_below(const wave *waves, int n, double depth)
{
    double sum = 0;
    for (int k = 0; k < n; k++)
        sum += waves[k].weight * waves[k].power * exp(-2 * waves[k].q * depth);
    return sum;
}

/* Steady state of formation and wear. */
static double thickness(const contact *c, double velocity, const wave *waves, int n)
{
    const double needed = c->critical_energy * c->wear_rate * c->pressure * velocity;
    double low = log(1e-12), high = log(1.0);
    if (power_below(waves, n, 0) <= needed)
        return 0;
    for (int k = 0; k < 200; k++) {
        const double middle = (low + high) / 2;
        *(power_below(waves, n, exp(middle)) > needed ? &low : &high) = middle;
    }
    return exp(low);
}

/* Both segments; 4 steps + 2 waves. Returns their number. */
static int fill(const contact *c, const rubber_state *state, double v, int steps, wave *waves)
{
    const int n = add_piece(c, state, v, c->q0, c->qr, steps, waves);
    return n + add_piece(c, state, v, c->qr, c->q1, steps, waves + n);
}

/* With the layer, if there is one. */
static void load(const contact *c, double v, int steps, wave *waves, double *area)
{
    const int n = 2 * steps + 1;
    for (int k = 0; k < 2 * n; k++) {
        const double softer = layer_modulus_ratio(c, waves[k].q);
        waves[k].variance_density = waves[k].bare_density * softer * softer;
        waves[k].loss_angle = waves[k].bare_loss * softer;
    }
    const double variance = run_piece(0, v, log(c->qr / c->q0) / (2 * steps), n, waves, area);
    run_piece(variance, v, log(c->q1 / c->qr) / (2 * steps), n, waves + n, area);
}

static double shear(const contact *c, double area)
{
    return (c->layer_ratio > 0 ? c->layer_ratio : 1) * c->shear_stress * area / c->pressure;
}

contact_truth contact_solve(const contact *c, const rubber_state *state, int steps)
{
    contact_truth truth = {.thickness = (double)NAN};
    wave *waves = calloc(4 * (size_t)steps + 2, sizeof *waves);
    if (waves == NULL)
        abort();
    for (int i = 0; i < c->velocities; i++) {
        const double v = c->velocity[i];
        const int n = fill(c, state, v, steps, waves);
        load(c, v, steps, waves, &truth.area[i]);
        truth.hysteresis[i] = power_below(waves, n, 0) / (c->pressure * v);
        truth.friction[i] = truth.hysteresis[i] + shear(c, truth.area[i]);
        if (i == c->layer_compute_energy)
            truth.thickness = thickness(c, v, waves, n);
    }
    free(waves);
    return truth;
}

struct contact_power {
    int n, steps;
    wave waves[];
};

contact_power *contact_power_make(const contact *c, const rubber_state *state, int steps)
{
    double area;
    contact_power *power = malloc(sizeof *power + (4 * (size_t)steps + 2) * sizeof power->waves[0]);
    if (power == NULL)
        abort();
    power->steps = steps;
    power->n = fill(c, state, c->velocity[0], steps, power->waves);
    load(c, c->velocity[0], steps, power->waves, &area);
    return power;
}

double contact_power_below(const contact_power *power, double depth)
{
    return power_below(power->waves, power->n, depth);
}

double contact_power_friction(const contact_power *power, const contact *c)
{
    double area;
    const size_t size = (size_t)power->n * sizeof power->waves[0];
    wave *waves = malloc(size);
    if (waves == NULL)
        abort();
    memcpy(waves, power->waves, size);
    load(c, c->velocity[0], power->steps, waves, &area);
    const double hysteresis = power_below(waves, power->n, 0) / (c->pressure * c->velocity[0]);
    free(waves);
    return hysteresis + shear(c, area);
}

void contact_power_free(contact_power *power)
{
    free(power);
}
