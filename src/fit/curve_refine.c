/* Least squares of one force curve in modulus, contact point, baseline offset and tilt at once
 * (Levenberg-Marquardt), and the errors of the result.
 *
 * What is compared. The noise sits in the force, and the force is also in the tip position, so that
 * a noise e appears in "force minus E* G(measured indentation)" as h e with h = 1 + S/k (S =
 * contact stiffness, k = spring constant): 13 times larger in contact than before it for rubber of
 * 20 MPa and a lever of 0.1 N/m, and correlated with the abscissa. Least squares in that residual
 * is neither efficient nor unbiased. Here the force is compared with the one that lever and sample
 * together give at the height of the sample, k (z - delta) = E* G(delta), which leaves e as it is.
 * The plain residual, as most programs use it, is there for comparison with them.
 *
 * Errors. The residuals are correlated, and what the model misses shows only in contact. So
 *     covariance = (J'J)^-1 [ sum_i v_i h_i^2 J_i J_i' ] (J'J)^-1     (h = 1 unless plain)
 * with v = variance times correlation length of e on the baseline and in the contact part
 * separately. The lever is as noisy in contact as before it at least, so v of the contact part is
 * never taken below that of the baseline.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/curve.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

enum { N = WT_CURVE_N_PARAMETERS, MAX_ITERATIONS = 60, MAX_NEWTON = 50 };

typedef struct problem {
    const wt_contact_table *table;
    const wt_curve_samples *samples;
    wt_indent_workspace *workspace;
    bool free[N];
    bool plain;
} problem;

typedef struct normal_equations {
    double jj[N][N], jr[N];
    double cost;
} normal_equations;

/* Turns the measured indentations of the workspace into those at which lever and sample are in
 * balance at the height of each sample, with G and G' there. k (z - x) - E* G(x) falls and is
 * concave, so Newton's method converges from anywhere after its first step. */
static void balance(const problem *q, const double p[N])
{
    const wt_curve_samples *s = q->samples;
    wt_indent_workspace *w = q->workspace;
    const double k = s->spring_constant;
    size_t first = 0;
    double deepest = 0.0;
    while (first < s->n && s->position[first] <= p[WT_CURVE_C])
        first++;
    for (size_t i = 0; i < s->n; i++) {
        double z = s->position[i] - p[WT_CURVE_C];
        if (z <= 0.0)
            w->delta[i] = z;
        else if (!(w->delta[i] > 0.0 && w->delta[i] < z))
            w->delta[i] = z;
        deepest = fmax(deepest, z);
    }
    memset(w->g, 0, first * sizeof *w->g);
    memset(w->slope, 0, first * sizeof *w->slope);
    double largest_step = INFINITY;
    for (int i = 0; i < MAX_NEWTON && largest_step > 1e-13 * deepest; i++) {
        wt_contact_table_eval(q->table, w->delta + first, s->n - first, w->g + first,
                              w->slope + first);
        largest_step = 0.0;
        for (size_t j = first; j < s->n; j++) {
            double z = s->position[j] - p[WT_CURVE_C];
            if (z <= 0.0)
                continue;
            double step = (k * (z - w->delta[j]) - p[WT_CURVE_E] * w->g[j]) /
                          (k + p[WT_CURVE_E] * w->slope[j]);
            double next = fmax(w->delta[j] + step, 0.0);
            largest_step = fmax(largest_step, fabs(next - w->delta[j]));
            /* G follows to first order, which is exact when the steps have become small. */
            w->g[j] += w->slope[j] * (next - w->delta[j]);
            w->delta[j] = next;
        }
    }
}

/* Residuals and, in the workspace, delta, G and G' of every sample. */
static double residuals(const problem *q, const double p[N])
{
    const wt_curve_samples *s = q->samples;
    wt_indent_workspace *w = q->workspace;
    const double k = s->spring_constant, stretch = 1.0 + p[WT_CURVE_T] / k;
    for (size_t i = 0; i < s->n; i++) {
        double z = s->position[i] - p[WT_CURVE_C], f = s->force[i] - p[WT_CURVE_F0];
        w->delta[i] = z * stretch - f / k;
        w->residual[i] = f - p[WT_CURVE_T] * z;
    }
    if (q->plain)
        wt_contact_table_eval(q->table, w->delta, s->n, w->g, w->slope);
    else
        balance(q, p);
    double cost = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        w->residual[i] -= p[WT_CURVE_E] * w->g[i];
        cost += w->residual[i] * w->residual[i];
    }
    return cost;
}

static double lever_factor(const problem *q, const double p[N], size_t i)
{
    return 1.0 + p[WT_CURVE_E] * q->workspace->slope[i] / q->samples->spring_constant;
}

/* Derivatives of the modelled force of sample i. Returns what the residual makes of a noise of 1.
 */
