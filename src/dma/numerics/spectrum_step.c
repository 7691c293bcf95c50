/* Step responses of a relaxation spectrum. The relaxation modulus E(t) is a sum over its terms.
 * The transform of the creep compliance is the inverse of that of E (J. D. Ferry, Viscoelastic
 * properties of polymers, 3rd ed., chapter 3). For a series the compliance is a sum over as many
 * retardation times, each between two relaxation times. It is exact, without an integral.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/root.h"

#include <math.h>
#include <string.h>

/* A term below this share of all slower moduli does not change the compliance in double
 * precision. Its retardation time equals its relaxation time. */
static const double least_share = 1e-14;

/* ---- relaxation ------------------------------------------------------------------------------ */

static void relaxation_response(const spectrum *s, const double *term, double x,
                                double *log_modulus, double *slope, double *gradient)
{
    const double ratio = exp(s->step);
    double modulus = s->liquid ? 0.0 : term[s->n_terms], rise = 0.0;
    double z = exp(x + s->log_tau);
    for (size_t j = 0; j < s->n_terms; j++, z *= ratio) {
        const double share = term[j] * exp(-1.0 / z);
        modulus += share;
        rise += share > 0.0 ? share / z : 0.0;
        if (gradient != NULL)
            gradient[j] = share;
    }
    *log_modulus = log(modulus);
    *slope = rise / modulus;
    for (size_t j = 0; gradient != NULL && j < s->n_terms; j++)
        gradient[j] /= modulus;
    if (gradient != NULL && !s->liquid)
        gradient[s->n_terms] = term[s->n_terms] / modulus;
}

/* ---- retardation times ----------------------------------------------------------------------- */

/* The transform p E~(p) = E_inf + sum E_j p / (p + r_j) at p = -x, where x is exp(+-u) times the
 * rate `near`. A root lies between two rates. u is its distance to the nearer one, so the share
 * x / (r - x) of that rate is exact. */
typedef struct root_bracket {
    const double *modulus, *rate; /* [n], rates rising */
    size_t n, near;
    double equilibrium, sign;
} root_bracket;

/* Returns x / (r_j - x). */
static double rate_share(const root_bracket *b, size_t j, double u)
{
    return j == b->near ? 1.0 / expm1(-b->sign * u)
                        : 1.0 / (b->rate[j] / b->rate[b->near] * exp(-b->sign * u) - 1.0);
}

/* Returns the transform times u, which removes the pole at 0. It is positive beyond the root. */
static double scaled_transform(double u, void *user)
{
    const root_bracket *b = user;
    double sum = b->equilibrium;
    for (size_t j = 0; j < b->n; j++)
        sum -= b->modulus[j] * rate_share(b, j, u);
    return -b->sign * u * sum;
}

/* Finds the root between rate k - 1 (0 before the first) and rate k. Returns u; b has the nearer
 * rate. */
static double find_retardation_root(root_bracket *b, size_t k)
{
    *b = (root_bracket){b->modulus, b->rate, b->n, k, b->equilibrium, -1.0};
    double far = k > 0 ? 0.5 * log(b->rate[k] / b->rate[k - 1]) : 1.0;
    /* below the first rate only E_inf opposes the terms */
    while (k == 0 && scaled_transform(far, b) < 0.0 && far < 700.0)
        far *= 2.0;
    if (k > 0 && scaled_transform(far, b) < 0.0) {
        b->near = k - 1;
        b->sign = 1.0;
    }
    const double least = far * 1e-18; /* at 0 the product is NaN */
    double u = (double)NAN;
    return root_find(scaled_transform, b, least, far, 0.0, &u, NULL) == WT_OK ? u : (double)NAN;
}

