/* Columns and keys of the tables of the indentation. Only core/table/registry.h includes this
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_TABLES_H
#define WT_INDENTATION_TABLES_H

/* The number of cosines is WT_MISFIT_TERMS. */
#define MISFIT_WAVE(X, n)                                                                          \
    X(INDENTATION_MISFIT_WAVE_##n, "misfit_wave_" #n,                                              \
      "cosine " #n " of the residual over the contact, relative to the largest force", NUMBER,     \
      SHOWS(deep.misfit[n - 1]), OPTIONAL)

#define SPOT_NAMINGS(X)                                                                            \
    X(SPOTS_NAMED, "named")                                                                        \
    X(SPOTS_MIXED, "mixed") /* some are named, each of the other files is one */                   \
    X(SPOTS_OF_FILES, "file")

/* A table written by hand needs verdicts and moduli only. */
#define INDENTATION_COLUMNS(X)                                                                     \
    X(INDENTATION_FILE, AS(file), "file of the curve", TEXT, LABEL("File"), OPTIONAL)              \
    X(INDENTATION_CURVE, AS(curve), "number of the curve in its file", NUMBER, LABEL("Curve"),     \
      OPTIONAL)                                                                                    \
    X(INDENTATION_SPOT, AS(spot), "place on the sample; curves of one spot are not independent",   \
      TEXT, LABEL("Spot"), OPTIONAL)                                                               \
    X(INDENTATION_X, AS(x), "lateral position x", SI(POSITION_X), OPTIONAL)                        \
    X(INDENTATION_Y, AS(y), "lateral position y", SI(POSITION_Y), OPTIONAL)                        \
    X(INDENTATION_VERDICT, AS(verdict), "accepted, wide, doubtful, or why there is no modulus",    \
      ENUM(curve_verdict))                                                                         \
    X(INDENTATION_REASON, IN(fit, reason), "the verdict with its numbers", TEXT, LABEL("Reason"),  \
      OPTIONAL)                                                                                    \
    X(INDENTATION_MODULUS, IN(fit, modulus), "Young's modulus", SI(MODULUS),                       \
      STANDARD_ERROR(INDENTATION_MODULUS))                                                         \
    X(INDENTATION_MODULUS_STANDARD_ERROR, "modulus_standard_error",                                \
      "standard error of the modulus, with that of a misfit", SI(MODULUS), OPTIONAL)               \
    X(INDENTATION_MODULUS_MISFIT_ERROR, "modulus_misfit_error",                                    \
      "what the contact law misses, in the standard error of the modulus", SI(MODULUS),            \
      SHOWS(fit.misfit_error), OPTIONAL)                                                           \
    X(INDENTATION_CONTACT_POINT, IN(fit, contact_point), "tip position at contact", SI(LENGTH),    \
      STANDARD_ERROR(INDENTATION_CONTACT_POINT), OPTIONAL)                                         \
    X(INDENTATION_CONTACT_POINT_STANDARD_ERROR, "contact_point_standard_error",                    \
      "standard error of the contact point", SI(LENGTH), OPTIONAL)                                 \
    X(INDENTATION_CONTACT_POINT_MISFIT_ERROR, "contact_point_misfit_error",                        \
      "what the contact law misses, in that of the contact point", SI(LENGTH),                     \
      SHOWS(fit.contact_misfit_error), OPTIONAL)                                                   \
    X(INDENTATION_BASELINE_OFFSET, IN(fit, baseline_offset), "force of the baseline at contact",   \
      SI(FORCE), OPTIONAL)                                                                         \
    X(INDENTATION_BASELINE_TILT, IN(fit, baseline_tilt), "slope of the baseline", UNIT("N/m"),     \
      OPTIONAL)                                                                                    \
    X(INDENTATION_NOISE, IN(fit, noise), "standard deviation of the baseline residual", SI(FORCE), \
      OPTIONAL)                                                                                    \
    X(INDENTATION_LACK_OF_FIT, IN(fit, lack_of_fit),                                               \
      "slow residual in contact over what the noise of the baseline explains", NUMBER, OPTIONAL)   \
    X(INDENTATION_LACK_OF_FIT_CHANCE, IN(fit, lack_of_fit_p), "chance of more by noise alone",     \
      NUMBER, OPTIONAL)                                                                            \
    X(INDENTATION_BASELINE_CHANCE, IN(fit, baseline_p),                                            \
      "chance that a straight baseline departs as much from a line", NUMBER, OPTIONAL)             \
    X(INDENTATION_BEND_SHIFT, "bend_shift",                                                        \
      "effect of the bend of the baseline on the modulus if it continues in contact; 0: "          \
      "straight",                                                                                  \
      SHOWS(fit.curvature_shift), SI(MODULUS), OPTIONAL)                                           \
    X(INDENTATION_INTERFERENCE_AMPLITUDE, IN(fit, interference_amplitude),                         \
      "amplitude of a sine that the baseline shows, fitted with the modulus; 0: none", SI(FORCE),  \
      OPTIONAL)                                                                                    \
    X(INDENTATION_INTERFERENCE_PERIOD, IN(fit, interference_period), "its period", SI(LENGTH),     \
      OPTIONAL)                                                                                    \
    X(INDENTATION_MAX_FORCE, IN(fit, max_force), "largest force above the baseline", SI(FORCE),    \
      OPTIONAL)                                                                                    \
    X(INDENTATION_MAX_INDENTATION, IN(fit, max_indentation), "largest indentation in the fit",     \
      SI(INDENTATION), OPTIONAL)                                                                   \
    X(INDENTATION_FITTED_FROM, IN(fit, fitted_from),                                               \
      "indentation at which the range of the fit begins; 0: at contact", SI(INDENTATION),          \
      OPTIONAL)                                                                                    \
    X(INDENTATION_ADHESION_FORCE, IN(fit, adhesion_force), "largest pull before contact",          \
      SI(FORCE), OPTIONAL)                                                                         \
    X(INDENTATION_WORK_OF_ADHESION, IN(fit, work_of_adhesion), "work of adhesion of the approach", \
      UNIT("J/m^2"), STANDARD_ERROR(INDENTATION_WORK_OF_ADHESION), OPTIONAL)                       \
    X(INDENTATION_WORK_OF_ADHESION_STANDARD_ERROR, "work_of_adhesion_standard_error",              \
      "standard error of the work of adhesion", UNIT("J/m^2"), OPTIONAL)                           \
    X(INDENTATION_CONTACT_PULL, "contact_pull",                                                    \
      "constant pull in contact, of adhesion of long range", SI(FORCE),                            \
      SHOWS(fit.contact_pull.value), OPTIONAL)                                                     \
    X(INDENTATION_PULL_OFF_FORCE, IN(fit, pull_off_force), "largest pull of the retract",          \
      SI(FORCE), OPTIONAL)                                                                         \
    X(INDENTATION_PULL_OFF_WORK, IN(fit, pull_off_work),                                           \
      "work of adhesion of the retract, an upper bound", UNIT("J/m^2"), OPTIONAL)                  \
    X(INDENTATION_RETRACT_MODULUS, IN(fit, retract_modulus),                                       \
      "Young's modulus of an elastic contact fitted to the retract alone", SI(MODULUS),            \
      STANDARD_ERROR(INDENTATION_RETRACT_MODULUS), OPTIONAL)                                       \
    X(INDENTATION_RETRACT_MODULUS_STANDARD_ERROR, "retract_modulus_standard_error",                \
      "standard error of it, with that of a misfit", SI(MODULUS), OPTIONAL)                        \
    X(INDENTATION_RETRACT_WORK, "retract_work_of_adhesion", "work of adhesion of that fit",        \
      UNIT("J/m^2"), SHOWS(fit.retract_work.value), OPTIONAL)                                      \
    X(INDENTATION_RETRACT_PULL, "retract_contact_pull", "constant pull in contact of that fit",    \
      SI(FORCE), SHOWS(fit.retract_pull.value), OPTIONAL)                                          \
    X(INDENTATION_TABOR_NUMBER, IN(fit, tabor_number),                                             \
      "Tabor number: above 5 the adhesion is that of the fit", NUMBER, OPTIONAL)                   \
    X(INDENTATION_LOSS, IN(fit, loss), "share of the work that the retract does not give back",    \
      NUMBER, OPTIONAL)                                                                            \
    X(INDENTATION_LOSS_BIAS, IN(fit, loss_bias),                                                   \
      "what a fit without memory has more than |E*| at 1/load_time, of the modulus", NUMBER,       \
      OPTIONAL)                                                                                    \
    X(INDENTATION_PIEZO_RATE, IN(fit, piezo_rate), "rate of the piezo", SI(VELOCITY), OPTIONAL)    \
    X(INDENTATION_RATE, IN(fit, indentation_rate), "mean rate of indentation", SI(VELOCITY),       \
      OPTIONAL)                                                                                    \
    X(INDENTATION_LOAD_TIME, IN(fit, load_time), "time from contact to the end of what is fitted", \
      SI(TIME), OPTIONAL)                                                                          \
    X(INDENTATION_SECOND_MINIMUM_RATIO, IN(fit, second_minimum_ratio),                             \
      "misfit of the second best contact point over the best; nan if there is no second", NUMBER,  \
      OPTIONAL)                                                                                    \
    X(INDENTATION_SENSITIVITY_GAIN, IN(fit, sensitivity_gain),                                     \
      "relative error of the modulus per relative error of sensitivity", NUMBER, OPTIONAL)         \
    X(INDENTATION_EQUIVALENT_FREQUENCY, AS(equivalent_frequency),                                  \
      "angular frequency of equal loading", SI(ANGULAR_FREQUENCY), OPTIONAL)                       \
    X(INDENTATION_SPECTRUM_FACTOR, IN(fit, spectrum_factor),                                       \
      "factor on the spectrum of the DMA: modulus over its |E*|", NUMBER,                          \
      STANDARD_ERROR(INDENTATION_SPECTRUM_FACTOR), OPTIONAL)                                       \
    X(INDENTATION_SPECTRUM_FACTOR_STANDARD_ERROR, "spectrum_factor_standard_error",                \
      "standard error of the factor", NUMBER, OPTIONAL)                                            \
    MISFIT_WAVE(X, 1)                                                                              \
    MISFIT_WAVE(X, 2)                                                                              \
    MISFIT_WAVE(X, 3)                                                                              \
    MISFIT_WAVE(X, 4)                                                                              \
    MISFIT_WAVE(X, 5)                                                                              \
    MISFIT_WAVE(X, 6)                                                                              \
    X(INDENTATION_MISFIT_LENGTH, "misfit_length", "travel of the piezo that the cosines are over", \
      SI(LENGTH), SHOWS(deep.window), OPTIONAL)                                                    \
    X(INDENTATION_BASELINE_LENGTH, "baseline_length", "travel of the piezo before contact",        \
      SI(LENGTH), SHOWS(deep.baseline), OPTIONAL)                                                  \
    X(INDENTATION_BASELINE_CURVATURE, "baseline_curvature",                                        \
      "factor of the square of the position in the baseline", UNIT("N/m^2"),                       \
      SHOWS(deep.curvature), OPTIONAL)                                                             \
    X(INDENTATION_LOSS_ERROR, "loss_error",                                                        \
      "relative error of the modulus by the assumed memory; nan: loss of unknown effect", NUMBER,  \
      SHOWS(deep.loss_error), OPTIONAL)

