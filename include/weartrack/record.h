/* weartrack - record: friction records and wear tracks; predicted against measured friction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_RECORD_H
#define WEARTRACK_RECORD_H

#include "weartrack/layer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- friction records: cycles, running-in, steady friction ---------------------------------- */

/* Interval for averaging friction before its scatter is computed, so that variation within a lap or
 * stroke does not count as scatter. */
typedef enum wt_cycle_kind {
    WT_CYCLE_AUTO,   /* strokes, laps or time intervals, the first that the record allows */
    WT_CYCLE_STROKE, /* one double stroke */
    WT_CYCLE_LAP,    /* whole revolutions */
    WT_CYCLE_TIME,   /* equal time intervals */
    WT_CYCLE_SAMPLE  /* no averaging: each sample */
} wt_cycle_kind;

/* Means over one cycle; channels that were not recorded are NaN. */
typedef struct wt_cycle {
    size_t first, n, step;
    double time, distance, laps; /* at its middle */
    double coefficient;
    double zero;      /* for strokes: mean of both directions, signed, as a coefficient */
    double deviation; /* standard deviation of its samples */
    double normal_force, velocity, pressure, temperature, wear_depth;
    double rotation; /* of the disc [rad/s] */
    double duration; /* to the first sample of the next one [s] */
} wt_cycle;

typedef struct wt_cycles {
    wt_cycle_kind kind;
    size_t n;
    wt_cycle *cycle;
    double *friction;  /* [samples of the record] signed coefficient */
    double samples;    /* median number of samples in a cycle */
    double difference; /* largest difference of mu and friction force over load, if the file has
                          both; NaN */
    bool has_zero;     /* the two directions have opposite signs */
    size_t n_unloaded; /* samples without a coefficient because the load is not positive */
} wt_cycles;
/* Splits a record into cycles. The track `radius` [m] converts distance to laps and rotation to
 * velocity; NaN: unknown. `load` [N] is used if none was recorded; NaN: unknown. WT_E_MISSING if
 * the record does not allow a `kind` other than WT_CYCLE_AUTO, and for a torque that
 * wt_record_torque_to_force has not converted. */
WT_API wt_status wt_cycles_compute(const wt_record *record, wt_cycle_kind kind, double radius,
                                   double load, wt_cycles *cycles, wt_error *err) WT_NODISCARD;
WT_API void wt_cycles_clear(wt_cycles *cycles);

/* End of the running-in of a series: a line with its own scatter, then a constant with another.
 * Both scatters are white plus an autoregression of first order. The likelihood is averaged over
 * its length and share, and over the end. */
typedef struct wt_running_in {
    bool is_detected; /* odds above 20 to 1 against a series without running-in */
    wt_interval end;  /* number of points before the steady state: median and 95 % interval; NaN */
    size_t steady_start; /* first point of the steady state, after the interval; 0: all */
    const char *reason;  /* "" or the reason why there is no end; static */
} wt_running_in;
WT_API wt_running_in wt_running_in_find(const double *y, size_t n);

/* Mean and drift of a steady-state series with correlated scatter. The 95 % intervals are averaged
 * over the uncertainty of the correlation; the mean also over models with and without drift. */
typedef struct wt_steady {
    size_t n;
    wt_interval mean;
    wt_interval drift;          /* per point */
    double deviation, min, max; /* of the points */
    double correlation;         /* variance of the mean over that of as many independent points */
    const char *note;           /* "" or a remark; static */
} wt_steady;
WT_API wt_status wt_steady_mean(const double *y, size_t n, wt_steady *steady,
                                wt_error *err) WT_NODISCARD;

/* ---- wear tracks ---------------------------------------------------------------------------- */

