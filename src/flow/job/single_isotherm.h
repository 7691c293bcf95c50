/* One isotherm as a master curve. Internal to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SINGLE_ISOTHERM_H
#define WEARTRACK_FLOW_SINGLE_ISOTHERM_H

#include "weartrack/fit.h"

/* The first isotherm of a sweep, unshifted. WT_E_MISSING if the options ask for a reference more
 * than 1 K away. */
wt_status flow_single_isotherm(const wt_sweep *sweep, const wt_shift_options *options,
                               wt_parselog *log, wt_master_curve *master,
                               wt_error *err) WT_NODISCARD;

#endif
