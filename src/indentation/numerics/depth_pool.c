/* Combined curves of a group: mean residual, fit of a law of the modulus against depth, and
 * derived numbers with errors.
 *
 * Each curve contributes to the parameters. The scatter of the contributions between spots is
 * their error, enlarged by the uncertainty of the weights. Shared effects do not scatter. A slope
 * change of all baselines may continue in contact, and the error includes that effect. It also
 * includes the uncertainty of the relaxation that represents loss.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/depth_pool.h"
#include "core/math/special.h"
#include "core/math/students_t.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    W = CURVE_WAVES,
    MAX_STEPS = 60, /* bisection alone reaches the last digit */
};

/* ---- force with a modulus that depends on depth ---------------------------------------------- */

depth_modulus depth_modulus_create(const depth_mean *m, depth_law law, const double *p)
{
    depth_modulus to = {.law = law, .level = p[DEPTH_LEVEL]};
    if (law == DEPTH_TIED) {
        to.ratio = exp(p[DEPTH_LEVEL] + m->tie.log_ratio);
        to.reach = m->tie.reach;
        to.slope = p[DEPTH_SLOPE];
    } else if (law == DEPTH_LAYER) {
        to.ratio = exp(p[DEPTH_RATIO]);
        to.reach = exp(p[DEPTH_REACH]);
    } else {
        to.slope = p[DEPTH_SLOPE];
        to.bend = law == DEPTH_QUADRATIC ? p[DEPTH_BEND] : 0.0;
    }
    return to;
}

double depth_log_modulus(const depth_modulus *l, double u)
{
    if (l->law == DEPTH_LAYER)
        return l->level + log(thin_layer_apparent_modulus(l->ratio, l->reach * u));
    if (l->law == DEPTH_TIED)
        return l->level + log(thin_layer_apparent_modulus(l->ratio, l->reach * u)) +
               (u - 1.0) * l->slope;
    return l->level +
           (u - 1.0) * (l->slope + (l->law == DEPTH_QUADRATIC ? l->bend * (u - 1.0) : 0.0));
}

/* Point with its bracket in the search for the equilibrium, and its previous depth with the excess
 * of the force there. */
typedef struct balance_point {
    size_t to; /* index of the point */
    double z, low, high, last, last_excess;
} balance_point;

/* Performs one step for n points at depths x. Returns the number of points that have not converged;
 * they come first afterwards. */
static size_t newton_step_points(const depth_mean *m, const depth_modulus *l, balance_point *b,
                                 double *x, size_t n, double force[DEPTH_POINTS])
{
    double g[DEPTH_POINTS], slope[DEPTH_POINTS];
    size_t left = 0;
    wt_contact_table_eval(m->table, x, n, g, slope);
    for (size_t j = 0; j < n; j++) {
        balance_point at = b[j];
        double next = x[j];
        const double e =
            m->reduced * (l != NULL ? exp(depth_log_modulus(l, slope[j] / m->widest)) : 1.0);
        const double excess_force = m->k * (at.z - next) - e * g[j];
        *(excess_force > 0.0 ? &at.low : &at.high) = next;
        /* Newton's step with constant E, then secants, as E depends on the depth. */
        const double fall = next == at.last ? m->k + e * slope[j]
                                            : (at.last_excess - excess_force) / (next - at.last);
        const double step = excess_force / fall;
        at.last = next;
        at.last_excess = excess_force;
        const bool is_converged = fabs(step) < 1e-13 * at.z;
        if (!is_converged)
            next = next + step > at.low && next + step < at.high ? next + step
                                                                 : 0.5 * (at.low + at.high);
        force[at.to] = m->k * (at.z - next);
        if (!is_converged) {
            b[left] = at;
            x[left++] = next;
        }
    }
    return left;
}

/* Computes the equilibrium force at positions from the contact point. l is NULL for the modulus of
 * the fit, whose forces are the start for the others. */
static void balance_forces(const depth_mean *m, const depth_modulus *l,
                           const double z[DEPTH_POINTS], double force[DEPTH_POINTS])
{
    balance_point b[DEPTH_POINTS];
    double x[DEPTH_POINTS];
    size_t n = 0;
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        force[i] = 0.0;
        if (z[i] > 0.0) {
            const double start = z[i] - m->fitted[i] / m->k;
            x[n] = l != NULL && start > 0.0 && start < z[i] ? start : 0.9 * z[i];
            b[n] = (balance_point){.to = i, .z = z[i], .high = z[i], .last = x[n]};
            n++;
        }
    }
    for (int i = 0; i < MAX_STEPS && n > 0; i++)
        n = newton_step_points(m, l, b, x, n, force);
}

/* Subtracts the line that a fit to the differences in the window, and to zeros before it, would
 * have. */
