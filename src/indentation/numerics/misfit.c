/* Misfit as an error: effect of a discrepancy of the contact law on the parameters of its fit.
 *
 * data = law + discrepancy(depth) + noise (Kennedy and O'Hagan, J. R. Stat. Soc. B 63 (2001) 425).
 * The discrepancy is a smooth force of unknown shape in contact: a Gaussian process of the depth
 * with the covariance s^2 exp(-(x - x')^2 / (2 l^2)), x in units of the largest depth. Legendre
 * functions represent it. Size s and length l have restricted likelihoods, those of the data
 * without the part that the parameters explain. The likelihoods have Student's form, because the
 * variance of the noise is estimated. The prior gives no discrepancy its own probability, and
 * equal probabilities to all octaves of the size up to a share of the largest force. The changes
 * of the parameters are averaged over all cases. The parameters stay those of least squares, as in
 * other programs. Their errors include the mean changes and their scatter: the shape of a large
 * misfit is not known well enough for a correction, and a linear model cannot predict its size.
 *
 * A tip radius without a stated error may be wrong, which is the most common misfit. Its effect is
 * one more kind of discrepancy of known shape, with the same prior probability. It is excluded if
 * it is nearly equivalent to another modulus.
 *
 * Tips within the stated errors (tip_variation of the workspace), and a detected pull that no law
 * includes, are further columns with a standard deviation of 1. A misfit that they explain is not
 * one of the law.
 *
 * The part of a discrepancy that the derivatives explain leaves no residual: a bow of the piezo,
 * or a modulus that depends on depth. No residual shows it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/misfit_bias.h"
#include "indentation/numerics/residual_blocks.h"

#include "core/math/cholesky.h"
#include "core/math/students_t.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    LEGENDRE = MISFIT_SMOOTH, /* represent lengths from 0.175 on to 1 % of the variance */
    FUNCTIONS = MISFIT_FUNCTIONS,
    M = MISFIT_COLUMNS,
    LENGTHS = 3,         /* nodes of a three-point rule for a normal prior */
    KINDS = LENGTHS + 1, /* kinds of discrepancy: these lengths, and another radius of the tip */
    SIZES = 16,          /* largest number */
    CANDIDATES = 1 + KINDS * SIZES,
    NODES = 64, /* nodes of the depth for the covariance of the Legendre functions */
};
/* ln l is normal with mean ln 0.5 and standard deviation 0.7. The nodes lie at -1, 0 and 1 standard
 * deviations. */
static const double length_median = 0.5, length_sd = 0.7;
/* Largest discrepancy over the largest force; beyond it the law is meaningless. Only the prior
 * limits a discrepancy that the parameters explain. */
static const double max_size = 0.3;
/* Largest discrepancy over the rms of the residual. The worst known case is the size of a tip: a
 * radius error of 1 to 15 % of a pyramid of 20 degrees changes the force by 60 times its residual.
 * A pull changes it by 3 times. */
static const double max_hidden_ratio = 60.0;
/* Largest change of the logarithm of a radius; makers state radii within a factor of two. */
static const double max_log_radius = 0.7;
static const double radius_probability =
    0.5; /* prior probability of a wrong radius among the discrepancies */
static const double size_ratio = 2.5; /* ratio of trial sizes; the likelihoods are wider */
static const double negligible_size =
    0.01; /* threshold of a likelihood below which the size is zero */
static const double outside_probability = 0.05; /* probability outside a 95 % interval */
static const double negligible_chance =
    1e-4; /* probability below which a case is not in the interval */
static const double error_step =
    0.01; /* relative tolerance of an error, which is reported with two digits */

/* Prior probability that the law is correct. At 0.5 the intervals of correct laws are 1.2 to 1.5
 * times too wide; at 0.9 small misfits are missed. It hardly affects visible misfits. */
static const double law_probability = 0.8;
static const double visible_force =
    3.0; /* in noise of a block; noise exceeds it in one of 700 cases */

/* Square roots of the covariances of the coefficients for s = 1 (lower triangles), and prior
 * probabilities. */
static struct {
    double root[LENGTHS][LEGENDRE][LEGENDRE], chance[LENGTHS];
} kernels;
static pthread_once_t kernels_once = PTHREAD_ONCE_INIT;

