/* Tables of the DMA job that are made of the spectrum. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_MASTER_H
#define WT_DMA_MASTER_H

#include "weartrack/flow.h"

wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err) WT_NODISCARD;

/* Of a number that is known by its decimal logarithm. */
wt_interval flow_power_of_ten(wt_interval log);

/* As many draws as a result has: a standard error from them is known to 5 %. */
enum { FLOW_STORED_DRAWS = 200 };
/* Isotherms fitted, and the rubber that comes of it, with so many draws unless they are left out.
 * Both cleared by the caller, also on failure. */
wt_status flow_rubber_fit(const wt_sweep *sweep, const wt_master_options *options,
                          double poisson_ratio, size_t n_draws, const wt_job *work, wt_master *fit,
                          wt_rubber *rubber, wt_error *err) WT_NODISCARD;

#endif
