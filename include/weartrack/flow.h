/* weartrack - flow room: the jobs (one for each step of the work, used alone by a subcommand and
 * together by a run), the case file, the plan (which stages it needs and why), running it.
 *
 * Jobs give tables with the names, columns and units that the report room draws; see base.h for
 * ownership and errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
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

/* What a job can give besides its main table. */
typedef enum wt_optional_output {
    WT_EXTRA_SHARE = 1,           /* of friction: the extrapolated share, else NaN */
    WT_EXTRA_MODULUS_DEPTH = 2,   /* of the curves: the table modulus_depth */
    WT_EXTRA_DRAWS = 4,           /* of the isotherms: what is not known of the material, as
                                     material_draws and series_draws and for the replicates */
    WT_EXTRA_DIGESTS = 8,         /* SHA-256 of the files read, else "" */
    WT_EXTRA_SUMMARY = 16,        /* items and errors in the cost, else its nodes and files alone */
    WT_EXTRA_TIMES = 32,          /* of the layer: its incubation and its time to 90 %, else NaN */
    WT_EXTRA_REDUCED = 64,        /* of the isotherms: the series with few terms */
    WT_EXTRA_SPECTRUM = 128,      /* of the isotherms: the relaxation spectrum with its error */
    WT_EXTRA_TRANSITION = 256,    /* of temperature sweeps: the peaks, else without rows */
    WT_EXTRA_COMMON = 512,        /* of the curves: what the errors do that all of them share */
    WT_EXTRA_DEPTH_CURVES = 1024, /* of each curve: what it tells of depth, else NaN */
    WT_EXTRAS = 2047
} wt_optional_output;

typedef struct wt_cost wt_cost;
typedef struct wt_material_cache wt_material_cache;

typedef struct wt_job {
    const wt_formats *formats; /* borrowed; needed by jobs that read files */
    unsigned threads;          /* 0 = one per processor; never changes a result */
    double tolerance;          /* relative numerical error asked for; default 1e-10 */
    uint64_t seed;             /* of the replicates */
    size_t replicates;         /* for standard errors; default 200, 0 = no standard errors */
    wt_progress progress;
    wt_log *log;               /* borrowed, may be NULL */
    wt_provenance *provenance; /* every file read is added; may be NULL */
    wt_table *failures;        /* of wt_failures_new: a file or curve that fails gets a row and the
                                  work goes on; NULL: the first one that fails ends the job */
    unsigned left_out;         /* of wt_optional_output: not asked for, so not made; default 0 */
    wt_cost *cost;             /* borrowed; NULL (default): nothing is counted */
    wt_material_cache *drawn;  /* of wt_run, whose jobs share what is drawn of the material; NULL */
    wt_sweep
        *dma; /* of wt_run, whose jobs share the DMA files of the case: read into this once; NULL */
    void (*case_advice)(wt_error *failure); /* of wt_run: adds how a case gives what is asked for */
} wt_job;
WT_API wt_job wt_job_defaults(void);
WT_API const wt_params *wt_job_params(void);
/* Adds a file that the caller of jobs has read itself to provenance and cost: `input` has its path,
 * role and format. */
WT_API wt_status wt_job_input(const wt_job *work, wt_provenance_input input, wt_input *file,
                              wt_error *err) WT_NODISCARD;
/* The tables of a file that is an input of the work (NULL: of none), and what it is used for: by
 * its content. A text stream ("-" is standard input), also of tables by other hands, or an HDF5
 * result; `name` is the path to show. */
typedef struct wt_tables_role {
    const char *of_curves, *of_others;
    const char *instead; /* what to give if it is none; NULL: results of weartrack */
} wt_tables_role;
WT_API wt_status wt_tables_read(const char *path, const char *name, const wt_job *work,
                                wt_tables_role role, wt_result **tables,
                                wt_error *err) WT_NODISCARD;
/* The same for wt_result_headlines: of an HDF5 result no other tables. */
WT_API wt_status wt_tables_read_headlines(const char *path, wt_result **tables,
                                          wt_error *err) WT_NODISCARD;
WT_API wt_table *wt_failures_new(void); /* table "failures"; NULL when out of memory */
/* Says in the failures, of which there is one at least, how much is answered (key "status"). */
WT_API wt_status wt_failures_answered(wt_table *failures, wt_answered answered,
                                      wt_error *err) WT_NODISCARD;
/* What the failure of a file or sample comes to: a row of the failures, whose message does not name
 * it again, and WT_OK; or, where there are none or the work cannot go on, its error and `status`.
 */
WT_API wt_status wt_job_failed(const wt_job *work, const char *file, wt_status status,
                               wt_error *failure, wt_error *err) WT_NODISCARD;
/* Table "notes" of a log, with the names of files below `folder` shown without it; NULL = as they
 * are. */
WT_API wt_status wt_notes_table(const wt_log *log, const char *folder, wt_table **table,
                                wt_error *err) WT_NODISCARD;
/* Table "methods" of a result: the methods by which its tables were made, in sentences with their
 * numbers, with references. */
WT_API wt_status wt_methods_table(const wt_result *result, wt_table **table,
                                  wt_error *err) WT_NODISCARD;
/* What jobs cost, stage by stage. `timed` false: counts without times, so that two runs give the
 * same table. NULL when out of memory. */
WT_API wt_cost *wt_cost_new(bool timed, unsigned threads);
WT_API void wt_cost_free(wt_cost *cost);
/* A stage begins, and the one before ends: what jobs with this cost do from now on is of this
 * stage. NULL: nothing. */
WT_API void wt_cost_stage(wt_cost *cost, const char *stage);
/* Ends the last stage. Table "cost", one row for each stage. */
WT_API wt_status wt_cost_table(wt_cost *cost, wt_table **table, wt_error *err) WT_NODISCARD;
/* Adds to the log what a person should know of the tables of a result: a tolerance that is not
 * reached, what is extrapolated. */
WT_API void wt_result_remarks(const wt_result *result, wt_log *log);
/* The main numbers of a result in one sentence, "" if it has none. Returns the length as snprintf
 * does. */
WT_API size_t wt_result_sentence(const wt_result *result, char *buffer, size_t size);

/* Files that are read with the same options. Begin with {.read = wt_read_defaults()}. */
typedef struct wt_file_set {
    const char *const *patterns; /* [n_patterns] files, folders or shell patterns */
    size_t n_patterns;
    const char *folder; /* the patterns are relative to it; NULL = current folder */
    wt_read_options read;
    const char *spot; /* force files: the place on the sample all these curves come from; NULL: each
                         file is a spot, or each grid position if the whole group is one file */
} wt_file_set;
WT_API const wt_params *wt_file_set_params(void);

/* ---- convert --------------------------------------------------------------------------------- */

typedef struct wt_convert_job {
    unsigned kind; /* WT_KIND_* of a file that holds several; 0: the first that has data, in the
                      order force, sweep, spectrum, image */
    const char *contact; /* result of weartrack indent: force curves are given from the contact
                            points and above the baselines there, with their indentation; NULL =
                            as measured */
    wt_read_options read;
} wt_convert_job;
WT_API wt_convert_job wt_convert_job_defaults(void);
WT_API const wt_params *wt_convert_job_params(void);

/* Takes one table (also on failure) as soon as it is made. */
typedef wt_status (*wt_table_sink)(void *user, wt_table *table, wt_error *err);
/* Takes one curve, which it borrows. */
typedef wt_status (*wt_curve_sink)(void *user, const wt_force_curve *curve, wt_error *err);
/* A file as tables in SI units: "force_curve/I" of each curve, "sweep", "roughness", "image/I". The
 * file is in the provenance before the first table is given. Curves go to `curves` instead, unless
 * that is NULL. WT_E_EMPTY if it holds no data of that kind. */
WT_API wt_status wt_convert_file(const wt_convert_job *job, const char *path, const wt_job *work,
                                 wt_table_sink sink, wt_curve_sink curves, void *user,
                                 wt_error *err) WT_NODISCARD;

/* ---- indentation ----------------------------------------------------------------------------- */

/* What all curves of a group share, so that their scatter does not show its error. */
typedef enum wt_shared_law_source {
    WT_COMMON_SPRING_CONSTANT,
    WT_COMMON_SENSITIVITY,
    WT_COMMON_HALF_ANGLE,
    WT_COMMON_RADIUS,
    WT_COMMON_SOURCES
} wt_shared_law_source;

