/* Columns and keys of the tables about a run and its files. Only tables.h includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_TABLES_H
#define WT_CASE_TABLES_H

/* Closed list of the verdicts of a finding; the text of each is the same in all outputs. */
#define FINDING_VERDICTS(X)                                                                        \
    X(FINDING_YES, "yes")             /* interval and model range on one side of the reference */  \
    X(FINDING_SAME, "same")           /* interval within the margin of equivalence */              \
    X(FINDING_PREDICTED, "predicted") /* a theoretical value that no measurement here tests */     \
    X(FINDING_INCONCLUSIVE, "inconclusive") /* interval or model range includes the reference */   \
    X(FINDING_NOT_ENOUGH_DATA, "not enough data") /* a value without an interval */                \
    X(FINDING_NOT_COMPUTED, "not computed")       /* an input is missing */

#define FINDING_BASES(X)                                                                           \
    X(FINDING_MEASURED, "measured")                                                                \
    X(FINDING_FROM_THEORY, "predicted")                                                            \
    X(FINDING_GIVEN, "given")

#define LIMIT_SUBJECTS(X)                                                                          \
    X(LIMITS_DATA, "data")                                                                         \
    X(LIMITS_MATERIAL, "material")                                                                 \
    X(LIMITS_INDENTATION, "indentation")                                                           \
    X(LIMITS_FRICTION, "friction")                                                                 \
    X(LIMITS_LAYER, "layer")

#define LIMITS_COLUMNS(X)                                                                          \
    X(LIMITS_SEVERITY, AS(severity), "warning: a number may be off; note: what it assumes",        \
      ENUM(severity), LABEL("Severity"))                                                           \
    X(LIMITS_SUBJECT, AS(subject), "data, material, indentation, friction or layer",               \
      ENUM(limit_subject), LABEL("Subject"))                                                       \
    X(LIMITS_LIMIT, AS(limit), "limit of the result", TEXT, LABEL("Limit"))
#define LIMITS_KEYS(X)

#define ANSWER_COLUMNS(X)                                                                          \
    X(ANSWER_QUESTION, AS(question), "question of the user", TEXT, LABEL("Question"))              \
    X(ANSWER_VERDICT, AS(verdict),                                                                 \
      "yes, same, predicted, inconclusive, not enough data or not computed",                       \
      ENUM(finding_verdict), OPTIONAL, LABEL("Verdict"))                                           \
    X(ANSWER_BASIS, AS(basis), "measured, predicted or given", ENUM(finding_basis), OPTIONAL,      \
      LABEL("Basis"))                                                                              \
    X(ANSWER_VALUE, AS(value), "number behind the verdict, in the unit beside it", NUMBER,         \
      OPTIONAL, LABEL("Value"))                                                                    \
    X(ANSWER_LOW, AS(low), "lower end of its 95 % interval", NUMBER, OPTIONAL)                     \
    X(ANSWER_HIGH, AS(high), "upper end of its 95 % interval", NUMBER, OPTIONAL)                   \
    X(ANSWER_RANGE_LOW, AS(range_low), "least value over the model choices", NUMBER, OPTIONAL)     \
    X(ANSWER_RANGE_HIGH, AS(range_high), "largest value over the model choices", NUMBER, OPTIONAL) \
    X(ANSWER_UNIT, AS(unit), "unit of the number, its interval and range", TEXT, OPTIONAL)         \
    X(ANSWER_WIDEST, AS(widest), "model choice that changes the number most", TEXT, OPTIONAL)      \
    X(ANSWER_ANSWER, AS(answer), "the verdict in one sentence, or why there is none", TEXT,        \
      LABEL("Answer"))                                                                             \
    X(ANSWER_REMEDY, AS(remedy), "what would make the answer more certain", TEXT, OPTIONAL,        \
      LABEL("To settle it"))
#define ANSWER_KEYS(X)                                                                             \
    X(ANSWER_KEY_CASE_TITLE, "case_title", TEXT, OPTIONAL)                                         \
    X(ANSWER_KEY_CASE_SAMPLE, "case_sample", TEXT, OPTIONAL)                                       \
    X(ANSWER_KEY_CASE_CONDITION, "case_condition", TEXT, OPTIONAL)

#define INPUTS_COLUMNS(X)                                                                          \
    X(INPUTS_PATH, "path", "path as given", TEXT, LABEL("File"))                                   \
    X(INPUTS_ROLE, "role", "what it was used for", ENUM(input_role), LABEL("Role"))                \
    X(INPUTS_FORMAT, "format", "format it was read as", TEXT, LABEL("Format"))                     \
    X(INPUTS_INSTRUMENT, "instrument", "instrument that the file states, and the kind of export",  \
      TEXT, OPTIONAL, SPARSE, LABEL("Instrument"))                                                 \
    X(INPUTS_BYTES, "bytes", "size of the file", SI(DATA_SIZE), LABEL("Size"))                     \
    X(INPUTS_SHA256, "sha256", "SHA-256 digest of the file", TEXT, LABEL("SHA-256"))
