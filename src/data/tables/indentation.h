/* The columns and keys of the tables of indentation. Included by tables.h alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_INDENTATION_H
#define WT_DATA_TABLES_INDENTATION_H

/* A table written by hand needs the verdicts and the moduli only. */
#define INDENTATION_COLUMNS(X)                                                                     \
    X(INDENTATION_FILE, "file", "file of the curve", TEXT, SHOWS(file), LABEL("File"), OPTIONAL)   \
    X(INDENTATION_CURVE, "curve", "number of the curve in its file", NUMBER, SHOWS(curve),         \
      LABEL("Curve"), OPTIONAL)                                                                    \
    X(INDENTATION_SPOT, "spot", "place on the sample; curves of one spot are not independent",     \
      TEXT, SHOWS(spot), LABEL("Spot"), OPTIONAL)                                                  \
    X(INDENTATION_X, "x", "lateral position x", SI(POSITION_X), SHOWS(x), OPTIONAL)                \
    X(INDENTATION_Y, "y", "lateral position y", SI(POSITION_Y), SHOWS(y), OPTIONAL)                \
    X(INDENTATION_VERDICT, "verdict", "accepted, or why not", TEXT, SHOWS(verdict))                \
    X(INDENTATION_REASON, "reason", "the verdict with its numbers", TEXT, SHOWS(fit.reason),       \
      LABEL("Reason"), OPTIONAL)                                                                   \
    X(INDENTATION_MODULUS, "modulus", "Young's modulus", SI(MODULUS),                              \
      STANDARD_ERROR(INDENTATION_MODULUS), SHOWS(fit.modulus))                                     \
    X(INDENTATION_MODULUS_STANDARD_ERROR, "modulus_standard_error",                                \
      "standard error of the modulus", SI(MODULUS), OPTIONAL)                                      \
    X(INDENTATION_CONTACT_POINT, "contact_point", "tip position at contact", SI(LENGTH),           \
      STANDARD_ERROR(INDENTATION_CONTACT_POINT), SHOWS(fit.contact_point), OPTIONAL)               \
    X(INDENTATION_CONTACT_POINT_STANDARD_ERROR, "contact_point_standard_error",                    \
      "standard error of the contact point", SI(LENGTH), OPTIONAL)                                 \
    X(INDENTATION_CONTACT_THRESHOLD, "contact_threshold",                                          \
      "contact by the threshold of the baseline, less contact_point", SI(LENGTH),                  \
      SHOWS(fit.contact_by[WT_CONTACT_THRESHOLD]), OPTIONAL)                                       \
    X(INDENTATION_CONTACT_VARIANCES, "contact_variances",                                          \
      "contact by the ratio of variances, less contact_point", SI(LENGTH),                         \
      SHOWS(fit.contact_by[WT_CONTACT_VARIANCES]), OPTIONAL)                                       \
    X(INDENTATION_CONTACT_LINES, "contact_lines",                                                  \
      "contact by the meeting of two lines, less contact_point", SI(LENGTH),                       \
      SHOWS(fit.contact_by[WT_CONTACT_LINES]), OPTIONAL)                                           \
    X(INDENTATION_CONTACT_DIRECT_PATH, "contact_direct_path",                                      \
      "contact by the distance from the direct path, less contact_point", SI(LENGTH),              \
      SHOWS(fit.contact_by[WT_CONTACT_DIRECT_PATH]), OPTIONAL)                                     \
    X(INDENTATION_CONTACT_GOODNESS_OF_FIT, "contact_goodness_of_fit",                              \
      "contact by the goodness of fit, less contact_point", SI(LENGTH),                            \
      SHOWS(fit.contact_by[WT_CONTACT_GOODNESS_OF_FIT]), OPTIONAL)                                 \
    X(INDENTATION_BASELINE_OFFSET, "baseline_offset", "force of the baseline at contact",          \
      SI(FORCE), SHOWS(fit.baseline_offset), OPTIONAL)                                             \
    X(INDENTATION_BASELINE_TILT, "baseline_tilt", "slope of the baseline", UNIT("N/m"),            \
      SHOWS(fit.baseline_tilt), OPTIONAL)                                                          \
    X(INDENTATION_NOISE, "noise", "standard deviation of the baseline residual", SI(FORCE),        \
      OPTIONAL, SHOWS(fit.noise))                                                                  \
    X(INDENTATION_LACK_OF_FIT, "lack_of_fit",                                                      \
      "slow residual in contact over what the noise of the baseline explains", NUMBER,             \
      SHOWS(fit.lack_of_fit), OPTIONAL)                                                            \
    X(INDENTATION_LACK_OF_FIT_CHANCE, "lack_of_fit_chance", "chance of more by noise alone",       \
      NUMBER, SHOWS(fit.lack_of_fit_chance), OPTIONAL)                                             \
    X(INDENTATION_BASELINE_CHANCE, "baseline_chance",                                              \
      "chance that a straight baseline departs as much from a line", NUMBER,                       \
      SHOWS(fit.baseline_chance), OPTIONAL)                                                        \
    X(INDENTATION_BEND_SHIFT, "bend_shift",                                                        \
      "what the bend of the baseline adds to the modulus if it goes on in contact; 0: straight",   \
      SI(MODULUS), SHOWS(fit.bend_shift), OPTIONAL)                                                \
    X(INDENTATION_INTERFERENCE_AMPLITUDE, "interference_amplitude",                                \
      "amplitude of a sine that the baseline shows, fitted with the modulus; 0: none", SI(FORCE),  \
      OPTIONAL, SHOWS(fit.interference_amplitude))                                                 \
    X(INDENTATION_INTERFERENCE_PERIOD, "interference_period", "its period", SI(LENGTH),            \
      SHOWS(fit.interference_period), OPTIONAL)                                                    \
    X(INDENTATION_MAX_FORCE, "max_force", "largest force above the baseline", SI(FORCE),           \
      SHOWS(fit.max_force), OPTIONAL)                                                              \
    X(INDENTATION_MAX_INDENTATION, "max_indentation", "largest indentation in the fit",            \
      SI(INDENTATION), SHOWS(fit.max_indentation), OPTIONAL)                                       \
    X(INDENTATION_FITTED_FROM, "fitted_from",                                                      \
      "indentation at which the range of the fit begins; 0: at contact", SI(INDENTATION),          \
      OPTIONAL, SHOWS(fit.fitted_from))                                                            \
    X(INDENTATION_ADHESION_FORCE, "adhesion_force", "largest pull before contact", SI(FORCE),      \
      OPTIONAL, SHOWS(fit.adhesion_force))                                                         \
    X(INDENTATION_WORK_OF_ADHESION, "work_of_adhesion", "work of adhesion of the approach",        \
      UNIT("J/m^2"), SHOWS(fit.work_of_adhesion), STANDARD_ERROR(INDENTATION_WORK_OF_ADHESION),    \
      OPTIONAL)                                                                                    \
    X(INDENTATION_WORK_OF_ADHESION_STANDARD_ERROR, "work_of_adhesion_standard_error",              \
      "standard error of the work of adhesion", UNIT("J/m^2"), OPTIONAL)                           \
    X(INDENTATION_PULL_OFF_FORCE, "pull_off_force", "largest pull of the retract", SI(FORCE),      \
      OPTIONAL, SHOWS(fit.pull_off_force))                                                         \
    X(INDENTATION_PULL_OFF_WORK, "pull_off_work",                                                  \
      "work of adhesion of the retract, an upper bound", UNIT("J/m^2"), SHOWS(fit.pull_off_work),  \
      OPTIONAL)                                                                                    \
    X(INDENTATION_TABOR_NUMBER, "tabor_number",                                                    \
      "Tabor number: above 5 the adhesion is that of the fit", NUMBER, SHOWS(fit.tabor_number),    \
      OPTIONAL)                                                                                    \
    X(INDENTATION_LOSS, "loss", "share of the work that the retract does not give back", NUMBER,   \
      OPTIONAL, SHOWS(fit.loss))                                                                   \
    X(INDENTATION_LOSS_BIAS, "loss_bias",                                                          \
      "what a fit without memory has more than |E*| at 1/load_time, of the modulus", NUMBER,       \
      OPTIONAL, SHOWS(fit.loss_bias))                                                              \
    X(INDENTATION_PIEZO_RATE, "piezo_rate", "rate of the piezo", SI(VELOCITY),                     \
      SHOWS(fit.piezo_rate), OPTIONAL)                                                             \
    X(INDENTATION_RATE, "indentation_rate", "mean rate of indentation", SI(VELOCITY),              \
      SHOWS(fit.indentation_rate), OPTIONAL)                                                       \
    X(INDENTATION_LOAD_TIME, "load_time", "time from contact to the end of what is fitted",        \
      SI(TIME), SHOWS(fit.load_time), OPTIONAL)                                                    \
    X(INDENTATION_SECOND_MINIMUM_RATIO, "second_minimum_ratio",                                    \
      "misfit of the second best contact point over the best; nan if there is no second", NUMBER,  \
      OPTIONAL, SHOWS(fit.second_minimum_ratio))                                                   \
    X(INDENTATION_SENSITIVITY_GAIN, "sensitivity_gain",                                            \
      "relative error of the modulus per relative error of sensitivity", NUMBER,                   \
      SHOWS(fit.sensitivity_gain), OPTIONAL)                                                       \
    X(INDENTATION_EQUIVALENT_FREQUENCY, "equivalent_frequency",                                    \
      "angular frequency of equal loading", SI(ANGULAR_FREQUENCY), SHOWS(equivalent_frequency),    \
      OPTIONAL)                                                                                    \
    X(INDENTATION_SPECTRUM_FACTOR, "spectrum_factor",                                              \
      "factor on the spectrum of the DMA: modulus over its |E*|", NUMBER,                          \
      STANDARD_ERROR(INDENTATION_SPECTRUM_FACTOR), SHOWS(fit.spectrum_factor), OPTIONAL)           \
    X(INDENTATION_SPECTRUM_FACTOR_STANDARD_ERROR, "spectrum_factor_standard_error",                \
      "standard error of the factor", NUMBER, OPTIONAL)

