/* Dwell on a rubber: one relaxation modulus through approach and dwell, by the hereditary integral
 * of Lee and Radok over the measured heights, in equilibrium with the cantilever.
 *
 * A dwell of two decades determines little more of the spectrum than its height, slope and
 * curvature: H = rise exp(slope x + bend x^2/2 + bumps), x = ln(tau/t) about the middle of the
 * dwell, and an equilibrium modulus. Slope, bend and bumps have priors for rubber. The drift of
 * the force has a prior too, because a constant rate of approach does not distinguish it from a
 * tilt. Curves of one kind share the error due to the priors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/relaxation.h"

#include "core/math/special.h"
#include "dma/law/prony_law.h"
#include "indentation/law/hereditary.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

/* Parameters. The bumps cover one and a half times the range of ln tau of the dwell; their distance
 * equals their width. Two ripples have a cosine and a sine each. */
enum { POINT, OFFSET, TILT, DRIFT, LEVEL, RISE, SLOPE, BEND, BUMP, BUMPS = 8 };
enum { N_PARAMETERS = BUMP + BUMPS, RIPPLES = 4 };
/* Steps of the force within each mean of the approach, with a linear depth. */
enum { SUBSTEPS = 4 };
/* Terms of the series. Four per decade have a ripple of 1e-7 (dma/numerics/master_fit.c), and 64
 * cover sixteen decades, more than a dwell with its margins. */
enum { MOST_TERMS = 64, TERMS_PER_DECADE = 4 };
/* Limit of the iterations. */
enum { MAX_STEPS = 60 };
/* Reported frequencies per decade. They equal the terms, because more would not be independent. */
enum { PER_DECADE = 4 };
/* Standard deviations of the priors of ln H: slope, which is -1/2 in Rouse's law and between -1 and
 * 1 for a visible relaxation (dma/numerics/master_fit.c); curvature per squared e-fold of time;
 * bumps, 20 % of H. A dwell determines slope and level; curvature and bumps widen the intervals.
 * Doubled values widen them accordingly where the dwell does not determine them. */
static const double slope_sd = 0.5, bend_sd = 0.15, bump_sd = 0.2;
/* Range of the series beyond the measured times; a term slower by 30 relaxes by 3 %. */
static const double term_range = 30;
/* Periods of the tested ripples of the spectrum in ln tau. They are close to the width of one
 * relaxation time, 1.14 decades. */
static const double period[RIPPLES / 2] = {M_LN10, 1.5 * M_LN10};
/* Step of the difference quotients, near the root of the rounding error of 1e-10. */
static const double derivative_step = 1e-5;
/* Relative decrease of the sum of squares at convergence: 1e-4 of a standard error. */
static const double converged = 1e-8;
/* Smallest ratio of the final to the initial indentation. Below it the dwell is not at constant
 * height or force, and the fit lacks Ting's law for a shrinking contact. 5 % of indentation are 8
 * to 10 % of force. */
static const double min_depth_ratio = 0.95;
/* Customary significance level of the misfit. */
static const double misfit_p_threshold = 0.01;

typedef struct relaxation_task {
    const wt_contact_table *table;
    const wt_dwell_history *history;
    dwell_nodes nodes;
    hereditary law;
    size_t n_terms;
    double time[MOST_TERMS], modulus[MOST_TERMS], width; /* width of a term in ln tau */
    double middle;                                       /* time of x = 0 */
    double bump[BUMPS], bump_width;                      /* positions and width, in x */
    double
        ripple[RIPPLES]; /* coefficients of cosine and sine of each period; 0 except in the test */
    double unit[N_PARAMETERS]; /* units of the parameters, which make all of the order of 1 */
    double
        sd[N_PARAMETERS]; /* standard deviations of the priors in these units; 0 without a prior */
    double *residual, *shifted, *depth, *pressed; /* [n] */
    double *jacobian;                             /* [N_PARAMETERS][n] */
    double *rippled;                              /* [RIPPLES][n] derivatives by the ripples */
} relaxation_task;

