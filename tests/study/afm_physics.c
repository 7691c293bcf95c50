/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_physics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double facets(const afm_tip *t)
{
    const double m = t->sides == 0 ? 1 : t->sides / M_PI * sin(M_PI / t->sides);
    return m / tan(t->angle);
}

afm_tip afm_pyramid(double radius, double angle_degrees, unsigned sides)
{
    const double angle = angle_degrees * M_PI / 180;
    return (afm_tip){.radius = radius,
                     .angle = angle,
                     .b = radius * cos(angle),
                     .sides = sides,
                     .end = END_FACES};
}

static double thick_depth(const afm_tip *t, double a)
{
    if (t->end == END_FLAT)
        return a;
    if (t->end == END_SPHERE)
        return a < t->radius ? a / 2 * log((t->radius + a) / (t->radius - a)) : (double)INFINITY;
    if (a <= t->b)
        return a * a / t->radius;
    const double edge = sqrt(a * a - t->b * t->b);
    const double cap = t->b > 0 ? a * t->b * t->b / (t->radius * (a + edge)) : 0;
    return cap + facets(t) * a * acos(t->b / a);
}

static double thick_force(const afm_tip *t, double a)
{
    const double r = t->radius;
    if (t->end == END_FLAT)
        return 2 * r * a;
    if (t->end == END_SPHERE)
        return a < r ? (a * a + r * r) / 2 * log((r + a) / (r - a)) - a * r : (double)INFINITY;
    if (a <= t->b)
        return 4 * a * a * a / (3 * t->radius);
    const double edge = sqrt(a * a - t->b * t->b), c = facets(t) / 2;
    /* tip_depth a - a^3/(3R) + edge^3/(3R), arranged to avoid cancellation */
    const double round = t->b > 0 ? t->b * t->b / (t->radius * (a + edge)) *
                                        (a * a - (a * a + a * edge + edge * edge) / 3)
                                  : 0;
    return 2 * (round + c * a * a * acos(t->b / a) + c * edge * t->b);
}

double tip_depth(const afm_tip *t, double a)
{
    return thick_depth(t, a) * (t->thin != NULL ? thin_depth(t->thin, a) : 1);
}

double tip_force(const afm_tip *t, double a)
{
    return thick_force(t, a) * (t->thin != NULL ? thin_force(t->thin, a) : 1);
}

/* Root of an increasing function between two limits. */
#define BISECT(low, high, value_at_middle, wanted)                                                 \
    for (int k_ = 0; k_ < 200; k_++) {                                                             \
        const double middle = 0.5 * ((low) + (high));                                              \
        if (middle <= (low) || middle >= (high))                                                   \
            break;                                                                                 \
        *((value_at_middle) > (wanted) ? &(high) : &(low)) = middle;                               \
    }

double tip_contact_radius(const afm_tip *t, double depth)
{
    double low = 0, high = 1e-9;
    if (!(depth > 0))
        return 0;
    while (tip_depth(t, high) < depth)
        high *= 2;
    BISECT(low, high, tip_depth(t, middle), depth)
    return 0.5 * (low + high);
}

double jkr_depth(const jkr *j, double a)
{
    return tip_depth(j->tip, a) - sqrt(2 * M_PI * j->work * a / j->reduced);
}

double jkr_force(const jkr *j, double a)
{
    return j->reduced * tip_force(j->tip, a) - sqrt(8 * M_PI * j->reduced * j->work * a * a * a);
}

static double jkr_base(const jkr *j, double k, double a)
{
    return jkr_depth(j, a) + jkr_force(j, a) / k;
}

double jkr_release(const jkr *j, double k)
{
    const double ratio = 1.0005;
    double a = 1e-5, best = a;
    for (; a > 1e-13; a /= ratio)
        if (jkr_base(j, k, a) <= jkr_base(j, k, best))
            best = a;
        else if (best > ratio * a * ratio)
            break;
    /* minimum by golden section; it may be at an edge of the tip */
    double low = best / ratio, high = best * ratio;
    for (int i = 0; i < 100; i++) {
        const double g = 0.3819660112501051 * (high - low);
        *(jkr_base(j, k, low + g) < jkr_base(j, k, high - g) ? &high : &low) =
            jkr_base(j, k, low + g) < jkr_base(j, k, high - g) ? high - g : low + g;
    }
    return 0.5 * (low + high);
}