static void subtract_line(const depth_mean *m, const double *z, double *d)
{
    const double from = -m->baseline, to = m->length, n = to - from,
                 step = m->window / DEPTH_POINTS;
    const double middle = 0.5 * (from + to), spread = n * n * n / 12.0;
    double sum = 0.0, moment = 0.0;
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        sum += d[i] * step;
        moment += d[i] * (z[i] - middle) * step;
    }
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        d[i] -= sum / n + moment / spread * (z[i] - middle);
}

/* Position of a point of the window. */
static double depth_mean_point(const depth_mean *m, size_t i)
{
    return m->length - m->window * (1.0 - ((double)i + 0.5) / DEPTH_POINTS);
}

/* Computes the cosines of a force over the window, relative to the largest force. */
static void depth_mean_cosines(const depth_mean *m, const double d[DEPTH_POINTS], double wave[W])
{
    memset(wave, 0, W * sizeof *wave);
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        for (size_t j = 0; j < W; j++)
            wave[j] += 2.0 / DEPTH_POINTS * d[i] / m->force * m->cosine[i][j];
}

void depth_mean_waves(const depth_mean *m, const double *p, double wave[W])
{
    double z[DEPTH_POINTS], align_with_contact[DEPTH_POINTS], d[DEPTH_POINTS];
    const depth_modulus law = depth_modulus_create(m, m->law, p);
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        z[i] = depth_mean_point(m, i);
        align_with_contact[i] = z[i] - p[DEPTH_CONTACT] * m->depth;
    }
    balance_forces(m, &law, align_with_contact, d);
    for (size_t i = 0; i < DEPTH_POINTS; i++)
        d[i] -= m->fitted[i];
    subtract_line(m, z, d);
    depth_mean_cosines(m, d, wave);
}

/* Tabulates values at the points of the window that all fits of the mean curve share. */
static void depth_mean_prepare(depth_mean *m)
{
    double z[DEPTH_POINTS];
    for (size_t i = 0; i < DEPTH_POINTS; i++) {
        z[i] = depth_mean_point(m, i);
        for (size_t j = 0; j < W; j++)
            m->cosine[i][j] = cos(M_PI * (double)(j + 1) * ((double)i + 0.5) / DEPTH_POINTS);
    }
    balance_forces(m, NULL, z, m->fitted);
}

enum {
    LEAST_SPOTS =
        3, /* two spots have one degree of freedom and an interval of 13 standard errors */
    MAX_ITERATIONS = 50, /* limit of the least squares in four parameters */
};
static const double shape_error =
    0.01; /* relative error of the modulus due to the choice of the law */
static const double max_log_factor =
    4.0; /* largest log factor; at a factor of 55 one side is nearly rigid */

/* ---- fit of a law ---------------------------------------------------------------------------- */

static size_t parameter_count(depth_law law)
{
    return law == DEPTH_LINE || law == DEPTH_TIED ? 3 : 4;
}

/* Solves by the Cholesky factor of the scatter, so that each number is in units of its error. */
static void whiten_waves(const depth_mean *m, double x[W])
{
    gsl_matrix_const_view factor = gsl_matrix_const_view_array(m->factor, W, W);
    gsl_vector_view v = gsl_vector_view_array(x, W);
    gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, &factor.matrix, &v.vector);
}

static int depth_residual(const gsl_vector *p, void *user, gsl_vector *r)
{
    const depth_mean *m = user;
    double wave[W];
    for (size_t a = 0; a < p->size; a++)
        if (!(fabs(gsl_vector_get(p, a)) < max_log_factor))
            return GSL_EDOM;
    depth_mean_waves(m, p->data, wave);
    for (size_t j = 0; j < W; j++)
        wave[j] -= m->wave[j];
    whiten_waves(m, wave);
    for (size_t j = 0; j < W; j++)
        gsl_vector_set(r, j, wave[j]);
    return GSL_SUCCESS;
}

/* Derivatives by central differences. The step is absolute, because parameters may be nearly 0. */
static int depth_jacobian(const gsl_vector *at, void *user, gsl_matrix *jacobian)
{
    const depth_mean *m = user;
    const double step = 1e-4;
    for (size_t a = 0; a < at->size; a++) {
        double p[DEPTH_PARAMETERS], widening[W], less[W];
        for (size_t b = 0; b < at->size; b++)
            p[b] = gsl_vector_get(at, b);
        p[a] += step;
        depth_mean_waves(m, p, widening);
        p[a] -= 2.0 * step;
        depth_mean_waves(m, p, less);
        for (size_t j = 0; j < W; j++)
            widening[j] = (widening[j] - less[j]) / (2.0 * step);
        whiten_waves(m, widening);
        for (size_t j = 0; j < W; j++)
            gsl_matrix_set(jacobian, j, a, widening[j]);
    }
    return GSL_SUCCESS;
}