/* Sets the relaxation times from well below the first to well above the last time of the dwell. */
static void set_relaxation_times(relaxation_task *t)
{
    const dwell_nodes *n = &t->nodes;
    const double load = n->time[n->first_dwell - 1] - n->time[n->first_loading],
                 first = n->time[n->first_dwell] - n->time[n->first_dwell - 1],
                 last = n->time[n->first_free - 1] - n->time[n->first_loading];
    const double low = log(fmin(load, first) / term_range), high = log(last * term_range);
    t->middle = sqrt(load * last);
    t->bump_width = 1.5 * log(last / load) / (BUMPS - 1);
    for (size_t k = 0; k < BUMPS; k++)
        t->bump[k] = 1.5 * log(last / load) * ((double)k / (BUMPS - 1) - 0.5);
    t->width = M_LN10 / TERMS_PER_DECADE;
    t->n_terms = (size_t)((high - low) / t->width) + 1;
    if (t->n_terms > MOST_TERMS) {
        t->n_terms = MOST_TERMS;
        t->width = (high - low) / (MOST_TERMS - 1);
    }
    for (size_t i = 0; i < t->n_terms; i++)
        t->time[i] = exp(low + t->width * (double)i);
}

/* Computes the moduli of the terms and returns the equilibrium modulus. LEVEL is the logarithm of
 * the relaxation modulus at the middle of the dwell, which hardly depends on the spectrum. RISE is
 * the spectrum there over that modulus. */
static double compute_term_moduli(relaxation_task *t, const double *p)
{
    const double level = t->history->modulus * exp(p[LEVEL]), rise = p[RISE] * level * t->width;
    double rest = level;
    for (size_t i = 0; i < t->n_terms; i++) {
        const double x = log(t->time[i] / t->middle);
        double ln = p[SLOPE] * x + 0.5 * p[BEND] * x * x;
        for (size_t k = 0; k < BUMPS; k++) {
            const double off = (x - t->bump[k]) / t->bump_width;
            ln += p[BUMP + k] * exp(-0.5 * off * off);
        }
        for (size_t k = 0; k < RIPPLES; k += 2) {
            const double turn = 2 * M_PI * x / period[k / 2];
            ln += t->ripple[k] * cos(turn) + t->ripple[k + 1] * sin(turn);
        }
        t->modulus[i] = rise * exp(ln);
        rest -= t->modulus[i] * exp(-t->middle / t->time[i]);
    }
    return rest;
}

/* Computes storage and loss modulus at an angular frequency. */
static void complex_modulus(relaxation_task *t, const double *p, double omega, double to[2])
{
    to[0] = compute_term_moduli(t, p);
    to[1] = 0;
    for (size_t i = 0; i < t->n_terms; i++)
        prony_add_term(t->modulus[i], t->time[i], omega, &to[0], &to[1]);
}

/* Adds the difference between the mean over a time interval and the value at its centre, due to the
 * curvature of the force. */
static void correct_mean_curvature(const dwell_nodes *n, const double *pressed, double *force)
{
    const size_t part[] = {n->first_loading, n->first_dwell - 1, n->first_dwell, n->first_free};
    for (size_t j = 0; j < sizeof part / sizeof part[0]; j += 2)
        for (size_t i = part[j] + 1; i + 1 < part[j + 1]; i++) {
            const double before = n->time[i] - n->time[i - 1], after = n->time[i + 1] - n->time[i],
                         width = n->to[i] - n->from[i];
            const double second =
                2 *
                ((pressed[i + 1] - pressed[i]) / after - (pressed[i] - pressed[i - 1]) / before) /
                (before + after);
            force[i] += second * width * width / 24 * (1 - 1 / (n->count[i] * n->count[i]));
        }
}

