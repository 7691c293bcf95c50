/* Reads the height image of a file, for all jobs on surfaces. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_HEIGHT_INPUT_H
#define WT_JOB_HEIGHT_INPUT_H

#include "job/inputs.h"

/* Reads the first image with heights in metres over an area in metres, or a profile with
 * `profiles`. Its name contains `name`, unless that is NULL. WT_E_NOT_FOUND without such an
 * image. */
wt_status flow_heights_read(flow_file *file, const char *name, bool profiles, const char *role,
                            const wt_job *work, wt_image *image, wt_error *err) WT_NODISCARD;

#endif
