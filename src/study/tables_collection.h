/* Columns and keys of the tables of collected cases. Only the table registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_COLLECTION_H
#define WT_STUDY_TABLES_COLLECTION_H

#define FRICTION_PARTS(X)                                                                          \
    X(WHOLE_FRICTION, "friction")                                                                  \
    X(HYSTERESIS_ALONE, "hysteresis")

#define OF_CASE(X, ID)                                                                             \
    X(ID##_SAMPLE, AS(sample), "rubber", TEXT, LABEL("Sample"))                                    \
    X(ID##_CONDITION, AS(condition), "what made the wear track", TEXT, LABEL("Condition"))

/* Each row is a case. */
#define COLLECTION_COLUMNS(X)                                                                      \
    OF_CASE(X, COLLECTION)                                                                         \
    VALUE_AND_INTERVAL(X, COLLECTION_RATIO, "modulus_ratio",                                       \
                       "modulus of the track over that of the bulk", NUMBER, SHOWS(ratio),         \
                       LABEL("Track / bulk"), SPARSE)                                              \
    X(COLLECTION_DIFFERS, AS(differs), "does the wear track differ: yes, no or inconclusive",      \
      ENUM(stated_verdict), LABEL("Differs"))                                                      \
    VALUE_AND_INTERVAL(X, COLLECTION_THICKNESS, "balance_thickness",                               \
                       "thickness of the layer where formation balances wear", SI(LENGTH),         \
                       SHOWS(thickness), LABEL("Layer thickness"), SPARSE)                         \
    VALUE_AND_INTERVAL(X, COLLECTION_CHANGE, "friction_change",                                    \
                       "relative change of the friction by the layer", NUMBER, SHOWS(change),      \
                       LABEL("Change of friction"), SPARSE)                                        \
    X(COLLECTION_FILE, AS(file), "result", TEXT, LABEL("File"))
#define COLLECTION_KEYS(X)                                                                         \
    X(COLLECTION_KEY_CASES, AS(cases), NUMBER, LABEL("Cases"))                                     \
    X(COLLECTION_KEY_SAMPLES, AS(samples), NUMBER, LABEL("Samples"))                               \
    X(COLLECTION_KEY_CONDITIONS, AS(conditions), NUMBER, LABEL("Conditions"))

/* Each block is a group of a case. */
#define COLLECTED_MODULUS_COLUMNS(X)                                                               \
    OF_CASE(X, COLLECTED_MODULUS)                                                                  \
    X(COLLECTED_MODULUS_PLACE, AS(place), "bulk, or the condition of the track", TEXT)             \
    X(COLLECTED_MODULUS_RATE, "indentation_rate", "geometric mean of the indentation rate",        \
      SI(VELOCITY), SHOWS(rate))                                                                   \
    VALUE_AND_INTERVAL(X, COLLECTED_MODULUS_MODULUS, "modulus", "geometric mean of the modulus",   \
                       SI(MODULUS), SHOWS(modulus))
#define COLLECTED_MODULUS_KEYS(X)