/* Mean relative changes of the moduli with other choices of the fit: the ranges in the order of
 * wt_indent_fit.range_shift, a contact law without loss, and one with a constant pull. */
#define INDENTATION_CHOICE_KEYS(X)                                                                 \
    X(INDENTATION_KEY_RANGE_SHIFT, "range_shift_shallow", NUMBER, OPTIONAL)                        \
    X(INDENTATION_KEY_RANGE_SHIFT_DEEP, "range_shift_deep", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_RANGE_SHIFT_MIDDLE, "range_shift_middle", NUMBER, OPTIONAL)                  \
    X(INDENTATION_KEY_LOSS_SHIFT, "loss_shift", NUMBER, OPTIONAL)                                  \
    X(INDENTATION_KEY_PULL_SHIFT, "pull_shift", NUMBER, OPTIONAL)

/* Keys of the systematic errors. They have the relative standard error of each source, stated or
 * else assumed, d ln E / d ln source and its standard error. The order is that of
 * wt_systematic_source. */
#define INDENTATION_COMMON_KEYS(X)                                                                 \
    X(INDENTATION_KEY_LEVER_ERROR, "spring_constant_error", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_SENSITIVITY_ERROR, "sensitivity_error", NUMBER, OPTIONAL)                    \
    X(INDENTATION_KEY_HALF_ANGLE_ERROR, "half_angle_error", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_RADIUS_ERROR, "radius_error", NUMBER, OPTIONAL)                              \
    X(INDENTATION_KEY_PIEZO_ERROR, "piezo_error", NUMBER, OPTIONAL)                                \
    X(INDENTATION_KEY_DETECTOR_ERROR, "detector_error", NUMBER, OPTIONAL)                          \
    X(INDENTATION_KEY_THICKNESS_ERROR, "sample_thickness_error", NUMBER, OPTIONAL)                 \
    X(INDENTATION_KEY_LEVER_ERROR_ASSUMED, "spring_constant_error_assumed", NUMBER, OPTIONAL)      \
    X(INDENTATION_KEY_SENSITIVITY_ERROR_ASSUMED, "sensitivity_error_assumed", NUMBER, OPTIONAL)    \
    X(INDENTATION_KEY_HALF_ANGLE_ERROR_ASSUMED, "half_angle_error_assumed", NUMBER, OPTIONAL)      \
    X(INDENTATION_KEY_RADIUS_ERROR_ASSUMED, "radius_error_assumed", NUMBER, OPTIONAL)              \
    X(INDENTATION_KEY_PIEZO_ERROR_ASSUMED, "piezo_error_assumed", NUMBER, OPTIONAL)                \
    X(INDENTATION_KEY_DETECTOR_ERROR_ASSUMED, "detector_error_assumed", NUMBER, OPTIONAL)          \
    X(INDENTATION_KEY_THICKNESS_ERROR_ASSUMED, "sample_thickness_error_assumed", NUMBER, OPTIONAL) \
    X(INDENTATION_KEY_LEVER_GAIN, "spring_constant_gain", NUMBER, OPTIONAL)                        \
    X(INDENTATION_KEY_SENSITIVITY_GAIN, "sensitivity_gain", NUMBER, OPTIONAL)                      \
    X(INDENTATION_KEY_HALF_ANGLE_GAIN, "half_angle_gain", NUMBER, OPTIONAL)                        \
    X(INDENTATION_KEY_RADIUS_GAIN, "radius_gain", NUMBER, OPTIONAL)                                \
    X(INDENTATION_KEY_PIEZO_GAIN, "piezo_gain", NUMBER, OPTIONAL)                                  \
    X(INDENTATION_KEY_DETECTOR_GAIN, "detector_gain", NUMBER, OPTIONAL)                            \
    X(INDENTATION_KEY_THICKNESS_GAIN, "sample_thickness_gain", NUMBER, OPTIONAL)                   \
    X(INDENTATION_KEY_LOSS_ERROR, "loss_error", NUMBER, OPTIONAL)                                  \
    X(INDENTATION_KEY_BEND_ERROR, "bend_error", NUMBER, OPTIONAL)                                  \
    X(INDENTATION_KEY_RANGE_ERROR, "range_error", NUMBER, OPTIONAL)                                \
    INDENTATION_CHOICE_KEYS(X)

