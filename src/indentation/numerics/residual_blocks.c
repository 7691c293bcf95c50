/* Block means of the residual of a fit, and their noise.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/residual_blocks.h"

#include <math.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    POWERS = 4, /* a cubic for drift, which is no noise */
    SLOW = 8,   /* cosines of the contact for a misfit, which is no noise */
    MOST = BLOCKS_BEFORE + BLOCKS_WINDOW,
};
static const double before_contact =
    0.2; /* share of the contact before it that belongs to the window, for a snap-in */
/* Smallest residual over the force, due to rounding in files and tables. */
static const double rounding_share = 2e-5;
static const double rounding_tolerance =
    1e-9; /* relative remainder of a column that depends linearly on earlier ones */

/* Adds sample j to block i of the history and window. */
static void add_block_columns(const curve_law *m, const double p[N], size_t j, size_t i,
                              residual_blocks *b)
{
    const wt_indent_workspace *w = m->workspace;
    double row[N];
    const double factor = curve_model_row(m, p, j, row), share = 1.0 / (double)b->length;
    size_t c = 0;
    for (size_t a = 0; a < N; a++)
        if (m->free[a])
            b->column[c++][i] += row[a] / factor * share;
    for (size_t k = 0; k < WAVE_PARAMETERS && m->wave && !curve_is_in_gap(m->samples, j); k++)
        b->column[c + k][i] += w->wave_column[k][j] / factor * share;
    if (w->delta[j] > 0.0 && (m->jump == 0 || j >= m->jump) && !curve_is_in_gap(m->samples, j)) {
        const double touch = share / curve_model_factor(m, p, j);
        b->touch[i] += touch;
        b->depth[i] += touch * w->delta[j];
    }
}

/* Converts sums of the depths to means, relative to the largest. */
static void normalise_depths(residual_blocks *b)
{
    double most = 0.0;
    for (size_t i = 0; i < BLOCKS_MAX_ORDER + b->n; i++) {
        b->depth[i] = b->touch[i] > 0.0 ? b->depth[i] / b->touch[i] : 0.0;
        most = fmax(most, b->depth[i]);
    }
    for (size_t i = 0; i < BLOCKS_MAX_ORDER + b->n && most > 0.0; i++)
        b->depth[i] /= most;
}

WIDE_REGISTERS bool residual_blocks_average(const curve_law *m, const double p[N], const double *e,
                                            residual_blocks *b)
{
    const curve_samples *s = m->samples;
    const double end = s->position[s->n - 1];
    size_t first = 0;
    while (first < s->n && s->position[first] < p[CURVE_C] - before_contact * (end - p[CURVE_C]))
        first++;
    if (s->n - first < 2)
        return false;
    b->n = s->n - first < BLOCKS_WINDOW ? s->n - first : BLOCKS_WINDOW;
    const size_t length = (s->n - first) / b->n;
    first = s->n - length * b->n;
    b->length = length;
    b->first = first;
    b->travel = (end - s->position[first]) * (double)(s->n - first) / (double)(s->n - first - 1);
    b->n_before = first / length < BLOCKS_BEFORE ? first / length : BLOCKS_BEFORE;
    const size_t left = s->gap_from > first ? s->gap_from - first : 0;
    const size_t right = s->gap_to > first ? s->gap_to - first : 0;
    b->gap_from = left / length;
    b->gap_to = right > left ? (right + length - 1) / length : b->gap_from;
    b->n_columns = m->wave ? (size_t)WAVE_PARAMETERS : 0;
    for (size_t a = 0; a < N; a++)
        b->n_columns += m->free[a];
    const double share = 1.0 / (double)length;
    for (size_t i = 0; i < b->n_before + b->n; i++) {
        const size_t from = first + i * length - b->n_before * length;
        b->r[i] = curve_sum(e + from, length) * share;
    }
    memset(b->column, 0, b->n_columns * sizeof b->column[0]);
    memset(b->depth, 0, sizeof b->depth);
    memset(b->touch, 0, sizeof b->touch);
    const size_t history = b->n_before < BLOCKS_MAX_ORDER ? b->n_before : BLOCKS_MAX_ORDER;
    for (size_t i = BLOCKS_MAX_ORDER - history; i < BLOCKS_MAX_ORDER + b->n; i++)
        for (size_t j = 0; j < length; j++)
            add_block_columns(m, p, first + i * length + j - BLOCKS_MAX_ORDER * length, i, b);
    normalise_depths(b);
    return true;
}

double residual_subtract_projection(const double *q, double *x, size_t n)
{
    const double along = curve_dot(q, x, n);
    for (size_t i = 0; i < n; i++)
        x[i] -= along * q[i];
    return along;
}

WIDE_REGISTERS double residual_orthogonalise(double *r, double *const *columns, size_t n_columns,
                                             size_t count, size_t n, size_t *n_counted)
{
    double removed = 0.0;
    *n_counted = 0;
    for (size_t c = 0; c < n_columns; c++) {
        const double before = curve_dot(columns[c], columns[c], n);
        for (int twice = 0; twice < 2; twice++)
            for (size_t d = 0; d < c; d++)
                residual_subtract_projection(columns[d], columns[c], n);
        const double norm = curve_dot(columns[c], columns[c], n);
        const bool new = norm > rounding_tolerance *rounding_tolerance *before;
        for (size_t i = 0; i < n; i++)
            columns[c][i] = new ? columns[c][i] / sqrt(norm) : 0.0;
        const double along = residual_subtract_projection(columns[c], r, n);
        if (c >= count && new) {
            removed += along * along;
            ++*n_counted;
        }
    }
    return removed;
}

/* ---- noise ----------------------------------------------------------------------------------- */

