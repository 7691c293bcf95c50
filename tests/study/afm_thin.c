/* A thin sample on a rigid base, or a layer on other rubber, by the integral equation of the
 * contact: pi/2 g + int K g = depth of the tip. The kernel K is the response of the sample to
 * waves, minus that of a thick one. Lengths are in units of the thickness.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_physics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 20, PANELS = 2, ALL = NODES * PANELS, WAVES = 300, RADII = 64 };
static const double deepest_wave = 20, largest_radius = 1.3;

struct thin_sample {
    double step;                               /* unit: contact radius [m] */
    double depth[RADII + 1], force[RADII + 1]; /* relative to a thick sample */
};

/* Gauss-Legendre rule between 0 and 1. */
static void rule(double *x, double *w)
{
    for (int i = 0; i < NODES; i++) {
        double z = cos(M_PI * (i + 0.75) / (NODES + 0.5)), slope = 1;
        for (int k = 0; k < 50; k++) {
            double p = 1, before = 0;
            for (int j = 0; j < NODES; j++) {
                const double next = ((2 * j + 1) * z * p - j * before) / (j + 1);
                before = p;
                p = next;
            }
            slope = NODES * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        x[i] = 0.5 * (1 - z);
        w[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

/* Compliance of the sample for a wave relative to a thick one, minus 1 (Poisson's ratio 0.5). */
static double response(double x, int unbonded)
{
    const double e = exp(-2 * x);
    if (unbonded)
        return x > 0 ? (2 * e * e - 2 * e - 4 * x * e) / (1 - e * e + 4 * x * e) : -1;
    return -(2 * (1 + 2 * x + 2 * x * x) * e + 2 * e * e) / (1 + (2 + 4 * x * x) * e + e * e);
}

/* The same for a layer bonded to rubber, relative to a thick layer (Burmister, J. Appl. Phys. 16
 * (1945) 89); ratio: E of the layer over that of the rubber. */
static double layer_response(double x, double ratio)
{
    const double beta = (ratio - 1) / (ratio + 1), e = exp(-2 * x), all = beta * beta * e * e;
    return (2 * beta * (1 + 2 * x + 2 * x * x) * e - 2 * all) /
           (1 - (2 * beta + 4 * beta * x * x) * e + all);
}

/* Solves m y = b for two right sides by elimination with pivoting. */
static void eliminate(double m[ALL][ALL], double b[2][ALL], int n)
{
    for (int c = 0; c < n; c++) {
        int pivot = c;
        for (int r = c + 1; r < n; r++)
            if (fabs(m[r][c]) > fabs(m[pivot][c]))
                pivot = r;
        for (int k = 0; k < n && pivot != c; k++) {
            const double swap = m[c][k];
            m[c][k] = m[pivot][k];
            m[pivot][k] = swap;
        }
        for (int s = 0; s < 2 && pivot != c; s++) {
            const double swap = b[s][c];
            b[s][c] = b[s][pivot];
            b[s][pivot] = swap;
        }
        for (int r = 0; r < n; r++) {
            const double part = r == c ? 0 : m[r][c] / m[c][c];
            for (int k = c; k < n && part != 0; k++)
                m[r][k] -= part * m[c][k];
            for (int s = 0; s < 2; s++)
                b[s][r] -= part * b[s][c];
        }
    }
    for (int c = 0; c < n; c++)
        for (int s = 0; s < 2; s++)
            b[s][c] /= m[c][c];
}

/* Depth and force over E/(1 - nu^2) at the contact radius a. The nodes are split at the edge of the
 * tip cap, and denser there. */
static void solve(const afm_tip *tip, double thickness, const double *kernel, double a,
                  double *depth, double *force)
{
    const double step = deepest_wave / WAVES;
    double x[NODES], w[NODES], t[ALL], weight[ALL], shape[2][ALL], m[ALL][ALL];
    double(*wave)[WAVES + 1] = calloc(ALL, sizeof *wave);
    const int panels = tip->end == END_FACES && tip->b > 0 && tip->b < a ? 2 : 1;
    const int n = NODES * panels;
    if (wave == NULL)
        abort();
    rule(x, w);
    for (int i = 0; i < NODES; i++) {
        const double part = panels == 2 ? tip->b : a;
        t[i] = part * x[i];
        weight[i] = part * w[i];
        if (panels == 2) {
            t[NODES + i] = tip->b + (a - tip->b) * x[i] * x[i];
            weight[NODES + i] = 2 * (a - tip->b) * x[i] * w[i];
        }
    }
    for (int i = 0; i < n; i++) {
        shape[0][i] = 1 / M_PI;
        shape[1][i] = tip_depth(tip, t[i]) / M_PI;
        for (int k = 0; k <= WAVES; k++)
            wave[i][k] = cos(k * step * t[i] / thickness);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k <= WAVES; k++) {
                sum += kernel[k] * wave[i][k] * wave[j][k];
            }
            m[i][j] = (i == j ? 1 : 0) + 2 / M_PI * sum * weight[j] / thickness;
        }
    /* At the edge the pressure density must vanish; the equation is evaluated there. */
    eliminate(m, shape, n);
    double edge[2] = {1 / M_PI, tip_depth(tip, a) / M_PI};
    for (int j = 0; j < n; j++) {
        double sum = 0;
        for (int k = 0; k <= WAVES; k++) {
            sum += kernel[k] * cos(k * step * a / thickness) * wave[j][k];
        }
        for (int s = 0; s < 2; s++)
            edge[s] -= 2 / M_PI * sum * weight[j] / thickness * shape[s][j];
    }
    *depth = edge[1] / edge[0];
    *force = 0;
    for (int j = 0; j < n; j++)
        *force += 2 * M_PI * weight[j] * (*depth * shape[0][j] - shape[1][j]);
    free(wave);
}

/* kernel: responses without the weights of Simpson's rule; radius: the largest. */
static thin_sample *solve_all(const afm_tip *tip, double thickness, double kernel[WAVES + 1],
                              double radius)
{
    thin_sample *to = calloc(1, sizeof *to);
    if (to == NULL)
        return NULL;
    for (int k = 0; k <= WAVES; k++) {
        const double simpson = k == 0 || k == WAVES ? 1 : k % 2 == 1 ? 4 : 2;
        kernel[k] *= simpson * deepest_wave / WAVES / 3;
    }
    to->step = radius / RADII;
    to->depth[0] = to->force[0] = 1;
    for (int i = 1; i <= RADII; i++) {
        const double a = i * to->step;
        double depth, force;
        solve(tip, thickness, kernel, a, &depth, &force);
        to->depth[i] = depth / tip_depth(tip, a);
        to->force[i] = force / tip_force(tip, a);
    }
    return to;
}

thin_sample *thin_make(const afm_tip *tip, double thickness, int unbonded)
{
    double kernel[WAVES + 1];
    for (int k = 0; k <= WAVES; k++)
        kernel[k] = response(k * deepest_wave / WAVES, unbonded);
    return solve_all(tip, thickness, kernel, largest_radius * thickness);
}

thin_sample *layer_make(const afm_tip *tip, double thickness, double ratio, double radius)
{
    double kernel[WAVES + 1];
    for (int k = 0; k <= WAVES; k++)
        kernel[k] = layer_response(k * deepest_wave / WAVES, ratio);
    return solve_all(tip, thickness, kernel, radius);
}

/* Cubic interpolation through four points. */
static double between(const double *y, double at)
{
    at = fmin(at, RADII);
    int i = (int)at - 1;
    i = i < 0 ? 0 : i > RADII - 3 ? RADII - 3 : i;
    const double u = at - i;
    return -y[i] * (u - 1) * (u - 2) * (u - 3) / 6 + y[i + 1] * u * (u - 2) * (u - 3) / 2 -
           y[i + 2] * u * (u - 1) * (u - 3) / 2 + y[i + 3] * u * (u - 1) * (u - 2) / 6;
}

double thin_depth(const thin_sample *s, double a)
{
    return between(s->depth, a / s->step);
}

double thin_force(const thin_sample *s, double a)
{
    return between(s->force, a / s->step);
}
