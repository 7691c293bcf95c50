/* Curves of a group for the modulus against depth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "indentation/curve_tables.h"
#include "indentation/indent.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool indent_has_unknown_loss(const wt_indent_fit *fit)
{
    const bool has_pull =
        fit->adhesion_force > 0 || fit->pull_off_force > 0; /* a pull loses work too */
    return fit->loss > CURVE_MIN_LOSS && isnan(fit->loss_bias) &&
           isnan(fit->spectrum_factor.value) && !has_pull;
}

/* True if the curve has data on the modulus against depth. A fit that begins at a depth lacks the
 * misfit at small depths. */
static bool has_depth_information(const wt_indent_fit *fit)
{
    const bool has_pull = fit->adhesion_force > 0 || fit->pull_off_force > 0;
    return !(fit->fitted_from > 0) &&
           (wt_curve_verdict_is_usable(fit->verdict) || fit->verdict == WT_CURVE_POOR_FIT) &&
           !(fit->verdict == WT_CURVE_DOUBTFUL && has_pull) && isnan(fit->work_of_adhesion.value) &&
           isnan(fit->contact_pull.value) && fit->modulus.value > 0 && !isnan(fit->misfit[0]);
}

bool indent_depth_curve(const wt_indent_fit *fit, const wt_force_curve *curve, bool is_requested,
                        wt_curve_residuals *to)
{
    const double none = (double)NAN;
    *to = (wt_curve_residuals){
        .baseline = none, .window = none, .curvature = none, .loss_error = none};
    for (size_t i = 0; i < WT_MISFIT_TERMS; i++)
        to->misfit[i] = none;
    if (!is_requested || !has_depth_information(fit))
        return false;
    *to = (wt_curve_residuals){.modulus = fit->modulus.value,
                               .depth = fit->max_indentation,
                               .spring_constant = curve->cantilever.spring_constant,
                               .baseline = fit->baseline_length,
                               .window = fit->misfit_length,
                               .curvature = fit->baseline_curvature,
                               .loss_error = indent_has_unknown_loss(fit) ? none : fit->loss_error};
    memcpy(to->misfit, fit->misfit, sizeof to->misfit);
    return true;
}

void indent_depths_add(indent_depths *to, const wt_curve_residuals *curve, const char *spot)
{
    to->curve = array_grow(to->curve, to->n, sizeof *to->curve);
    wt_curve_residuals *added = &to->curve[to->n++];
    if (to->last_spot == NULL || strcmp(spot, to->last_spot) != 0)
        to->n_spots++;
    to->last_spot = spot;
    *added = *curve;
    added->spot = to->n_spots;
}

wt_status indent_depths_table(const indent_depths *depths, const wt_indent_job *job,
                              const wt_contact_table *contact, wt_indent_tables *tables,
                              wt_error *err)
{
    wt_modulus_profile depth;
    if (job->options.plain_least_squares || depths->n == 0)
        return WT_OK;
    const wt_status status = wt_modulus_profile_fit(contact, job->options.poisson_ratio,
                                                    depths->curve, depths->n, &depth, err);
    return status == WT_OK ? flow_depth_table_add(tables, job->group, &depth, err) : status;
}

void indent_depths_clear(indent_depths *depths)
{
    free(depths->curve);
}
