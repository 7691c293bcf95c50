/* Does the modulus change with depth? The mean residual of the curves of a group says so where one
 * noisy curve does not.
 *
 * The first cosines of the residual over the contact (curve_lack.c) are those of the difference
 * between the force and that of the fit. A modulus E exp(a + b (u - 1)) at the contact radius u of
 * the largest one, with the contact point moved, makes such a difference: the three are fitted to
 * the mean of the curves, weighted by the scatter between them, together, for the contact point of
 * a fit with one modulus hides most of a change. What the cosines leave then follows the F
 * distribution whatever the noise; where it is too much, a square is fitted as well, or a layer on
 * other rubber. Each curve has
 * its share in the parameters, and the scatter of the shares between spots is their error,
 * enlarged by what is not known of the weights. What all curves share does not scatter: a bend that
 * their baselines have in common goes on in contact, nobody knows how, and what it does there if it
 * does is part of the errors; so is what is not known of the memory that stands for loss.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/array.h"
#include "base/gsl_quiet.h"
#include "base/pool.h"
#include "fit/indentation/depth_waves.h"
#include "fit/students_t.h"
#include "model/thin_layer.h"
#include "model/tip.h"

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
    LEAST_CURVES = 2 * W, /* the scatter has as many degrees of freedom as there are cosines */
    LEAST_SPOTS = 3,      /* two have a scatter of one degree of freedom, 13 standard errors wide */
    MAX_ITERATIONS = 50,  /* a bound of least squares in four parameters */
};
static const double level = 0.01; /* of a change, and of what is left: one group of 100 by chance */
static const double margin = WT_DEPTH_MARGIN; /* a change that does not matter */
/* Ends of the interval of a thickness, their ratio: one not known to a factor 2 is not told. */
static const double roughest = 4.0;
static const double shape_error = 0.01; /* of a modulus by a law that is one of several */
static const double largest_log = 4.0;  /* of a factor: of 55 one side is as good as rigid */
static const double more_shallow = 1.5; /* of the error of a memory, at no depth */

static size_t n_parameters(depth_law law)
{
    return law == DEPTH_LINE ? 3 : 4;
}

/* x solved by the factor of the scatter: of the size of its error each. */
static void whiten(const depth_mean *m, double x[W])
{
    gsl_matrix_const_view factor = gsl_matrix_const_view_array(m->factor, W, W);
    gsl_vector_view v = gsl_vector_view_array(x, W);
    gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, &factor.matrix, &v.vector);
}

static int residual_of(const gsl_vector *p, void *user, gsl_vector *r)
{
    const depth_mean *m = user;
    double wave[W];
    for (size_t a = 0; a < p->size; a++)
        if (!(fabs(gsl_vector_get(p, a)) < largest_log))
            return GSL_EDOM;
    depth_mean_waves(m, p->data, wave);
    for (size_t j = 0; j < W; j++)
        wave[j] -= m->wave[j];
    whiten(m, wave);
    for (size_t j = 0; j < W; j++)
        gsl_vector_set(r, j, wave[j]);
    return GSL_SUCCESS;
}

/* By differences, whose steps must not shrink with parameters that are nearly 0. */
static int derivatives_of(const gsl_vector *at, void *user, gsl_matrix *jacobian)
{
    const depth_mean *m = user;
    const double step = 1e-4;
    for (size_t a = 0; a < at->size; a++) {
        double p[DEPTH_PARAMETERS], more[W], less[W];
        for (size_t b = 0; b < at->size; b++)
            p[b] = gsl_vector_get(at, b);
        p[a] += step;
        depth_mean_waves(m, p, more);
        p[a] -= 2.0 * step;
        depth_mean_waves(m, p, less);
        for (size_t j = 0; j < W; j++)
            more[j] = (more[j] - less[j]) / (2.0 * step);
        whiten(m, more);
        for (size_t j = 0; j < W; j++)
            gsl_matrix_set(jacobian, j, a, more[j]);
    }
    return GSL_SUCCESS;
}

