/* Strain softening of a filled rubber: measured characteristics and the law of Kraus.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/kraus_region.h"

#include "core/base/array.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

/* END points are averaged at each end. A fit of four constants needs seven points, so that three
 * degrees of freedom remain. A largest value among the outer two points is no maximum. */
enum { END = 3, FEWEST_FIT = 7, FROM_END = 2 };
/* Strain range of the points that are averaged at the start: half a decade. The law of Kraus
 * falls there by (start_ratio gamma / gamma_c)^(2 m), less for a smaller first amplitude. */
static const double start_ratio = 3;
/* Fractions of the initial modulus whose strains are reported: onset of softening and half. */
static const double tenth_lost = 0.9, half_lost = 0.5;
/* Quantile of the 95 % intervals, and the significance level of the fall. */
static const double confidence = 0.975, significance = 0.05;

double wt_kraus_storage(const wt_kraus *law, double strain)
{
    const double x = pow(strain / law->strain_c, law->exponent);
    return law->storage_inf + (law->storage_0 - law->storage_inf) / (1 + x * x);
}

double wt_kraus_loss(const wt_kraus *law, double strain)
{
    const double x = pow(strain / law->strain_c, law->exponent);
    return law->loss_inf + (law->loss_m - law->loss_inf) * 2 / (x + 1 / x);
}

/* ---- as measured ----------------------------------------------------------------------------- */

static double crossing_strain(const payne_points *p, double to)
{
    const double *x = p->log_strain, *y = p->storage;
    for (size_t i = 1; i < p->n; i++)
        if (y[i] < to && y[i - 1] >= to)
            return exp(x[i - 1] + (x[i] - x[i - 1]) * (y[i - 1] - to) / (y[i - 1] - y[i]));
    return (double)NAN;
}

static void measure_softening(const payne_points *p, wt_payne *payne)
{
    size_t first = 1, top = 0;
    while (first < END && first < p->n &&
           p->log_strain[first] - p->log_strain[0] <= log(start_ratio))
        first++;
    const size_t last = p->n < END ? p->n : END;
    payne->storage_start = numbers_mean(p->storage, first);
    payne->loss_start = numbers_mean(p->loss, first);
    payne->storage_end = numbers_mean(p->storage + p->n - last, last);
    payne->strain_tenth = crossing_strain(p, tenth_lost * payne->storage_start);
    payne->strain_half = crossing_strain(p, half_lost * payne->storage_start);
    for (size_t i = 1; i < p->n; i++)
        if (p->loss[i] > p->loss[top])
            top = i;
    payne->loss_max = p->loss[top];
    if (top >= FROM_END && top + FROM_END < p->n)
        payne->strain_loss_max = exp(p->log_strain[top]);
    else
        payne->loss_note = top < FROM_END
                               ? "largest at the smallest amplitudes: no maximum in range"
                               : "largest at the largest amplitudes: no maximum in range";
}

/* ---- the law --------------------------------------------------------------------------------- */

/* Returns the root mean square of the residuals. The flag is true if neighbouring residuals have
 * the same sign more often than independent noise. */
static double law_misfit(const payne_points *p, const double *y, const wt_kraus *law,
                         double (*law_function)(const wt_kraus *, double), bool *residuals_drift)
{
    double squares = 0, steps = 0, before = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double off = y[i] - law_function(law, exp(p->log_strain[i]));
        squares += off * off;
        steps += i > 0 ? (off - before) * (off - before) : 0;
        before = off;
    }
    *residuals_drift = steps < (2 - 4 / sqrt((double)p->n)) * squares;
    return sqrt(squares / (double)p->n);
}

/* Sets parameters outside the measured amplitudes to NaN. */
static void withhold_unmeasured(const payne_points *p, wt_payne *payne)
{
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    const double at = log(payne->law.strain_c);
    const char *reason = NULL;
    if (at > p->log_strain[p->n - 1])
        reason = "half of the fall is not reached in range";
    else if (at < p->log_strain[0])
        reason = "more than half of the fall lies below the smallest amplitude";
    if (reason == NULL)
        return;
    payne->note = reason;
    payne->strain_c = payne->loss_m = payne->loss_inf = unknown;
    *(at > p->log_strain[0] ? &payne->storage_inf : &payne->storage_0) = unknown;
}