typedef struct wt_indent_job {
    const char *group; /* "bulk", "track" or another name of [a-z0-9_]+ */
    const wt_file_set *sets;
    size_t n_sets;
    wt_tip tip;
    wt_indent_options options;
    /* Those of all curves, with their errors (0 = not stated); value NaN: as in the files. */
    wt_estimate spring_constant, sensitivity;
    /* relative standard errors where the values state none, 0 = none (default) */
    double lever_error, sensitivity_error;
    bool rates;        /* decode what tells the time (piezo and indentation rate) */
    bool median_curve; /* the representative curve for the figures */
    /* Curves to look at, in words: "median" (which sets median_curve), "rejected", "worst:N",
     * "all", "FILE:N". */
    const char *const *curves;
    size_t n_curves;
    const char *choices; /* file of what was chosen by hand for files and curves; NULL = none */
    const struct wt_rubber *rubber; /* a factor on its spectrum is fitted; NULL = none (default) */
    wt_estimate temperature;        /* of the curves [K]; NaN = the rubber's reference */
    struct wt_curve_set *keep;      /* takes the accepted curves; NULL (default) */
} wt_indent_job;
WT_API wt_indent_job wt_indent_job_defaults(void);
WT_API const wt_params *wt_indent_job_params(void);

/* The accepted curves of a group with their fits, to be drawn anew by wt_coverage_make. NULL when
 * out of memory. */
typedef struct wt_curve_set wt_curve_set;
WT_API wt_curve_set *wt_curve_set_new(void);
WT_API void wt_curve_set_free(wt_curve_set *set);

/* Tables; each freed with wt_table_free, all by wt_indent_tables_clear. Zero-initialise it; given
 * to a second group, `indentation` must have been taken out (set to NULL) and the other tables are
 * appended to. */
typedef struct wt_indent_tables {
    wt_table *indentation;        /* indentation/GROUP, one row per curve, rejected ones included */
    wt_table *force_displacement; /* NULL unless curves are asked for */
    wt_table *force_indentation;
    wt_table *curves;        /* samples of the curves to look at; NULL if there are none */
    wt_table *choices;       /* what was chosen by hand and applied; NULL without choices */
    wt_table *modulus_depth; /* NULL if no group has the curves for it */
    size_t n_files, n_curves, n_accepted, n_failed;
} wt_indent_tables;
WT_API void wt_indent_tables_clear(wt_indent_tables *tables);

/* Fits every curve of every file. Files are streamed and fitted in parallel in batches, so memory
 * is bounded; rows come in the order of the files and curves for any number of threads. WT_E_EMPTY
 * if no file gives a curve. */
