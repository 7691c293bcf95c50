/* The counter surface: its parameters, their check, a measured spectrum.
 * Internal to friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_COUNTER_SURFACE_H
#define WT_FRICTION_COUNTER_SURFACE_H

#include "job/inputs.h"

wt_surface flow_surface_defaults(void); /* nothing is given */
/* The parameters of a self-affine law, and of a measured spectrum, in a wt_surface. */
const wt_params *flow_self_affine_params(void);
const wt_params *flow_spectrum_params(void);
/* Says to the cost how much it is of: the points of a spectrum, or the constants of a law. */
void flow_surface_cost(const wt_surface *surface, const wt_job *work);
/* Whether they make a law; a roll-off that is not given is q0. */
wt_status flow_surface_check(wt_surface *surface, wt_error *err) WT_NODISCARD;
/* The law of a replicate, all densities multiplied by `factor` and each by its own scatter; without
 * that for WT_NO_REPLICATE. Of scans of several sizes `factor` is that of the widest. */
wt_status flow_surface_draw(const wt_surface *surface, double factor, uint64_t seed,
                            size_t replicate, wt_roughness **roughness, wt_error *err) WT_NODISCARD;
/* A measured spectrum as a surface, uncut; the densities are not checked. The errors of one that
 * weartrack psd made come with it. */
wt_status flow_surface_read(flow_file *file, const wt_job *work, wt_surface *surface,
                            wt_error *err) WT_NODISCARD;
/* Likewise of the height maps and profiles of a surface; *tables: of them, NULL for none. */
wt_status flow_surface_measure(const wt_topography_job *job, const wt_job *work,
                               wt_surface *surface, wt_topography_tables *tables,
                               wt_error *err) WT_NODISCARD;

#endif
