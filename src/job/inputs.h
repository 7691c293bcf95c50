/* Input files of a job. The functions list and open them, and record failures. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_INPUTS_H
#define WT_JOB_INPUTS_H

#include "core/base/shared_params.h"
#include "weartrack/job.h"
#include <stddef.h>
#include <stdint.h>

/* Parameters of a job that a run also has. */
#define JOB_ROWS(type)                                                                             \
    FRICTION_TOLERANCE(type),                                                                      \
        {PARAM("replicates", type, replicates, WT_Q_NONE, FROM_TO(0, 100000)), .value = "N",       \
         .flags = PARAM_NO_CASE, .help = "draws behind the standard errors; 0 for none"},          \
        {PARAM("seed", type, seed, WT_Q_NONE, AT_LEAST(0)), .value = "N", .flags = PARAM_NO_CASE,  \
         .help = "seed of the draws behind the standard errors"},                                  \
        PARAM_THREADS(type)

typedef struct sample_slot {
    uint64_t hash;
    const void *owner; /* NULL: the slot is free */
} sample_slot;

/* Hash table with open addressing: a map has a million curves, of which each is looked up once. */
typedef struct sample_set {
    sample_slot *slot; /* [size] */
    size_t size, n;    /* size is 0 or a power of two */
} sample_set;

void sample_set_clear(sample_set *set);

/* Input file of a job. */
typedef struct flow_file {
    const char *path; /* for opening; owned by the list */
    const char *name; /* for messages: `path` without the folder of the set; points into `path` */
    size_t number;    /* in the order of the arguments */
    const wt_file_set *set; /* set with the options for this file */
    bool from_folder;       /* found in a folder, not named itself */
    const char *group;      /* its name, if opened as WT_ROLE_GROUP */
    /* set by flow_open: */
    const wt_format_info *format;
    bool is_copy;     /* set by flow_check_copy */
    sample_set *seen; /* samples of the files of the list; owned by it; NULL of a single file */
} flow_file;

typedef struct flow_files {
    flow_file *file;
    size_t n;
    sample_set *seen;
} flow_files;

/* Lists all files of the sets in the order of their paths, so that sums do not depend on the order
 * of the arguments. A file that is named twice is used once, with a warning. A pattern without a
 * match is recorded as a failure, or ends the job (see wt_job.failures). */
wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                          flow_files *files, wt_error *err) WT_NODISCARD;
void flow_files_clear(flow_files *files);

/* Result of matching a name with a file: equal to its name or path, or one path is the end of the
 * other after a '/', for example if a result was created in another folder. */
typedef enum flow_name_match {
    FLOW_NAME_DIFFERENT,
    FLOW_NAME_SAME_SUFFIX,
    FLOW_NAME_EQUAL
} flow_name_match;
flow_name_match flow_file_match(const flow_file *file, const char *named, size_t length);

/* Opens a file, detects its format among `kinds` and adds it to the provenance under `role`. */
wt_status flow_open(const wt_job *work, flow_file *file, wt_input_role role, unsigned kinds,
                    wt_input **input, wt_error *err) WT_NODISCARD;
/* Variant for large files. If *paired is not NULL, the caller must add the file to the provenance
 * with flow_record_input, using this second input in another thread. */
wt_status flow_open_paired(const wt_job *work, flow_file *file, wt_input_role role, unsigned kinds,
                           wt_input **input, wt_input **paired, wt_error *err) WT_NODISCARD;
/* Adds an opened file to the provenance. */
wt_status flow_record_input(const wt_job *work, wt_input *input, const flow_file *file,
                            wt_input_role role, wt_error *err) WT_NODISCARD;

/* Returns `path` without the prefix `folder`. */
const char *flow_relative_path(const char *folder, const char *path);
/* Returns the read options of a file: those of its set, with the detected format. */
wt_read_options flow_read_options(const flow_file *file);

/* Adds the number of files and advice to an error of files that lack the necessary data. */
void flow_error_add_files(const flow_files *files, size_t n_failed, wt_error *err);

/* Returns true if the file was only found in a folder and has no data of the requested kind. It is
 * then skipped with a warning. Otherwise the file has failed. */
bool flow_skip_file(const wt_job *work, const flow_file *file, const wt_error *failure);

/* Calls `process` for each file. A file with an error is skipped or recorded as a failure, and the
 * others are processed. *n_failed is the number of failures. */
typedef wt_status flow_process(void *user, flow_file *file, size_t i, wt_error *err);
wt_status flow_files_process(const flow_files *files, const wt_job *work, flow_process *process,
                             void *user, size_t *n_failed, wt_error *err) WT_NODISCARD;

/* Returns true if the job continues after a failure of one file. False for lack of memory,
 * cancellation and internal errors, and for jobs without a table of failures. */
bool flow_may_continue(const wt_job *work, wt_status status);
/* Adds a row to the table of failures. */
wt_status flow_add_failure(const wt_job *work, const char *what, const wt_error *failure,
                           wt_error *err) WT_NODISCARD;

/* Reads the first image with heights in metres over an area in metres, or a profile with
 * `profiles`. Its name contains `name`, unless that is NULL. WT_E_NOT_FOUND without such an
 * image. */
wt_status flow_heights_read(flow_file *file, const char *name, bool profiles, wt_input_role role,
                            const wt_job *work, wt_image *image, wt_error *err) WT_NODISCARD;

#endif
