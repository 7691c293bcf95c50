/* Columns and keys of the tables that compare measured and predicted friction. Only the table
 * registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_TABLES_VALIDATION_H
#define WT_RECORD_TABLES_VALIDATION_H

/* A number of a step with its standard error only. */
#define STEP_NUMBER(X, ID, name, words, heading, shown)                                            \
    X(ID, name, words, NUMBER, LABEL(heading), STANDARD_ERROR(ID), SPARSE, shown)                  \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", NUMBER,                   \
      LABEL("Standard error"), SPARSE)

/* Each row is a step of a record. */
#define VALIDATION_COLUMNS(X)                                                                      \
    X(VALIDATION_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY), LABEL("Velocity"))      \
    X(VALIDATION_TEMPERATURE, AS(temperature), "temperature that it is predicted at",              \
      SI(TEMPERATURE), LABEL("Temperature"), SPARSE)                                               \
    X(VALIDATION_PRESSURE, AS(pressure), "nominal pressure that it is predicted at", SI(PRESSURE), \
      LABEL("Pressure"))                                                                           \
    NUMBER_AND_INTERVAL(X, VALIDATION_MEASURED, "friction_measured",                               \
                        "friction coefficient as measured", NUMBER, "Measured", SHOWS(measured))   \
    STEP_NUMBER(X, VALIDATION_PREDICTED, "friction_predicted",                                     \
                "friction coefficient as predicted, without a layer", "Predicted",                 \
                SHOWS(predicted))                                                                  \
    NUMBER_AND_INTERVAL(X, VALIDATION_RATIO, "ratio", "measured over predicted, without a layer",  \
                        NUMBER, "Measured over predicted", SHOWS(ratio))                           \
    STEP_NUMBER(X, VALIDATION_WITH_LAYER, "friction_with_layer",                                   \
                "friction coefficient as predicted, with the layer", "With layer",                 \
                SHOWS(with_layer))                                                                 \
    NUMBER_AND_INTERVAL(X, VALIDATION_RATIO_LAYER, "ratio_with_layer",                             \
                        "measured over predicted, with the layer", NUMBER,                         \
                        "Measured over that with layer", SHOWS(ratio_with_layer))                  \
    NUMBER_AND_INTERVAL(X, VALIDATION_NEEDED, "shear_stress_needed",                               \
                        "shear stress that the step alone asks for, of the judged prediction",     \
                        SI(STRESS), "Shear stress needed", SHOWS(needed))                          \
    X(VALIDATION_NOTE, AS(note), "what is lacking, or why it is not compared", TEXT,               \
      LABEL("Note"))                                                                               \
    X(VALIDATION_FILE, AS(file), "file of the record", TEXT, LABEL("File"))

