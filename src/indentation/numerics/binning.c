/* Means over the samples of an approach, its dwell and the free part of its retract, and their
 * covariance due to the noise of the baseline.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/numerics/relaxation.h"

#include <gsl/gsl_linalg.h>
#include <math.h>

/* Number of means of each part. A line needs 8 or 16, a curved part 64; the dwell has as many as
 * its result. The run time grows with the cube of their total. */
enum { FREE_BINS = 16, PRESSED_BINS = 64, HELD_BINS = WT_DWELL_POINTS, RETRACT_BINS = 8 };
enum { MOST_NODES = FREE_BINS + PRESSED_BINS + 1 + HELD_BINS + RETRACT_BINS };
/* Each mean of a baseline has two samples. */
enum { LEAST_BASELINE = 2 * FREE_BINS };
/* Duration of the first mean of the dwell over that of the dwell. The means with a constant ratio
 * of times cover three decades. */
static const double first_bin_share = 1e-3;
/* Start of the contact means before the contact point, in lengths of the contact. They still
 * include a contact point with that error. The value is chosen; the fit includes the adjacent means
 * as well. */
static const double margin = 0.2;
/* Last part of a retract that counts as free of contact and adhesion. The value is chosen. At 0.75
 * it may include the neck of an adhesive contact, at 0.25 the drift is three times less accurate.
 */
static const double free_share = 0.5;

static void begin_node(const wt_dwell_history *h, dwell_nodes *to, size_t i)
{
    to->from[to->n] = h->time[i];
    to->n++;
}

static void add_node_sample(const wt_dwell_history *h, dwell_nodes *to, size_t i, double step)
{
    const size_t k = to->n - 1;
    to->count[k]++;
    to->time[k] += h->time[i];
    to->position[k] += h->position[i];
    to->force[k] += h->force[i];
    to->to[k] = h->time[i] + step;
}

/* Adds means with equal numbers of samples. */
static void add_equal_bins(const wt_dwell_history *h, size_t from, size_t to, size_t bins,
                           double step, dwell_nodes *nodes)
{
    const size_t n = to - from;
    size_t last = bins;
    bins = bins < n ? bins : n;
    for (size_t i = 0; i < n; i++) {
        const size_t bin = i * bins / n;
        if (bin != last)
            begin_node(h, nodes, from + i);
        last = bin;
        add_node_sample(h, nodes, from + i, step);
    }
}

/* Adds means over times since the approach that grow by a constant factor. */
static void add_dwell_bins(const wt_dwell_history *h, double step, dwell_nodes *nodes)
{
    const size_t from = h->n_approach, n = h->n_dwell;
    const double start = h->time[from] - step, duration = h->time[from + n - 1] - start;
    const double first = fmax(step, first_bin_share * duration), ratio = log(duration / first);
    double last = -1;
    for (size_t i = from; i < from + n; i++) {
        const double since = h->time[i] - start;
        const double bin =
            since < first ? 0 : fmin(floor(log(since / first) / ratio * HELD_BINS), HELD_BINS - 1);
        if (!(bin <= last))
            begin_node(h, nodes, i);
        last = bin;
        add_node_sample(h, nodes, i, step);
    }
}

/* Adds the farther part of the retract after its strongest pull. It is at least as far from the
 * sample as the depth of loading. */
static void add_retract_bins(const wt_dwell_history *h, dwell_nodes *nodes)
{
    const size_t from = h->n_approach + h->n_dwell, end = from + h->n_retract;
    const double max_depth = h->position[h->n_approach - 1] - h->contact_point;
    size_t first = from;
    for (size_t i = from; i < end; i++)
        if (h->force[i] < h->force[first])
            first = i;
    while (first < end && !(h->position[first] < h->contact_point - max_depth))
        first++;
    if (end - first < LEAST_BASELINE)
        return;
    const size_t begin = first + (size_t)(free_share * (double)(end - first));
    add_equal_bins(h, begin, end, RETRACT_BINS,
                   (h->time[end - 1] - h->time[begin]) / (double)(end - 1 - begin), nodes);
}

/* ---- noise ----------------------------------------------------------------------------------- */

/* Model of the noise: white noise and first-order processes with times in octaves. Processes slower
 * than the baseline resolves are as strong as the slowest resolved one. */
