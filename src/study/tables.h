/* Columns and keys of the tables that compare groups of curves. Only the table registry includes
 * this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_H
#define WT_STUDY_TABLES_H

/* A group without an accepted curve has only its numbers of curves. */
#define ANALYSIS_UNITS(X)                                                                          \
    X(UNIT_IS_CURVE, "curve")                                                                      \
    X(UNIT_IS_SPOT, "spot")

#define RATE_MATCHES(X)                                                                            \
    X(RATES_COMMON, "those that both groups have")                                                 \
    X(RATES_BROUGHT, "brought to one")                                                             \
    X(RATES_NOT_KNOWN, "not known")

#define CANTILEVER_COUNTS(X)                                                                       \
    X(ONE_CANTILEVER, "one")                                                                       \
    X(TWO_CANTILEVERS, "two")

/* Kinds of errors of a budget. */
#define ERROR_KINDS(X)                                                                             \
    X(ERROR_SCATTER, "scatter")                                                                    \
    X(ERROR_BESIDE, "beside") /* of one curve or spot, not in the sum */                           \
    X(ERROR_SHARED, "shared")                                                                      \
    X(ERROR_MEASURED, "measured")                                                                  \
    X(ERROR_DRAWS, "draws")                                                                        \
    X(ERROR_NUMERICAL, "numerical")                                                                \
    X(ERROR_MODEL, "model")                                                                        \
    X(ERROR_TOGETHER, "together")

#define MODULUS_GROUPS_COLUMNS(X)                                                                  \
    X(MODULUS_GROUPS_GROUP, AS(group), "group of curves", TEXT, LABEL("Group"))                    \
    X(MODULUS_GROUPS_N, IN(data, n), "curves used", NUMBER, LABEL("Curves n"))                     \
    X(MODULUS_GROUPS_N_REJECTED, IN(data, n_rejected), "rejected curves", NUMBER,                  \
      LABEL("Rejected"))                                                                           \
    X(MODULUS_GROUPS_N_SPOTS, IN(summary, n_spots), "places on the sample", NUMBER,                \
      LABEL("Spots"))                                                                              \
    X(MODULUS_GROUPS_MEAN, IN(summary, mean), "mean modulus of the curves", SI(MODULUS),           \
      LABEL("Mean"), LIKE(MODULUS_GROUPS_GEOMETRIC_MEAN), SPARSE)                                  \
    X(MODULUS_GROUPS_STANDARD_DEVIATION, IN(summary, standard_deviation),                          \
      "standard deviation of the curves", SI(MODULUS), LABEL("Standard deviation"),                \
      LIKE(MODULUS_GROUPS_GEOMETRIC_MEAN), SPARSE)                                                 \
    X(MODULUS_GROUPS_MEDIAN, IN(summary, median), "median modulus of the curves", SI(MODULUS),     \
      LABEL("Median"), LIKE(MODULUS_GROUPS_GEOMETRIC_MEAN), SPARSE)                                \
    X(MODULUS_GROUPS_GEOMETRIC_MEAN, "geometric_mean", "geometric mean of the spots", SI(MODULUS), \
      SHOWS(modulus), LABEL("Geometric mean"), INTERVAL(MODULUS_GROUPS_LOW, MODULUS_GROUPS_HIGH),  \
      SPARSE)                                                                                      \
    INTERVAL_COLUMNS(X, MODULUS_GROUPS, "", SI(MODULUS), LIKE(MODULUS_GROUPS_GEOMETRIC_MEAN),      \
                     SPARSE)
#define MODULUS_GROUPS_KEYS(X)

/* Components of the standard error of a group. All errors are relative errors of the modulus, so
 * that their squares add. */
