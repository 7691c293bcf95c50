/* Columns and keys of the tables for the calibration of the cantilever. Only core/table/registry.h
 * includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_TABLES_CALIBRATION_H
#define WT_INDENTATION_TABLES_CALIBRATION_H

/* Each row is one branch of a curve. */
#define SENSITIVITY_CURVES_COLUMNS(X)                                                              \
    X(SENSITIVITY_CURVES_FILE, "file", "file of the curve", TEXT)                                  \
    X(SENSITIVITY_CURVES_CURVE, "curve", "number of the curve in its file", NUMBER)                \
    X(SENSITIVITY_CURVES_DIRECTION, "direction", "approach or retract", TEXT)                      \
    X(SENSITIVITY_CURVES_VERDICT, "verdict", "used, or why not", TEXT)                             \
    X(SENSITIVITY_CURVES_SENSITIVITY, "sensitivity",                                               \
      "piezo travel per signal in contact; of a surface that gives way it is no sensitivity",      \
      SI(SENSITIVITY), STANDARD_ERROR(SENSITIVITY_CURVES_SENSITIVITY), SPARSE)                     \
    X(SENSITIVITY_CURVES_SENSITIVITY_STANDARD_ERROR, "sensitivity_standard_error",                 \
      "its standard error by the scatter within the curve", SI(SENSITIVITY), SPARSE)               \
    X(SENSITIVITY_CURVES_FACTOR, "factor", "sensitivity over that of the file", NUMBER, SPARSE)    \
    X(SENSITIVITY_CURVES_CHANGE, "slope_change",                                                   \
      "change of the slope from end to end of the part, of the slope", NUMBER,                     \
      STANDARD_ERROR(SENSITIVITY_CURVES_CHANGE), SPARSE)                                           \
    X(SENSITIVITY_CURVES_CHANGE_STANDARD_ERROR, "slope_change_standard_error",                     \
      "its standard error", NUMBER, SPARSE)                                                        \
    X(SENSITIVITY_CURVES_TILT, "baseline_tilt",                                                    \
      "slope of the baseline, which is subtracted, of that in contact", NUMBER, SPARSE)            \
    X(SENSITIVITY_CURVES_MISFIT, "misfit",                                                         \
      "root mean square deviation of the samples from a line, relative to the rise of the "        \
      "signal",                                                                                    \
      NUMBER, SPARSE)                                                                              \
    X(SENSITIVITY_CURVES_TRAVEL, "travel", "travel of the piezo in the part", SI(LENGTH), SPARSE)  \
    X(SENSITIVITY_CURVES_POINTS, "points", "samples in the part", NUMBER)
#define SENSITIVITY_CURVES_KEYS(X)                                                                 \
    X(SENSITIVITY_CURVES_KEY_FROM, "contact_from", PLAIN)                                          \
    X(SENSITIVITY_CURVES_KEY_TO, "contact_to", PLAIN)

#define SLOPE_DIRECTIONS(X)                                                                        \
    X(SLOPE_OF_APPROACH, "approach")                                                               \
    X(SLOPE_OF_RETRACT, "retract")                                                                 \
    X(SLOPE_OF_BOTH, "both")

#define SLOPE_VERDICTS(X)                                                                          \
    X(SLOPE_STRAIGHT, "straight")                                                                  \
    X(SLOPE_RISES, "soft surface")                                                                 \
    X(SLOPE_FALLS, "not straight")                                                                 \
    X(SLOPE_INCONCLUSIVE, "inconclusive")

#define SENSITIVITY_COLUMNS(X)                                                                     \
    X(SENSITIVITY_DIRECTION, "direction",                                                          \
      "approach, retract, or the mean of the two of each curve", ENUM(slope_direction),            \
      LABEL("Direction"))                                                                          \
    X(SENSITIVITY_N, "n", "number of curves", NUMBER, LABEL("Curves"))                             \
    X(SENSITIVITY_UNITS, "n_units", "files, or curves where fewer than three files are", NUMBER,   \
      LABEL("Units"))                                                                              \
    NUMBER_AND_INTERVAL(X, SENSITIVITY_VALUE, "sensitivity", "deflection sensitivity",             \
                        SI(SENSITIVITY), "Deflection sensitivity", .member = NULL)                 \
    NUMBER_AND_INTERVAL(X, SENSITIVITY_FACTOR, "factor", "sensitivity over that of the file",      \
                        NUMBER, "Over that of the file", .member = NULL)                           \
    X(SENSITIVITY_SCATTER, "scatter", "standard deviation of a unit, of the sensitivity", NUMBER,  \
      LABEL("Scatter"), DIGITS(2), SPARSE)                                                         \
    X(SENSITIVITY_WAYS_ERROR, "direction_error",                                                   \
      "part of the standard error by the difference of approach and retract, of the sensitivity",  \
      NUMBER, LABEL("Of it by the ways"), DIGITS(2), SPARSE)                                       \
    NUMBER_AND_INTERVAL(X, SENSITIVITY_CHANGE, "slope_change",                                     \
                        "change of the slope from end to end of the part, of the slope", NUMBER,   \
                        "Change of the slope", .member = NULL)                                     \
    X(SENSITIVITY_SHARE, "surface_share",                                                          \
      "share of the sensitivity that a surface like a sphere's contact may add, by the upper end " \
      "of the change of the slope",                                                                \
      NUMBER, LABEL("Surface at most"), DIGITS(2), SPARSE)                                         \
    X(SENSITIVITY_TILT, "baseline_tilt",                                                           \
      "mean slope of the baselines, which is subtracted, of that in contact", NUMBER, SPARSE)      \
    X(SENSITIVITY_VERDICT, "verdict", "straight, or what it is instead", ENUM(slope_verdict),      \
      LABEL("Verdict"))                                                                            \
    X(SENSITIVITY_NOTE, "note", "what is lacking", TEXT, LABEL("Note"))
#define SENSITIVITY_KEYS(X)                                                                        \
    X(SENSITIVITY_KEY_SENSITIVITY, "sensitivity", SI(SENSITIVITY),                                 \
      HEADLINE("Deflection sensitivity"), OPTIONAL)                                                \
    X(SENSITIVITY_KEY_FACTOR, "factor", UNIT("1"), LABEL("Sensitivity over that of the file"),     \
      OPTIONAL)                                                                                    \
    X(SENSITIVITY_KEY_VERDICT, "verdict", ENUM(slope_verdict), HEADLINE("Surface and detector"))   \
    X(SENSITIVITY_KEY_DIRECTION, "direction", ENUM(slope_direction))                               \
    X(SENSITIVITY_KEY_DIFFERENCE, "retract_over_approach", UNIT("1"),                              \
      LABEL("Retract over approach"), OPTIONAL)                                                    \
    X(SENSITIVITY_KEY_INDENT, "indent_option", TEXT, OPTIONAL)                                     \
    X(SENSITIVITY_KEY_COMPARE, "compare_option", TEXT, OPTIONAL)                                   \
    X(SENSITIVITY_KEY_SPRING, "thermal_spring_constant_factor", PLAIN, OPTIONAL)                   \
    X(SENSITIVITY_KEY_N_CURVES, "n_curves", PLAIN)                                                 \
    X(SENSITIVITY_KEY_N_LEFT_OUT, "n_left_out", PLAIN)

#endif
