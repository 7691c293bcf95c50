/* Test of the contact law: residual of one curve compared with its noise.
 *
 * The blocks (residual_blocks.h) minus their autoregression are white if the law is correct. The
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
#include "indentation/numerics/residual_blocks.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    COSINES = 8, /* a smooth misfit is in the first; more cosines add noise */
    TOPS = 3,    /* lengths of the top, in eighths of the window */
    POWERS = 4,
    MAX_COLUMNS = BLOCKS_COLUMNS + COSINES,
    BEFORE = BLOCKS_BEFORE,
    WINDOW = BLOCKS_WINDOW,
    MAX_ORDER = BLOCKS_MAX_ORDER,
};
static const double min_curvature = 3.0;   /* in innovations; noise exceeds it in 1 of 400 cases */
static const double max_end_slope = 0.9;   /* largest slope at the end over the steepest slope */
static const double straight_share = 0.75; /* share of the force at the steepest slope */

typedef residual_blocks blocks;
typedef double cosine_table[COSINES][BLOCKS_HISTORY];

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
    const double explained = residual_orthogonalise(r, columns, n, b->n_columns, b->n, &n_counted);
    *statistic = n_counted > 0 ? explained / (double)n_counted / b->innovation : 0.0;
    return gsl_cdf_fdist_Q(*statistic, (double)n_counted, b->freedom);
}

static double baseline_residual_chance(const blocks *b)
{
    double power[4][BEFORE], store[4][BEFORE], r[BEFORE];
    double *const columns[4] = {store[0], store[1], store[2], store[3]};
    const size_t skip = b->order, n = b->n_before - skip;
    size_t n_counted;
    for (size_t i = 0; i < b->n_before; i++) {
        const double x = 2.0 * (double)i / (double)(b->n_before - 1) - 1.0;
        power[0][i] = 1.0;
        for (size_t k = 1; k < POWERS; k++)
            power[k][i] = power[k - 1][i] * x;
    }
    for (int c = 0; c < 4; c++)
        residual_blocks_whiten(b, power[c], skip, n, store[c]);
    residual_blocks_whiten(b, b->r, skip, n, r);
    const double explained = residual_orthogonalise(r, columns, 4, 2, n, &n_counted);
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
    if (b.n_before >= BLOCKS_MIN_BASELINE)
        lack.baseline_p = baseline_residual_chance(&b);
    if (history == MAX_ORDER)
        find_flat_top(m, p, &b, &lack);
    tabulate_cosines(&b, wave);
    lack.chance = contact_residual_chance(&b, wave, &lack.statistic);
    for (size_t j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = 2.0 / (double)b.n * curve_dot(b.r + b.n_before, wave[j] + MAX_ORDER, b.n);
    return lack;
}