#define MODULUS_BUDGET_COLUMNS(X)                                                                  \
    X(MODULUS_BUDGET_GROUP, AS(group), "group of curves", TEXT, LABEL("Group"))                    \
    X(MODULUS_BUDGET_SOURCE, "source", "where the error comes from", TEXT, SHOWS(part.words),      \
      LABEL("Source"))                                                                             \
    X(MODULUS_BUDGET_KIND, AS(kind),                                                               \
      "shared: by all curves of the group; scatter: of the mean of the spots; together: the root " \
      "of "                                                                                        \
      "the sum of their squares; beside: of one curve or spot, not in the sum",                    \
      ENUM(error_kind), LABEL("Kind"))                                                             \
    X(MODULUS_BUDGET_SOURCE_ERROR, IN(part, source_error),                                         \
      "relative standard error of the source; nan: not known", NUMBER, LABEL("Its error"),         \
      MISSING("not known"), SPARSE)                                                                \
    X(MODULUS_BUDGET_GAIN, IN(part, gain),                                                         \
      "relative change of the modulus per relative change of the source, curves fitted anew",      \
      NUMBER, LABEL("Gain"), STANDARD_ERROR(MODULUS_BUDGET_GAIN), SPARSE)                          \
    X(MODULUS_BUDGET_GAIN_STANDARD_ERROR, "gain_standard_error",                                   \
      "standard error of the mean gain of the curves fitted anew", NUMBER, SPARSE)                 \
    X(MODULUS_BUDGET_RELATIVE_ERROR, "relative_error", "relative standard error of the modulus",   \
      NUMBER, SHOWS(part.error), LABEL("Error of the modulus"), MISSING("not known"))              \
    X(MODULUS_BUDGET_SHARE, AS(share), "of the variance of all together", NUMBER,                  \
      LABEL("Share of the variance"))
/* Each key exists once for every group. */
#define MODULUS_BUDGET_KEYS(X)                                                                     \
    X(MODULUS_BUDGET_KEY_MODULUS, "modulus_", SI(MODULUS), SHOWS(modulus), OPTIONAL)               \
    X(MODULUS_BUDGET_KEY_DF, "df_", NUMBER, SHOWS(df), OPTIONAL)                                   \
    X(MODULUS_BUDGET_KEY_LOW, "low_", SI(MODULUS), SHOWS(low), OPTIONAL)                           \
    X(MODULUS_BUDGET_KEY_HIGH, "high_", SI(MODULUS), SHOWS(high), OPTIONAL)                        \
    X(MODULUS_BUDGET_KEY_SAYS, "says_", TEXT, SHOWS(says), OPTIONAL)

/* A row that cannot be compared has only its numbers of curves and spots. */
#define COMPARISON_COLUMNS(X)                                                                      \
    X(COMPARISON_RATE_LOW, "rate_low", "smallest indentation rate of the row; nan = all rates",    \
      SI(VELOCITY), SHOWS(low), LABEL("Indentation rate from"), LIKE(COMPARISON_RATE_HIGH),        \
      MISSING("all"))                                                                              \
    X(COMPARISON_RATE_HIGH, "rate_high", "largest indentation rate of the row; nan = all rates",   \
      SI(VELOCITY), SHOWS(high), LABEL("to"), MISSING("all"))                                      \
    X(COMPARISON_N_BULK, "n_bulk", "bulk curves compared", NUMBER, SHOWS(n[0]), LABEL("n bulk"))   \
    X(COMPARISON_N_TRACK, "n_track", "wear-track curves compared", NUMBER, SHOWS(n[1]),            \
      LABEL("n track"))                                                                            \
    X(COMPARISON_SPOTS_BULK, "spots_bulk", "bulk spots compared: the units of the tests", NUMBER,  \
      SHOWS(c.n_bulk), LABEL("Spots bulk"))                                                        \
    X(COMPARISON_SPOTS_TRACK, "spots_track", "wear-track spots compared", NUMBER,                  \
      SHOWS(c.n_track), LABEL("Spots track"))                                                      \
    X(COMPARISON_RATIO, IN(c, ratio), "modulus of the track over that of the bulk", NUMBER,        \
      LABEL("Track / bulk"), SPARSE)                                                               \
    INTERVAL_COLUMNS(X, COMPARISON_RATIO, "ratio_", NUMBER, SPARSE)                                \
    X(COMPARISON_WELCH_T, "welch_t", "Welch's t of ln E", NUMBER, SHOWS(c.t), LABEL("Welch t"),    \
      SPARSE)                                                                                      \
    X(COMPARISON_WELCH_DF, "welch_df", "its degrees of freedom", NUMBER, SHOWS(c.df),              \
      LABEL("Degrees of freedom"), SPARSE)                                                         \
    X(COMPARISON_WELCH_P, "welch_p", "its two-sided p", NUMBER, SHOWS(c.p), LABEL("p (Welch)"),    \
      DIGITS(2), SPARSE)                                                                           \
    X(COMPARISON_HOLM_P, "holm_p", "p after Holm's correction for the number of rates", NUMBER,    \
      SHOWS(holm), LABEL("p (Holm)"), DIGITS(2), SPARSE)                                           \
    X(COMPARISON_MANN_WHITNEY_P, IN(c, mann_whitney_p), "two-sided p of the Mann-Whitney test",    \
      NUMBER, LABEL("p (Mann-Whitney)"), DIGITS(2), SPARSE)                                        \
    X(COMPARISON_MANN_WHITNEY_SMALLEST_P, IN(c, mann_whitney_smallest_p),                          \
      "smallest p of that test with so few spots", NUMBER, LABEL("its smallest p"), DIGITS(2),     \
      SPARSE)                                                                                      \
    X(COMPARISON_EFFECT_SIZE, IN(c, effect_size), "Hedges' g of ln E", NUMBER,                     \
      LABEL("Effect size"), SPARSE)

