/* Interval of the layer thickness that the curves of the track allow.
 *
 * One curve does not determine both moduli and the thickness. The modulus of the bulk is measured
 * next to the track, so the ratio of the homogeneous fits is known. Each thickness then leaves one
 * free parameter, the modulus of the layer, and predicts the change of the modulus with depth. The
 * file fits a law of that layer with an additional slope to the mean curve (see modulus_depth.c).
 * The slope must equal that of the bulk, where no layer exists, within the errors. The interval
 * contains all thicknesses that pass this test at 5 %, so it may be bounded on one side. If the
 * ratio does not distinguish layer and bulk, the error of the slope due to the ratio lets every
 * thickness pass.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/depth_pool.h"
#include "weartrack/indentation.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum { POINTS = 2000, RATIOS = 241 }; /* steps of 1 % */

static const double widest_ratio = 8.0; /* in ln; ratios beyond 3000 are not searched */

/* Significance level of a "no". It is below the customary 5 % as a reserve for intervals that are
 * too narrow. */
static const double no_level = 0.01;

static const double source_range = 6.0; /* range in standard errors of the other source */

/* ---- comparison with another source ---------------------------------------------------------- */

/* Comparison of the layer thickness from the curves with another source (theory, or a section
 * under the microscope). The curves have a deviate for each thickness, the other source one of its
 * logarithm by its interval. The sum of both squares measures the deviation of a thickness. */

/* Logarithm of the other thickness: value, and standard errors below and above. */
typedef struct comparison_source {
    double at, below, above;
} comparison_source;

static double source_squared_deviation(const comparison_source *o, double x)
{
    const double deviation = x - o->at, error = deviation < 0 ? o->below : o->above;
    return isinf(error) ? 0.0 : deviation * deviation / (error * error);
}

/* Squared deviate of the curves with linear interpolation. Thicker layers have that of the first
 * step. The curves do not constrain layers below the range of the law if `below` is true. */
static double curve_squared_deviation(const wt_layer_profile *p, double x)
{
    size_t i = 1;
    if (x >= p->log_thickness[0])
        return p->deviate[0] * p->deviate[0];
    if (p->thinner_allowed && x < p->log_thickness[p->n_steps - 1])
        return 0.0;
    while (i + 1 < p->n_steps && x < p->log_thickness[i])
        i++;
    const double step = p->log_thickness[i] - p->log_thickness[i - 1],
                 part = fmin(1.0, (x - p->log_thickness[i - 1]) / step),
                 z = p->deviate[i - 1] + part * (p->deviate[i] - p->deviate[i - 1]);
    return z * z;
}

/* Smallest sum of squares if ln of the thickness by the curves exceeds the other by `shift`. */
static double min_squared_deviation(const double x[POINTS], const double curve_squares[POINTS],
                                    const comparison_source *o, double shift)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < POINTS; i++)
        least = fmin(least, curve_squares[i] + source_squared_deviation(o, x[i] - shift));
    return least;
}

/* Finds the joint interval from the sum of squares minus its minimum. */
static void find_joint_interval(const double x[POINTS], const double curve_squares[POINTS],
                                const comparison_source *o, double limit, wt_layer_agreement *to)
{
    const double least = min_squared_deviation(x, curve_squares, o, 0.0);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < POINTS; i++)
        if (curve_squares[i] + source_squared_deviation(o, x[i]) <= least + limit) {
            low = fmin(low, x[i]);
            high = fmax(high, x[i]);
        }
    to->low = low > x[0] ? exp(low) : 0.0;
    to->high = high < x[POINTS - 1] ? exp(high) : (double)HUGE_VAL;
}

static void find_ratio_interval(const double x[POINTS], const double curve_squares[POINTS],
                                const comparison_source *o, double limit, wt_layer_agreement *to)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < RATIOS; i++) {
        const double shift = widest_ratio * (2.0 * i / (RATIOS - 1) - 1.0);
        if (min_squared_deviation(x, curve_squares, o, shift) > limit)
            continue;
        low = fmin(low, shift);
        high = fmax(high, shift);
    }
    to->ratio_low = low <= -widest_ratio ? 0.0 : exp(low);
    to->ratio_high = high >= widest_ratio ? (double)HUGE_VAL : exp(high);
}