/* Computes the Legendre functions that are orthonormal on [0, 1]. */
static void legendre_values(double x, double to[LEGENDRE])
{
    const double y = 2.0 * x - 1.0;
    double before = 0.0, now = 1.0;
    for (int k = 0; k < LEGENDRE; k++) {
        to[k] = now * sqrt(2.0 * k + 1.0);
        const double next = ((2.0 * k + 1.0) * y * now - k * before) / (k + 1.0);
        before = now;
        now = next;
    }
}

static void tabulate_kernels(void)
{
    double at[NODES][LEGENDRE], at_distance[NODES], all = 0.0;
    for (int i = 0; i < NODES; i++)
        legendre_values((i + 0.5) / NODES, at[i]);
    for (int l = 0; l < LENGTHS; l++) {
        const double node = l - 0.5 * (LENGTHS - 1), length = length_median * exp(length_sd * node);
        double a[M][M] = {{0.0}};
        for (int i = 0; i < NODES; i++) {
            const double apart = (double)i / NODES / length;
            at_distance[i] = exp(-0.5 * apart * apart) / (NODES * NODES);
        }
        for (int i = 0; i < NODES; i++) {
            double along[LEGENDRE] = {0.0};
            for (int j = 0; j < NODES; j++)
                for (int c = 0; c < LEGENDRE; c++)
                    along[c] += at_distance[abs(i - j)] * at[j][c];
            for (int c = 0; c < LEGENDRE; c++)
                for (int d = 0; d <= c; d++)
                    a[c][d] += at[i][c] * along[d];
        }
        for (int c = 0; c < LEGENDRE; c++) /* rounding, relative to a variance of 1 */
            a[c][c] += 1e-12;
        (void)cholesky_factor(&a[0][0], M, LEGENDRE, 0.0);
        for (int c = 0; c < LEGENDRE; c++)
            for (int d = 0; d < LEGENDRE; d++)
                kernels.root[l][c][d] = d <= c ? a[c][d] : 0.0;
        kernels.chance[l] = exp(-0.5 * node * node);
        all += kernels.chance[l];
    }
    for (int l = 0; l < LENGTHS; l++)
        kernels.chance[l] /= all;
}

/* ---- sums of the data ------------------------------------------------------------------------ */

typedef struct whitened_columns {
    double a[N][BLOCKS_WINDOW], b[M][BLOCKS_WINDOW], y[BLOCKS_WINDOW];
} whitened_columns;

/* Adds the blocks of the baseline to aa and ay. */
static void add_baseline_sums(const curve_law *m, const double p[N], const double *e,
                              const residual_blocks *b, double aa[M][M], double ay[N])
{
    const curve_samples *s = m->samples;
    const size_t n = b->first / b->length, start = b->first - n * b->length;
    double *z = m->workspace->tip, *r = m->workspace->weight;
    const double share = 1.0 / (double)b->length;
    for (size_t i = 0; i < n; i++) {
        const size_t from = start + i * b->length;
        z[i] = curve_sum(s->position + from, b->length) * share - p[CURVE_C];
        r[i] = curve_sum(e + from, b->length) * share;
    }
    double sums[3][3] = {{0.0}}, with[3] = {0.0}; /* of 1 and z */
    for (size_t i = b->order; i < n; i++) {
        double one = 1.0, line = z[i], rest = r[i];
        for (size_t k = 1; k <= b->order; k++) {
            one -= b->a[k];
            line -= b->a[k] * z[i - k];
            rest -= b->a[k] * r[i - k];
        }
        sums[0][0] += one * one;
        sums[0][1] += one * line;
        sums[1][1] += line * line;
        with[0] += one * rest;
        with[1] += line * rest;
    }
    /* The rows are (0, -t, 1, z, 0). */
    const double of_one[N] = {[CURVE_C] = -p[CURVE_T], [CURVE_F0] = 1.0},
                 of_line[N] = {[CURVE_T] = 1.0};
    size_t c = 0;
    for (size_t i = 0; i < N; i++) {
        size_t d = 0;
        if (!m->free[i])
            continue;
        for (size_t j = 0; j < N; j++) {
            if (!m->free[j])
                continue;
            aa[c][d++] += of_one[i] * of_one[j] * sums[0][0] +
                          of_line[i] * of_line[j] * sums[1][1] +
                          (of_one[i] * of_line[j] + of_line[i] * of_one[j]) * sums[0][1];
        }
        ay[c++] += of_one[i] * with[0] + of_line[i] * with[1];
    }
}