/* A wear track in a profile across it: heights relative to a line through the outer quarters. */
typedef struct wt_track {
    bool found; /* two adjacent samples are deeper than 3 standard deviations of the outer quarters
                 */
    double slope, intercept, scatter; /* of the line; standard deviation about it */
    double depth, at, from, to; /* depth and position of the deepest point; limits of the track */
    wt_estimate area; /* area below the line within the limits; error from the line's scatter */
    double ridges;    /* area above the line within the limits */
} wt_track;
/* Finds the track. Positions x increasing and heights z, both [m]. WT_E_RANGE for fewer than 40
 * points. */
WT_API wt_status wt_track_find(const double *x, const double *z, size_t n, wt_track *track,
                               wt_error *err) WT_NODISCARD;

/* ---- a ball on a rubber --------------------------------------------------------------------- */

/* Hertz contact of a rigid ball on a rubber that is thick compared with a: a^3 = 3 F R (1 - nu^2) /
 * (4 E). */
typedef struct wt_ball_contact {
    double contact_radius; /* a [m] */
    double pressure;       /* nominal pressure F / (pi a^2) [Pa] */
} wt_ball_contact;
WT_API wt_ball_contact wt_ball_contact_compute(double load, double radius, double modulus,
                                               double poisson_ratio);
/* Returns the load [N] for a nominal pressure [Pa]. */
WT_API double wt_ball_load(double pressure, double radius, double modulus, double poisson_ratio);
/* Returns the duty of a point on a circular track at the distance `aside` from the centre line: its
 * load in one turn relative to constant nominal pressure. Along the line through the point, Hertz's
 * pressure gives (3 a / 8 r) (1 - (aside/a)^2), 0 outside of the track; the mean over the track is
 * a / 4 r. */
WT_API double wt_ball_duty(double contact_radius, double track_radius, double aside);

/* ---- records -------------------------------------------------------------------------------- */

/* Rule for the end of the running-in. */
typedef enum wt_running_in_rule {
    WT_RUNNING_IN_LIKELIHOOD, /* wt_running_in_find */
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
/* WT_E_EMPTY if no file has a record. */
WT_API wt_status wt_record_compute(const wt_record_job *job, const wt_job *work,
                                   wt_record_tables *tables, wt_error *err) WT_NODISCARD;

/* ---- validation ----------------------------------------------------------------------------- */

typedef struct wt_validation_job {
    const wt_sliding *sliding;
    const wt_layer_job *layer;                     /* NULL as in wt_model_sensitivity_compute */
    const wt_layer_observation *layer_observation; /* NULL as in wt_model_sensitivity_compute; its
                                          thickness is the one used for the layer */
    const wt_table *record;                        /* table "record" */
    const wt_table *cycles; /* table "record_cycles", for the running-in only */
    const wt_table *wear;   /* table "wear", or NULL */
    double margin;          /* irrelevant deviation of measured over predicted; default 0.2 */
    bool wanted;            /* in a case: validates its records; default true */
} wt_validation_job;
WT_API wt_validation_job
wt_validation_job_defaults(void); /* Sets the margin and the following members. */
WT_API const wt_params *wt_validation_job_params(void);

typedef struct wt_validation_tables {
    wt_table *validation, *sources;
} wt_validation_tables;

/* Compares measured with predicted friction at every step of the records, with both errors: the
 * verdict "yes", "no" or "inconclusive" by the test in the key `test`; the shear stress
 * that the record requires; the error sources. */
WT_API wt_status wt_validation_compute(const wt_validation_job *job, const wt_job *work,
                                       wt_validation_tables *tables, wt_error *err) WT_NODISCARD;

typedef struct wt_running_in_tables {
    wt_table *running_in, *running_in_curve; /* "validation_running_in", "validation_course" */
} wt_running_in_tables;

/* Sets the running-in of the first step of every record beside that predicted for the growing layer
 * of `layer` and `layer_observation` (not NULL): time to the steady state, measured, predicted and
 * as a ratio; change of friction; and friction in time, with errors. */
WT_API wt_status wt_running_in_validation_compute(const wt_validation_job *job, const wt_job *work,
                                                  wt_running_in_tables *tables,
                                                  wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
