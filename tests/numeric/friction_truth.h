/* Friction by a quadrature that is independent of the library: G, P and mu of one scene in long
 * double, or in quad precision with FRICTION_TRUTH_QUAD (gcc).
 *
 * Double sums replace the closed forms, and the angle is integrated from knot to knot. Subintervals
 * in ln q are halved until the integrand is a polynomial to 16 digits. A transversely isotropic
 * solid uses the published compliance of its surface. */
#ifndef WT_TESTS_FRICTION_TRUTH_H
#define WT_TESTS_FRICTION_TRUTH_H

#include "numeric/friction_scene.h"

#include <stdlib.h>

#ifdef FRICTION_TRUTH_QUAD
#include <complex.h>
#include <quadmath.h>
typedef __float128 real;
typedef __complex128 pair;
#define FN(name) name##q
#define TRUTH_PI M_PIq
#define TRUTH_DEEP 80 /* number of e-folds below w that contribute */
#define TRUTH_SMALL (real)1e-16
#else
#include <complex.h>
typedef long double real;
typedef long double _Complex pair;
#define FN(name) name##l
#define TRUTH_PI M_PIl
#define TRUTH_DEEP 52
#define TRUTH_SMALL 1e-14L
#endif

typedef struct truth {
    real variance, hysteresis;
} truth;

/* ---- a rule ---------------------------------------------------------------------------------- */

enum { NODES = 20 };

/* Gauss-Legendre rule on [0, 1], the Legendre polynomials at its nodes, and the integrals from 0 to
 * each node of the Lagrange polynomials. */
static real node[NODES], weight[NODES], legendre[NODES][NODES], running[NODES][NODES];
/* Subintervals of the angle: near a pole 12 nodes have an error below 1e-24. */
enum { ANGLES = 12 };
static real angle_node[ANGLES], angle_weight[ANGLES];

static void make_legendre(real x, real *p)
{
    const real z = 2 * x - 1;
    p[0] = 1;
    p[1] = z;
    for (int k = 1; k + 1 < NODES; k++)
        p[k + 1] = ((2 * k + 1) * z * p[k] - k * p[k - 1]) / (k + 1);
}

