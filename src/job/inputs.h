/* The files of a job: listing, opening with provenance, recording what failed. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_INPUTS_H
#define WT_JOB_INPUTS_H

#include "core/base/shared_params.h"
#include "weartrack/flow.h"

/* The records that a run has too. */
#define JOB_ROWS(type)                                                                             \
    FRICTION_TOLERANCE(type),                                                                      \
        {PARAM("replicates", type, replicates, WT_Q_NONE, FROM_TO(0, 100000)), .value = "N",       \
         .flags = PARAM_NO_CASE, .help = "draws behind the standard errors; 0 for none"},          \
        {PARAM("seed", type, seed, WT_Q_NONE, AT_LEAST(0)), .value = "N", .flags = PARAM_NO_CASE,  \
         .help = "seed of the draws behind the standard errors"},                                  \
        PARAM_THREADS(type)

/* One file of the sets of a job. */
typedef struct flow_file {
    const char *path;       /* to open; owned by the list */
    const char *name;       /* to show: `path` without the folder of the set; borrowed from it */
    const wt_file_set *set; /* whose options hold */
    bool of_folder;         /* not named itself, but found in a folder that was */
    /* by flow_open: */
    const wt_format_info *format;
} flow_file;

typedef struct flow_files {
    flow_file *file;
    size_t n;
    void *paths; /* the same for tsearch */
} flow_files;

/* All files of the sets in the order of their paths, so that no sum depends on the order in which
 * they are given. A file that is named twice is taken once, with a warning. A
 * pattern without a match is recorded as a failure (or ends the job, see wt_job.failures). */
wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                          flow_files *files, wt_error *err) WT_NODISCARD;
void flow_files_clear(flow_files *files);

/* How so many characters name a file: they are its name or path, or one of the two paths is the end
 * of the other behind a '/', as where a result was made in another folder. */
typedef enum flow_naming { FLOW_OTHER_FILE, FLOW_SAME_END, FLOW_SAME_NAME } flow_naming;
flow_naming flow_file_is(const flow_file *file, const char *named, size_t length);

/* Opens a file, finds its format among `kinds` and adds it to the provenance under `role`. */
wt_status flow_open(const wt_job *work, flow_file *file, const char *role, unsigned kinds,
                    wt_input **input, wt_error *err) WT_NODISCARD;
/* The same, but of a large file the provenance is left to flow_record with the input `beside`, on
 * another thread than that which reads the file; NULL where nothing is left. */
wt_status flow_open_paired(const wt_job *work, flow_file *file, const char *role, unsigned kinds,
                           wt_input **input, wt_input **beside, wt_error *err) WT_NODISCARD;
/* Adds a file that was opened to the provenance. */
wt_status flow_record(const wt_job *work, wt_input *input, const flow_file *file, const char *role,
                      wt_error *err) WT_NODISCARD;

/* How a file is read: by the options of its set, as the format that was found, if any. */
wt_read_options flow_read_options(const flow_file *file);

/* For an error of files none of which held what is needed: how many, and where to look. */
void flow_error_add_files(const flow_files *files, size_t n_failed, wt_error *err);

/* Whether a file that gave `failure` is one that merely lies in the folder that was named, without
 * measured data of the kind asked for: it is left out with a warning. Else it has failed. */
bool flow_skip_file(const wt_job *work, const flow_file *file, const wt_error *failure);

/* Has `take` read the files in turn. What it refuses is left out of its folder or has failed, and
 * the others go on; *n_failed: how many failed. */
typedef wt_status flow_process(void *user, flow_file *file, size_t i, wt_error *err);
wt_status flow_files_process(const flow_files *files, const wt_job *work, flow_process *take,
                             void *user, size_t *n_failed, wt_error *err) WT_NODISCARD;

/* Whether a failure of one file leaves the others alone: false for lack of memory, cancelling,
 * internal errors, and when the job keeps no failures. */
bool flow_may_continue(const wt_job *work, wt_status status);
/* Adds a row to the failures. */
wt_status flow_add_failure(const wt_job *work, const char *what, const wt_error *failure,
                           wt_error *err) WT_NODISCARD;

#endif
