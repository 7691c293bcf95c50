/* A misfit as an error: what a discrepancy of the contact law does to the parameters of its fit.
 *
 * data = law + discrepancy(depth) + noise (Kennedy and O'Hagan, J. R. Stat. Soc. B 63 (2001) 425):
 * the force of the contact has a smooth part of unknown shape, a Gaussian process of the depth with
 * the covariance s^2 exp(-(x - x')^2 / (2 l^2)), x in units of the largest depth, and nothing off
 * contact. It is carried by Legendre functions. Size and length have likelihoods (restricted: those
 * of the data without what the parameters can imitate; of Student's kind, for the variance of the
 * noise is estimated, too); beforehand no discrepancy at all has a chance of its own, and of sizes
 * up to the largest force each octave has the same. What the parameters would be is averaged over
 * all of these. They stay those of least squares, which other programs have, too; that they would
 * be others is in their errors, as is how they scatter: where the misfit is large its shape is not
 * known well enough to correct for it, and a linear model not good enough to say by how much.
 *
 * Tips that are as likely as the stated one (tip_moved of the workspace) are further columns, of a
 * standard deviation of 1: a misfit that they explain is not one of the law.
 *
 * What a discrepancy shares with the derivatives leaves no residual: a bow of the piezo, a modulus
 * that changes with depth. No residual tells them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/indentation/curve_fitting.h"
#include "fit/indentation/residual_blocks.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    LEGENDRE = 10, /* carry lengths from 0.175 on to 1 % of the variance */
    MOVES = CURVE_TIP_MOVES,
    M = LEGENDRE + MOVES,
    LENGTHS = 3,
    SIZES = 16, /* most */
    NODES = 64, /* of the depth, for the covariance of the Legendre functions */
};
/* ln l is normal about ln 0.5 with a standard deviation of 0.7: nodes at -1, 0 and 1 of them. */
static const double length_median = 0.5, length_sd = 0.7;
/* Of a discrepancy, of the largest force: beyond it there is no law left to speak of. One that the
 * parameters imitate has no likelihood of its own, and the prior is all that limits it. */
static const double largest_size = 0.3;
static const double size_ratio = 2.5; /* of two sizes that are tried: likelihoods are wider */
static const double no_size = 0.01;   /* of a likelihood: the size is none */

/* Of laws, that they hold: with even odds intervals of curves that they describe are 1.2 to 1.5
 * times as wide as needed, with nine of ten small misfits are missed; what is to be seen does not
 * feel it.
 */
static const double holds = 0.8;
static const double to_be_seen = 3.0; /* of a force, in noise of a block: one of 700 by chance */

/* Square roots of the covariances of the coefficients, lower triangles, for s = 1. */
static struct {
    double root[LENGTHS][LEGENDRE][LEGENDRE], chance[LENGTHS];
} kernels;
static pthread_once_t kernels_once = PTHREAD_ONCE_INIT;

/* Orthonormal on [0, 1]. */
static void legendre(double x, double to[LEGENDRE])
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

/* In place, the lower triangle of n of M; false if it is not positive. */
static bool decompose(double a[M][M], size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = a[i][j];
            for (size_t k = 0; k < j; k++)
                sum -= a[i][k] * a[j][k];
            if (i > j)
                a[i][j] = sum / a[j][j];
            else if (sum > 0.0)
                a[i][i] = sqrt(sum);
            else
                return false;
        }
    return true;
}

/* x = L^-1 b. */
static void forward(const double (*l)[M], size_t n, const double *b, double *x)
{
    for (size_t i = 0; i < n; i++) {
        double sum = b[i];
        for (size_t k = 0; k < i; k++)
            sum -= l[i][k] * x[k];
        x[i] = sum / l[i][i];
    }
}

