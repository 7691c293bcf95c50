/* Stress-activated bond breaking as a rate against depth. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_ACTIVATION_H
#define WT_LAYER_NUMERICS_ACTIVATION_H

#include "layer/numerics/energy_density_kernel.h"

typedef struct activation activation;

/* Creates the rate for a source at a velocity; *out is NULL without power. The caller frees it. */
wt_status activation_new(const wt_energy_source *source, const wt_activation *parameters,
                         double velocity, activation **out, wt_error *err) WT_NODISCARD;
void activation_free(activation *a);

/* ln of Omega - Omega_inf at a depth, of its integral below a depth, and of its integral over a
 * length. */
double activation_log_density(const activation *a, double depth);
double activation_log_tail(const activation *a, double depth);
double activation_log_integral(const activation *a, double depth, double length);
/* Variant that also returns the slope and a bound of the second derivative, as energy_expand
 * does. */
energy_expansion activation_expand(const activation *a, double depth, double length, double reach);
/* Relative numerical error of the integrals. */
double activation_error(const activation *a);

#endif
