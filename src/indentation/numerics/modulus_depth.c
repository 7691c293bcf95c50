/* Test of a change of the modulus with depth from the mean residual of the curves of a group,
 * which has less noise than one curve.
 *
 * The first cosines of the residual over the contact (lack_of_fit.c) are those of the difference
 * between the force and that of the fit. A modulus E exp(a + b (u - 1)) at the relative contact
 * radius u, with a shifted contact point, causes such a difference. The three parameters are
 * fitted to the mean of the curves, weighted by their scatter. They are fitted together, because
 * the contact point of a homogeneous fit hides most of a change. The remaining cosines follow the
 * F distribution for any noise. If they are significant, a quadratic term or a layer on other
 * rubber is fitted too. depth_pool.c describes the errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/depth_pool.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

enum { W = CURVE_WAVES };
static const double level =
    0.01; /* significance level of a change and of the remaining cosines: one group of 100 */
static const double margin = WT_DEPTH_MARGIN; /* largest irrelevant change */
/* Largest ratio of the limits of a thickness; a thickness uncertain by more than a factor of 2 is
 * not reported. */
static const double max_thickness_ratio = 4.0;

typedef struct factor_estimate {
    wt_interval interval;
    double chance;                 /* p value of a logarithm of 0 */
    double bend_share, loss_share; /* shares of its variance */
} factor_estimate;

/* Computes a factor. The arguments describe its logarithm as in depth_estimate. */
static factor_estimate estimate_factor(depth_pool *d, const depth_fit *fit, double at,
                                       const double by[DEPTH_PARAMETERS], bool with_level,
                                       double losses)
{
    const depth_value v = depth_estimate(d, fit, at, by, with_level, losses);
    const double error = hypot(v.scatter.error, hypot(v.bend, v.loss));
    const double reach = students_t_quantile(v.scatter.df) * error;
    const double value = exp(v.mean);
    return (factor_estimate){
        .interval = {value, value * error, exp(v.mean - reach), exp(v.mean + reach)},
        .chance = 2.0 * gsl_cdf_tdist_Q(fabs(v.mean) / error, v.scatter.df),
        .bend_share = v.bend * v.bend / (error * error),
        .loss_share = v.loss * v.loss / (error * error)};
}

/* ---- results --------------------------------------------------------------------------------- */

/* Computes ln of the modulus over that of the fit at a share of the depth, and its derivatives. */
static double log_modulus_ratio(const depth_mean *m, const depth_fit *fit, double share,
                                double by[DEPTH_PARAMETERS])
{
    const double depth = share * m->depth, step = 1e-5;
    double g, slope, p[DEPTH_PARAMETERS];
    wt_contact_table_eval(m->table, &depth, 1, &g, &slope);
    depth_modulus law = depth_modulus_create(m, fit->law, fit->p);
    const double u = slope / m->widest, value = depth_log_modulus(&law, u);
    memcpy(p, fit->p, sizeof p);
    for (size_t a = 0; a < DEPTH_PARAMETERS; a++) {
        p[a] += step;
        law = depth_modulus_create(m, fit->law, p);
        by[a] = (depth_log_modulus(&law, u) - value) / step;
        p[a] = fit->p[a];
    }
    return value;
}

/* Sets the modulus at shares of the depth, and its change from the first to the last. */
static void set_depth_moduli(depth_pool *d, const depth_fit *fit, wt_modulus_profile *to)
{
    double first[DEPTH_PARAMETERS] = {0.0}, by[DEPTH_PARAMETERS], top = 0.0;
    for (size_t i = 0; i < WT_DEPTHS; i++) {
        const double share = (double)(i + 1) / WT_DEPTHS;
        const double at = log_modulus_ratio(&d->mean, fit, share, by);
        to->depth[i] = share * d->mean.depth;
        to->modulus[i] =
            estimate_factor(d, fit, at, by, true, 1.0 + DEPTH_SHALLOW_FACTOR * (1.0 - share))
                .interval;
        if (i == 0) {
            memcpy(first, by, sizeof first);
            top = at;
        }
        if (i + 1 < WT_DEPTHS)
            continue;
        for (size_t a = 0; a < DEPTH_PARAMETERS; a++)
            by[a] -= first[a];
        const factor_estimate change = estimate_factor(
            d, fit, at - top, by, false, DEPTH_SHALLOW_FACTOR * (1.0 - 1.0 / WT_DEPTHS));
        to->change = change.interval;
        to->change_p = change.chance;
        to->curvature_share = change.bend_share;
        to->loss_share = change.loss_share;
    }
}

/* Fits a layer thinner than the indentation that would cause the same change. */
static depth_fit fit_equivalent_layer(depth_pool *d, double log_change, wt_error *err)
{
    static const double reaches[] = {0.7, 1.2, 2.0}; /* contact radius over thickness */
    depth_fit best = {.is_valid = false};
    for (size_t i = 0; i < COUNT_OF(reaches); i++) {
        const double start[] = {0.0, -0.5 * log_change, -1.5 * log_change, log(reaches[i])};
        const depth_fit fit = depth_fit_law(d, DEPTH_LAYER, start, err);
        if (fit.is_valid && (!best.is_valid || fit.left < best.left))
            best = fit;
    }
    return best;
}