/* Form of the tip as wt_tip_describe writes it. Several tips are described one after another. */
#define TIP_FORMS(X)                                                                               \
    X(TIP_BLUNTED_PYRAMID, "blunted pyramid")                                                      \
    X(SEVERAL_TIPS, "several")                                                                     \
    X(SEVERAL_BLUNTED_PYRAMIDS, "several: blunted pyramid")

/* In the order of wt_tip_shape. */
#define TIP_SHAPES(X)                                                                              \
    X(TIP_SHAPE_PYRAMID, "pyramid or cone with a cap")                                             \
    X(TIP_SHAPE_PARABOLOID, "paraboloid")                                                          \
    X(TIP_SHAPE_CONE, "cone")                                                                      \
    X(TIP_SHAPE_SPHERE, "sphere")                                                                  \
    X(TIP_SHAPE_PUNCH, "flat punch")

/* Dimensions of the tip, if the group has one tip; code reads these and not the description. */
#define INDENTATION_TIP_KEYS(X)                                                                    \
    X(INDENTATION_KEY_TIP_SHAPE, "tip_shape", ENUM(tip_shape), OPTIONAL)                           \
    X(INDENTATION_KEY_TIP_SIDES, "tip_sides", NUMBER, OPTIONAL)                                    \
    X(INDENTATION_KEY_TIP_HALF_ANGLE, "tip_half_angle", SI(ANGLE), OPTIONAL)                       \
    X(INDENTATION_KEY_TIP_RADIUS, "tip_radius", SI(LENGTH), OPTIONAL)                              \
    X(INDENTATION_KEY_TIP_TRANSITION, "tip_transition_radius", SI(LENGTH), OPTIONAL)               \
    X(INDENTATION_KEY_SAMPLE_THICKNESS, "sample_thickness", SI(LENGTH), OPTIONAL)

