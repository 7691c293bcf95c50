/* Conditioning: checks between reading and computing. What is left out or corrected, and what is
 * implausible, is logged with its count, place and effect. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_CONDITIONING_H
#define WT_JOB_CONDITIONING_H

#include "weartrack/core.h"

/* Leaves out samples of friction and load that are far from all others (they become NaN), sets a
 * load within the scatter of the unloaded sensor to 0, and subtracts the zero of the friction force
 * that is seen before loading. */
void condition_record(wt_record *record, const char *file, wt_log *log);
/* Warns of moduli, frequencies and temperatures that rubber and instruments do not have, and of
 * isotherms of one temperature that differ. Nothing is changed. */
void check_sweep(const wt_sweep *sweep, wt_log *log);
/* Warns of a friction coefficient that rubber does not have. */
void check_friction_coefficient(double typical, const char *file, wt_log *log);

#endif
