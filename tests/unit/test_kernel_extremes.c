/* Extreme materials, surfaces, velocities and pressures, drawn at random: the true error of
 * friction lies within the stated one. The truth is an own quadrature in long double: double sums
 * instead of the closed forms, short panels in ln q, and for tables tanh-sinh over the angle; of a
 * solid with directions the compliance of its surface as it stands in the books.
 *
 * With an argument that many other materials are drawn: test_kernel_extremes CASES [SEED]. */
#include "near.h"

#include "weartrack/kernel.h"

#include <complex.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>

typedef long double real;
typedef long double _Complex pair;

enum { MOST_TERMS = 6, NODES = 12, ANGLES = 90 };

static uint64_t state;

static double uniform(double low, double high)
{
    state += 0x9e3779b97f4a7c15u;
    uint64_t z = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return low + (high - low) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double decades(double low, double high)
{
    return pow(10, uniform(low, high));
}

typedef enum law_kind { PRONY, TABLE, ZENER } law_kind;

typedef struct scene {
    law_kind law;
    bool table, transverse;
    wt_transverse factors; /* if transverse */
    double alpha;          /* of the fractional Zener law: e[0], e[0] + e[1], tau[0] */
    size_t n;              /* terms or knots */
    double e0, e[MOST_TERMS], tau[MOST_TERMS], loss[MOST_TERMS];
    double nu, pressure, velocity, q0, qr, q1, hurst, c0, gamma, tolerance;
    double least, most; /* frequencies backed by data */
} scene;

static const char *const law_names[] = {"prony", "table", "zener"};

/* Mostly stable. */
static void draw_directions(scene *s)
{
    wt_transverse *t = &s->factors;
    double *const factors[] = {&t->axial_storage, &t->axial_loss,    &t->plane_storage,
                               &t->plane_loss,    &t->shear_storage, &t->shear_loss};
    *t = wt_transverse_defaults();
    for (size_t i = 0; i < 6; i++)
        *factors[i] = decades(-0.4, 0.6);
    t->plane_poisson = uniform(-0.5, 0.6);
    t->axial_poisson = uniform(-0.3, 0.45);
}

static scene draw_scene(law_kind law, bool transverse)
{
    const bool table = law == TABLE;
    scene s = {.law = law,
               .table = table,
               .transverse = transverse,
               .n = 1 + (size_t)uniform(0, MOST_TERMS)};
    if (law == ZENER) {
        s.n = 2;
        s.alpha = uniform(0.05, 1);
    }
    if (transverse)
        draw_directions(&s);
    if (table && s.n < 2)
        s.n = 2;
    double omega = decades(-8, 4);
    s.e0 = uniform(0, 1) < 0.2 ? 0 : decades(3, 9);
    for (size_t k = 0; k < s.n; k++) {
        s.e[k] = decades(2, 11);
        s.loss[k] = decades(2, 11);
        s.tau[k] = table ? (omega *= decades(0.05, 3)) : decades(-14, 10);
    }
    s.nu = uniform(0, 1) < 0.2 ? 0.5 : uniform(0, 0.5);
    s.pressure = decades(0, 12);
    s.velocity = decades(-12, 6);
    s.q0 = decades(1, 5);
    s.q1 = s.q0 * (1 + decades(-4, 6));
    s.qr = uniform(0, 1) < 0.3 ? s.q0 : s.q0 * pow(s.q1 / s.q0, uniform(0, 1));
    s.hurst = uniform(-0.9, 2.5);
    s.c0 = decades(-30, -8) / pow(s.q0 / 1e3, 4);
    s.gamma = uniform(0, 1) < 0.5 ? 1 : uniform(0, 1);
    s.tolerance = decades(-12, -2);
    s.least = decades(-6, 2);
    s.most = s.least * decades(0.1, 10);
    return s;
}

/* ---- the truth ------------------------------------------------------------------------------- */

/* Gauss-Legendre on [0, 1]; running[i][k]: int of the k-th Lagrange polynomial up to node i. */
static real node[NODES], weight[NODES], running[NODES][NODES];

static void make_rule(void)
{
    for (int i = 0; i < NODES; i++) {
        real x = cosl(M_PIl * (i + 0.75L) / (NODES + 0.5L)), slope = 0;
        for (int k = 0; k < 60; k++) {
            real p = 1, last = 0;
            for (int j = 0; j < NODES; j++) {
                const real next = ((2 * j + 1) * x * p - j * last) / (j + 1);
                last = p;
                p = next;
            }
            slope = NODES * (x * p - last) / (x * x - 1);
            x -= p / slope;
        }
        node[i] = (1 + x) / 2;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++)
            for (int j = 0; j < NODES; j++) {
                const real u = node[i] * node[j];
                real polynomial = 1;
                for (int m = 0; m < NODES; m++)
                    polynomial *= m == k ? 1 : (u - node[m]) / (node[k] - node[m]);
                running[i][k] += weight[j] * node[i] * polynomial;
            }
}

static void table_modulus(const scene *s, real omega, real *storage, real *loss)
{
    const size_t last = s->n - 1;
    size_t k = 0;
    const real x = fminl(fmaxl(omega, s->tau[0]), s->tau[last]);
    while (k + 2 < s->n && x > s->tau[k + 1])
        k++;
    const real t = logl(x / s->tau[k]) / logl((real)s->tau[k + 1] / s->tau[k]);
    *storage = s->e[k] * powl((real)s->e[k + 1] / s->e[k], t);
    *loss = s->loss[k] * powl((real)s->loss[k + 1] / s->loss[k], t);
}

static void law_modulus(const scene *s, real omega, real *storage, real *loss)
{
    if (s->table) {
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
        const real r = expl(s->alpha * logl(omega * s->tau[0]));
        const pair z = r * (cosl(s->alpha * M_PIl / 2) + sinl(s->alpha * M_PIl / 2) * (pair)I);
        const real rise = (real)(s->e[0] + s->e[1]) - s->e[0];
        const pair e = s->e[0] + rise / (1 + 1 / z);
        re = creall(e);
        im = cimagl(e);
    }
    *storage = re;
    *loss = im;
}

static void modulus(const scene *s, real omega, real *storage, real *loss)
{
    const wt_transverse *t = &s->factors;
    law_modulus(s, omega, storage, loss);
    if (!s->transverse)
        return;
    const pair i = (pair)I;
    const pair plane = t->plane_storage * *storage + t->plane_loss * *loss * i,
               axial = t->axial_storage * *storage + t->axial_loss * *loss * i,
               shear = (t->shear_storage * *storage + t->shear_loss * *loss * i) /
                       (2 * (1 + (real)t->plane_poisson));
    const real nu_p = t->plane_poisson, nu_zp = t->axial_poisson;
    const pair b11 = (1 - nu_p * nu_p) / plane, b33 = (1 - nu_zp * nu_zp * plane / axial) / axial,
               b13 = -nu_zp * (1 + nu_p) / axial;
    const pair d = csqrtl(b33) * csqrtl(1 / shear + 2 * (b13 + csqrtl(b11) * csqrtl(b33)));
    const pair e = 2 * (1 - (real)s->nu * s->nu) / d;
    *storage = creall(e);
    *loss = cimagl(e);
}

/* J1 and J2 over the angles with low < cos(phi) < high, in which the moduli are smooth, by
 * tanh-sinh in pi/2 - phi. */
static void angle_piece(const scene *s, real w, real low, real high, real *j1, real *j2)
{
    const real from = asinl(low), width = asinl(fminl(1, high)) - from;
    /* with directions the moduli have poles close to the axis where the table is steep */
    const int n = s->transverse ? 4 * ANGLES : ANGLES;
    for (int i = -n; i <= n; i++) {
        const real u = 3.6L * i / n, a = M_PIl / 2 * sinhl(u);
        const real d = 3.6L / n * M_PIl / 4 * coshl(u) / (coshl(a) * coshl(a));
        const real c = sinl(from + width / (1 + expl(-2 * a)));
        real storage, loss;
        modulus(s, w * fminl(fmaxl(c, low), high), &storage, &loss);
        *j1 += 4 * width * d * c * loss;
        *j2 += 4 * width * d * (storage * storage + loss * loss);
    }
}

/* A law that is smooth: short panels in the angle down to 60 degrees, then in ln cos(phi). */
static void smooth_angular(const scene *s, real w, real *j1, real *j2)
{
    const real wide = 0.5L;
    real storage, loss;
    for (real from = 0; from < 46; from += wide) {
        const bool over_angle = from < 1;
        const real to = over_angle ? fminl(from + wide, 1) : from + wide;
        for (int i = 0; i < NODES; i++) {
            const real x = from + (to - from) * node[i];
            const real c = over_angle ? cosl(M_PIl / 3 * x) : expl(1 - x) / 2;
            const real d =
                (to - from) * weight[i] * (over_angle ? M_PIl / 3 : c / sqrtl((1 - c) * (1 + c)));
            modulus(s, w * c, &storage, &loss);
            *j1 += 4 * d * c * loss;
            *j2 += 4 * d * (storage * storage + loss * loss);
        }
        if (over_angle)
            from = to - wide;
    }
}

static void angular(const scene *s, real w, real *j1, real *j2)
{
    *j1 = *j2 = 0;
    if (s->law == ZENER || (s->transverse && !s->table)) {
        smooth_angular(s, w, j1, j2);
        return;
    }
    if (s->table) {
        real low = 0;
        for (size_t k = 0; k < s->n && s->tau[k] < w; k++) {
            angle_piece(s, w, low, s->tau[k] / w, j1, j2);
            low = s->tau[k] / w;
        }
        angle_piece(s, w, low, 1, j1, j2);
        return;
    }
    real sum = (real)s->e0 * s->e0;
    for (size_t k = 0; k < s->n; k++) {
        const real a = w * s->tau[k], r = sqrtl(1 + a * a);
        *j1 += s->e[k] * a / (r * (1 + r));
        sum += 2 * (real)s->e0 * s->e[k] * a * a / (r * (1 + r));
        for (size_t m = 0; m < s->n; m++) {
            /* int Re[i a c / (1 + i a c) conj(i b c / (1 + i b c))] over the circle / 2 pi */
            const real b = w * s->tau[m], t = sqrtl(1 + b * b);
            const real mine = a * a / (r * (1 + r)), other = b * b / (t * (1 + t));
            sum += (real)s->e[k] * s->e[m] * (mine * b + other * a) / (a + b);
        }
    }
    *j1 *= 2 * M_PIl;
    *j2 = 2 * M_PIl * sum;
}

typedef struct truth {
    real variance, hysteresis;
} truth;

/* d G / dt and, without S P, d mu / dt at q = q0 exp(t). */
static void integrand(const scene *s, real t, real *g, real *mu)
{
    real j1, j2;
    const real q = s->q0 * expl(t), stiff = 1 / (1 - (real)s->nu * s->nu) / s->pressure;
    const real fall = q > s->qr ? powl(q / s->qr, -2 * (1 + (real)s->hurst)) : 1;
    angular(s, q * s->velocity, &j1, &j2);
    *g = q * q * q * q * s->c0 * fall * j2 * stiff * stiff / 8;
    *mu = q * q * q * q * s->c0 * fall * j1 * stiff / 2;
}

static real area(real variance)
{
    return variance > 0 ? erfl(1 / (2 * sqrtl(variance))) : 1;
}

/* t = from + (to - from) u^2: smooth right of a knot. */
static void panel(const scene *s, real from, real to, truth *sum)
{
    real g[NODES], mu[NODES];
    for (int i = 0; i < NODES; i++) {
        integrand(s, from + (to - from) * node[i] * node[i], &g[i], &mu[i]);
        g[i] *= 2 * node[i] * (to - from);
        mu[i] *= 2 * node[i] * (to - from);
    }
    const real start = sum->variance;
    for (int i = 0; i < NODES; i++) {
        real here = start;
        for (int k = 0; k < NODES; k++)
            here += running[i][k] * g[k];
        const real p = area(here);
        sum->hysteresis += weight[i] * mu[i] * p * (s->gamma + (1 - (real)s->gamma) * p * p);
        sum->variance += weight[i] * g[i];
    }
}

static int rising(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x > y) - (x < y);
}