/* Where an error of theirs is stated: relative standard error of what all curves share, and what 1
 * of it does to ln E, with the standard error of that. In the order of wt_common_source. */
#define INDENTATION_COMMON_KEYS(X)                                                                 \
    X(INDENTATION_KEY_LEVER_ERROR, "spring_constant_error", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_SENSITIVITY_ERROR, "sensitivity_error", NUMBER, OPTIONAL)                    \
    X(INDENTATION_KEY_HALF_ANGLE_ERROR, "half_angle_error", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_RADIUS_ERROR, "radius_error", NUMBER, OPTIONAL)                              \
    X(INDENTATION_KEY_LEVER_GAIN, "spring_constant_gain", NUMBER, OPTIONAL)                        \
    X(INDENTATION_KEY_SENSITIVITY_GAIN, "sensitivity_gain", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_HALF_ANGLE_GAIN, "half_angle_gain", NUMBER, OPTIONAL)                        \
    X(INDENTATION_KEY_RADIUS_GAIN, "radius_gain", NUMBER, OPTIONAL)                                \
    X(INDENTATION_KEY_LOSS_ERROR, "loss_error", NUMBER, OPTIONAL)                                  \
    X(INDENTATION_KEY_BEND_ERROR, "bend_error", NUMBER, OPTIONAL)