wt_layer_agreement wt_layer_compare(const wt_layer_profile *p, wt_interval other)
{
    const double quantile = gsl_cdf_ugaussian_Pinv(0.975), limit = quantile * quantile;
    const double none = (double)NAN;
    wt_layer_agreement to = {none, none, none, none, false, false};
    double x[POINTS], curve_squares[POINTS];
    if (p->n_steps < 2 || !(other.value > 0) || !(other.high >= other.value) ||
        !(other.low <= other.value))
        return to;
    const comparison_source o = {
        log(other.value),
        other.low > 0 ? log(other.value / other.low) / quantile : (double)HUGE_VAL,
        isfinite(other.high) ? log(other.high / other.value) / quantile : (double)HUGE_VAL};
    const double low = fmin(p->log_thickness[p->n_steps - 1],
                            isinf(o.below) ? o.at : o.at - source_range * o.below) -
                       widest_ratio,
                 high = fmax(p->log_thickness[0],
                             isinf(o.above) ? o.at : o.at + source_range * o.above) +
                        widest_ratio;
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = low + (high - low) * (double)i / (POINTS - 1);
        curve_squares[i] = curve_squared_deviation(p, x[i]);
    }
    find_ratio_interval(x, curve_squares, &o, limit, &to);
    to.differ = gsl_cdf_chisq_Q(min_squared_deviation(x, curve_squares, &o, 0.0), 1.0) < no_level;
    to.agree = to.ratio_low >= 1.0 / WT_LAYER_MARGIN && to.ratio_high <= WT_LAYER_MARGIN;
    if (!to.differ)
        find_joint_interval(x, curve_squares, &o, limit, &to);
    return to;
}

/* ---- thickness by the curves ----------------------------------------------------------------- */

/* Range of thickness over contact radius. The upper limit is nearly an infinite layer (1e-3 of the
 * change remains), the lower one is near the end of the range of the law. */
static const double thickest = 1000.0, thinnest = 1.0 / 5.9;
enum { HALVES = 60 }; /* more than the binary digits of a double */
/* Relative error of the predicted change over depth. The law is accurate to 2 % of the modulus for
 * a ratio of 3, which is 2 % of the change. The contact point, fitted together with the slope,
 * increases it up to threefold. */
static const double law_error_share = 0.06;

/* Finds ln(E1/E2) of a layer with ln(E_app/E2) = log_ratio at x = contact radius over thickness.
 * The result is NaN outside the range of the law. */
static double layer_log_ratio(double log_ratio, double x)
{
    double low = -2.0, high = 2.0; /* beyond the range of the law */
    for (int i = 0; i < HALVES; i++) {
        const double middle = 0.5 * (low + high);
        const double apparent = middle + log(thin_layer_apparent_modulus(exp(middle), x));
        *(apparent < log_ratio ? &low : &high) = middle;
    }
    return thin_layer_is_valid(exp(low), x) ? low : (double)NAN;
}

double wt_layer_modulus(const wt_layer_profile *profile, double ratio, double thickness,
                        double contact_radius)
{
    const double layer_log_modulus =
        layer_log_ratio(log(ratio), profile->contact_radius / thickness);
    const double layer = exp(layer_log_modulus), x = contact_radius / thickness;
    return !isnan(layer_log_modulus) && thin_layer_is_valid(layer, x)
               ? layer * thin_layer_apparent_modulus(layer, x)
               : (double)NAN;
}

/* Change of ln of the modulus over depth that two rubbers under one tip may differ by without a
 * layer (relaxation, weak adhesion). It equals the error due to the choice of a law elsewhere
 * (depth_pool.c). */
static const double material_difference = 0.01;

/* Thickness with the fit of its law; the first is infinite. */
typedef struct layer_step {
    depth_tie tie;
    depth_fit fit;
} layer_step;

/* Curves of bulk and track, and the slope of the bulk. */
typedef struct layer_test {
    depth_pool arena[2];
    depth_value bulk;
    wt_estimate log_ratio;
    double ratio_df;
    layer_step step[WT_LAYER_STEPS];
} layer_test;

static const double slope_gradient[DEPTH_PARAMETERS] = {
    [DEPTH_SLOPE] = 1.0}; /* derivatives of the slope itself */

/* Derivative of the slope of the track by ln of the ratio. */
static double ratio_sensitivity(depth_mean *m, const depth_fit *fit)
{
    const double at = m->tie.log_ratio, step = 1e-4;
    double more[CURVE_WAVES], less[CURVE_WAVES];
    if (fit->law != DEPTH_TIED)
        return 0.0;
    m->tie.log_ratio = at + step;
    depth_mean_waves(m, fit->p, more);
    m->tie.log_ratio = at - step;
    depth_mean_waves(m, fit->p, less);
    m->tie.log_ratio = at;
    for (size_t i = 0; i < CURVE_WAVES; i++)
        more[i] = (more[i] - less[i]) / (2.0 * step);
    return -depth_projection(m, fit, slope_gradient, more);
}

/* Difference of the additional slope to that of the bulk as a standard normal deviate. `excess` is
 * the smallest lack of fit over all thicknesses, because that of a wrong thickness is no error. */
