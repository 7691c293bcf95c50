/* Conditioning: checks between reading and computing. What is left out or corrected, and what is
 * implausible, is logged with its count, place and effect. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_CONDITIONING_H
#define WT_JOB_CONDITIONING_H

#include "job/inputs.h"

/* Hash of values that follow those of the hash `before`, 0 for none. */
uint64_t flow_hash_samples(uint64_t before, const double *x, size_t n);
/* Returns WT_END, with a warning, if a file has the samples of one before it, under another name or
 * with another header: flow_skip_file is then true. */
wt_status flow_check_copy(flow_file *file, uint64_t samples, const wt_job *work);
/* The two parts of it, for a file of many curves. The first returns the earlier file with the same
 * samples; NULL if there is none, or if `file` counts as it stands. The second warns that n of
 * n_all curves are copies. */
const flow_file *flow_find_original(const flow_file *file, uint64_t samples);
void flow_log_copy(flow_file *file, const flow_file *original, size_t n, size_t n_all,
                   const wt_job *work);
/* Hash of all channels of a record. */
uint64_t condition_hash_record(const wt_record *record);
/* Leaves out samples of friction and load that are far from all others (they become NaN), sets a
 * load within the scatter of the unloaded sensor to 0, and subtracts the zero of the friction force
 * that is seen before loading. */
void condition_record(wt_record *record, const char *file, wt_log *log);
/* Warns of moduli, frequencies and temperatures that rubber and instruments do not have, and of
 * isotherms of one temperature that differ. Nothing is changed. */
void check_sweep(const wt_sweep *sweep, wt_log *log);
/* Warns of a friction coefficient that rubber does not have. */
void check_friction_coefficient(double typical, const char *file, wt_log *log);

typedef struct typical_values {
    double middle, most; /* values further from the middle than `most` are outliers */
} typical_values;

/* Computes the median and five standard deviations of n > 0 values, which are changed. The standard
 * deviation follows from the median absolute deviation. If more than half of the values equal the
 * median, it follows from the mean absolute deviation (Iglewicz and Hoaglin 1993). */
typical_values flow_typical_values(double *values, size_t n);

#endif
