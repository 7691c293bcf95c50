/* weartrack - job: what all jobs share: options, input files, failures, cost; conversion of a file
 * to tables. A job is one step of the work. A subcommand runs one job, a run of a case runs
 * several.
 *
 * Jobs return tables with the names, columns and units that the report draws. See core.h for
 * ownership and errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_JOB_H
#define WEARTRACK_JOB_H

#include "weartrack/read.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what every job takes ------------------------------------------------------------------- */

/* Optional outputs of a job, besides its main table. */
typedef enum wt_optional_output {
    WT_EXTRA_EXTRAPOLATED_SHARE = 1, /* friction: extrapolated share, else NaN */
    WT_EXTRA_MODULUS_DEPTH = 2,      /* force curves: table modulus_depth */
    WT_EXTRA_DRAWS = 4,           /* isotherms: draws of the material as tables material_draws and
                                     series_draws, and for the replicates */
    WT_EXTRA_DIGESTS = 8,         /* SHA-256 of the files read, else "" */
    WT_EXTRA_SUMMARY = 16,        /* items and errors in the cost, else only nodes and files */
    WT_EXTRA_LAYER_TIMES = 32,    /* layer: incubation time and time to 90 %, else NaN */
    WT_EXTRA_REDUCED_SERIES = 64, /* isotherms: reduced series */
    WT_EXTRA_SPECTRUM = 128,      /* isotherms: relaxation spectrum with its error */
    WT_EXTRA_TRANSITION = 256,    /* temperature sweeps: the peaks, else no rows */
    WT_EXTRA_SYSTEMATIC_ERRORS = 512, /* force curves: effect of systematic errors */
    WT_EXTRA_DEPTH_CURVES = 1024,     /* force curves: values for the analysis of depth, else NaN */
    WT_EXTRA_MASTER_CURVE = 2048,     /* isotherms: fitted moduli and table master_curve */
    WT_EXTRA_INFLUENCES = 4096,       /* isotherms: fits without one of them, table influences */
    WT_EXTRA_ALL = 8191
} wt_optional_output;

typedef struct wt_cost wt_cost;
typedef struct wt_material_cache wt_material_cache;

typedef struct wt_job {
    const wt_formats *formats; /* borrowed; needed by jobs that read files */
    unsigned threads;          /* 0 = one per processor; never changes a result */
    double tolerance;          /* requested relative numerical error; default 1e-10 */
    uint64_t seed;             /* seed of the replicates */
    size_t replicates;         /* for standard errors; default 200, 0 = no standard errors */
    wt_progress progress;
    wt_log *log;               /* borrowed, may be NULL */
    wt_provenance *provenance; /* receives every file read; may be NULL */
    wt_table *failures; /* from wt_failures_new: a file or curve that fails adds a row and the work
                           continues; NULL: the first failure ends the job */
    unsigned left_out;  /* wt_optional_output flags that are not computed; default 0 */
    wt_cost *cost;      /* borrowed; NULL (default): no cost */
    wt_material_cache
        *drawn;    /* set by wt_run_case: cache of material draws, shared by its jobs; NULL */
    wt_sweep *dma; /* set by wt_run_case: DMA files of the case, read once for all its jobs; NULL */
    void (*case_advice)(
        wt_error *failure); /* set by wt_run_case: adds how to request the missing data in a case */
} wt_job;
WT_API wt_job wt_job_defaults(void);
WT_API const wt_params *wt_job_params(void);

#define WT_NO_REPLICATE SIZE_MAX /* instead of a replicate: the fitted values */

/* ---- input files ---------------------------------------------------------------------------- */

/* Files with common reading options. Initialise with {.read = wt_read_defaults()}. */
typedef struct wt_file_set {
    const char *const *patterns; /* [n_patterns] files, folders or shell patterns */
    size_t n_patterns;
    const char *folder; /* folder of relative patterns; NULL = current folder */
    wt_read_options read;
    const char *spot; /* force files: name of the spot of all these curves; NULL: each file is a
                         spot, or each grid position if the group is one file */
} wt_file_set;
WT_API const wt_params *wt_file_set_params(void);

/* Adds a file that the caller has read itself to provenance and cost. `input` has its path, role,
 * group and format. */
