/* The files of a job: listing, opening with provenance, recording what failed. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_INPUTS_H
#define WEARTRACK_FLOW_INPUTS_H

#include "weartrack/flow.h"

/* One file of the sets of a job. */
typedef struct flow_file {
    const char *path;       /* to open; owned by the list */
    const char *name;       /* to show: `path` without the folder of the set; borrowed from it */
    const wt_file_set *set; /* whose options hold */
    /* by flow_open: */
    const wt_format_info *format;
    wt_read_options read; /* options of the set, with the format that was found */
} flow_file;

typedef struct flow_files {
    flow_file *file;
    size_t n;
} flow_files;

/* All files of the sets in their order. A file that is named twice is taken once, with a warning. A
 * pattern without a match is recorded as a failure (or ends the job, see wt_job.failures). */
wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *common,
                          flow_files *files, wt_error *err) WT_NODISCARD;
void flow_files_clear(flow_files *files);

/* Opens a file, finds its format among `kinds` and adds it to the provenance under `role`. */
wt_status flow_open(const wt_job *common, flow_file *file, const char *role, unsigned kinds,
                    wt_input **input, wt_error *err) WT_NODISCARD;

/* A measured spectrum as a surface, uncut; the densities are not checked. */
wt_status flow_surface_read(flow_file *file, const wt_job *common, wt_surface *surface,
                            wt_error *err) WT_NODISCARD;

/* Table "notes" of a log, with the names of files below `folder` shown without it; NULL = as they
 * are. */
wt_status flow_notes_table(const wt_parselog *log, const char *folder, wt_table **table,
                           wt_error *err) WT_NODISCARD;

/* Whether a failure of one file leaves the others alone: false for lack of memory, cancelling,
 * internal errors, and when the job keeps no failures. */
bool flow_goes_on(const wt_job *common, wt_status status);
/* Adds a row to the failures. */
wt_status flow_failed(const wt_job *common, const char *file, const wt_error *failure,
                      wt_error *err) WT_NODISCARD;

#endif
