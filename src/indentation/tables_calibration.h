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

/* Each row is one cantilever. */
#define THERMAL_COLUMNS(X)                                                                         \
    X(THERMAL_FILE, "file", "file of the spectrum", TEXT, LABEL("File"))                           \
    NUMBER_AND_INTERVAL(X, THERMAL_SPRING_CONSTANT, "spring_constant", "spring constant",          \
                        SI(SPRING_CONSTANT), "Spring constant", .member = NULL)                    \
    X(THERMAL_FIT_ERROR, "fit_error", "standard error by the scatter of the spectrum, of it",      \
      NUMBER, LABEL("Of it by the fit"), DIGITS(2), SPARSE)                                        \
    NUMBER_AND_INTERVAL(X, THERMAL_RESONANCE, "resonance", "resonance", SI(FREQUENCY),             \
                        "Resonance", .member = NULL)                                               \
    NUMBER_AND_INTERVAL(X, THERMAL_QUALITY, "quality_factor", "quality factor", NUMBER,            \
                        "Quality factor", .member = NULL)                                          \
    X(THERMAL_DEFLECTION, "deflection", "root mean square of the deflection as measured",          \
      SI(DEFLECTION), LABEL("Deflection"), SPARSE)                                                 \
    X(THERMAL_FLOOR, "floor", "density of the white floor", SI(SPECTRAL_DENSITY), SPARSE)          \
    X(THERMAL_TEMPERATURE, "temperature", "temperature of the cantilever", SI(TEMPERATURE),        \
      LABEL("Temperature"))                                                                        \
    X(THERMAL_OF_FILE, "spring_constant_of_file", "spring constant that the file says",            \
      SI(SPRING_CONSTANT), LABEL("Of the file"), SPARSE)                                           \
    X(THERMAL_RATIO, "ratio", "spring constant over that of the file", NUMBER, LABEL("Ratio"),     \
      SPARSE)                                                                                      \
    X(THERMAL_SADER, "sader_spring_constant",                                                      \
      "spring constant by Sader's method, of resonance and quality factor", SI(SPRING_CONSTANT),   \
      LABEL("By Sader's method"), STANDARD_ERROR(THERMAL_SADER), SPARSE)                           \
    X(THERMAL_SADER_STANDARD_ERROR, "sader_spring_constant_standard_error",                        \
      "its standard error, as far as those of its values are known", SI(SPRING_CONSTANT), SPARSE)  \
    X(THERMAL_SADER_RATIO, "sader_ratio", "spring constant over that by Sader's method", NUMBER,   \
      SPARSE)                                                                                      \
    X(THERMAL_FROM, "fit_from", "range of the fit", SI(FREQUENCY), SPARSE)                         \
    X(THERMAL_TO, "fit_to", "its end", SI(FREQUENCY), SPARSE)                                      \
    X(THERMAL_POINTS, "points", "points in it", NUMBER)                                            \
    X(THERMAL_AVERAGES, "averages", "number of averages, from the scatter about the fit", NUMBER,  \
      SPARSE)                                                                                      \
    X(THERMAL_AVERAGES_OF_FILE, "averages_of_file", "averages that the file says", NUMBER, SPARSE) \
    X(THERMAL_CHANCE, "misfit_p",                                                                  \
      "chance of as much slow departure from the oscillator by scatter alone", NUMBER, DIGITS(2),  \
      SPARSE)                                                                                      \
    X(THERMAL_NOTE, "note", "why there is no spring constant, or what it lacks", TEXT,             \
      LABEL("Note"))
#define THERMAL_KEYS(X)                                                                            \
    X(THERMAL_KEY_SPRING_CONSTANT, "spring_constant", SI(SPRING_CONSTANT),                         \
      HEADLINE("Spring constant by thermal noise"), OPTIONAL)                                      \
    X(THERMAL_KEY_SCATTER, "scatter", PLAIN, OPTIONAL)                                             \
    X(THERMAL_KEY_MODE_SHAPE, "mode_shape", PLAIN)                                                 \
    X(THERMAL_KEY_CHI, "chi", PLAIN)                                                               \
    X(THERMAL_KEY_INCLUDES, "includes", TEXT)                                                      \
    X(THERMAL_KEY_INDENT, "indent_option", TEXT, OPTIONAL)                                         \
    X(THERMAL_KEY_COMPARE, "compare_option", TEXT, OPTIONAL)                                       \
    X(THERMAL_KEY_CONTRADICTION, "contradiction", TEXT, LABEL("Not to be used"), OPTIONAL)         \
    X(THERMAL_KEY_N_SPECTRA, "n_spectra", PLAIN)

#endif