#define INDENTATION_KEYS(X)                                                                        \
    X(INDENTATION_KEY_TIP, "tip", ENUM(tip_form), OPTIONAL)                                        \
    INDENTATION_TIP_KEYS(X)                                                                        \
    X(INDENTATION_KEY_POISSON_RATIO, "poisson_ratio", PLAIN, OPTIONAL)                             \
    X(INDENTATION_KEY_FIT_RANGE, "fit_range", TEXT, LABEL("Range of the fit"), OPTIONAL)           \
    X(INDENTATION_KEY_SPRING_CONSTANT, "spring_constant", SI(SPRING_CONSTANT), OPTIONAL)           \
    X(INDENTATION_KEY_SPRING_CONSTANTS, "spring_constants", TEXT, OPTIONAL)                        \
    X(INDENTATION_KEY_SENSITIVITY, "sensitivity", SI(SENSITIVITY), OPTIONAL)                       \
    X(INDENTATION_KEY_SENSITIVITIES, "sensitivities", TEXT, OPTIONAL)                              \
    INDENTATION_COMMON_KEYS(X)                                                                     \
    X(INDENTATION_KEY_SPOTS, "spots", ENUM(spot_naming), OPTIONAL)                                 \
    X(INDENTATION_KEY_TEMPERATURE, "indentation_temperature", SI(TEMPERATURE),                     \
      LABEL("Temperature of the sample"), OPTIONAL)                                                \
    X(INDENTATION_KEY_SPECTRUM_TEMPERATURE, "spectrum_temperature", SI(TEMPERATURE),               \
      LABEL("Temperature of the spectrum"), OPTIONAL)                                              \
    X(INDENTATION_KEY_POOLED_MISFIT, "pooled_misfit", PLAIN,                                       \
      LABEL("Mean residual of all curves, of the largest force"), OPTIONAL)                        \
    X(INDENTATION_KEY_POOLED_MISFIT_CHANCE, "pooled_misfit_p", PLAIN,                              \
      LABEL("Chance of more by scatter alone"), OPTIONAL)                                          \
    X(INDENTATION_KEY_ASSUMED, "assumed_errors", TEXT, LABEL("Errors assumed, as none is stated"), \
      OPTIONAL)                                                                                    \
    X(INDENTATION_KEY_NOT_SHOWN, "not_shown", TEXT, LABEL("What no curve shows"), OPTIONAL)        \
    X(INDENTATION_KEY_N_USED, "n_used", PLAIN, LABEL("Curves used"), OPTIONAL)                     \
    X(INDENTATION_KEY_N_WIDE, "n_wide", PLAIN, LABEL("Of them with a wide interval"), OPTIONAL)    \
    X(INDENTATION_KEY_N_DOUBTFUL, "n_doubtful", PLAIN, LABEL("Of them doubtful"), OPTIONAL)        \
    X(INDENTATION_KEY_N_REJECTED, "n_rejected", PLAIN, LABEL("Curves rejected"), OPTIONAL)

