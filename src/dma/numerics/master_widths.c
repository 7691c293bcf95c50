/* The fits over the widths of the vertical shift, which are averaged over.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include <math.h>

/* Widths of the prior of the vertical shift [decade]: clamping, departure of the material, in steps
 * of about four between nothing that is seen and more than is believed. Cells: what of all widths
 * each stands for; in one of three or four sweeps there is next to none of either. What is believed
 * are half widths of Cauchy priors, which twice or half of them hardly moves where an isotherm
 * tells its own: 0.01 decade is the 2.3 % of a cross section whose two sides are measured to 1 to
 * 2 %; 0.05 decade lies between a pure polyisoprene (PI_634.5k of RepTate), whose free shifts are
 * the entropic ones to 0.012, and a filled damping rubber that was measured, whose are off by 0.23.
 */
static const double geometry_widths[] = {0.0003, 0.002, 0.008, 0.03};
static const double geometry_cells[] = {0.0068, 0.0032, 0.0115, 0.0445};
static const double departure_widths[] = {0.0, 0.02, 0.1};
static const double departure_cells[] = {0.02, 0.04, 0.12};
static const double geometry_believed = 0.01, departure_believed = 0.05;
enum { GEOMETRIES = 4, DEPARTURES = 3 };

/* Cells with less of the logarithm of the largest weight count for nothing, whatever the law says:
 * exp(-20) is 2e-9 of the mixture, which the law would have to raise by exp(13) to the least share
 * that is kept (posterior.c). */
static const double hopeless = 20.0;

static double log_prior_of(double width, double believed, double cell)
{
    return log(cell / (1.0 + width * width / (believed * believed)));
}

/* One pair of widths of the tied vertical shift: ln of what it weighs. */
static wt_status fit_cell(master_work *work, int g, int d, double *weight, wt_error *err)
{
    wt_status status =
        master_set_widths(work, WT_VERTICAL_TIED, geometry_widths[g], departure_widths[d], err);
    if (status == WT_OK)
        status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
    *weight = log_prior_of(geometry_widths[g], geometry_believed, geometry_cells[g]) +
              log_prior_of(departure_widths[d], departure_believed, departure_cells[d]) -
              0.5 * work->s->criterion;
    return status == WT_OK && work->options.vertical == WT_VERTICAL_TIED
               ? posterior_keep(work->posterior, WT_VERTICAL_TIED, &work->vertical, *weight, err)
               : status;
}

/* From the widest down, for as long as it is not hopeless to be narrower; of[GEOMETRIES]: ln of the
 * weight of each error of the geometry. */
static wt_status fit_tied(master_work *work, double *of, wt_error *err)
{
    wt_status status = WT_OK;
    double best = -HUGE_VAL;
    for (int g = 0; g < GEOMETRIES; g++)
        of[g] = -HUGE_VAL;
    for (int g = GEOMETRIES - 1; g == GEOMETRIES - 1 || (g >= 0 && of[g + 1] > best - hopeless);
         g--) {
        double weight = 0.0;
        for (int d = DEPARTURES - 1; weight >= of[g] - hopeless && d >= 0; d--) {
            status = fit_cell(work, g, d, &weight, err);
            if (status != WT_OK)
                return status;
            of[g] = fmax(of[g], weight) + log1p(exp(-fabs(of[g] - weight)));
        }
        best = fmax(best, of[g]);
    }
    return status;
}

/* The shifts are free, but the reference was clamped as the others were: what a tied shift makes of
 * their scatter is the error of its level. */
static wt_status fit_free(master_work *work, const double *of, wt_error *err)
{
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < GEOMETRIES; g++) {
        if (!(of[g] > -HUGE_VAL))
            continue;
        status = master_set_widths(work, WT_VERTICAL_FREE, geometry_widths[g], 0.0, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
        if (status == WT_OK)
            status = posterior_keep(work->posterior, WT_VERTICAL_FREE, &work->vertical, of[g], err);
    }
    return status;
}

/* All widths that count; the spectrum is left at the best of them. */
wt_status master_fit_widths(master_work *work, wt_error *err)
{
    const wt_vertical_shift kind = work->options.vertical;
    wt_posterior *p = work->posterior;
    double of[GEOMETRIES];
    wt_status status = WT_OK;
    if (work->prior.held) {
        status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
        return status == WT_OK ? posterior_keep(p, kind, &work->vertical, 0.0, err) : status;
    }
    status = fit_tied(work, of, err);
    if (status == WT_OK && kind == WT_VERTICAL_FREE)
        status = fit_free(work, of, err);
    if (status != WT_OK)
        return status;
    const posterior_cell *best = posterior_best(p);
    status = master_set_widths(work, kind, best->geometry, best->departure, err);
    posterior_restore(p, best);
    return status;
}