double jkr_radius(const jkr *j, double k, double base)
{
    double low = j->work > 0 ? jkr_release(j, k) : 0, high = 1e-9;
    if (base < (low > 0 ? jkr_base(j, k, low) : 0))
        return 0;
    while (high <= low || jkr_base(j, k, high) < base)
        high *= 2;
    BISECT(low, high, jkr_base(j, k, middle), base)
    return 0.5 * (low + high);
}

/* ---- loss ------------------------------------------------------------------------------------ */

double relaxation_modulus(const relaxation *r, double omega, double *tan_delta)
{
    double storage = r->rest, loss = 0;
    for (size_t i = 0; i < r->n; i++) {
        const double x = omega * r->tau[i];
        storage += r->e[i] * x * x / (1 + x * x);
        loss += r->e[i] * x / (1 + x * x);
    }
    *tan_delta = loss / storage;
    return hypot(storage, loss);
}

static relaxation cole_cole(double alpha, double centre)
{
    relaxation r = {.n = RELAXATIONS, .rest = 1};
    for (size_t i = 0; i < r.n; i++) {
        const double lg = -9 + 0.25 * (double)i;
        r.tau[i] = pow(10, lg);
        r.e[i] = 999 * 0.25 * M_LN10 / (2 * M_PI) * sin(alpha * M_PI) /
                 (cosh(alpha * M_LN10 * (lg - centre)) + cos(alpha * M_PI));
    }
    return r;
}

relaxation relaxation_cole_cole(double alpha, double tan_delta, int beyond)
{
    /* tan delta has its peak where E' is the geometric mean of the limits. */
    double low = beyond ? 4 : -9, high = -1.5 / alpha;
    relaxation r;
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        double found;
        r = cole_cole(alpha, middle);
        relaxation_modulus(&r, 1, &found);
        *(found > tan_delta ? &high : &low) = middle;
    }
    return r;
}

relaxation relaxation_power(double power, double tan_delta)
{
    relaxation r = {.n = 25};
    double found, low = 0, high = 1e6;
    for (size_t i = 0; i < r.n; i++) {
        r.tau[i] = pow(10, -3 + 0.25 * (double)i);
        r.e[i] = pow(r.tau[i], -power);
    }
    for (int k = 0; k < 100; k++) {
        r.rest = 0.5 * (low + high);
        relaxation_modulus(&r, 1, &found);
        *(found > tan_delta ? &low : &high) = r.rest;
    }
    return r;
}

relaxation relaxation_maxwell(double tan_delta)
{
    relaxation r = {.n = 1, .e = {1}, .tau = {1}}; /* E'' = 1/2, E' = rest + 1/2 */
    r.rest = 0.5 / tan_delta - 0.5;
    return r;
}

/* Data that the recursions of Lee-Radok and Ting store during the approach. */
typedef struct memory {
    const afm_tip *tip;
    const relaxation *r;
    double share, step, k;                       /* 1/(1 - nu^2) */
    double fade[RELAXATIONS], gain[RELAXATIONS]; /* exp(-x), (1 - exp(-x))/x */
    size_t n;                                    /* steps of the approach */
    double *depth, *f;                           /* [n] */
    double (*h)[RELAXATIONS], (*d)[RELAXATIONS]; /* running integrals of f and of the depth */
} memory;

/* Adds a step of the approach to a base position; returns the force. */
static double step_in(memory *m, double base)
{
    const relaxation *r = m->r;
    const size_t at = m->n++;
    const double f0 = at > 0 ? m->f[at - 1] : 0, d0 = at > 0 ? m->depth[at - 1] : 0;
    double past = 0, now = r->rest, low = 0, high = 1e-9;
    for (size_t i = 0; i < r->n; i++) {
        past += r->e[i] * ((at > 0 ? m->fade[i] * m->h[at - 1][i] : 0) - m->gain[i] * f0);
        now += r->e[i] * m->gain[i];
    }
#define BASE_AT(a) (tip_depth(m->tip, a) + m->share * (past + now * tip_force(m->tip, a)) / m->k)
    while (BASE_AT(high) < base)
        high *= 2;
    BISECT(low, high, BASE_AT(middle), base)
#undef BASE_AT
    const double a = 0.5 * (low + high);
    m->f[at] = tip_force(m->tip, a);
    m->depth[at] = tip_depth(m->tip, a);
    for (size_t i = 0; i < r->n; i++) {
        m->h[at][i] = (at > 0 ? m->fade[i] * m->h[at - 1][i] : 0) + m->gain[i] * (m->f[at] - f0);
        m->d[at][i] =
            (at > 0 ? m->fade[i] * m->d[at - 1][i] : 0) + m->gain[i] * (m->depth[at] - d0);
    }
    return m->share * (past + now * m->f[at]);
}