void spectrum_modes_new(spectrum *s)
{
    arena *m = &s->memory;
    spectrum_modes *modes = arena_alloc(m, 1, sizeof *modes);
    const size_t n = s->n_terms;
    modes->terms = arena_numbers(m, s->n_linear);
    modes->index = arena_alloc(m, n, sizeof *modes->index);
    modes->modulus = arena_numbers(m, n);
    modes->rate = arena_numbers(m, n);
    modes->root = arena_numbers(m, n);
    modes->slope = arena_numbers(m, n);
    modes->bend = arena_numbers(m, n);
    modes->decay = arena_numbers(m, n);
    modes->share = arena_numbers(m, n * n);
    s->modes = modes;
}

/* Finds the roots and the derived values for these terms. */
static void find_modes(const spectrum *s, const double *term)
{
    spectrum_modes *m = s->modes;
    double slower = term[s->n_terms];
    m->n = 0;
    for (size_t j = s->n_terms; j-- > 0; slower += term[j]) {
        if (!(term[j] > least_share * slower))
            continue;
        m->index[m->n] = j;
        m->modulus[m->n] = term[j];
        m->rate[m->n++] = exp(-(s->log_tau + (double)j * s->step));
    }
    m->instantaneous = slower;
    root_bracket b = {.modulus = m->modulus, .rate = m->rate, .n = m->n};
    b.equilibrium = term[s->n_terms];
    for (size_t k = 0; k < m->n; k++) {
        const double u = find_retardation_root(&b, k);
        double *share = m->share + k * m->n, slope = 0.0, bend = 0.0;
        m->root[k] = m->rate[b.near] * exp(b.sign * u);
        for (size_t j = 0; j < m->n; j++) {
            const double a = share[j] = rate_share(&b, j, u);
            slope += m->modulus[j] * a * (1.0 + a);
            bend -= 2.0 * m->modulus[j] * a * a * (1.0 + a);
        }
        m->slope[k] = slope;
        m->bend[k] = bend / slope;
    }
    memcpy(m->terms, term, s->n_linear * sizeof *m->terms);
    m->known = true;
}

/* ---- creep ----------------------------------------------------------------------------------- */

/* Computes the derivatives of the compliance from the double pole at each root. */
static void creep_derivatives(const spectrum *s, double time, double compliance, double *gradient)
{
    const spectrum_modes *m = s->modes;
    const double equilibrium = m->terms[s->n_terms];
    double of_equilibrium = -1.0 / (equilibrium * equilibrium);
    memset(gradient, 0, s->n_terms * sizeof *gradient);
    for (size_t k = 0; k < m->n; k++) {
        const double tx = time * m->root[k], *share = m->share + k * m->n;
        const double weight = m->decay[k] / (m->slope[k] * m->slope[k]);
        of_equilibrium += weight * (tx + 1.0 - m->bend[k]);
        for (size_t j = 0; weight > 0.0 && j < m->n; j++) {
            const double a = share[j];
            gradient[m->index[j]] +=
                weight * m->modulus[j] / compliance * a * (tx - a - m->bend[k]);
        }
    }
    gradient[s->n_terms] = -equilibrium * of_equilibrium / compliance;
}

static void creep_response(const spectrum *s, const double *term, double x, double *log_modulus,
                           double *slope, double *gradient)
{
    const double time = exp(-x);
    spectrum_modes *m = s->modes;
    if (!m->known || memcmp(m->terms, term, s->n_linear * sizeof *m->terms) != 0)
        find_modes(s, term);
    double compliance = 1.0 / m->instantaneous, rise = 0.0;
    for (size_t k = 0; k < m->n; k++) {
        const double tx = time * m->root[k];
        m->decay[k] = exp(-tx);
        compliance -= expm1(-tx) / m->slope[k];
        rise += m->decay[k] > 0.0 ? tx * m->decay[k] / m->slope[k] : 0.0;
    }
    *log_modulus = -log(compliance);
    *slope = rise / compliance;
    if (gradient != NULL)
        creep_derivatives(s, time, compliance, gradient);
}

void spectrum_step_response(const spectrum *s, const double *term, double x, double *log_modulus,
                            double *slope, double *gradient)
{
    if (s->loading == WT_CREEP)
        creep_response(s, term, x, log_modulus, slope, gradient);
    else
        relaxation_response(s, term, x, log_modulus, slope, gradient);
}
