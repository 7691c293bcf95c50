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

/* Curves of a file that have the samples of curves of other files. */
typedef struct copied_curves {
    const flow_file *original; /* of the first copy */
    size_t n;
} copied_curves;

/* Hash of all channels of a curve; 0 if the list of its file has no other file. */
uint64_t condition_hash_curve(const flow_file *file, const wt_force_curve *curve);
/* Returns true and counts the curve if an earlier file has the same samples, unless `file` counts
 * as it stands. Curves of one file are not compared. */
bool flow_is_copied_curve(flow_file *file, uint64_t samples, copied_curves *copies);
/* Warns of the copies among the n_all curves of a file, if there are any. */
void flow_log_copies(flow_file *file, const copied_curves *copies, size_t n_all,
                     const wt_job *work);
/* Hash of all channels of a record; 0 if the list of its file has no other file. */
uint64_t condition_hash_record(const flow_file *file, const wt_record *record);
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