enum { OCTAVES = 24 }; /* covers 2^24 samples, more than a curve has */
/* Limit of the multiplicative iterations. The estimate needs an accuracy of some per cent. */
enum { ROUNDS = 400 };
typedef struct dwell_noise {
    double white, slow[OCTAVES], time[OCTAVES]; /* variances of a sample; times [s] */
    size_t n;
    double extra; /* additional variance in contact */
} dwell_noise;

/* Residuals of a line through n samples against time. */
static void subtract_line(const double *time, const double *force, size_t n, double *residual)
{
    double t = 0, f = 0, tt = 0, tf = 0;
    for (size_t i = 0; i < n; i++) {
        t += time[i] / (double)n;
        f += force[i] / (double)n;
    }
    for (size_t i = 0; i < n; i++) {
        tt += (time[i] - t) * (time[i] - t);
        tf += (time[i] - t) * (force[i] - f);
    }
    for (size_t i = 0; i < n; i++)
        residual[i] = force[i] - f - (tt > 0 ? tf / tt : 0) * (time[i] - t);
}

/* Mean square of the differences between successive means of m samples. */
static double mean_square_difference(const double *x, size_t n, size_t m)
{
    double sum = 0, count = 0, step = 0;
    for (size_t i = 0; i < m; i++)
        step += (x[m + i] - x[i]) / (double)m;
    for (size_t i = 0;; i++) {
        sum += step * step;
        count++;
        if (i + 2 * m >= n)
            break;
        step += (x[i] - 2 * x[i + m] + x[i + 2 * m]) / (double)m;
    }
    return sum / count;
}

/* Mean square difference for a process of variance 1. x = duration of a mean over the time of the
 * process. */
static double process_difference(double x)
{
    const double within = x < 1e-3 ? 1 - x / 3 : 2 * (x + expm1(-x)) / (x * x),
                 across = x < 1e-3 ? 1 - x : pow(expm1(-x) / x, 2);
    return fmax(2 * (within - across), 0);
}

/* Half the mean square of the steps of force - stiffness * position. */
static double half_mean_square_step(const wt_dwell_history *h, size_t from, size_t n,
                                    double stiffness)
{
    double sum = 0;
    for (size_t i = from + 1; i < from + n; i++) {
        const double step =
            h->force[i] - h->force[i - 1] - stiffness * (h->position[i] - h->position[i - 1]);
        sum += 0.5 * step * step;
    }
    return n > 1 ? sum / (double)(n - 1) : 0;
}

/* Finds non-negative variances that reproduce the measured differences, by iterations in the
 * logarithm. */
static void fit_noise_variances(const double *measured, size_t n,
                                double response[OCTAVES][OCTAVES + 1], double *variance)
{
    for (size_t k = 0; k <= n; k++)
        variance[k] = measured[0] / (double)(n + 1);
    for (int round = 0; round < ROUNDS; round++) {
        double up[OCTAVES + 1] = {0}, down[OCTAVES + 1] = {0};
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t k = 0; k <= n; k++)
                sum += response[i][k] * variance[k];
            for (size_t k = 0; k <= n; k++) {
                const double part = response[i][k] / sum;
                up[k] += part * measured[i] / sum;
                down[k] += part;
            }
        }
        for (size_t k = 0; k <= n; k++)
            variance[k] *= sqrt(up[k] / down[k]);
    }
}

static dwell_noise estimate_dwell_noise(const wt_dwell_history *h, size_t n, double stiffness,
                                        double step, double *residual)
{
    dwell_noise v = {0};
    double measured[OCTAVES] = {0}, response[OCTAVES][OCTAVES + 1], variance[OCTAVES + 1];
    const double whole = h->time[h->n_approach + h->n_dwell - 1] - h->time[0];
    size_t n_measured = 0;
    subtract_line(h->time, h->force, n, residual);
    for (size_t m = 1; 8 * m <= n && n_measured < OCTAVES; m *= 2) {
        measured[n_measured] = mean_square_difference(residual, n, m);
        response[n_measured][0] = 2 / (double)m;
        n_measured++;
    }
    for (size_t i = 0; i < n_measured; i++)
        for (size_t k = 0; k < n_measured; k++)
            response[i][k + 1] = process_difference(ldexp(1, (int)i - (int)k));
    fit_noise_variances(measured, n_measured, response, variance);
    v.white = variance[0];
    for (; v.n < OCTAVES; v.n++) {
        v.time[v.n] = step * ldexp(1, (int)v.n);
        v.slow[v.n] = variance[1 + (v.n < n_measured ? v.n : n_measured - 1)];
        if (v.n >= n_measured && v.time[v.n] > whole)
            break;
    }
    v.extra = fmax(0, half_mean_square_step(h, h->n_approach, h->n_dwell, stiffness) -
                          half_mean_square_step(h, 0, n, 0));
    return v;
}