static double jacobian_row(const problem *q, const double p[N], size_t i, double row[N])
{
    const wt_indent_workspace *w = q->workspace;
    double h = lever_factor(q, p, i), stiffness = p[WT_CURVE_E] * w->slope[i];
    double plain = q->plain ? h : 1.0, balanced = q->plain ? 1.0 : 1.0 / h;
    row[WT_CURVE_E] = w->g[i] * balanced;
    row[WT_CURVE_C] = -p[WT_CURVE_T] * plain - stiffness * balanced;
    row[WT_CURVE_F0] = plain;
    row[WT_CURVE_T] = (q->samples->position[i] - p[WT_CURVE_C]) * plain;
    for (size_t a = 0; a < N; a++)
        if (!q->free[a])
            row[a] = 0.0;
    return plain;
}

static void assemble(const problem *q, const double p[N], normal_equations *e)
{
    memset(e, 0, sizeof *e);
    for (size_t i = 0; i < q->samples->n; i++) {
        double row[N], r = q->workspace->residual[i];
        jacobian_row(q, p, i, row);
        for (size_t a = 0; a < N; a++) {
            for (size_t b = a; b < N; b++)
                e->jj[a][b] += row[a] * row[b];
            e->jr[a] += row[a] * r;
        }
    }
    for (size_t a = 0; a < N; a++) {
        for (size_t b = 0; b < a; b++)
            e->jj[a][b] = e->jj[b][a];
        if (!q->free[a])
            e->jj[a][a] = 1.0;
    }
}

/* Solves (J'J + damping diag) x = y for several y, columns scaled to 1. */
static bool solve(const normal_equations *e, double damping, double (*y)[N], size_t n_y)
{
    double scaled[N * N], scale[N];
    for (size_t a = 0; a < N; a++) {
        if (!(e->jj[a][a] > 0.0))
            return false;
        scale[a] = 1.0 / sqrt(e->jj[a][a]);
    }
    for (size_t a = 0; a < N; a++)
        for (size_t b = 0; b < N; b++)
            scaled[a * N + b] = e->jj[a][b] * scale[a] * scale[b] + (a == b ? damping : 0.0);
    gsl_matrix_view matrix = gsl_matrix_view_array(scaled, N, N);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS)
        return false;
    for (size_t j = 0; j < n_y; j++) {
        for (size_t a = 0; a < N; a++)
            y[j][a] *= scale[a];
        gsl_vector_view x = gsl_vector_view_array(y[j], N);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
            return false;
        for (size_t a = 0; a < N; a++)
            y[j][a] *= scale[a];
    }
    return true;
}

static bool minimise(const problem *q, double p[N], double *cost)
{
    double damping = 0.0, scale = 0.0;
    for (size_t i = 0; i < q->samples->n; i++)
        scale += q->samples->force[i] * q->samples->force[i];
    *cost = residuals(q, p);
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        normal_equations e;
        assemble(q, p, &e);
        for (;;) {
            double step[1][N], trial[N], expected = 0.0;
            memcpy(step[0], e.jr, sizeof e.jr);
            bool solved = solve(&e, damping, step, 1);
            for (size_t a = 0; a < N; a++) {
                trial[a] = p[a] + step[0][a];
                expected += step[0][a] * e.jr[a];
            }
            /* The step is 1e-5 of the standard errors, or no more than rounding of the forces. */
            if (solved &&
                (expected <= 1e-10 * *cost / (double)q->samples->n || expected <= 1e-28 * scale))
                return true;
            if (solved && trial[WT_CURVE_E] > 0.0) {
                double trial_cost = residuals(q, trial);
                if (trial_cost < *cost) {
                    *cost = trial_cost;
                    memcpy(p, trial, sizeof trial);
                    damping = damping > 1e-6 ? 0.1 * damping : 0.0;
                    break;
                }
                if (expected <= 1e-9 * *cost) { /* too little to be seen in the cost */
                    *cost = residuals(q, p);
                    return true;
                }
            }
            damping = damping > 0.0 ? 10.0 * damping : 1e-3;
            if (damping > 1e8) {
                *cost = residuals(q, p);
                return false;
            }
        }
    }
    return false;
}

/* Variance of the mean per sample, v = variance * tau, with the samples that the fit used up. */
static double long_run_variance(wt_noise noise, size_t n, double used)
{
    double independent = (double)n / noise.correlation_length;
    return noise.variance * noise.correlation_length * independent /
           fmax(independent - used, 1.0 / 3.0 * independent);
}

