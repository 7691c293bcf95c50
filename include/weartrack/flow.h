/* weartrack - flow: the jobs (one for each step, used alone by a subcommand and together by a run),
 * the case file, the plan (its stages with reasons) and its execution.
 *
 * Jobs return tables with the names, columns and units that the report draws; see base.h for
 * ownership and errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_H
#define WEARTRACK_FLOW_H

#include "weartrack/fit.h"
#include "weartrack/kernel.h"
#include "weartrack/read.h"
#include "weartrack/report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what all jobs share --------------------------------------------------------------------- */

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
    WT_EXTRA_ALL = 2047
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
/* Adds a file that the caller has read itself to provenance and cost. `input` has its path, role
 * and format. */
WT_API wt_status wt_job_add_input(const wt_job *work, wt_provenance_input input, wt_input *file,
                                  wt_error *err) WT_NODISCARD;
/* Reads the tables of a file that is an input of the work (NULL: no input), with a role that
 * depends on the content. The file is a text stream ("-" is standard input), a foreign text table
 * or an HDF5 result. Errors show `name`. wt_tables_role has the role of force-curve results and of
 * other tables. */
typedef struct wt_tables_role {
    const char *curve_role, *other_role;
    const char *instead; /* advice for a file of another kind; NULL: results of weartrack */
} wt_tables_role;
WT_API wt_status wt_tables_read(const char *path, const char *name, const wt_job *work,
                                wt_tables_role role, wt_result **tables,
                                wt_error *err) WT_NODISCARD;
/* Variant for wt_result_main_values that reads only the necessary tables of an HDF5 result. */
WT_API wt_status wt_tables_read_main_values(const char *path, wt_result **tables,
                                            wt_error *err) WT_NODISCARD;
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
/* Creates the table "methods" of a result: the methods that produced its tables, in sentences with
 * numbers and references. */
WT_API wt_status wt_methods_table(const wt_result *result, wt_table **table,
                                  wt_error *err) WT_NODISCARD;
/* Creates the cost of jobs by stage. `timed` false: counts without times, so that repeated runs
 * give the same table. NULL when out of memory. */
WT_API wt_cost *wt_cost_new(bool timed, unsigned threads);
WT_API void wt_cost_free(wt_cost *cost);
/* Begins a stage and ends the one before. Later work of jobs with this cost counts for this stage.
 * NULL: no effect. */
WT_API void wt_cost_begin_stage(wt_cost *cost, const char *stage);
/* Ends the last stage and creates the table "cost", one row for each stage. */
WT_API wt_status wt_cost_table(wt_cost *cost, wt_table **table, wt_error *err) WT_NODISCARD;
/* Logs remarks on the tables of a result: a tolerance that is not reached, extrapolation. */
WT_API void wt_result_log_remarks(const wt_result *result, wt_log *log);
/* Formats the summary line of a result, its main numbers, "" if it has none. Returns the length as
 * snprintf does. */
WT_API size_t wt_result_summary_line(const wt_result *result, char *buffer, size_t size);

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

/* ---- convert --------------------------------------------------------------------------------- */

typedef struct wt_convert_job {
    unsigned kind; /* WT_KIND_* for a file of several kinds; 0: the first with data in the order
                      force, sweep, spectrum, image */
    const char *contact; /* result of weartrack indent: force curves are relative to its contact
                            points and baselines, with the indentation; NULL = as measured */
    wt_read_options read;
} wt_convert_job;
WT_API wt_convert_job wt_convert_job_defaults(void);
WT_API const wt_params *wt_convert_job_params(void);

/* Callback that takes ownership of one table (also on failure) as soon as it exists. */
typedef wt_status (*wt_table_sink)(void *user, wt_table *table, wt_error *err);
/* Callback for one curve, which it borrows. */
typedef wt_status (*wt_curve_sink)(void *user, const wt_force_curve *curve, wt_error *err);
/* Converts a file to tables in SI units: "force_curve/I" for each curve, "sweep", "roughness",
 * "image/I". The file is in the provenance before the first table. Curves go to `curves` instead,
 * unless it is NULL. WT_E_EMPTY if there are no data of that kind. */
WT_API wt_status wt_convert_file(const wt_convert_job *job, const char *path, const wt_job *work,
                                 wt_table_sink sink, wt_curve_sink curves, void *user,
                                 wt_error *err) WT_NODISCARD;

/* ---- indentation ----------------------------------------------------------------------------- */

/* Systematic error sources common to all curves of a group, which their scatter does not show. */
typedef enum wt_systematic_source {
    WT_SYSTEMATIC_SPRING_CONSTANT,
    WT_SYSTEMATIC_SENSITIVITY,
    WT_SYSTEMATIC_HALF_ANGLE,
    WT_SYSTEMATIC_RADIUS,
    WT_SYSTEMATIC_SOURCES
} wt_systematic_source;

typedef struct wt_indent_job {
    const char *group; /* "bulk", "track" or another name of [a-z0-9_]+ */
    const wt_file_set *sets;
    size_t n_sets;
    wt_tip tip;
    wt_indent_options options;
    /* Values of all curves with their errors (0 = not stated); value NaN: as in the files. */
    wt_estimate spring_constant, sensitivity;
    /* Relative standard errors if the values state none; 0 (default) = none. */
    double lever_error, sensitivity_error;
    bool rates;        /* decodes times for the piezo and indentation rates */
    bool median_curve; /* stores the representative curve for the figures */
    /* Curves to store: "median" (which sets median_curve), "rejected", "worst:N", "all", "FILE:N".
     */
    const char *const *curves;
    size_t n_curves;
    const char *choices;            /* file of manual overrides for files and curves; NULL = none */
    const struct wt_rubber *rubber; /* a factor on its spectrum is fitted; NULL (default) = none */
    wt_estimate
        temperature; /* temperature of the curves [K]; NaN = reference temperature of the rubber */
    struct wt_curve_set *keep; /* receives the accepted curves; NULL (default) */
} wt_indent_job;
WT_API wt_indent_job wt_indent_job_defaults(void);
WT_API const wt_params *wt_indent_job_params(void);

/* Accepted curves of a group with their fits, for the bootstrap of wt_coverage_compute. NULL when
 * out of memory. */
typedef struct wt_curve_set wt_curve_set;
WT_API wt_curve_set *wt_curve_set_new(void);
WT_API void wt_curve_set_free(wt_curve_set *set);

/* Tables of indentation, each freed with wt_table_free, all with wt_indent_tables_clear. Initialise
 * with zeros. For a further group, first take `indentation` (set it to NULL); the other tables are
 * appended to. */
typedef struct wt_indent_tables {
    wt_table *indentation;        /* indentation/GROUP, one row per curve, also of rejected ones */
    wt_table *force_displacement; /* NULL unless curves are requested */
    wt_table *force_indentation;
    wt_table *curves;        /* samples of the stored curves; NULL if there are none */
    wt_table *choices;       /* applied manual overrides; NULL without choices */
    wt_table *modulus_depth; /* NULL if no group has enough curves */
    size_t n_files, n_curves, n_accepted, n_failed;
} wt_indent_tables;
WT_API void wt_indent_tables_clear(wt_indent_tables *tables);

/* Fits every curve of every file. Files are streamed and fitted in parallel batches, so that memory
 * is bounded. The order of rows is that of files and curves for any number of threads. WT_E_EMPTY
 * if no file has a curve. */