/* Covariance of two means of a noise with one decay time, over its variance. */
static double noise_covariance(const dwell_nodes *n, size_t i, size_t k, double time)
{
    const double x = (n->to[i] - n->from[i]) / time, y = (n->to[k] - n->from[k]) / time;
    if (i == k)
        return x < 1e-4 ? 1 - x / 3 : 2 * (x + expm1(-x)) / (x * x);
    return exp(-fmax(0, n->from[k] - n->to[i]) / time) * (-expm1(-x) / x) * (-expm1(-y) / y);
}

static bool factor_covariance(dwell_nodes *n, const dwell_noise *v, arena *memory)
{
    n->factor = arena_matrix(memory, n->n, n->n);
    for (size_t i = 0; i < n->n; i++)
        for (size_t k = i; k < n->n; k++) {
            const bool pressed = i >= n->first_loading && i < n->first_free;
            double c = 0;
            for (size_t j = 0; j < v->n; j++)
                c += v->slow[j] * noise_covariance(n, i, k, v->time[j]);
            c += i == k ? (v->white + (pressed ? v->extra : 0)) / n->count[i] : 0;
            gsl_matrix_set(n->factor, i, k, c);
            gsl_matrix_set(n->factor, k, i, c);
        }
    return gsl_linalg_cholesky_decomp1(n->factor) == GSL_SUCCESS;
}

const char *dwell_nodes_create(const wt_dwell_history *h, double stiffness, arena *memory,
                               dwell_nodes *nodes)
{
    double **const arrays[] = {&nodes->time, &nodes->position, &nodes->force,
                               &nodes->from, &nodes->to,       &nodes->count};
    *nodes = (dwell_nodes){0};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = arena_numbers(memory, MOST_NODES);
    double *residual = arena_numbers(memory, h->n_approach);
    const double end = h->position[h->n_approach - 1],
                 begin = h->contact_point - margin * (end - h->contact_point);
    size_t split = 0;
    while (split < h->n_approach && h->position[split] < begin)
        split++;
    if (split < LEAST_BASELINE)
        return "too little baseline for its noise";
    if (h->n_approach - split < HELD_BINS || h->n_dwell < HELD_BINS)
        return "too few samples in contact";
    const double before = (h->time[h->n_approach - 1] - h->time[0]) / (double)(h->n_approach - 1),
                 step = (h->time[h->n_approach + h->n_dwell - 1] - h->time[h->n_approach]) /
                        (double)(h->n_dwell - 1);
    add_equal_bins(h, 0, split, FREE_BINS, before, nodes);
    nodes->first_loading = nodes->n;
    add_equal_bins(h, split, h->n_approach - 1, PRESSED_BINS, before, nodes);
    add_equal_bins(h, h->n_approach - 1, h->n_approach, 1, before, nodes); /* end of the approach */
    nodes->first_dwell = nodes->n;
    add_dwell_bins(h, step, nodes);
    nodes->first_free = nodes->n;
    if (h->n_retract > 0)
        add_retract_bins(h, nodes);
    for (size_t i = 0; i < nodes->n; i++) {
        nodes->time[i] /= nodes->count[i];
        nodes->position[i] /= nodes->count[i];
        nodes->force[i] /= nodes->count[i];
    }
    const dwell_noise v = estimate_dwell_noise(h, split, stiffness, before, residual);
    if (isnan(v.white) ||
        !factor_covariance(nodes, &v, memory)) /* variances without noise are NaN */
        return "no noise in the baseline";
    return "";
}
