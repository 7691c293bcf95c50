/* Names of tables, columns and keys in results of the command. No other file of the study states
 * them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_PLACES_H
#define STUDY_PLACES_H

#include "facts.h"
#include "stream.h"

/* A number with its standard error or the limits of its interval. `error`, `low` and `high` are
 * columns, attributes of the key, or separate keys; NULL if there are none. */
typedef struct place {
    const char *table;
    const char *value, *error, *low, *high;
} place;

extern const place place_shift, place_law, place_storage, place_loss;
extern const place place_hysteresis, place_area, place_friction;
extern const place place_c1, place_c2, place_equilibrium, place_thickness;
extern const place place_modulus, place_factor; /* of curves */
extern const place place_depth;                 /* of all curves, a row for each depth */
extern const place place_budget[2];             /* of bulk and track */
extern const place place_ratio;                 /* over all rates, the first row */
extern const place place_layered_friction;      /* at the reference velocity */

extern const place place_density; /* of a surface, a row for each bin */
extern const place place_hurst, place_roll_off, place_c0;
extern const place place_rms_height, place_rms_slope;
extern const place place_anisotropy, place_texture;

extern const place place_steady, place_running_in, place_running_in_time,
    place_drift;                    /* of a record, a row for a step */
extern const place place_wear_rate; /* a row for each method */

extern const place place_energy, place_energy_wear; /* of identification, a row for each method */
extern const place place_friction_ratio, place_needed_shear; /* of validation */

extern const place place_collected_ratio, place_collected_thickness, place_collected_change;
extern const place place_collected_modulus, place_collected_friction, place_pair;
#define PLACE_SAMPLE "sample" /* in the first five, with the condition: names the case */
#define PLACE_CONDITION "condition"
#define PLACE_ZONE "place" /* "bulk" or another */
#define PLACE_RATE "indentation_rate"
#define PLACE_PAIR_OF "of" /* the property that both share */
#define PLACE_PAIR_FIRST "first"
#define PLACE_PAIR_SECOND "second"
#define PLACE_PAIR_DIFFER "differ"
#define PLACE_PAUSED "paused_time"
#define PLACE_ROUGHNESS "roughness" /* quantity of a surface that friction uses */

extern const place place_settled_predicted, place_settled_measured,
    place_time_ratio; /* of a running-in */
#define PLACE_LAYER "track_layer"
#define PLACE_LAYER_LOW "thickness_low" /* [m]; absent without a lower limit */
#define PLACE_LAYER_HIGH "thickness_high"
#define PLACE_LAYER_BOTH_LOW "both_low"
#define PLACE_LAYER_BOTH_HIGH "both_high"
#define PLACE_LAYER_AGREE "agree"     /* begins with yes, no or inconclusive */
#define PLACE_LAYER_ALLOWED "allowed" /* begins with "none" if no thickness is allowed */
#define PLACE_NONE "none"
#define PLACE_VALIDATION "validation"
#define PLACE_VALIDATION_RUNNING_IN "validation_running_in"
#define PLACE_VALIDATION_VERDICT "verdict"  /* begins with yes, no or inconclusive */
#define PLACE_STEADY_CYCLES "steady_cycles" /* in `place_steady.table` */
#define PLACE_WAVENUMBER "wavenumber"       /* [rad/m], with the density */
#define PLACE_SOURCE "source"               /* with the density: source of the row */
#define PLACE_BY_LAW "law"
#define PLACE_CURVE "verdict" /* in `place_modulus.table`, of a curve: */
#define PLACE_ACCEPTED "accepted"
#define PLACE_DOUBTFUL "doubtful"
#define PLACE_WIDE "wide"
#define PLACE_POOLED_CHANCE "pooled_misfit_p" /* in `place_modulus.table` */
#define PLACE_DEPTH "modulus_depth"
#define PLACE_DEPTH_CHANGES "changes_bulk" /* begins with yes, no or inconclusive */
#define PLACE_DEPTH_MISFIT_CHANCE "misfit_p_bulk"
#define PLACE_TEMPERATURE "temperature"     /* [K], with shift and law */
#define PLACE_FREQUENCY "angular_frequency" /* [rad/s], with the moduli */
#define PLACE_VELOCITY "velocity"
#define PLACE_PRONY "prony"
#define PLACE_PRONY_TIME "relaxation_time"
#define PLACE_PRONY_MODULUS "modulus"

/* In `place_shift.table`. */
#define PLACE_INFLUENCES "influences"
#define PLACE_INFLUENCE_CHANGE "log_a_change"   /* [decade], of a row for each isotherm left out */
#define PLACE_INFLUENCE_OUTSIDE "outside"       /* shifts that leave their interval then */
#define PLACE_REFERENCE "reference_temperature" /* [K] */
#define PLACE_CORRELATION "wlf_correlation"
#define PLACE_LAW "law" /* name of the law; WLF without it */
#define PLACE_LAW_WLF "WLF"
#define PLACE_JOINT "joint" /* [K]; another law below it */
#define PLACE_VERDICT "superposition"
#define PLACE_FAILS "fail" /* first word of the verdict */
#define PLACE_HOLDS "holds"
#define PLACE_INCONCLUSIVE "inconclusive"
#define PLACE_UNTESTED "not tested"

/* In `place_ratio.table`. */
#define PLACE_DIFFERS "differs" /* the verdict, which begins with: */
#define PLACE_YES "yes"
#define PLACE_NO "no"
#define PLACE_MODULUS_RATIO "modulus_ratio" /* with its standard error, as input of friction */
#define PLACE_MODULUS_RATIO_DF "modulus_ratio_df"

/* Stated estimate; low and high are nan without an interval. */
typedef struct estimate {
    double value, low, high;
} estimate;

estimate place_row(const stream *s, const place *p, int row);
estimate place_key(const stream *s, const place *p);
/* Verdict of a validation on the measured friction: YES for "yes". */
verdict place_friction_verdict(const stream *found, const char *table);

#endif