static double slope_deviate(layer_test *t, const layer_step *step, double excess)
{
    depth_pool *track = &t->arena[1];
    depth_fit for_all = step->fit;
    const depth_fit *const fit = &for_all;
    for_all.excess = excess;
    track->mean.tie = step->tie;
    const depth_value v = depth_estimate(track, fit, fit->p[DEPTH_SLOPE], slope_gradient, false,
                                         DEPTH_SHALLOW_FACTOR);
    const double of_law = law_error_share * (fit->p[DEPTH_SLOPE] - t->step[0].fit.p[DEPTH_SLOPE]);
    const double of_ratio =
        fabs(ratio_sensitivity(&track->mean, fit)) * t->log_ratio.standard_error;
    const t_error parts[] = {v.scatter, t->bulk.scatter, {of_ratio, t->ratio_df}};
    const double shared = pow(v.bend - t->bulk.bend, 2) + pow(v.loss - t->bulk.loss, 2) +
                          of_law * of_law + material_difference * material_difference;
    const t_error error = t_error_add_normal(t_error_sum(parts, COUNT_OF(parts)), shared);
    const double ratio = (v.mean - t->bulk.mean) / error.error;
    const double most = 30.0; /* limit beyond the precision of the normal distribution */
    const double beyond = gsl_cdf_tdist_Q(fabs(ratio), error.df);
    return copysign(beyond > 0.0 ? fmin(gsl_cdf_ugaussian_Qinv(beyond), most) : most, ratio);
}

/* Fits the law at a thickness. Returns false outside its range or without convergence. */
static bool fit_thickness_step(layer_test *t, double log_thickness, layer_step *to, wt_error *err)
{
    depth_mean *m = &t->arena[1].mean;
    const double reach = 0.5 * m->widest / exp(log_thickness);
    const double layer_log_modulus = layer_log_ratio(t->log_ratio.value, reach);
    if (isnan(layer_log_modulus))
        return false;
    m->tie = (depth_tie){reach, t->log_ratio.value};
    const double start[] = {0.0, layer_log_modulus - t->log_ratio.value, 0.0};
    *to = (layer_step){m->tie, depth_fit_law(&t->arena[1], DEPTH_TIED, start, err)};
    return to->fit.is_valid &&
           thin_layer_is_valid(exp(to->fit.p[DEPTH_LEVEL] + t->log_ratio.value), reach);
}

/* ---- the interval ---------------------------------------------------------------------------- */

/* Extends the interval by the allowed part between two steps, with linear interpolation of the
 * deviate. */
static void extend_allowed_range(const double x[2], const double z[2], double limit,
                                 double range[2])
{
    double ends[2] = {0.0, 1.0}; /* shares of the way from the first to the second step */
    const double slope = z[1] - z[0];
    if (fabs(z[0]) > limit && fabs(z[1]) > limit && (z[0] > 0) == (z[1] > 0))
        return;
    if (fabs(z[0]) > limit)
        ends[0] = (copysign(limit, z[0]) - z[0]) / slope;
    if (fabs(z[1]) > limit)
        ends[1] = (copysign(limit, z[1]) - z[0]) / slope;
    for (int i = 0; i < 2; i++) {
        const double at = x[0] + ends[i] * (x[1] - x[0]);
        range[0] = fmin(range[0], at);
        range[1] = fmax(range[1], at);
    }
}

/* Returns where the deviate is 0, or the step nearest to it. */
static double find_zero_deviate(const wt_layer_profile *p)
{
    size_t nearest = 0;
    for (size_t i = 1; i < p->n_steps; i++) {
        const double z0 = p->deviate[i - 1], z1 = p->deviate[i];
        nearest = fabs(z1) < fabs(p->deviate[nearest]) ? i : nearest;
        if ((z0 > 0) != (z1 > 0))
            return p->log_thickness[i - 1] +
                   z0 / (z0 - z1) * (p->log_thickness[i] - p->log_thickness[i - 1]);
    }
    return p->log_thickness[nearest];
}

/* Sets the interval. Thinner layers predict a larger change over depth, upwards for a soft layer.
 * If the thinnest layer is not allowed, it excludes all thinner ones only if its change is too
 * large. */