static void statistics(const problem *q, wt_curve_solution *s)
{
    const wt_curve_samples *samples = q->samples;
    wt_indent_workspace *w = q->workspace;
    const double *p = s->p;
    const size_t n = samples->n;

    size_t first = 0;
    while (first < n && samples->position[first] < p[WT_CURVE_C])
        first++;
    s->first_contact = first;

    double row[N], n_contact = (double)(n - first);
    s->max_indentation = 0.0;
    s->largest_lever_factor = 1.0;
    for (size_t i = 0; i < n; i++) {
        w->scratch[i] = w->residual[i] / jacobian_row(q, p, i, row); /* e */
        s->max_indentation = fmax(s->max_indentation, w->delta[i]);
        s->largest_lever_factor = fmax(s->largest_lever_factor, lever_factor(q, p, i));
    }

    wt_noise before = wt_noise_estimate(w->scratch, first);
    wt_noise contact = wt_noise_estimate(w->scratch + first, n - first);
    double v_before = long_run_variance(before, first, 1.0 + (q->free[WT_CURVE_T] ? 1.0 : 0.0));
    double v_contact =
        long_run_variance(contact, n - first, 1.0 + (q->free[WT_CURVE_C] ? 1.0 : 0.0));
    v_contact = fmax(v_contact, v_before);
    s->noise = sqrt(before.variance);
    s->effective_n =
        (double)first / before.correlation_length + n_contact / contact.correlation_length;
    s->correlation_length = (double)n / s->effective_n;

    normal_equations e;
    assemble(q, p, &e);
    double middle[N][N] = {{0.0}}, gain[N] = {0.0};
    for (size_t i = 0; i < n; i++) {
        double h = jacobian_row(q, p, i, row), v = (i < first ? v_before : v_contact) * h * h;
        for (size_t a = 0; a < N; a++)
            for (size_t b = 0; b < N; b++)
                middle[a][b] += v * row[a] * row[b];
        /* A sensitivity larger by a share u acts like a noise of u times the force. */
        double f = samples->force[i] - p[WT_CURVE_F0] -
                   p[WT_CURVE_T] * (samples->position[i] - p[WT_CURVE_C]);
        for (size_t a = 0; a < N; a++)
            gain[a] += row[a] * h * f;
    }
    double inverse[N + 1][N] = {{0.0}};
    for (size_t a = 0; a < N; a++)
        inverse[a][a] = 1.0;
    memcpy(inverse[N], gain, sizeof gain);
    bool solved = solve(&e, 0.0, inverse, N + 1);
    for (size_t a = 0; a < N; a++) {
        double variance = 0.0;
        for (size_t b = 0; b < N; b++)
            for (size_t c = 0; c < N; c++)
                variance += inverse[a][b] * middle[b][c] * inverse[a][c];
        s->standard_error[a] = !q->free[a] ? 0.0 : solved ? sqrt(variance) : (double)NAN;
    }
    s->sensitivity_gain = solved ? inverse[N][WT_CURVE_E] / p[WT_CURVE_E] : (double)NAN;
}

/* Of the force against the measured indentation in contact, as a plot of them shows it. */
static double r_squared(const problem *q, const wt_curve_solution *s)
{
    problem plain = *q;
    plain.plain = true;
    residuals(&plain, s->p);
    const wt_indent_workspace *w = q->workspace;
    double total = 0.0, sum = 0.0, sum2 = 0.0;
    for (size_t i = s->first_contact; i < q->samples->n; i++) {
        double f = s->p[WT_CURVE_E] * w->g[i] + w->residual[i];
        total += w->residual[i] * w->residual[i];
        sum += f;
        sum2 += f * f;
    }
    double scatter = sum2 - sum * sum / (double)(q->samples->n - s->first_contact);
    return scatter > 0.0 ? 1.0 - total / scatter : (double)NAN;
}

void wt_curve_refine(const wt_contact_table *table, const wt_curve_samples *samples,
                     const wt_curve_minimum *start, bool tilt, bool contact_fixed, bool plain,
                     wt_indent_workspace *workspace, wt_curve_solution *solution)
{
    problem q = {table, samples, workspace, {true, !contact_fixed, true, tilt}, plain};
    wt_curve_solution s = {
        .p = {start->reduced_modulus, start->contact_point, start->offset, tilt ? start->tilt : 0}};
    s.converged = minimise(&q, s.p, &s.cost);
    statistics(&q, &s);
    s.r_squared = r_squared(&q, &s);
    *solution = s;
}

void wt_curve_weights(const wt_contact_table *table, const wt_curve_samples *samples,
                      const wt_curve_solution *solution, wt_indent_workspace *workspace)
{
    problem q = {table, samples, workspace, {true, true, true, true}, false};
    residuals(&q, solution->p);
    for (size_t i = 0; i < samples->n; i++) {
        double h = lever_factor(&q, solution->p, i);
        workspace->weight[i] = 1.0 / (h * h);
    }
}