/* Computes the forces of the nodes, and the indentations unless depth is NULL. */
static void predict_forces(relaxation_task *t, const double *p, double *force, double *depth)
{
    const dwell_nodes *n = &t->nodes;
    const wt_dwell_history *h = t->history;
    const double nu = h->poisson_ratio, k = h->spring_constant;
    hereditary *law = &t->law;
    double before = 0, start = 0;
    const double rest = compute_term_moduli(t, p);
    const wt_prony series = {.equilibrium_modulus = rest,
                             .n = t->n_terms,
                             .relaxation_time = t->time,
                             .modulus = t->modulus};
    hereditary_begin(law, &series, 1 / (1 - nu * nu), t->time[0],
                     n->time[n->first_free - 1] - n->time[0]);
    for (size_t i = 0; i < law->n; i++)
        law->memory[0][i] = 0;
    for (size_t i = 0; i < n->n; i++) {
        const double z = n->position[i] - h->contact_point - p[POINT] * t->unit[POINT];
        double g = 0, slope = 0, pressed = 0, x = 0;
        t->pressed[i] = 0;
        force[i] = p[OFFSET] * t->unit[OFFSET] + p[TILT] * t->unit[TILT] * z +
                   p[DRIFT] * t->unit[DRIFT] * (n->time[i] - n->time[n->first_dwell - 1]);
        if (i == 0 || i >= n->first_free || (before <= 0 && !(z > 0)))
            continue;
        const double last = n->position[i - 1] - h->contact_point - p[POINT] * t->unit[POINT];
        hereditary_set_step(law, (n->time[i] - n->time[i - 1]) / SUBSTEPS);
        for (int j = 1; j <= SUBSTEPS; j++) {
            const double at = last + (z - last) * j / SUBSTEPS,
                         faded = hereditary_decay(law, law->memory[0]),
                         now = hereditary_force(law, 0, 0, 1),
                         past = hereditary_force(law, faded, before, 0);
            g = x = pressed = 0;
            if (k * at > past && now > 0 && at > 0) {
                x = curve_balanced_depth(t->table, k, at, 1, past, now, start, &g, &slope);
                pressed = past + now * g;
            }
            hereditary_add_change(law, law->memory[0], g - before);
            before = g;
            start = x;
        }
        force[i] += t->pressed[i] = pressed;
        if (depth != NULL)
            depth[i] = x;
    }
    correct_mean_curvature(n, t->pressed, force);
}

/* Divides by the Cholesky factor of the covariance. */
static void whiten_residual(const dwell_nodes *n, double *x)
{
    for (size_t i = 0; i < n->n; i++) {
        for (size_t k = 0; k < i; k++)
            x[i] -= gsl_matrix_get(n->factor, i, k) * x[k];
        x[i] /= gsl_matrix_get(n->factor, i, i);
    }
}

/* Computes the whitened residuals and returns the sum of squares with that of the priors. */
static double dwell_cost(relaxation_task *t, const double *p, double *residual)
{
    double sum = 0;
    predict_forces(t, p, residual, NULL);
    for (size_t i = 0; i < t->nodes.n; i++)
        residual[i] = t->nodes.force[i] - residual[i];
    whiten_residual(&t->nodes, residual);
    for (size_t i = 0; i < t->nodes.n; i++)
        sum += residual[i] * residual[i];
    for (size_t a = 0; a < N_PARAMETERS; a++)
        sum += t->sd[a] > 0 ? p[a] * p[a] / (t->sd[a] * t->sd[a]) : 0;
    return sum;
}

/* Computes J'J and J'r with the priors. */
static void dwell_equations(relaxation_task *t, const double *p,
                            double jj[N_PARAMETERS][N_PARAMETERS], double jr[N_PARAMETERS])
{
    const size_t n = t->nodes.n;
    for (size_t a = 0; a < N_PARAMETERS; a++) {
        double there[N_PARAMETERS], *column = t->jacobian + a * n;
        for (size_t b = 0; b < N_PARAMETERS; b++)
            there[b] = p[b] + (b == a ? derivative_step : 0);
        (void)dwell_cost(t, there, column);
        for (size_t i = 0; i < n; i++)
            column[i] = (t->residual[i] - column[i]) / derivative_step;
    }
    for (size_t a = 0; a < N_PARAMETERS; a++) {
        const double prior_weight = t->sd[a] > 0 ? 1 / (t->sd[a] * t->sd[a]) : 0;
        jr[a] = curve_dot(t->jacobian + a * n, t->residual, n) - prior_weight * p[a];
        for (size_t b = 0; b < N_PARAMETERS; b++)
            jj[a][b] = curve_dot(t->jacobian + a * n, t->jacobian + b * n, n) +
                       (a == b ? prior_weight : 0);
    }
}