static void make_gauss(int n, real *nodes, real *weights)
{
    for (int i = 0; i < n; i++) {
        real x = FN(cos)(TRUTH_PI * (i + (real)0.75) / (n + (real)0.5)), slope = 0;
        for (int k = 0; k < 60; k++) {
            real p = 1, last = 0;
            for (int j = 0; j < n; j++) {
                const real next = ((2 * j + 1) * x * p - j * last) / (j + 1);
                last = p;
                p = next;
            }
            slope = n * (x * p - last) / (x * x - 1);
            x -= p / slope;
        }
        nodes[i] = (1 + x) / 2;
        weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

static void make_rule(void)
{
    make_gauss(ANGLES, angle_node, angle_weight);
    make_gauss(NODES, node, weight);
    for (int i = 0; i < NODES; i++)
        make_legendre(node[i], legendre[i]);
    /* int_0^x P_k = (P_(k+1) - P_(k-1)) / (4k + 2) */
    for (int to = 0; to < NODES; to++)
        for (int i = 0; i < NODES; i++) {
            const real z = 2 * node[to] - 1, *p = legendre[to];
            running[to][i] = weight[i] * node[to];
            for (int k = 1; k < NODES; k++) {
                const real next =
                    k + 1 < NODES ? p[k + 1] : ((2 * k + 1) * z * p[k] - k * p[k - 1]) / (k + 1);
                running[to][i] += weight[i] * legendre[i][k] * (next - p[k - 1]) / 2;
            }
        }
}

/* Computes Legendre coefficients and the size of the last ones. */
static real expand(const real *value, real *coefficient)
{
    real most = 0;
    for (int k = 0; k < NODES; k++) {
        coefficient[k] = 0;
        for (int i = 0; i < NODES; i++)
            coefficient[k] += (2 * k + 1) * weight[i] * value[i] * legendre[i][k];
        most = FN(fmax)(most, FN(fabs)(coefficient[k]));
    }
    const real tail = FN(fabs)(coefficient[NODES - 1]) + FN(fabs)(coefficient[NODES - 2]);
    return most > 0 ? tail / most : 0;
}

/* True if halves are not more accurate: the coefficients decay, or `before`, from twice the width,
 * shows that only rounding is left. */
static bool is_fine(real tail, real before)
{
    return tail <= TRUTH_SMALL || (tail <= (real)1e-9 && tail > before / 4);
}

static real series_at(const real *coefficient, real x)
{
    real p[NODES], sum = 0;
    make_legendre(x, p);
    for (int k = 0; k < NODES; k++)
        sum += coefficient[k] * p[k];
    return sum;
}

/* ---- material -------------------------------------------------------------------------------- */

/* Table of the current scene, from knot to knot: logarithms of frequencies and moduli. */
static real log_width[SCENE_MOST], log_storage[SCENE_MOST], log_loss[SCENE_MOST];

static void compute_logarithms(const scene *s)
{
    for (size_t k = 0; s->law == TABLE && k + 1 < s->n; k++) {
        log_width[k] = FN(log)((real)s->tau[k + 1] / s->tau[k]);
        log_storage[k] = FN(log)((real)s->e[k + 1] / s->e[k]);
        log_loss[k] = FN(log)((real)s->loss[k + 1] / s->loss[k]);
    }
}

static void table_modulus(const scene *s, real omega, real *storage, real *loss)
{
    const size_t last = s->n - 1;
    const real x = s->slope ? omega : FN(fmin)(FN(fmax)(omega, s->tau[0]), s->tau[last]);
    size_t k = 0, end = last;
    while (k + 1 < end) {
        const size_t middle = (k + end) / 2;
        if (x > s->tau[middle])
            k = middle;
        else
            end = middle;
    }
    const real t = FN(log)(x / s->tau[k]) / log_width[k];
    *storage = s->e[k] * FN(exp)(t * log_storage[k]);
    *loss = s->loss[k] * FN(exp)(t * log_loss[k]);
}

static void law_modulus(const scene *s, real omega, real *storage, real *loss)
{
    if (s->law == TABLE) {
        table_modulus(s, omega, storage, loss);
        return;
    }
    real re = s->e0, im = 0;
    for (size_t k = 0; s->law == PRONY && k < s->n; k++) {
        const real a = omega * s->tau[k];
        re += s->e[k] * (a / (1 + a * a)) * a;
        im += s->e[k] * (a / (1 + a * a));
    }
    if (s->law == ZENER) {
        const real r = FN(exp)(s->alpha * FN(log)(omega * s->tau[0]));
        const real turn = s->alpha * TRUTH_PI / 2;
        const pair z = r * (FN(cos)(turn) + FN(sin)(turn) * (pair)I);
        const pair e = s->e[0] + ((real)s->e[1] - s->e[0]) / (1 + 1 / z);
        re = FN(creal)(e);
        im = FN(cimag)(e);
    }
    *storage = re;
    *loss = im;
}

/* Strain softening of the current scene. */
static real soft_storage = 1, soft_loss = 1;

static void modulus(const scene *s, real omega, real *storage, real *loss)
{
    const wt_transverse *t = &s->factors;
    law_modulus(s, omega, storage, loss);
    if (!s->transverse) {
        *storage *= soft_storage;
        *loss *= soft_loss;
        return;
    }
    const pair i = (pair)I;
    const pair plane = t->plane_storage * *storage + t->plane_loss * *loss * i,
               axial = t->axial_storage * *storage + t->axial_loss * *loss * i,
               shear = (t->shear_storage * *storage + t->shear_loss * *loss * i) /
                       (2 * (1 + (real)t->plane_poisson));
    const real nu_p = t->plane_poisson, nu_zp = t->axial_poisson;
    const pair b11 = (1 - nu_p * nu_p) / plane, b33 = (1 - nu_zp * nu_zp * plane / axial) / axial,
               b13 = -nu_zp * (1 + nu_p) / axial;
    const pair d =
        FN(csqrt)(b33) * FN(csqrt)(1 / shear + 2 * (b13 + FN(csqrt)(b11) * FN(csqrt)(b33)));
    const pair e = 2 * (1 - (real)s->nu * s->nu) / d;
    *storage = soft_storage * FN(creal)(e);
    *loss = soft_loss * FN(cimag)(e);
}

/* ---- angle ----------------------------------------------------------------------------------- */

/* From ln(omega / w) = -low to -high, 0 <= high < low, where the moduli are smooth and change by at
 * most one e-fold over `wide`: cos(phi) = exp(-t^2). */
static void angle_piece(const scene *s, real w, real low, real high, real wide, real *j1, real *j2)
{
    const real end = FN(sqrt)(low), longest = s->transverse ? (real)0.2 : (real)0.35;
    real from = FN(sqrt)(high);
    while (from < end) {
        const real more = wide * (1 + from * from / 8); /* c^s is negligible there. */
        const real to = FN(fmin)(FN(fmin)(from + longest, FN(sqrt)(from * from + more)), end);
        for (int i = 0; i < ANGLES; i++) {
            const real t = from + (to - from) * angle_node[i], c = FN(exp)(-t * t);
            const real d =
                4 * (to - from) * angle_weight[i] * 2 * t * c / FN(sqrt)(-FN(expm1)(-2 * t * t));
            real storage, loss;
            modulus(s, w * c, &storage, &loss);
            *j1 += d * c * loss;
            *j2 += d * (storage * storage + loss * loss);
        }
        from = to;
    }
}

/* The same where the moduli are constant. */
static void angle_constant(const scene *s, real omega, real low, real high, real *j1, real *j2)
{
    real storage, loss;
    modulus(s, omega, &storage, &loss);
    const real sines = FN(sqrt)((1 - low) * (1 + low)) + FN(sqrt)((1 - high) * (1 + high));
    *j1 += 4 * loss * (high - low) * (high + low) / sines;
    *j2 += 4 * (storage * storage + loss * loss) * (FN(asin)(high) - FN(asin)(low));
}

/* Slopes of ln E' and ln E'' between two knots: the smaller and the larger. */
static void table_slopes(size_t k, real *least, real *most)
{
    const real storage = log_storage[k] / log_width[k], loss = log_loss[k] / log_width[k];
    *least = FN(fmin)(storage, loss);
    *most = FN(fmax)(FN(fabs)(storage), FN(fabs)(loss));
}

static void table_angular(const scene *s, real w, real *j1, real *j2)
{
    const real most_down = 110, first = s->tau[0], last = s->tau[s->n - 1];
    real least, most;
    if (!s->slope) {
        angle_constant(s, first, 0, FN(fmin)(1, first / w), j1, j2);
    } else {
        const real high = FN(fmax)(0, FN(log)(w / first));
        table_slopes(0, &least, &most);
        angle_piece(s, w, high + FN(fmin)(most_down, 60 / (1 + 2 * least)), high,
                    FN(fmin)((real)0.5, 3 / (1 + 2 * most)), j1, j2);
    }
    for (size_t k = 0; k + 1 < s->n && s->tau[k] < w; k++) {
        const real low = FN(log)(w / s->tau[k]);
        const real high = s->tau[k + 1] < w ? FN(log)(w / s->tau[k + 1]) : 0;
        table_slopes(k, &least, &most);
        const real wide = FN(fmin)(s->transverse ? (real)0.3 : 1, 3 / (1 + 2 * most));
        if (high < most_down)
            angle_piece(s, w, low, high, wide, j1, j2);
    }
    if (w > last && !s->slope) {
        angle_constant(s, w, last / w, 1, j1, j2);
    } else if (w > last) {
        table_slopes(s->n - 2, &least, &most);
        angle_piece(s, w, FN(log)(w / last), 0, FN(fmin)((real)0.5, 3 / (1 + 2 * most)), j1, j2);
    }
}

static void angular(const scene *s, real w, real *j1, real *j2)
{
    *j1 = *j2 = 0;
    if (s->law == TABLE) {
        table_angular(s, w, j1, j2);
        return;
    }
    if (s->law == ZENER || s->transverse || s->n_strain > 0) {
        angle_piece(s, w, TRUTH_DEEP, 0, s->transverse ? (real)0.5 : 2, j1, j2);
        return;
    }
    static real part[SCENE_MOST];
    real sum = (real)s->e0 * s->e0;
    for (size_t k = 0; k < s->n; k++) {
        const real a = w * s->tau[k], r = FN(sqrt)(1 + a * a), mine = a * a / (r * (1 + r));
        *j1 += s->e[k] * a / (r * (1 + r));
        sum += 2 * (real)s->e0 * s->e[k] * mine;
        part[k] = mine;
        for (size_t m = 0; m <= k; m++) {
            /* int Re[i a c / (1 + i a c) conj(i b c / (1 + i b c))] over the circle / 2 pi */
            const real b = w * s->tau[m];
            sum += (m < k ? 2 : 1) * (real)s->e[k] * s->e[m] * (mine * b + part[m] * a) / (a + b);
        }
    }
    *j1 *= 2 * TRUTH_PI;
    *j2 = 2 * TRUTH_PI * sum;
}

/* ---- wavenumbers ----------------------------------------------------------------------------- */

static real density_at(const scene *s, real q)
{
    if (s->n_density == 0)
        return q > s->qr ? s->c0 * FN(pow)(q / s->qr, -2 * (1 + (real)s->hurst)) : s->c0;
    size_t k = 0;
    while (k + 2 < s->n_density && q > s->wavenumber[k + 1])
        k++;
    const real t =
        FN(log)(q / s->wavenumber[k]) / FN(log)((real)s->wavenumber[k + 1] / s->wavenumber[k]);
    return s->density[k] * FN(pow)((real)s->density[k + 1] / s->density[k], t);
}

/* Burmister (1943), nu = 1/2, bonded layer; relative to the modulus of the bulk. */
static real layer_scale(const scene *s, real q)
{
    if (!(s->thickness > 0))
        return 1;
    const real n = ((real)s->ratio - 1) / ((real)s->ratio + 1), x = q * s->thickness;
    const real e = FN(exp)(-2 * x);
    return s->ratio * (1 - 2 * n * (1 + 2 * x * x) * e + n * n * e * e) /
           (1 + 4 * n * x * e - n * n * e * e);
}

/* int k^4 C dt up to t, on subintervals between the slope changes of the spectrum, each a power
 * law. */
static real slope_moment(const scene *s, real t)
{
    const size_t bends = s->n_density > 0 ? s->n_density : 1;
    real from = 0, sum = 0;
    for (size_t k = 0; k <= bends && from < t; k++) {
        const real bend = k == bends         ? t
                          : s->n_density > 0 ? FN(log)((real)s->wavenumber[k] / s->q0)
                                             : FN(log)((real)s->qr / s->q0);
        const real to = FN(fmin)(bend, t);
        while (from < to) {
            const real end = FN(fmin)(to, from + (real)0.5);
            for (int i = 0; i < NODES; i++) {
                const real q = s->q0 * FN(exp)(from + (end - from) * node[i]);
                sum += (end - from) * weight[i] * q * q * q * q * density_at(s, q);
            }
            from = end;
        }
    }
    return sum;
}

static real strain_at(const scene *s, real t)
{
    return s->strain_factor * FN(sqrt)(2 * TRUTH_PI * slope_moment(s, t));
}

/* Finds by bisection where the strain is reached; a negative number if it is not. */
static real find_strain(const scene *s, real strain, real length)
{
    real low = 0, high = length;
    if (!(strain_at(s, length) > strain))
        return -1;
    for (int i = 0; i < 140; i++) {
        const real middle = i < 40 ? low + (high - low) / 16 : (low + high) / 2;
        if (strain_at(s, middle) > strain)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static void soften(const scene *s, real t)
{
    const real strain = strain_at(s, t);
    size_t k = 0;
    while (k < s->n_strain && s->strain[k] <= strain)
        k++;
    const size_t left = k > 0 ? k - 1 : 0, right = k < s->n_strain ? k : s->n_strain - 1;
    const real part = left < right ? FN(log)(strain / s->strain[left]) /
                                         FN(log)((real)s->strain[right] / s->strain[left])
                                   : 0;
    soft_storage = (1 - part) * s->f[left] + part * s->f[right];
    soft_loss = (1 - part) * s->g[left] + part * s->g[right];
}

/* d G / dt and, without S P, d mu / dt at q = q0 exp(t). */
static void integrand(const scene *s, real t, real *g, real *mu)
{
    real j1, j2;
    const real q = s->q0 * FN(exp)(t);
    const real stiff = layer_scale(s, q) / (1 - (real)s->nu * s->nu) / s->pressure;
    const real power = q * q * q * q * density_at(s, q);
    if (s->n_strain > 0)
        soften(s, t);
    angular(s, q * s->velocity, &j1, &j2);
    soft_storage = soft_loss = 1;
    *g = power * j2 * stiff * stiff / 8;
    *mu = power * j1 * stiff / 2;
}

static real area(real variance)
{
    return variance > 0 ? FN(erf)(1 / (2 * FN(sqrt)(variance))) : 1;
}

/* t = from + (root + width u)^2 - root^2, with g and mu as polynomials in u. */
typedef struct panel {
    real root, width, start; /* start: G in front of the subinterval */
    real g[NODES], mu[NODES];
    real gamma;
} panel;

static real slope_at(const panel *p, real u)
{
    return 2 * p->width * (p->root + p->width * u);
}

/* int g dt from u = a to b. */
static real rise(const panel *p, real a, real b)
{
    real sum = 0;
    for (int i = 0; i < NODES; i++) {
        const real u = a + (b - a) * node[i];
        sum += (b - a) * weight[i] * slope_at(p, u) * series_at(p->g, u);
    }
    return sum;
}

/* P is 1 to 30 digits below this point. */
static const double full_contact = 0.0037;

/* int S P mu dt from u = a, where G is `variance`, to b. */
static real contact_part(const panel *p, real a, real b, real variance, real before, int depth)
{
    real g[NODES], value[NODES], coefficient[NODES], sum = 0, end = variance;
    for (int i = 0; i < NODES; i++) {
        const real u = a + (b - a) * node[i];
        g[i] = (b - a) * slope_at(p, u) * series_at(p->g, u);
        end += weight[i] * g[i];
    }
    for (int i = 0; i < NODES; i++) {
        real here = variance;
        for (int j = 0; j < NODES; j++)
            here += running[i][j] * g[j];
        const real u = a + (b - a) * node[i], P = area(here);
        value[i] = slope_at(p, u) * series_at(p->mu, u) * P * (p->gamma + (1 - p->gamma) * P * P);
        sum += (b - a) * weight[i] * value[i];
    }
    const bool begins = a == 0 && variance == 0 && end > full_contact;
    const real tail = expand(value, coefficient);
    if ((is_fine(tail, before) && !begins) || depth > 150 || (depth > 20 && a > 0))
        return sum;
    const real half = rise(p, a, (a + b) / 2);
    return contact_part(p, a, (a + b) / 2, variance, tail, depth + 1) +
           contact_part(p, (a + b) / 2, b, variance + half, tail, depth + 1);
}

static void panel_add(const scene *s, real anchor, real from, real to, real before, int depth,
                      truth *sum)
{
    real g[NODES], mu[NODES], full = 0;
    panel p = {.root = FN(sqrt)(from - anchor), .start = sum->variance, .gamma = s->gamma};
    p.width = (to - from) / (p.root + FN(sqrt)(to - anchor));
    for (int i = 0; i < NODES; i++) {
        const real step = p.width * node[i];
        integrand(s, from + step * (2 * p.root + step), &g[i], &mu[i]);
        full += weight[i] * slope_at(&p, node[i]) * mu[i];
    }
    const real tail_g = expand(g, p.g), tail_mu = expand(mu, p.mu);
    const real tail = FN(fmax)(tail_g, tail_mu);
    if (!is_fine(tail, before) && depth < 40) {
        const real step = p.width / 2, middle = from + step * (2 * p.root + step);
        panel_add(s, anchor, from, middle, tail, depth + 1, sum);
        panel_add(s, anchor, middle, to, tail, depth + 1, sum);
        return;
    }
    const real more = rise(&p, 0, 1);
    sum->hysteresis += p.start + more > full_contact ? contact_part(&p, 0, 1, p.start, 1, 0) : full;
    sum->variance += more;
}

static int rising(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x > y) - (x < y);
}

/* Call make_rule first. */
static truth truth_of(const scene *s)
{
    const real length = FN(log)((real)s->q1 / s->q0), widest = (real)0.7;
    real *cut = malloc((s->n + s->n_density + s->n_strain + 3) * sizeof *cut);
    truth sum = {0, 0};
    if (cut == NULL)
        return sum;
    compute_logarithms(s);
    size_t n = 0, knot = 0;
    cut[n++] = length;
    if (s->n_density == 0 && s->qr > s->q0 && s->qr < s->q1)
        cut[n++] = FN(log)((real)s->qr / s->q0);
    for (size_t k = 0; k < s->n_density; k++)
        cut[n++] = FN(log)((real)s->wavenumber[k] / s->q0);
    const size_t n_knots = s->law == TABLE ? s->n : 0;
    for (size_t k = 0; k < n_knots; k++)
        cut[n++] = FN(log)(s->tau[k] / ((real)s->velocity * s->q0));
    for (size_t k = 0; k < s->n_strain; k++)
        cut[n++] = find_strain(s, s->strain[k], length);
    qsort(cut, n, sizeof *cut, rising);
    real from = 0;
    for (size_t i = 0; i < n; i++)
        while (from < cut[i] && cut[i] <= length) {
            /* smooth to the right of a knot */
            real anchor = from;
            while (knot < n_knots && FN(log)(s->tau[knot] / ((real)s->velocity * s->q0)) <= from)
                knot++;
            if (knot > 0) {
                const real below = FN(log)(s->tau[knot - 1] / ((real)s->velocity * s->q0));
                anchor = below > from - 3 ? below : from;
            }
            const real to = FN(fmin)(cut[i], from + widest);
            panel_add(s, anchor, from, to, 1, 0, &sum);
            from = to;
        }
    free(cut);
    return sum;
}

#endif
