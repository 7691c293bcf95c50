/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer_physics.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static const double complex unit = (double complex)I;

/* ---- contact --------------------------------------------------------------------------------- */

static void angles(const contact *c, const rubber_state *state, double omega, double *loss,
                   double *square)
{
    const double step = 0.25, kappa = 1 / (1 - c->poisson * c->poisson);
    *loss = *square = 0;
    for (int k = 0; k <= 120; k++) {
        const double cosine = 1 / cosh(step * k), weight = k == 0 ? step / 2 : step;
        double storage, lost;
        state_moduli(state, omega * cosine, &storage, &lost);
        *loss += 4 * weight * cosine * cosine * kappa * lost;
        *square += 4 * weight * cosine * kappa * kappa * (storage * storage + lost * lost);
    }
}

void slide_make(const contact *c, const rubber_state *state, double velocity, slide *to)
{
    to->contact = c;
    to->velocity = velocity;
    to->step = log(c->q1 / c->q0) / (WAVES - 1);
    for (int i = 0; i < WAVES; i++) {
        const double q = c->q0 * exp(to->step * i);
        const double density = q <= c->qr ? c->c0 : c->c0 * pow(q / c->qr, -2 * (1 + c->hurst));
        to->q[i] = q;
        to->density[i] = q * q * q * density;
        angles(c, state, q * velocity, &to->loss[i], &to->square[i]);
    }
}

double layer_seen(double x, double ratio)
{
    const double n = (ratio - 1) / (ratio + 1), fall = exp(-2 * x);
    const double above = 1 + 4 * n * x * fall - n * n * fall * fall,
                 below = 1 - 2 * n * (1 + 2 * x * x) * fall + n * n * fall * fall;
    return ratio * below / above;
}

/* Trapezia of ln q; power may be NULL. */
static void run_through(const slide *s, double pressure, double thickness, double ratio,
                        double *hysteresis, double *area, double *power)
{
    double variance = 0, before = 0;
    *hysteresis = 0;
    for (int i = 0; i < WAVES; i++) {
        const double factor = thickness > 0 ? layer_seen(s->q[i] * thickness, ratio) : 1;
        const double here =
            s->q[i] * s->density[i] * factor * factor * s->square[i] / (8 * pressure * pressure);
        variance += i > 0 ? s->step / 2 * (before + here) : 0;
        before = here;
        *area = variance > 0 ? erf(1 / (2 * sqrt(variance))) : 1;
        const double weight = s->q[i] * s->step * (i == 0 || i == WAVES - 1 ? 0.5 : 1);
        const double part = weight * s->density[i] * factor * s->loss[i] * *area / 2;
        *hysteresis += part / pressure;
        if (power != NULL)
            power[i] = part * s->velocity;
    }
}

void slide_friction(const slide *s, double pressure, double thickness, double ratio,
                    double *hysteresis, double *area)
{
    run_through(s, pressure, thickness, ratio, hysteresis, area, NULL);
}

void heat_make(const slide *s, double pressure, double severity, heat *to)
{
    double hysteresis, area;
    to->slide = s;
    run_through(s, pressure, 0, 1, &hysteresis, &area, to->power);
    to->surface = hysteresis * pressure * s->velocity;
    to->wear = s->contact->wear_rate * (severity > 0 ? 1 + to->surface / severity : 1) * pressure *
               s->velocity;
}

double heat_below(const heat *h, double depth)
{
    double sum = 0;
    for (int i = 0; i < WAVES; i++)
        sum += h->power[i] * exp(-2 * h->slide->q[i] * depth);
    return sum;
}

/* ---- a layer with moduli of its own ---------------------------------------------------------- */

double own_phase(const own_ratio *own, double omega)
{
    const int steps = 2000;
    const double low = log(own->low / omega), high = log(own->high / omega),
                 step = (high - low) / steps;
    double sum = 0;
    for (int k = 0; k < steps; k++) {
        const double y = fabs(low + step * (k + 0.5)) / 2;
        sum += step * log(1 / tanh(y > 1e-12 ? y : 1e-12));
    }
    return own->slope / acos(-1) * sum;
}

static double own_size(const own_ratio *own, double omega)
{
    const double held = fmin(fmax(omega, own->low), own->high);
    return own->ratio * pow(held / own->reference, own->slope);
}

/* Both moduli against ln omega, in equal steps up to the highest frequency. */
enum { TABULATED = 1601 };
typedef struct tabulated {
    double first, step;
    double complex bulk[TABULATED], ratio[TABULATED];
} tabulated;

static void tabulate(const slide *s, const rubber_state *state, const own_ratio *own, tabulated *to)
{
    const double last = log(s->q[WAVES - 1] * s->velocity);
    to->step = 0.02;
    to->first = last - to->step * (TABULATED - 2);
    for (int k = 0; k < TABULATED; k++) {
        const double omega = exp(to->first + to->step * k);
        double storage, loss;
        state_moduli(state, omega, &storage, &loss);
        to->bulk[k] = storage + unit * loss;
        const double phase = own_phase(own, omega), size = own_size(own, omega);
        to->ratio[k] = size * cos(phase) + unit * (size * sin(phase));
    }
}

