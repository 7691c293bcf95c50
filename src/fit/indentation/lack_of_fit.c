/* Does the contact law describe the curve? Its residual against the noise of the same curve.
 *
 * From a fifth of the contact before it to the end the residual is averaged in blocks, and so is
 * the baseline before; an autoregression of the baseline says what the noise of one block owes to
 * those before it. What it leaves of the blocks is white if the law is right. It is compared with
 * the first cosines over the contact, less what the parameters of the fit can imitate: the share of
 * each cosine is then of the size of the innovations. The baseline itself is tried against a
 * parabola and a cubic. The degrees of freedom, a tenth of the blocks of the baseline, are those
 * that simulated noise of several colours asks for.
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
#include "fit/indentation/curve_model.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    WINDOW = 48,   /* blocks */
    BEFORE = 400,  /* most of the baseline */
    LEAST = 16,    /* blocks of the baseline, to say anything */
    MAX_ORDER = 6, /* of the autoregression */
    COSINES = 8,
    LOSS = 4, /* powers of the logarithm of time */
    TOPS = 3, /* lengths of the top: so many eighths of the window */
    OTHERS = N + LOSS + COSINES,
    MAX_COLUMNS = OTHERS + WAVE_PARAMETERS,
};
static const double before_contact = 0.2;  /* of the contact: a snap-on hides there */
static const double per_freedom = 10.0;    /* blocks */
static const double least_bend = 3.0;      /* innovations: less is not looked at */
static const double less_steep = 0.9;      /* at the end than at the steepest */
static const double still_straight = 0.75; /* of the force where it is steepest */
static const double nothing = 2e-5;        /* of the force: a residual that does not matter */
static const double same = 1e-9;           /* of a column: it lies in those before it */

typedef struct blocks {
    size_t n_before, n; /* blocks of the baseline and of the window behind it */
    double r[BEFORE + WINDOW];
    double column[MAX_COLUMNS][MAX_ORDER + WINDOW]; /* of the window, and what it owes to */
    double wave[COSINES][MAX_ORDER + WINDOW];
    size_t n_columns;
    size_t length;           /* samples in one */
    double travel;           /* of the window [m] */
    size_t gap_from, gap_to; /* blocks of the window with samples that are not compared */
    size_t order;
    double a[MAX_ORDER + 1]; /* x_i = sum a_k x_(i-k) + innovation, k from 1 */
    double innovation;       /* its variance */
} blocks;

/* Sample j, of block i. */
static void add_columns(const curve_law *m, const double p[N], size_t j, size_t i, size_t length,
                        blocks *b)
{
    const curve_samples *s = m->samples;
    const double end = s->position[s->n - 1];
    double row[N];
    const double factor = curve_model_row(m, p, j, row), share = 1.0 / (factor * (double)length);
    size_t c = 0;
    for (size_t a = 0; a < N; a++)
        if (m->free[a])
            b->column[c++][i] += row[a] * share;
    const double part = (s->position[j] - p[CURVE_C]) / (end - p[CURVE_C]);
    if (m->lossy && part > 0.0) { /* the modulus falls with the time since contact */
        double fallen = row[CURVE_E] * share;
        for (size_t power = 0; power < LOSS; power++)
            b->column[c + power][i] += fallen *= log(part);
    }
    c += m->lossy ? (size_t)LOSS : 0;
    for (size_t k = 0; k < WAVE_PARAMETERS && m->wave && !curve_in_gap(s, j); k++)
        b->column[c + k][i] += m->workspace->wave_column[k][j] * share;
}

/* Block means of residual and Jacobian. False if there is too little baseline. */
WIDE_REGISTERS static bool average(const curve_law *m, const double p[N], const double *e,
                                   blocks *b)
{
    const curve_samples *s = m->samples;
    const double end = s->position[s->n - 1];
    size_t first = 0;
    while (first < s->n && s->position[first] < p[CURVE_C] - before_contact * (end - p[CURVE_C]))
        first++;
    b->n = s->n - first < WINDOW ? s->n - first : WINDOW;
    if (b->n <= (m->wave ? MAX_COLUMNS : OTHERS))
        return false;
    const size_t length = (s->n - first) / b->n;
    first = s->n - length * b->n;
    b->length = length;
    b->travel = (end - s->position[first]) * (double)(s->n - first) / (double)(s->n - first - 1);
    b->n_before = first / length < BEFORE ? first / length : BEFORE;
    if (b->n_before < LEAST)
        return false;
    const size_t left = s->gap_from > first ? s->gap_from - first : 0;
    const size_t right = s->gap_to > first ? s->gap_to - first : 0;
    b->gap_from = left / length;
    b->gap_to = right > left ? (right + length - 1) / length : b->gap_from;
    b->n_columns = 0;
    for (size_t a = 0; a < N; a++)
        b->n_columns += m->free[a];
    b->n_columns += (m->lossy ? (size_t)LOSS : 0) + (m->wave ? (size_t)WAVE_PARAMETERS : 0);
    const double share = 1.0 / (double)length;
    for (size_t i = 0; i < b->n_before + b->n; i++) {
        const size_t from = first + i * length - b->n_before * length;
        b->r[i] = curve_sum(e + from, length) * share;
    }
    memset(b->column, 0, b->n_columns * sizeof b->column[0]);
    for (size_t i = 0; i < MAX_ORDER + b->n; i++)
        for (size_t j = 0; j < length; j++)
            add_columns(m, p, first + i * length + j - MAX_ORDER * length, i, length, b);
    return true;
}

