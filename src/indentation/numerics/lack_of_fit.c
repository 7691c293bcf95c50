/* Test of the contact law: residual of one curve compared with its noise.
 *
 * The blocks minus their autoregression are white if the law is correct. The
 * test projects them on the first cosines over the contact that the parameters of the fit do not
 * explain. Each projection then has the size of the innovations. The baseline alone is tested
 * against a parabola and a cubic.
 *
 * The force of a contact steepens with the height. A flattening at its top indicates a saturated
 * detector or a yielding sample. The file therefore tests parabolas through the last blocks in the
 * same way.
 *
 * A curve that passes may still have a wrong tip or a layer, because these change the modulus much
 * more than the residual.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum {
    WINDOW = 48,       /* blocks of the contact */
    BEFORE = 400,      /* largest number of blocks of the baseline */
    MIN_BASELINE = 16, /* smallest baseline that determines the noise alone */
    MAX_ORDER = 6,     /* order of the autoregression */
    HISTORY = MAX_ORDER + WINDOW,
    COLUMNS = CURVE_N_PARAMETERS + WAVE_PARAMETERS,
    N = CURVE_N_PARAMETERS,
    COSINES = 8, /* a smooth misfit is in the first; more cosines add noise */
    TOPS = 3,    /* lengths of the top, in eighths of the window */
    POWERS = 4,  /* a cubic for drift, which is no noise */
    MAX_COLUMNS = COLUMNS + COSINES,
    SLOW = 8, /* cosines of the contact for a misfit, which is no noise */
};

/* Blocks per degree of freedom of the noise variance. Simulations with noise of several colours
 * determine it (1 % false alarms for white, first-order and 1/f noise). */
static const double blocks_per_freedom = 10.0;

typedef struct blocks {
    size_t n_before, n; /* blocks of the baseline, and of the window after it */
    double r[BEFORE + WINDOW];
    double column[COLUMNS][HISTORY]; /* columns of the window and of its history */
    size_t n_columns;
    size_t length;           /* samples per block */
    double travel;           /* travel in the window [m] */
    size_t gap_from, gap_to; /* blocks of the window with samples that are not compared */
    size_t order;
    double a[MAX_ORDER + 1]; /* x_i = sum a_k x_(i-k) + innovation, k from 1 */
    double innovation;       /* variance of the innovations */
    double freedom;          /* degrees of freedom of that variance */
} blocks;

static const double before_contact =
    0.2; /* share of the contact before it that belongs to the window, for a snap-in */

/* Smallest residual over the force, due to rounding in files and tables. */
static const double rounding_share = 2e-5;

static const double rounding_tolerance =
    1e-9; /* relative remainder of a column that depends linearly on earlier ones */

/* ---- block means of the residual, and their noise -------------------------------------------- */

/* Adds a share of sample j to block i of the history and window. */
static void add_block_columns(const curve_law *m, const double p[N], size_t j, double share,
                              size_t i, blocks *b)
{
    const wt_indent_workspace *w = m->workspace;
    double row[N];
    const double factor = curve_model_row(m, p, j, row);
    size_t c = 0;
    for (size_t a = 0; a < N; a++)
        if (m->free[a])
            b->column[c++][i] += row[a] / factor * share;
    for (size_t k = 0; k < WAVE_PARAMETERS && m->wave && !curve_is_in_gap(m->samples, j); k++)
        b->column[c + k][i] += w->wave_column[k][j] / factor * share;
}

/* Computes block means of the residuals e and of the derivatives at the parameters of the latest
 * evaluation. The window begins a fifth of the contact before it, because a snap-in may be there.
 * Returns false if no sample is in contact. */
