/* WLF fit to arrays (internal to the fit room): the shift fit needs it to move to a reference
 * temperature that was not measured. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_WLF_FIT_H
#define WT_FIT_WLF_FIT_H

#include "weartrack/fit.h"

/* Generalised least squares of n >= 4 shifts log_a (decades, relative to any isotherm) at
 * temperatures [K] with covariance[n * n] plus floor^2 on the diagonal; the offset is free. */
wt_status wlf_fit_arrays(const double *temperature, const double *log_a, const double *covariance,
                         size_t n, double reference_temperature, double floor, wt_wlf_fit *fit,
                         wt_error *err) WT_NODISCARD;

#endif