/* Returns a pull before contact that the law of the fit does not include. The residual decides
 * whether it acts in contact. A pull-off is no measure of it, because it is much stronger than the
 * snap-in on rubber. */
static double unmodelled_pull(const curve_fitting *f)
{
    return f->kind.adhesive ? 0.0 : f->snap_in_pull;
}

/* Relative change of a force due to a shift of the tip by its deviation: slope and curvature. */
typedef struct tip_change {
    double slope, bend;
} tip_change;

static tip_change tip_force_change(const curve_law *m, const tip_variation *move, double depth)
{
    double now = 0.0, up = 0.0, down = 0.0;
    if (move->up == NULL || !(depth > 0.0))
        return (tip_change){0.0, 0.0};
    wt_contact_table_eval(m->table, &depth, 1, &now, NULL);
    wt_contact_table_eval(move->up, &depth, 1, &up, NULL);
    wt_contact_table_eval(move->down, &depth, 1, &down, NULL);
    if (!(now > 0.0))
        return (tip_change){0.0, 0.0};
    const double x = move->deviation;
    return (tip_change){0.5 * x * (up - down) / now, x * x * (up - now - (now - down)) / now};
}

/* Fills the columns of each block of the history and window: Legendre functions in units of the
 * largest force, effects of a shifted tip, and a pull. */
static void fill_misfit_columns(const curve_fitting *f, const curve_law *m, const double p[N],
                                const residual_blocks *b, double force, whitened_columns *to,
                                misfit_sums *d)
{
    double raw[M][BLOCKS_HISTORY];
    const double pull = unmodelled_pull(f);
    const tip_variation *const tips = f->workspace->tip_variation;
    size_t n_tips = 0;
    while (n_tips < CURVE_TIP_VARIATIONS && tips[n_tips].up != NULL)
        n_tips++;
    const size_t n_variations = n_tips + (pull > 0.0), bends = FUNCTIONS + n_variations;
    d->n_tips = n_tips;
    d->n_variations = n_variations;
    d->unstated_radius = f->workspace->unstated_radius.up != NULL;
    const double deepest = f->solution.max_indentation;
    for (size_t i = 0; i < BLOCKS_MAX_ORDER + b->n; i++) {
        double at[LEGENDRE] = {0.0};
        if (b->touch[i] > 0.0)
            legendre_values(b->depth[i], at);
        for (size_t k = 0; k < LEGENDRE; k++)
            raw[k][i] = at[k] * b->touch[i] * force;
        /* Shares of the force as block means, as the law has them. */
        const double contact = b->touch[i] > 0.0 ? p[CURVE_E] * b->column[CURVE_E][i] : 0.0;
        const tip_change radius =
            tip_force_change(m, &f->workspace->unstated_radius, b->depth[i] * deepest);
        raw[MISFIT_RADIUS][i] = contact * radius.slope;
        for (size_t k = 0; k < n_tips; k++) {
            const tip_change moved = tip_force_change(m, &tips[k], b->depth[i] * deepest);
            raw[FUNCTIONS + k][i] = contact * moved.slope;
            raw[bends + k][i] = contact * moved.bend;
        }
        if (pull > 0.0)
            raw[FUNCTIONS + n_tips][i] = -pull * b->touch[i];
    }
    for (size_t k = 0; k < bends + n_tips; k++)
        residual_blocks_whiten(b, raw[k], BLOCKS_MAX_ORDER, b->n, to->b[k]);
    for (size_t c = 0, k = 0; c < N; c++)
        if (m->free[c]) {
            residual_blocks_whiten(b, b->column[k], BLOCKS_MAX_ORDER, b->n, to->a[k]);
            k++;
        }
    residual_blocks_whiten(b, b->r, b->n_before, b->n, to->y);
}

