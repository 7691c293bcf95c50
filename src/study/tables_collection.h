/* Columns and keys of the tables of collected cases. Only the table registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_COLLECTION_H
#define WT_STUDY_TABLES_COLLECTION_H

/* What cases have in common. */
#define SHARING_LEVELS(X)                                                                          \
    X(OF_SAMPLE, "sample")                                                                         \
    X(OF_CONDITION, "condition")                                                                   \
    X(OF_ALL, "all cases")

/* Does one value of a constant suffice? */
#define SHARING_VERDICTS(X)                                                                        \
    X(SHARING_INCONCLUSIVE, "inconclusive")                                                        \
    X(SHARING_ONE, "one")                                                                          \
    X(SHARING_DIFFERS, "differs")

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

#define OF_CONSTANT(X, ID)                                                                         \
    X(ID##_CONSTANT, AS(constant), "what is compared", TEXT, LABEL("Constant"))                    \
    X(ID##_OVER, AS(over), "what the cases have in common: sample, condition, or all cases", TEXT, \
      LABEL("Common to"))                                                                          \
    X(ID##_OF, AS(of), "its name", TEXT, LABEL("Of"))

/* Each row is a constant that cases may share. */
#define SHARED_CONSTANTS_COLUMNS(X)                                                                \
    OF_CONSTANT(X, SHARED_CONSTANTS)                                                               \
    VALUE_AND_INTERVAL(X, SHARED_CONSTANTS_VALUE, "value", "shared value, weighted by the errors", \
                       NUMBER, SHOWS(value), LABEL("Shared value"), SPARSE)                        \
    X(SHARED_CONSTANTS_UNIT, AS(unit), "unit of the three numbers before", TEXT, LABEL("Unit"))    \
    X(SHARED_CONSTANTS_N, AS(n), "values that it is of", NUMBER, LABEL("Values"))                  \
    X(SHARED_CONSTANTS_CHI_SQUARED, AS(chi_squared), "chi-squared of their scatter about it",      \
      NUMBER, LABEL("Chi-squared"), DIGITS(3))                                                     \
    X(SHARED_CONSTANTS_DF, AS(df), "its degrees of freedom", NUMBER, LABEL("Degrees of freedom"))  \
    X(SHARED_CONSTANTS_P, AS(p), "chance of as much scatter if one value is behind them", NUMBER,  \
      LABEL("p"), DIGITS(2))                                                                       \
    X(SHARED_CONSTANTS_HOLM_P, AS(holm_p), "p after Holm's correction for the number of rows",     \
      NUMBER, LABEL("p (Holm)"), DIGITS(2))                                                        \
    X(SHARED_CONSTANTS_SUFFICES, AS(suffices),                                                     \
      "does one value suffice: one, differs, inconclusive", ENUM(sharing_verdict),                 \
      LABEL("One value"))
#define SHARED_CONSTANTS_KEYS(X)                                                                   \
    X(SHARED_CONSTANTS_KEY_TESTED, "constants_tested", NUMBER, SHOWS(tested),                      \
      LABEL("Constants tested"))                                                                   \
    X(SHARED_CONSTANTS_KEY_DIFFERENT, "constants_that_differ", NUMBER, SHOWS(different),           \
      LABEL("Constants that differ"))                                                              \
    X(SHARED_CONSTANTS_KEY_UNDECIDED, AS(undecided), NUMBER,                                       \
      LABEL("Constants with an inconclusive verdict"))                                             \
    X(SHARED_CONSTANTS_KEY_INCLUDES, AS(includes), TEXT, LABEL("The intervals include"))           \
    X(SHARED_CONSTANTS_KEY_LEFT_OUT, AS(left_out), TEXT, LABEL("Cases that are not in them"),      \
      OPTIONAL)                                                                                    \
    X(SHARED_CONSTANTS_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("How to decide the others"),    \
      OPTIONAL)                                                                                    \
    X(SHARED_CONSTANTS_KEY_MARGIN, "constant_margin", PLAIN, SHOWS(margin),                        \
      LABEL("Margin within which they are alike"))

/* Each block has the values behind one shared value. */
#define SHARED_MEMBERS_COLUMNS(X)                                                                  \
    OF_CONSTANT(X, SHARED_MEMBERS)                                                                 \
    X(SHARED_MEMBERS_MEMBER, AS(member), "case, and bulk or track where it has both", TEXT,        \
      LABEL("Case"))                                                                               \
    X(SHARED_MEMBERS_NUMBER, AS(number), "its number", NUMBER)                                     \
    X(SHARED_MEMBERS_VALUE, AS(value), "its own value", NUMBER, LABEL("Value"), DIGITS(4))         \
    X(SHARED_MEMBERS_UNIT, AS(unit), "unit of that", TEXT, LABEL("Unit"))                          \
    VALUE_AND_INTERVAL(X, SHARED_MEMBERS_RATIO, "ratio",                                           \
                       "over the shared one; the intervals of all of a constant hold together in " \
                       "95 %",                                                                     \
                       NUMBER, SHOWS(ratio), LABEL("Over the shared one"), SPARSE)
#define SHARED_MEMBERS_KEYS(X)

/* Critical energy and wear rate with their correlation. */
#define OF_PAIR(X, ID)                                                                             \
    NUMBER_AND_INTERVAL(X, ID##_ENERGY, "critical_energy", "critical energy U_c",                  \
                        SI(ENERGY_DENSITY), "Critical energy", SHOWS(energy))                      \
    NUMBER_AND_INTERVAL(X, ID##_WEAR, "specific_wear_rate", "specific wear rate k", SI(WEAR_RATE), \
                        "Specific wear rate", SHOWS(wear))                                         \
    X(ID##_CORRELATION, IN(axes, correlation), "correlation of ln U_c and ln k", NUMBER,           \
      DIGITS(2), LABEL("Correlation"), SPARSE)                                                     \
    X(ID##_LOOSE, IN(axes, loose), "the combination that is known least", TEXT,                    \
      LABEL("Known least"))                                                                        \
    X(ID##_LOOSE_ERROR, IN(axes, loose_error), "standard deviation along it, of the logarithms",   \
      NUMBER, DIGITS(2), LABEL("to"), SPARSE)                                                      \
    X(ID##_TIGHT_ERROR, IN(axes, tight_error), "standard deviation across it, of the logarithms",  \
      NUMBER, DIGITS(2), LABEL("Across it"), SPARSE)

/* Each row is one method of determination for one case. */
#define COLLECTED_CONSTANTS_COLUMNS(X)                                                             \
    OF_CASE(X, COLLECTED_CONSTANTS)                                                                \
    X(COLLECTED_CONSTANTS_BY, AS(by), "what they are known by", TEXT, LABEL("By"))                 \
    OF_PAIR(X, COLLECTED_CONSTANTS)
#define COLLECTED_CONSTANTS_KEYS(X)

/* Each row is a pair that cases may share, by one method. */
#define SHARED_PAIRS_COLUMNS(X)                                                                    \
    X(SHARED_PAIRS_BY, AS(by), "what they are known by", TEXT, LABEL("By"))                        \
    X(SHARED_PAIRS_OVER, AS(over),                                                                 \
      "what the cases have in common: sample, condition, or all "                                  \
      "cases",                                                                                     \
      ENUM(sharing_level), LABEL("Common to"))                                                     \
    X(SHARED_PAIRS_OF, AS(of), "its name", TEXT, LABEL("Of"))                                      \
    X(SHARED_PAIRS_N, AS(n), "cases that it is of", NUMBER, LABEL("Cases"))                        \
    X(SHARED_PAIRS_ONE_ENERGY, AS(one_energy),                                                     \
      "does one critical energy suffice: one, differs, inconclusive", ENUM(sharing_verdict),       \
      LABEL("One U_c"))                                                                            \
    X(SHARED_PAIRS_ONE_WEAR, AS(one_wear),                                                         \
      "does one wear rate suffice: one, differs, inconclusive", ENUM(sharing_verdict),             \
      LABEL("One k"))                                                                              \
    X(SHARED_PAIRS_ONE_PAIR, AS(one_pair),                                                         \
      "does one pair of both suffice: one, differs, inconclusive", ENUM(sharing_verdict),          \
      LABEL("One pair"))                                                                           \
    OF_PAIR(X, SHARED_PAIRS)                                                                       \
    X(SHARED_PAIRS_CHI_SQUARED, AS(chi_squared), "chi-squared of the scatter of the pairs",        \
      NUMBER, LABEL("Chi-squared"), DIGITS(3))                                                     \
    X(SHARED_PAIRS_DF, AS(df), "its degrees of freedom", NUMBER, LABEL("Degrees of freedom"))      \
    X(SHARED_PAIRS_HOLM_P, AS(holm_p),                                                             \
      "chance of as much scatter if one pair is behind them, after Holm's correction for the "     \
      "number of tests of the table",                                                              \
      NUMBER, LABEL("p (Holm)"), DIGITS(2))
#define SHARED_PAIRS_KEYS(X)                                                                       \
    X(SHARED_PAIRS_KEY_ONE, "one_layer_constants", ENUM(sharing_verdict), SHOWS(one_of_all),       \
      HEADLINE("One critical energy and wear rate of all layers"), OPTIONAL)                       \
    X(SHARED_PAIRS_KEY_TESTS, "tests", NUMBER, SHOWS(tests), LABEL("Tests"))                       \
    X(SHARED_PAIRS_KEY_LEFT_OUT, AS(left_out), TEXT, LABEL("Cases that are not in them"),          \
      OPTIONAL)                                                                                    \
    X(SHARED_PAIRS_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("How to decide the others"),        \
      OPTIONAL)                                                                                    \
    X(SHARED_PAIRS_KEY_MARGIN, "constant_margin", PLAIN, SHOWS(margin),                            \
      LABEL("Margin within which they are alike"))

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
