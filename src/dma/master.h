/* Internal interface of the DMA job: tables of a fit, the fit of a rubber and of temperature
 * sweeps. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_MASTER_H
#define WT_DMA_MASTER_H

#include "weartrack/dma.h"

wt_status flow_shift_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_master_curve_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_prony_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
/* Builds the tables of n draws of the material and its series. */
wt_status flow_draw_tables(const wt_master *m, size_t n, wt_master_tables *tables,
                           wt_error *err) WT_NODISCARD;
wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err) WT_NODISCARD;

/* Fits without each of the isotherms and warns if that moves a shift out of its interval. */
wt_status flow_influence_table(const wt_sweep *sweep, const wt_master_options *options,
                               const wt_master *all, wt_log *log, wt_table **table,
                               wt_error *err) WT_NODISCARD;

/* Returns false if a further step of the fit would visibly move a number. */
bool flow_fit_has_converged(const wt_master *m);

/* Number of draws in a result. They determine a standard error to 5 %. */
enum { FLOW_STORED_DRAWS = 200 };
/* Fits isotherms and creates the rubber with n_draws draws, unless the job excludes draws. The
 * caller clears `fit` and `rubber`, also on failure. */
wt_status flow_rubber_fit(const wt_sweep *sweep, const wt_master_options *options,
                          double poisson_ratio, size_t n_draws, const wt_job *work, wt_master *fit,
                          wt_rubber *rubber, wt_error *err) WT_NODISCARD;

/* Converts the temperature sweeps to isotherms, adds them to `sweep` and fits all isotherms. A
 * stated law (kind not NONE) also fixes the shifts. Without one, a single frequency returns
 * WT_E_MISSING. */
wt_status flow_ramps_fit(wt_sweep *sweep, const wt_master_options *options,
                         const wt_shift_law *given, wt_log *log, wt_master *master,
                         wt_error *err) WT_NODISCARD;

#endif
