/* Fills missing heights by a membrane over their neighbours, with conjugate gradients (Hestenes
 * and Stiefel, J. Res. Natl. Bur. Stand. 49 (1952) 409).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Relative residual at the end of the iteration, far below the resolution of an instrument. */
static const double residual_left = 1e-12;

typedef struct membrane {
    double *z;               /* heights; missing ones are filled in place */
    size_t nx, ny, n;        /* size of the grid; n: missing heights */
    size_t *position;        /* [n] */
    uint32_t *missing_index; /* [ny * nx] index of a missing height; a marker for known heights */
    double *residual, *direction, *product; /* [n] */
} membrane;
enum { NEIGHBOURS = 4 }; /* neighbours in the grid */
#define NOT_MISSING UINT32_MAX

/* Lists the neighbours of a grid point and returns their number. */
static size_t list_neighbours(const membrane *m, size_t p, size_t to[NEIGHBOURS])
{
    const size_t i = p % m->nx, j = p / m->nx;
    size_t n = 0;
    if (i > 0)
        to[n++] = p - 1;
    if (i + 1 < m->nx)
        to[n++] = p + 1;
    if (j > 0)
        to[n++] = p - m->nx;
    if (j + 1 < m->ny)
        to[n++] = p + m->nx;
    return n;
}

/* Applies the discrete Laplacian to the missing heights: number of neighbours times the value,
 * minus the missing neighbours. */
static void apply_laplacian(const membrane *m, const double *x, double *to)
{
    size_t neighbours[NEIGHBOURS];
    for (size_t k = 0; k < m->n; k++) {
        const size_t n = list_neighbours(m, m->position[k], neighbours);
        double sum = (double)n * x[k];
        for (size_t b = 0; b < n; b++)
            if (m->missing_index[neighbours[b]] != NOT_MISSING)
                sum -= x[m->missing_index[neighbours[b]]];
        to[k] = sum;
    }
}

static double sum_of_squares(const double *x, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sum;
}

/* Starts at zero. The residual is the sum of the known neighbours. */
static void start_solution(membrane *m)
{
    size_t neighbours[NEIGHBOURS];
    for (size_t k = 0; k < m->n; k++) {
        const size_t n = list_neighbours(m, m->position[k], neighbours);
        double sum = 0;
        for (size_t b = 0; b < n; b++)
            if (m->missing_index[neighbours[b]] == NOT_MISSING)
                sum += m->z[neighbours[b]];
        m->residual[k] = m->direction[k] = sum;
    }
    for (size_t k = 0; k < m->n; k++)
        m->z[m->position[k]] = 0;
}

static wt_status solve_membrane(membrane *m, wt_error *err)
{
    start_solution(m);
    const double first = sum_of_squares(m->residual, m->n);
    double now = first;
    /* In exact arithmetic n steps suffice; a small patch needs a few more due to rounding. */
    for (size_t step = 0; step < 2 * m->n + 10; step++) {
        if (now <= residual_left * residual_left * first)
            return WT_OK;
        apply_laplacian(m, m->direction, m->product);
        double along = 0;
        for (size_t k = 0; k < m->n; k++)
            along += m->direction[k] * m->product[k];
        const double a = now / along;
        for (size_t k = 0; k < m->n; k++) {
            m->z[m->position[k]] += a * m->direction[k];
            m->residual[k] -= a * m->product[k];
        }
        const double next = sum_of_squares(m->residual, m->n), b = next / now;
        for (size_t k = 0; k < m->n; k++)
            m->direction[k] = m->residual[k] + b * m->direction[k];
        now = next;
    }
    return wt_fail(err, WT_E_CONVERGENCE, "the missing heights could not be filled");
}

wt_status surface_fill_missing(double *z, size_t nx, size_t ny, wt_error *err)
{
    membrane m = {.z = z, .nx = nx, .ny = ny};
    for (size_t p = 0; p < nx * ny; p++)
        m.n += isfinite(z[p]) ? 0 : 1;
    if (m.n == 0)
        return WT_OK;
    if (m.n == nx * ny)
        return wt_fail(err, WT_E_EMPTY, "all heights are missing");
    m.position = wt_alloc(m.n, sizeof *m.position);
    m.missing_index = wt_alloc(nx * ny, sizeof *m.missing_index);
    m.residual = wt_alloc(3 * m.n, sizeof *m.residual);
    m.direction = m.residual + m.n;
    m.product = m.direction + m.n;
    size_t k = 0;
    for (size_t p = 0; p < nx * ny; p++) {
        m.missing_index[p] = isfinite(z[p]) ? NOT_MISSING : (uint32_t)k;
        if (m.missing_index[p] != NOT_MISSING)
            m.position[k++] = p;
    }
    const wt_status status = solve_membrane(&m, err);
    free(m.position);
    free(m.missing_index);
    free(m.residual);
    return status;
}
