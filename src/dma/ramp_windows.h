/* Fit of temperature sweeps together with isotherms. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_RAMP_WINDOWS_H
#define WT_DMA_RAMP_WINDOWS_H

#include "weartrack/dma.h"

/* Converts the temperature sweeps to isotherms, adds them to `sweep` and fits all isotherms. A
 * stated law (kind not NONE) also fixes the shifts. Without one, a single frequency returns
 * WT_E_MISSING. */
wt_status flow_ramps_fit(wt_sweep *sweep, const wt_master_options *options,
                         const wt_shift_law *given, wt_log *log, wt_master *master,
                         wt_error *err) WT_NODISCARD;

#endif