#define FORCE_DISPLACEMENT_COLUMNS(X)                                                              \
    X(FORCE_DISPLACEMENT_GROUP, AS(group), "bulk or track", TEXT)                                  \
    X(FORCE_DISPLACEMENT_SEGMENT, AS(segment), "approach or retract", ENUM(segment_kind))          \
    X(FORCE_DISPLACEMENT_DISPLACEMENT, AS(displacement),                                           \
      "piezo displacement towards the sample, from the contact point", SI(LENGTH))                 \
    X(FORCE_DISPLACEMENT_FORCE, AS(force), "force above the baseline at contact", SI(FORCE))

/* Each group has one of each key. */
#define FORCE_DISPLACEMENT_KEYS(X)                                                                 \
    X(FORCE_DISPLACEMENT_KEY_CURVE, "curve_", TEXT, OPTIONAL)                                      \
    X(FORCE_DISPLACEMENT_KEY_CONTACT_POINT, "contact_point_", SI(LENGTH), OPTIONAL)                \
    X(FORCE_DISPLACEMENT_KEY_CONTACT_FORCE, "contact_force_", SI(FORCE), OPTIONAL)

#define FORCE_INDENTATION_COLUMNS(X)                                                               \
    X(FORCE_INDENTATION_GROUP, AS(group), "bulk or track", TEXT)                                   \
    X(FORCE_INDENTATION_INDENTATION, AS(indentation), "indentation depth", SI(INDENTATION))        \
    X(FORCE_INDENTATION_FORCE, AS(force), "force above the baseline", SI(FORCE))                   \
    X(FORCE_INDENTATION_FITTED_FORCE, AS(fitted_force), "force of the fitted contact model",       \
      SI(FORCE))