/* Each block is a case. */
#define COLLECTED_FRICTION_COLUMNS(X)                                                              \
    OF_CASE(X, COLLECTED_FRICTION)                                                                 \
    X(COLLECTED_FRICTION_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                 \
    X(COLLECTED_FRICTION_FRICTION, AS(friction),                                                   \
      "friction coefficient, or its hysteresis part where no shear stress is given", NUMBER,       \
      STANDARD_ERROR(COLLECTED_FRICTION_FRICTION))                                                 \
    X(COLLECTED_FRICTION_FRICTION_STANDARD_ERROR, "friction_standard_error", "its standard error", \
      NUMBER, SHOWS(standard_error))                                                               \
    X(COLLECTED_FRICTION_WITH_LAYER, AS(with_layer),                                               \
      "friction coefficient with the modified layer", NUMBER, SPARSE)                              \
    X(COLLECTED_FRICTION_AREA_RATIO, AS(area_ratio), "real over nominal contact area", NUMBER)
#define COLLECTED_FRICTION_KEYS(X) X(COLLECTED_FRICTION_KEY_PART, AS(part), ENUM(friction_part))

/* Each block is a temperature sweep. */
#define COLLECTED_RAMP_COLUMNS(X)                                                                  \
    X(COLLECTED_RAMP_SAMPLE, AS(sample), "rubber", TEXT)                                           \
    X(COLLECTED_RAMP_TEMPERATURE, AS(temperature), "temperature", SI(TEMPERATURE))                 \
    X(COLLECTED_RAMP_ANGULAR_FREQUENCY, AS(angular_frequency),                                     \
      "angular frequency, of all that the sample has the nearest to their geometric mean over "    \
      "the samples",                                                                               \
      SI(ANGULAR_FREQUENCY))                                                                       \
    X(COLLECTED_RAMP_STORAGE_MODULUS, AS(storage_modulus), "storage modulus", SI(STORAGE_MODULUS)) \
    X(COLLECTED_RAMP_LOSS_MODULUS, AS(loss_modulus), "loss modulus", SI(LOSS_MODULUS))
#define COLLECTED_RAMP_KEYS(X)                                                                     \
    X(COLLECTED_RAMP_KEY_DEFORMATION, AS(deformation), ENUM(deformation))                          \
    X(COLLECTED_RAMP_KEY_LEFT_OUT, AS(left_out), TEXT, OPTIONAL)

/* Each block is a group of a case, or a paired group of a sample. */
#define COLLECTED_FORCE_COLUMNS(X)                                                                 \
    OF_CASE(X, COLLECTED_FORCE)                                                                    \
    X(COLLECTED_FORCE_PLACE, AS(place),                                                            \
      "bulk, the condition of the track, or a group beside the cases", TEXT)                       \
    X(COLLECTED_FORCE_INDENTATION, AS(indentation), "indentation depth", SI(INDENTATION))          \
    X(COLLECTED_FORCE_FORCE, AS(force),                                                            \
      "force above the baseline, of the curve with the median modulus", SI(FORCE))
#define COLLECTED_FORCE_KEYS(X)

/* Each row is a pair of cases of one sample or condition: the ratio of their modulus ratios. */
#define RATIO_PAIRS_COLUMNS(X)                                                                     \
    X(RATIO_PAIRS_OF, AS(of), "sample or condition that both have", TEXT, LABEL("Of"))             \
    X(RATIO_PAIRS_FIRST, AS(first), "condition or sample of the first", TEXT, LABEL("First"))      \
    X(RATIO_PAIRS_SECOND, AS(second), "that of the second", TEXT, LABEL("Second"))                 \
    VALUE_AND_INTERVAL(X, RATIO_PAIRS_RATIO, "ratio",                                              \
                       "modulus ratio of the first over that of the second", NUMBER, SHOWS(ratio), \
                       LABEL("Ratio of the ratios"), SPARSE)                                       \
    X(RATIO_PAIRS_DF, AS(df), "degrees of freedom of its error; nan: a normal one", NUMBER,        \
      LABEL("Degrees of freedom"), SPARSE)                                                         \
    X(RATIO_PAIRS_P, AS(p), "two-sided p of Welch's test of their logarithms", NUMBER, LABEL("p"), \
      DIGITS(2), SPARSE)                                                                           \
    X(RATIO_PAIRS_HOLM_P, AS(holm_p), "p after Holm's correction for the number of pairs", NUMBER, \
      LABEL("p (Holm)"), DIGITS(2), SPARSE)                                                        \
    X(RATIO_PAIRS_DIFFER, AS(differ), "do they differ: yes, no within the margin, inconclusive",   \
      ENUM(stated_verdict), LABEL("Differ"))                                                       \
    X(RATIO_PAIRS_RATES, AS(rates),                                                                \
      "indentation rates that both have, at which they are compared; nan: none, the ratios of "    \
      "all rates are compared",                                                                    \
      NUMBER, LABEL("Common rates"), SPARSE)                                                       \
    X(RATIO_PAIRS_INTERACTION_P, AS(interaction_p),                                                \
      "p of the test whether the difference depends on the rate", NUMBER, LABEL("p (rate)"),       \
      DIGITS(2), SPARSE)
#define RATIO_PAIRS_KEYS(X)                                                                        \
    X(RATIO_PAIRS_KEY_PAIRS, AS(pairs), NUMBER, LABEL("Pairs compared"))                           \
    X(RATIO_PAIRS_KEY_DIFFERENT, "pairs_that_differ", NUMBER, SHOWS(different),                    \
      LABEL("Pairs that differ"), HEADLINE("Pairs that differ"))                                   \
    X(RATIO_PAIRS_KEY_UNDECIDED, AS(undecided), NUMBER,                                            \
      LABEL("Pairs with an inconclusive verdict"))                                                 \
    X(RATIO_PAIRS_KEY_INCLUDES, AS(includes), TEXT, LABEL("The intervals include"))                \
    X(RATIO_PAIRS_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("How to decide the others"),         \
      OPTIONAL)                                                                                    \
    X(RATIO_PAIRS_KEY_MARGIN, "equivalence_margin", PLAIN, SHOWS(margin),                          \
      LABEL("Margin within which they are alike"))

#endif