WT_API wt_status wt_indent_group(const wt_indent_job *job, const wt_job *work,
                                 wt_indent_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- dwells ---------------------------------------------------------------------------------- */

typedef struct wt_dwell_tables {
    wt_table *dwell, *dwell_points, *dwell_moduli;
} wt_dwell_tables;
WT_API void wt_dwell_tables_clear(wt_dwell_tables *tables);
/* Evaluates the first dwell after the approach of every curve, with the tip and options of an
 * indentation job. WT_E_EMPTY if no curve has one. */
WT_API wt_status wt_dwell_compute(const wt_indent_job *job, const wt_job *work,
                                  wt_dwell_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- images of a spot ------------------------------------------------------------------------ */

typedef struct wt_spot_job {
    wt_tip tip;
    double depth; /* indentation depth [m] */
    double x, y;  /* position in the coordinates of the image [m]; NaN (default) = its middle */
    double position_error; /* [m]; NaN (default) = one contact radius */
    double largest_effect; /* largest acceptable effect of roughness on the contact area; default
                              0.1 */
    const char *image;     /* part of the name of the image; NULL = first height image */
    const char *after;     /* file with the image after the indentation; NULL = none */
    wt_read_options read;  /* for both files; initialise with wt_read_defaults() */
    bool map;              /* also computes the table spot_map */
} wt_spot_job;
WT_API wt_spot_job wt_spot_job_defaults(void);
WT_API const wt_params *wt_spot_job_params(void);
typedef struct wt_spot_tables {
    wt_table *spot, *spot_map; /* spot_map: NULL unless requested */
} wt_spot_tables;
WT_API void wt_spot_tables_clear(wt_spot_tables *tables);
/* Evaluates the image `path` before the indentation: roughness over the contact relative to the
 * depth, and the remaining imprint. WT_E_NOT_FOUND if the file has no such height image, WT_E_RANGE
 * if sides or pixels of the images differ by more than a factor of four. */
WT_API wt_status wt_spot_compute(const wt_spot_job *job, const char *path, const wt_job *work,
                                 wt_spot_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- measured surfaces ----------------------------------------------------------------------- */

typedef struct wt_topography_job {
    const wt_file_set *sets; /* height maps and profiles of one surface */
    size_t n_sets;
    wt_surface_options options;
    const char *image; /* part of the name of the image; NULL = first height image */
    double end;        /* last wavenumber [rad/m]; NaN = that of the reliable range */
    double end_slope;  /* ends the spectrum at this rms slope instead; NaN = none */
    bool scans;        /* also computes the table scan_spectra */
    bool heights;      /* also computes the tables height_map and height_profile */
} wt_topography_job;
WT_API wt_topography_job wt_topography_job_defaults(void);
WT_API const wt_params *wt_topography_job_params(void);
typedef struct wt_topography_tables {
    wt_table *power_spectrum, *surfaces;
    wt_table *place_errors;     /* NULL for scans of one size */
    wt_table *angular_spectrum; /* NULL for profiles */
    wt_table *scan_spectra, *height_map,
        *height_profile; /* NULL unless requested; height_map NULL also for profiles */
} wt_topography_tables;
WT_API void wt_topography_tables_clear(wt_topography_tables *tables);
/* Computes the power spectrum of a surface. Scans of several sizes are stitched, several positions
 * averaged, profiles inverted. If end or end_slope requires it, the self-affine law extends the
 * reliable range. WT_E_EMPTY if no file has heights or no wavenumber is reliable, WT_E_RANGE if the
 * requested end cannot be reached. */
WT_API wt_status wt_topography_compute(const wt_topography_job *job, const wt_job *work,
                                       wt_topography_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- calibration of the cantilever ----------------------------------------------------------- */

typedef enum wt_curve_direction {
    WT_DIRECTION_BOTH,
    WT_DIRECTION_APPROACH,
    WT_DIRECTION_RETRACT
} wt_curve_direction;

/* Deflection sensitivity from curves on a hard surface. */
typedef struct wt_sensitivity_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_slope_options options;
    wt_curve_direction ways; /* directions of the result */
    double max_slope_change; /* largest relative change of the slope within the part that counts as
                         straight */
} wt_sensitivity_job;
WT_API wt_sensitivity_job wt_sensitivity_job_defaults(void);
WT_API const wt_params *wt_sensitivity_job_params(void);
typedef struct wt_sensitivity_tables {
    wt_table *sensitivity, *sensitivity_curves;
} wt_sensitivity_tables;
WT_API void wt_sensitivity_tables_clear(wt_sensitivity_tables *tables);
/* WT_E_EMPTY if no file has a curve. If the surface is compliant or the signal is not straight
 * there is no sensitivity; the verdict has the reason. */
WT_API wt_status wt_sensitivity_compute(const wt_sensitivity_job *job, const wt_job *work,
                                        wt_sensitivity_tables *tables, wt_error *err) WT_NODISCARD;

/* Spring constant of a cantilever from its thermal noise: k = mode_shape / chi^2 k_B T / <d^2>,
 * with the deflection d from the sensitivity on a hard surface. If the plan view or the coefficient
 * of the cantilever type are stated, Sader's method is also used. */
typedef struct wt_thermal_job {
    const wt_file_set *sets; /* read.sensitivity [m/V] for spectra in volts without their own */
    size_t n_sets;
    wt_estimate
        temperature; /* of the cantilever [K]; NaN: that of the file, else 25 degC with a warning */
    double sensitivity_error;  /* relative */
    double mode_shape;         /* share of the first mode in the thermal energy of the deflection */
    double chi;                /* sensitivity of the free cantilever over that on a surface */
    double from, to;           /* range of the fit [Hz]; NaN: about the peak */
    wt_estimate length, width; /* of a rectangular cantilever [m]; NaN: unknown */
    wt_medium medium;          /* medium around the cantilever */
    wt_estimate sader_coefficient; /* A of k = A Q f^1.3 [N/m per kHz^1.3]; NaN: unknown */
} wt_thermal_job;
WT_API wt_thermal_job wt_thermal_job_defaults(void);
WT_API const wt_params *wt_thermal_job_params(void);
/* Creates the table "thermal". WT_E_EMPTY if no file has a spectrum. */
WT_API wt_status wt_thermal_compute(const wt_thermal_job *job, const wt_job *work, wt_table **table,
                                    wt_error *err) WT_NODISCARD;

/* Rule for the end of the running-in. */
typedef enum wt_running_in_rule {
    WT_RUNNING_IN_LIKELIHOOD, /* wt_running_in_find */
    WT_RUNNING_IN_STEP,       /* wt_step_detect */
    WT_RUNNING_IN_MSER,       /* wt_mser_5 */
    WT_RUNNING_IN_NONE        /* no running-in */
} wt_running_in_rule;

/* Friction records: running-in, steady-state friction, wear. A step begins where the instrument
 * starts one, or where velocity, load, pressure or temperature change. */
typedef struct wt_record_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_cycle_kind cycle;
    wt_running_in_rule running_in;
    wt_estimate load;         /* [N] if the record states none; NaN: none */
    wt_estimate track_radius; /* [m], replaces that of the file; NaN: that of the file */
    /* Wear, NaN: unknown: one of the first three, else the depth of the record under a ball. */
    wt_estimate track_area; /* worn cross-section [m^2] */
    const char *profile; /* files of profiles across the track for the cross-section; NULL: none */
    const wt_file_set *profile_set; /* how these are read; NULL: as the records */
    wt_estimate mass_loss;          /* [kg]; needs `density` */
    wt_estimate density;            /* [kg/m^3] */
    wt_estimate track_length;       /* [m]; NaN: circumference of the track, or the stroke */
    wt_estimate ball_radius;        /* [m] */
    /* For the nominal pressure of the ball: */
    wt_estimate modulus;  /* Young's modulus of the rubber at the frequency of the contact [Pa] */
    double poisson_ratio; /* of the rubber */
} wt_record_job;
WT_API wt_record_job wt_record_job_defaults(void);
WT_API const wt_params *wt_record_job_params(void);
/* Checks that a mass has a density. */
WT_API wt_status wt_record_job_check(const wt_record_job *job, wt_error *err) WT_NODISCARD;
typedef struct wt_record_tables {
    wt_table *record, *record_cycles;
    wt_table *wear; /* NULL without data on wear */
} wt_record_tables;
WT_API void wt_record_tables_clear(wt_record_tables *tables);
/* WT_E_EMPTY if no file has a record. */
WT_API wt_status wt_record_compute(const wt_record_job *job, const wt_job *work,
                                   wt_record_tables *tables, wt_error *err) WT_NODISCARD;

/* Digest of the measured values of a curve, for finding duplicates; 0 = too few values. */
typedef struct wt_curve_digest {
    uint64_t digest;
    size_t item;
} wt_curve_digest;

/* The accepted moduli of an indentation table as a group for comparison. wt_group_data_clear frees
 * the arrays. A duplicate curve counts once. */
typedef struct wt_group_data {
    wt_group group; /* borrows the arrays below */
    double *modulus;
    long *spot;
    double *indentation_rate;     /* [n] m/s, NaN if unknown */
    double *equivalent_frequency; /* [n] rad/s, NaN if unknown */
    double *spectrum_factor;      /* [n] factor on the DMA spectrum, NaN if unknown */
    double *pull; /* [n] largest attractive force of approach and retract [N]; NaN if unknown */
    double *max_force, *max_indentation; /* [n] N, m; NaN if unknown */
    /* of all curves together: mean residual of the largest force, and the chance of more by
     * scatter; NaN if unknown */
    double pooled_misfit, pooled_misfit_p;
    /* [n_fitted] of the curves that were fitted, rejected ones too, for a misfit rejects them: cube
     * root of the lack of fit, number of the spot (not that of the accepted ones) */
    double *lack_of_fit;
    long *fitted_spot;
    size_t n_fitted;
    wt_curve_digest *digest;       /* [n_digests] of the curves, increasing */
    size_t n_digests, n_copies;    /* n_copies: number of excluded duplicates */
    const char *duplicate_file[2]; /* files of the first duplicate; borrowed from the table */
    wt_estimate spring_constant;   /* of the table; NaN if it has none */
    double sensitivity_gain;       /* mean of the curves, NaN if unknown */
    wt_estimate sensitivity;       /* stated value; NaN if none or several */
    /* Relative standard errors, NaN if not stated, and the derivative of ln E by each, NaN if
     * unknown. */
    double common_error[WT_SYSTEMATIC_SOURCES];
    wt_estimate common_gain[WT_SYSTEMATIC_SOURCES];
    double loss_error,
        bend_error; /* systematic errors of all moduli by loss and baseline curvature, the latter
                       with its sign; 0 if not detected, NaN if detected with unknown size */
    double misfit_error;          /* the same by lack of fit of the contact law */
    const char *tip;              /* description; borrowed from the table; NULL if unknown */
    bool has_several_cantilevers; /* the curves have several spring constants */
    bool has_several_sensitivities, has_several_tips;
    bool spots_are_named;            /* the user named the spots */
    wt_curve_verdict main_rejection; /* most frequent verdict of the rejected curves */
    size_t n_main_rejection;         /* number of curves with it */
} wt_group_data;
/* Reads a group from a table. A spot is a named one, else a file, or each position of the unnamed
 * ones with `spot_per_position`. */
WT_API wt_status wt_group_from_table(const wt_table *indentation, bool spot_per_position,
                                     wt_group_data *data, wt_error *err) WT_NODISCARD;
WT_API void wt_group_data_clear(wt_group_data *data);
/* Creates the table "modulus_groups", one row per indentation table. A group without an accepted
 * curve has a row with n = 0. */
WT_API wt_status wt_modulus_groups_table(const wt_table *const *indentation, size_t n,
                                         wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "modulus_budget": for each group the contributions of scatter and systematic
 * errors to the error of the modulus. NULL if no group states a systematic error. */
WT_API wt_status wt_modulus_budget_table(const wt_table *const *indentation, size_t n,
                                         wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- results of cases side by side ----------------------------------------------------------- */

/* A result of wt_run_case, identified by the sample and condition of the case, or by `file` and "";
 * or a result of wt_indent_group, whose groups are listed with the cases. */
typedef struct wt_collected_result {
    const wt_result *result;
    const char *file;
} wt_collected_result;

typedef struct wt_collect_job {
    double margin;          /* irrelevant relative difference of modulus ratios; default 0.2 */
    double constant_margin; /* irrelevant relative difference of shared constants; default 0.5 */
} wt_collect_job;
WT_API wt_collect_job wt_collect_job_defaults(void);
WT_API const wt_params *wt_collect_job_params(void);

/* Tables of these names. NULL: no case has data for it, or there is no pair. */
typedef struct wt_collection_tables {
    wt_table *collection, *collected_modulus, *collected_friction, *collected_force, *ratio_pairs,
        *shared_constants, *shared_members, *collected_constants, *shared_pairs;
} wt_collection_tables;
WT_API void wt_collection_tables_clear(wt_collection_tables *tables);
/* Compares cases. Modulus ratios of pairs count as independent. For shared constants, errors from
 * the same files are fully correlated. WT_E_EMPTY without a case; WT_E_AMBIGUOUS for two cases of
 * one sample and condition. */
WT_API wt_status wt_collection_compute(const wt_collected_result *cases, size_t n,
                                       const wt_collect_job *job, wt_collection_tables *tables,
                                       wt_error *err) WT_NODISCARD;

/* ---- DMA: shift factors, WLF, master curve, Prony -------------------------------------------- */

/* Names of the samples of isotherms and temperature sweeps, sorted; "" for sweeps without a name.
 */
typedef struct wt_sample_names {
    size_t n;
    char **name;
} wt_sample_names;
WT_API void wt_sample_names_clear(wt_sample_names *samples);
/* Reads the names; the caller clears `samples`. The data read are stored in work->dma, if it is not
 * NULL, for the jobs that fit them. */
WT_API wt_status wt_sample_names_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                                      wt_sample_names *samples, wt_error *err) WT_NODISCARD;

typedef struct wt_master_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_master_options fit;        /* reference_temperature NaN: the middle isotherm */
    double poisson_ratio;         /* of the rubber; default 0.5 */
    const char *const *leave_out; /* "temperature:LOW..HIGH" or "frequency:LOW..HIGH"; one limit may
                                     be missing, or one value replaces both */
    size_t n_leave_out;
    const char *shift_law;  /* "wlf:reference-temperature=T,c1=X,c2=X" or
                               "arrhenius:activation-energy=E", the law of all shifts; or NULL */
    const wt_table *shifts; /* columns temperature, log_a and optionally log_b of fixed shifts,
                               borrowed; or NULL */
    wt_reduction reduction; /* has its own parameters */
} wt_master_job;
WT_API wt_master_job wt_master_job_defaults(void);
WT_API const wt_params *wt_master_job_params(void);

/* One joint draw of the uncertain properties of a rubber. */
typedef struct wt_rubber_draw {
    wt_prony prony; /* at the reference temperature */
    wt_shift_law law;
    double *log_b; /* [n_vertical] */
} wt_rubber_draw;

/* Source of the moduli. */
typedef enum wt_rubber_kind {
    WT_RUBBER_SERIES, /* prony */
    WT_RUBBER_TABLE,  /* points of the single isotherm of `sweep`, linear in log-log */
    WT_RUBBER_ZENER   /* fractional Zener model, in tension */
} wt_rubber_kind;

/* Fractional Zener model: E(w) = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha. */
typedef struct wt_zener {
    double e0, eg; /* [Pa] */
    double tau;    /* [s] */
    double alpha;
} wt_zener;

/* A rubber: moduli at one reference temperature, and their dependence on temperature. */
typedef struct wt_rubber {
    wt_rubber_kind kind;
    wt_prony prony; /* E or G as measured, vertical shift applied, at the reference temperature;
                       without terms for other kinds */
    wt_zener zener;
    wt_extrapolation extrapolation; /* of a table */
    double poisson_ratio;
    bool is_transverse; /* the moduli are the E that `transverse` multiplies */
    wt_transverse transverse;
    wt_shift_law law;                         /* kind WT_LAW_NONE: only the reference temperature */
    double c1_error, c2_error, c_correlation; /* of a law without isotherms; 0 = unknown */
    double temperature_min, temperature_max;  /* of the isotherms [K]; NaN = unknown */
    size_t n_vertical; /* points of log_b against temperature; 0 = no vertical shift */
    double *vertical_temperature, *vertical_log_b;
    size_t n_draws; /* draws for the replicates; 0 = uncertainty unknown */
    wt_rubber_draw *draws;
    wt_sweep sweep; /* isotherms and fit options, for wt_rubber_refit */
    wt_master_options fit;
} wt_rubber;
WT_API void wt_rubber_clear(wt_rubber *rubber);
/* Adds the items of a rubber that no job computed to the current stage of the cost: terms of a
 * series, points of a table or constants of a law. */
WT_API void wt_rubber_add_cost(const wt_rubber *rubber, const wt_job *work);

/* Representation of the moduli of a rubber. */
typedef enum wt_moduli_source { WT_MODULI_SERIES, WT_MODULI_POINTS } wt_moduli_source;
typedef struct wt_rubber_options {
    wt_moduli_source moduli;        /* for isotherms: series, or points of the master curve */
    wt_extrapolation extrapolation; /* outside of the points of any table; default hold */
} wt_rubber_options;
WT_API wt_rubber_options wt_rubber_options_defaults(void);
WT_API const wt_params *wt_rubber_options_params(void);

/* Opens a rubber: "fractional-zener:e0=5MPa,eg=2GPa,tau=1us,alpha=0.4", or the path of a table of
 * moduli at one temperature, which is that of the file, else of `read`, else unknown. */
WT_API wt_status wt_rubber_open(const char *text, const wt_read_options *read,
                                const wt_rubber_options *options, double poisson_ratio,
                                const wt_job *work, wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* Replaces the series by the points of a table "master_curve", without draws, but with the shifts
 * of the rubber. A rubber of zeros but for the Poisson ratio is filled from the table. Points
 * closer than a twentieth of a decade are merged. */
WT_API wt_status wt_rubber_tabulate(wt_rubber *rubber, const wt_table *master_curve,
                                    const wt_rubber_options *options, wt_error *err) WT_NODISCARD;
/* Describes the source of the moduli; "" for an isotropic series. Returns the length as snprintf
 * does. */
WT_API size_t wt_rubber_describe(const wt_rubber *rubber, char *buffer, size_t size);

typedef struct wt_master_tables {
    wt_table *shift_factors, *master_curve, *prony, *material_draws, *series_draws;
    size_t n_isotherms;
    wt_table *prony_reduced, *relaxation_spectrum;
    wt_master *fit; /* fit of these tables */
} wt_master_tables;
WT_API void wt_master_tables_clear(wt_master_tables *tables);

/* Reads the sweeps and fits the master curve. `rubber` receives the data that friction needs. One
 * isotherm is allowed: no shift, no law. Either output may be NULL. */
WT_API wt_status wt_master_compute(const wt_master_job *job, const wt_job *work,
                                   wt_master_tables *tables, wt_rubber *rubber,
                                   wt_error *err) WT_NODISCARD;

/* Shared shift law of samples that are fitted separately. */
typedef struct wt_shared_shift_law_job {
    const char *const *names;     /* [n] names of the samples */
    const wt_master *const *fits; /* [n]; NULL: no fit */
    size_t n;
    double reference; /* reference temperature of the law [K]; NaN: that of the first sample used */
    wt_shared_law_mode common; /* default WT_SHARED_LAW_NONE: not requested */
    double margin;             /* irrelevant difference of laws [decade]; default 0.1 */
} wt_shared_shift_law_job;
WT_API wt_shared_shift_law_job wt_shared_shift_law_job_defaults(void);
WT_API const wt_params *wt_shared_shift_law_job_params(void);
/* Table "shared_shift_law": the law with its errors, the shifts about it, and whether the samples
 * have one law. */
WT_API wt_status wt_shared_shift_law_compute(const wt_shared_shift_law_job *job, wt_table **table,
                                             wt_error *err) WT_NODISCARD;

/* Glass transition and moduli at given temperatures, from temperature sweeps or from isotherms
 * split by frequency. */
typedef struct wt_ramp_job {
    const wt_file_set *sets;
    size_t n_sets;
    const double *temperature; /* increasing [K]; owned by the caller */
    size_t n_temperatures;
    size_t peak_points; /* points of a plain parabola; 0 (default): as wt_peak_find chooses */
} wt_ramp_job;
WT_API wt_ramp_job wt_ramp_job_defaults(void);
WT_API const wt_params *wt_ramp_job_params(void);
typedef struct wt_ramp_tables {
    wt_table *ramp, *glass_transition;
    wt_table *moduli_at; /* NULL without temperatures */
} wt_ramp_tables;
WT_API void wt_ramp_tables_clear(wt_ramp_tables *tables);
WT_API wt_status wt_ramp_compute(const wt_ramp_job *job, const wt_job *work, wt_ramp_tables *tables,
                                 wt_error *err) WT_NODISCARD;

/* Strain softening from strain sweeps. */
typedef struct wt_payne_job {
    const wt_file_set *sets;
    size_t n_sets;
} wt_payne_job;
WT_API wt_payne_job wt_payne_job_defaults(void);
typedef struct wt_payne_tables {
    wt_table *payne, *payne_sweep;
} wt_payne_tables;
WT_API void wt_payne_tables_clear(wt_payne_tables *tables);
WT_API wt_status wt_payne_compute(const wt_payne_job *job, const wt_job *work,
                                  wt_payne_tables *tables, wt_error *err) WT_NODISCARD;

/* Tables of wt_master_compute, as read from a file; borrowed. */
typedef struct wt_rubber_tables {
    const wt_table *prony;
    const wt_table *shift_factors;                 /* NULL: only the reference temperature */
    const wt_table *material_draws, *series_draws; /* NULL: errors unknown */
} wt_rubber_tables;
WT_API wt_status wt_rubber_from_tables(const wt_rubber_tables *tables, double poisson_ratio,
                                       wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* Refits the isotherms with another vertical shift, without draws. WT_E_MISSING without isotherms.
 */
WT_API wt_status wt_rubber_refit(const wt_rubber *rubber, wt_vertical_shift vertical,
                                 wt_rubber *refitted, wt_error *err) WT_NODISCARD;

/* Export of the reduced series to finite-element programs, in the keywords of their manuals. */
typedef enum wt_fem_program {
    WT_FEM_ABAQUS,
    WT_FEM_ANSYS,
    WT_FEM_CODE_ASTER, /* needs a Poisson's ratio below 0.5 */
    WT_FEM_TABLE
} wt_fem_program;
/* Units of stress and time: Pa and s, MPa and s, GPa and ms. */
typedef enum wt_fem_units { WT_FEM_M_KG_S, WT_FEM_MM_T_S, WT_FEM_MM_KG_MS } wt_fem_units;
typedef enum wt_fem_temperature { WT_FEM_CELSIUS, WT_FEM_KELVIN } wt_fem_temperature;
typedef enum wt_fem_domain { WT_FEM_TIME, WT_FEM_FREQUENCY } wt_fem_domain;
typedef struct wt_fem_export_options {
    wt_fem_units units;
    wt_fem_temperature temperature;
    wt_fem_domain domain; /* only for Abaqus */
    const char *name;     /* a letter, then letters, digits and '_', at most 32; NULL: RUBBER */
    double density;       /* [kg/m^3], NaN: not written */
    double expansion;     /* coefficient of linear thermal expansion [1/K], NaN: not written */
    double poisson_ratio; /* constant in time; default 0.5: incompressible */
} wt_fem_export_options;
WT_API wt_fem_export_options wt_fem_export_options_defaults(void);
WT_API const wt_params *wt_fem_export_options_params(void);
/* Finds a program by name: "abaqus", "ansys", "code_aster", "table". False if there is none. */
WT_API bool wt_fem_program_find(const char *name, size_t length, wt_fem_program *program);
/* Checks that the program supports such a material. */
WT_API wt_status wt_fem_export_check(wt_fem_program program, const wt_fem_export_options *options,
                                     wt_error *err) WT_NODISCARD;
/* Writes the material from tables of wt_master_compute. shift_factors NULL: no law. options NULL =
 * defaults. */
WT_API wt_status wt_fem_export(FILE *out, wt_fem_program program, const wt_table *prony_reduced,
                               const wt_table *shift_factors, const wt_fem_export_options *options,
                               wt_error *err) WT_NODISCARD;

#define WT_NO_REPLICATE SIZE_MAX /* instead of a replicate: the fitted values */
/* Creates the material at a temperature [K] (NaN = reference): relaxation times times a_T, moduli
 * divided by b_T. `statement` (may be NULL) receives a remark: outside of the isotherms, b
 * constant. WT_E_MISSING if more than 1 K away without a shift law; WT_E_RANGE at or below the WLF
 * pole. replicate: its number, or WT_NO_REPLICATE. */
WT_API wt_status wt_rubber_material(const wt_rubber *rubber, double temperature, uint64_t seed,
                                    size_t replicate, wt_material **material, char statement[256],
                                    wt_error *err) WT_NODISCARD;

/* ---- comparison ------------------------------------------------------------------------------ */

/* Number of cantilevers for bulk and track. The errors of a shared one cancel in the ratio. */
typedef enum wt_cantilever_sharing {
    WT_CANTILEVERS_AUTO, /* one if the spring constants are equal */
    WT_CANTILEVERS_SHARED,
    WT_CANTILEVERS_SEPARATE
} wt_cantilever_sharing;

typedef struct wt_compare_job {
    const wt_table *bulk, *track; /* indentation tables */
    const wt_rubber *rubber;      /* for the DMA comparison; NULL (default) = none */
    wt_estimate temperature; /* of the indentation [K]; NaN = reference temperature of the rubber */
    wt_estimate track_temperature; /* NaN = the same for the track */
    wt_estimate temperature_slope; /* d ln E/dT [1/K]; NaN = that of the rubber */
    wt_cantilever_sharing levers;
    double lever_error; /* relative standard error of a spring constant whose table states none;
                           default 0 = none */
    double sensitivity_error; /* relative standard error; default 0 = not stated */
    double tip_error;         /* relative error of the modulus by the tip; default 0 = not stated */
    double spot_scatter;      /* relative scatter between spots, for groups of one spot; default 0 =
                                 unknown */
    bool map_spots;   /* each position of a map is a spot; default false: a map is one spot */
    double margin;    /* irrelevant relative difference; default 0.2 */
    bool rates;       /* default true: table of the modulus against rate */
    bool groups_only; /* no comparison of the two groups */
    wt_estimate expected_thickness; /* independent thickness [m]; NaN (default): that of the theory,
                                       if any */
} wt_compare_job;
WT_API wt_compare_job wt_compare_job_defaults(void);
WT_API const wt_params *wt_compare_job_params(void);

typedef struct wt_compare_tables {
    wt_table *modulus_groups;
    wt_table *comparison;
    wt_table *modulus_rate;   /* NULL if rates are unknown or not requested */
    wt_table *dma_comparison; /* NULL without rubber or rates */
    wt_table *modulus_budget; /* NULL if no group states a systematic error */
} wt_compare_tables;
WT_API void wt_compare_tables_clear(wt_compare_tables *tables);
/* Compares bulk and track. One of them may be NULL: then there is no table "comparison". A group
 * without a usable curve has a row without numbers. WT_E_RANGE if a curve is in both groups. */
WT_API wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *work,
                                   wt_compare_tables *tables, wt_error *err) WT_NODISCARD;

/* Creates the table "track_layer": the thickness of a layer in the track from the curves alone,
 * compared with that of the job or, if it is NaN, that of `layer` (table "layer", or NULL). NULL if
 * the tables have no depth information and no thickness is stated. */
WT_API wt_status wt_track_layer_compute(const wt_compare_job *job, const wt_table *layer,
                                        const wt_job *work, wt_table **table,
                                        wt_error *err) WT_NODISCARD;

/* Creates the table "dwell_dma": moduli of dwells (tables dwell_moduli as job->bulk and job->track;
 * the track may be NULL) relative to those of job->rubber at the same frequency and temperature. */
WT_API wt_status wt_compare_dwells(const wt_compare_job *job, const wt_job *work, wt_table **table,
                                   wt_error *err) WT_NODISCARD;

/* ---- materials side by side ------------------------------------------------------------------ */

typedef struct wt_compared_material {
    const char *name;
    const wt_rubber *rubber;
    const wt_table *shift_factors; /* has the verdict on superposition; NULL: unknown */
} wt_compared_material;

typedef struct wt_materials_job {
    const wt_compared_material *materials; /* moduli are relative to those of the first */
    size_t n_materials;                    /* two or more */
    double temperature;  /* temperature of the comparison over frequency [K]; NaN: the reference of
                            the first, if all cover it */
    double frequency;    /* frequency of the comparison over temperature [rad/s]; NaN: 10 Hz, if all
                            cover it */
    double sample_error; /* relative error of the modulus by the dimensions of a sample */
    double margin;       /* irrelevant relative difference; default 0.2 */
} wt_materials_job;
WT_API wt_materials_job wt_materials_job_defaults(void);
WT_API const wt_params *wt_materials_job_params(void);

typedef struct wt_materials_tables {
    wt_table *materials, *material_ratio;
} wt_materials_tables;
WT_API void wt_materials_tables_clear(wt_materials_tables *tables);
/* Computes moduli and their ratios in the common measured range, each at the other's temperatures
 * by its own shift law. WT_E_RANGE without a common temperature and frequency. */
WT_API wt_status wt_compare_materials(const wt_materials_job *job, const wt_job *work,
                                      wt_materials_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- roughness ------------------------------------------------------------------------------- */

/* A counter surface with its stated or measured error. */
typedef struct wt_surface {
    bool self_affine;
    double q0, qr, q1, hurst; /* self-affine law; q0 and q1 truncate a spectrum (NaN = its ends) */
    wt_estimate c0;           /* [m^4]; for a spectrum: value 1, relative error of the densities */
    wt_power_spectrum spectrum; /* if not self-affine; 2-D */
    double *modes_error; /* [spectrum.n] standard errors of ln C by its modes; NULL: unknown */
    double *modes_tie;   /* [spectrum.n] correlation of that with the next point; NULL: none */
    double *law_error;   /* [spectrum.n] fully correlated error of the law outside of the measured
                            range; NULL */
    /* [n_sizes * spectrum.n] For scans of several sizes: contributions to c0.standard_error of ln C
     * of the points by the positions of the widest scans, then of the next. Each size is drawn
     * independently. NULL: all points share the whole error. */
    size_t n_sizes;
    double *place_parts;
    double reliable_to; /* end of the measured range [rad/m], continued by the law; 0: unknown */
    double steep; /* wavenumber where the rms slope reaches 1.3 [rad/m]; 0: unknown or nowhere */
    bool places_known; /* the scatter between positions is known, even if the error of c0 is 0 */
} wt_surface;
WT_API void wt_surface_clear(wt_surface *surface);
/* Opens a surface: "self-affine:q0=1e3rad/m,qr=5e3rad/m,q1=1e7rad/m,hurst=0.8,c0=1e-17m^4+-10%",
 * the path of a spectrum or height map, or a folder or pattern of several maps, which are
 * transformed as by wt_topography_compute. read NULL = defaults. */
WT_API wt_status wt_surface_open(const char *text, const wt_read_options *read, const wt_job *work,
                                 wt_surface *surface, wt_error *err) WT_NODISCARD;
/* Creates the roughness with all densities multiplied by `factor` > 0. It borrows nothing. */
WT_API wt_status wt_surface_roughness(const wt_surface *surface, double factor,
                                      wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_surface_table(const wt_surface *surface, wt_table **table,
                                  wt_error *err) WT_NODISCARD; /* Creates the table "roughness". */

/* ---- softening with strain ------------------------------------------------------------------- */

/* Strain softening of the moduli of a rubber. */
typedef struct wt_strain_softening {
    wt_softening table;    /* owns its arrays */
    double *storage_error; /* [n] standard error of f; NULL: unknown */
    double *loss_error;    /* [n] standard error of g; NULL: unknown */
    size_t n_sweeps;       /* number of averaged sweeps; 0: a given table */
    double temperature;    /* mean of their temperatures [K]; NaN: unknown */
} wt_strain_softening;
WT_API void wt_strain_softening_clear(wt_strain_softening *softness);
/* Selection among strain sweeps. */
typedef struct wt_strain_softening_choice {
    double temperature; /* those nearest to it [K]; NaN: all have one temperature */
    const char *sample; /* those of this sample; NULL: all have one sample */
} wt_strain_softening_choice;
WT_API wt_strain_softening_choice wt_strain_softening_choice_defaults(void);
/* Reads strain softening from the table payne_sweep, where f and g are storage_ratio and
 * loss_ratio. For several sweeps it is their mean over the common strains; the error is the
 * standard deviation between sweeps, so that 1.96 of it covers 95 % of further sweeps.
 * WT_E_AMBIGUOUS if they have several temperatures or samples and none is chosen, as they are no
 * repeats. Any table with columns strain, f, g and optionally f_error, g_error is also accepted. */
WT_API wt_status wt_strain_softening_from_table(const wt_table *table,
                                                wt_strain_softening_choice choice,
                                                wt_strain_softening *softness,
                                                wt_error *err) WT_NODISCARD;
/* Reads it from the table payne_sweep of a file, or else its first table. The file is an input of
 * the work, shown as `name`. */
WT_API wt_status wt_strain_softening_read(const char *path, const char *name,
                                          wt_strain_softening_choice choice, const wt_job *work,
                                          wt_strain_softening *softness,
                                          wt_error *err) WT_NODISCARD;

/* ---- friction -------------------------------------------------------------------------------- */

/* Sliding contact: rubber on a counter surface under given conditions. */
typedef struct wt_sliding {
    const wt_rubber *rubber;   /* borrowed */
    const wt_surface *surface; /* borrowed */
    wt_estimate pressure;      /* [Pa] */
    wt_estimate temperature;   /* [K]; value NaN = reference temperature of the rubber */
    wt_estimate shear_stress;  /* of the real contact [Pa]; value NaN: unknown, no total friction */
    double gamma;              /* as in wt_friction_options; default 1 */
    const double *velocity;    /* [n_velocity] m/s, borrowed */
    size_t n_velocity;
    double reference_velocity; /* velocity of the answer and the layer [m/s]; NaN = middle of the
                                  list */
    const wt_strain_softening *softness; /* borrowed; NULL = none */
    double strain_factor;                /* as in wt_friction_options; default 1 */
    wt_anisotropy anisotropy;            /* of the roughness; default none */
    const double *temperatures;          /* [n_temperatures] K, of the friction map, borrowed */
    size_t n_temperatures;
    const double *pressures; /* [n_pressures] Pa, of the friction map, borrowed */
    size_t n_pressures;
    bool decades;         /* requests friction by decades of the wavenumber */
    wt_area_law area_law; /* as in wt_friction_options */
    wt_flash flash; /* as in wt_friction_options; `temperature` is then the ambient temperature */
    wt_shear_law shear_law; /* law of the shear stress, which is its peak value */
    bool sensitivities; /* requests sensitivities of the friction at the reference velocity; default
                           false */
    const wt_rubber
        *layer_rubber; /* material of a layer, instead of a modulus ratio, borrowed; default NULL */
} wt_sliding;
WT_API wt_sliding wt_sliding_defaults(void);
WT_API const wt_params *wt_sliding_params(void);

/* The modified layer on the surface of the track. */
typedef struct wt_layer_observation {
    wt_estimate thickness;     /* [m] */
    wt_estimate modulus_ratio; /* E_track / E_bulk */
    double modulus_ratio_df;   /* degrees of freedom of its error (Student's t); 0 = normal */
    wt_estimate ratio_slope;   /* d ln modulus_ratio / d ln omega; default 0: constant ratio */
    double ratio_frequency;    /* angular frequency of modulus_ratio [rad/s]; NaN: not stated */
    double ratio_lowest,
        ratio_highest; /* measured range; the ratio is constant outside [rad/s]; NaN: not stated */
    double ratio_temperature; /* temperature of these frequencies [K]; NaN: that of the sliding */
    bool by_rate;    /* in a case: the ratio depends on the rate as compared; default false */
    bool bulk_shear; /* tau_s = tau_bulk, without the modulus ratio; default false */
    double calibration_share; /* share of calibration (spring constants etc.), not spot scatter, in
                                 the variance of the ratio; default 0 */
    const wt_layer_shear *shear; /* shear of the real contact on it; NULL: defaults */
} wt_layer_observation;
WT_API wt_layer_observation wt_layer_observation_defaults(void); /* Returns no layer. */
WT_API const wt_params *wt_layer_observation_params(void);
/* Reads ratio, slope and frequencies from tables of `weartrack compare`: the ratio of all rates at
 * their mean frequency, and its slope over the frequencies of the rates. WT_E_MISSING with one
 * rate. */
WT_API wt_status wt_layer_observation_from_rates(const wt_table *comparison,
                                                 const wt_table *modulus_rate,
                                                 wt_layer_observation *known,
                                                 wt_error *err) WT_NODISCARD;

typedef struct wt_friction_tables {
    wt_table *friction;
    double extrapolated_share; /* largest of all velocities */
} wt_friction_tables;
WT_API void wt_friction_tables_clear(wt_friction_tables *tables);

/* Computes hysteresis friction, contact area and total friction at every velocity. Standard errors
 * come from replicates: spectrum, shifts and law are drawn jointly from the posterior of the
 * isotherms, and pressure, temperature, shear stress and C0 from their stated errors. The key
 * `standard_error_includes` lists the sources. With a layer (NULL = none): for a bonded layer and
 * tau_s = tau_bulk x modulus ratio. */
WT_API wt_status wt_sliding_friction_compute(const wt_sliding *sliding,
                                             const wt_layer_observation *layer, const wt_job *work,
                                             wt_friction_tables *tables,
                                             wt_error *err) WT_NODISCARD;

/* Creates the table "contact_area": contact area and friction against magnification at the slowest,
 * the reference and the fastest velocity. */
WT_API wt_status wt_contact_area_compute(const wt_sliding *sliding, const wt_job *work,
                                         wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "softening": hysteresis friction and contact area with and without the strain
 * softening of `sliding`, and the shares from strains outside of its range. WT_E_ARG without strain
 * softening. */
WT_API wt_status wt_softened_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "flash_temperature": hysteresis friction, contact area and temperature at every
 * velocity with and without flash temperature, and for a second solution if there is one. WT_E_ARG
 * if it is not requested. */
WT_API wt_status wt_flash_temperature_compute(const wt_sliding *sliding, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;
/* Table "directions": hysteresis friction and contact area of a transversely isotropic rubber at
 * every velocity, with its factors on E' and E'' and with those on one of them or none. WT_E_ARG if
 * it has no directions. */
WT_API wt_status wt_transverse_isotropy_compute(const wt_sliding *sliding, const wt_job *work,
                                                wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "anisotropy": hysteresis friction, contact area and lateral force with and
 * without the anisotropy of `sliding`. WT_E_ARG without anisotropy. */
WT_API wt_status wt_anisotropic_friction_compute(const wt_sliding *sliding, const wt_job *work,
                                                 wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "friction_map": friction at every velocity and temperature at the nominal
 * pressure, then at every velocity and pressure at the nominal temperature. One kernel at the
 * reference temperature of the rubber serves all: mu(v, T, p) is mu(v a_T, reference, p b_T).
 * WT_E_ARG without temperatures and pressures. */
/* The map has no layer, but uses the crack opening of the shear stress of `known` (NULL: none) on
 * the bare surface. */
WT_API wt_status wt_friction_map_compute(const wt_sliding *sliding,
                                         const wt_layer_observation *known, const wt_job *work,
                                         wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the table "friction_decades": contributions of each decade of the wavenumber to
 * hysteresis friction, and to shearing and crack opening of bare rubber (`known` as in the map), at
 * the slowest, the reference and the fastest velocity. */
WT_API wt_status wt_friction_by_scale_compute(const wt_sliding *sliding,
                                              const wt_layer_observation *known, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- modified layer -------------------------------------------------------------------------- */

/* Energy that modifies the rubber: hysteresis below the surface, shearing of the real contact, or
 * both. The depth profile of shearing is assumed to be that of hysteresis. */
typedef enum wt_layer_energy { WT_LAYER_HYSTERESIS, WT_LAYER_SHEAR, WT_LAYER_BOTH } wt_layer_energy;

typedef struct wt_layer_job {
    wt_estimate critical_energy;    /* U_c [J/m^3]; value NaN: calibrated from observed_thickness */
    wt_estimate observed_thickness; /* [m]; value NaN = not observed */
    wt_estimate specific_wear_rate; /* k [m^2/N] */
    double damage;                  /* Lambda; default 1 */
    double duty;                    /* share of the time in contact; default 1 */
    double start_thickness;         /* [m]; default 0 */
    bool incubation;                /* as in wt_layer_parameters; default true: exact */
    wt_depth_profile profile;
    double local_friction; /* m of the incompressible profile */
    const double *time;    /* [n_time] s; NULL: chosen around the time scales */
    size_t n_time;
    double velocity;          /* velocity of the wear [m/s]; NaN = reference velocity */
    wt_layer_energy energy;   /* default hysteresis */
    double shear_share;       /* share of the shearing power that counts, [0, 1]; default 1 */
    double severity_power;    /* as in wt_layer_parameters; default 0 */
    double severity_exponent; /* as in wt_layer_parameters; default 1 */
    wt_layer_closure closure; /* default energy; activated at the temperature of the rubber */
    wt_estimate barrier;      /* of the activated closure [J] */
    wt_activation activation; /* volume, attempt frequency and ageing of the activated closure */
    bool bands;               /* requests the modified bands */
    const char *const
        *loads; /* [n_loads] successive loads, borrowed; none: the constant load of the sliding */
    size_t n_loads;
    bool running_in;      /* requests friction during the growth of the layer */
    bool has_feedback;    /* feedback of the layer on the energy that forms it */
    wt_layer_shear shear; /* shear of the real contact on the layer */
    bool existence;       /* requests the regime map */
} wt_layer_job;
WT_API wt_layer_job wt_layer_job_defaults(void);
WT_API const wt_params *wt_layer_job_params(void);
/* Checks the values and their combination: exactly one of critical energy and observed thickness;
 * the latter needs a wear rate. */
WT_API wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err) WT_NODISCARD;

typedef struct wt_layer_tables {
    wt_table *layer;
    wt_estimate thickness; /* steady-state thickness [m]; infinite without wear */
    wt_layer_steady_state balance;
} wt_layer_tables;
WT_API void wt_layer_tables_clear(wt_layer_tables *tables);

/* Computes the thickness of the layer at the reference velocity. Standard errors from the
 * replicates of the friction and the stated errors of k and U_c (or of the observed thickness). */
WT_API wt_status wt_layer_thickness_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                            const wt_job *work, wt_layer_tables *tables,
                                            wt_error *err) WT_NODISCARD;

/* Creates the table "layer_bands": edges of the modified bands in time by exact damage transport
 * under the loads of the job, and the events of the bands. */
WT_API wt_status wt_layer_bands_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                        const wt_job *work, wt_table **table,
                                        wt_error *err) WT_NODISCARD;
/* Creates the table "running_in": friction with the growing layer, which has the modulus ratio of
 * `known`. With `has_feedback` its energy is that under this layer. */
WT_API wt_status wt_running_in_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                       const wt_layer_observation *known, const wt_job *work,
                                       wt_table **table, wt_error *err) WT_NODISCARD;
/* Table "layer_feedback": all balances of a layer that acts back, and the folds between them. */
WT_API wt_status wt_layer_steady_states_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                                const wt_layer_observation *known,
                                                const wt_job *work, wt_table **table,
                                                wt_error *err) WT_NODISCARD;
/* Table "existence": balance thickness at every velocity, at the pressures of the map of `sliding`
 * if it has some, else at its pressure, and with `known` (may be NULL) what the layer does to
 * friction. */
WT_API wt_status wt_regime_map_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                       const wt_layer_observation *known, const wt_job *work,
                                       wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "energy_density": energy density against depth at the velocity of the layer. */
WT_API wt_status wt_energy_density_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                           const wt_job *work, wt_table **table,
                                           wt_error *err) WT_NODISCARD;

typedef struct wt_identify_job {
    wt_estimate observed_thickness; /* steady-state thickness [m] */
    wt_estimate specific_wear_rate; /* k [m^2/N]; value NaN: not measured */
    wt_estimate running_in_time;    /* [s] from unmodified rubber; value NaN: not measured */
    double running_in_share;        /* share of the thickness at that time; default 0.95 */
    double damage, duty;            /* as in wt_layer_job */
    wt_depth_profile profile;
    double local_friction;
    double wear_low, wear_high;     /* k in the literature [m^2/N] */
    double energy_low, energy_high; /* U_c in the literature [J/m^3] */
} wt_identify_job;
WT_API wt_identify_job wt_identify_job_defaults(void);
WT_API const wt_params *wt_identify_job_params(void);
/* Creates the table "identification": U_c and k from the thickness with the wear rate, with the
 * running-in time by either closure, and their range from the thickness alone; 95 % intervals and
 * correlation from the replicates and the stated errors. */
WT_API wt_status wt_identification_compute(const wt_sliding *sliding, const wt_identify_job *job,
                                           const wt_job *work, wt_table **table,
                                           wt_error *err) WT_NODISCARD;

/* ---- what if ----------------------------------------------------------------------------------
 */

/* Creates the table "what_if", a one-at-a-time sensitivity: friction and layer at the reference
 * velocity, then with one model choice changed in each row, and the resulting change. Choices that
 * do not apply have no row; a row that cannot be computed has the reason. `layer` NULL: no
 * thickness of the layer; `known` NULL: no friction with a layer. With both, the thickness is that
 * of `layer`. */
WT_API wt_status wt_model_sensitivity_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                              const wt_layer_observation *known, const wt_job *work,
                                              wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- validation ------------------------------------------------------------------------------ */

typedef struct wt_validation_job {
    const wt_sliding *sliding;
    const wt_layer_job *layer;         /* NULL as in wt_model_sensitivity_compute */
    const wt_layer_observation *known; /* NULL as in wt_model_sensitivity_compute; its thickness is
                                          the one used for the layer */
    const wt_table *record;            /* table "record" */
    const wt_table *cycles;            /* table "record_cycles", for the running-in only */
    const wt_table *wear;              /* table "wear", or NULL */
    const wt_table
        *what_if;  /* table "what_if" of the same inputs, or NULL: no likelihood of choices */
    double margin; /* irrelevant deviation of measured over predicted; default 0.2 */
    double plausible_low,
        plausible_high;       /* plausible range of the shear stress [Pa]; default 1 MPa, 10 MPa */
    double running_in_margin; /* margin of times and changes of a running-in; default 1 */
    bool wanted;              /* in a case: validates its records; default true */
} wt_validation_job;
WT_API wt_validation_job
wt_validation_job_defaults(void); /* Sets the margins and the following members. */
WT_API const wt_params *wt_validation_job_params(void);

typedef struct wt_validation_tables {
    wt_table *validation, *choices, *sources; /* choices NULL without what_if or shear stress */
} wt_validation_tables;
WT_API void wt_validation_tables_clear(wt_validation_tables *tables);

/* Compares measured with predicted friction at every step of the records, with both errors: the
 * verdict "explains", "does not" or "cannot say" by the test in the key `test`; the shear stress
 * and largest wavenumber that the record requires; the error sources; the likelihood of each model
 * choice. */
WT_API wt_status wt_validation_compute(const wt_validation_job *job, const wt_job *work,
                                       wt_validation_tables *tables, wt_error *err) WT_NODISCARD;

typedef struct wt_running_in_tables {
    wt_table *running_in, *running_in_curve; /* "validation_running_in", "validation_course" */
} wt_running_in_tables;
WT_API void wt_running_in_tables_clear(wt_running_in_tables *tables);

/* Compares the running-in of the first step of every record with that predicted for the growing
 * layer of `layer` and `known` (not NULL): time to the steady state and change of friction, with
 * both errors; a verdict as above; the specific wear rate and critical energy that the time
 * requires. */
WT_API wt_status wt_running_in_validation_compute(const wt_validation_job *job, const wt_job *work,
                                                  wt_running_in_tables *tables,
                                                  wt_error *err) WT_NODISCARD;

/* ---- error budget ---------------------------------------------------------------------------- */

/* Creates the table "error_budget": the error of each number at the reference velocity by every
 * source alone (replicates with all others fixed), by the number of replicates, by numerical
 * errors, and by the model choices of `what_if` (may be NULL); with the time of each, if the cost
 * of `work` has times and includes `what_if`, and how to reduce it. `layer` and `known` as above.
 */
WT_API wt_status wt_error_budget_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                         const wt_layer_observation *known, const wt_table *what_if,
                                         const wt_job *work, wt_table **table,
                                         wt_error *err) WT_NODISCARD;

/* ---- coverage -------------------------------------------------------------------------------- */

typedef struct wt_coverage_job {
    const wt_sliding *sliding;
    const wt_layer_job *layer;         /* NULL as in wt_model_sensitivity_compute */
    const wt_layer_observation *known; /* NULL as in wt_model_sensitivity_compute */
    const wt_table *bulk, *track;      /* indentation tables, or NULL: no groups to compare */
    size_t trials;
    /* Curves of both groups, which are then drawn and refitted; NULL: their moduli are drawn. */
    const wt_curve_set *curves[2];
    bool ratio_of_groups; /* the ratio of `known` is that of the groups in each trial */
} wt_coverage_job;
WT_API wt_coverage_job wt_coverage_job_defaults(void); /* Sets trials to 0. */
WT_API const wt_params *wt_coverage_job_params(void);
/* Creates the table "coverage" by a parametric bootstrap: data are drawn from the fit of the case
 * (isotherms with noise and temperature scatter, force curves with scatter of spots and curves,
 * inputs with stated errors) and evaluated in the same way. It states how often the intervals
 * contain the values of the fit. It cannot detect a wrong model, which the table states. */
WT_API wt_status wt_coverage_compute(const wt_coverage_job *job, const wt_job *work,
                                     wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- error against run time ------------------------------------------------------------------ */

typedef struct wt_accuracy_job {
    const char *part; /* name of one numerical part; NULL (default): all */
    size_t repeats;   /* timing repetitions of each point; default 9 */
    bool built_in;    /* in a case: also the built-in problems; default false */
} wt_accuracy_job;
WT_API wt_accuracy_job wt_accuracy_job_defaults(void);
WT_API const wt_params *wt_accuracy_job_params(void);
/* Creates the table "work_precision": error of every numerical part on a problem with an
 * independent reference, and processor time on one thread, for a sweep of its setting; the textbook
 * method for comparison. WT_E_NOT_FOUND for an unknown part. */
WT_API wt_status wt_accuracy_compute(const wt_accuracy_job *job, const wt_job *work,
                                     wt_table **table, wt_error *err) WT_NODISCARD;
/* Creates the same table for a sliding contact at the reference velocity: friction and layer for a
 * sweep of the tolerance (reference 1e-13; textbook method for comparison), standard errors for a
 * sweep of the number of replicates, and values with fewer isotherms. Times are NaN if the cost of
 * `work` has none. `layer` and `known` as above. */
WT_API wt_status wt_case_precision_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                           const wt_layer_observation *known,
                                           const wt_accuracy_job *job, const wt_job *work,
                                           wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- case ------------------------------------------------------------------------------------ */

typedef struct wt_case wt_case;
/* Reads and checks a case file (schema, then further rules). Its paths are relative to the file. */
WT_API wt_status wt_case_read(const char *path, wt_case **out, wt_error *err) WT_NODISCARD;
WT_API void wt_case_free(wt_case *c);
/* Restricts the requests of the case to these tables (names in a result, separated by blanks). */
WT_API wt_status wt_case_request_tables(wt_case *c, const char *tables, wt_error *err) WT_NODISCARD;
/* Replaces the records of the case (files, folders or patterns, relative to the current folder) and
 * those parameters of the validation that are marked in `given`, as set by wt_params_set for `job`.
 */
WT_API wt_status wt_case_set_validation(wt_case *c, const char *const *records, size_t n,
                                        const wt_validation_job *job, uint64_t given,
                                        wt_error *err) WT_NODISCARD;
WT_API const char *wt_case_schema(void);            /* XSD text; static */
WT_API const char *wt_case_title(const wt_case *c); /* Returns the title, "" if none; borrowed. */
/* Returns the report options of the case: its style, figures, width, font and language, or the
 * defaults. Borrowed. */
WT_API const wt_report_options *wt_case_report_options(const wt_case *c);

/* ---- plan and run ---------------------------------------------------------------------------- */

typedef struct wt_run_options {
    const char *formats; /* folder of further descriptions, NULL = none */
    double tolerance;    /* requested relative numerical error; default 1e-10 */
    unsigned threads;    /* 0 = one per processor */
    uint64_t seed;       /* seed of the draws */
    size_t replicates;   /* number of draws; default 200 */
    wt_progress progress;
    size_t trials;              /* trials of the table "coverage"; default 100 */
    wt_accuracy_job precision;  /* options of the table "work_precision" */
    bool no_provenance;         /* no times in "cost", no digests in "inputs" */
    const char *const *columns; /* of plain tables, as in wt_formats_add_columns */
    size_t n_columns;
} wt_run_options;
WT_API wt_run_options wt_run_defaults(void);
WT_API const wt_params *wt_run_params(void);

/* Creates the plan as a table: stage, title, runs (1 or 0), because (reason), needs, gives. Reads
 * no data file. */
WT_API wt_status wt_plan(const wt_case *c, wt_table **plan, wt_error *err) WT_NODISCARD;
/* Runs the plan. Skipped stages have no tables; the table "cost" lists every stage. A failed file
 * does not stop the others: the table "failures" lists it and *n_failed counts it. The same holds
 * for a failed stage; the stages that need it are skipped. If no requested table exists, the result
 * still exists, with the status WT_RESULT_EMPTY. */
WT_API wt_status wt_run_case(const wt_case *c, const wt_run_options *options, wt_log *log,
                             wt_result **result, size_t *n_failed, wt_error *err) WT_NODISCARD;
/* Tests if `result`, read from its file, is up to date with the case and `command` (as returned by
 * wt_provenance_command). *current is false if version, command line, case or a file that was read
 * has changed, a file is new or missing, or the result is partial; `why` has the first difference.
 * Files that nothing requested, and descriptions of --formats, are not tested. */
WT_API wt_status wt_run_is_current(const wt_case *c, const wt_result *result, const char *command,
                                   bool *current, char *why, size_t size,
                                   wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