/* Levenberg-Marquardt fit of the first n parameters. Returns the sum of squares, or NaN on failure.
 */
static double fit_parameters(relaxation_task *t, size_t n, double p[N_PARAMETERS],
                             double jj[N_PARAMETERS][N_PARAMETERS])
{
    double cost = dwell_cost(t, p, t->residual), damping = 1e-3, jr[N_PARAMETERS];
    for (int step = 0; step < MAX_STEPS; step++) {
        double damped[N_PARAMETERS][N_PARAMETERS], next[N_PARAMETERS], there;
        dwell_equations(t, p, jj, jr);
        do {
            for (size_t a = 0; a < N_PARAMETERS; a++) {
                for (size_t b = 0; b < N_PARAMETERS; b++)
                    damped[a][b] = jj[a][b] * (a == b ? 1 + damping : 1);
                next[a] = a < n ? jr[a] : 0;
            }
            gsl_matrix_view matrix =
                gsl_matrix_view_array_with_tda(&damped[0][0], n, n, N_PARAMETERS);
            gsl_vector_view x = gsl_vector_view_array(next, n);
            there = (double)NAN;
            if (gsl_linalg_cholesky_decomp1(&matrix.matrix) == GSL_SUCCESS &&
                gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) == GSL_SUCCESS) {
                for (size_t a = 0; a < N_PARAMETERS; a++)
                    next[a] += p[a];
                there = dwell_cost(t, next, t->shifted);
            }
            damping *= there <= cost ? 0.1 : 4;
        } while (!(there <= cost) && damping < 1e12);
        if (!(there <= cost))
            return isfinite(cost) ? cost : (double)NAN;
        const double gain = cost - there;
        for (size_t a = 0; a < N_PARAMETERS; a++)
            p[a] = next[a];
        cost = dwell_cost(t, p, t->residual);
        if (gain <= converged * cost)
            break;
    }
    dwell_equations(t, p, jj, jr);
    return cost;
}

/* ---- results --------------------------------------------------------------------------------- */

/* p value of the ripples of the spectrum, given noise and priors. They reveal single relaxation
 * times long before the whole misfit is significant. The result is NaN without a test: the fit
 * leaves nothing of a ripple, or rounding decides. */
static double ripple_chance(relaxation_task *t, const double *p, const gsl_matrix *covariance)
{
    const size_t n = t->nodes.n;
    double along[RIPPLES][N_PARAMETERS], m[RIPPLES][RIPPLES], left[RIPPLES], solved[RIPPLES],
        sum = 0;
    for (size_t k = 0; k < RIPPLES; k++) {
        double *column = t->rippled + k * n;
        t->ripple[k] = derivative_step;
        (void)dwell_cost(t, p, column);
        t->ripple[k] = 0;
        for (size_t i = 0; i < n; i++)
            column[i] = (t->residual[i] - column[i]) / derivative_step;
        for (size_t a = 0; a < N_PARAMETERS; a++)
            along[k][a] = curve_dot(t->jacobian + a * n, column, n);
        solved[k] = left[k] = curve_dot(column, t->residual, n);
    }
    for (size_t k = 0; k < RIPPLES; k++)
        for (size_t l = 0; l < RIPPLES; l++) {
            m[k][l] = curve_dot(t->rippled + k * n, t->rippled + l * n, n);
            for (size_t a = 0; a < N_PARAMETERS; a++)
                for (size_t b = 0; b < N_PARAMETERS; b++)
                    m[k][l] -= along[k][a] * gsl_matrix_get(covariance, a, b) * along[l][b];
        }
    gsl_matrix_view matrix = gsl_matrix_view_array(&m[0][0], RIPPLES, RIPPLES);
    gsl_vector_view x = gsl_vector_view_array(solved, RIPPLES);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
        return (double)NAN;
    for (size_t k = 0; k < RIPPLES; k++)
        sum += left[k] * solved[k];
    return gsl_cdf_chisq_Q(sum, RIPPLES);
}

/* Standard error from g' C g, and the part that curves share because of the priors. `scale`
 * multiplies the part of the noise. */