typedef struct depth_fit {
    depth_law law;
    double p[DEPTH_PARAMETERS];
    double gain[DEPTH_PARAMETERS][W]; /* of the parameters by the whitened waves */
    double left;                      /* of the squares */
    double excess;                    /* of them over what scatter leaves; 1 at least */
    double chance;                    /* of more by scatter alone */
    bool good;
} depth_fit;

/* Least squares from p; n: curves. */
static depth_fit fit_law(depth_mean *m, depth_law law, const double *start, size_t n, wt_error *err)
{
    const size_t n_p = n_parameters(law);
    const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf problem = {
        .f = residual_of, .df = derivatives_of, .n = W, .p = n_p, .params = m};
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, W, n_p);
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
    if (status == GSL_SUCCESS || status == GSL_ENOPROG) { /* no step that helps: it is there */
        double square[DEPTH_PARAMETERS * DEPTH_PARAMETERS];
        gsl_matrix_view inverse = gsl_matrix_view_array(square, n_p, n_p);
        const gsl_matrix *j = gsl_multifit_nlinear_jac(w);
        fit.good = gsl_multifit_nlinear_covar(j, 1e-10, &inverse.matrix) == GSL_SUCCESS;
        for (size_t a = 0; a < n_p; a++) {
            fit.p[a] = gsl_vector_get(gsl_multifit_nlinear_position(w), a);
            fit.good = fit.good && gsl_matrix_get(&inverse.matrix, a, a) > 0.0;
            for (size_t b = 0; b < n_p; b++)
                for (size_t i = 0; i < W; i++)
                    fit.gain[a][i] +=
                        gsl_matrix_get(&inverse.matrix, a, b) * gsl_matrix_get(j, i, b);
        }
        gsl_blas_ddot(gsl_multifit_nlinear_residual(w), gsl_multifit_nlinear_residual(w),
                      &fit.left);
        const double rest = (double)(W - n_p), curves = (double)n;
        const double f = fit.left / (curves - 1.0) * (curves - rest) / rest;
        fit.excess = fmax(1.0, f);
        fit.chance = gsl_cdf_fdist_Q(f, rest, curves - rest);
    }
    gsl_multifit_nlinear_free(w);
    return fit;
}

/* ---- curves and spots ------------------------------------------------------------------------ */

typedef struct depth_pool {
    const wt_depth_curve *curve; /* [n] by spot */
    size_t n, n_units;
    bool by_spot;
    depth_mean mean;
    double *value; /* [n], then of the units */
} depth_pool;

static int by_spot(const void *a, const void *b)
{
    const wt_depth_curve *x = a, *y = b;
    return (x->spot > y->spot) - (x->spot < y->spot);
}