static WIDE_REGISTERS bool residual_blocks_average(const curve_law *m, const double p[N],
                                                   const double *e, blocks *b)
{
    const curve_samples *s = m->samples;
    const double end = s->position[s->n - 1];
    size_t first = 0;
    while (first < s->n && s->position[first] < p[CURVE_C] - before_contact * (end - p[CURVE_C]))
        first++;
    if (s->n - first < 2)
        return false;
    b->n = s->n - first < WINDOW ? s->n - first : WINDOW;
    const size_t length = (s->n - first) / b->n;
    first = s->n - length * b->n;
    b->length = length;
    b->travel = (end - s->position[first]) * (double)(s->n - first) / (double)(s->n - first - 1);
    b->n_before = first / length < BEFORE ? first / length : BEFORE;
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
    const size_t history = b->n_before < MAX_ORDER ? b->n_before : MAX_ORDER;
    const size_t step = length < 4 ? 1 : length / 4; /* derivatives are smooth */
    const size_t n_rows = (length - step / 2 + step - 1) / step;
    for (size_t i = MAX_ORDER - history; i < MAX_ORDER + b->n; i++)
        for (size_t j = step / 2; j < length; j += step)
            add_block_columns(m, p, first + i * length + j - MAX_ORDER * length,
                              1.0 / (double)n_rows, i, b);
    return true;
}

/* Subtracts the projection on the unit vector q from x and returns its coefficient. */
static double residual_subtract_projection(const double *q, double *x, size_t n)
{
    const double along = curve_dot(q, x, n);
    for (size_t i = 0; i < n; i++)
        x[i] -= along * q[i];
    return along;
}

WIDE_REGISTERS double curve_orthogonalise(double *r, double *const *columns, size_t n_columns,
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
    double x[BEFORE + WINDOW];
    size_t n, second; /* blocks; start of the second run */
    double removed;   /* parameters that were eliminated */
} noise_runs;

/* Tabulates the first powers of the position among n blocks, from -1 to 1. */
static void tabulate_powers(size_t n, double power[POWERS][BEFORE])
{
    for (size_t i = 0; i < n; i++) {
        const double at = n > 1 ? 2.0 * (double)i / (double)(n - 1) - 1.0 : 0.0;
        power[0][i] = 1.0;
        for (size_t k = 1; k < POWERS; k++)
            power[k][i] = power[k - 1][i] * at;
    }
}

/* Subtracts a polynomial of `terms` terms. */
static void subtract_polynomial(double *x, size_t n, size_t terms)
{
    double power[POWERS][BEFORE];
    double *const columns[POWERS] = {power[0], power[1], power[2], power[3]};
    size_t ignored;
    tabulate_powers(n, power);
    curve_orthogonalise(x, columns, terms, terms, n, &ignored);
}

/* Subtracts the columns of the parameters and slow cosines from the window. */
static void subtract_slow_waves(const blocks *b, double *x)
{
    double store[COLUMNS + SLOW][WINDOW], *columns[COLUMNS + SLOW];
    size_t ignored;
    for (size_t c = 0; c < b->n_columns + SLOW; c++) {
        columns[c] = store[c];
        const double angle = M_PI * ((double)c - (double)b->n_columns + 1.0) / (double)b->n;
        for (size_t i = 0; i < b->n; i++)
            store[c][i] =
                c < b->n_columns ? b->column[c][MAX_ORDER + i] : cos(angle * ((double)i + 0.5));
    }
    curve_orthogonalise(x, columns, b->n_columns + SLOW, b->n_columns + SLOW, b->n, &ignored);
}