/* x less the part of it along the unit vector q. */
static double remove_along(const double *q, double *x, size_t n)
{
    const double along = curve_dot(q, x, n);
    for (size_t i = 0; i < n; i++)
        x[i] -= along * q[i];
    return along;
}

/* Makes columns orthonormal one by one and takes them out of r; returns the sum of squares that
 * those from `count` on take, and how many they are. Destroys columns and r. */
WIDE_REGISTERS static double project_out(double *r, double *const *columns, size_t n_columns,
                                         size_t count, size_t n, size_t *n_counted)
{
    double taken = 0.0;
    *n_counted = 0;
    for (size_t c = 0; c < n_columns; c++) {
        const double before = curve_dot(columns[c], columns[c], n);
        for (int twice = 0; twice < 2; twice++)
            for (size_t d = 0; d < c; d++)
                remove_along(columns[d], columns[c], n);
        const double norm = curve_dot(columns[c], columns[c], n);
        const bool new = norm > same *same *before;
        for (size_t i = 0; i < n; i++)
            columns[c][i] = new ? columns[c][i] / sqrt(norm) : 0.0;
        const double along = remove_along(columns[c], r, n);
        if (c >= count && new) {
            taken += along * along;
            ++*n_counted;
        }
    }
    return taken;
}

/* 1, x, x^2, x^3 over n samples. */
static void powers(size_t n, double column[4][BEFORE])
{
    for (size_t i = 0; i < n; i++) {
        const double x = 2.0 * (double)i / (double)(n - 1) - 1.0;
        column[0][i] = 1.0;
        for (int k = 1; k < 4; k++)
            column[k][i] = column[k - 1][i] * x;
    }
}

/* Autoregression of the baseline less a cubic (Burg), its order by the corrected criterion of
 * Akaike. */
WIDE_REGISTERS static void find_noise(blocks *b)
{
    const size_t n = b->n_before;
    double x[BEFORE], back[BEFORE], a[MAX_ORDER + 1] = {0.0}, power[4][BEFORE];
    double *const columns[4] = {power[0], power[1], power[2], power[3]};
    size_t ignored;
    memcpy(x, b->r, n * sizeof *x);
    powers(n, power);
    project_out(x, columns, 4, 4, n, &ignored);
    memcpy(back, x, n * sizeof *x);
    double variance = curve_dot(x, x, n) / (double)n, best = (double)INFINITY;
    b->innovation = 0.0;
    b->order = 0; /* of a baseline without noise, too */
    for (size_t order = 0; order <= MAX_ORDER && variance > 0.0; order++) {
        if (order > 0) {
            double above = 0.0, below = 0.0, old[MAX_ORDER + 1];
            for (size_t i = order; i < n; i++) {
                above += x[i] * back[i - 1];
                below += x[i] * x[i] + back[i - 1] * back[i - 1];
            }
            const double k = below > 0.0 ? 2.0 * above / below : 0.0;
            memcpy(old, a, sizeof old);
            a[order] = k;
            for (size_t j = 1; j < order; j++)
                a[j] = old[j] - k * old[order - j];
            for (size_t i = n - 1; i >= order; i--) {
                const double forward = x[i];
                x[i] = forward - k * back[i - 1];
                back[i] = back[i - 1] - k * forward;
            }
            variance *= 1.0 - k * k;
        }
        const double p = (double)order + 1.0, all = (double)n;
        const double criterion = all * log(variance) + 2.0 * p * all / (all - p - 1.0);
        if (criterion < best) {
            best = criterion;
            b->order = order;
            memcpy(b->a, a, sizeof a);
            b->innovation = variance * all / (all - p - 3.0);
        }
    }
}

/* Innovations of x[from..], n of them. */
static void whiten(const blocks *b, const double *x, size_t from, size_t n, double *out)
{
    for (size_t i = 0; i < n; i++) {
        out[i] = x[from + i];
        for (size_t k = 1; k <= b->order && k <= from + i; k++)
            out[i] -= b->a[k] * x[from + i - k];
    }
}

