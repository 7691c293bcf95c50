/* Forces in the equilibrium of cantilever and rubber with a modulus that depends on depth, and
 * their cosines.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/depth_residuals.h"

#include "indentation/law/thin_layer.h"

#include <math.h>
#include <string.h>

enum {
    W = CURVE_WAVES,
    MAX_STEPS = 60, /* bisection alone reaches the last digit */
};

depth_modulus depth_modulus_create(const depth_mean *m, depth_law law, const double *p)
{
    depth_modulus to = {.law = law, .level = p[DEPTH_LEVEL]};
    if (law == DEPTH_TIED) {
        to.ratio = exp(p[DEPTH_LEVEL] + m->tie.log_ratio);
        to.reach = m->tie.reach;
        to.slope = p[DEPTH_SLOPE];
    } else if (law == DEPTH_LAYER) {
        to.ratio = exp(p[DEPTH_RATIO]);
        to.reach = exp(p[DEPTH_REACH]);
    } else {
        to.slope = p[DEPTH_SLOPE];
        to.bend = law == DEPTH_QUADRATIC ? p[DEPTH_BEND] : 0.0;
    }
    return to;
}

double depth_log_modulus(const depth_modulus *l, double u)
{
    if (l->law == DEPTH_LAYER)
        return l->level + log(thin_layer_apparent_modulus(l->ratio, l->reach * u));
    if (l->law == DEPTH_TIED)
        return l->level + log(thin_layer_apparent_modulus(l->ratio, l->reach * u)) +
               (u - 1.0) * l->slope;
    return l->level +
           (u - 1.0) * (l->slope + (l->law == DEPTH_QUADRATIC ? l->bend * (u - 1.0) : 0.0));
}

/* Point with its bracket in the search for the equilibrium. */
typedef struct balance_point {
    size_t to; /* index of the point */
    double z, low, high;
} balance_point;

/* Performs one step for n points at depths x. Returns the number of points that have not converged;
 * they come first afterwards. */
static size_t newton_step_points(const depth_mean *m, const depth_modulus *l, balance_point *b,
                                 double *x, size_t n, double force[DEPTH_POINTS])
{
    double g[DEPTH_POINTS], slope[DEPTH_POINTS];
    size_t left = 0;
    wt_contact_table_eval(m->table, x, n, g, slope);
    for (size_t j = 0; j < n; j++) {
        balance_point at = b[j];
        double next = x[j];
        const double e =
            m->reduced * (l != NULL ? exp(depth_log_modulus(l, slope[j] / m->widest)) : 1.0);
        const double excess_force = m->k * (at.z - next) - e * g[j];
        *(excess_force > 0.0 ? &at.low : &at.high) = next;
        const double step =
            excess_force / (m->k + e * slope[j]); /* Newton's step with constant E */
        const bool is_converged = fabs(step) < 1e-13 * at.z;
        if (!is_converged)
            next = next + step > at.low && next + step < at.high ? next + step
                                                                 : 0.5 * (at.low + at.high);
        force[at.to] = m->k * (at.z - next);
        if (!is_converged) {
            b[left] = at;
            x[left++] = next;
        }
    }
    return left;
}

/* Computes the equilibrium force at positions from the contact point. l is NULL for the modulus of
 * the fit. */
static void balance_forces(const depth_mean *m, const depth_modulus *l,
                           const double z[DEPTH_POINTS], double force[DEPTH_POINTS])
{
    balance_point b[DEPTH_POINTS];
    double x[DEPTH_POINTS];
    size_t n = 0;
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        force[i] = 0.0;
        if (z[i] > 0.0) {
            x[n] = 0.9 * z[i];
            b[n++] = (balance_point){i, z[i], 0.0, z[i]};
        }
    }
    for (int i = 0; i < MAX_STEPS && n > 0; i++)
        n = newton_step_points(m, l, b, x, n, force);
}

/* Subtracts the line that a fit to the differences in the window, and to zeros before it, would
 * have. */
static void subtract_line(const depth_mean *m, const double *z, double *d)
{
    const double from = -m->baseline, to = m->length, n = to - from,
                 step = m->window / DEPTH_POINTS;
    const double middle = 0.5 * (from + to), spread = n * n * n / 12.0;
    double sum = 0.0, moment = 0.0;
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        sum += d[i] * step;
        moment += d[i] * (z[i] - middle) * step;
    }
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        d[i] -= sum / n + moment / spread * (z[i] - middle);
}

double depth_mean_point(const depth_mean *m, size_t i)
{
    return m->length - m->window * (1.0 - ((double)i + 0.5) / DEPTH_POINTS);
}

void depth_mean_cosines(const depth_mean *m, const double d[DEPTH_POINTS], double wave[W])
{
    memset(wave, 0, W * sizeof *wave);
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        for (size_t j = 0; j < W; j++)
            wave[j] += 2.0 / DEPTH_POINTS * d[i] / m->force * m->cosine[i][j];
}

void depth_mean_waves(const depth_mean *m, const double *p, double wave[W])
{
    double z[DEPTH_POINTS], align_with_contact[DEPTH_POINTS], d[DEPTH_POINTS];
    const depth_modulus law = depth_modulus_create(m, m->law, p);
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        z[i] = depth_mean_point(m, i);
        align_with_contact[i] = z[i] - p[DEPTH_CONTACT] * m->depth;
    }
    balance_forces(m, &law, align_with_contact, d);
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        d[i] -= m->fitted[i];
    subtract_line(m, z, d);
    depth_mean_cosines(m, d, wave);
}

void depth_mean_prepare(depth_mean *m)
{
    double z[DEPTH_POINTS];
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        z[i] = depth_mean_point(m, i);
        for (size_t j = 0; j < W; j++)
            m->cosine[i][j] = cos(M_PI * (double)(j + 1) * ((double)i + 0.5) / DEPTH_POINTS);
    }
    balance_forces(m, NULL, z, m->fitted);
}