/* Fits an autoregression by Burg's method, with the order by the corrected Akaike criterion. */
WIDE_REGISTERS static void fit_autoregression(const noise_runs *of, blocks *b)
{
    const size_t n = of->n, start[2] = {0, of->second}, stop[2] = {of->second, n};
    double x[BEFORE + WINDOW], back[BEFORE + WINDOW], a[MAX_ORDER + 1] = {0.0};
    memcpy(x, of->x, n * sizeof *x);
    memcpy(back, of->x, n * sizeof *back);
    const double all = (double)n - of->removed + POWERS;
    double variance = curve_dot(x, x, n) / all, best = (double)INFINITY;
    b->innovation = 0.0;
    b->order = 0; /* also for a baseline without noise */
    for (size_t order = 0; order <= MAX_ORDER && variance > 0.0; order++) {
        const double p = (double)order + 1.0;
        if (!(all - p - 3.0 > 0.0))
            break;
        if (order > 0) {
            double above = 0.0, below = 0.0, old[MAX_ORDER + 1];
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

/* Estimates the noise of the baseline without its slow part. If the baseline is short, the window
 * is used too. Returns false without noise. */
static bool residual_blocks_find_noise(const curve_law *m, const double p[N], blocks *b)
{
    noise_runs of = {.n = b->n_before, .second = b->n_before, .removed = POWERS};
    const bool is_short = b->n_before < MIN_BASELINE;
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
    b->freedom = ((double)of.n - (is_short ? of.removed : 0.0)) / blocks_per_freedom;
    const double top = rounding_share * p[CURVE_E] * m->workspace->g[m->samples->n - 1];
    b->innovation = fmax(b->innovation, top * top);
    return b->innovation > 0.0 && isfinite(b->innovation);
}

/* Computes the n innovations of x[from..]. */
static void residual_blocks_whiten(const blocks *b, const double *x, size_t from, size_t n,
                                   double *out)
{
    for (size_t i = 0; i < n; i++) {
        out[i] = x[from + i];
        for (size_t k = 1; k <= b->order && k <= from + i; k++)
            out[i] -= b->a[k] * x[from + i - k];
    }
}

/* Sets the innovations of blocks with samples that are not compared to 0. */
static void residual_blocks_zero_gap(const blocks *b, double *x)
{
    const size_t end = b->gap_to > b->gap_from ? b->gap_to + b->order : 0;
    for (size_t i = b->gap_from; i < end && i < b->n; i++)
        x[i] = 0.0;
}

static const double min_curvature = 3.0;   /* in innovations; noise exceeds it in 1 of 400 cases */
static const double max_end_slope = 0.85;  /* largest slope at the end over the steepest slope */
static const double straight_share = 0.75; /* share of the force at the steepest slope */

/* ---- test ------------------------------------------------------------------------------------ */

typedef double cosine_table[COSINES][HISTORY];

/* Tabulates cosines over the window, and zeros before it. */
static void tabulate_cosines(const blocks *b, cosine_table to)
{
    memset(to, 0, sizeof(cosine_table));
    for (size_t j = 0; j < COSINES; j++) {
        double *wave = to[j] + MAX_ORDER;
        const double angle = M_PI * (double)(j + 1) / (double)b->n, twice = 2.0 * cos(angle);
        wave[0] = cos(0.5 * angle);
        wave[1] = cos(1.5 * angle);
        for (size_t i = 2; i < b->n; i++)
            wave[i] = twice * wave[i - 1] - wave[i - 2];
    }
}

WIDE_REGISTERS static double contact_residual_chance(const blocks *b, cosine_table wave,
                                                     double *statistic)
{
    double store[MAX_COLUMNS][WINDOW], r[WINDOW], *columns[MAX_COLUMNS];
    size_t n = 0, n_counted;
    residual_blocks_whiten(b, b->r, b->n_before, b->n, r);
    for (; n < b->n_columns; n++)
        residual_blocks_whiten(b, b->column[n], MAX_ORDER, b->n, store[n]);
    for (size_t j = 0; j < COSINES; j++, n++)
        residual_blocks_whiten(b, wave[j], MAX_ORDER, b->n, store[n]);
    residual_blocks_zero_gap(b, r);
    for (size_t c = 0; c < n; c++) {
        residual_blocks_zero_gap(b, store[c]);
        columns[c] = store[c];
    }
    const double explained = curve_orthogonalise(r, columns, n, b->n_columns, b->n, &n_counted);
    *statistic = n_counted > 0 ? explained / (double)n_counted / b->innovation : 0.0;
    return gsl_cdf_fdist_Q(*statistic, (double)n_counted, b->freedom);
}

static double baseline_residual_chance(const blocks *b)
{
    double power[4][BEFORE], store[4][BEFORE], r[BEFORE];
    double *const columns[4] = {store[0], store[1], store[2], store[3]};
    const size_t skip = b->order, n = b->n_before - skip;
    size_t n_counted;
    tabulate_powers(b->n_before, power);
    for (int c = 0; c < 4; c++)
        residual_blocks_whiten(b, power[c], skip, n, store[c]);
    residual_blocks_whiten(b, b->r, skip, n, r);
    const double explained = curve_orthogonalise(r, columns, 4, 2, n, &n_counted);
    if (n_counted == 0)
        return 1.0;
    return gsl_cdf_fdist_Q(explained / (double)n_counted / b->innovation, (double)n_counted,
                           b->freedom);
}

/* Curvature of a parabola through the last n of N whitened blocks, in standard deviations of the
 * innovation, with its sign. */
WIDE_REGISTERS static double top_curvature(const blocks *b, const double *force,
                                           double (*column)[WINDOW], size_t n)
{
    double x[WINDOW], power[3][WINDOW], bend = 0.0;
    memcpy(x, force + b->n - n, n * sizeof *x);
    for (size_t k = 0; k < 3; k++) {
        memcpy(power[k], column[k] + b->n - n, n * sizeof *x);
        for (size_t d = 0; d < k; d++)
            residual_subtract_projection(power[d], power[k], n);
        const double norm = sqrt(curve_dot(power[k], power[k], n));
        for (size_t i = 0; i < n; i++)
            power[k][i] /= norm;
        bend = residual_subtract_projection(power[k], x, n);
    }
    return bend / sqrt(b->innovation);
}

/* Tests the flattening against the height, because samples may be missing and a piezo may slow
 * down. */
WIDE_REGISTERS static void find_flat_top(const curve_law *m, const double p[N], const blocks *b,
                                         curve_misfit_test *lack)
{
    enum { ALL = MAX_ORDER + WINDOW };
    const curve_samples *s = m->samples;
    const size_t all = MAX_ORDER + b->n, first = s->n - all * b->length;
    const double end = s->position[s->n - 1];
    double force[ALL], power[3][ALL], white[WINDOW], column[3][WINDOW], most = 0.0, steepest = 0.0;
    for (size_t i = 0; i < all; i++) {
        const size_t from = first + i * b->length;
        const double length = (double)b->length;
        force[i] = curve_sum(s->force + from, b->length) / length;
        power[0][i] = 1.0;
        power[1][i] = (curve_sum(s->position + from, b->length) / length - end) / b->travel;
        power[2][i] = power[1][i] * power[1][i];
    }
    residual_blocks_whiten(b, force, MAX_ORDER, b->n, white);
    for (size_t k = 0; k < 3; k++)
        residual_blocks_whiten(b, power[k], MAX_ORDER, b->n, column[k]);
    for (size_t top = 1; top <= TOPS; top++)
        most = fmax(most, -top_curvature(b, white, column, top * b->n / 8));
    double slope = 0.0;
    for (size_t i = MAX_ORDER; i + 3 < all; i++) {
        const double moved = power[1][i + 3] - power[1][i];
        if (!(moved > 0.0)) /* a constant or decreasing height has no slope */
            continue;
        slope = (force[i + 3] - force[i]) / moved;
        if (slope > steepest) {
            steepest = slope;
            lack->flat_from = straight_share * (0.5 * (force[i + 3] + force[i]) - p[CURVE_F0]);
        }
    }
    const bool flat =
        most > min_curvature && slope < max_end_slope * steepest; /* slope at the end */
    lack->flat_chance = flat ? 0.5 * TOPS * gsl_cdf_fdist_Q(most * most, 1.0, b->freedom) : 1.0;
}

curve_misfit_test curve_lack_of_fit(const curve_law *m, const double p[N], const double *e)
{
    blocks b;
    cosine_table wave;
    const double unknown = (double)NAN;
    curve_misfit_test lack = {
        .statistic = unknown, .chance = unknown, .baseline_p = unknown, .flat_chance = unknown};
    for (int j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = unknown;
    if (!residual_blocks_average(m, p, e, &b) || b.n <= b.n_columns + COSINES ||
        !residual_blocks_find_noise(m, p, &b))
        return lack;
    const size_t history = b.n_before < MAX_ORDER ? b.n_before : MAX_ORDER;
    lack.window = b.travel;
    if (b.n_before >= MIN_BASELINE)
        lack.baseline_p = baseline_residual_chance(&b);
    if (history == MAX_ORDER)
        find_flat_top(m, p, &b, &lack);
    tabulate_cosines(&b, wave);
    lack.chance = contact_residual_chance(&b, wave, &lack.statistic);
    for (size_t j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = 2.0 / (double)b.n * curve_dot(b.r + b.n_before, wave[j] + MAX_ORDER, b.n);
    return lack;
}