/* Cosines over the window, nothing before it. */
static void make_waves(blocks *b)
{
    memset(b->wave, 0, sizeof b->wave);
    for (size_t j = 0; j < COSINES; j++) {
        double *wave = b->wave[j] + MAX_ORDER;
        const double angle = M_PI * (double)(j + 1) / (double)b->n, twice = 2.0 * cos(angle);
        wave[0] = cos(0.5 * angle);
        wave[1] = cos(1.5 * angle);
        for (size_t i = 2; i < b->n; i++)
            wave[i] = twice * wave[i - 1] - wave[i - 2];
    }
}

/* Innovations that samples in the gap are part of do not count. */
static void leave_out_gap(const blocks *b, double *x)
{
    const size_t end = b->gap_to > b->gap_from ? b->gap_to + b->order : 0;
    for (size_t i = b->gap_from; i < end && i < b->n; i++)
        x[i] = 0.0;
}

WIDE_REGISTERS static double judge_contact(const blocks *b, double *statistic)
{
    double store[MAX_COLUMNS][WINDOW], r[WINDOW], *columns[MAX_COLUMNS];
    size_t n = 0, counted;
    whiten(b, b->r, b->n_before, b->n, r);
    for (; n < b->n_columns; n++)
        whiten(b, b->column[n], MAX_ORDER, b->n, store[n]);
    for (size_t j = 0; j < COSINES; j++, n++)
        whiten(b, b->wave[j], MAX_ORDER, b->n, store[n]);
    leave_out_gap(b, r);
    for (size_t c = 0; c < n; c++) {
        leave_out_gap(b, store[c]);
        columns[c] = store[c];
    }
    const double taken = project_out(r, columns, n, b->n_columns, b->n, &counted);
    *statistic = counted > 0 ? taken / (double)counted / b->innovation : 0.0;
    return gsl_cdf_fdist_Q(*statistic, (double)counted, (double)b->n_before / per_freedom);
}

static double judge_baseline(const blocks *b)
{
    double power[4][BEFORE], store[4][BEFORE], r[BEFORE];
    double *const columns[4] = {store[0], store[1], store[2], store[3]};
    const size_t skip = b->order, n = b->n_before - skip;
    size_t counted;
    powers(b->n_before, power);
    for (int c = 0; c < 4; c++)
        whiten(b, power[c], skip, n, store[c]);
    whiten(b, b->r, skip, n, r);
    const double taken = project_out(r, columns, 4, 2, n, &counted);
    if (counted == 0)
        return 1.0;
    return gsl_cdf_fdist_Q(taken / (double)counted / b->innovation, (double)counted,
                           (double)b->n_before / per_freedom);
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
            remove_along(power[d], power[k], n);
        const double norm = sqrt(curve_dot(power[k], power[k], n));
        for (size_t i = 0; i < n; i++)
            power[k][i] /= norm;
        bend = remove_along(power[k], x, n);
    }
    return bend / sqrt(b->innovation);
}

/* Against the height, for samples may be left out and a piezo may slow down. */
WIDE_REGISTERS static void judge_top(const curve_law *m, const double p[N], const blocks *b,
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
    whiten(b, force, MAX_ORDER, b->n, white);
    for (size_t k = 0; k < 3; k++)
        whiten(b, power[k], MAX_ORDER, b->n, column[k]);
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
    lack->flat_chance =
        flat ? 0.5 * TOPS * gsl_cdf_fdist_Q(most * most, 1.0, (double)b->n_before / per_freedom)
             : 1.0;
}

curve_lack curve_lack_of_fit(const curve_law *m, const double p[N], const double *e)
{
    blocks b;
    const double unknown = (double)NAN;
    curve_lack lack = {.statistic = unknown,
                       .chance = unknown,
                       .baseline_chance = unknown,
                       .flat_chance = unknown};
    for (int j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = unknown;
    if (!average(m, p, e, &b))
        return lack;
    find_noise(&b);
    const double top = nothing * p[CURVE_E] * m->workspace->g[m->samples->n - 1];
    b.innovation = fmax(b.innovation, top * top);
    if (!(b.innovation > 0.0) || !isfinite(b.innovation))
        return lack;
    lack.window = b.travel;
    lack.baseline_chance = judge_baseline(&b);
    judge_top(m, p, &b, &lack);
    make_waves(&b);
    lack.chance = judge_contact(&b, &lack.statistic);
    for (size_t j = 0; j < CURVE_WAVES; j++)
        lack.wave[j] = 2.0 / (double)b.n * curve_dot(b.r + b.n_before, b.wave[j] + MAX_ORDER, b.n);
    return lack;
}
