/* The files of a job: listing, opening with provenance, recording what failed. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_INPUTS_H
#define WEARTRACK_FLOW_INPUTS_H

#include "kernel/params.h"
#include "weartrack/flow.h"

/* The records that a run has too. */
#define JOB_ROWS(type)                                                                             \
    FRICTION_TOLERANCE(type),                                                                      \
        {PARAM("replicates", type, replicates, WT_Q_NONE, FROM_TO(0, 100000)), .value = "N",       \
         .flags = PARAM_NO_CASE, .help = "draws behind the standard errors; 0 for none"},          \
        {PARAM("seed", type, seed, WT_Q_NONE, AT_LEAST(0)), .value = "N", .flags = PARAM_NO_CASE,  \
         .help = "seed of the draws behind the standard errors"},                                  \
        PARAM_THREADS(type)

/* The record of what compares groups of curves, and of what compares materials. */
#define EQUIVALENCE_MARGIN(type)                                                                   \
    {                                                                                              \
        PARAM("equivalence-margin", type, margin, WT_Q_NONE, ABOVE(0)),                            \
            .value = "X",                                                                          \
            .help = "relative difference of the moduli that does not matter: \"no difference\" "   \
                    "is said "                                                                     \
                    "only if the whole interval lies within it"                                    \
    }

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

/* All files of the sets in their order. A file that is named twice is taken once, with a warning. A
 * pattern without a match is recorded as a failure (or ends the job, see wt_job.failures). */
wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                          flow_files *files, wt_error *err) WT_NODISCARD;
void flow_files_clear(flow_files *files);

/* Opens a file, finds its format among `kinds` and adds it to the provenance under `role`. */
wt_status flow_open(const wt_job *work, flow_file *file, const char *role, unsigned kinds,
                    wt_input **input, wt_error *err) WT_NODISCARD;

/* How a file is read: by the options of its set, as the format that was found, if any.
 */
wt_read_options flow_read_options(const flow_file *file);

/* For an error of files none of which held what is needed: how many, and where to look. */
void flow_tell_files(const flow_files *files, size_t n_failed, wt_error *err);

/* All isotherms and temperature sweeps of the files, sorted, without copies, of the sample that the
 * first set names; cleared by the caller, also on failure. */
wt_status flow_sweeps_read(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                           wt_sweep *sweep, wt_error *err) WT_NODISCARD;
/* The samples of isotherms and temperature sweeps; `samples` is empty, and to be cleared. */
wt_status flow_samples_find(const wt_sweep *sweep, wt_samples *samples, wt_error *err) WT_NODISCARD;
/* Takes out the sweeps of other samples than `name`, unless NULL or "all". WT_E_NOT_FOUND if there
 * are no others. */
wt_status flow_sample_take(wt_sweep *sweep, const char *name, wt_error *err) WT_NODISCARD;
/* Isotherms and temperature sweeps of several samples are WT_E_AMBIGUOUS unless the first set says
 * which. */
wt_status flow_one_sample(const wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                          wt_parselog *log, wt_error *err) WT_NODISCARD;
/* Of isotherms and temperature sweeps of several strain amplitudes at one temperature and frequency
 * keeps those nearest to the one that the first set names; without one they are WT_E_AMBIGUOUS. */
wt_status flow_one_amplitude(wt_sweep *sweep, const wt_file_set *sets, size_t n_sets,
                             wt_parselog *log, wt_error *err) WT_NODISCARD;
/* Whether a file that gave `failure` is one that merely lies in the folder that was named, without
 * measured data of the kind asked for: it is left out with a warning. Else it has failed. */
bool flow_leave_out(const wt_job *work, const flow_file *file, const wt_error *failure);

/* A law in one word: "self-affine:q0=1e3rad/m,...". */
typedef struct flow_law_text {
    const char *prefix, *name; /* "self-affine:", "self-affine law" */
    const char *what;          /* it is a law of: "roughness" */
    const char *example;       /* after the prefix */
    const wt_params *(*params)(void);
} flow_law_text;
/* Whether the text begins with the prefix. */
bool flow_is_law(const flow_law_text *law, const char *text);
/* Sets the parameters that are there; all required ones must be. */
wt_status flow_law_parse(const flow_law_text *law, const char *text, void *structure,
                         wt_error *err) WT_NODISCARD;

wt_surface flow_surface_defaults(void); /* nothing is given */
/* The parameters of a self-affine law, and of a measured spectrum, in a wt_surface. */
const wt_params *flow_self_affine_params(void);
const wt_params *flow_spectrum_params(void);
/* Says to the cost how much it is of: the points of a spectrum, or the constants of a law. */
void flow_surface_cost(const wt_surface *surface, const wt_job *work);
/* Whether they make a law; a roll-off that is not given is q0. */
wt_status flow_surface_check(wt_surface *surface, wt_error *err) WT_NODISCARD;
/* A measured spectrum as a surface, uncut; the densities are not checked. */
wt_status flow_surface_read(flow_file *file, const wt_job *work, wt_surface *surface,
                            wt_error *err) WT_NODISCARD;

void flow_rubber_drop_draws(wt_rubber *rubber);
/* Whether the shift law takes the material to a temperature (NaN: the reference); if not, why. */
bool flow_rubber_reaches(const wt_rubber *rubber, double temperature, wt_error *why);
/* Isotherms fitted, and the rubber that comes of it, with draws unless they are left out. Both
 * cleared by the caller, also on failure. */
wt_status flow_rubber_fit(const wt_sweep *sweep, const wt_master_options *options,
                          double poisson_ratio, const wt_job *work, wt_master *fit,
                          wt_rubber *rubber, wt_error *err) WT_NODISCARD;
/* The parameters of a fractional Zener material, and those as a rubber, whose law is checked. */
wt_zener flow_zener_defaults(void);
const wt_params *flow_zener_params(void);
wt_status flow_rubber_zener(const wt_zener *zener, double poisson_ratio, wt_rubber *rubber,
                            wt_error *err) WT_NODISCARD;
/* A table of moduli as a rubber; its points are checked. */
wt_status flow_rubber_read(flow_file *file, const wt_rubber_options *options, double poisson_ratio,
                           const wt_job *work, wt_rubber *rubber, wt_error *err) WT_NODISCARD;

/* Whether a failure of one file leaves the others alone: false for lack of memory, cancelling,
 * internal errors, and when the job keeps no failures. */
bool flow_goes_on(const wt_job *work, wt_status status);
/* Adds a row to the failures. */
wt_status flow_add_failure(const wt_job *work, const char *what, const wt_error *failure,
                           wt_error *err) WT_NODISCARD;

#endif