#define INPUTS_KEYS(X)

#define NOTES_COLUMNS(X)                                                                           \
    X(NOTES_SEVERITY, AS(severity), "note, warning or loss", ENUM(severity), LABEL("Severity"))    \
    X(NOTES_FILE, AS(file), "file it is about", TEXT, LABEL("File"))                               \
    X(NOTES_PLACE, IN(entry, place), "first place in the file", TEXT, LABEL("Place"))              \
    X(NOTES_TEXT, IN(entry, text), "what was noticed", TEXT, LABEL("Note"))                        \
    X(NOTES_COUNT, IN(entry, count), "how often", NUMBER, LABEL("Times"))
#define NOTES_KEYS(X)

#define DATA_QUALITY_COLUMNS(X)                                                                    \
    X(DATA_QUALITY_FILE, AS(file), "file it is about", TEXT, LABEL("File"))                        \
    X(DATA_QUALITY_PLACE, IN(entry, place), "first place in the file", TEXT, LABEL("Place"))       \
    X(DATA_QUALITY_ACTION, AS(action),                                                             \
      "left out, corrected, contradicted, copied, implausible or kept", ENUM(action),              \
      LABEL("Action"))                                                                             \
    X(DATA_QUALITY_VALUES, AS(n_values), "number of values, rows or files; nan unless known",      \
      NUMBER, LABEL("Number"))                                                                     \
    X(DATA_QUALITY_REASON, IN(entry, text), "why", TEXT, LABEL("Reason"))                          \
    X(DATA_QUALITY_OPTION, IN(entry, option), "option that overrides it", TEXT, LABEL("Option"))
#define DATA_QUALITY_KEYS(X)

#define METHODS_COLUMNS(X)                                                                         \
    X(METHODS_METHOD, AS(method), "method", TEXT, LABEL("Method"))                                 \
    X(METHODS_TEXT, AS(text), "what it did, for a section on methods", TEXT, LABEL("Here"))        \
    X(METHODS_REFERENCE, AS(reference), "where it is described", TEXT, LABEL("Reference"))         \
    X(METHODS_DOI, AS(doi), "digital object identifier of that", TEXT, LABEL("DOI"))
#define METHODS_KEYS(X)

#define FAILURES_COLUMNS(X)                                                                        \
    X(FAILURES_FILE, AS(file), "file or stage that failed", TEXT, LABEL("File"))                   \
    X(FAILURES_MESSAGE, AS(message), "what went wrong, where, and what to do", TEXT,               \
      LABEL("What happened"))
#define FAILURES_KEYS(X) X(FAILURES_KEY_STATUS, "status", PLAIN, OPTIONAL)

#define COST_COLUMNS(X)                                                                            \
    X(COST_STAGE, AS(stage), "stage", TEXT, LABEL("Stage"))                                        \
    X(COST_RUNS, AS(runs), "1: ran, 0: left out", YES_NO)                                          \
    X(COST_REASON, "reason", "reason", TEXT, SHOWS(because), LABEL("Reason"))                      \
    X(COST_WALL_TIME, "wall_time", "elapsed time", SI(TIME), SHOWS(wall), LABEL("Wall time"))      \
    X(COST_CPU_TIME, "cpu_time", "processor time", SI(TIME), SHOWS(cpu), LABEL("Processor time"),  \
      LIKE(COST_WALL_TIME))                                                                        \
    X(COST_ITEMS, IN(reported, items), "curves, isotherms, points, terms of a series", NUMBER,     \
      LABEL("Items"))                                                                              \
    X(COST_TOLERANCE_ASKED, IN(reported, tolerance_asked),                                         \
      "relative numerical error asked for; of a fit, the change by a further step that ends it",   \
      NUMBER, LABEL("Tolerance asked"))                                                            \
    X(COST_ERROR_ESTIMATED, IN(reported, error_estimated),                                         \
      "largest relative numerical error estimated; of a fit, the change by a further step",        \
      NUMBER, LABEL("Error estimated"))                                                            \
    X(COST_NODES, AS(nodes), "nodes of the friction integral; of a fit, evaluations of its model", \
      NUMBER, LABEL("Nodes"))                                                                      \
    X(COST_STANDARD_ERROR, IN(reported.number, standard_error),                                    \
      "relative standard error of the main number", NUMBER, LABEL("Standard error"))               \
    X(COST_FILES, AS(files), "data files read", NUMBER, LABEL("Files"))                            \
    X(COST_BYTES, AS(bytes), "their size", SI(DATA_SIZE), LABEL("Size"))
#define COST_KEYS(X)                                                                               \
    X(COST_KEY_WALL_TIME, "total_wall_time", SI(TIME), SHOWS(wall), OPTIONAL)                      \
    X(COST_KEY_CPU_TIME, "total_cpu_time", SI(TIME), SHOWS(cpu), OPTIONAL)                         \
    X(COST_KEY_THREADS, AS(threads), NUMBER, OPTIONAL)