/* Noise in one or two runs of blocks. */
typedef struct noise_runs {
    double x[MOST];
    size_t n, second; /* blocks; start of the second run */
    double removed;   /* parameters that were eliminated */
} noise_runs;

/* Subtracts a polynomial of `terms` terms. */
static void subtract_polynomial(double *x, size_t n, size_t terms)
{
    double power[POWERS][BLOCKS_BEFORE];
    double *const columns[POWERS] = {power[0], power[1], power[2], power[3]};
    size_t ignored;
    for (size_t i = 0; i < n; i++) {
        const double at = n > 1 ? 2.0 * (double)i / (double)(n - 1) - 1.0 : 0.0;
        power[0][i] = 1.0;
        for (size_t k = 1; k < terms; k++)
            power[k][i] = power[k - 1][i] * at;
    }
    residual_orthogonalise(x, columns, terms, terms, n, &ignored);
}

/* Subtracts the columns of the parameters and slow cosines from the window. */
static void subtract_slow_waves(const residual_blocks *b, double *x)
{
    double store[BLOCKS_COLUMNS + SLOW][BLOCKS_WINDOW], *columns[BLOCKS_COLUMNS + SLOW];
    size_t ignored;
    for (size_t c = 0; c < b->n_columns + SLOW; c++) {
        columns[c] = store[c];
        const double angle = M_PI * ((double)c - (double)b->n_columns + 1.0) / (double)b->n;
        for (size_t i = 0; i < b->n; i++)
            store[c][i] = c < b->n_columns ? b->column[c][BLOCKS_MAX_ORDER + i]
                                           : cos(angle * ((double)i + 0.5));
    }
    residual_orthogonalise(x, columns, b->n_columns + SLOW, b->n_columns + SLOW, b->n, &ignored);
}

/* Fits an autoregression by Burg's method, with the order by the corrected Akaike criterion. */
WIDE_REGISTERS static void fit_autoregression(const noise_runs *of, residual_blocks *b)
{
    const size_t n = of->n, start[2] = {0, of->second}, stop[2] = {of->second, n};
    double x[MOST], back[MOST], a[BLOCKS_MAX_ORDER + 1] = {0.0};
    memcpy(x, of->x, n * sizeof *x);
    memcpy(back, of->x, n * sizeof *back);
    const double all = (double)n - of->removed + POWERS;
    double variance = curve_dot(x, x, n) / all, best = (double)INFINITY;
    b->innovation = 0.0;
    b->order = 0; /* also for a baseline without noise */
    for (size_t order = 0; order <= BLOCKS_MAX_ORDER && variance > 0.0; order++) {
        const double p = (double)order + 1.0;
        if (!(all - p - 3.0 > 0.0))
            break;
        if (order > 0) {
            double above = 0.0, below = 0.0, old[BLOCKS_MAX_ORDER + 1];
            for (int run = 0; run < 2; run++)
                for (size_t i = start[run] + order; i < stop[run]; i++) {
                    above += x[i] * back[i - 1];
                    below += x[i] * x[i] + back[i - 1] * back[i - 1];
                }
            const double k = below > 0.0 ? 2.0 * above / below : 0.0;
            memcpy(old, a, sizeof old);
            a[order] = k;
            for (size_t j = 1; j < order; j++)
                a[j] = old[j] - k * old[order - j];
            for (int run = 0; run < 2; run++)
                for (size_t i = stop[run]; i-- > start[run] + order;) {
                    const double forward = x[i];
                    x[i] = forward - k * back[i - 1];
                    back[i] = back[i - 1] - k * forward;
                }
            variance *= 1.0 - k * k;
        }
        const double criterion = all * log(variance) + 2.0 * p * all / (all - p - 1.0);
        if (criterion < best) {
            best = criterion;
            b->order = order;
            memcpy(b->a, a, sizeof a);
            b->innovation = variance * all / (all - p - 3.0);
        }
    }
}

bool residual_blocks_find_noise(const curve_law *m, const double p[N], residual_blocks *b)
{
    noise_runs of = {.n = b->n_before, .second = b->n_before, .removed = POWERS};
    const bool is_short = b->n_before < BLOCKS_MIN_BASELINE;
    memcpy(of.x, b->r, b->n_before * sizeof *of.x);
    if (!is_short) {
        subtract_polynomial(of.x, of.n, POWERS);
    } else { /* slow parts in contact may be misfit, fast ones are noise */
        of.n = b->n_before + b->n;
        of.removed = (double)(b->n_columns + SLOW + 1);
        memcpy(of.x + b->n_before, b->r + b->n_before, b->n * sizeof *of.x);
        subtract_polynomial(of.x, b->n_before, b->n_before > 0 ? 1 : 0);
        subtract_slow_waves(b, of.x + b->n_before);
    }
    if ((double)of.n < of.removed + POWERS)
        return false;
    fit_autoregression(&of, b);
    b->freedom = ((double)of.n - (is_short ? of.removed : 0.0)) / BLOCKS_PER_FREEDOM;
    const double top = rounding_share * p[CURVE_E] * m->workspace->g[m->samples->n - 1];
    b->innovation = fmax(b->innovation, top * top);
    return b->innovation > 0.0 && isfinite(b->innovation);
}

void residual_blocks_whiten(const residual_blocks *b, const double *x, size_t from, size_t n,
                            double *out)
{
    for (size_t i = 0; i < n; i++) {
        out[i] = x[from + i];
        for (size_t k = 1; k <= b->order && k <= from + i; k++)
            out[i] -= b->a[k] * x[from + i - k];
    }
}

void residual_blocks_zero_gap(const residual_blocks *b, double *x)
{
    const size_t end = b->gap_to > b->gap_from ? b->gap_to + b->order : 0;
    for (size_t i = b->gap_from; i < end && i < b->n; i++)
        x[i] = 0.0;
}