/* The ratio of all rates also has a key, if it exists. A normal error has no degrees of freedom. */
#define COMPARISON_KEYS(X)                                                                         \
    X(COMPARISON_KEY_DIFFERS, AS(differs), ENUM(stated_verdict),                                   \
      LABEL("Does the wear track differ"))                                                         \
    X(COMPARISON_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("How to decide it"), OPTIONAL)        \
    X(COMPARISON_KEY_WOULD_EXPLAIN, AS(would_explain), TEXT,                                       \
      LABEL("What else would make this ratio"), OPTIONAL)                                          \
    X(COMPARISON_KEY_UNIT_OF_ANALYSIS, "unit_of_analysis", ENUM(analysis_unit), SHOWS(unit),       \
      LABEL("Unit of analysis"))                                                                   \
    X(COMPARISON_KEY_RATES, "rates_compared", ENUM(rate_match), SHOWS(rates),                      \
      LABEL("Rates compared"))                                                                     \
    X(COMPARISON_KEY_INCLUDES, "interval_includes", TEXT, SHOWS(includes),                         \
      LABEL("The interval includes"), OPTIONAL)                                                    \
    X(COMPARISON_KEY_CANTILEVERS, AS(cantilevers), ENUM(cantilever_count), LABEL("Cantilevers"))   \
    X(COMPARISON_KEY_CANCELS, AS(cancels), TEXT, LABEL("Errors that cancel in the ratio"),         \
      OPTIONAL)                                                                                    \
    X(COMPARISON_KEY_MARGIN, "equivalence_margin", PLAIN, SHOWS(margin),                           \
      LABEL("Margin within which they are alike"))                                                 \
    X(COMPARISON_KEY_RATE_SLOPE, AS(rate_slope), NUMBER, LABEL("Slope of ln E against ln rate"),   \
      OPTIONAL)                                                                                    \
    X(COMPARISON_KEY_INTERACTION_P, AS(interaction_p), NUMBER,                                     \
      LABEL("p of one slope in both groups"), OPTIONAL)                                            \
    X(COMPARISON_KEY_MODULUS_RATIO, "modulus_ratio", NUMBER, SHOWS(ratio), LABEL("Modulus ratio"), \
      OPTIONAL)                                                                                    \
    X(COMPARISON_KEY_MODULUS_RATIO_DF, "modulus_ratio_df", NUMBER, SHOWS(ratio_df),                \
      LABEL("Degrees of freedom of its error"), OPTIONAL)                                          \
    X(COMPARISON_KEY_CHOICES_LOW, "model_choices_low", NUMBER, SHOWS(choices.low), OPTIONAL)       \
    X(COMPARISON_KEY_CHOICES_HIGH, "model_choices_high", NUMBER, SHOWS(choices.high), OPTIONAL)    \
    X(COMPARISON_KEY_WIDEST_CHOICE, "widest_choice", TEXT, SHOWS(choices.widest), OPTIONAL)        \
    X(COMPARISON_KEY_CHOICE_REMEDY, "widest_choice_settled_by", TEXT, SHOWS(choices.remedy),       \
      OPTIONAL)                                                                                    \
    X(COMPARISON_KEY_RATE_SPREAD, AS(rate_spread), NUMBER,                                         \
      LABEL("Half the range of its logarithm over the rates, in its error"), OPTIONAL)             \
    X(COMPARISON_KEY_CALIBRATION_SHARE, AS(calibration_share), NUMBER,                             \
      LABEL("Share of calibration and temperature in it"), OPTIONAL)                               \
    X(COMPARISON_KEY_SPOT_SCATTER, AS(spot_scatter), NUMBER,                                       \
      LABEL("Scatter from spot to spot, as given"), OPTIONAL)