static truth truth_of(const scene *s)
{
    const real length = logl((real)s->q1 / s->q0);
    real cut[MOST_TERMS + 3];
    size_t n = 0;
    cut[n++] = length;
    if (s->qr > s->q0 && s->qr < s->q1)
        cut[n++] = logl((real)s->qr / s->q0);
    for (size_t k = 0; s->table && k < s->n; k++) {
        const real t = logl(s->tau[k] / ((real)s->velocity * s->q0));
        if (t > 0 && t < length)
            cut[n++] = t;
    }
    qsort(cut, n, sizeof *cut, rising);
    truth sum = {0, 0};
    const real widest = 0.15L;
    real from = 0;
    for (size_t i = 0; i < n; i++)
        while (from < cut[i]) {
            /* from a panel so thin that G is 0 in it, growing */
            real to = fminl(cut[i], from == 0 ? 1e-34L * cut[0] : from * 1.35L);
            to = fminl(to, from + widest);
            panel(s, from, to, &sum);
            from = to;
        }
    return sum;
}

/* ---- the comparison -------------------------------------------------------------------------- */

static wt_material *material_of(const scene *s)
{
    wt_material *material = NULL;
    const wt_prony prony = {.deformation = WT_TENSION,
                            .equilibrium_modulus = s->e0,
                            .n = s->n,
                            .relaxation_time = (double *)s->tau,
                            .modulus = (double *)s->e,
                            .frequency_min = (double)NAN,
                            .frequency_max = (double)NAN};
    wt_status status = s->law == TABLE ? wt_material_table(s->tau, s->e, s->loss, s->n, s->nu,
                                                           WT_EXTRAPOLATE_HOLD, &material, NULL)
                       : s->law == ZENER
                           ? wt_material_fractional_zener(s->e[0], s->e[0] + s->e[1], s->tau[0],
                                                          s->alpha, s->nu, &material, NULL)
                           : wt_material_prony(&prony, s->nu, &material, NULL);
    if (status == WT_OK && s->transverse)
        status = wt_material_transverse(material, NULL, NULL, &s->factors, s->nu, &material, NULL);
    assert_int_equal(status, WT_OK);
    return material;
}

