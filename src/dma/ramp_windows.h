/* Temperature sweeps fitted together with isotherms. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_RAMP_WINDOWS_H
#define WT_DMA_RAMP_WINDOWS_H

#include "weartrack/fit.h"

/* Adds isotherms made of the temperature sweeps to those of `sweep`, each point brought to the
 * temperature of its isotherm by the law, and fits all of them. A law that is given (kind NONE:
 * none is) holds their shifts too; without one WT_E_MISSING for one frequency alone. */
wt_status flow_ramps_fit(wt_sweep *sweep, const wt_master_options *options,
                         const wt_shift_law *given, wt_log *log, wt_master *master,
                         wt_error *err) WT_NODISCARD;

#endif
