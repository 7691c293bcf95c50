/* Friction with flash temperature against nested quadrature that is independent of the kernel. The
 * heat kernel is the closed form for two wavenumbers, without a lattice. Damped steps from the
 * ambient temperature find the temperatures. The drawn scenes have a large effect of heat.
 *
 * heat_checks [SCENES [SEED [slow]]]
 *
 * slow: diffusivities down to 1e-12 m^2/s, where the heat stays at its source. */
#include "numeric/drawn_numbers.h"

#include "weartrack/friction.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { TERMS = 12, NODES = 12, PANELS = 96, MOST = PANELS * NODES, ANGLES = 26 * NODES };

typedef struct scene {
    double e0, modulus[TERMS], time[TERMS], nu;
    double q0, qr, q1, hurst, c0;
    double pressure, velocity, gamma, surroundings, c1, c2;
    wt_flash flash;
} scene;

typedef struct answer {
    double variance, area, hysteresis, rise;
} answer;

/* ---- a rule on [0, 1], and the integrals of its interpolation up to each node -----------------
 */

static double node[NODES], weight[NODES], running[NODES][NODES];

static double lagrange(int i, double x)
{
    double value = 1;
    for (int j = 0; j < NODES; j++)
        value *= j == i ? 1 : (x - node[j]) / (node[i] - node[j]);
    return value;
}