/* Standard deviation of the mean of a block. */
static double block_noise(const residual_blocks *b)
{
    const double of_baseline =
        b->n_before > 0 ? curve_dot(b->r, b->r, b->n_before) / (double)b->n_before : 0.0;
    return sqrt(fmax(of_baseline, b->innovation));
}

/* Prior range of the contact point. Force is visible from the depth at which that of the law, or
 * the measured one, exceeds the noise of a block. The linear model cannot determine this range. */
static double contact_point_range(const curve_law *m, const double p[N], const residual_blocks *b)
{
    const curve_samples *s = m->samples;
    const double length = (double)b->length, noise = visible_force * block_noise(b);
    const size_t n = b->first / b->length + b->n, start = s->n - n * b->length;
    double by_law = 0.0, visible = s->position[s->n - 1] - p[CURVE_C];
    for (size_t i = s->n; i-- > b->first;)
        if (p[CURVE_E] * m->workspace->g[i] > noise)
            by_law = m->workspace->delta[i];
    for (size_t i = n; i-- > 0;) {
        const size_t from = start + i * b->length;
        const double z = curve_sum(s->position + from, b->length) / length - p[CURVE_C],
                     force = curve_sum(s->force + from, b->length) / length - p[CURVE_F0] -
                             p[CURVE_T] * z;
        if (fabs(force) < noise)
            break;
        visible = z;
    }
    return fmax(by_law, fabs(visible - by_law));
}

/* Transforms back from the triangular form and units of the noise. The function destroys `solved`.
 */
static void solve_parameter_changes(double (*aa)[M], const double *scale, double (*solved)[N],
                                    size_t n_columns, misfit_sums *to)
{
    const size_t q = to->n_free;
    for (size_t k = 0; k < n_columns; k++) {
        double *x = solved[k];
        for (size_t c = q; c-- > 0;) {
            for (size_t d = c + 1; d < q; d++)
                x[c] -= aa[d][c] * x[d];
            x[c] /= aa[c][c];
        }
        for (size_t c = 0; c < q; c++)
            to->parameter_change[c][k] = scale[c] * x[c];
    }
}

static bool sum_misfit_columns(const curve_fitting *f, const curve_law *m, const double p[N],
                               const double *e, const residual_blocks *b, double force,
                               misfit_sums *to)
{
    whitened_columns of;
    double aa[M][M] = {{0.0}}, ay[N] = {0.0}, scale[N], solved[M][N];
    *to = (misfit_sums){0};
    fill_misfit_columns(f, m, p, b, force, &of, to);
    const size_t n = b->n, columns_b = FUNCTIONS + to->n_variations + to->n_tips;
    for (size_t i = 0; i < N; i++)
        if (m->free[i])
            to->which[to->n_free++] = i;
    const size_t q = to->n_free;
    residual_blocks_zero_gap(b, of.y);
    for (size_t c = 0; c < q; c++)
        residual_blocks_zero_gap(b, of.a[c]);
    for (size_t c = 0; c < columns_b; c++)
        residual_blocks_zero_gap(b, of.b[c]);
    add_baseline_sums(m, p, e, b, aa, ay);
    for (size_t c = 0; c < q; c++) {
        for (size_t d = 0; d < q; d++)
            aa[c][d] += curve_dot(of.a[c], of.a[d], n);
        ay[c] += curve_dot(of.a[c], of.y, n);
        if (!(aa[c][c] > 0.0))
            return false;
    }
    const double reach = contact_point_range(m, p, b);
    for (size_t c = 0; c < q; c++) {
        if (to->which[c] == CURVE_C)
            aa[c][c] += b->innovation / (reach * reach);
        scale[c] = 1.0 / sqrt(aa[c][c]);
    }
    for (size_t c = 0; c < q; c++)
        for (size_t d = 0; d < q; d++)
            aa[c][d] *= scale[c] * scale[d];
    if (!cholesky_factor(&aa[0][0], M, q, 0.0))
        return false;
    /* All numbers are in units of the noise, and A is in triangular form. */
    double along_y[N];
    for (size_t c = 0; c < q; c++)
        ay[c] *= scale[c];
    cholesky_forward(&aa[0][0], M, q, ay, along_y);
    for (size_t k = 0; k < columns_b; k++) {
        double with[N];
        for (size_t c = 0; c < q; c++)
            with[c] = scale[c] * curve_dot(of.a[c], of.b[k], n);
        cholesky_forward(&aa[0][0], M, q, with, solved[k]);
    }
    for (size_t k = 0; k < columns_b; k++) {
        for (size_t l = 0; l <= k; l++)
            to->mm[k][l] = to->mm[l][k] =
                (curve_dot(of.b[k], of.b[l], n) - misfit_dot(solved[k], solved[l], q)) /
                b->innovation;
        if (k == MISFIT_RADIUS)
            to->unstated_radius = to->unstated_radius && max_hidden_ratio * max_hidden_ratio *
                                                                 to->mm[k][k] * b->innovation >
                                                             curve_dot(of.b[k], of.b[k], n);
        to->my[k] =
            (curve_dot(of.b[k], of.y, n) - misfit_dot(solved[k], along_y, q)) / b->innovation;
    }
    solve_parameter_changes(aa, scale, solved, columns_b, to);
    return true;
}