depth_fit depth_fit_law(depth_pool *d, depth_law law, const double *start, wt_error *err)
{
    depth_mean *m = &d->mean;
    const size_t n_p = parameter_count(law);
    const gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf problem = {
        .f = depth_residual, .df = depth_jacobian, .n = W, .p = n_p, .params = m};
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, W, n_p);
    depth_fit fit = {.law = law};
    gsl_vector_const_view from = gsl_vector_const_view_array(start, n_p);
    int info = 0;
    m->law = law;
    if (w == NULL) {
        (void)wt_fail(err, WT_E_MEMORY, "out of memory");
        return fit;
    }
    int status = gsl_multifit_nlinear_init(&from.vector, &problem, w);
    if (status == GSL_SUCCESS)
        status =
            gsl_multifit_nlinear_driver(MAX_ITERATIONS, 1e-8, 1e-10, 0.0, NULL, NULL, &info, w);
    if (status == GSL_SUCCESS || status == GSL_ENOPROG) { /* no further improvement: converged */
        double square[DEPTH_PARAMETERS * DEPTH_PARAMETERS];
        gsl_matrix_view inverse = gsl_matrix_view_array(square, n_p, n_p);
        const gsl_matrix *j = gsl_multifit_nlinear_jac(w);
        fit.is_valid = gsl_multifit_nlinear_covar(j, 1e-10, &inverse.matrix) == GSL_SUCCESS;
        for (size_t a = 0; a < n_p; a++) {
            fit.p[a] = gsl_vector_get(gsl_multifit_nlinear_position(w), a);
            fit.is_valid = fit.is_valid && gsl_matrix_get(&inverse.matrix, a, a) > 0.0;
            for (size_t b = 0; b < n_p; b++)
                for (size_t i = 0; i < W; i++)
                    fit.gain[a][i] +=
                        gsl_matrix_get(&inverse.matrix, a, b) * gsl_matrix_get(j, i, b);
        }
        gsl_blas_ddot(gsl_multifit_nlinear_residual(w), gsl_multifit_nlinear_residual(w),
                      &fit.left);
        const double rest = (double)(W - n_p), curves = (double)d->n;
        const double f = fit.left / (curves - 1.0) * (curves - rest) / rest;
        fit.excess = fmax(1.0, f);
        fit.p_value = gsl_cdf_fdist_Q(f, rest, curves - rest);
    }
    gsl_multifit_nlinear_free(w);
    return fit;
}

/* ---- curves and spots ------------------------------------------------------------------------ */

static int by_spot(const void *a, const void *b)
{
    const wt_curve_residuals *x = a, *y = b;
    return (x->spot > y->spot) - (x->spot < y->spot);
}

/* Computes the mean curve and its scatter. Returns false if the scatter matrix is singular. */
static bool compute_mean_curve(depth_pool *d, const wt_contact_table *table, double poisson_ratio)
{
    const double curves = (double)d->n;
    double modulus = 0.0, depth = 0.0, k = 0.0, g, slope;
    depth_mean *m = &d->mean;
    *m = (depth_mean){.table = table};
    for (size_t i = 0; i < d->n; i++) {
        const wt_curve_residuals *c = &d->curve[i];
        modulus += log(c->modulus) / curves;
        depth += c->depth / curves;
        k += c->spring_constant / curves;
        m->baseline += c->baseline / curves;
        m->window += c->window / curves;
        m->loss_error += c->loss_error / curves;
        for (size_t a = 0; a < W; a++)
            m->wave[a] += c->misfit[a] / curves;
    }
    for (size_t i = 0; i < d->n; i++)
        for (size_t a = 0; a < W; a++)
            for (size_t b = 0; b < W; b++)
                m->factor[a * W + b] += (d->curve[i].misfit[a] - m->wave[a]) *
                                        (d->curve[i].misfit[b] - m->wave[b]) /
                                        (curves * (curves - 1.0));
    wt_contact_table_eval(table, &depth, 1, &g, &slope);
    m->reduced = exp(modulus) / (1.0 - poisson_ratio * poisson_ratio);
    m->k = k;
    m->depth = depth;
    m->force = m->reduced * g;
    m->length = depth + m->force / k;
    m->widest = slope;
    gsl_matrix_view scatter = gsl_matrix_view_array(m->factor, W, W);
    return m->force > 0.0 && gsl_linalg_cholesky_decomp1(&scatter.matrix) == GSL_SUCCESS;
}

