/* The prior of the vertical shifts: tied to the physical one, about which every clamping scatters
 * and the material departs smoothly with temperature. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/vertical_shift.h"

#include "base/gsl_quiet.h"
#include "fit/dense.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

/* Over how many degrees the departure of the material keeps its course [K]: a filler network or a
 * transition changes over some tens of kelvin. Chosen; at 20 the departure follows isotherms 10 K
 * apart nearly one by one, as clamping does; at 80 it is nearly a line over what is measured. */
static const double reach = 40.0;

/* Covariance of the smooth departure at two temperatures, 0 at the reference. */
static double departure_covariance(const vertical *v, double t1, double t2)
{
    const double r = v->reference_temperature;
    const double k12 = exp(-0.5 * (t1 - t2) * (t1 - t2) / (reach * reach));
    const double k1 = exp(-0.5 * (t1 - r) * (t1 - r) / (reach * reach));
    const double k2 = exp(-0.5 * (t2 - r) * (t2 - r) / (reach * reach));
    return k12 - k1 - k2 + 1.0;
}

double vertical_physical(const vertical *v, double temperature)
{
    const double t0 = v->reference_temperature;
    return log(t0 / temperature) + v->expansion * (temperature - t0);
}

wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err)
{
    const size_t n = s->n_curves;
    gsl_quiet();
    *prior = (spectrum_prior){.held = kind == WT_VERTICAL_NONE || kind == WT_VERTICAL_PHYSICAL,
                              .mean = v->mean};
    for (size_t i = 0; i < n; i++)
        v->mean[i] = kind == WT_VERTICAL_NONE ? 0.0 : vertical_physical(v, temperature[i]);
    const double geometry = v->geometry * M_LN10, departure = v->departure * M_LN10;
    gsl_matrix_view part = gsl_matrix_submatrix(v->precision, 0, 0, n, n);
    if (kind == WT_VERTICAL_FREE && geometry > 0.0) {
        gsl_matrix_set_zero(&part.matrix);
        gsl_matrix_set(&part.matrix, s->anchor, s->anchor, 1.0 / (geometry * geometry));
        prior->log_det = 2.0 * log(geometry);
        prior->precision = v->precision;
    }
    if (kind != WT_VERTICAL_TIED)
        return WT_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++)
            gsl_matrix_set(&part.matrix, i, k,
                           departure * departure *
                                   departure_covariance(v, temperature[i], temperature[k]) +
                               (i == k ? geometry * geometry : 0.0));
    if (gsl_linalg_cholesky_decomp1(&part.matrix) != GSL_SUCCESS)
        return wt_fail(err, WT_E_INTERNAL, "the prior of the vertical shifts is not positive");
    for (size_t i = 0; i < n; i++)
        prior->log_det += 2.0 * log(gsl_matrix_get(&part.matrix, i, i));
    gsl_linalg_cholesky_invert(&part.matrix);
    prior->precision = v->precision;
    return WT_OK;
}

void vertical_smooth_part(const vertical *v, const spectrum_prior *prior, const double *temperature,
                          size_t n, double *weight)
{
    const double departure = v->departure * M_LN10;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++) {
            const double with =
                departure * departure * departure_covariance(v, temperature[i], temperature[k]);
            dense_add(weight + i * n, n, &with, 1, gsl_matrix_const_ptr(prior->precision, k, 0),
                      prior->precision->tda, 1);
        }
}
