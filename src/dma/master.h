/* Tables of the DMA job that derive from the spectrum. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_MASTER_H
#define WT_DMA_MASTER_H

#include "weartrack/dma.h"

wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err) WT_NODISCARD;

/* Converts an interval of log10 of a number to an interval of the number. The standard error is
 * NaN. */
wt_interval flow_power_of_ten(wt_interval log);

/* Number of draws in a result. They determine a standard error to 5 %. */
enum { FLOW_STORED_DRAWS = 200 };
/* Fits isotherms and creates the rubber with n_draws draws, unless the job excludes draws. The
 * caller clears `fit` and `rubber`, also on failure. */
wt_status flow_rubber_fit(const wt_sweep *sweep, const wt_master_options *options,
                          double poisson_ratio, size_t n_draws, const wt_job *work, wt_master *fit,
                          wt_rubber *rubber, wt_error *err) WT_NODISCARD;

#endif
