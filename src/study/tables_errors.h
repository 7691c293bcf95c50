/* Columns and keys of the tables about errors: "error_budget", contribution of each error to a
 * number; "work_precision", error against run time; "what_if", choices of the model. Only the table
 * registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_ERRORS_H
#define WT_STUDY_TABLES_ERRORS_H

#define ERROR_BUDGET_COLUMNS(X)                                                                    \
    X(ERROR_BUDGET_NUMBER, AS(number), "the number, at the reference velocity", TEXT,              \
      LABEL("Number"))                                                                             \
    X(ERROR_BUDGET_SOURCE, IN(of, source), "where the error comes from", TEXT, LABEL("Source"))    \
    X(ERROR_BUDGET_KIND, IN(of, kind),                                                             \
      "measured: one standard error by this source alone; together: by all of them; draws: "       \
      "what the number of replicates leaves open of that, at most; numerical: a bound; model: "    \
      "half the range of the what-if table",                                                       \
      ENUM(error_kind), LABEL("Kind"))                                                             \
    X(ERROR_BUDGET_RELATIVE_ERROR, "relative_error", "the error over the number", NUMBER,          \
      SHOWS(of.error), LABEL("Relative error"))                                                    \
    X(ERROR_BUDGET_SHARE, IN(of, share), "of the variance by all that is measured or stated",      \
      NUMBER, LABEL("Share of the variance"))                                                      \
    X(ERROR_BUDGET_SECONDS, IN(of, seconds), "elapsed time to know it, of all numbers together",   \
      SI(TIME), LABEL("Time"))                                                                     \
    X(ERROR_BUDGET_REMEDY, IN(of, remedy), "what reduces it", TEXT, LABEL("What reduces it"))

#define ERROR_BUDGET_KEYS(X)                                                                       \
    X(ERROR_BUDGET_KEY_HYSTERESIS, "hysteresis_advice", TEXT, LABEL("Hysteresis part"), OPTIONAL)  \
    X(ERROR_BUDGET_KEY_AREA_RATIO, "area_ratio_advice", TEXT,                                      \
      LABEL("Real over nominal contact area"), OPTIONAL)                                           \
    X(ERROR_BUDGET_KEY_FRICTION, "friction_advice", TEXT, LABEL("Friction coefficient"), OPTIONAL) \
    X(ERROR_BUDGET_KEY_THICKNESS, "thickness_advice", TEXT, LABEL("Layer thickness at balance"),   \
      OPTIONAL)                                                                                    \
    X(ERROR_BUDGET_KEY_WITH_LAYER, "friction_with_layer_advice", TEXT,                             \
      LABEL("Friction coefficient with layer"), OPTIONAL)                                          \
    X(ERROR_BUDGET_KEY_RATIO, "modulus_ratio_advice", TEXT, LABEL("Modulus ratio"), OPTIONAL)      \
    X(ERROR_BUDGET_KEY_LACKS, "excluded_errors", TEXT, LABEL("Errors that nothing states"),        \
      OPTIONAL)

#define PRECISION_METHODS(X)                                                                       \
    X(METHOD_OF_PROGRAM, "weartrack")                                                              \
    X(METHOD_OF_TEXTBOOK, "textbook")

#define WORK_PRECISION_COLUMNS(X)                                                                  \
    X(WORK_PRECISION_PART, AS(part), "numerical part", TEXT, LABEL("Part"))                        \
    X(WORK_PRECISION_METHOD, AS(method), "weartrack or the textbook", ENUM(precision_method),      \
      LABEL("Method"))                                                                             \
    X(WORK_PRECISION_SETTING, AS(setting), "what is swept", TEXT, LABEL("Setting"))                \
    X(WORK_PRECISION_VALUE, AS(value), "its value", NUMBER, LABEL("Value"))                        \
    X(WORK_PRECISION_TRUE_ERROR, IN(errors, true_error),                                           \
      "largest relative error against the reference, or that of the reference if it is larger",    \
      NUMBER, LABEL("True error"))                                                                 \
    X(WORK_PRECISION_STATED_ERROR, IN(errors, stated_error), "the same as stated by the method",   \
      NUMBER, LABEL("Stated error"))                                                               \
    X(WORK_PRECISION_REFERENCE_ERROR, AS(reference_error),                                         \
      "what the reference is good to, by a second computation of it", NUMBER,                      \
      LABEL("Error of the reference"))                                                             \
    X(WORK_PRECISION_SECONDS, "seconds", "processor time, median of the repeats", SI(TIME),        \
      SHOWS(time.median), LABEL("Time"))                                                           \
    X(WORK_PRECISION_SPREAD, IN(time, spread), "half the range of the middle half of them",        \
      SI(TIME), LABEL("Spread"), LIKE(WORK_PRECISION_SECONDS))                                     \
    X(WORK_PRECISION_REPEATS, IN(time, repeats), "how often it was timed", NUMBER,                 \
      LABEL("Repeats"))                                                                            \
    X(WORK_PRECISION_WORDS, AS(words), "the problem and its reference", TEXT, LABEL("Problem"))

#define WORK_PRECISION_KEYS(X)                                                                     \
    X(WORK_PRECISION_KEY_ANSWER, "answer", TEXT, LABEL("What more work buys"), OPTIONAL)

/* Choices of the model, with their names after "if the"; the first row of the table: none. */
#define WHAT_IF_CHOICES(X)                                                                         \
    X(CHOICE_AS_USED, "as used")                                                                   \
    X(CHOICE_Q1, "largest wavenumber q1")                                                          \
    X(CHOICE_SPECTRUM_END, "end of the measured spectrum")                                         \
    X(CHOICE_Q0, "smallest wavenumber q0")                                                         \
    X(CHOICE_GAMMA, "factor gamma of partial contact")                                             \
    X(CHOICE_STRAIN, "strain over slope")                                                          \
    X(CHOICE_FLASH, "flash temperature")                                                           \
    X(CHOICE_CONDUCTIVITY, "heat conductivity of the rubber")                                      \
    X(CHOICE_CONTACT_SIZE, "size of a macroscopic contact")                                        \
    X(CHOICE_POISSON, "Poisson ratio")                                                             \
    X(CHOICE_VERTICAL, "vertical shift")                                                           \
    X(CHOICE_PROFILE, "depth profile")                                                             \
    X(CHOICE_SHEAR, "shear stress of the layer")