/* Limits of the 95 % interval of a number whose key has no interval. */
#define KEY_BOUNDS(X, ID, name, unit, heading)                                                     \
    X(ID##_LOW, name "_low", unit, LABEL(heading ", 95 % interval from"), OPTIONAL)                \
    X(ID##_HIGH, name "_high", unit, LABEL("to"), OPTIONAL)
/* Whether the theory explains the record: as given, or with the shear stress that the record asks
 * for if this is plausible. */
#define VALIDATION_OUTCOMES(X)                                                                     \
    X(OUTCOME_INCONCLUSIVE, "inconclusive")                                                        \
    X(OUTCOME_YES, "yes")                                                                          \
    X(OUTCOME_YES_WITH_SHEAR, "yes, with another shear stress")                                    \
    X(OUTCOME_NO, "no")

#define VALIDATION_KEYS(X)                                                                         \
    X(VALIDATION_KEY_OUTCOME, "outcome", ENUM(validation_outcome),                                 \
      HEADLINE("Theory against measured friction"), OPTIONAL)                                      \
    X(VALIDATION_KEY_POWER, "verdict_power", NUMBER,                                               \
      LABEL("Probability that such a record shows that a true theory explains it"), OPTIONAL)      \
    X(VALIDATION_KEY_VERDICT, "verdict", ENUM(stated_verdict),                                     \
      LABEL("With the shear stress as given"))                                                     \
    X(VALIDATION_KEY_WITHOUT, "verdict_without_layer", TEXT, LABEL("Without a layer"))             \
    X(VALIDATION_KEY_WITH, "verdict_with_layer", TEXT, LABEL("With the layer"), OPTIONAL)          \
    X(VALIDATION_KEY_JUDGED, "judged", TEXT, LABEL("The verdict is on"))                           \
    X(VALIDATION_KEY_TEST, "test", TEXT, LABEL("Test"))                                            \
    X(VALIDATION_KEY_SETTLED_BY, "settled_by", TEXT, LABEL("How to decide it"), OPTIONAL)          \
    X(VALIDATION_KEY_RATIO, "ratio", UNIT("1"), HEADLINE("Friction, measured over predicted"),     \
      OPTIONAL)                                                                                    \
    KEY_BOUNDS(X, VALIDATION_KEY_RATIO, "ratio", NUMBER, "Measured over predicted")                \
    X(VALIDATION_KEY_TREND, "ratio_per_decade", UNIT("1"),                                         \
      LABEL("Change of the ratio with a decade of velocity"), OPTIONAL)                            \
    X(VALIDATION_KEY_SCATTER, "scatter", NUMBER,                                                   \
      LABEL("Relative scatter between the steps beside their errors"), OPTIONAL)                   \
    X(VALIDATION_KEY_SHEAR, "shear_stress", SI(STRESS), LABEL("Shear stress used"), OPTIONAL)      \
    X(VALIDATION_KEY_NEEDED, "shear_stress_needed", SI(STRESS),                                    \
      HEADLINE("Shear stress that the record asks for"), OPTIONAL)                                 \
    KEY_BOUNDS(X, VALIDATION_KEY_NEEDED, "shear_stress_needed", SI(STRESS), "Shear stress needed") \
    X(VALIDATION_KEY_PLAUSIBLE, "shear_stress_plausible", TEXT,                                    \
      LABEL("Is that shear stress plausible"), OPTIONAL)                                           \
    X(VALIDATION_KEY_SHAPE, "verdict_with_needed", TEXT,                                           \
      LABEL("With the shear stress that it asks for"), OPTIONAL)                                   \
    X(VALIDATION_KEY_WEAR_RATIO, "wear_ratio", UNIT("1"),                                          \
      LABEL("Specific wear rate, measured over used"), OPTIONAL)                                   \
    KEY_BOUNDS(X, VALIDATION_KEY_WEAR_RATIO, "wear_ratio", NUMBER, "Wear rate ratio")              \
    X(VALIDATION_KEY_WEAR, "verdict_wear", TEXT, LABEL("Wear, measured against used"), OPTIONAL)   \
    X(VALIDATION_KEY_LAYER_THICKNESS, "layer_thickness", SI(LENGTH), LABEL("Layer thickness"),     \
      OPTIONAL)                                                                                    \
    X(VALIDATION_KEY_LAYER_RATIO, "layer_modulus_ratio", NUMBER, LABEL("Modulus ratio"), OPTIONAL) \
    X(VALIDATION_KEY_LAYER_MODULI, "layer_moduli", TEXT, LABEL("Moduli of the layer"), OPTIONAL)   \
    X(VALIDATION_KEY_LAYER_SLOPE, "layer_ratio_slope", NUMBER,                                     \
      LABEL("Slope of the modulus ratio with the frequency"), OPTIONAL)                            \
    X(VALIDATION_KEY_STEPS, "n_steps", PLAIN, LABEL("Steps that were compared"))                   \
    X(VALIDATION_KEY_LEFT_OUT, "n_left_out", PLAIN, LABEL("Steps that were not"))                  \
    X(VALIDATION_KEY_REMARKS, "remarks", TEXT, LABEL("Assumed"), OPTIONAL)

/* Sources of the error of measured over predicted friction. */
#define VALIDATION_SOURCE_LIST(X)                                                                  \
    X(VALIDATION_SOURCE_SHIFT_LAW, "shift law")                                                    \
    X(VALIDATION_SOURCE_PRESSURE, "pressure")                                                      \
    X(VALIDATION_SOURCE_TEMPERATURE, "temperature")                                                \
    X(VALIDATION_SOURCE_SHEAR_STRESS, "shear stress")                                              \
    X(VALIDATION_SOURCE_ROUGHNESS, "roughness")                                                    \
    X(VALIDATION_SOURCE_SOFTENING, "softening with strain")                                        \
    X(VALIDATION_SOURCE_THICKNESS, "thickness of the layer")                                       \
    X(VALIDATION_SOURCE_RATIO, "modulus ratio")                                                    \
    X(VALIDATION_SOURCE_RATIO_SLOPE, "slope of the modulus ratio")                                 \
    X(VALIDATION_SOURCE_WEAR, "specific wear rate")                                                \
    X(VALIDATION_SOURCE_CRITICAL_ENERGY, "critical energy")                                        \
    X(VALIDATION_SOURCE_OBSERVED, "observed thickness")                                            \
    X(VALIDATION_SOURCE_MATERIAL, "material")                                                      \
    X(VALIDATION_SOURCE_MATERIAL_AND_SURFACE, "material, and scatter of the measured spectrum")    \
    X(VALIDATION_SOURCE_ALL_DRAWN, "material and all else that is drawn")                          \
    X(VALIDATION_SOURCE_RECORD, "record")                                                          \
    X(VALIDATION_SOURCE_SCATTER, "scatter between the steps")

/* Each row is a source of the error. */
#define VALIDATION_SOURCES_COLUMNS(X)                                                              \
    X(VALIDATION_SOURCES_SOURCE, AS(source), "where the error comes from",                         \
      ENUM(validation_source), LABEL("Source"))                                                    \
    X(VALIDATION_SOURCES_ERROR, AS(error),                                                         \
      "standard error of measured over predicted by it alone, relative, at the deciding step",     \
      NUMBER, LABEL("Error of the ratio"))                                                         \
    X(VALIDATION_SOURCES_SHARE, AS(share), "of the variance there", NUMBER, LABEL("Share"))        \
    X(VALIDATION_SOURCES_NEEDED_SHARE, AS(needed_share),                                           \
      "of the variance of the shear stress that is asked for", NUMBER,                             \
      LABEL("Share of the shear stress needed"), SPARSE)                                           \
    X(VALIDATION_SOURCES_REMEDY, AS(remedy), "what reduces it", TEXT, LABEL("What reduces it"))
#define VALIDATION_SOURCES_KEYS(X)                                                                 \
    X(VALIDATION_SOURCES_KEY_ADVICE, "advice", TEXT, LABEL("What would narrow it most"))

/* Each row is the running-in of a record. */
#define VALIDATION_RUNNING_IN_COLUMNS(X)                                                           \
    X(VALIDATION_RUNNING_IN_VELOCITY, IN(at, velocity), "sliding velocity", SI(VELOCITY),          \
      LABEL("Velocity"))                                                                           \
    X(VALIDATION_RUNNING_IN_TEMPERATURE, IN(at, temperature),                                      \
      "temperature that it is predicted at", SI(TEMPERATURE), LABEL("Temperature"), SPARSE)        \
    X(VALIDATION_RUNNING_IN_PRESSURE, IN(at, pressure),                                            \
      "nominal pressure that it is predicted at", SI(PRESSURE), LABEL("Pressure"))                 \
    NUMBER_AND_INTERVAL(X, VALIDATION_RUNNING_IN_SETTLED, "settled_measured",                      \
                        "time until 5 % of the change of friction are left, by the predicted "     \
                        "course that lies nearest to the record",                                  \
                        SI(TIME), "Steady after, measured", SHOWS(settled))                        \
    X(VALIDATION_RUNNING_IN_PREDICTED, "settled_predicted",                                        \
      "time until 5 % of the change of friction are left, as predicted with the layer", SI(TIME),  \
      SHOWS(predicted), LABEL("predicted"), STANDARD_ERROR(VALIDATION_RUNNING_IN_PREDICTED),       \
      SPARSE)                                                                                      \
    X(VALIDATION_RUNNING_IN_PREDICTED_STANDARD_ERROR, "settled_predicted_standard_error",          \
      "its standard error", SI(TIME), LABEL("Standard error"), SPARSE)                             \
    NUMBER_AND_INTERVAL(X, VALIDATION_RUNNING_IN_TIME_RATIO, "time_ratio",                         \
                        "time measured over predicted", NUMBER, "Time, measured over predicted",   \
                        SHOWS(time_ratio))                                                         \
    X(VALIDATION_RUNNING_IN_CHANGE, "change_predicted",                                            \
      "friction in the end less that which is farthest from it, as predicted", NUMBER,             \
      SHOWS(change), LABEL("Change predicted"), STANDARD_ERROR(VALIDATION_RUNNING_IN_CHANGE),      \
      SPARSE)                                                                                      \
    X(VALIDATION_RUNNING_IN_CHANGE_STANDARD_ERROR, "change_predicted_standard_error",              \
      "its standard error", NUMBER, LABEL("Standard error"), SPARSE)                               \
    X(VALIDATION_RUNNING_IN_NOTE, AS(note), "what is lacking", TEXT, LABEL("Note"))                \
    X(VALIDATION_RUNNING_IN_FILE, AS(file), "file of the record", TEXT, LABEL("File"))
#define VALIDATION_RUNNING_IN_KEYS(X)                                                              \
    X(VALIDATION_RUNNING_IN_KEY_TIME_RATIO, "time_ratio", UNIT("1"),                               \
      HEADLINE("Running-in time, measured over predicted"), OPTIONAL)                              \
    KEY_BOUNDS(X, VALIDATION_RUNNING_IN_KEY_TIME_RATIO, "time_ratio", NUMBER, "Time ratio")        \
    X(VALIDATION_RUNNING_IN_KEY_RUNS, "n_runs", PLAIN, LABEL("Running-ins predicted"))             \
    X(VALIDATION_RUNNING_IN_KEY_INCLUDES, "includes", TEXT, LABEL("Errors in the prediction"))     \
    X(VALIDATION_RUNNING_IN_KEY_REMARKS, "remarks", TEXT, LABEL("Assumed"), OPTIONAL)

/* Friction during the running-in: each row is a time, each block is a record. */
#define VALIDATION_COURSE_COLUMNS(X)                                                               \
    X(VALIDATION_COURSE_TIME, AS(time), "time from the start of the record on", SI(TIME))          \
    X(VALIDATION_COURSE_MEASURED, "friction_measured",                                             \
      "mean friction coefficient of the cycles about it", NUMBER, SHOWS(measured),                 \
      LABEL("Measured"))                                                                           \
    STEP_NUMBER(X, VALIDATION_COURSE_LAYER, "friction_with_layer",                                 \
                "friction coefficient as predicted while the layer grows", "With layer",           \
                SHOWS(layered))                                                                    \
    STEP_NUMBER(X, VALIDATION_COURSE_BARE, "friction_without_layer",                               \
                "friction coefficient as predicted without a layer", "Without", SHOWS(bare))       \
    X(VALIDATION_COURSE_FILE, AS(file), "file of the record", TEXT)
#define VALIDATION_COURSE_KEYS(X)

#endif