/* What a wave sees of both at a frequency. */
static double complex own_seen(const tabulated *t, double log_omega, double x)
{
    const double place = fmax(0, (log_omega - t->first) / t->step);
    const int k = (int)place < TABULATED - 1 ? (int)place : TABULATED - 2;
    const double part = place - k;
    const double complex bulk = t->bulk[k] + part * (t->bulk[k + 1] - t->bulk[k]),
                         ratio = t->ratio[k] + part * (t->ratio[k + 1] - t->ratio[k]);
    const double complex n = (ratio - 1) / (ratio + 1);
    const double fall = exp(-2 * x);
    return bulk * ratio * (1 - 2 * n * (1 + 2 * x * x) * fall + n * n * fall * fall) /
           (1 + 4 * n * x * fall - n * n * fall * fall);
}

double slide_on_own(const slide *s, const rubber_state *state, double pressure, double thickness,
                    const own_ratio *own)
{
    const contact *c = s->contact;
    const double kappa = 1 / (1 - c->poisson * c->poisson), step = 0.25;
    slide felt = *s;
    tabulated *t = malloc(sizeof *t);
    double hysteresis, area;
    if (t == NULL)
        abort();
    tabulate(s, state, own, t);
    for (int i = 0; i < WAVES; i++) {
        felt.loss[i] = felt.square[i] = 0;
        for (int k = 0; k <= 100; k++) {
            const double cosine = 1 / cosh(step * k), weight = k == 0 ? step / 2 : step;
            const double complex e =
                own_seen(t, log(s->q[i] * s->velocity * cosine), s->q[i] * thickness);
            felt.loss[i] += 4 * weight * cosine * cosine * kappa * cimag(e);
            felt.square[i] += 4 * weight * cosine * kappa * kappa * creal(e * conj(e));
        }
    }
    free(t);
    slide_friction(&felt, pressure, 0, 1, &hysteresis, &area);
    return hysteresis + own_size(own, s->velocity / thickness) * c->shear_stress * area / pressure;
}

/* ---- damage ---------------------------------------------------------------------------------- */

/* At a depth, 1: modified. What a load gave is the energy over the way that the rubber went up. */
static double damage(const history *h, double time, double depth)
{
    const double energy = h->load[0]->slide->contact->critical_energy;
    double begin = 0, worn = 0, sum = 0, way[LOADS_MAX];
    int now = 0;
    for (int i = 0; i < h->n; i++) {
        const double left = time - begin;
        const double lasts = i + 1 < h->n && h->lasts[i] < left ? h->lasts[i] : left;
        way[i] = lasts > 0 ? h->load[i]->wear * lasts : 0;
        now = lasts > 0 ? i : now;
        begin += i + 1 < h->n ? h->lasts[i] : 0;
    }
    for (int i = now; i >= 0; i--) {
        sum +=
            (heat_below(h->load[i], depth + worn) - heat_below(h->load[i], depth + worn + way[i])) /
            (energy * h->load[i]->wear);
        worn += way[i];
    }
    return sum;
}

double history_thickness(const history *h, double time)
{
    double low = log(1e-13), high = log(1e-2);
    if (damage(h, time, exp(low)) < 1)
        return 0;
    for (int k = 0; k < 60; k++) {
        const double middle = (low + high) / 2;
        *(damage(h, time, exp(middle)) >= 1 ? &low : &high) = middle;
    }
    return exp(low);
}

double history_first(const history *h, double latest)
{
    const int steps = 2000;
    const double least = 1e-7 * latest;
    double before = 0;
    for (int k = 0; k <= steps; k++) {
        const double time = least * pow(latest / least, (double)k / steps);
        if (damage(h, time, 0) < 1) {
            before = time;
            continue;
        }
        double low = before, high = time;
        for (int i = 0; i < 60; i++) {
            const double middle = (low + high) / 2;
            *(damage(h, middle, 0) < 1 ? &low : &high) = middle;
        }
        return high;
    }
    return (double)NAN;
}

double heat_balance(const heat *h)
{
    const double needed = h->slide->contact->critical_energy * h->wear;
    double low = log(1e-13), high = log(1e-2);
    if (h->surface <= needed)
        return 0;
    for (int k = 0; k < 80; k++) {
        const double middle = (low + high) / 2;
        *(heat_below(h, exp(middle)) > needed ? &low : &high) = middle;
    }
    return exp(low);
}

/* ---- friction -------------------------------------------------------------------------------- */

static double friction_of(const heat *h, double thickness, double ratio)
{
    const contact *c = h->slide->contact;
    double hysteresis, area;
    slide_friction(h->slide, c->pressure, thickness, ratio, &hysteresis, &area);
    return hysteresis + c->shear_stress * (thickness > 0 ? ratio : 1) * area / c->pressure;
}

/* The last time at which a twentieth of the change of friction is left. */
settling settle(const heat *h, double ratio)
{
    const int steps = 240;
    history alone = {.n = 1, .load = {(heat *)h}};
    const double thickness = heat_balance(h), end = friction_of(h, thickness, ratio),
                 limit = 0.05 * fabs(friction_of(h, 0, ratio) - end);
    const double latest = 30 * thickness / h->wear, least = 1e-6 * latest;
    settling found = {end, (double)NAN};
    for (int k = steps; k >= 0; k--) {
        const double time = least * pow(latest / least, (double)k / steps);
        const double off = friction_of(h, history_thickness(&alone, time), ratio) - end;
        if (fabs(off) <= limit)
            continue;
        double low = time, high = time * pow(latest / least, 1.0 / steps);
        for (int i = 0; i < 30; i++) {
            const double middle = sqrt(low * high);
            const double rest = friction_of(h, history_thickness(&alone, middle), ratio) - end;
            *(fabs(rest) > limit ? &low : &high) = middle;
        }
        found.settled = high;
        break;
    }
    return found;
}