/* Measured moduli, and those of layers with the same ratio of the moduli at the depth of the
 * curves. */
#define TRACK_LAYER_COLUMNS(X)                                                                     \
    X(TRACK_LAYER_CURVE, AS(curve), "bulk, track, or a layer of which thickness", TEXT,            \
      LABEL("Curve"))                                                                              \
    X(TRACK_LAYER_DEPTH, AS(depth), "indentation depth", SI(INDENTATION), LABEL("Depth"))          \
    X(TRACK_LAYER_MODULUS, AS(modulus),                                                            \
      "modulus of a homogeneous rubber with the force at this depth", SI(MODULUS),                 \
      LABEL("Modulus at this depth"), INTERVAL(TRACK_LAYER_LOW, TRACK_LAYER_HIGH))                 \
    INTERVAL_COLUMNS(X, TRACK_LAYER, "", SI(MODULUS))

/* A limit is missing if it does not exist. */
#define TRACK_LAYER_KEYS(X)                                                                        \
    X(TRACK_LAYER_KEY_ALLOWED, AS(allowed), TEXT, LABEL("Thickness that the curves allow"))        \
    X(TRACK_LAYER_KEY_AGREE, AS(agree), TEXT, LABEL("Do curves and theory agree on it"), OPTIONAL) \
    X(TRACK_LAYER_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("How to decide it"), OPTIONAL)       \
    X(TRACK_LAYER_KEY_DEPTH, AS(deepest), SI(INDENTATION),                                         \
      LABEL("Indentation, mean of the track"), OPTIONAL)                                           \
    X(TRACK_LAYER_KEY_RADIUS, AS(contact_radius), SI(LENGTH), LABEL("Contact radius there"),       \
      OPTIONAL)                                                                                    \
    X(TRACK_LAYER_KEY_THICKNESS, AS(thickness), SI(LENGTH), LABEL("Thickness by the curves"),      \
      OPTIONAL)                                                                                    \
    X(TRACK_LAYER_KEY_LOW, "thickness_low", SI(LENGTH), SHOWS(low),                                \
      LABEL("Its 95 % interval from"), OPTIONAL)                                                   \
    X(TRACK_LAYER_KEY_HIGH, "thickness_high", SI(LENGTH), SHOWS(high), LABEL("to"), OPTIONAL)      \
    X(TRACK_LAYER_KEY_LEAST, "thinnest_tried", SI(LENGTH), SHOWS(least),                           \
      LABEL("Thinnest that was tried"), OPTIONAL)                                                  \
    X(TRACK_LAYER_KEY_RATIO, "layer_to_bulk", NUMBER, SHOWS(layer_ratio),                          \
      LABEL("Modulus of such a layer over that of the bulk"), OPTIONAL)                            \
    X(TRACK_LAYER_KEY_OTHER, "other_thickness", SI(LENGTH), SHOWS(other),                          \
      LABEL("Thickness otherwise"), OPTIONAL)                                                      \
    X(TRACK_LAYER_KEY_OTHER_LOW, AS(other_low), SI(LENGTH), LABEL("Its 95 % interval from"),       \
      OPTIONAL)                                                                                    \
    X(TRACK_LAYER_KEY_OTHER_HIGH, AS(other_high), SI(LENGTH), LABEL("to"), OPTIONAL)               \
    X(TRACK_LAYER_KEY_OTHER_FROM, AS(other_from), TEXT, LABEL("Where that is from"), OPTIONAL)     \
    X(TRACK_LAYER_KEY_BOTH_LOW, AS(both_low), SI(LENGTH), LABEL("Both allow from"), OPTIONAL)      \
    X(TRACK_LAYER_KEY_BOTH_HIGH, AS(both_high), SI(LENGTH), LABEL("to"), OPTIONAL)                 \
    X(TRACK_LAYER_KEY_OVER_LOW, AS(over_low), NUMBER, LABEL("Otherwise over by the curves, from"), \
      OPTIONAL)                                                                                    \
    X(TRACK_LAYER_KEY_OVER_HIGH, AS(over_high), NUMBER, LABEL("to"), OPTIONAL)