/* Moments of d->value over units. A unit is the mean over a spot, or a curve. */
static moments unit_moments(depth_pool *d)
{
    size_t unit = 0, in_unit = 0;
    for (size_t i = 0; i < d->n; i++) {
        const double value = d->value[i]; /* at or after d->value[unit] */
        if (i > 0 && (!d->by_spot || d->curve[i].spot != d->curve[i - 1].spot)) {
            d->value[unit++] /= (double)in_unit;
            in_unit = 0;
        }
        d->value[unit] = in_unit > 0 ? d->value[unit] + value : value;
        in_unit++;
    }
    d->value[unit++] /= (double)in_unit;
    return sample_moments(d->value, unit);
}

/* Computes the mean parabola of the baselines over the window if it is significant. */
static void find_common_bend(depth_pool *d)
{
    depth_mean *m = &d->mean;
    double z[DEPTH_POINTS], bend[DEPTH_POINTS];
    for (size_t i = 0; i < d->n; i++)
        d->value[i] = d->curve[i].curvature;
    const moments all = unit_moments(d);
    const double error = students_t_quantile(all.n - 1.0) * sqrt(all.variance / all.n);
    const double curvature = fabs(all.mean) > error ? all.mean : 0.0;
    const double middle = 0.5 * (m->length - m->baseline), n = m->length + m->baseline;
    for (size_t i = 0; i < DEPTH_POINTS;
         i++) { /* subtracts the line that the baseline fit includes */
        z[i] = depth_mean_point(m, i) - middle;
        bend[i] = curvature * (z[i] * z[i] - n * n / 12.0);
    }
    depth_mean_cosines(m, bend, m->bend);
}

double depth_projection(const depth_mean *m, const depth_fit *fit,
                        const double by[DEPTH_PARAMETERS], const double w[W])
{
    double white[W], sum = 0.0;
    memcpy(white, w, sizeof white);
    whiten_waves(m, white);
    for (size_t a = 0; a < parameter_count(fit->law); a++)
        for (size_t j = 0; j < W; j++)
            sum += by[a] * fit->gain[a][j] * white[j];
    return sum;
}

depth_value depth_estimate(depth_pool *d, const depth_fit *fit, double at,
                           const double by[DEPTH_PARAMETERS], bool with_level, double losses)
{
    const depth_mean *m = &d->mean;
    const double rest = (double)(W - parameter_count(fit->law));
    for (size_t i = 0; i < d->n; i++) {
        double wave[W];
        for (size_t a = 0; a < W; a++)
            wave[a] = d->curve[i].misfit[a] - m->wave[a];
        d->value[i] =
            at + depth_projection(m, fit, by, wave) + (with_level ? log(d->curve[i].modulus) : 0.0);
    }
    const moments all = unit_moments(d);
    /* The weights come from the same curves: Rao, Biometrika 54 (1967) 447. A significant lack of
     * fit also increases the error of the parameters. */
    const double curves = (double)d->n, left = fmax(1.0, curves - 1.0 - rest);
    const double widening = (curves - 1.0) / left * (1.0 + fit->left / (curves - 1.0));
    const double scatter = sqrt(all.variance / all.n * widening * fit->excess);
    return (depth_value){.mean = all.mean,
                         .scatter = {fit->law == DEPTH_LINE || fit->law == DEPTH_TIED
                                         ? scatter
                                         : hypot(scatter, shape_error),
                                     fmin(all.n - 1.0, left)},
                         .bend = depth_projection(m, fit, by, m->bend),
                         .loss = losses * m->loss_error};
}

void depth_pool_create(depth_pool *d, const wt_contact_table *table, double poisson_ratio,
                       const wt_curve_residuals *curve, size_t n, arena *memory)
{
    wt_curve_residuals *sorted = arena_alloc(memory, n, sizeof *sorted);
    *d = (depth_pool){.curve = sorted, .value = arena_numbers(memory, n)};
    gsl_quiet();
    for (size_t i = 0; i < n; i++)
        if (!isnan(curve[i].loss_error))
            sorted[d->n++] = curve[i];
    d->n_excluded_by_loss = n - d->n;
    if (d->n < WT_DEPTH_MIN_CURVES || d->n_excluded_by_loss >= d->n)
        return;
    qsort(sorted, d->n, sizeof *sorted, by_spot);
    d->n_units = 1;
    for (size_t i = 1; i < d->n; i++)
        d->n_units += sorted[i].spot != sorted[i - 1].spot;
    d->two_spots = d->n_units == 2;
    d->by_spot = d->n_units >= LEAST_SPOTS;
    if (!d->by_spot)
        d->n_units = d->n;
    d->has_mean = compute_mean_curve(d, table, poisson_ratio);
    if (d->has_mean) {
        depth_mean_prepare(&d->mean);
        find_common_bend(d);
    }
}