static void make_rule(void)
{
    for (int i = 0; i < NODES; i++) {
        double x = cos(M_PI * (i + 0.75) / (NODES + 0.5)), slope = 1;
        for (int step = 0; step < 50; step++) {
            double p = 1, last = 0;
            for (int k = 0; k < NODES; k++) {
                const double next = ((2 * k + 1) * x * p - k * last) / (k + 1);
                last = p;
                p = next;
            }
            slope = NODES * (x * p - last) / (x * x - 1);
            x -= p / slope;
        }
        node[i] = 0.5 * (1 + x);
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    for (int to = 0; to < NODES; to++)
        for (int i = 0; i < NODES; i++)
            for (int k = 0; k < NODES; k++)
                running[to][i] += node[to] * weight[k] * lagrange(i, node[to] * node[k]);
}

/* ---- angle ----------------------------------------------------------------------------------- */

/* The variable is the logarithm of the distance from 90 degrees, where the frequency is 0. */
static double cosine[ANGLES], of_loss[ANGLES], of_square[ANGLES];

static void make_angles(void)
{
    const double low = log(1e-10), high = log(M_PI / 2), width = (high - low) / (ANGLES / NODES);
    for (int i = 0; i < ANGLES; i++) {
        const double theta = exp(low + width * (i / NODES + node[i % NODES]));
        const double measure = width * weight[i % NODES] * theta;
        cosine[i] = sin(theta);
        of_loss[i] = 4 * cosine[i] * measure;
        of_square[i] = 4 * measure;
    }
}

static void angular(const scene *s, double omega, double *j1, double *j2)
{
    *j1 = *j2 = 0;
    for (int i = 0; i < ANGLES; i++) {
        double storage = s->e0, loss = 0;
        for (int m = 0; m < TERMS; m++) {
            const double z = omega * cosine[i] * s->time[m], part = s->modulus[m] / (1 + z * z);
            storage += part * z * z;
            loss += part * z;
        }
        *j1 += of_loss[i] * loss;
        *j2 += of_square[i] * (storage * storage + loss * loss);
    }
}

/* ---- heat ------------------------------------------------------------------------------------ */

static const long double pi = 3.14159265358979323846264338327950288L;

/* exp(z^2) erfc(z) */
static long double scaled_gap(long double z)
{
    const long double square = z * z;
    return z < 20 ? expl(square) * erfcl(z)
                  : (1 - (1 - 3 * (1 - 5 * (1 - 7 / (2 * square)) / (2 * square)) / (2 * square)) /
                             (2 * square)) /
                        (z * sqrtl(pi));
}

/* int_0^inf (1 - exp(-tau k^2)) / (k^2 (k^2 + a^2)) dk. Below z = 1 it uses the power series,
 * because the two terms nearly cancel. */
static long double wave_integral(long double a, long double tau)
{
    const long double z = a * sqrtl(tau);
    long double sum = 0, power = -z;
    for (int n = 2; z < 1 && n < 60; n++)
        sum += (power *= -z) / tgammal(0.5L * n + 1);
    if (!(z < 1))
        sum = 2 * z / sqrtl(pi) - (1 - scaled_gap(z));
    return pi / 2 / (a * a * a) * sum;
}

/* Effect of heat at scale k on the temperature of scale i, by the integrals of both. */
static double heat_kernel(const double *q, const long double *integral, size_t i, size_t k,
                          long double tau)
{
    const long double near = 1e-6L; /* The cancellation leaves half of the digits. */
    long double a = 2 * q[i], b = 2 * q[k], of_a = integral[i], of_b = integral[k];
    if (i == k) {
        a *= 1 + near;
        b *= 1 - near;
        of_a = wave_integral(a, tau);
        of_b = wave_integral(b, tau);
    }
    return (double)(16 * q[k] * q[i] * q[i] / pi * (of_b - of_a) / ((a - b) * (a + b)));
}

/* ---- scales ---------------------------------------------------------------------------------- */

/* The variable is x = ln ln(q / q0), from 1e-13 above q0. */
static size_t n_nodes;
static double wavenumber[MOST + 1], measure[MOST], panel_width[MOST];

static void add_panels(const scene *s, double from, double to, double widest)
{
    const int n = 1 + (int)(log(to / from) / widest);
    const double low = log(from), width = log(to / from) / n;
    for (int p = 0; p < n; p++)
        for (int i = 0; i < NODES; i++, n_nodes++) {
            const double t = exp(low + width * (p + node[i]));
            wavenumber[n_nodes] = s->q0 * exp(t);
            panel_width[n_nodes] = width;
            measure[n_nodes] = t;
        }
}

static void make_scales(const scene *s)
{
    const double roll_off = log(s->qr / s->q0), end = log(s->q1 / s->q0);
    n_nodes = 0;
    add_panels(s, 1e-13, roll_off, 0.5);
    for (double from = roll_off, step = 0.5; from < end; from += step) {
        step = from + step > end ? end - from : step;
        add_panels(s, from, from + step, 1);
    }
    wavenumber[n_nodes] = s->q1;
}

static double shift(const scene *s, double rise)
{
    return pow(10, -s->c1 * rise / (s->c2 + rise));
}

/* Computes all numbers at the temperature rises `rise`, and the heat f times the measure of each
 * scale. */
static answer at_temperatures(const scene *s, const double *rise, double *heat)
{
    const double stiffness = 1 / (1 - s->nu * s->nu) / s->pressure;
    answer sum = {0, 1, 0, 0};
    for (size_t from = 0; from < n_nodes; from += NODES) {
        double g[NODES], along[NODES], all = 0;
        for (size_t i = 0; i < NODES; i++) {
            const double q = wavenumber[from + i], power = q > s->qr ? -2 * (1 + s->hurst) : 0;
            const double dt = panel_width[from + i] * measure[from + i];
            const double slope = dt * pow(q, 4) * s->c0 * pow(q / s->qr, power);
            double j1, j2;
            angular(s, q * s->velocity * shift(s, rise[from + i]), &j1, &j2);
            g[i] = slope * j2 * stiffness * stiffness / 8;
            along[i] = slope * j1 * stiffness / 2;
        }
        for (size_t i = 0; i < NODES; i++) {
            double here = sum.variance;
            for (size_t k = 0; k < NODES; k++)
                here += running[i][k] * g[k];
            const double area = erf(0.5 / sqrt(here));
            const double part = area * (s->gamma + (1 - s->gamma) * area * area);
            sum.hysteresis += weight[i] * along[i] * part;
            /* mu sigma0 v of this scale is rho c P_m f / (2 q). */
            heat[from + i] = 2 * wavenumber[from + i] * weight[i] * along[i] * part * s->pressure *
                             s->velocity / (s->flash.heat_capacity * s->flash.macroscopic);
            all += weight[i] * g[i];
        }
        sum.variance += all;
    }
    sum.area = erf(0.5 / sqrt(sum.variance));
    return sum;
}

static const double hottest = 560; /* [K]; rubber burns above it */

/* Returns false if the temperatures do not converge or exceed the limit. */
static bool solve(const scene *s, bool warm, answer *a)
{
    static double kernel[MOST + 1][MOST], rise[MOST + 1], heat[MOST];
    static long double integral[MOST + 1];
    const double tau = s->flash.diffusivity * s->flash.contact_size / s->velocity;
    const double damping = 0.2; /* factor of a map with eigenvalues from -4 to 1 */
    double moved = 1;
    make_angles();
    make_scales(s);
    for (size_t i = 0; i <= n_nodes; i++)
        integral[i] = wave_integral(2 * (long double)wavenumber[i], tau);
    for (size_t i = 0; i <= n_nodes; i++) {
        rise[i] = 0;
        for (size_t k = 0; k < n_nodes; k++)
            kernel[i][k] = heat_kernel(wavenumber, integral, i, k, tau) / s->flash.diffusivity;
    }
    for (int step = 0; step < 1500 && moved > 1e-12; step++) {
        *a = at_temperatures(s, rise, heat);
        moved = 0;
        for (size_t i = 0; warm && i <= n_nodes; i++) {
            double made = 0;
            for (size_t k = 0; k < n_nodes; k++)
                made += kernel[i][k] * heat[k];
            const double change = damping * (made - rise[i]);
            rise[i] += change;
            moved = fmax(moved, fabs(change) / (1 + made));
        }
    }
    a->rise = rise[n_nodes];
    return moved <= 1e-12 && s->surroundings + a->rise < hottest;
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static scene draw(bool slow)
{
    scene s = {.nu = uniform(0.45, 0.5),
               .q0 = decades(2, 3),
               .hurst = uniform(0.7, 0.95),
               .pressure = decades(5.3, 6.3),
               .velocity = decades(-1, 1.3),
               .gamma = uniform(0, 1) < 0.5 ? 1 : uniform(0.4, 1),
               .surroundings = uniform(278, 330),
               .c1 = uniform(6, 9),
               .c2 = uniform(100, 160),
               .flash = wt_flash_defaults()};
    s.e0 = decades(6.3, 6.9);
    for (int k = 0; k < TERMS; k++) {
        s.time[k] = pow(10, -k) * decades(-0.3, 0.3);
        s.modulus[k] = 1e6 * pow(10, 2.7 * k / (TERMS - 1)) * decades(-0.2, 0.2);
    }
    s.qr = s.q0 * decades(0.3, 1);
    s.q1 = s.qr * decades(2, 3);
    s.c0 = uniform(0.5, 2) * 6e-16 * pow(2000 / s.qr, 4);
    s.flash.contact_size = decades(-3.3, -2.3);
    s.flash.macroscopic = uniform(0.15, 0.4);
    s.flash.diffusivity = slow ? decades(-12, -7) : decades(-7.2, -6.8);
    return s;
}

static bool computed(const scene *s, double tolerance, wt_friction_point *p)
{
    scene own = *s;
    const wt_prony series = {.deformation = WT_TENSION,
                             .reference_temperature = (double)NAN,
                             .equilibrium_modulus = s->e0,
                             .n = TERMS,
                             .relaxation_time = own.time,
                             .modulus = own.modulus,
                             .frequency_min = (double)NAN,
                             .frequency_max = (double)NAN};
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = tolerance;
    options.gamma = s->gamma;
    options.flash = s->flash;
    options.flash.on = true;
    options.temperature = s->surroundings;
    options.shift =
        (wt_shift_law){.kind = WT_LAW_WLF,
                       .wlf = {.c1 = s->c1, .c2 = s->c2, .reference_temperature = s->surroundings}};
    wt_status status = wt_material_prony(&series, s->nu, &material, &err);
    if (status == WT_OK)
        status = wt_roughness_self_affine(s->q0, s->qr, s->q1, s->hurst, s->c0, &roughness, &err);
    if (status == WT_OK)
        status = wt_friction_workspace_new(material, roughness, &options, &ws, &err);
    if (status == WT_OK)
        status = wt_friction_compute(ws, s->pressure, &s->velocity, 1, p, &err);
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
    if (status != WT_OK)
        fprintf(stderr, "%s\n", err.message);
    return status == WT_OK && !p->has_no_solution;
}

/* ---- checks ---------------------------------------------------------------------------------- */

/* Accuracy of this quadrature. */
static const double own_error = 2e-10;
static double worst;

static bool holds(size_t number, double tolerance, const char *what, wt_estimate actual,
                  double expected, double scale)
{
    const double off = fabs(actual.value - expected);
    worst = fmax(worst, tolerance < 1e-9 ? off / scale : 0);
    if (off <= actual.numerical_error + own_error * scale)
        return true;
    fprintf(stderr, "scene %zu at %g: %s is %.15g, expected %.15g: %.2g off, %.2g stated\n", number,
            tolerance, what, actual.value, expected, off, actual.numerical_error);
    return false;
}

static bool check(const scene *s, size_t number, const answer *a)
{
    static const double tolerances[] = {1e-10, 1e-6, 1e-3};
    bool good = true;
    for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
        const double tolerance = tolerances[i];
        wt_friction_point p;
        if (!computed(s, tolerance, &p)) {
            fprintf(stderr, "scene %zu at %g: no answer\n", number, tolerance);
            return false;
        }
        wt_estimate rise = p.temperature;
        rise.value -= s->surroundings;
        good &= holds(number, tolerance, "G", p.stress_variance, a->variance, a->variance);
        good &= holds(number, tolerance, "P", p.area_ratio, a->area, a->area);
        good &= holds(number, tolerance, "mu", p.hysteresis, a->hysteresis, a->hysteresis);
        good &= holds(number, tolerance, "T", rise, a->rise, s->surroundings);
    }
    return good;
}

int main(int argc, char **argv)
{
    const size_t scenes = argc > 1 ? strtoul(argv[1], NULL, 10) : 5;
    const uint64_t seed = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
    const bool slow = argc > 3;
    size_t bad = 0, settled = 0, matter = 0;
    make_rule();
    printf("| scene | warmer by, K | mu | isothermal |\n"
           "|---|---|---|---|\n");
    for (size_t i = 0; i < scenes; i++) {
        drawn_state = seed * 1000003 + i * 7919;
        const scene s = draw(slow);
        answer warm, cold;
        if (!solve(&s, true, &warm))
            continue; /* without a reference the library is not tested */
        (void)solve(&s, false, &cold);
        settled++;
        matter += fabs(warm.hysteresis / cold.hysteresis - 1) > 0.05;
        bad += !check(&s, i, &warm);
        printf("| %zu | %.1f | %.4f | %.4f |\n", i, warm.rise, warm.hysteresis, cold.hysteresis);
        fflush(stdout);
    }
    printf("%zu of %zu settled, heat matters in %zu; %zu bad; worst %.1e\n", settled, scenes,
           matter, bad, worst);
    return bad > 0 || 2 * matter < scenes || 2 * settled < scenes;
}