static void propagate_errors(const relaxation_task *t, const gsl_matrix *covariance,
                             const double *gradient, double scale, double *error, double *common)
{
    double all = 0, shared = 0;
    for (size_t a = 0; a < N_PARAMETERS; a++) {
        double row = 0;
        for (size_t b = 0; b < N_PARAMETERS; b++)
            row += gsl_matrix_get(covariance, a, b) * gradient[b];
        all += gradient[a] * row;
        shared += t->sd[a] > 0 ? row * row / (t->sd[a] * t->sd[a]) : 0;
    }
    *common = sqrt(shared) * (isnan(scale) ? scale : 1);
    *error = isnan(scale) ? scale : sqrt(fmax(0, all - shared) * scale + shared);
}

/* Sets the moduli at the frequencies of a grid common to all curves, between the inverse times from
 * contact to the start and end of the dwell. */
static void set_dwell_moduli(relaxation_task *t, const double *p, const gsl_matrix *covariance,
                             double scale, wt_dwell *to)
{
    /* No error is known of what the model does not describe. */
    const double known = to->misfit_p >= misfit_p_threshold ? 1 : (double)NAN;
    const double low = ceil(-log10(to->load_time + to->duration) * PER_DECADE),
                 high = floor(-log10(to->load_time) * PER_DECADE);
    for (double at = low; at <= high && to->n < WT_DWELL_FREQUENCIES; at++) {
        wt_dwell_moduli *m = &to->moduli[to->n++];
        double value[2], there[2], gradient[2][N_PARAMETERS] = {{0}};
        m->angular_frequency = pow(10, at / PER_DECADE);
        complex_modulus(t, p, m->angular_frequency, value);
        for (size_t a = LEVEL; a < N_PARAMETERS; a++) {
            double q[N_PARAMETERS];
            for (size_t b = 0; b < N_PARAMETERS; b++)
                q[b] = p[b] + (b == a ? derivative_step : 0);
            complex_modulus(t, q, m->angular_frequency, there);
            for (size_t k = 0; k < 2; k++)
                gradient[k][a] = (there[k] - value[k]) / derivative_step;
        }
        m->storage = (wt_estimate){.value = value[0], .unit = "Pa"};
        m->loss = (wt_estimate){.value = value[1], .unit = "Pa"};
        propagate_errors(t, covariance, gradient[0], known * scale, &m->storage.standard_error,
                         &m->storage_common_error);
        propagate_errors(t, covariance, gradient[1], known * scale, &m->loss.standard_error,
                         &m->loss_common_error);
    }
}

/* Sets contact point and baseline, and the systematic error of the indentation. */
static void set_contact_estimates(const relaxation_task *t, const double *p,
                                  const gsl_matrix *covariance, wt_dwell *to)
{
    const dwell_nodes *n = &t->nodes;
    const size_t last = n->first_free - 1;
    const double k = t->history->spring_constant;
    const bool described = to->misfit_p >= misfit_p_threshold;
    double gradient[N_PARAMETERS] = {0}, all;
    to->contact_point = t->history->contact_point + p[POINT] * t->unit[POINT];
    to->baseline_offset = p[OFFSET] * t->unit[OFFSET];
    to->baseline_tilt = p[TILT] * t->unit[TILT];
    to->drift = p[DRIFT] * t->unit[DRIFT];
    to->drift_start = n->time[n->first_dwell - 1];
    gradient[POINT] = -t->unit[POINT] * (1 + to->baseline_tilt / k);
    gradient[OFFSET] = t->unit[OFFSET] / k;
    gradient[TILT] = t->unit[TILT] * (n->position[last] - to->contact_point) / k;
    gradient[DRIFT] = t->unit[DRIFT] * (n->time[last] - to->drift_start) / k;
    propagate_errors(t, covariance, gradient, described ? 1 : (double)NAN, &all,
                     &to->indentation_common_error);
}