#define MODULUS_RATE_COLUMNS(X)                                                                    \
    X(MODULUS_RATE_GROUP, AS(group), "bulk or track", TEXT)                                        \
    X(MODULUS_RATE_RATE, "indentation_rate", "geometric mean of the indentation rate",             \
      SI(VELOCITY), SHOWS(point.rate))                                                             \
    X(MODULUS_RATE_EQUIVALENT_FREQUENCY, "equivalent_frequency",                                   \
      "angular frequency of equal loading", SI(ANGULAR_FREQUENCY), SHOWS(point.frequency))         \
    X(MODULUS_RATE_N, IN(point, n), "accepted curves", NUMBER)                                     \
    X(MODULUS_RATE_GEOMETRIC_MEAN, "geometric_mean", "geometric mean of the modulus", SI(MODULUS), \
      SHOWS(modulus), INTERVAL(MODULUS_RATE_LOW, MODULUS_RATE_HIGH))                               \
    INTERVAL_COLUMNS(X, MODULUS_RATE, "", SI(MODULUS))
#define MODULUS_RATE_KEYS(X)

/* Without a frequency there is no DMA modulus for the comparison. */
#define DMA_COMPARISON_COLUMNS(X)                                                                  \
    X(DMA_COMPARISON_GROUP, AS(group), "bulk or track", TEXT, LABEL("Group"))                      \
    X(DMA_COMPARISON_EQUIVALENT_FREQUENCY, "equivalent_frequency",                                 \
      "angular frequency of equal loading", SI(ANGULAR_FREQUENCY), SHOWS(frequency),               \
      LABEL("Equivalent frequency"))                                                               \
    X(DMA_COMPARISON_MODULUS, "indentation_modulus", "geometric mean of the modulus", SI(MODULUS), \
      SHOWS(modulus), LABEL("Indentation"), INTERVAL(DMA_COMPARISON_LOW, DMA_COMPARISON_HIGH))     \
    INTERVAL_COLUMNS(X, DMA_COMPARISON, "", SI(MODULUS), LIKE(DMA_COMPARISON_MODULUS))             \
    X(DMA_COMPARISON_STORAGE_MODULUS, "dma_storage_modulus", "E' of the DMA at this frequency",    \
      SI(STORAGE_MODULUS), SHOWS(storage), LABEL("DMA E′"), LIKE(DMA_COMPARISON_MODULUS), SPARSE)  \
    X(DMA_COMPARISON_COMPLEX_MODULUS, "dma_complex_modulus", "|E*| of the DMA at this frequency",  \
      SI(COMPLEX_MODULUS), SHOWS(dma), LABEL("DMA |E*|"), LIKE(DMA_COMPARISON_MODULUS),            \
      STANDARD_ERROR(DMA_COMPARISON_COMPLEX_MODULUS), SPARSE)                                      \
    X(DMA_COMPARISON_COMPLEX_MODULUS_STANDARD_ERROR, "dma_complex_modulus_standard_error",         \
      "its standard error, by the draws of the material; nan: not known", SI(COMPLEX_MODULUS),     \
      LABEL("Standard error"), LIKE(DMA_COMPARISON_MODULUS), SPARSE)                               \
    X(DMA_COMPARISON_RATIO, AS(ratio), "indentation modulus over |E*|", NUMBER,                    \
      LABEL("Indentation / DMA"), SPARSE)                                                          \
    X(DMA_COMPARISON_EXTRAPOLATED, AS(extrapolated), "1: outside the frequencies measured by DMA", \
      YES_NO, LABEL("Outside measured frequencies"), SPARSE)

#define DMA_COMPARISON_KEYS(X)                                                                     \
    X(DMA_COMPARISON_KEY_TEMPERATURE, AS(temperature), SI(TEMPERATURE))                            \
    X(DMA_COMPARISON_KEY_TRACK_TEMPERATURE, AS(track_temperature), SI(TEMPERATURE), OPTIONAL)      \
    X(DMA_COMPARISON_KEY_RATIO_OF, AS(ratio_of), TEXT)                                             \
    X(DMA_COMPARISON_KEY_ERROR_LACKS, "standard_error_excludes", ENUM(error_source), SHOWS(lacks), \
      LABEL("No error known of"), OPTIONAL)                                                        \
    X(DMA_COMPARISON_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, SHOWS(statement), OPTIONAL)

#endif