WT_API wt_status wt_indent_group(const wt_indent_job *job, const wt_job *work,
                                 wt_indent_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- dwells ---------------------------------------------------------------------------------- */

typedef struct wt_dwell_tables {
    wt_table *dwell, *dwell_points, *dwell_moduli;
} wt_dwell_tables;
WT_API void wt_dwell_tables_clear(wt_dwell_tables *tables);
/* The first dwell behind the approach of every curve, with tip and options of an indentation.
 * WT_E_EMPTY if no curve has one. */
WT_API wt_status wt_dwell_make(const wt_indent_job *job, const wt_job *work,
                               wt_dwell_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- images of a spot ------------------------------------------------------------------------ */

typedef struct wt_spot_job {
    wt_tip tip;
    double depth;          /* indentation that it reached [m] */
    double x, y;           /* in the coordinates of the image [m]; NaN = its middle (default) */
    double position_error; /* [m]; NaN = one contact radius (default) */
    double largest_effect; /* of roughness on the contact area that is still fine; default 0.1 */
    const char *image;     /* part of the name of the image; NULL = the first of heights */
    const char *after;     /* file with the image after the indentation; NULL = none */
    wt_read_options read;  /* of both; begin with wt_read_defaults() */
    bool map;              /* makes the table spot_map, too */
} wt_spot_job;
WT_API wt_spot_job wt_spot_job_defaults(void);
WT_API const wt_params *wt_spot_job_params(void);
typedef struct wt_spot_tables {
    wt_table *spot, *spot_map; /* spot_map: NULL unless asked for */
} wt_spot_tables;
WT_API void wt_spot_tables_clear(wt_spot_tables *tables);
/* Of the image `path` before the indentation: roughness over the contact against the depth, and
 * what stayed of the indentation. WT_E_NOT_FOUND if the file has no such image of heights,
 * WT_E_RANGE if sides or pixels of the images differ by more than four times. */
WT_API wt_status wt_spot_make(const wt_spot_job *job, const char *path, const wt_job *work,
                              wt_spot_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- measured surfaces ----------------------------------------------------------------------- */

typedef struct wt_topography_job {
    const wt_file_set *sets; /* height maps and profiles of one surface */
    size_t n_sets;
    wt_surface_options options;
    const char *image; /* part of the name of the image; NULL = the first of heights */
    double end;        /* last wavenumber [rad/m]; NaN = that of the reliable range */
    double end_slope;  /* rms slope at which it ends instead; NaN = none */
    bool scans;        /* makes the table scan_spectra, too */
    bool heights;      /* and the tables height_map and height_profile */
} wt_topography_job;
WT_API wt_topography_job wt_topography_job_defaults(void);
WT_API const wt_params *wt_topography_job_params(void);
typedef struct wt_topography_tables {
    wt_table *power_spectrum, *surfaces;
    wt_table *place_errors;                               /* NULL of scans of one size */
    wt_table *angular_spectrum;                           /* NULL of profiles */
    wt_table *scan_spectra, *height_map, *height_profile; /* NULL unless asked for; height_map
                                                             NULL of profiles, too */
} wt_topography_tables;
WT_API void wt_topography_tables_clear(wt_topography_tables *tables);
/* The power spectrum of a surface: scans of several sizes are stitched, several places averaged,
 * profiles inverted. Beyond the reliable range it goes on by its self-affine law where end or
 * end_slope ask for that. WT_E_EMPTY if no file has heights or no wavenumber is reliable,
 * WT_E_RANGE if the end that is asked for cannot be reached. */
WT_API wt_status wt_topography_make(const wt_topography_job *job, const wt_job *work,
                                    wt_topography_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- calibration of the lever ---------------------------------------------------------------- */

typedef enum wt_curve_direction {
    WT_WAYS_BOTH,
    WT_WAYS_APPROACH,
    WT_WAYS_RETRACT
} wt_curve_direction;

/* Deflection sensitivity by curves on a hard surface. */
typedef struct wt_sensitivity_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_slope_options options;
    wt_curve_direction ways; /* which ways the answer is of */
    double
        most_bend; /* change of the slope within the part, of the slope, that is still straight */
} wt_sensitivity_job;
WT_API wt_sensitivity_job wt_sensitivity_job_defaults(void);
WT_API const wt_params *wt_sensitivity_job_params(void);
typedef struct wt_sensitivity_tables {
    wt_table *sensitivity, *sensitivity_curves;
} wt_sensitivity_tables;
WT_API void wt_sensitivity_tables_clear(wt_sensitivity_tables *tables);
/* WT_E_EMPTY if no file gives a curve. Where the surface gives way or the signal is not straight
 * there is no sensitivity, and the verdict says why. */
WT_API wt_status wt_sensitivity_make(const wt_sensitivity_job *job, const wt_job *work,
                                     wt_sensitivity_tables *tables, wt_error *err) WT_NODISCARD;

/* Spring constant of a lever by the spectrum of its thermal noise: k = mode_shape / chi^2 k_B T /
 * <d^2>, d the deflection by the sensitivity of curves on a hard surface. Beside it, where the plan
 * view of the lever or its kind's coefficient are given, Sader's method. */
typedef struct wt_thermal_job {
    const wt_file_set *sets; /* read.sensitivity [m/V] for spectra in volts that say none */
    size_t n_sets;
    wt_estimate temperature;   /* of the lever [K]; NaN: of the file, else 25 degC with a warning */
    double sensitivity_error;  /* relative */
    double mode_shape;         /* share of the first mode in the thermal energy of the deflection */
    double chi;                /* sensitivity of the free lever over that on a surface */
    double from, to;           /* range of the fit [Hz]; NaN: about the peak */
    wt_estimate length, width; /* of a rectangular lever [m]; NaN: not known */
    wt_medium medium;          /* about the lever */
    wt_estimate sader_coefficient; /* A of k = A Q f^1.3 [N/m per kHz^1.3]; NaN: not known */
} wt_thermal_job;
WT_API wt_thermal_job wt_thermal_job_defaults(void);
WT_API const wt_params *wt_thermal_job_params(void);
/* Table "thermal". WT_E_EMPTY if no file has a spectrum. */
WT_API wt_status wt_thermal_make(const wt_thermal_job *job, const wt_job *work, wt_table **table,
                                 wt_error *err) WT_NODISCARD;

/* How the end of the running-in is found. */
typedef enum wt_running_in_rule {
    WT_RUNNING_IN_LIKELIHOOD, /* wt_running_in_find */
    WT_RUNNING_IN_STEP,       /* wt_step_detect */
    WT_RUNNING_IN_MSER,       /* wt_mser_5 */
    WT_RUNNING_IN_NONE        /* all is steady */
} wt_running_in_rule;

/* Records of friction: running-in, friction when it is over, wear. A step is where the instrument
 * says so, or where velocity, load, pressure or temperature change to another value. */
typedef struct wt_record_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_cycle_kind cycle;
    wt_running_in_rule running_in;
    wt_estimate load;         /* [N] where the record says none; NaN: none */
    wt_estimate track_radius; /* [m] instead of that of the file; NaN: that */
    /* Wear, NaN: not known; one of the first three, else the depth of the record under a ball. */
    wt_estimate track_area; /* cross-section that is missing [m^2] */
    const char *profile;    /* files of profiles across the track that tell it; NULL: none */
    const wt_file_set *profile_set; /* how they are read; NULL: as the records */
    wt_estimate mass_loss;          /* [kg], with */
    wt_estimate density;            /* [kg/m^3] */
    wt_estimate track_length;       /* [m]; NaN: circumference of the track, or the stroke */
    wt_estimate ball_radius;        /* [m] */
    /* Nominal pressure of the ball. */
    wt_estimate modulus;  /* Young's, at the frequency of the contact [Pa] */
    double poisson_ratio; /* of the rubber */
} wt_record_job;
WT_API wt_record_job wt_record_job_defaults(void);
WT_API const wt_params *wt_record_job_params(void);
/* A mass takes a density. */
WT_API wt_status wt_record_job_check(const wt_record_job *job, wt_error *err) WT_NODISCARD;
typedef struct wt_record_tables {
    wt_table *record, *record_cycles;
    wt_table *wear; /* NULL: nothing of it was given */
} wt_record_tables;
WT_API void wt_record_tables_clear(wt_record_tables *tables);
/* WT_E_EMPTY if no file has a record. */
WT_API wt_status wt_record_make(const wt_record_job *job, const wt_job *work,
                                wt_record_tables *tables, wt_error *err) WT_NODISCARD;

/* What was measured on a curve as one number; 0 = too little for that. */
typedef struct wt_curve_digest {
    uint64_t digest;
    size_t item;
} wt_curve_digest;

/* The accepted moduli of an indentation table as a group of the fit room; the arrays are allocated,
 * to be released with wt_group_data_clear. A curve that is in the table twice is taken once. */
typedef struct wt_group_data {
    wt_group group; /* borrows the arrays below */
    double *modulus;
    long *spot;
    double *indentation_rate;     /* [n] m/s, NaN if unknown */
    double *equivalent_frequency; /* [n] rad/s, NaN if unknown */
    double *spectrum_factor;      /* [n] on the spectrum of the DMA, NaN if unknown */
    double *pull;                 /* [n] N, the largest of approach and retract; NaN if unknown */
    double *max_force, *max_indentation; /* [n] N, m; NaN if unknown */
    /* of all curves together: mean residual of the largest force, and the chance of more by
     * scatter; NaN if unknown */
    double pooled_misfit, pooled_misfit_p;
    /* [n_fitted] of the curves that were fitted, rejected ones too, for a misfit rejects them: cube
     * root of the lack of fit, number of the spot (not that of the accepted ones) */
    double *lack_of_fit;
    long *fitted_spot;
    size_t n_fitted;
    wt_curve_digest *digest;     /* [n_digests] of the curves, rising */
    size_t n_digests, n_copies;  /* how many were left out as copies */
    const char *copy_of[2];      /* files of the first copy; borrowed from the table */
    wt_estimate spring_constant; /* of the table; NaN if it has none */
    double sensitivity_gain;     /* mean of the curves, NaN if unknown */
    wt_estimate sensitivity;     /* that was given; NaN if none was, or several */
    /* relative standard errors, NaN if not stated, and what 1 of each does to ln E, NaN if unknown
     */
    double common_error[WT_COMMON_SOURCES];
    wt_estimate common_gain[WT_COMMON_SOURCES];
    double loss_error, bend_error; /* what all moduli may be off by alike, the bend with the sign
                                      that it has in all; 0 if none was found, NaN
                                      if there is one and its size is not known */
    double misfit_error;           /* likewise of what the contact law misses */
    const char *tip;               /* in words; borrowed from the table; NULL if unknown */
    bool several_levers;           /* the curves have several spring constants */
    bool several_sensitivities, several_tips;
    bool spots_given;              /* the user named the spots */
    wt_curve_verdict rejected_for; /* the commonest verdict of the rejected curves */
    size_t n_rejected_for;         /* that have it */
} wt_group_data;
/* A spot is what was named so, else a file, or `each_place` of those that were not named. */
WT_API wt_status wt_group_from_table(const wt_table *indentation, bool each_place,
                                     wt_group_data *data, wt_error *err) WT_NODISCARD;
WT_API void wt_group_data_clear(wt_group_data *data);
/* Table "modulus_groups", one row per indentation table. A group without an accepted curve has a
 * row with n = 0. */
WT_API wt_status wt_modulus_groups(const wt_table *const *indentation, size_t n, wt_table **table,
                                   wt_error *err) WT_NODISCARD;
/* Table "modulus_budget": of each group, what the error of its modulus consists of, scatter and
 * what its curves share. NULL if no group states a common error. */
WT_API wt_status wt_modulus_budget(const wt_table *const *indentation, size_t n, wt_table **table,
                                   wt_error *err) WT_NODISCARD;

/* ---- results of cases side by side ----------------------------------------------------------- */

/* A result of wt_run, whose sample and condition are those of the case, or `file` and ""; or one of
 * wt_indent_group, whose groups stand beside the cases. */
typedef struct wt_collected {
    const wt_result *result;
    const char *file;
} wt_collected;

typedef struct wt_collect_job {
    double margin; /* relative difference of modulus ratios that does not matter; default 0.2 */
    double constant_margin; /* the same of constants that cases have in common; default 0.5 */
} wt_collect_job;
WT_API wt_collect_job wt_collect_job_defaults(void);
WT_API const wt_params *wt_collect_job_params(void);

/* The tables of these names; NULL: no case has anything for it, or there is no pair. */
typedef struct wt_collection_tables {
    wt_table *collection, *collected_modulus, *collected_friction, *collected_force, *ratio_pairs,
        *shared_constants, *shared_members, *collected_constants, *shared_pairs;
} wt_collection_tables;
WT_API void wt_collection_tables_clear(wt_collection_tables *tables);
/* Modulus ratios of pairs are compared as if they knew nothing of each other; of constants in
 * common the errors that come from the same files are one. WT_E_EMPTY without a case;
 * WT_E_AMBIGUOUS for two cases of one sample and condition. */
WT_API wt_status wt_collect(const wt_collected *cases, size_t n, const wt_collect_job *job,
                            wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- DMA: shift factors, WLF, master curve, Prony -------------------------------------------- */

/* The samples of isotherms and temperature sweeps, in the order of their names; that of sweeps
 * without one is "". */
typedef struct wt_samples {
    size_t n;
    char **name;
} wt_samples;
WT_API void wt_samples_clear(wt_samples *samples);
/* `samples` is to be cleared. What is read stays in work->dma, if there is one, for the jobs that
 * fit it. */
WT_API wt_status wt_samples_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                                 wt_samples *samples, wt_error *err) WT_NODISCARD;

typedef struct wt_master_job {
    const wt_file_set *sets;
    size_t n_sets;
    wt_master_options fit;        /* reference_temperature NaN: the isotherm in the middle */
    double poisson_ratio;         /* of the rubber; default 0.5 */
    const char *const *leave_out; /* "temperature:LOW..HIGH" or "frequency:LOW..HIGH", where either
                                     end may be missing, or one value in its place */
    size_t n_leave_out;
    const char *shift_law;  /* "wlf:reference-temperature=T,c1=X,c2=X" or
                               "arrhenius:activation-energy=E" that all shifts follow; or NULL */
    const wt_table *shifts; /* columns temperature, log_a and, if it has that, log_b of shifts that
                               are not fitted, borrowed; or NULL */
    wt_reduction reduction; /* with parameters of its own */
} wt_master_job;
WT_API wt_master_job wt_master_job_defaults(void);
WT_API const wt_params *wt_master_job_params(void);

/* One draw of all that is not known of a rubber together. */
typedef struct wt_rubber_draw {
    wt_prony prony; /* at the reference temperature */
    wt_shift_law law;
    double *log_b; /* [n_vertical] */
} wt_rubber_draw;

/* What tells the moduli. */
typedef enum wt_rubber_kind {
    WT_RUBBER_SERIES, /* prony */
    WT_RUBBER_TABLE,  /* the points of the one isotherm of `sweep`, linear in log-log */
    WT_RUBBER_ZENER   /* fractional, in tension */
} wt_rubber_kind;

/* E(w) = (E0 + Eg z) / (1 + z), z = (i w tau)^alpha. */
typedef struct wt_zener {
    double e0, eg; /* [Pa] */
    double tau;    /* [s] */
    double alpha;
} wt_zener;

/* The rubber as the later stages know it: moduli at one reference temperature and how to go to
 * another one. */
typedef struct wt_rubber {
    wt_rubber_kind kind;
    wt_prony prony; /* E or G as measured, vertical shift applied, at the reference temperature; of
                       another kind without terms */
    wt_zener zener;
    wt_extrapolation extrapolation; /* of a table */
    double poisson_ratio;
    bool is_transverse; /* the moduli are the E of the next */
    wt_transverse transverse;
    wt_shift_law law;                         /* kind NONE: no other temperature */
    double c1_error, c2_error, c_correlation; /* of a law that came without isotherms; 0 unknown */
    double temperature_min, temperature_max;  /* of the isotherms [K]; NaN = not known */
    size_t n_vertical;                        /* log_b against temperature; 0 = no vertical shift */
    double *vertical_temperature, *vertical_log_b;
    size_t n_draws; /* of what the isotherms say, which the replicates go through; 0 = unknown */
    wt_rubber_draw *draws;
    wt_sweep sweep; /* the isotherms and how they were fitted, for wt_rubber_refit */
    wt_master_options fit;
} wt_rubber;
WT_API void wt_rubber_clear(wt_rubber *rubber);
/* Says to the cost of `work` what the stage that goes on has read: the terms of a series, the
 * points of a table or the constants of a law are its items. For a rubber that no job made. */
WT_API void wt_rubber_cost(const wt_rubber *rubber, const wt_job *work);

/* How the moduli of a rubber are taken. */
typedef enum wt_moduli { WT_MODULI_SERIES, WT_MODULI_POINTS } wt_moduli;
typedef struct wt_rubber_options {
    wt_moduli moduli; /* of isotherms: the series, or the points of the master curve */
    wt_extrapolation extrapolation; /* outside the points of any table; default hold */
} wt_rubber_options;
WT_API wt_rubber_options wt_rubber_options_defaults(void);
WT_API const wt_params *wt_rubber_options_params(void);

/* "fractional-zener:e0=5MPa,eg=2GPa,tau=1us,alpha=0.4" or the path of a table of the moduli at one
 * temperature: that of the file, else of `read`, else not known. */
WT_API wt_status wt_rubber_open(const char *text, const wt_read_options *read,
                                const wt_rubber_options *options, double poisson_ratio,
                                const wt_job *work, wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* The points of a table "master_curve" in place of the series, without draws, with the shifts that
 * the rubber has; one of zeros but for the Poisson ratio gets all that the table tells. Points
 * closer than a twentieth of a decade are joined. */
WT_API wt_status wt_rubber_tabulate(wt_rubber *rubber, const wt_table *master_curve,
                                    const wt_rubber_options *options, wt_error *err) WT_NODISCARD;
/* What tells the moduli, in words; "" for an isotropic series. Returns the length as snprintf does.
 */
WT_API size_t wt_rubber_describe(const wt_rubber *rubber, char *buffer, size_t size);

typedef struct wt_master_tables {
    wt_table *shift_factors, *master_curve, *prony, *material_draws, *series_draws;
    size_t n_isotherms;
    wt_table *prony_reduced, *relaxation_spectrum;
    wt_master *fit; /* that they are of */
} wt_master_tables;
WT_API void wt_master_tables_clear(wt_master_tables *tables);

/* Reads the sweeps and fits them. `rubber` gets all that friction needs. One isotherm is allowed:
 * no shift, no law. Either output may be NULL. */
WT_API wt_status wt_master_make(const wt_master_job *job, const wt_job *work,
                                wt_master_tables *tables, wt_rubber *rubber,
                                wt_error *err) WT_NODISCARD;

/* One law of the shift factors for the samples, each fitted by itself. */
typedef struct wt_shared_shift_law_job {
    const char *const *names;     /* [n] of the samples */
    const wt_master *const *fits; /* [n]; NULL: it could not be fitted */
    size_t n;
    double reference; /* temperature of the law [K]; NaN: that of the first sample it is of */
    wt_common common; /* default WT_COMMON_NONE: not asked for */
    double margin;    /* difference of laws that does not matter [decade]; default 0.1 */
} wt_shared_shift_law_job;
WT_API wt_shared_shift_law_job wt_shared_shift_law_job_defaults(void);
WT_API const wt_params *wt_shared_shift_law_job_params(void);
/* Table "shared_shift_law": the law with its errors, the shifts about it, and whether the samples
 * have one law. */
WT_API wt_status wt_shared_shift_law_make(const wt_shared_shift_law_job *job, wt_table **table,
                                          wt_error *err) WT_NODISCARD;

/* Temperature sweeps, or isotherms taken apart by frequency: where the glass transition is, and the
 * moduli at temperatures. */
typedef struct wt_ramp_job {
    const wt_file_set *sets;
    size_t n_sets;
    const double *temperature; /* rising [K]; owned by the caller */
    size_t n_temperatures;
    size_t peak_points; /* of a plain parabola; 0 (default): as wt_peak_find chooses */
} wt_ramp_job;
WT_API wt_ramp_job wt_ramp_job_defaults(void);
WT_API const wt_params *wt_ramp_job_params(void);
typedef struct wt_ramp_tables {
    wt_table *ramp, *glass_transition;
    wt_table *moduli_at; /* NULL without temperatures */
} wt_ramp_tables;
WT_API void wt_ramp_tables_clear(wt_ramp_tables *tables);
WT_API wt_status wt_ramp_make(const wt_ramp_job *job, const wt_job *work, wt_ramp_tables *tables,
                              wt_error *err) WT_NODISCARD;

/* Strain sweeps: how the moduli fall with the amplitude. */
typedef struct wt_payne_job {
    const wt_file_set *sets;
    size_t n_sets;
} wt_payne_job;
WT_API wt_payne_job wt_payne_job_defaults(void);
typedef struct wt_payne_tables {
    wt_table *payne, *payne_sweep;
} wt_payne_tables;
WT_API void wt_payne_tables_clear(wt_payne_tables *tables);
WT_API wt_status wt_payne_make(const wt_payne_job *job, const wt_job *work, wt_payne_tables *tables,
                               wt_error *err) WT_NODISCARD;

/* The tables that wt_master_make gave, as read from a file; borrowed. */
typedef struct wt_rubber_tables {
    const wt_table *prony;
    const wt_table *shift_factors;                 /* NULL: no other temperature */
    const wt_table *material_draws, *series_draws; /* NULL: the errors are not known */
} wt_rubber_tables;
WT_API wt_status wt_rubber_from_tables(const wt_rubber_tables *tables, double poisson_ratio,
                                       wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* The same isotherms with another vertical shift, without draws. WT_E_MISSING without isotherms. */
WT_API wt_status wt_rubber_refit(const wt_rubber *rubber, wt_vertical_shift vertical,
                                 wt_rubber *refitted, wt_error *err) WT_NODISCARD;

/* The reduced series for programs of finite elements, each by the keywords of its manual. */
typedef enum wt_fem_program {
    WT_SOLID_ABAQUS,
    WT_SOLID_ANSYS,
    WT_SOLID_CODE_ASTER, /* needs a Poisson's ratio below 0.5 */
    WT_SOLID_TABLE
} wt_fem_program;
/* Stress and time: Pa and s, MPa and s, GPa and ms. */
typedef enum wt_solid_units { WT_SOLID_M_KG_S, WT_SOLID_MM_T_S, WT_SOLID_MM_KG_MS } wt_solid_units;
typedef enum wt_solid_temperature { WT_SOLID_CELSIUS, WT_SOLID_KELVIN } wt_solid_temperature;
typedef enum wt_solid_domain { WT_SOLID_TIME, WT_SOLID_FREQUENCY } wt_solid_domain;
typedef struct wt_fem_export_options {
    wt_solid_units units;
    wt_solid_temperature temperature;
    wt_solid_domain domain; /* of Abaqus, which tells them apart */
    const char *name;       /* a letter, then letters, digits and '_', 32 at most; NULL: RUBBER */
    double density;         /* [kg/m3], NaN: not written */
    double expansion;       /* coefficient of linear thermal expansion [1/K], NaN: not written */
    double poisson_ratio;   /* at all times; default 0.5: incompressible */
} wt_fem_export_options;
WT_API wt_fem_export_options wt_fem_export_options_defaults(void);
WT_API const wt_params *wt_fem_export_options_params(void);
/* Whether there is such a program: "abaqus", "ansys", "code_aster", "table". */
WT_API bool wt_fem_program_find(const char *name, size_t length, wt_fem_program *program);
/* Whether the program can have such a material. */
WT_API wt_status wt_fem_export_check(wt_fem_program program, const wt_fem_export_options *options,
                                     wt_error *err) WT_NODISCARD;
/* Tables of wt_master_make; shift_factors NULL: no law. options NULL = defaults. */
WT_API wt_status wt_fem_export(FILE *out, wt_fem_program program, const wt_table *prony_reduced,
                               const wt_table *shift_factors, const wt_fem_export_options *options,
                               wt_error *err) WT_NODISCARD;

#define WT_NO_REPLICATE                                                                            \
    SIZE_MAX /* in the place of the number of a replicate: the values as fitted */
/* The material at a temperature [K] (NaN = reference): relaxation times times a_T, moduli divided
 * by b_T. `statement` (may be NULL) gets what must be said: outside the isotherms, b held.
 * WT_E_MISSING more than 1 K away without a WLF law; WT_E_RANGE at or below its pole. replicate:
 * a number, or WT_NO_REPLICATE. */
WT_API wt_status wt_rubber_at(const wt_rubber *rubber, double temperature, uint64_t seed,
                              size_t replicate, wt_material **material, char statement[256],
                              wt_error *err) WT_NODISCARD;

/* ---- comparison ------------------------------------------------------------------------------ */

/* Whether bulk and track were indented with one cantilever, whose errors cancel in the ratio. */
typedef enum wt_cantilever_sharing {
    WT_LEVERS_AUTO, /* one if the spring constants are equal */
    WT_LEVERS_ONE,
    WT_LEVERS_TWO
} wt_cantilever_sharing;

typedef struct wt_compare_job {
    const wt_table *bulk, *track;  /* indentation tables */
    const wt_rubber *rubber;       /* for the DMA comparison; NULL = none (default) */
    wt_estimate temperature;       /* of the indentation [K]; NaN = the rubber's reference */
    wt_estimate track_temperature; /* NaN = the same in the track */
    wt_estimate temperature_slope; /* d ln E/dT [1/K]; NaN = that of the rubber */
    wt_cantilever_sharing levers;
    double lever_error;       /* of a spring constant whose table states none; default 0 = none */
    double sensitivity_error; /* relative standard error; default 0 = none stated */
    double tip_error;         /* of the modulus by the tip, relative; default 0 = none stated */
    double spot_scatter;      /* relative, where one spot does not tell it; default 0 = not known */
    bool map_spots;           /* each place of a map is a spot; default false: a map is one */
    double margin;            /* relative difference that does not matter; default 0.2 */
    bool rates;               /* default true: table of the modulus against rate */
    bool groups_only;         /* no comparison of the two groups */
    wt_estimate
        expected_thickness; /* known otherwise [m]; NaN (default): that of the theory, if any */
} wt_compare_job;
WT_API wt_compare_job wt_compare_job_defaults(void);
WT_API const wt_params *wt_compare_job_params(void);

typedef struct wt_compare_tables {
    wt_table *modulus_groups;
    wt_table *comparison;
    wt_table *modulus_rate;   /* NULL if no rate is known or asked for */
    wt_table *dma_comparison; /* NULL without rubber or rates */
    wt_table *modulus_budget; /* NULL where no group states a common error */
} wt_compare_tables;
WT_API void wt_compare_tables_clear(wt_compare_tables *tables);
/* Also with bulk or track NULL: then without "comparison". Where a group has no curve with a
 * modulus it says so, in a row without numbers. WT_E_RANGE if a curve is in both groups. */
WT_API wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *work,
                                   wt_compare_tables *tables, wt_error *err) WT_NODISCARD;

/* What the curves alone say of the thickness of a layer in the track, beside another thickness: the
 * one of the job or, where that is NaN, that of `layer` (table "layer", or NULL). Table
 * "track_layer"; NULL where the tables of the groups hold nothing of depth and no thickness is
 * given. */
WT_API wt_status wt_track_layer_make(const wt_compare_job *job, const wt_table *layer,
                                     const wt_job *work, wt_table **table,
                                     wt_error *err) WT_NODISCARD;

/* The moduli of dwells (tables dwell_moduli as job->bulk and job->track, of which the track may be
 * NULL) against those of job->rubber at the same frequency and temperature: table dwell_dma. */
WT_API wt_status wt_compare_dwells(const wt_compare_job *job, const wt_job *work, wt_table **table,
                                   wt_error *err) WT_NODISCARD;

/* ---- materials side by side ------------------------------------------------------------------ */

typedef struct wt_compared {
    const char *name;
    const wt_rubber *rubber;
    const wt_table *shift_factors; /* whether superposition holds; NULL: not known */
} wt_compared;

typedef struct wt_materials_job {
    const wt_compared *materials; /* the moduli of each are divided by those of the first */
    size_t n_materials;           /* two or more */
    double temperature;  /* over frequency [K]; NaN: the first's reference, if all have it */
    double frequency;    /* over temperature [rad/s]; NaN: 10 Hz, if all have it */
    double sample_error; /* of the modulus by the dimensions of a sample, relative */
    double margin;       /* relative difference that does not matter; default 0.2 */
} wt_materials_job;
WT_API wt_materials_job wt_materials_job_defaults(void);
WT_API const wt_params *wt_materials_job_params(void);

typedef struct wt_materials_tables {
    wt_table *materials, *material_ratio;
} wt_materials_tables;
WT_API void wt_materials_tables_clear(wt_materials_tables *tables);
/* Moduli and their ratios where all was measured: each at the other's temperatures by its own shift
 * law. WT_E_RANGE without a temperature and a frequency in common. */
WT_API wt_status wt_compare_materials(const wt_materials_job *job, const wt_job *work,
                                      wt_materials_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- roughness ------------------------------------------------------------------------------- */

/* A counter surface with its error, stated or measured. */
typedef struct wt_surface {
    bool self_affine;
    double q0, qr, q1, hurst;   /* of the self-affine law; q0, q1 cut a spectrum (NaN = its ends) */
    wt_estimate c0;             /* [m^4]; of a spectrum: value 1, relative error of the densities */
    wt_power_spectrum spectrum; /* if not self-affine; 2-D */
    double *modes_error; /* [spectrum.n] standard errors of ln C by its modes; NULL: not known */
    double *modes_tie;   /* [spectrum.n] correlation of that with the next point's; NULL: none */
    double *law_error;   /* [spectrum.n] beyond what was measured, by the law, all together; NULL */
    /* [n_sizes * spectrum.n] Of scans of several sizes: the parts of c0.standard_error that ln C of
     * the points has by the places of the widest scans, then of the next, each of which is drawn
     * for itself. NULL: all have all of it together. */
    size_t n_sizes;
    double *place_parts;
    double reliable_to; /* of a measured one: beyond it goes on by its law [rad/m]; 0: not known */
    double steep;       /* where its rms slope reaches 1.3 [rad/m]; 0: not known, or nowhere */
    bool places_known;  /* how its places differ, though the error of c0 be 0 */
} wt_surface;
WT_API void wt_surface_clear(wt_surface *surface);
/* "self-affine:q0=1e3rad/m,qr=5e3rad/m,q1=1e7rad/m,hurst=0.8,c0=1e-17m^4+-10%", the path of a
 * spectrum, or that of a height map, or a folder or pattern of several, which are then transformed
 * as by wt_topography_make. read NULL = defaults. */
WT_API wt_status wt_surface_open(const char *text, const wt_read_options *read, const wt_job *work,
                                 wt_surface *surface, wt_error *err) WT_NODISCARD;
/* The law with all densities multiplied by `factor` > 0. It borrows nothing. */
WT_API wt_status wt_surface_roughness(const wt_surface *surface, double factor,
                                      wt_roughness **roughness, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_surface_table(const wt_surface *surface, wt_table **table,
                                  wt_error *err) WT_NODISCARD; /* "roughness" */

/* ---- softening with strain ------------------------------------------------------------------- */

/* How the moduli of a rubber soften with strain. */
typedef struct wt_strain_softening {
    wt_softening table;    /* its arrays are its own */
    double *storage_error; /* [n] standard error of f; NULL: not known */
    double *loss_error;    /* [n] of g; likewise */
    size_t n_sweeps;       /* of which it is the mean; 0: a table that was given */
    double temperature;    /* mean of theirs [K]; NaN: not known */
} wt_strain_softening;
WT_API void wt_strain_softening_clear(wt_strain_softening *softness);
/* Which of several strain sweeps. */
typedef struct wt_strain_softening_choice {
    double temperature; /* those measured nearest to it [K]; NaN: they are of one */
    const char *sample; /* those of this one; NULL: they are of one */
} wt_strain_softening_choice;
WT_API wt_strain_softening_choice wt_strain_softening_choice_defaults(void);
/* From the table payne_sweep: f and g are storage_ratio and loss_ratio; of several sweeps their
 * mean over the strains that all have reached, and the error is what another sweep would scatter
 * about it, 1.96 of it to each side for 95 % of them. WT_E_AMBIGUOUS if they are of several
 * temperatures or samples and none is chosen: those are no repeats. Or from any table with columns
 * strain, f, g and maybe f_error, g_error. */
WT_API wt_status wt_strain_softening_from_table(const wt_table *table,
                                                wt_strain_softening_choice choice,
                                                wt_strain_softening *softness,
                                                wt_error *err) WT_NODISCARD;
/* From payne_sweep among the tables of a file, or the first of them; the file is an input of the
 * work, shown as `name`. */
WT_API wt_status wt_strain_softening_read(const char *path, const char *name,
                                          wt_strain_softening_choice choice, const wt_job *work,
                                          wt_strain_softening *softness,
                                          wt_error *err) WT_NODISCARD;

/* ---- friction -------------------------------------------------------------------------------- */

/* Rubber on a counter surface under conditions. */
typedef struct wt_sliding {
    const wt_rubber *rubber;   /* borrowed */
    const wt_surface *surface; /* borrowed */
    wt_estimate pressure;      /* [Pa] */
    wt_estimate temperature;   /* [K]; value NaN = the rubber's reference */
    wt_estimate
        shear_stress;       /* of the real contact [Pa]; value NaN: not known, no total friction */
    double gamma;           /* as in wt_friction_options; default 1 */
    const double *velocity; /* [n_velocity] m/s, borrowed */
    size_t n_velocity;
    double reference_velocity; /* of the answer and the layer [m/s]; NaN = middle of the list */
    const wt_strain_softening *softness; /* borrowed; NULL = none */
    double strain_factor;                /* as in wt_friction_options; default 1 */
    wt_anisotropy anisotropy;            /* of the roughness; default none */
    const double *temperatures;          /* [n_temperatures] K, of the friction map, borrowed */
    size_t n_temperatures;
    const double *pressures; /* [n_pressures] Pa, likewise */
    size_t n_pressures;
    bool decades;                  /* the friction by decades of the wavenumber is asked for */
    wt_area_law area_law;          /* likewise */
    wt_flash flash;                /* likewise; `temperature` is then that of the surroundings */
    wt_shear_law shear_law;        /* of the shear stress, which is that of its peak */
    bool sensitivities;            /* of the friction at the reference velocity; default false */
    const wt_rubber *layer_rubber; /* the material of a layer, instead of a modulus ratio, borrowed;
                                      default NULL */
} wt_sliding;
WT_API wt_sliding wt_sliding_defaults(void);
WT_API const wt_params *wt_sliding_params(void);

/* What is on the surface of the track. */
typedef struct wt_layer_observation {
    wt_estimate thickness;     /* [m] */
    wt_estimate modulus_ratio; /* E_track / E_bulk */
    double modulus_ratio_df;   /* degrees of freedom of its error (Student's t); 0 = normal */
    wt_estimate ratio_slope;   /* of ln modulus_ratio against ln omega; default 0: one ratio */
    double ratio_frequency;    /* where the ratio is modulus_ratio [rad/s]; NaN: not given */
    double ratio_lowest, ratio_highest; /* that were measured, outside of which it is constant
                                           [rad/s]; NaN: not given */
    double ratio_temperature;           /* of these frequencies [K]; NaN: that of the sliding */
    bool by_rate;    /* of a case: the ratio goes with the rate as compared; default false */
    bool bulk_shear; /* tau_s = tau_bulk, not times the modulus ratio; default false */
    double calibration_share;    /* of the variance of the ratio that is of spring constants and the
                                    like, not of the scatter of spots; default 0 */
    const wt_layer_shear *shear; /* of the real contact with it; NULL: as by default */
} wt_layer_observation;
WT_API wt_layer_observation wt_layer_observation_defaults(void); /* no layer */
WT_API const wt_params *wt_layer_observation_params(void);
/* Ratio, slope and frequencies from tables of `weartrack compare`: the ratio of all rates at their
 * mean frequency, and how that of each rate goes with its frequency. WT_E_MISSING with one rate. */
WT_API wt_status wt_layer_observation_by_rate(const wt_table *comparison,
                                              const wt_table *modulus_rate,
                                              wt_layer_observation *known,
                                              wt_error *err) WT_NODISCARD;

typedef struct wt_friction_tables {
    wt_table *friction;
    double extrapolated_share; /* largest of all velocities */
} wt_friction_tables;
WT_API void wt_friction_tables_clear(wt_friction_tables *tables);

/* Hysteresis friction, contact area and total friction at every velocity. Standard errors come from
 * replicates: spectrum, shifts and law drawn together from what the isotherms say, and pressure,
 * temperature, shear stress and C0 drawn from their stated errors; the key
 * `standard_error_includes` says which. With a layer (NULL = none): the same with a bonded layer
 * and tau_s = tau_bulk x modulus ratio. */
WT_API wt_status wt_friction_make(const wt_sliding *sliding, const wt_layer_observation *layer,
                                  const wt_job *work, wt_friction_tables *tables,
                                  wt_error *err) WT_NODISCARD;

/* Table "contact_area": contact area and friction against magnification at the slowest, the
 * reference and the fastest velocity. */
WT_API wt_status wt_contact_area_table(const wt_sliding *sliding, const wt_job *work,
                                       wt_table **table, wt_error *err) WT_NODISCARD;

/* Table "softening": hysteresis friction and contact area with the softening of `sliding` and
 * without it, and the shares from strains that it does not know. WT_E_ARG if there is none. */
WT_API wt_status wt_softening_make(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                   wt_error *err) WT_NODISCARD;
/* Table "flash_temperature": hysteresis friction, contact area and temperature at every velocity
 * with the flash temperature of `sliding`, the same of a second solution where there is one, and
 * without it. WT_E_ARG if it is not asked for. */
WT_API wt_status wt_flash_make(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                               wt_error *err) WT_NODISCARD;
/* Table "directions": hysteresis friction and contact area of a transversely isotropic rubber at
 * every velocity, with its factors on E' and E'' and with those on one of them or none. WT_E_ARG if
 * it has no directions. */
WT_API wt_status wt_transverse_isotropy_make(const wt_sliding *sliding, const wt_job *work,
                                             wt_table **table, wt_error *err) WT_NODISCARD;

/* Table "anisotropy": hysteresis friction, contact area and the force to the side with the
 * anisotropy of `sliding` and without it. WT_E_ARG if there is none. */
WT_API wt_status wt_anisotropy_make(const wt_sliding *sliding, const wt_job *work, wt_table **table,
                                    wt_error *err) WT_NODISCARD;
/* Table "friction_map": friction at every velocity and temperature at the nominal pressure, then at
 * every velocity and pressure at the nominal temperature. One preparation of the kernel at the
 * reference temperature of the rubber serves all: mu(v, T, p) is mu(v a_T, reference, p b_T).
 * WT_E_ARG if neither temperatures nor pressures are given. */
/* Without the layer `known` (NULL: none), but with the crack opening that its shear stress has on
 * the bare surface, too. */
WT_API wt_status wt_friction_map_make(const wt_sliding *sliding, const wt_layer_observation *known,
                                      const wt_job *work, wt_table **table,
                                      wt_error *err) WT_NODISCARD;
/* Table "friction_decades": what the roughness of each decade of the wavenumber makes of the
 * hysteresis friction, and of the shearing and crack opening of bare rubber (`known` as in the
 * map), at the slowest, the reference and the fastest velocity. */
WT_API wt_status wt_friction_decades_make(const wt_sliding *sliding,
                                          const wt_layer_observation *known, const wt_job *work,
                                          wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- modified layer -------------------------------------------------------------------------- */

/* What modifies the rubber: the hysteresis below the surface, the shearing of the real contact, or
 * both. Where the shearing goes to is rebuilt: with depth as the hysteresis. */
typedef enum wt_layer_energy { WT_LAYER_HYSTERESIS, WT_LAYER_SHEAR, WT_LAYER_BOTH } wt_layer_energy;

typedef struct wt_layer_job {
    wt_estimate critical_energy;    /* U_c [J/m^3]; value NaN: calibrated from the next */
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
    double velocity;          /* at which the track was worn [m/s]; NaN = the reference velocity */
    wt_layer_energy energy;   /* default hysteresis */
    double shear_share;       /* of the power of shearing that counts, [0, 1]; default 1 */
    double severity_power;    /* as in wt_layer_parameters; default 0 */
    double severity_exponent; /* likewise; default 1 */
    wt_layer_closure closure; /* default energy; activated at the temperature of the rubber */
    wt_estimate barrier;      /* of the activated closure [J] */
    wt_activation activation; /* its volume, attempt and ageing */
    bool bands;               /* the modified bands are asked for */
    const char *const *loads; /* [n_loads] that follow one another, borrowed; none: the load of the
                                 sliding for ever */
    size_t n_loads;
    bool running_in;      /* friction while the layer grows is asked for */
    bool acts_back;       /* the layer acts back on the energy that makes it */
    wt_layer_shear shear; /* of the real contact on the layer */
    bool existence;       /* where a layer exists is asked for */
} wt_layer_job;
WT_API wt_layer_job wt_layer_job_defaults(void);
WT_API const wt_params *wt_layer_job_params(void);
/* Also what goes together: one of critical energy and observed thickness, and wear for the latter.
 */
WT_API wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err) WT_NODISCARD;

typedef struct wt_layer_tables {
    wt_table *layer;
    wt_estimate thickness; /* at balance [m]; infinity without wear */
    wt_layer_balance balance;
} wt_layer_tables;
WT_API void wt_layer_tables_clear(wt_layer_tables *tables);

/* Thickness of the layer at the reference velocity. Standard errors from the replicates of the
 * friction and the stated errors of k and U_c (or of the observed thickness). */
WT_API wt_status wt_layer_make(const wt_sliding *sliding, const wt_layer_job *job,
                               const wt_job *work, wt_layer_tables *tables,
                               wt_error *err) WT_NODISCARD;

/* Table "layer_bands": upper and lower edge of the modified rubber in time, by exact transport of
 * damage through the loads of the job, and how the bands come about. */
WT_API wt_status wt_layer_bands_make(const wt_sliding *sliding, const wt_layer_job *job,
                                     const wt_job *work, wt_table **table,
                                     wt_error *err) WT_NODISCARD;
/* Table "running_in": friction with the layer that has grown until then, whose modulus ratio is
 * that of `known`; with `acts_back` also its energy is that under this layer. */
WT_API wt_status wt_running_in_make(const wt_sliding *sliding, const wt_layer_job *job,
                                    const wt_layer_observation *known, const wt_job *work,
                                    wt_table **table, wt_error *err) WT_NODISCARD;
/* Table "layer_feedback": all balances of a layer that acts back, and the folds between them. */
WT_API wt_status wt_layer_balances_make(const wt_sliding *sliding, const wt_layer_job *job,
                                        const wt_layer_observation *known, const wt_job *work,
                                        wt_table **table, wt_error *err) WT_NODISCARD;
/* Table "existence": balance thickness at every velocity, at the pressures of the map of `sliding`
 * if it has some, else at its pressure, and with `known` (may be NULL) what the layer does to
 * friction. */
WT_API wt_status wt_layer_regime_map_make(const wt_sliding *sliding, const wt_layer_job *job,
                                          const wt_layer_observation *known, const wt_job *work,
                                          wt_table **table, wt_error *err) WT_NODISCARD;

/* Table "energy_density": the energy density against depth at the velocity of the layer. */
WT_API wt_status wt_energy_density_table(const wt_sliding *sliding, const wt_layer_job *job,
                                         const wt_job *work, wt_table **table,
                                         wt_error *err) WT_NODISCARD;

typedef struct wt_identify_job {
    wt_estimate observed_thickness; /* [m], at balance */
    wt_estimate specific_wear_rate; /* k [m^2/N]; value NaN: not measured */
    wt_estimate running_in_time;    /* [s] from bare rubber; value NaN: not measured */
    double running_in_share;        /* of the thickness that the layer had then; default 0.95 */
    double damage, duty;            /* as in wt_layer_job */
    wt_depth_profile profile;
    double local_friction;
    double wear_low, wear_high;     /* k by the literature [m^2/N] */
    double energy_low, energy_high; /* U_c by the literature [J/m^3] */
} wt_identify_job;
WT_API wt_identify_job wt_identify_job_defaults(void);
WT_API const wt_params *wt_identify_job_params(void);
/* Table "identification": U_c and k from the thickness with the wear rate, with the running-in time
 * by either closure, and what the thickness alone leaves of them; intervals of 95 % and correlation
 * from the replicates and the stated errors. */
WT_API wt_status wt_identify_make(const wt_sliding *sliding, const wt_identify_job *job,
                                  const wt_job *work, wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- what if ----------------------------------------------------------------------------------
 */

/* Table "what_if": friction and layer at the reference velocity, then the same with one choice of
 * the model moved in each row, and what that changes. Choices that do not apply have no row; a row
 * that cannot be computed says why. `layer` NULL: no thickness of the layer; `known` NULL: no
 * friction with a layer. With both, the thickness is that which `layer` gives. */
WT_API wt_status wt_what_if_make(const wt_sliding *sliding, const wt_layer_job *layer,
                                 const wt_layer_observation *known, const wt_job *work,
                                 wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- validation ------------------------------------------------------------------------------ */

typedef struct wt_validation_job {
    const wt_sliding *sliding;
    const wt_layer_job *layer;         /* NULL, as above */
    const wt_layer_observation *known; /* likewise; its thickness is that of the layer as used */
    const wt_table *record;            /* table "record" */
    const wt_table *cycles;            /* table "record_cycles", of the running-in alone */
    const wt_table *wear;              /* table "wear", or NULL */
    const wt_table *what_if; /* table "what_if" of the same, or NULL: no likelihood of choices */
    double margin;           /* of measured over predicted; default 0.2 */
    double plausible_low, plausible_high; /* of the shear stress [Pa]; default 1 MPa, 10 MPa */
    double running_in_margin;             /* of the times and changes of a running-in; default 1 */
    bool wanted; /* of a case: its records are held against it; default true */
} wt_validation_job;
WT_API wt_validation_job wt_validation_job_defaults(void); /* the margins and what follows */
WT_API const wt_params *wt_validation_job_params(void);

typedef struct wt_validation_tables {
    wt_table *validation, *choices, *sources; /* choices NULL without what_if or shear stress */
} wt_validation_tables;
WT_API void wt_validation_tables_clear(wt_validation_tables *tables);

/* Friction as measured over friction as predicted at every step of the records, with both errors;
 * the verdict "explains", "does not" or "cannot say" by the test that the key `test` states; the
 * shear stress and the largest wavenumber that the record asks for; where the error comes from; and
 * the likelihood of each choice of the model. */
WT_API wt_status wt_validation_make(const wt_validation_job *job, const wt_job *work,
                                    wt_validation_tables *tables, wt_error *err) WT_NODISCARD;

typedef struct wt_running_in_tables {
    wt_table *running_in, *course; /* "validation_running_in", "validation_course" */
} wt_running_in_tables;
WT_API void wt_running_in_tables_clear(wt_running_in_tables *tables);

/* Friction in time, in the first step of every record, over that which is predicted while the layer
 * of `layer` and `known` (not NULL) grows: time to the steady value and change of friction, with
 * both errors; a verdict as above; the specific wear rate and the critical energy that the time
 * asks for. */
WT_API wt_status wt_validation_running_in_make(const wt_validation_job *job, const wt_job *work,
                                               wt_running_in_tables *tables,
                                               wt_error *err) WT_NODISCARD;

/* ---- error budget ---------------------------------------------------------------------------- */

/* Table "error_budget": the error of each number at the reference velocity by every source alone
 * (replicates with all others held), by the replicates and the arithmetic, and by the choices of
 * the model, which `what_if` (may be NULL) moved; with the time that each took, if the cost of
 * `work` has times and was that of `what_if`, and what would make it smaller. `layer` and `known`
 * as above. */
WT_API wt_status wt_error_budget_make(const wt_sliding *sliding, const wt_layer_job *layer,
                                      const wt_layer_observation *known, const wt_table *what_if,
                                      const wt_job *work, wt_table **table,
                                      wt_error *err) WT_NODISCARD;

/* ---- coverage -------------------------------------------------------------------------------- */

typedef struct wt_coverage_job {
    const wt_sliding *sliding;
    const wt_layer_job *layer;         /* NULL, as above */
    const wt_layer_observation *known; /* likewise */
    const wt_table *bulk, *track;      /* indentation tables, or NULL: no groups to compare */
    size_t trials;
    /* the curves of both groups, which are then drawn anew and fitted; NULL: their moduli are drawn
     */
    const wt_curve_set *curves[2];
    bool ratio_of_groups; /* the ratio of `known` is that of the groups: of the trial in each trial
                           */
} wt_coverage_job;
WT_API wt_coverage_job wt_coverage_job_defaults(void); /* trials 0 */
WT_API const wt_params *wt_coverage_job_params(void);
/* Table "coverage": the case drawn anew from its own fit (isotherms with their noise and scatter of
 * temperature, force curves of spots and curves that scatter, inputs by their stated errors),
 * computed each time as it is, and how often the intervals that it then states hold what it was
 * drawn from. It cannot reveal a wrong model, which the table says. */
WT_API wt_status wt_coverage_make(const wt_coverage_job *job, const wt_job *work, wt_table **table,
                                  wt_error *err) WT_NODISCARD;

/* ---- error against run time ------------------------------------------------------------------ */

typedef struct wt_accuracy_job {
    const char *part; /* name of one numerical part; NULL (default): all */
    size_t repeats;   /* how often each point is timed; default 9 */
    bool built_in;    /* of a case: these problems after its own numbers; default false */
} wt_accuracy_job;
WT_API wt_accuracy_job wt_accuracy_job_defaults(void);
WT_API const wt_params *wt_accuracy_job_params(void);
/* Table "work_precision": the error of every numerical part on a problem whose answer is known
 * otherwise, and its processor time on one thread, as its setting is swept; beside it the textbook
 * method. WT_E_NOT_FOUND for a part that is none. */
WT_API wt_status wt_accuracy_make(const wt_accuracy_job *job, const wt_job *work, wt_table **table,
                                  wt_error *err) WT_NODISCARD;
/* The same table of the numbers of a sliding contact at the reference velocity: friction and layer
 * as the tolerance is swept (against 1e-13; beside it the textbook method), their standard errors
 * as the number of replicates is, and the numbers with fewer isotherms. Times are NaN if the cost
 * of `work` has none. `layer` and `known` as above. */
WT_API wt_status wt_case_precision_make(const wt_sliding *sliding, const wt_layer_job *layer,
                                        const wt_layer_observation *known,
                                        const wt_accuracy_job *job, const wt_job *work,
                                        wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- case ------------------------------------------------------------------------------------ */

typedef struct wt_case wt_case;
/* Reads and checks a case file (schema, then what a schema cannot say). Paths in it are relative to
 * it. */
WT_API wt_status wt_case_read(const char *path, wt_case **out, wt_error *err) WT_NODISCARD;
WT_API void wt_case_free(wt_case *c);
/* From now on the case asks for these tables (their names in a result, parted by blanks) and
 * nothing else. */
WT_API wt_status wt_case_request(wt_case *c, const char *tables, wt_error *err) WT_NODISCARD;
/* Records (files, folders or patterns, relative to the current folder) instead of those of the
 * case; and of the validation what is in `given`, as wt_params_set sets it for `job`. */
WT_API wt_status wt_case_validate(wt_case *c, const char *const *records, size_t n,
                                  const wt_validation_job *job, uint64_t given,
                                  wt_error *err) WT_NODISCARD;
WT_API const char *wt_case_schema(void);            /* XSD text; static */
WT_API const char *wt_case_title(const wt_case *c); /* "" if none; borrowed */
/* How it has the report drawn: style, figures, width, font and language are those it asks
 * for, or the defaults. Borrowed. */
WT_API const wt_report_options *wt_case_report(const wt_case *c);

/* ---- plan and run ---------------------------------------------------------------------------- */

typedef struct wt_run_options {
    const char *formats; /* folder of further descriptions, NULL = none */
    double tolerance;    /* relative numerical error asked for; default 1e-10 */
    unsigned threads;    /* 0 = one per processor */
    uint64_t seed;       /* of the draws */
    size_t replicates;   /* of the draws; default 200 */
    wt_progress progress;
    size_t trials;              /* of the table "coverage"; default 100 */
    wt_accuracy_job precision;  /* of the table "work_precision" */
    bool no_provenance;         /* no times in "cost", no digests in "inputs" */
    const char *const *columns; /* of plain tables, as wt_formats_add_columns takes them */
    size_t n_columns;
} wt_run_options;
WT_API wt_run_options wt_run_defaults(void);
WT_API const wt_params *wt_run_params(void);

/* The plan as a table: stage, title, runs (1 or 0), because (words), needs, gives. Reads no data
 * file. */
WT_API wt_status wt_plan(const wt_case *c, wt_table **plan, wt_error *err) WT_NODISCARD;
/* Runs what the plan says. Stages left out leave no tables; the table "cost" lists every stage.
 * A file that fails in a batch does not stop the others: it is listed in the table "failures" and
 * *n_failed counts it; so is a stage that fails, and the stages that need it are left out. With no
 * table of what was asked for the result is one nevertheless, and says WT_ANSWERED_NOTHING. */
WT_API wt_status wt_run(const wt_case *c, const wt_run_options *options, wt_log *log,
                        wt_result **result, size_t *n_failed, wt_error *err) WT_NODISCARD;
/* Whether `result`, read from its file, is what the case would give again by `command` (as
 * wt_provenance_command tells it): *current is false, and `why` says what differs first, if
 * version, command line, case or a file that was read is another, a file is new or gone, or it was
 * answered in part. What nothing asked for is not looked at, descriptions of --formats are not
 * either. */
WT_API wt_status wt_run_is_current(const wt_case *c, const wt_result *result, const char *command,
                                   bool *current, char *why, size_t size,
                                   wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
