/* Force curves from their contact points, as a result has them. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_ALIGNED_CURVES_H
#define WT_JOB_ALIGNED_CURVES_H

#include "job/inputs.h"

/* The tables of indentation of a result; a zero-initialised one is empty. */
typedef struct contact_points {
    const char *path;
    wt_result *tables;
} contact_points;

wt_status contact_points_read(const char *path, const wt_job *work, contact_points *points,
                              wt_error *err) WT_NODISCARD;
void contact_points_clear(contact_points *points);

/* A curve with three channels, and time where it is known: the height from the contact point,
 * rising into the sample; the force above the baseline; the indentation. `to` is reused.
 * WT_E_NOT_FOUND for a curve that the result does not have, or not with a contact point. */
wt_status from_contact(const contact_points *points, const flow_file *file,
                       const wt_force_curve *curve, const wt_job *work, wt_force_curve *to,
                       wt_error *err) WT_NODISCARD;

#endif