static void set_dwell_points(relaxation_task *t, const double *p, wt_dwell *to)
{
    const dwell_nodes *n = &t->nodes;
    const double nu = t->history->poisson_ratio, k = t->history->spring_constant;
    predict_forces(t, p, t->shifted, t->depth);
    for (size_t i = n->first_dwell; i < n->first_free; i++) {
        wt_dwell_point *point = &to->point[to->n_points++];
        const double z = n->position[i] - t->history->contact_point - p[POINT] * t->unit[POINT];
        const double baseline =
            p[OFFSET] * t->unit[OFFSET] + p[TILT] * t->unit[TILT] * z +
            p[DRIFT] * t->unit[DRIFT] * (n->time[i] - n->time[n->first_dwell - 1]);
        double g[2];
        point->time = n->time[i] - n->from[n->first_dwell] + to->load_time;
        point->force = n->force[i] - baseline;
        point->indentation = z - point->force / k;
        wt_contact_table_eval(t->table, &point->indentation, 1, &g[0], NULL);
        wt_contact_table_eval(t->table, &t->depth[i], 1, &g[1], NULL);
        point->modulus = point->force * (1 - nu * nu) / g[0];
        point->fitted = (t->shifted[i] - baseline) * (1 - nu * nu) / g[1];
    }
    const wt_dwell_point *first = &to->point[0], *last = &to->point[to->n_points - 1];
    to->creep = fabs(n->position[n->first_free - 1] - n->position[n->first_dwell]) * k >
                fabs(last->force - first->force);
    if (last->indentation < min_depth_ratio * first->indentation)
        to->reason = "the indentation falls in it, of which the law holds nothing";
    if (!contact_law_is_valid(contact_table_tip(t->table),
                              fmax(first->indentation, last->indentation)))
        to->reason = "deeper than the contact law of the tip holds";
}

/* Time from the contact point, interpolated between the means, to the dwell. */
static double load_time(const relaxation_task *t, const double *p)
{
    const dwell_nodes *n = &t->nodes;
    const double c = t->history->contact_point + p[POINT] * t->unit[POINT];
    size_t i = n->first_loading;
    while (i < n->first_dwell && n->position[i] < c)
        i++;
    if (i == 0 || i == n->first_dwell)
        return (double)NAN;
    const double part = (c - n->position[i - 1]) / (n->position[i] - n->position[i - 1]);
    return n->from[n->first_dwell] - n->time[i - 1] - part * (n->time[i] - n->time[i - 1]);
}

/* p value of the smaller of two p values. One test alone can reject the law. Acceptance needs both,
 * because the whole misfit does not show the ripples. */
static double combined_chance(double misfit, double ripples)
{
    if (isnan(ripples))
        return misfit * (2 - misfit) < misfit_p_threshold ? misfit * (2 - misfit) : (double)NAN;
    const double chance = fmin(misfit, ripples);
    return chance * (2 - chance);
}

static void set_relaxation_result(relaxation_task *t, const double *p, double cost,
                                  double jj[N_PARAMETERS][N_PARAMETERS], wt_dwell *to)
{
    const dwell_nodes *n = &t->nodes;
    const double freedom = (double)(n->n - N_PARAMETERS);
    gsl_matrix_view matrix = gsl_matrix_view_array(&jj[0][0], N_PARAMETERS, N_PARAMETERS);
    to->load_time = load_time(t, p);
    if (!(cost >= 0) || !(to->load_time > 0) ||
        gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_invert(&matrix.matrix) != GSL_SUCCESS) {
        to->reason = "no relaxation modulus goes through approach and dwell";
        return;
    }
    to->duration = n->to[n->first_free - 1] - n->from[n->first_dwell];
    to->misfit = cost / freedom;
    to->misfit_p =
        combined_chance(gsl_cdf_chisq_Q(cost, freedom), ripple_chance(t, p, &matrix.matrix));
    set_dwell_points(t, p, to);
    if (to->reason[0] != '\0')
        return;
    set_contact_estimates(t, p, &matrix.matrix, to);
    set_dwell_moduli(t, p, &matrix.matrix, fmax(1, to->misfit), to);
    if (to->n == 0)
        to->reason = "too short beside its loading";
    to->found = to->n > 0;
}