/* Sets the three numbers of the layer if the mean curve determines them. */
static void set_layer_estimate(depth_pool *d, wt_modulus_profile *to, wt_error *err)
{
    const depth_fit fit = fit_equivalent_layer(d, log(to->change.value), err);
    const double ratio = exp(fit.p[DEPTH_RATIO]), reach = exp(fit.p[DEPTH_REACH]);
    if (thin_sample_radius_ratio(contact_table_tip(d->mean.table), d->mean.depth) >
            THICK_SAMPLE_MAX_RATIO ||
        !fit.is_valid || fit.p_value < level || !thin_layer_is_valid(ratio, reach) ||
        (ratio > 0.6 && ratio < 1.6) || reach < 0.7 || reach > 2.5)
        return;
    const double of_layer[] = {0.0, 1.0, 0.0, 0.0}, of_ground[] = {0.0, 1.0, -1.0, 0.0},
                 of_thickness[] = {0.0, 0.0, 0.0, -1.0};
    const wt_interval thickness =
        estimate_factor(d, &fit, log(0.5 * d->mean.widest) - fit.p[DEPTH_REACH], of_thickness,
                        false, 1.0)
            .interval;
    if (thickness.high > max_thickness_ratio * thickness.low)
        return;
    to->thickness = thickness;
    to->layer_modulus = estimate_factor(d, &fit, fit.p[DEPTH_LEVEL], of_layer, true, 1.0).interval;
    to->substrate_modulus =
        estimate_factor(d, &fit, fit.p[DEPTH_LEVEL] - fit.p[DEPTH_RATIO], of_ground, true, 1.0)
            .interval;
}

/* True if the change is irrelevant in either direction. */
static bool is_negligible_change(const wt_modulus_profile *d)
{
    return d->change.low > 1.0 / (1.0 + margin) && d->change.high < 1.0 + margin;
}

/* Sets the verdict on the change: significant, irrelevant, or inconclusive. */
static void set_depth_verdict(const depth_fit *fit, wt_modulus_profile *to)
{
    to->misfit_p = fit->p_value;
    to->verdict = to->change_p < level       ? WT_DEPTH_CHANGES
                  : fit->p_value < level     ? WT_DEPTH_OTHER_RESIDUAL
                  : is_negligible_change(to) ? WT_DEPTH_SAME
                                             : WT_DEPTH_INCONCLUSIVE;
}

static wt_status analyse_depth(depth_pool *d, wt_modulus_profile *to, wt_error *err)
{
    const double start[DEPTH_PARAMETERS] = {0.0};
    wt_error failure = WT_ERROR_INIT;
    depth_fit fit = depth_fit_law(d, DEPTH_LINE, start, &failure);
    if (fit.is_valid && fit.p_value < level) {
        const depth_fit other[] = {depth_fit_law(d, DEPTH_QUADRATIC, fit.p, &failure),
                                   fit_equivalent_layer(d, fit.p[DEPTH_SLOPE], &failure)};
        for (size_t i = 0; i < COUNT_OF(other); i++)
            if (other[i].is_valid && other[i].p_value > fit.p_value)
                fit = other[i];
    }
    if (fit.is_valid && failure.status == WT_OK) {
        set_depth_moduli(d, &fit, to);
        set_depth_verdict(&fit, to);
    }
    if (to->verdict == WT_DEPTH_CHANGES) {
        const depth_fit bent = depth_fit_law(d, DEPTH_QUADRATIC, fit.p, &failure);
        const double chance = to->change_p;
        if (fit.law == DEPTH_LINE && bent.is_valid) /* the change need not be linear */
            set_depth_moduli(d, &bent, to);
        to->change_p = chance;
        if (is_negligible_change(to) && to->change.low < 1.0 && to->change.high > 1.0)
            to->verdict = WT_DEPTH_SAME;
        else
            set_layer_estimate(d, to, &failure);
    }
    if (failure.status == WT_OK)
        return WT_OK;
    if (err != NULL)
        *err = failure;
    return failure.status;
}

/* The scatter of two spots is not known, and that of their curves does not replace it. */
static void remove_interval(wt_modulus_profile *to)
{
    const double unknown = (double)NAN;
    const wt_interval nothing = {unknown, unknown, unknown, unknown};
    for (size_t i = 0; i < WT_DEPTHS; i++)
        to->modulus[i].standard_error = to->modulus[i].low = to->modulus[i].high = unknown;
    to->change.standard_error = to->change.low = to->change.high = unknown;
    to->change_p = to->misfit_p = unknown;
    to->layer_modulus = to->substrate_modulus = to->thickness = nothing;
    to->verdict = WT_DEPTH_INCONCLUSIVE;
}

wt_status wt_modulus_profile_fit(const wt_contact_table *table, double poisson_ratio,
                                 const wt_curve_residuals *curve, size_t n, wt_modulus_profile *to,
                                 wt_error *err)
{
    const double unknown = (double)NAN;
    const wt_interval nothing = {unknown, unknown, unknown, unknown};
    arena memory = {0};
    depth_pool d;
    wt_status status = WT_OK;
    depth_pool_create(&d, table, poisson_ratio, curve, n, &memory);
    *to = (wt_modulus_profile){.n = d.n,
                               .n_units = d.n_units,
                               .by_spot = d.by_spot,
                               .two_spots = d.two_spots,
                               .n_excluded_by_loss = d.n_excluded_by_loss,
                               .change_p = unknown,
                               .misfit_p = unknown,
                               .change = nothing,
                               .layer_modulus = nothing,
                               .substrate_modulus = nothing,
                               .thickness = nothing};
    if (d.has_mean)
        status = analyse_depth(&d, to, err);
    if (status == WT_OK && d.two_spots)
        remove_interval(to);
    arena_free(&memory);
    return status;
}
