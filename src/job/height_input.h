/* The image of heights of a file: what every job on a surface reads. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_HEIGHT_INPUT_H
#define WT_JOB_HEIGHT_INPUT_H

#include "job/inputs.h"

/* The first image of heights over an area in metres, or a profile of them if `profiles`, whose name
 * has `name` in it unless that is NULL. WT_E_NOT_FOUND. */
wt_status flow_heights_read(flow_file *file, const char *name, bool profiles, const char *role,
                            const wt_job *work, wt_image *image, wt_error *err) WT_NODISCARD;

#endif
