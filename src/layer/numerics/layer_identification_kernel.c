/* Critical energy and specific wear rate from observations of a layer: its thickness at balance
 * with a wear rate, or with the time to approach that thickness.
 *
 * The thickness alone determines U_c k: Qf(d) = Qw. Both rates scale with time, so that a
 * running-in time determines the depth worn off meanwhile, l = Qw t, which depends on the profile
 * only.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/memory.h"
#include "layer/numerics/layer_kernel.h"

#include "core/math/root.h"

#include <gsl/gsl_integration.h>
#include <math.h>

wt_status wt_layer_identify_wear(const wt_energy_source *source, const wt_layer_parameters *p,
                                 double thickness, double specific_wear_rate,
                                 wt_identified_constants *found, wt_error *err)
{
    if (p == NULL || found == NULL)
        return wt_fail(err, WT_E_ARG, "nothing to identify a layer by");
    const wt_status status = energy_check(source, err);
    if (status != WT_OK)
        return status;
    const double zero = energy_log_tail(source, 0), there = energy_log_tail(source, thickness);
    if (!(thickness > 0) || !(specific_wear_rate > 0) || !isfinite(zero) || !isfinite(there)) {
        wt_fail(err, WT_E_RANGE, "no layer to identify");
        wt_error_expected(err, "a thickness and a wear rate above 0, and energy at that depth");
        wt_error_found(err, "%g m, %g m^2/N", thickness, specific_wear_rate);
        return WT_E_RANGE;
    }
    *found =
        (wt_identified_constants){.critical_energy = exp(there) / (p->damage * specific_wear_rate *
                                                                   p->pressure * p->velocity),
                                  .specific_wear_rate = specific_wear_rate,
                                  .ratio = exp(zero - there)};
    return WT_OK;
}

/* ---- depth worn off during running-in -------------------------------------------------------- */

typedef struct growth {
    const wt_energy_source *source;
    double from;      /* thickness reached: the share of the balance thickness [m] */
    double log_there; /* ln J at the balance */
} growth;

/* d l / d delta for the rate balance, d delta/dt = Qw (J(delta)/J(balance) - 1). */
static double worn_per_growth(double depth, void *user)
{
    const growth *g = user;
    return 1 / expm1(energy_log_tail(g->source, depth) - g->log_there);
}

/* ln of the damage that a position gains along its path, over that at the balance; 0 at the edge of
 * the layer. */
static double log_surplus(double length, void *user)
{
    const growth *g = user;
    return energy_log_integral(g->source, g->from, length) - g->log_there;
}

/* The integrand is smooth away from the balance: far fewer intervals are needed. */
enum { MAX_INTERVALS = 200 };
static const double integral_tolerance = 1e-12;

static wt_status compute_worn_length_rates(growth *g, double *length, wt_error *err)
{
    double error = 0;
    gsl_function f = {worn_per_growth, g};
    gsl_integration_workspace *const w = gsl_integration_workspace_alloc(MAX_INTERVALS);
    if (w == NULL)
        out_of_memory(MAX_INTERVALS * sizeof(double));
    const int failed = gsl_integration_qag(&f, 0, g->from, 0, integral_tolerance, MAX_INTERVALS,
                                           GSL_INTEG_GAUSS61, w, length, &error);
    gsl_integration_workspace_free(w);
    if (failed != 0 && !(error <= 1e-6 * *length)) {
        wt_fail(err, WT_E_CONVERGENCE, "the growth of the layer could not be integrated");
        return WT_E_CONVERGENCE;
    }
    return WT_OK;
}

static wt_status compute_worn_length_transport(growth *g, double *length, wt_error *err)
{
    double high = g->from, low = high;
    if (!(energy_log_tail(g->source, g->from) > g->log_there))
        return wt_fail(err, WT_E_RANGE,
                       "no energy between that share of the thickness and all of it");
    while (log_surplus(high, g) < 0)
        high *= 2;
    while (log_surplus(low, g) >= 0)
        low /= 2;
    return root_find(log_surplus, g, low, high, 0, length, err);
}

wt_status wt_layer_identify_time(const wt_energy_source *source, const wt_layer_parameters *p,
                                 double thickness, double time, double share,
                                 wt_identified_constants *found, wt_error *err)
{
    wt_status status = wt_layer_identify_wear(source, p, thickness, 1, found, err);
    if (status == WT_OK && (!(time > 0) || !(share > 0) || !(share < 1))) {
        wt_fail(err, WT_E_RANGE, "no running-in to identify a layer by");
        wt_error_expected(err, "a time above 0, and a share of the thickness between 0 and 1");
        wt_error_found(err, "%g s, %g", time, share);
        return WT_E_RANGE;
    }
    if (status != WT_OK)
        return status;
    growth g = {source, share * thickness, energy_log_tail(source, thickness)};
    double length = 0;
    status = p->incubation ? compute_worn_length_transport(&g, &length, err)
                           : compute_worn_length_rates(&g, &length, err);
    if (status != WT_OK)
        return status;
    const double k = length / (p->duty * p->pressure * p->velocity * time);
    return wt_layer_identify_wear(source, p, thickness, k, found, err);
}
