/* Copies among the input files of a job. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_FILE_COPIES_H
#define WT_JOB_FILE_COPIES_H

#include "job/inputs.h"

/* Removes each file with the same bytes as an earlier one of the list, with a warning that names
 * both. A copy is no second measurement. A file that cannot be read stays; opening it reports the
 * error. Only files of equal size are read, and of these the whole only if their ends agree. */
void file_copies_remove(flow_files *files, const wt_job *work);

#endif
