/* Fits of the spectrum for several widths of the vertical shift.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include <math.h>

/* Widths of the prior of the vertical shift [decade]: clamping and departure of the material, in
 * steps of about four. Cells: the widths of the grid cells; a quarter to a third of all sweeps
 * have next to none of either. The priors are Cauchy distributions with the stated half widths.
 * A factor of 2 hardly matters where an isotherm determines its shift. 0.01 decade is 2.3 % of a
 * cross section with sides measured to 1 to 2 %. 0.05 decade lies between a pure polyisoprene
 * (PI_634.5k of RepTate), within 0.012 of the entropic shifts, and a filled damping rubber, 0.23
 * from them. */
static const double geometry_widths[] = {0.0003, 0.002, 0.008, 0.03};
static const double geometry_cells[] = {0.0068, 0.0032, 0.0115, 0.0445};
static const double departure_widths[] = {0.0, 0.02, 0.1};
static const double departure_cells[] = {0.02, 0.04, 0.12};
static const double geometry_prior_width = 0.01, departure_prior_width = 0.05;
enum { GEOMETRIES = 4, DEPARTURES = 3 };

/* Cells whose ln weight is this much below the largest are dropped, as by posterior.c. A departure
 * that is too narrow for a geometry error is too narrow for a smaller one. */
static const double negligible_log_weight = 14.0;

static double log_prior(double width, double believed, double cell)
{
    return log(cell / (1.0 + width * width / (believed * believed)));
}

/* Fits one pair of widths of the tied vertical shift. *weight: ln of its weight. */
static wt_status fit_cell(master_work *work, int g, int d, double *weight, wt_error *err)
{
    wt_status status =
        master_set_widths(work, WT_VERTICAL_TIED, geometry_widths[g], departure_widths[d], err);
    if (status == WT_OK)
        status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
    *weight = log_prior(geometry_widths[g], geometry_prior_width, geometry_cells[g]) +
              log_prior(departure_widths[d], departure_prior_width, departure_cells[d]) -
              0.5 * work->s->criterion;
    if (status == WT_OK && work->options.vertical == WT_VERTICAL_TIED)
        status = posterior_store(work->posterior, WT_VERTICAL_TIED, &work->vertical, *weight, err);
    return status;
}

/* Fits from the widest prior to narrower ones until they become negligible. The array gets ln of
 * the weight of each geometry error. */
static wt_status fit_tied_shift(master_work *work, double *log_weight, wt_error *err)
{
    wt_status status = WT_OK;
    double best = -HUGE_VAL;
    int narrowest = 0;
    for (int g = 0; g < GEOMETRIES; g++)
        log_weight[g] = -HUGE_VAL;
    for (int g = GEOMETRIES - 1;
         g == GEOMETRIES - 1 || (g >= 0 && log_weight[g + 1] > best - negligible_log_weight); g--) {
        double weight;
        spectrum_return(work->s); /* to the widest departure of the geometry before */
        for (int d = DEPARTURES - 1; d >= narrowest; d--) {
            status = fit_cell(work, g, d, &weight, err);
            if (status != WT_OK)
                return status;
            if (d == DEPARTURES - 1)
                spectrum_keep(work->s);
            if (weight < log_weight[g] - negligible_log_weight)
                narrowest = d + 1;
            log_weight[g] = fmax(log_weight[g], weight) + log1p(exp(-fabs(log_weight[g] - weight)));
        }
        best = fmax(best, log_weight[g]);
    }
    return status;
}

/* Fits free vertical shifts. The reference is clamped like the others, so the scatter of the
 * tied shifts is the error of its level. */
static wt_status fit_free_shift(master_work *work, const double *log_weight, wt_error *err)
{
    wt_status status = WT_OK;
    spectrum_return(work->s);
    for (int g = 0; status == WT_OK && g < GEOMETRIES; g++) {
        if (!(log_weight[g] > -HUGE_VAL))
            continue;
        status = master_set_widths(work, WT_VERTICAL_FREE, geometry_widths[g], 0.0, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
        if (status == WT_OK)
            status = posterior_store(work->posterior, WT_VERTICAL_FREE, &work->vertical,
                                     log_weight[g], err);
    }
    return status;
}

wt_status master_fit_widths(master_work *work, wt_error *err)
{
    const wt_vertical_shift kind = work->options.vertical;
    wt_posterior *p = work->posterior;
    double log_weight[GEOMETRIES];
    wt_status status = WT_OK;
    spectrum_return(work->s); /* the test of superposition left free vertical shifts */
    if (work->prior.held) {
        status = spectrum_fit(work->s, SPECTRUM_NOISE, err);
        if (status == WT_OK)
            status = posterior_store(p, kind, &work->vertical, 0.0, err);
    } else {
        status = fit_tied_shift(work, log_weight, err);
        if (status == WT_OK && kind == WT_VERTICAL_FREE)
            status = fit_free_shift(work, log_weight, err);
    }
    if (status != WT_OK)
        return status;
    const posterior_cell *best = posterior_best(p);
    status = master_set_widths(work, kind, best->geometry, best->departure, err);
    posterior_restore(p, best);
    return status;
}
