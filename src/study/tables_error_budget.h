/* Columns and keys of the table "error_budget": contribution of each error to a number, and its
 * computation time. Only the table registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_ERROR_BUDGET_H
#define WT_STUDY_TABLES_ERROR_BUDGET_H

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
    X(ERROR_BUDGET_REMEDY, IN(of, remedy), "what makes it smaller", TEXT,                          \
      LABEL("What makes it smaller"))

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

#endif
