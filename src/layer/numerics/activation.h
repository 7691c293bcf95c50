/* Internal to the kernel room: bonds that stress helps over a barrier, as a rate over the depth.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_ACTIVATION_H
#define WT_LAYER_NUMERICS_ACTIVATION_H

#include "layer/numerics/energy_density_kernel.h"

typedef struct activation activation;

/* Of a source at a velocity; *out is NULL without power. */
wt_status activation_new(const wt_energy_source *source, const wt_activation *parameters,
                         double velocity, activation **out, wt_error *err) WT_NODISCARD;
void activation_free(activation *a);

/* ln of Omega - Omega_inf at a depth, of its integral from there on, and over a length. */
double activation_log_density(const activation *a, double depth);
double activation_log_tail(const activation *a, double depth);
double activation_log_gain(const activation *a, double depth, double length);
/* The same with slope and bound as energy_course_at gives them. */
energy_course activation_course(const activation *a, double depth, double length, double reach);
/* Relative numerical error of the integrals. */
double activation_error(const activation *a);

#endif