#define FORCE_INDENTATION_KEYS(X)

/* Each curve is a block. */
#define CURVES_COLUMNS(X)                                                                          \
    X(CURVES_GROUP, AS(group), "bulk or track", TEXT)                                              \
    X(CURVES_FILE, AS(file), "file of the curve", TEXT)                                            \
    X(CURVES_CURVE, AS(curve), "number of the curve in its file", NUMBER)                          \
    X(CURVES_SEGMENT, AS(segment), "approach or retract", ENUM(segment_kind))                      \
    X(CURVES_DISPLACEMENT, AS(displacement),                                                       \
      "piezo displacement from the contact point; of a curve without one from its first sample",   \
      SI(LENGTH))                                                                                  \
    X(CURVES_FORCE, AS(force),                                                                     \
      "force above the baseline; of a curve without a contact point as measured", SI(FORCE))       \
    X(CURVES_INDENTATION, AS(indentation), "displacement less the bending of the cantilever",      \
      SI(LENGTH))                                                                                  \
    X(CURVES_FITTED_FORCE, AS(fitted_force), "fit to the approach at the same indentation",        \
      SI(FORCE))                                                                                   \
    X(CURVES_RESIDUAL, AS(residual), "force less the fit", SI(FORCE))
#define CURVES_KEYS(X)

/* A file of this form has the manual overrides; the result has those that were applied. */
#define OVERRIDES_COLUMNS(X)                                                                       \
    X(OVERRIDES_GROUP, AS(group), "group that it is for", TEXT, LABEL("Group"), OPTIONAL)          \
    X(OVERRIDES_FILE, AS(file), "file, or the end of its path", TEXT, LABEL("File"))               \
    X(OVERRIDES_CURVE, AS(curve), "number of the curve in its file; nan: all of the file", NUMBER, \
      LABEL("Curve"), OPTIONAL)                                                                    \
    X(OVERRIDES_CHOICE, AS(choice),                                                                \
      "exclude, contact-point, baseline-from, baseline-to, spring-constant, sensitivity or tip",   \
      TEXT, LABEL("Choice"))                                                                       \
    X(OVERRIDES_VALUE, AS(value), "with its unit", TEXT, LABEL("Value"), OPTIONAL)                 \
    X(OVERRIDES_NOTE, AS(note), "why, in words", TEXT, LABEL("Why"), OPTIONAL)                     \
    X(OVERRIDES_APPLIED, AS(applied), "curves that it was applied to", NUMBER, LABEL("Curves"),    \
      OPTIONAL)
#define OVERRIDES_KEYS(X)

/* The rows of a group have equal numbers of curves and units. */
#define MODULUS_DEPTH_COLUMNS(X)                                                                   \
    X(MODULUS_DEPTH_GROUP, AS(group), "bulk or track", TEXT, LABEL("Group"))                       \
    X(MODULUS_DEPTH_DEPTH, AS(depth), "indentation depth", SI(INDENTATION), LABEL("Depth"))        \
    X(MODULUS_DEPTH_MODULUS, AS(modulus),                                                          \
      "modulus of a homogeneous rubber with the force at this depth, geometric mean", SI(MODULUS), \
      LABEL("Modulus at this depth"), INTERVAL(MODULUS_DEPTH_LOW, MODULUS_DEPTH_HIGH))             \
    INTERVAL_COLUMNS(X, MODULUS_DEPTH, "", SI(MODULUS))                                            \
    X(MODULUS_DEPTH_N, AS(n), "number of curves", NUMBER, LABEL("Curves"))                         \
    X(MODULUS_DEPTH_UNITS, AS(n_units), "spots, or curves where fewer than three spots are",       \
      NUMBER, LABEL("Units"))