/* Sets the start of the search, an elastic sample. */
static void start_elastic(relaxation_task *t, double p[N_PARAMETERS])
{
    const wt_dwell_history *h = t->history;
    const dwell_nodes *n = &t->nodes;
    const double max_depth = h->position[h->n_approach - 1] - h->contact_point,
                 largest = n->force[n->first_dwell - 1] - h->baseline_offset,
                 time = n->time[n->first_free - 1] - n->time[0];
    const double unit[] = {max_depth, largest, largest / max_depth, largest / time};
    const double rate = (n->position[n->first_dwell - 1] - n->position[0]) /
                        (n->time[n->first_dwell - 1] - n->time[0]);
    for (size_t a = 0; a < N_PARAMETERS; a++) {
        t->unit[a] = a <= DRIFT ? unit[a] : 1;
        t->sd[a] = a >= BUMP ? bump_sd : 0;
    }
    t->sd[SLOPE] = slope_sd;
    t->sd[BEND] = bend_sd;
    /* The tilt may be entirely due to drift, or not at all. */
    t->sd[DRIFT] = hypot(h->baseline_tilt.value, h->baseline_tilt.standard_error) * fabs(rate) /
                   t->unit[DRIFT];
    if (!(t->sd[DRIFT] > 0))
        t->sd[DRIFT] = 1;
    p[RISE] = 0.05;
    p[OFFSET] = h->baseline_offset / t->unit[OFFSET];
    p[TILT] = h->baseline_tilt.value / t->unit[TILT];
}

static const char *history_defect(const wt_dwell_history *h)
{
    const size_t n = h->n_approach + h->n_dwell + h->n_retract;
    if (!(h->spring_constant > 0) || !(h->modulus > 0) || !isfinite(h->contact_point) ||
        !isfinite(h->baseline_offset) || !isfinite(h->baseline_tilt.value))
        return "no contact point from the approach";
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(h->time[i]) || !isfinite(h->position[i]) || !isfinite(h->force[i]))
            return "samples without a number";
        if (i > 0 && !(h->time[i] > h->time[i - 1]))
            return "times that do not rise";
    }
    return h->position[h->n_approach - 1] > h->contact_point ? "" : "not in contact";
}

static void fit_relaxation(relaxation_task *t, arena *memory, wt_dwell *to)
{
    const wt_dwell_history *h = t->history;
    const double depth = h->position[h->n_approach - 1] - h->contact_point;
    double g, slope, p[N_PARAMETERS] = {0}, jj[N_PARAMETERS][N_PARAMETERS];
    wt_contact_table_eval(t->table, &depth, 1, &g, &slope);
    const double s = h->modulus * slope;
    to->reason =
        dwell_nodes_create(h, h->spring_constant * s / (h->spring_constant + s), memory, &t->nodes);
    t->residual = arena_numbers(memory, t->nodes.n);
    t->jacobian = arena_numbers(memory, N_PARAMETERS * t->nodes.n);
    t->rippled = arena_numbers(memory, RIPPLES * t->nodes.n);
    t->shifted = arena_numbers(memory, t->nodes.n);
    t->depth = arena_numbers(memory, t->nodes.n);
    t->pressed = arena_numbers(memory, t->nodes.n);
    if (to->reason[0] != '\0')
        return;
    start_elastic(t, p);
    set_relaxation_times(t);
    (void)fit_parameters(t, BUMP, p, jj);
    const double cost = fit_parameters(t, N_PARAMETERS, p, jj);
    set_relaxation_result(t, p, cost, jj, to);
}

wt_status wt_dwell_fit(const wt_contact_table *table, const wt_dwell_history *history,
                       wt_dwell *dwell, wt_error *err)
{
    if (table == NULL || history == NULL || dwell == NULL || history->n_approach == 0)
        return wt_fail(err, WT_E_ARG, "no dwell");
    relaxation_task t = {.table = table, .history = history};
    arena memory = {0};
    *dwell = (wt_dwell){.load_time = (double)NAN, .misfit = (double)NAN};
    dwell->reason = history_defect(history);
    gsl_quiet();
    hereditary_reserve(&t.law, MOST_TERMS);
    if (dwell->reason[0] == '\0')
        fit_relaxation(&t, &memory, dwell);
    arena_free(&memory);
    hereditary_clear(&t.law);
    return WT_OK;
}
