/* Tables of the DMA job that are made of the spectrum. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_MASTER_H
#define WEARTRACK_FLOW_MASTER_H

#include "weartrack/flow.h"

const char *flow_deformation_name(wt_deformation deformation);
wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err) WT_NODISCARD;
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err) WT_NODISCARD;

#endif
