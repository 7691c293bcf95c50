/* Parts of weartrack master. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_CMD_MASTER_H
#define WEARTRACK_CMD_MASTER_H

#include "cmd/cmd.h"

/* Fits each sample, compares the samples, fits a shared law if requested and finishes the call.
 * `set` is the file set of the job. */
void fit_sample_masters(cmd_session *s, wt_master_job *job, wt_shared_shift_law_job *common,
                        wt_file_set *set, const wt_sample_names *samples);

#endif
