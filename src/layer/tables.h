/* Columns and keys of the identification of a layer. Included by core/table/registry.h only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_TABLES_H
#define WT_LAYER_TABLES_H

#define IDENTIFICATION_METHODS(X)                                                                  \
    X(BY_WEAR, "thickness and wear rate")                                                          \
    X(BY_RATES, "thickness and running-in, by the balance of rates")                               \
    X(BY_TRANSPORT, "thickness and running-in, by the transport of damage")                        \
    X(BY_THICKNESS, "thickness alone")

/* Each row is one identification method. */
#define IDENTIFICATION_COLUMNS(X)                                                                  \
    X(IDENTIFICATION_BY, AS(by), "what they are known by", ENUM(identification_method),            \
      LABEL("By"))                                                                                 \
    NUMBER_AND_INTERVAL(X, IDENTIFICATION_ENERGY, "critical_energy", "critical energy U_c",        \
                        SI(ENERGY_DENSITY), "Critical energy", SHOWS(energy))                      \
    NUMBER_AND_INTERVAL(X, IDENTIFICATION_WEAR, "specific_wear_rate", "specific wear rate k",      \
                        SI(WEAR_RATE), "Specific wear rate", SHOWS(wear))                          \
    X(IDENTIFICATION_CORRELATION, IN(axes, correlation), "correlation of ln U_c and ln k", NUMBER, \
      DIGITS(2), LABEL("Correlation"), SPARSE)                                                     \
    X(IDENTIFICATION_LOOSE, IN(axes, loose), "the combination that is known least", TEXT,          \
      LABEL("Known least"))                                                                        \
    X(IDENTIFICATION_LOOSE_ERROR, IN(axes, loose_error),                                           \
      "standard deviation along it, of the logarithms; inf: it is not determined", NUMBER,         \
      DIGITS(2), LABEL("to"), SPARSE)                                                              \
    X(IDENTIFICATION_TIGHT_ERROR, IN(axes, tight_error),                                           \
      "standard deviation across it, of the logarithms", NUMBER, DIGITS(2), LABEL("Across it"),    \
      SPARSE)                                                                                      \
    X(IDENTIFICATION_ENERGY_INPUTS, AS(energy_inputs),                                             \
      "standard deviation of ln U_c by material, surface and conditions alone", NUMBER, OPTIONAL,  \
      SPARSE)                                                                                      \
    X(IDENTIFICATION_WEAR_INPUTS, AS(wear_inputs), "likewise of ln k", NUMBER, OPTIONAL, SPARSE)   \
    X(IDENTIFICATION_CORRELATION_INPUTS, AS(correlation_inputs), "correlation of these two",       \
      NUMBER, OPTIONAL, SPARSE)                                                                    \
    X(IDENTIFICATION_NOTE, AS(note), "what is lacking, or taken from elsewhere", TEXT,             \
      LABEL("Note"))
/* The first two belong to the first method with an interval. */
#define IDENTIFICATION_KEYS(X)                                                                     \
    X(IDENTIFICATION_KEY_ENERGY, "identified_critical_energy", SI(ENERGY_DENSITY),                 \
      HEADLINE("Critical energy by the layer"), OPTIONAL)                                          \
    X(IDENTIFICATION_KEY_WEAR, "identified_wear_rate", SI(WEAR_RATE),                              \
      HEADLINE("Specific wear rate by the layer"), OPTIONAL)                                       \
    X(IDENTIFICATION_KEY_PRODUCT, "wear_times_energy", NUMBER,                                     \
      LABEL("k U_c, which the thickness alone determines"))                                        \
    X(IDENTIFICATION_KEY_RATIO, "formation_wear_ratio", NUMBER,                                    \
      LABEL("Formation rate over wear rate, R"))                                                   \
    X(IDENTIFICATION_KEY_AGREES, "agreement", TEXT, LABEL("Running-in against wear"), OPTIONAL)    \
    X(IDENTIFICATION_KEY_VELOCITY, "velocity", SI(VELOCITY), LABEL("Velocity"))                    \
    X(IDENTIFICATION_KEY_PRESSURE, "pressure", SI(PRESSURE), LABEL("Pressure"))                    \
    X(IDENTIFICATION_KEY_THICKNESS, "observed_thickness", SI(LENGTH), LABEL("Observed thickness")) \
    X(IDENTIFICATION_KEY_INCLUDES, "standard_error_includes", TEXT,                                \
      LABEL("Standard errors include"))                                                            \
    X(IDENTIFICATION_KEY_LACKS, "standard_error_excludes", TEXT, LABEL("No error known of"),       \
      OPTIONAL)

#endif
