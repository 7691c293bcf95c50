/* The counter surface: its parameters, their check and the measured spectrum. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_COUNTER_SURFACE_H
#define WT_FRICTION_COUNTER_SURFACE_H

#include "job/inputs.h"
#include "weartrack/friction.h"

wt_surface flow_surface_defaults(void); /* all values unset */
/* Parameters of a self-affine law and of a measured spectrum, as members of a wt_surface. */
const wt_params *flow_self_affine_params(void);
const wt_params *flow_spectrum_params(void);
/* Reports the number of spectrum points, or of the constants of a law, to the cost. */
void flow_surface_report_cost(const wt_surface *surface, const wt_job *work);
/* Checks that the values define a law. An unset roll-off becomes q0. */
wt_status flow_surface_check(wt_surface *surface, wt_error *err) WT_NODISCARD;
/* Roughness of a replicate: all densities are multiplied by `factor`, and each has its own scatter.
 * WT_NO_REPLICATE gives no scatter. With scans of several sizes, `factor` applies to the widest. */
wt_status flow_surface_draw(const wt_surface *surface, double factor, uint64_t seed,
                            size_t replicate, wt_roughness **roughness, wt_error *err) WT_NODISCARD;
/* Reads a measured spectrum without cut-offs. The densities are not checked. The errors are read if
 * weartrack psd wrote the file. */
wt_status flow_surface_read(flow_file *file, const wt_job *work, wt_surface *surface,
                            wt_error *err) WT_NODISCARD;
/* Computes the spectrum from the height maps and profiles of a surface. `tables` receives their
 * tables; NULL discards them. */
wt_status flow_surface_measure(const wt_topography_job *job, const wt_job *work,
                               wt_surface *surface, wt_topography_tables *tables,
                               wt_error *err) WT_NODISCARD;

#endif