static void assess_profile(wt_layer_profile *p, double log_ratio)
{
    const double limit = gsl_cdf_ugaussian_Pinv(0.975);
    double range[2] = {HUGE_VAL, -HUGE_VAL};
    const size_t last = p->n_steps - 1;
    for (size_t i = 1; i < p->n_steps; i++)
        extend_allowed_range(&p->log_thickness[i - 1], &p->deviate[i - 1], limit, range);
    const bool soft = log_ratio < 0.0;
    const bool too_much = soft ? p->deviate[last] < -limit : p->deviate[last] > limit;
    const bool open_below =
        fabs(p->deviate[last]) <= limit || (!too_much && soft == (p->deviate[0] > 0));
    p->thinner_allowed = open_below;
    const bool open_above = fabs(p->deviate[0]) <= limit, has_allowed = range[1] >= range[0];
    p->thickness = (wt_interval){.value = (double)NAN,
                                 .standard_error = (double)NAN,
                                 .low = open_below ? 0.0 : exp(range[0]),
                                 .high = open_above    ? (double)INFINITY
                                         : has_allowed ? exp(range[1])
                                                       : p->smallest_thickness};
    p->bound_kind = open_below && open_above ? WT_LAYER_BOUND_ANY
                    : open_above             ? WT_LAYER_BOUND_LOWER
                    : open_below             ? WT_LAYER_BOUND_UPPER
                    : has_allowed            ? WT_LAYER_BOUND_BOTH
                                             : WT_LAYER_BOUND_EMPTY;
    if (p->bound_kind == WT_LAYER_BOUND_BOTH)
        p->thickness.value = exp(find_zero_deviate(p));
    if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        p->thickness.low = p->thickness.high = (double)NAN;
}

static wt_status compute_profile(layer_test *t, wt_layer_profile *p, wt_error *err)
{
    const double start[DEPTH_PARAMETERS] = {0.0};
    wt_error failure = WT_ERROR_INIT;
    const depth_fit bulk = depth_fit_law(&t->arena[0], DEPTH_LINE, start, &failure),
                    line = depth_fit_law(&t->arena[1], DEPTH_LINE, start, &failure);
    const double top = log(thickest * p->contact_radius), end = log(thinnest * p->contact_radius);
    const double ratio = (end - top) / (WT_LAYER_STEPS - 1);
    if (bulk.is_valid && line.is_valid) {
        t->bulk = depth_estimate(&t->arena[0], &bulk, bulk.p[DEPTH_SLOPE], slope_gradient, false,
                                 DEPTH_SHALLOW_FACTOR);
        p->log_thickness[0] = top;
        t->step[0].fit = line; /* nearly infinite */
        p->n_steps = 1;
    }
    if (p->n_steps == 1 && isnan(layer_log_ratio(t->log_ratio.value, 0.0)))
        p->bound_kind = WT_LAYER_BOUND_OUTSIDE_LAW;
    double excess = line.excess;
    for (size_t i = 1; p->n_steps == i && i < WT_LAYER_STEPS; i++) {
        p->log_thickness[i] = top + ratio * (double)i;
        if (fit_thickness_step(t, p->log_thickness[i], &t->step[i], &failure)) {
            excess = fmin(excess, t->step[i].fit.excess);
            p->n_steps++;
        }
    }
    for (size_t i = 0; i < p->n_steps; i++)
        p->deviate[i] = slope_deviate(t, &t->step[i], excess);
    if (failure.status != WT_OK) {
        if (err != NULL)
            *err = failure;
        return failure.status;
    }
    if (p->n_steps < 2)
        return WT_OK;
    p->smallest_thickness = exp(p->log_thickness[p->n_steps - 1]);
    assess_profile(p, t->log_ratio.value);
    return WT_OK;
}

wt_status wt_layer_profile_compute(const wt_contact_table *const table[2], double poisson_ratio,
                                   const wt_curve_residuals *const curve[2], const size_t n[2],
                                   wt_estimate log_ratio, double ratio_df,
                                   wt_layer_profile *profile, wt_error *err)
{
    arena memory = {0};
    layer_test t = {.log_ratio = log_ratio, .ratio_df = ratio_df};
    wt_status status = WT_OK;
    bool thick = true;
    *profile = (wt_layer_profile){.thickness = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                                  .smallest_thickness = (double)NAN};
    for (int g = 0; g < 2; g++) {
        depth_pool_create(&t.arena[g], table[g], poisson_ratio, curve[g], n[g], &memory);
        profile->n[g] = t.arena[g].n;
        profile->n_units[g] = t.arena[g].n_units;
        thick = thick &&
                !(thin_sample_radius_ratio(contact_table_tip(table[g]), t.arena[g].mean.depth) >
                  THICK_SAMPLE_MAX_RATIO);
    }
    if (t.arena[0].has_mean && t.arena[1].has_mean && thick && isfinite(log_ratio.value) &&
        log_ratio.standard_error >= 0.0) {
        profile->depth = t.arena[1].mean.depth;
        profile->contact_radius = 0.5 * t.arena[1].mean.widest;
        status = compute_profile(&t, profile, err);
    }
    arena_free(&memory);
    return status;
}