/* A number with its change relative to the first row. */
#define WHAT_IF_NUMBER(X, ID, name, words, unit, heading)                                          \
    X(ID, name, words, unit, LABEL(heading))                                                       \
    X(ID##_CHANGE, name "_change", "its relative change", NUMBER, LABEL("change"))

#define WHAT_IF_COLUMNS(X)                                                                         \
    X(WHAT_IF_CHOICE, "choice", "the choice that is moved; the first row: none",                   \
      ENUM(what_if_choice), LABEL("Choice"))                                                       \
    X(WHAT_IF_USED, "used", "what all other tables rest on", TEXT, LABEL("Used"))                  \
    X(WHAT_IF_TRIED, "alternative", "value in this row instead", TEXT, LABEL("Alternative"))       \
    WHAT_IF_NUMBER(X, WHAT_IF_HYSTERESIS, "hysteresis",                                            \
                   "hysteresis friction at the reference velocity", NUMBER, "Hysteresis")          \
    WHAT_IF_NUMBER(X, WHAT_IF_AREA_RATIO, "area_ratio", "real over nominal contact area there",    \
                   NUMBER, "A/A₀")                                                                 \
    WHAT_IF_NUMBER(X, WHAT_IF_FRICTION, "friction", "friction coefficient there", NUMBER,          \
                   "Total μ")                                                                      \
    WHAT_IF_NUMBER(X, WHAT_IF_THICKNESS, "thickness", "thickness of the layer at balance",         \
                   SI(LENGTH), "Thickness")                                                        \
    WHAT_IF_NUMBER(X, WHAT_IF_WITH_LAYER, "friction_with_layer",                                   \
                   "friction coefficient with the modified layer", NUMBER, "With layer")           \
    X(WHAT_IF_WHY, "why", "why this range", TEXT, LABEL("Why this range"))                         \
    X(WHAT_IF_REMEDY, "remedy", "what to measure to settle the choice", TEXT, OPTIONAL,            \
      LABEL("To settle it"))                                                                       \
    X(WHAT_IF_NOTE, "note", "why there is no number", TEXT, LABEL("Not computed because"))

#define WHAT_IF_KEYS(X)                                                                            \
    X(WHAT_IF_KEY_LEFT_OUT, "left_out", TEXT, LABEL("Choices that do not apply"), OPTIONAL)        \
    X(WHAT_IF_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, LABEL("Material statement"),     \
      OPTIONAL)                                                                                    \
    X(WHAT_IF_KEY_EXTRAPOLATED_SHARE, "extrapolated_share", NUMBER, LABEL("Extrapolated share"),   \
      OPTIONAL)                                                                                    \
    X(WHAT_IF_KEY_SHARE_BEYOND, "share_beyond_reliable", NUMBER,                                   \
      LABEL("Share of the hysteresis from waves beyond the reliable range of the surface"),        \
      OPTIONAL)

#endif