/* ---- sizes and lengths ----------------------------------------------------------------------- */

/* Sums for a discrepancy of size 1 and one length, in independent unit normal coefficients. A
 * rotation makes their matrix tridiagonal, so that each size needs little time. */
typedef struct length_sums {
    double with[LEGENDRE], next[LEGENDRE]; /* diagonal, and off-diagonal elements */
    double residual[LEGENDRE], parameter_change[N][LEGENDRE];
} length_sums;

static void rotate_vector(double (*q)[LEGENDRE], const double x[LEGENDRE], double to[LEGENDRE])
{
    for (size_t i = 0; i < LEGENDRE; i++)
        to[i] = 0.0;
    for (size_t k = 0; k < LEGENDRE; k++)
        for (size_t i = 0; i < LEGENDRE; i++)
            to[i] += q[k][i] * x[k];
}

/* Makes the matrix `with` = root' mm root tridiagonal. */
static void tridiagonalise(double (*root)[LEGENDRE], double (*with)[LEGENDRE], const misfit_sums *d,
                           length_sums *to)
{
    double tau[LEGENDRE - 1], q[LEGENDRE][LEGENDRE], turned[LEGENDRE][LEGENDRE];
    gsl_matrix_view a = gsl_matrix_view_array(&with[0][0], LEGENDRE, LEGENDRE),
                    of_q = gsl_matrix_view_array(&q[0][0], LEGENDRE, LEGENDRE);
    gsl_vector_view scales = gsl_vector_view_array(tau, LEGENDRE - 1),
                    diagonal = gsl_vector_view_array(to->with, LEGENDRE),
                    beside = gsl_vector_view_array(to->next, LEGENDRE - 1);
    (void)gsl_linalg_symmtd_decomp(&a.matrix, &scales.vector); /* the only errors are wrong sizes */
    (void)gsl_linalg_symmtd_unpack(&a.matrix, &scales.vector, &of_q.matrix, &diagonal.vector,
                                   &beside.vector);
    to->next[LEGENDRE - 1] = 0.0;
    for (size_t k = 0; k < LEGENDRE; k++) /* root times q */
        rotate_vector(q, root[k], turned[k]);
    rotate_vector(turned, d->my, to->residual);
    for (size_t c = 0; c < d->n_free; c++)
        rotate_vector(turned, d->parameter_change[c], to->parameter_change[c]);
}

static length_sums length_scale_sums(const misfit_sums *d, int length)
{
    double root[LEGENDRE][LEGENDRE], half[LEGENDRE][LEGENDRE], with[LEGENDRE][LEGENDRE] = {{0.0}};
    length_sums to;
    for (size_t i = 0; i < LEGENDRE; i++) /* transposed */
        for (size_t k = 0; k < LEGENDRE; k++)
            root[i][k] = kernels.root[length][k][i];
    for (size_t i = 0; i < LEGENDRE; i++)
        for (size_t k = 0; k < LEGENDRE; k++)
            half[i][k] = misfit_dot(root[i] + i, d->mm[k] + i, LEGENDRE - i);
    for (size_t i = 0; i < LEGENDRE; i++)
        for (size_t j = 0; j <= i; j++)
            with[i][j] = misfit_dot(half[i] + j, root[j] + j, LEGENDRE - j);
    tridiagonalise(kernels.root[length], with, d, &to);
    return to;
}