#define INDENTATION_KEYS(X)                                                                        \
    X(INDENTATION_KEY_TIP, "tip", TEXT, OPTIONAL)                                                  \
    X(INDENTATION_KEY_POISSON_RATIO, "poisson_ratio", PLAIN, OPTIONAL)                             \
    X(INDENTATION_KEY_FIT_RANGE, "fit_range", TEXT, LABEL("Range of the fit"), OPTIONAL)           \
    X(INDENTATION_KEY_SPRING_CONSTANT, "spring_constant", SI(SPRING_CONSTANT), OPTIONAL)           \
    X(INDENTATION_KEY_SPRING_CONSTANTS, "spring_constants", TEXT, OPTIONAL)                        \
    X(INDENTATION_KEY_SENSITIVITY, "sensitivity", SI(SENSITIVITY), OPTIONAL)                       \
    INDENTATION_COMMON_KEYS(X)                                                                     \
    X(INDENTATION_KEY_SPOTS, "spots", TEXT, OPTIONAL)                                              \
    X(INDENTATION_KEY_SPECTRUM_TEMPERATURE, "spectrum_temperature", SI(TEMPERATURE),               \
      LABEL("Temperature of the spectrum"), OPTIONAL)                                              \
    X(INDENTATION_KEY_POOLED_MISFIT, "pooled_misfit", PLAIN,                                       \
      LABEL("Mean residual of all curves, of the largest force"), OPTIONAL)                        \
    X(INDENTATION_KEY_POOLED_MISFIT_CHANCE, "pooled_misfit_chance", PLAIN,                         \
      LABEL("Chance of more by scatter alone"), OPTIONAL)                                          \
    X(INDENTATION_KEY_N_ACCEPTED, "n_accepted", PLAIN, LABEL("Curves accepted"), OPTIONAL)         \
    X(INDENTATION_KEY_N_REJECTED, "n_rejected", PLAIN, LABEL("Curves rejected"), OPTIONAL)