WT_API wt_status wt_job_add_input(const wt_job *work, wt_provenance_input input, wt_input *file,
                                  wt_error *err) WT_NODISCARD;
/* Reads the tables of a file that is an input of the work (NULL: no input), with a role that
 * depends on the content. The file is a text stream ("-" is standard input), a foreign text table
 * or an HDF5 result. Errors show `name`. */
typedef struct wt_tables_role {
    const char *group; /* of force-curve results, which then have WT_ROLE_GROUP; NULL: `role` */
    wt_input_role role;
    const char *instead; /* advice for a file of another kind; NULL: results of weartrack */
} wt_tables_role;
WT_API wt_status wt_tables_read(const char *path, const char *name, const wt_job *work,
                                wt_tables_role role, wt_result **tables,
                                wt_error *err) WT_NODISCARD;
/* Variant that reads and checks only the tables of an HDF5 result for wt_result_main_values. */
WT_API wt_status wt_tables_read_main_values(const char *path, wt_result **tables,
                                            wt_error *err) WT_NODISCARD;

/* ---- failures and notes --------------------------------------------------------------------- */

WT_API wt_table *wt_failures_new(void); /* Creates the table "failures"; NULL when out of memory. */
/* Sets the completeness of the result in a table of at least one failure (key "status"). */
WT_API wt_status wt_failures_set_status(wt_table *failures, wt_result_status answered,
                                        wt_error *err) WT_NODISCARD;
/* Handles the failure of a file or sample. It adds a row to the failures, whose message does not
 * repeat the name, and returns WT_OK. Without a table of failures, or if the work cannot continue,
 * it returns the error and `status`. */
WT_API wt_status wt_job_add_failure(const wt_job *work, const char *file, wt_status status,
                                    wt_error *failure, wt_error *err) WT_NODISCARD;
/* Creates the table "notes" of a log. Names of files below `folder` are shown relative to it; NULL
 * = unchanged. */
WT_API wt_status wt_notes_table(const wt_log *log, const char *folder, wt_table **table,
                                wt_error *err) WT_NODISCARD;
/* Severity of a row of a table with a column "severity", such as "notes"; WT_NOTE without one. */
WT_API wt_severity wt_table_severity(const wt_table *table, size_t row);
/* Creates the table "data_quality" of the actions on data in a log; *table is NULL if there are
 * none. `folder` as above. Free with wt_table_free. */
WT_API wt_status wt_data_quality_table(const wt_log *log, const char *folder, wt_table **table,
                                       wt_error *err) WT_NODISCARD;

/* ---- what jobs cost ------------------------------------------------------------------------- */

/* Creates the cost of jobs by stage. `timed` false: counts without times, so that repeated runs
 * give the same table. NULL when out of memory. */
WT_API wt_cost *wt_cost_new(bool timed, unsigned threads);
WT_API void wt_cost_free(wt_cost *cost);
/* Begins a stage and ends the one before. Later work of jobs with this cost counts for this stage.
 * NULL: no effect. */
WT_API void wt_cost_begin_stage(wt_cost *cost, const char *stage);
/* Ends the last stage and creates the table "cost", one row for each stage. */
WT_API wt_status wt_cost_table(wt_cost *cost, wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- convert -------------------------------------------------------------------------------- */

typedef struct wt_convert_job {
    unsigned kind; /* WT_KIND_* for a file of several kinds; 0: the first with data in the order
                      force, sweep, spectrum, image */
    wt_read_options read;
} wt_convert_job;
WT_API wt_convert_job wt_convert_job_defaults(void);
WT_API const wt_params *wt_convert_job_params(void);

/* Callback that takes ownership of one table (also on failure) as soon as it exists. */
typedef wt_status (*wt_table_sink)(void *user, wt_table *table, wt_error *err);
/* Converts a file to tables in SI units: "force_curve/I" for each curve, "sweep", "roughness",
 * "image/I". The file is in the provenance before the first table. WT_E_EMPTY if there are no data
 * of that kind. */
WT_API wt_status wt_convert_file(const wt_convert_job *job, const char *path, const wt_job *work,
                                 wt_table_sink sink, void *user, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
