/* Does the contact law describe the curve? Its residual against the noise of the same curve.
 *
 * Its blocks (residual_blocks.h) less what their noise owes to those before are white if the law
 * is right. It is compared with
 * the first cosines over the contact, less what the parameters of the fit can imitate: the share of
 * each cosine is then of the size of the innovations. The baseline itself is tried against a
 * parabola and a cubic.
 *
 * The force of a contact rises ever steeper with the height. Where it bends the other way at its
 * top the detector saturates, or the sample gives way: so parabolas through the last blocks,
 * whitened alike, are tried, too.
 *
 * A curve that passes may still be of a wrong tip, or of a layer: these change the modulus far more
 * than the residual.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/residual_blocks.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    COSINES = 8, /* a smooth misfit is in the first; more share its power with noise */
    TOPS = 3,    /* lengths of the top: so many eighths of the window */
    POWERS = 4,
    MAX_COLUMNS = BLOCKS_COLUMNS + COSINES,
    BEFORE = BLOCKS_BEFORE,
    WINDOW = BLOCKS_WINDOW,
    MAX_ORDER = BLOCKS_MAX_ORDER,
};
static const double least_bend = 3.0;      /* innovations: less is noise in 1 of 400 */
static const double less_steep = 0.9;      /* at the end than at the steepest */
static const double still_straight = 0.75; /* of the force where it is steepest */

typedef residual_blocks blocks;
typedef double waves[COSINES][BLOCKS_HISTORY];

/* Cosines over the window, nothing before it. */
static void make_waves(const blocks *b, waves to)
{
    memset(to, 0, sizeof(waves));
    for (size_t j = 0; j < COSINES; j++) {
        double *wave = to[j] + MAX_ORDER;
        const double angle = M_PI * (double)(j + 1) / (double)b->n, twice = 2.0 * cos(angle);
        wave[0] = cos(0.5 * angle);
        wave[1] = cos(1.5 * angle);
        for (size_t i = 2; i < b->n; i++)
            wave[i] = twice * wave[i - 1] - wave[i - 2];
    }
}

WIDE_REGISTERS static double contact_residual_chance(const blocks *b, waves wave, double *statistic)
{
    double store[MAX_COLUMNS][WINDOW], r[WINDOW], *columns[MAX_COLUMNS];
    size_t n = 0, counted;
    residual_blocks_whiten(b, b->r, b->n_before, b->n, r);
    for (; n < b->n_columns; n++)
        residual_blocks_whiten(b, b->column[n], MAX_ORDER, b->n, store[n]);
    for (size_t j = 0; j < COSINES; j++, n++)
        residual_blocks_whiten(b, wave[j], MAX_ORDER, b->n, store[n]);
    residual_blocks_leave_out_gap(b, r);
    for (size_t c = 0; c < n; c++) {
        residual_blocks_leave_out_gap(b, store[c]);
        columns[c] = store[c];
    }
    const double taken = residual_project_out(r, columns, n, b->n_columns, b->n, &counted);
    *statistic = counted > 0 ? taken / (double)counted / b->innovation : 0.0;
    return gsl_cdf_fdist_Q(*statistic, (double)counted, b->freedom);
}

static double baseline_residual_chance(const blocks *b)
{
    double power[4][BEFORE], store[4][BEFORE], r[BEFORE];
    double *const columns[4] = {store[0], store[1], store[2], store[3]};
    const size_t skip = b->order, n = b->n_before - skip;
    size_t counted;
    for (size_t i = 0; i < b->n_before; i++) {
        const double x = 2.0 * (double)i / (double)(b->n_before - 1) - 1.0;
        power[0][i] = 1.0;
        for (size_t k = 1; k < POWERS; k++)
            power[k][i] = power[k - 1][i] * x;
    }
    for (int c = 0; c < 4; c++)
        residual_blocks_whiten(b, power[c], skip, n, store[c]);
    residual_blocks_whiten(b, b->r, skip, n, r);
    const double taken = residual_project_out(r, columns, 4, 2, n, &counted);
    if (counted == 0)
        return 1.0;
    return gsl_cdf_fdist_Q(taken / (double)counted / b->innovation, (double)counted, b->freedom);
}

/* How much a parabola bends through the last n of N whitened blocks, in innovations; its sign. */
WIDE_REGISTERS static double bend_of(const blocks *b, const double *force, double (*column)[WINDOW],
                                     size_t n)
{
    double x[WINDOW], power[3][WINDOW], bend = 0.0;
    memcpy(x, force + b->n - n, n * sizeof *x);
    for (size_t k = 0; k < 3; k++) {
        memcpy(power[k], column[k] + b->n - n, n * sizeof *x);
        for (size_t d = 0; d < k; d++)
            residual_remove_along(power[d], power[k], n);
        const double norm = sqrt(curve_dot(power[k], power[k], n));
        for (size_t i = 0; i < n; i++)
            power[k][i] /= norm;
        bend = residual_remove_along(power[k], x, n);
    }
    return bend / sqrt(b->innovation);
}

/* Against the height, for samples may be left out and a piezo may slow down. */
WIDE_REGISTERS static void find_flat_top(const curve_law *m, const double p[N], const blocks *b,
                                         curve_lack *lack)
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
        most = fmax(most, -bend_of(b, white, column, top * b->n / 8));
    double slope = 0.0;
    for (size_t i = MAX_ORDER; i + 3 < all; i++) {
        const double moved = power[1][i + 3] - power[1][i];
        if (!(moved > 0.0)) /* a height that is held or steps back shows no slope */
            continue;
        slope = (force[i + 3] - force[i]) / moved;
        if (slope > steepest) {
            steepest = slope;
            lack->flat_from = still_straight * (0.5 * (force[i + 3] + force[i]) - p[CURVE_F0]);
        }
    }
    const bool flat = most > least_bend && slope < less_steep * steepest; /* the last one */
    lack->flat_chance = flat ? 0.5 * TOPS * gsl_cdf_fdist_Q(most * most, 1.0, b->freedom) : 1.0;
}

curve_lack curve_lack_of_fit(const curve_law *m, const double p[N], const double *e)
{
    blocks b;
    waves wave;
    const double unknown = (double)NAN;
    curve_lack lack = {
        .statistic = unknown, .chance = unknown, .baseline_p = unknown, .flat_chance = unknown};
    for (int j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = unknown;
    if (!residual_blocks_average(m, p, e, &b) || b.n <= b.n_columns + COSINES ||
        !residual_blocks_find_noise(m, p, &b))
        return lack;
    const size_t history = b.n_before < MAX_ORDER ? b.n_before : MAX_ORDER;
    lack.window = b.travel;
    if (b.n_before >= BLOCKS_LEAST)
        lack.baseline_p = baseline_residual_chance(&b);
    if (history == MAX_ORDER)
        find_flat_top(m, p, &b, &lack);
    make_waves(&b, wave);
    lack.chance = contact_residual_chance(&b, wave, &lack.statistic);
    for (size_t j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = 2.0 / (double)b.n * curve_dot(b.r + b.n_before, wave[j] + MAX_ORDER, b.n);
    return lack;
}