static void check(const scene *s, size_t number, const char *what, wt_estimate actual, real exact)
{
    const real error = fabsl(actual.value - exact);
    if (!(error <= actual.numerical_error + 1e-17L * fabsl(exact) + DBL_MIN))
        fail_msg(
            "case %zu (%s, %zu, tolerance %.2g, v %.2g, p %.2g): %s %.17g is %.3Lg from %.20Lg, "
            "but %.3g is stated",
            number, law_names[s->law], s->n, s->tolerance, s->velocity, s->pressure, what,
            actual.value, error, exact, actual.numerical_error);
    if (!(actual.numerical_error <= 0.1 * fabs(actual.value) + DBL_MIN))
        fail_msg("case %zu: %s %g +- %g", number, what, actual.value, actual.numerical_error);
}

static size_t reached, refused;

static void compare(const scene *s, size_t number)
{
    wt_material *material = material_of(s);
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_options options = wt_friction_defaults();
    wt_friction_point p;
    wt_error err = WT_ERROR_INIT;
    options.tolerance = s->tolerance;
    options.gamma = s->gamma;
    assert_int_equal(
        wt_roughness_self_affine(s->q0, s->qr, s->q1, s->hurst, s->c0, &roughness, NULL), WT_OK);
    assert_int_equal(wt_friction_workspace_new(material, roughness, &options, &ws, NULL), WT_OK);
    if (wt_friction_compute(ws, s->pressure, &s->velocity, 1, &p, &err) != WT_OK) {
        if (!s->transverse || strstr(err.message, "transversely isotropic") == NULL)
            fail_msg("case %zu: %s", number, err.message);
        refused++;
        goto done;
    }
    const truth exact = truth_of(s);
    check(s, number, "G", p.stress_variance, exact.variance);
    check(s, number, "P", p.area_ratio, area(exact.variance));
    check(s, number, "mu", p.hysteresis, exact.hysteresis);
    reached += p.reached;
done:
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
}

static size_t n_cases = 24;

static void extreme_friction(void **ignored)
{
    (void)ignored;
    make_rule();
    for (size_t i = 0; i < n_cases; i++) {
        /* of sixteen: two tables, two Zener, two with directions */
        const scene s = draw_scene(i % 8 == 7 || i % 16 == 11 ? TABLE
                                   : i % 8 == 5               ? ZENER
                                                              : PRONY,
                                   i % 8 == 3);
        compare(&s, i);
    }
    assert_true(10 * (reached + refused) >= 9 * n_cases);
    assert_true(20 * refused <= n_cases);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        n_cases = strtoul(argv[1], NULL, 10);
    state = argc > 2 ? strtoul(argv[2], NULL, 10) : 7;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extreme_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