/* Sums for another radius, which has one function. */
static length_sums radius_sums(const misfit_sums *d)
{
    length_sums to = {.with = {d->mm[MISFIT_RADIUS][MISFIT_RADIUS]},
                      .residual = {d->my[MISFIT_RADIUS]}};
    for (size_t c = 0; c < d->n_free; c++)
        to.parameter_change[c][0] = d->parameter_change[c][MISFIT_RADIUS];
    return to;
}

/* Evaluates a discrepancy of size s. Returns the part of the squared residual that it explains. */
static double evaluate_size(const misfit_sums *d, const length_sums *l, double s,
                            const misfit_candidate *none, misfit_candidate *c)
{
    const double square = s * s;
    double factor[LEGENDRE], share[LEGENDRE] = {0.0}, x[LEGENDRE], explained = 0.0, product = 1.0;
    *c = (misfit_candidate){.log_likelihood = -(double)INFINITY};
    for (size_t i = 0; i < LEGENDRE; i++) {
        factor[i] = 1.0 + square * l->with[i];
        x[i] = l->residual[i];
        if (i > 0) {
            share[i] = square * l->next[i - 1] / factor[i - 1];
            factor[i] -= share[i] * square * l->next[i - 1];
            x[i] -= share[i] * x[i - 1];
        }
        if (!(factor[i] > 0.0))
            return 0.0;
        product *=
            factor[i]; /* each factor is below 1e12 because of the smallest noise of the blocks */
    }
    c->log_likelihood = -0.5 * log(product);
    for (size_t i = 0; i < LEGENDRE; i++) {
        factor[i] = square / factor[i];
        explained += factor[i] * x[i] * x[i];
    }
    for (size_t a = 0; a < d->n_free; a++) {
        double y = 0.0;
        c->shift[a] = none->shift[a];
        c->variance[a] = none->variance[a];
        for (size_t i = 0; i < LEGENDRE; i++) {
            y = l->parameter_change[a][i] - share[i] * y;
            c->shift[a] -= factor[i] * y * x[i];
            c->variance[a] += factor[i] * y * y;
        }
    }
    return explained;
}

/* Log likelihood of the unexplained residual for an estimated variance of the noise. */
static double student_log_likelihood(double unexplained, double freedom)
{
    return -0.5 * (freedom + LEGENDRE) * log(1.0 + fmax(unexplained, 0.0) / freedom);
}

typedef struct candidate_mixture {
    size_t n;
    misfit_candidate part[CANDIDATES]; /* the first candidate is no discrepancy */
    double tip[N]; /* part of the variances due to the stated errors of the tip */
} candidate_mixture;

static bool weigh_candidates(misfit_sums *d, double largest, double freedom, candidate_mixture *to)
{
    misfit_candidate *const none = &to->part[0];
    double explained[CANDIDATES] = {0.0}, most = 0.0, best, sum = 0.0;
    length_sums of[KINDS];
    if (!misfit_remove_bias(d, none, to->tip))
        return false;
    const size_t kinds = LENGTHS + d->unstated_radius;
    for (int l = 0; l < LENGTHS; l++)
        of[l] = length_scale_sums(d, l);
    if (d->unstated_radius)
        of[LENGTHS] = radius_sums(d);
    to->n = 1;
    bool matters = true;
    for (double s = 1.0; to->n + kinds <= 1 + kinds * SIZES && matters; s /= size_ratio) {
        matters = false;
        for (size_t l = 0; l < kinds; l++, to->n++) {
            misfit_candidate *c = &to->part[to->n];
            explained[to->n] =
                evaluate_size(d, &of[l], s * (l < LENGTHS ? largest : max_log_radius), none, c);
            most = fmax(most, explained[to->n]); /* value of the largest size */
            matters = matters || c->log_likelihood < -negligible_size ||
                      explained[to->n] > negligible_size;
            c->chance = l == LENGTHS ? radius_probability
                                     : (d->unstated_radius ? 1.0 - radius_probability : 1.0) *
                                           kernels.chance[l];
        }
    }
    best = none->log_likelihood = log(law_probability) + student_log_likelihood(most, freedom);
    for (size_t i = 1; i < to->n; i++) {
        misfit_candidate *c = &to->part[i];
        c->log_likelihood +=
            student_log_likelihood(most - explained[i], freedom) +
            log((1.0 - law_probability) * c->chance * (double)kinds / (double)(to->n - 1));
        best = fmax(best, c->log_likelihood);
    }
    for (size_t i = 0; i < to->n; i++)
        sum += to->part[i].chance = exp(to->part[i].log_likelihood - best);
    for (size_t i = 0; i < to->n; i++)
        to->part[i].chance /= sum;
    return true;
}