static void fit_kraus_law(const payne_points *p, wt_payne *payne)
{
    double u, v;
    bool residuals_drift, loss_residuals_drift;
    payne_best_fit(p, &u, &v);
    const payne_levels s = payne_storage_levels(p, u, v), l = payne_loss_levels(p, u, v);
    const double freedom = (double)(p->n - 4), flat = payne_total_squares(p);
    if (!(s.rss > 0) ||
        gsl_cdf_fdist_Q((flat - s.rss) / 3 / (s.rss / freedom), 3, freedom) > significance) {
        payne->note = s.rss > 0 ? "no fall of the storage modulus that stands out of its scatter"
                                : "the points have no scatter";
        return;
    }
    payne->fitted = true;
    payne->law = (wt_kraus){s.b, s.a, exp(u), exp(v), l.b, l.a};
    payne->storage_misfit =
        law_misfit(p, p->storage, &payne->law, wt_kraus_storage, &residuals_drift) /
        payne->law.storage_0;
    payne->loss_misfit =
        law_misfit(p, p->loss, &payne->law, wt_kraus_loss, &loss_residuals_drift) / payne->loss_max;
    payne_intervals(p, gsl_cdf_tdist_Pinv(confidence, freedom), payne);
    if (residuals_drift)
        payne->note = "the points leave the law of Kraus one after the other to the same side: "
                      "intervals too narrow";
    if (loss_residuals_drift && payne->loss_note[0] == '\0')
        payne->loss_note = "the points leave the law of Kraus one after the other to the same "
                           "side: intervals too narrow";
    withhold_unmeasured(p, payne);
}

wt_status wt_payne_fit(const double *strain, const double *storage, const double *loss, size_t n,
                       wt_payne *payne, wt_error *err)
{
    const double nan = (double)NAN;
    const wt_interval unknown = {nan, nan, nan, nan};
    const bool storage_only = loss == NULL;
    loss = storage_only ? storage : loss; /* placeholder; its results are set to NaN below */
    if (strain == NULL || storage == NULL || payne == NULL || n == 0)
        return wt_fail(err, WT_E_ARG, "no strain sweep");
    for (size_t i = 0; i < n; i++)
        if (!(strain[i] > 0 && storage[i] > 0 && loss[i] > 0 && isfinite(strain[i]) &&
              isfinite(storage[i]) && isfinite(loss[i]) && (i == 0 || strain[i] >= strain[i - 1])))
            return wt_fail(err, WT_E_ARG, "strain sweep: not rising, or not above zero");
    double *log_strain = wt_alloc(n, sizeof *log_strain);
    for (size_t i = 0; i < n; i++)
        log_strain[i] = log(strain[i]);
    const payne_points p = {n, log_strain, storage, loss};
    *payne = (wt_payne){.strain_loss_max = nan,
                        .law = {nan, nan, nan, nan, nan, nan},
                        .storage_0 = unknown,
                        .storage_inf = unknown,
                        .strain_c = unknown,
                        .exponent = unknown,
                        .loss_m = unknown,
                        .loss_inf = unknown,
                        .storage_misfit = nan,
                        .loss_misfit = nan,
                        .note = "",
                        .loss_note = ""};
    measure_softening(&p, payne);
    if (n < FEWEST_FIT)
        payne->note = "too few points for the law of Kraus";
    else
        fit_kraus_law(&p, payne);
    if (storage_only) {
        payne->loss_start = payne->loss_max = payne->strain_loss_max = nan;
        payne->law.loss_m = payne->law.loss_inf = payne->loss_misfit = nan;
        payne->loss_m = payne->loss_inf = unknown;
        payne->loss_note = "no loss modulus was measured";
    }
    free(log_strain);
    return WT_OK;
}