#define PLAN_COLUMNS(X)                                                                            \
    X(PLAN_STAGE, "stage", "stage", TEXT)                                                          \
    X(PLAN_TITLE, "title", "what it does", TEXT)                                                   \
    X(PLAN_RUNS, "runs", "1: runs, 0: left out", YES_NO)                                           \
    X(PLAN_REASON, "reason", "reason", TEXT)                                                       \
    X(PLAN_NEEDS, "needs", "what it needs", TEXT)                                                  \
    X(PLAN_PRODUCES, "produces", "tables and values that it produces", TEXT)
#define PLAN_KEYS(X)

#define CONTENTS_COLUMNS(X)                                                                        \
    X(CONTENTS_TABLE, "table", "name of the table", TEXT)                                          \
    X(CONTENTS_TITLE, "title", "what it is", TEXT)                                                 \
    X(CONTENTS_ROWS_OF, "rows", "its rows", NUMBER)                                                \
    X(CONTENTS_COLUMNS_OF, "columns", "its columns", NUMBER)                                       \
    X(CONTENTS_KEYS_OF, "keys", "values that belong to all of it", NUMBER)
#define CONTENTS_KEYS(X)

#define KEYS_COLUMNS(X)                                                                            \
    X(KEYS_KEY, "key", "name of the value", TEXT)                                                  \
    X(KEYS_VALUE, "value", "the value", NUMBER, SPARSE)                                            \
    X(KEYS_STANDARD_ERROR, "standard_error", "its standard error", NUMBER, SPARSE)                 \
    X(KEYS_NUMERICAL_ERROR, "numerical_error",                                                     \
      "what its numerical error is below, which of an integral is far below it", NUMBER, SPARSE)   \
    X(KEYS_UNIT, "unit", "unit of all three", TEXT, SPARSE)                                        \
    X(KEYS_WORDS, "words", "a text, or what a headline is", TEXT, SPARSE)
#define KEYS_KEYS(X)

#define FACTS_COLUMNS(X)                                                                           \
    X(FACTS_ITEM, "item", "what is known", TEXT)                                                   \
    X(FACTS_VALUE, "value", "its value", TEXT)                                                     \
    X(FACTS_UNIT, "unit", "unit of the value", TEXT)                                               \
    X(FACTS_SOURCE, "source", "where in the file it stands, or how it is known", TEXT)             \
    X(FACTS_OPTIONS, "options", "options that give what is missing", TEXT, SPARSE)                 \
    X(FACTS_KIND, "kind", "number of the item in the list of those on which code acts", NUMBER)    \
    X(FACTS_QUANTITY, "quantity", "number of the quantity of a column", NUMBER, SPARSE)
#define FACTS_KEYS(X)

/* Items on which code acts. The first ones are whole items, the others begin an item that has
 * a number or a name: "table 1". */
#define FACT_ITEMS(X)                                                                              \
    X(FACT_FORMAT, "format")                                                                       \
    X(FACT_INSTRUMENT, "instrument")                                                               \
    X(FACT_CURVES, "curves")                                                                       \
    X(FACT_RECORD, "record of friction")                                                           \
    X(FACT_SPRING_CONSTANT, "spring constant")                                                     \
    X(FACT_SENSITIVITY, "deflection sensitivity")                                                  \
    X(FACT_ISOTHERMS, "isotherms")                                                                 \
    X(FACT_RAMPS, "temperature sweeps")                                                            \
    X(FACT_STRAIN_SWEEPS, "strain sweeps")                                                         \
    X(FACT_DEFORMATION, "deformation")                                                             \
    X(FACT_SPECTRUM, "power spectrum")                                                             \
    X(FACT_UNREADABLE, "not readable as it is")                                                    \
    X(FACT_MISSING, "missing")                                                                     \
    X(FACT_TABLE, "table")                                                                         \
    X(FACT_COLUMN, "column")                                                                       \
    X(FACT_PROFILE, "profile")                                                                     \
    X(FACT_TIP_RADIUS, "tip radius")

#define DESCRIPTION_COLUMNS(X)                                                                     \
    X(DESCRIPTION_COLUMN, "column", "name in the file", TEXT)                                      \
    X(DESCRIPTION_QUANTITY, "quantity", "what it measures", TEXT)                                  \
    X(DESCRIPTION_UNIT, "unit", "unit in the file", TEXT)                                          \
    X(DESCRIPTION_SI_UNIT, "si_unit", "unit of the first value", TEXT)                             \
    X(DESCRIPTION_FIRST_VALUE, "first_value", "first value in the SI unit", NUMBER, SPARSE)        \
    X(DESCRIPTION_ROWS, "rows", "rows of its table", NUMBER)                                       \
    X(DESCRIPTION_LINE, "line", "line of the names row", NUMBER)                                   \
    X(DESCRIPTION_PROBLEM, "problem", "why it is not read", TEXT)
#define DESCRIPTION_KEYS(X)

#endif