/* Half of the interval about 0 that holds 95 % of parameter a, in units of 1.96. `less` is excluded
 * from the variances. A shift counts as a deviation, because the direction of a correction is more
 * certain than its size. It is limited to least_shift, because a linear model permits a negative
 * modulus. */
static double mixture_error(const candidate_mixture *m, size_t a, double less,
                            double standard_error, double least_shift)
{
    double low = standard_error, high = standard_error, sd[CANDIDATES];
    for (size_t i = 0; i < m->n; i++) {
        const misfit_candidate *c = &m->part[i];
        const double shift = fmax(c->shift[a], least_shift);
        sd[i] = sqrt(fmax(0.0, c->variance[a] - less) + shift * shift +
                     standard_error * standard_error);
        if (c->chance > negligible_chance)
            high = fmax(high, sd[i]);
    }
    while (high - low > error_step * high) {
        const double error = 0.5 * (low + high);
        double beyond = 0.0;
        for (size_t i = 0; i < m->n; i++)
            if (m->part[i].chance > negligible_chance)
                beyond += m->part[i].chance * erfc(NORMAL_95 * error / (M_SQRT2 * sd[i]));
        *(beyond > outside_probability ? &low : &high) = error;
    }
    return high;
}

/* ---- error ----------------------------------------------------------------------------------- */

/* Evaluates the residuals of the noise at p and stores them in the scratch array. */
static void evaluate_residuals(curve_law *m, const double p[N], const curve_wave *wave)
{
    wt_indent_workspace *w = m->workspace;
    curve_law_evaluate(m, p, wave);
    for (size_t i = 0; i < m->samples->n; i++)
        w->scratch[i] = i < m->n_baseline
                            ? w->residual[i]
                            : w->residual[i] * (m->plain ? 1.0 / curve_model_factor(m, p, i) : 1.0);
}

void curve_add_misfit(curve_fitting *f)
{
    curve_solution *s = &f->solution;
    curve_law m = curve_law_create(f->table, &f->input.samples, &f->kind, f->workspace);
    residual_blocks b;
    misfit_sums d;
    candidate_mixture found;
    double *const e = f->workspace->scratch;
    for (size_t i = 0; i < N; i++) /* until it is known */
        s->misfit_error[i] = m.free[i] ? (double)NAN : 0.0;
    if (f->kind.plain || !(f->options->misfit_p_threshold > 0.0) || !s->converged)
        return;
    (void)pthread_once(&kernels_once, tabulate_kernels);
    evaluate_residuals(&m, s->p, &s->wave);
    const double force = s->p[CURVE_E] * f->workspace->g[f->input.samples.n - 1];
    if (!(force > 0.0) || !residual_blocks_average(&m, s->p, e, &b) ||
        !residual_blocks_find_noise(&m, s->p, &b) ||
        !sum_misfit_columns(f, &m, s->p, e, &b, force, &d))
        return;
    const double *residual = b.r + b.n_before;
    const double seen = sqrt(curve_dot(residual, residual, b.n) / (double)b.n) / force;
    if (!weigh_candidates(&d, fmin(max_size, max_hidden_ratio * seen), b.freedom, &found))
        return;
    for (size_t a = 0; a < d.n_free; a++) {
        const size_t i = d.which[a];
        const double noise = s->standard_error[i],
                     least = i == CURVE_E ? -s->p[CURVE_E] : -(double)INFINITY,
                     by_law = mixture_error(&found, a, found.tip[a], noise, least),
                     error = mixture_error(&found, a, 0.0, noise, least);
        s->misfit_error[i] = sqrt(by_law * by_law - noise * noise);
        s->standard_error[i] = error;
    }
}