/* Integral of E ddepth from step j to now, which is `since` steps after the end of the approach. */
static double open_integral(const memory *m, size_t j, double since, double depth,
                            const double *now)
{
    double g = m->r->rest * (depth - m->depth[j]);
    for (size_t i = 0; i < m->r->n; i++)
        g +=
            m->r->e[i] *
            (now[i] - exp(-((double)(m->n - 1 - j) + since) * m->step / m->r->tau[i]) * m->d[j][i]);
    return g;
}

static double force_from(const memory *m, size_t j, double since)
{
    double f = m->r->rest * m->f[j];
    for (size_t i = 0; i < m->r->n; i++)
        f += m->r->e[i] * exp(-((double)(m->n - 1 - j) + since) * m->step / m->r->tau[i]) *
             m->h[j][i];
    return m->share * f;
}

/* Force at a depth during retraction; 0 without contact. No approach step after `from` has an
 * effect. */
static double ting(const memory *m, size_t *from, double since, double depth, const double *now)
{
    double above = open_integral(m, *from, since, depth, now);
    while (*from > 0) {
        const double below = open_integral(m, *from - 1, since, depth, now);
        if (below > 0) {
            const double part = below / (below - above);
            return part * force_from(m, *from, since) +
                   (1 - part) * force_from(m, *from - 1, since);
        }
        above = below;
        --*from;
    }
    return 0;
}

/* Adds a step of the retraction; d: running integrals of the depth, updated. */
static double step_out(const memory *m, size_t *from, double since, double base, double before,
                       double force_before, double *depth, double *d)
{
    double low = base - force_before / m->k, high = fmin(base, before), now[RELAXATIONS], force = 0;
    size_t start = *from;
    const int rounds = isinf(m->k) ? 1 : 40;
    if (isinf(m->k))
        low = high;
    for (int round = 0; round < rounds; round++) {
        *depth = 0.5 * (low + high);
        for (size_t i = 0; i < m->r->n; i++)
            now[i] = m->fade[i] * d[i] + m->gain[i] * (*depth - before);
        *from = start;
        force = ting(m, from, since, *depth, now);
        *(*depth + force / m->k > base ? &high : &low) = *depth;
    }
    for (size_t i = 0; i < m->r->n; i++)
        d[i] = now[i];
    return force;
}

int lossy_forces(const afm_tip *tip, const relaxation *r, double poisson, double k,
                 const double *base, size_t n, double step, double *force, double *depth)
{
    memory m = {.tip = tip, .r = r, .share = 1 / (1 - poisson * poisson), .step = step, .k = k};
    double d[RELAXATIONS], before = 0, force_before = 0, here = 0;
    size_t from = 0, since = 0;
    for (size_t i = 0; i < r->n; i++) {
        m.fade[i] = exp(-step / r->tau[i]);
        m.gain[i] = -expm1(-step / r->tau[i]) * r->tau[i] / step;
    }
    m.depth = calloc(n, sizeof *m.depth);
    m.f = calloc(n, sizeof *m.f);
    m.h = calloc(n, sizeof *m.h);
    m.d = calloc(n, sizeof *m.d);
    const int good = m.depth != NULL && m.f != NULL && m.h != NULL && m.d != NULL;
    for (size_t i = 0; good && i < n; i++) {
        if (tip->end == END_FLAT || (since == 0 && (i == 0 || base[i] >= base[i - 1]))) {
            /* The contact radius of a flat punch is constant. */
            force[i] = fmax(step_in(&m, base[i]), 0);
            here = m.depth[m.n - 1];
            from = m.n - 1;
            memcpy(d, m.d[from], sizeof d);
        } else {
            since++;
            force[i] = step_out(&m, &from, (double)since, base[i], before, force_before, &here, d);
        }
        before = here;
        force_before = force[i];
        if (depth != NULL)
            depth[i] = here;
    }
    free(m.depth);
    free(m.f);
    free(m.h);
    free(m.d);
    return good ? 0 : -1;
}

double layer_apparent(double ratio, double x)
{
    const double q = log(ratio);
    const double influence = 1 - 1 / (1 + (0.907 - 0.065 * q) * x + (0.999 - 0.762 * q) * x * x +
                                      (0.437 + 0.007 * q) * x * x * x);
    return 1 / (1 - influence + influence * ratio);
}
