/* Reference values of friction in long double arithmetic.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/reference_values.h"

#include <complex.h>
#include <math.h>

typedef long double real;
typedef long double complex complex_real;

static real pi(void)
{
    return acosl(-1);
}

/* ---- angle ----------------------------------------------------------------------------------- */

/* Equivalent isotropic modulus of the surface of a transversely isotropic solid, from the
 * plane-strain compliances. */
static complex_real surface_modulus(const reference_material *m, complex_real e)
{
    const real nu = (real)m->poisson_ratio;
    const complex_real axial =
        (real)m->axial_storage * creall(e) + (real)m->axial_loss * cimagl(e) * (complex_real)I;
    const complex_real b11 = (1 - nu * nu) / e, b33 = (1 - nu * nu * e / axial) / axial,
                       b13 = -nu * (1 + nu) / axial;
    const complex_real shear = 2 * (1 + nu) / e;
    return 2 * (1 - nu * nu) /
           (csqrtl(b33) * csqrtl(shear + 2 * (b13 + csqrtl(b11) * csqrtl(b33))));
}

static complex_real complex_modulus(const reference_material *m, real omega)
{
    complex_real e = (real)m->e0;
    for (size_t k = 0; k < m->n; k++) {
        const real x = omega * (real)m->tau[k];
        const complex_real ix = x * (complex_real)I;
        const complex_real z = m->alpha < 1 ? cpowl(ix, (real)m->alpha) : ix;
        e += (real)m->e[k] * z / (1 + z);
    }
    return m->axial_storage > 0 ? surface_modulus(m, e) : e;
}

typedef struct integrals {
    real j1, j2;
} integrals;

/* 4 int sin(u) E''(w sin u) du and 4 int |E|^2 du from a to b, with u = pi/2 - phi, by a tanh-sinh
 * rule. It tolerates singular derivatives at the limits. */
static integrals integrate_segment(const reference_material *m, real w, real a, real b)
{
    enum { HALF = 40 }; /* nodes on each side */
    const real step = 3.2L / HALF, middle = (a + b) / 2, half = (b - a) / 2;
    integrals sum = {0, 0};
    for (int i = -HALF; i <= HALF; i++) {
        const real t = step * i, s = pi() / 2 * sinhl(t), c = coshl(s);
        const real weight = 4 * half * step * pi() / 2 * coshl(t) / (c * c);
        /* measured from the nearer limit, so that a small u keeps its digits */
        const real from_end = half * expl(-fabsl(s)) / c;
        const real u = i < 0 ? a + from_end : i > 0 ? b - from_end : middle;
        const complex_real e = complex_modulus(m, w * sinl(u));
        sum.j1 += weight * sinl(u) * cimagl(e);
        sum.j2 += weight * (creall(e) * creall(e) + cimagl(e) * cimagl(e));
    }
    return sum;
}

/* Splits the integral where w sin(u) is a relaxation frequency. */
static integrals integrate_angle(const reference_material *m, real w)
{
    integrals sum = {0, 0};
    real from = 0;
    for (size_t k = 0; k <= m->n; k++) {
        const real x = k < m->n ? 1 / (w * (real)m->tau[k]) : 1;
        const real to = x < 1 ? asinl(x) : pi() / 2;
        if (to > from) {
            const integrals part = integrate_segment(m, w, from, to);
            sum.j1 += part.j1;
            sum.j2 += part.j2;
            from = to;
        }
    }
    return sum;
}

void reference_angle(const reference_material *material, double w, double *j1, double *j2)
{
    const integrals j = integrate_angle(material, (real)w);
    *j1 = (double)j.j1;
    *j2 = (double)j.j2;
}

/* ---- wavenumber ------------------------------------------------------------------------------ */

enum { MOST_ORDER = 24 }; /* as stated in the header */

typedef struct gauss_rule {
    int n;
    real node[MOST_ORDER], weight[MOST_ORDER];
} gauss_rule;

/* Gauss-Legendre rule on [0, 1] by Newton's method. */
static gauss_rule gauss_legendre(int n)
{
    gauss_rule r = {.n = n};
    for (int i = 0; i < n; i++) {
        real x = cosl(pi() * (i + 0.75L) / (n + 0.5L)), slope = 1;
        for (int step = 0; step < 50; step++) {
            real p = 1, before = 0;
            for (int k = 1; k <= n; k++) {
                const real next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        r.node[n - 1 - i] = (1 + x) / 2;
        r.weight[n - 1 - i] = 1 / ((1 - x * x) * slope * slope);
    }
    return r;
}

typedef struct friction_integral {
    const reference_contact *c;
    gauss_rule gauss_rule;
    real stiffness; /* 1 / ((1 - nu^2) pressure) */
    real variance, hysteresis;
} friction_integral;

/* Returns q^4 C times the angular integrals at q0 exp(t). */
static integrals integrand_at(const friction_integral *s, real t)
{
    const reference_contact *c = s->c;
    const real q = (real)c->q0 * expl(t), qr = (real)c->qr;
    const real density =
        (real)c->c0 * (q > qr ? powl(q / qr, -2 * (1 + (real)c->hurst)) : 1) * q * q * q * q;
    const integrals j = integrate_angle(&c->material, q * (real)c->velocity);
    return (integrals){density * j.j1, density * j.j2};
}

static real variance_between(const friction_integral *s, real a, real b)
{
    real sum = 0;
    for (int i = 0; i < s->gauss_rule.n; i++)
        sum += s->gauss_rule.weight[i] * integrand_at(s, a + (b - a) * s->gauss_rule.node[i]).j2;
    return (b - a) * sum * s->stiffness * s->stiffness / 8;
}

static void add_subinterval(friction_integral *s, real a, real b)
{
    real sum = 0;
    for (int i = 0; i < s->gauss_rule.n; i++) {
        const real t = a + (b - a) * s->gauss_rule.node[i];
        const real g = s->variance + variance_between(s, a, t);
        sum += s->gauss_rule.weight[i] * integrand_at(s, t).j1 * erfl(1 / (2 * sqrtl(g)));
    }
    s->hysteresis += (b - a) * sum * s->stiffness / 2;
    s->variance += variance_between(s, a, b);
}

/* Subintervals that grow by this factor from the start, where the area changes fastest, up to the
 * largest width. Two orders determine their accuracy. */
#define WIDTH_RATIO 3
#define FIRST_WIDTH 1e-9L
#define MAX_WIDTH 0.7L

static void add_subintervals(friction_integral *s, real from, real to)
{
    real t = from;
    while (t < to) {
        const real width = from > 0 || t > 0
                               ? fminl(MAX_WIDTH, fmaxl((WIDTH_RATIO - 1) * t, FIRST_WIDTH))
                               : FIRST_WIDTH;
        const real next = t + 1.5L * width < to ? t + width : to;
        add_subinterval(s, t, next);
        t = next;
    }
}

double reference_friction(const reference_contact *c, int order)
{
    const real nu = (real)c->poisson_ratio, q0 = (real)c->q0;
    friction_integral s = {.c = c,
                           .gauss_rule = gauss_legendre(order),
                           .stiffness = 1 / ((1 - nu * nu) * (real)c->pressure)};
    const real roll_off = logl((real)c->qr / q0);
    add_subintervals(&s, 0, roll_off);
    add_subintervals(&s, roll_off, logl((real)c->q1 / q0));
    return (double)s.hysteresis;
}