/* Each group has one of each key. */
#define MODULUS_DEPTH_KEYS(X)                                                                      \
    X(MODULUS_DEPTH_KEY_CHANGES, "changes_", TEXT, SHOWS(changes), OPTIONAL)                       \
    X(MODULUS_DEPTH_KEY_READING, "reading_", TEXT, SHOWS(reading), OPTIONAL)                       \
    X(MODULUS_DEPTH_KEY_RATIO, "ratio_", PLAIN, SHOWS(ratio), OPTIONAL)                            \
    X(MODULUS_DEPTH_KEY_CHANCE, "p_value_", PLAIN, SHOWS(chance), PRECISION(3), OPTIONAL)          \
    X(MODULUS_DEPTH_KEY_MISFIT_CHANCE, "misfit_p_", PLAIN, SHOWS(misfit_p), PRECISION(3), OPTIONAL)

#define SPOT_COLUMNS(X)                                                                            \
    X(SPOT_X, AS(x), "place in the image", SI(POSITION_X), LABEL("x"))                             \
    X(SPOT_Y, AS(y), "place in the image", SI(POSITION_Y), LABEL("y"))                             \
    X(SPOT_INDENTATION, "indentation", "depth that the tip reached", SI(INDENTATION),              \
      SHOWS(depth), LABEL("Indentation"))                                                          \
    X(SPOT_CONTACT_RADIUS, "contact_radius", "of the tip at this depth", SI(LENGTH),               \
      SHOWS(spot.contact), LABEL("Contact radius"))                                                \
    X(SPOT_PIXELS, "pixels", "pixels within the contact radius", NUMBER, SHOWS(spot.plane.n),      \
      LABEL("Pixels"))                                                                             \
    X(SPOT_TILT, AS(tilt), "slope of the plane over the contact", NUMBER, LABEL("Slope"), SPARSE)  \
    X(SPOT_ROUGHNESS, AS(roughness), "rms height over the contact, less its plane", SI(LENGTH),    \
      LABEL("Roughness"), INTERVAL(SPOT_ROUGHNESS_LOW, SPOT_ROUGHNESS_HIGH), SPARSE)               \
    X(SPOT_ROUGHNESS_LOW, "roughness_low", "least within the error of the position", SI(LENGTH),   \
      SPARSE)                                                                                      \
    X(SPOT_ROUGHNESS_HIGH, "roughness_high", "largest within the error of the position",           \
      SI(LENGTH), SPARSE)                                                                          \
    X(SPOT_ROUGHNESS_MEDIAN, "roughness_median", "median of as large places all over the image",   \
      SI(LENGTH), SHOWS(spot.median), LABEL("Roughness elsewhere"), SPARSE)                        \
    X(SPOT_RATIO, AS(ratio), "roughness over indentation", NUMBER, LABEL("Roughness / depth"),     \
      INTERVAL(SPOT_RATIO_LOW, SPOT_RATIO_HIGH), SPARSE)                                           \
    X(SPOT_RATIO_LOW, "ratio_low", "least within the error of the position", NUMBER, SPARSE)       \
    X(SPOT_RATIO_HIGH, "ratio_high", "largest within the error of the position", NUMBER, SPARSE)   \
    X(SPOT_LIMIT, AS(limit), "ratio at which the contact area is uncertain by the largest effect", \
      NUMBER, LABEL("Limit"), SPARSE)

#define SPOT_KEYS(X)                                                                               \
    X(SPOT_KEY_TIP, AS(tip), TEXT)                                                                 \
    X(SPOT_KEY_IMAGE, AS(image), TEXT)                                                             \
    X(SPOT_KEY_EFFECT, "largest_effect", PLAIN, SHOWS(effect))                                     \
    X(SPOT_KEY_VERDICT, "roughness_verdict", ENUM(stated_verdict), SHOWS(verdict),                 \
      LABEL("Roughness"))

#endif
