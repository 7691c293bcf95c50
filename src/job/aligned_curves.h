/* Aligns force curves at the contact points of a result. Internal to job. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_JOB_ALIGNED_CURVES_H
#define WT_JOB_ALIGNED_CURVES_H

#include "job/inputs.h"

/* Indentation tables of a result; a zero-initialised structure is empty. */
typedef struct contact_points {
    const char *path;
    wt_result *tables;
} contact_points;

wt_status contact_points_read(const char *path, const wt_job *work, contact_points *points,
                              wt_error *err) WT_NODISCARD;
void contact_points_clear(contact_points *points);

/* Aligns a curve. The new curve has three channels, and time if it is known: the height from the
 * contact point, increasing into the sample; the force above the baseline; the indentation. `to` is
 * reused. WT_E_NOT_FOUND if the result lacks the curve or its contact point. */
wt_status align_with_contact(const contact_points *points, const flow_file *file,
                             const wt_force_curve *curve, const wt_job *work, wt_force_curve *to,
                             wt_error *err) WT_NODISCARD;

#endif