/* Mean curve and scatter; false if the scatter has no inverse. */
static bool make_mean(depth_pool *d, const wt_contact_table *table, double poisson_ratio)
{
    const double curves = (double)d->n;
    double modulus = 0.0, depth = 0.0, k = 0.0, g, slope;
    depth_mean *m = &d->mean;
    *m = (depth_mean){.table = table};
    for (size_t i = 0; i < d->n; i++) {
        const wt_depth_curve *c = &d->curve[i];
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

/* Mean of d->value of the curves over each spot, or of each curve. */
static moments over_units(depth_pool *d)
{
    size_t unit = 0, in_unit = 0;
    for (size_t i = 0; i < d->n; i++) {
        const double value = d->value[i]; /* not before d->value[unit] */
        if (i > 0 && (!d->by_spot || d->curve[i].spot != d->curve[i - 1].spot)) {
            d->value[unit++] /= (double)in_unit;
            in_unit = 0;
        }
        d->value[unit] = in_unit > 0 ? d->value[unit] + value : value;
        in_unit++;
    }
    d->value[unit++] /= (double)in_unit;
    return moments_of(d->value, unit);
}

/* The parabola of the baselines over the window, if it is more than they scatter. */
static void find_bend(depth_pool *d)
{
    depth_mean *m = &d->mean;
    double z[DEPTH_POINTS], bend[DEPTH_POINTS];
    for (size_t i = 0; i < d->n; i++)
        d->value[i] = d->curve[i].curvature;
    const moments all = over_units(d);
    const double error = students_t_quantile(all.n - 1.0) * sqrt(all.variance / all.n);
    const double curvature = fabs(all.mean) > error ? all.mean : 0.0;
    const double middle = 0.5 * (m->length - m->baseline), n = m->length + m->baseline;
    for (size_t i = 0; i < DEPTH_POINTS; i++) { /* less the line it is fitted with, all along */
        z[i] = depth_mean_point(m, i) - middle;
        bend[i] = curvature * (z[i] * z[i] - n * n / 12.0);
    }
    depth_mean_cosines(m, bend, m->bend);
}

/* What the waves w add to a number with these derivatives by the parameters. */
static double share_of(const depth_mean *m, const depth_fit *fit, const double by[DEPTH_PARAMETERS],
                       const double w[W])
{
    double white[W], sum = 0.0;
    memcpy(white, w, sizeof white);
    whiten(m, white);
    for (size_t a = 0; a < n_parameters(fit->law); a++)
        for (size_t j = 0; j < W; j++)
            sum += by[a] * fit->gain[a][j] * white[j];
    return sum;
}

typedef struct depth_number {
    wt_interval interval;
    double chance;                 /* of the logarithm being 0 */
    double bend_share, loss_share; /* of its variance */
} depth_number;

/* A number of the curves: `at` for the parameters of the fit, its derivatives by them, and
 * with_level: with ln E of each curve; losses: errors of the memory in it. By Student's t over the
 * units. */
static depth_number number_of(depth_pool *d, const depth_fit *fit, double at,
                              const double by[DEPTH_PARAMETERS], bool with_level, double losses)
{
    const depth_mean *m = &d->mean;
    const double rest = (double)(W - n_parameters(fit->law));
    for (size_t i = 0; i < d->n; i++) {
        double wave[W];
        for (size_t a = 0; a < W; a++)
            wave[a] = d->curve[i].misfit[a] - m->wave[a];
        d->value[i] =
            at + share_of(m, fit, by, wave) + (with_level ? log(d->curve[i].modulus) : 0.0);
    }
    const moments all = over_units(d);
    /* The weights are of the same curves: Rao, Biometrika 54 (1967) 447. And where the law leaves
     * more than scatter, its parameters are off by as much. */
    const double curves = (double)d->n, left = fmax(1.0, curves - 1.0 - rest);
    const double df = fmin(all.n - 1.0, left);
    const double more = (curves - 1.0) / left * (1.0 + fit->left / (curves - 1.0));
    const double scatter = sqrt(all.variance / all.n * more * fit->excess);
    const double bend = share_of(m, fit, by, m->bend), loss = losses * m->loss_error;
    const double own = fit->law == DEPTH_LINE ? scatter : hypot(scatter, shape_error);
    const double error = hypot(own, hypot(bend, loss));
    const double reach = students_t_quantile(df) * error;
    const double value = exp(all.mean);
    return (depth_number){
        .interval = {value, value * error, exp(all.mean - reach), exp(all.mean + reach)},
        .chance = 2.0 * gsl_cdf_tdist_Q(fabs(all.mean) / error, df),
        .bend_share = bend * bend / (error * error),
        .loss_share = loss * loss / (error * error)};
}

/* ---- what is told ---------------------------------------------------------------------------- */

/* ln of the modulus over that of the fit at a share of the depth, and its derivatives. */
static double at_depth(const depth_mean *m, const depth_fit *fit, double share,
                       double by[DEPTH_PARAMETERS])
{
    const double depth = share * m->depth, step = 1e-5;
    double g, slope, p[DEPTH_PARAMETERS];
    wt_contact_table_eval(m->table, &depth, 1, &g, &slope);
    depth_modulus law = depth_modulus_of(fit->law, fit->p);
    const double u = slope / m->widest, value = depth_log_modulus(&law, u);
    memcpy(p, fit->p, sizeof p);
    for (size_t a = 0; a < DEPTH_PARAMETERS; a++) {
        p[a] += step;
        law = depth_modulus_of(fit->law, p);
        by[a] = (depth_log_modulus(&law, u) - value) / step;
        p[a] = fit->p[a];
    }
    return value;
}

/* The modulus at shares of the depth, and the change from the first to the last. */
static void tell_depths(depth_pool *d, const depth_fit *fit, wt_curve_depth *to)
{
    double first[DEPTH_PARAMETERS] = {0.0}, by[DEPTH_PARAMETERS], top = 0.0;
    for (size_t i = 0; i < WT_DEPTHS; i++) {
        const double share = (double)(i + 1) / WT_DEPTHS;
        const double at = at_depth(&d->mean, fit, share, by);
        to->depth[i] = share * d->mean.depth;
        to->modulus[i] =
            number_of(d, fit, at, by, true, 1.0 + more_shallow * (1.0 - share)).interval;
        if (i == 0) {
            memcpy(first, by, sizeof first);
            top = at;
        }
        if (i + 1 < WT_DEPTHS)
            continue;
        for (size_t a = 0; a < DEPTH_PARAMETERS; a++)
            by[a] -= first[a];
        const depth_number change =
            number_of(d, fit, at - top, by, false, more_shallow * (1.0 - 1.0 / WT_DEPTHS));
        to->change = change.interval;
        to->chance = change.chance;
        to->bend_share = change.bend_share;
        to->loss_share = change.loss_share;
    }
}

/* A layer thinner than the indentation that would look the same, by how the modulus changes. */
static depth_fit fit_layer(depth_pool *d, double log_change, wt_error *err)
{
    static const double reaches[] = {0.7, 1.2, 2.0}; /* contact radius over thickness */
    depth_fit best = {.good = false};
    for (size_t i = 0; i < COUNT_OF(reaches); i++) {
        const double start[] = {0.0, -0.5 * log_change, -1.5 * log_change, log(reaches[i])};
        const depth_fit fit = fit_law(&d->mean, DEPTH_LAYER, start, d->n, err);
        if (fit.good && (!best.good || fit.left < best.left))
            best = fit;
    }
    return best;
}

/* Its three numbers, where the mean curve tells them. */
static void read_layer(depth_pool *d, wt_curve_depth *to, wt_error *err)
{
    const depth_fit fit = fit_layer(d, log(to->change.value), err);
    const double ratio = exp(fit.p[DEPTH_RATIO]), reach = exp(fit.p[DEPTH_REACH]);
    if (contact_table_tip(d->mean.table)->sample_thickness > 0.0 || !fit.good ||
        fit.chance < level || !thin_layer_holds(ratio, reach) || (ratio > 0.6 && ratio < 1.6) ||
        reach < 0.7 || reach > 2.5)
        return;
    const double of_layer[] = {0.0, 1.0, 0.0, 0.0}, of_ground[] = {0.0, 1.0, -1.0, 0.0},
                 of_thickness[] = {0.0, 0.0, 0.0, -1.0};
    const wt_interval thickness =
        number_of(d, &fit, log(0.5 * d->mean.widest) - fit.p[DEPTH_REACH], of_thickness, false, 1.0)
            .interval;
    if (thickness.high > roughest * thickness.low)
        return;
    to->thickness = thickness;
    to->layer_modulus = number_of(d, &fit, fit.p[DEPTH_LEVEL], of_layer, true, 1.0).interval;
    to->ground_modulus =
        number_of(d, &fit, fit.p[DEPTH_LEVEL] - fit.p[DEPTH_RATIO], of_ground, true, 1.0).interval;
}

/* Too little to matter, whichever way. */
static bool is_small(const wt_curve_depth *d)
{
    return d->change.low > 1.0 / (1.0 + margin) && d->change.high < 1.0 + margin;
}

/* What the change says: shown, of no matter, or neither. */
static void judge(const depth_fit *fit, wt_curve_depth *to)
{
    to->misfit_chance = fit->chance;
    to->verdict = to->chance < level    ? WT_DEPTH_CHANGES
                  : fit->chance < level ? WT_DEPTH_OTHERWISE
                  : is_small(to)        ? WT_DEPTH_SAME
                                        : WT_DEPTH_CANNOT_SAY;
}

static wt_status make(depth_pool *d, wt_curve_depth *to, wt_error *err)
{
    const double start[DEPTH_PARAMETERS] = {0.0};
    wt_error failure = WT_ERROR_INIT;
    depth_fit fit = fit_law(&d->mean, DEPTH_LINE, start, d->n, &failure);
    if (fit.good && fit.chance < level) {
        const depth_fit other[] = {fit_law(&d->mean, DEPTH_BENT, fit.p, d->n, &failure),
                                   fit_layer(d, fit.p[DEPTH_SLOPE], &failure)};
        for (size_t i = 0; i < COUNT_OF(other); i++)
            if (other[i].good && other[i].chance > fit.chance)
                fit = other[i];
    }
    if (fit.good && failure.status == WT_OK) {
        tell_depths(d, &fit, to);
        judge(&fit, to);
    }
    if (to->verdict == WT_DEPTH_CHANGES) {
        const depth_fit bent = fit_law(&d->mean, DEPTH_BENT, fit.p, d->n, &failure);
        const double chance = to->chance;
        if (fit.law == DEPTH_LINE && bent.good) /* that it is a line nobody says */
            tell_depths(d, &bent, to);
        to->chance = chance;
        if (is_small(to) && to->change.low < 1.0 && to->change.high > 1.0)
            to->verdict = WT_DEPTH_SAME;
        else
            read_layer(d, to, &failure);
    }
    if (failure.status == WT_OK)
        return WT_OK;
    if (err != NULL)
        *err = failure;
    return failure.status;
}

wt_status wt_curve_depth_make(const wt_contact_table *table, double poisson_ratio,
                              const wt_depth_curve *curve, size_t n, wt_curve_depth *to,
                              wt_error *err)
{
    const double unknown = (double)NAN;
    const wt_interval nothing = {unknown, unknown, unknown, unknown};
    pool memory = {0};
    wt_depth_curve *sorted = pool_alloc(&memory, n, sizeof *sorted);
    depth_pool d = {.curve = sorted, .value = pool_numbers(&memory, n)};
    wt_status status = WT_OK;
    gsl_quiet();
    for (size_t i = 0; i < n && !memory.failed; i++)
        if (!isnan(curve[i].loss_error))
            sorted[d.n++] = curve[i];
    *to = (wt_curve_depth){.n = d.n,
                           .n_lossy = n - d.n,
                           .chance = unknown,
                           .misfit_chance = unknown,
                           .change = nothing,
                           .layer_modulus = nothing,
                           .ground_modulus = nothing,
                           .thickness = nothing};
    if (memory.failed) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    } else if (d.n >= LEAST_CURVES && to->n_lossy < d.n) {
        qsort(sorted, d.n, sizeof *sorted, by_spot);
        d.n_units = 1;
        for (size_t i = 1; i < d.n; i++)
            d.n_units += sorted[i].spot != sorted[i - 1].spot;
        d.by_spot = d.n_units >= LEAST_SPOTS;
        to->by_spot = d.by_spot;
        to->n_units = d.by_spot ? d.n_units : d.n;
        if (make_mean(&d, table, poisson_ratio)) {
            depth_mean_prepare(&d.mean);
            find_bend(&d);
            status = make(&d, to, err);
        }
    }
    pool_free(&memory);
    return status;
}