static double dot(const double *a, const double *b, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void make_kernels(void)
{
    double at[NODES][LEGENDRE], all = 0.0;
    for (int i = 0; i < NODES; i++)
        legendre((i + 0.5) / NODES, at[i]);
    for (int l = 0; l < LENGTHS; l++) {
        const double node = l - 0.5 * (LENGTHS - 1), length = length_median * exp(length_sd * node);
        double a[M][M] = {{0.0}};
        for (int i = 0; i < NODES; i++)
            for (int j = 0; j < NODES; j++) {
                const double apart = (double)(i - j) / NODES / length;
                const double k = exp(-0.5 * apart * apart) / (NODES * NODES);
                for (int c = 0; c < LEGENDRE; c++)
                    for (int d = 0; d <= c; d++)
                        a[c][d] += k * at[i][c] * at[j][d];
            }
        for (int c = 0; c < LEGENDRE; c++) /* of a variance of 1: rounding */
            a[c][c] += 1e-12;
        (void)decompose(a, LEGENDRE);
        for (int c = 0; c < LEGENDRE; c++)
            for (int d = 0; d < LEGENDRE; d++)
                kernels.root[l][c][d] = d <= c ? a[c][d] : 0.0;
        kernels.chance[l] = exp(-0.5 * node * node);
        all += kernels.chance[l];
    }
    for (int l = 0; l < LENGTHS; l++)
        kernels.chance[l] /= all;
}

/* ---- what the data say ----------------------------------------------------------------------- */

/* Whitened and in units of the noise: the discrepancy's columns without what the parameters can
 * imitate. */
typedef struct data_sums {
    size_t n_free, n_moves, which[N]; /* the free parameters */
    double imitated[N][M];            /* of the parameters, by a coefficient of 1 */
    double mm[M][M], my[M];           /* sums of the columns with each other and the residual */
} data_sums;

typedef struct columns {
    double a[N][BLOCKS_WINDOW], b[M][BLOCKS_WINDOW], y[BLOCKS_WINDOW];
} columns;

/* aa, ay: of the blocks of the baseline, all of them. */
static void add_baseline(const curve_law *m, const double p[N], const double *e,
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
    double sums[3][3] = {{0.0}}, with[3] = {0.0}; /* of 1, z */
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
    /* the rows are (0, -t, 1, z, 0) */
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

/* Of one block of the history or window: Legendre functions, in units of the largest force, and
 * what a moved tip changes. */
static void fill_columns(const curve_fitting *f, const curve_law *m, const double p[N],
                         const residual_blocks *b, double force, size_t n_moves, columns *to)
{
    double raw[M][BLOCKS_HISTORY];
    const double deepest = f->solution.max_indentation;
    for (size_t i = 0; i < BLOCKS_MAX_ORDER + b->n; i++) {
        double at[LEGENDRE] = {0.0};
        if (b->touch[i] > 0.0)
            legendre(b->depth[i], at);
        for (size_t k = 0; k < LEGENDRE; k++)
            raw[k][i] = at[k] * b->touch[i] * force;
        for (size_t k = 0; k < n_moves; k++) {
            double depth = b->depth[i] * deepest, now = 0.0, moved = 0.0;
            if (b->touch[i] > 0.0) {
                wt_contact_table_eval(m->table, &depth, 1, &now, NULL);
                wt_contact_table_eval(f->workspace->tip_moved[k], &depth, 1, &moved, NULL);
            }
            raw[LEGENDRE + k][i] = p[CURVE_E] * (moved - now) * b->touch[i];
        }
    }
    for (size_t k = 0; k < LEGENDRE + n_moves; k++)
        residual_blocks_whiten(b, raw[k], BLOCKS_MAX_ORDER, b->n, to->b[k]);
    for (size_t c = 0, k = 0; c < N; c++)
        if (m->free[c]) {
            residual_blocks_whiten(b, b->column[k], BLOCKS_MAX_ORDER, b->n, to->a[k]);
            k++;
        }
    residual_blocks_whiten(b, b->r, b->n_before, b->n, to->y);
}

/* Standard deviation of the mean of a block. */
static double noise_of_block(const residual_blocks *b)
{
    const double of_baseline =
        b->n_before > 0 ? curve_dot(b->r, b->r, b->n_before) / (double)b->n_before : 0.0;
    return sqrt(fmax(of_baseline, b->innovation));
}

/* How far from the fitted contact point the tip may touch, whatever the law: force is to be seen
 * from the depth on at which that of the law stands out of the noise of a block, or from where the
 * measured one does. Linear in the contact point, the fit would not know. */
static double contact_reach(const curve_law *m, const double p[N], const residual_blocks *b)
{
    const curve_samples *s = m->samples;
    const double length = (double)b->length, noise = to_be_seen * noise_of_block(b);
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

static bool sum_up(const curve_fitting *f, const curve_law *m, const double p[N], const double *e,
                   const residual_blocks *b, double force, data_sums *to)
{
    columns of;
    double aa[M][M] = {{0.0}}, ay[N] = {0.0}, scale[N], solved[M][N];
    *to = (data_sums){0};
    while (to->n_moves < MOVES && f->workspace->tip_moved[to->n_moves] != NULL)
        to->n_moves++;
    const size_t n = b->n, columns_b = LEGENDRE + to->n_moves;
    fill_columns(f, m, p, b, force, to->n_moves, &of);
    for (size_t i = 0; i < N; i++)
        if (m->free[i])
            to->which[to->n_free++] = i;
    const size_t q = to->n_free;
    residual_blocks_leave_out_gap(b, of.y);
    for (size_t c = 0; c < q; c++)
        residual_blocks_leave_out_gap(b, of.a[c]);
    for (size_t c = 0; c < columns_b; c++)
        residual_blocks_leave_out_gap(b, of.b[c]);
    add_baseline(m, p, e, b, aa, ay);
    for (size_t c = 0; c < q; c++) {
        for (size_t d = 0; d < q; d++)
            aa[c][d] += curve_dot(of.a[c], of.a[d], n);
        ay[c] += curve_dot(of.a[c], of.y, n);
        if (!(aa[c][c] > 0.0))
            return false;
    }
    const double reach = contact_reach(m, p, b);
    for (size_t c = 0; c < q; c++) {
        if (to->which[c] == CURVE_C)
            aa[c][c] += b->innovation / (reach * reach);
        scale[c] = 1.0 / sqrt(aa[c][c]);
    }
    for (size_t c = 0; c < q; c++)
        for (size_t d = 0; d < q; d++)
            aa[c][d] *= scale[c] * scale[d];
    if (!decompose(aa, q))
        return false;
    /* all in units of the noise, and of A in its triangular form */
    double along_y[N];
    for (size_t c = 0; c < q; c++)
        ay[c] *= scale[c];
    forward((const double(*)[M])aa, q, ay, along_y);
    for (size_t k = 0; k < columns_b; k++) {
        double with[N];
        for (size_t c = 0; c < q; c++)
            with[c] = scale[c] * curve_dot(of.a[c], of.b[k], n);
        forward((const double(*)[M])aa, q, with, solved[k]);
    }
    for (size_t k = 0; k < columns_b; k++) {
        for (size_t l = 0; l <= k; l++)
            to->mm[k][l] = to->mm[l][k] =
                (curve_dot(of.b[k], of.b[l], n) - dot(solved[k], solved[l], q)) / b->innovation;
        to->my[k] = (curve_dot(of.b[k], of.y, n) - dot(solved[k], along_y, q)) / b->innovation;
    }
    /* back to the parameters */
    for (size_t k = 0; k < columns_b; k++) {
        double *x = solved[k];
        for (size_t c = q; c-- > 0;) {
            for (size_t d = c + 1; d < q; d++)
                x[c] -= aa[d][c] * x[d];
            x[c] /= aa[c][c];
        }
        for (size_t c = 0; c < q; c++)
            to->imitated[c][k] = scale[c] * x[c];
    }
    return true;
}

/* ---- sizes and lengths ----------------------------------------------------------------------- */

typedef struct candidate {
    double log_likelihood, log_prior, shift[N], variance[N];
} candidate;

/* With a discrepancy of size s and length number l; s = 0: with the moves of the tip alone. */
static candidate try_size(const data_sums *d, double s, int l, double most, double freedom,
                          double *explained)
{
    const size_t from = s > 0.0 ? 0 : LEGENDRE, all = LEGENDRE + d->n_moves, n = all - from;
    double root[M][M] = {{0.0}}, t[M][M], with[M], x[M], half[M][M];
    candidate c = {.log_likelihood = 0.0};
    /* rows of root': how each unit normal number enters the coefficients */
    for (size_t k = 0; k < LEGENDRE && s > 0.0; k++)
        for (size_t j = 0; j <= k; j++)
            root[j][k] = s * kernels.root[l][k][j];
    for (size_t k = 0; k < d->n_moves; k++)
        root[LEGENDRE + k][LEGENDRE + k] = 1.0;
    for (size_t i = 0; i < n; i++) {
        with[i] = dot(root[from + i], d->my, all);
        for (size_t k = 0; k < all; k++)
            half[i][k] = dot(root[from + i], d->mm[k], all);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            t[i][j] = dot(half[i], root[from + j], all) + (i == j ? 1.0 : 0.0);
    if (!decompose(t, n)) {
        c.log_likelihood = -(double)INFINITY;
        return c;
    }
    forward((const double(*)[M])t, n, with, x);
    *explained = dot(x, x, n);
    for (size_t i = 0; i < n; i++)
        c.log_likelihood -= log(t[i][i]);
    c.log_likelihood -=
        0.5 * (freedom + LEGENDRE) * log(1.0 + fmax(most - *explained, 0.0) / freedom);
    for (size_t a = 0; a < d->n_free; a++) {
        double by[M], y[M];
        for (size_t i = 0; i < n; i++)
            by[i] = dot(root[from + i], d->imitated[a], all);
        forward((const double(*)[M])t, n, by, y);
        c.shift[a] = -dot(y, x, n);
        c.variance[a] = dot(y, y, n);
    }
    return c;
}

typedef struct mixture {
    double shift[N], variance[N]; /* of the free parameters */
    double none;                  /* chance that there is no discrepancy */
} mixture;

/* The candidates by their likelihood. */
static mixture mix(candidate *all, size_t n)
{
    mixture to = {.none = 0.0};
    double best = -(double)INFINITY, sum = 0.0;
    for (size_t i = 0; i < n; i++)
        best = fmax(best, all[i].log_likelihood + all[i].log_prior);
    for (size_t i = 0; i < n; i++) {
        const double share = exp(all[i].log_likelihood + all[i].log_prior - best);
        sum += share;
        all[i].log_prior = share;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < N; a++)
            to.shift[a] += all[i].log_prior / sum * all[i].shift[a];
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < N; a++) {
            const double off = all[i].shift[a] - to.shift[a];
            to.variance[a] += all[i].log_prior / sum * (all[i].variance[a] + off * off);
        }
    to.none = all[0].log_prior / sum;
    return to;
}

static mixture weigh_sizes(const data_sums *d, double freedom)
{
    candidate all[1 + LENGTHS * SIZES];
    double most = 0.0, explained;
    size_t n = 1, sizes = 1;
    (void)try_size(d, 1.0, 0, 0.0, freedom, &most);
    all[0] = try_size(d, 0.0, 0, most, freedom, &explained);
    all[0].log_prior = log(holds);
    bool matters = true;
    for (double s = largest_size; sizes <= SIZES && matters; s /= size_ratio, sizes++) {
        matters = false;
        for (int l = 0; l < LENGTHS; l++, n++) {
            all[n] = try_size(d, s, l, most, freedom, &explained);
            all[n].log_prior = log((1.0 - holds) * kernels.chance[l]);
            matters = matters || !(fabs(all[n].log_likelihood - all[0].log_likelihood) < no_size);
        }
    }
    for (size_t i = 1; i < n; i++)
        all[i].log_prior -= log((double)(sizes - 1));
    return mix(all, n);
}

/* ---- the error ------------------------------------------------------------------------------- */

/* Residuals of the noise at p, to scratch. */
static void evaluate(curve_law *m, const double p[N], const curve_wave *wave)
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
    curve_law m = curve_law_of(f->table, &f->input.samples, &f->kind, f->workspace);
    residual_blocks b;
    data_sums d;
    double *const e = f->workspace->scratch;
    if (f->kind.plain || !(f->options->least_chance > 0.0) || !s->converged)
        return;
    (void)pthread_once(&kernels_once, make_kernels);
    evaluate(&m, s->p, &s->wave);
    const double force = s->p[CURVE_E] * f->workspace->g[f->input.samples.n - 1];
    if (!(force > 0.0) || !residual_blocks_average(&m, s->p, e, &b) ||
        !residual_blocks_find_noise(&m, s->p, &b) || !sum_up(f, &m, s->p, e, &b, force, &d))
        return;
    const mixture found = weigh_sizes(&d, b.freedom);
    s->no_misfit = found.none;
    /* a pull before contact, where no law of it describes the rest, is there in contact or is not
     */
    const double pull =
        f->snap_on > 0.0 && !f->kind.adhesive && !curve_fits(f) ? f->snap_on / force : 0.0;
    for (size_t a = 0; a < d.n_free; a++) {
        const size_t i = d.which[a];
        s->misfit_error[i] =
            hypot(hypot(sqrt(found.variance[a]), found.shift[a]), pull * d.imitated[a][0]);
        s->standard_error[i] = hypot(s->standard_error[i], s->misfit_error[i]);
    }
}