#define FORCE_DISPLACEMENT_COLUMNS(X)                                                              \
    X(FORCE_DISPLACEMENT_GROUP, "group", "bulk or track", TEXT, SHOWS(group))                      \
    X(FORCE_DISPLACEMENT_SEGMENT, "segment", "approach or retract", TEXT, SHOWS(segment))          \
    X(FORCE_DISPLACEMENT_DISPLACEMENT, "displacement",                                             \
      "piezo displacement towards the sample, from the contact point", SI(LENGTH),                 \
      SHOWS(displacement))                                                                         \
    X(FORCE_DISPLACEMENT_FORCE, "force", "force above the baseline at contact", SI(FORCE),         \
      SHOWS(force))

/* One of each for every group. */
#define FORCE_DISPLACEMENT_KEYS(X)                                                                 \
    X(FORCE_DISPLACEMENT_KEY_CURVE, "curve_", TEXT, OPTIONAL)                                      \
    X(FORCE_DISPLACEMENT_KEY_CONTACT_POINT, "contact_point_", SI(LENGTH), OPTIONAL)                \
    X(FORCE_DISPLACEMENT_KEY_CONTACT_FORCE, "contact_force_", SI(FORCE), OPTIONAL)

#define FORCE_INDENTATION_COLUMNS(X)                                                               \
    X(FORCE_INDENTATION_GROUP, "group", "bulk or track", TEXT, SHOWS(group))                       \
    X(FORCE_INDENTATION_INDENTATION, "indentation", "indentation depth", SI(INDENTATION),          \
      SHOWS(indentation))                                                                          \
    X(FORCE_INDENTATION_FORCE, "force", "force above the baseline", SI(FORCE), SHOWS(force))       \
    X(FORCE_INDENTATION_FITTED_FORCE, "fitted_force", "force of the fitted contact model",         \
      SI(FORCE), SHOWS(fitted_force))
#define FORCE_INDENTATION_KEYS(X)

/* The rows of a group have the same numbers of curves and units. */
#define MODULUS_DEPTH_COLUMNS(X)                                                                   \
    X(MODULUS_DEPTH_GROUP, "group", "bulk or track", TEXT, SHOWS(group), LABEL("Group"))           \
    X(MODULUS_DEPTH_DEPTH, "depth", "indentation depth", SI(INDENTATION), SHOWS(depth),            \
      LABEL("Depth"))                                                                              \
    X(MODULUS_DEPTH_MODULUS, "modulus",                                                            \
      "modulus of a homogeneous rubber with the force at this depth, geometric mean", SI(MODULUS), \
      LABEL("Modulus at this depth"), SHOWS(modulus),                                              \
      INTERVAL(MODULUS_DEPTH_LOW, MODULUS_DEPTH_HIGH))                                             \
    INTERVAL_COLUMNS(X, MODULUS_DEPTH, "", SI(MODULUS))                                            \
    X(MODULUS_DEPTH_N, "n", "number of curves", NUMBER, SHOWS(n), LABEL("Curves"))                 \
    X(MODULUS_DEPTH_UNITS, "n_units", "spots, or curves where fewer than three spots are", NUMBER, \
      LABEL("Units"), SHOWS(n_units))
/* One of each for every group. */
#define MODULUS_DEPTH_KEYS(X)                                                                      \
    X(MODULUS_DEPTH_KEY_CHANGES, "changes_", TEXT, SHOWS(changes), OPTIONAL)                       \
    X(MODULUS_DEPTH_KEY_READING, "reading_", TEXT, SHOWS(reading), OPTIONAL)                       \
    X(MODULUS_DEPTH_KEY_RATIO, "ratio_", PLAIN, SHOWS(ratio), OPTIONAL)                            \
    X(MODULUS_DEPTH_KEY_CHANCE, "chance_", PLAIN, SHOWS(chance), PRECISION(3), OPTIONAL)           \
    X(MODULUS_DEPTH_KEY_MISFIT_CHANCE, "misfit_chance_", PLAIN, SHOWS(misfit_chance),              \
      PRECISION(3), OPTIONAL)

#endif
