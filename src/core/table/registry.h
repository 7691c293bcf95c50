/* Registry of the tables that leave the program. A column or a key is a row in the list of its
 * table, which names the member that it shows (table_rows.h). Other cells are set by a function
 * call.
 *
 * For a table `layer` this header defines the types layer_column and layer_key, the schema
 * layer_schema, and the functions below. These functions accept the columns and keys of this table
 * only; others are a compiler error. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_REGISTRY_H
#define WT_CORE_TABLE_REGISTRY_H

#include "case/tables.h"
#include "core/table/table_view.h"
#include "core/table/table_writer.h"
#include "dma/tables.h"
#include "friction/tables.h"
#include "indentation/tables.h"
#include "indentation/tables_calibration.h"
#include "layer/tables.h"
#include "record/tables.h"
#include "record/tables_measured.h"
#include "record/tables_validation.h"
#include "study/tables.h"
#include "study/tables_collection.h" /* with its intervals */
#include "study/tables_errors.h"
#include "surface/tables.h"
#include "weartrack/indentation.h" /* enums of closed lists of texts */
#include "weartrack/layer.h"

/* Groups of columns: a number with its standard error, a number with both errors, or the limits of
 * an interval. `heading` is the heading on the page. */
#define COLUMN_AND_ERROR(X, ID, name, words, unit, heading, ...)                                   \
    X(ID, name, words, unit, LABEL(heading), STANDARD_ERROR(ID), __VA_ARGS__)                      \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit,                     \
      LABEL("Standard error"))
#define COLUMN_AND_ERRORS(X, ID, name, words, unit, heading, ...)                                  \
    X(ID, name, words, unit, LABEL(heading), BOTH_ERRORS(ID), __VA_ARGS__)                         \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit,                     \
      LABEL("Standard error"))                                                                     \
    X(ID##_NUMERICAL_ERROR, name "_numerical_error", "its numerical error", unit,                  \
      LABEL("Numerical error"))
/* Variant for tables that earlier versions wrote without errors. */
#define COLUMN_AND_NEW_ERROR(X, ID, name, words, unit, ...)                                        \
    X(ID, name, words, unit, STANDARD_ERROR(ID), __VA_ARGS__)                                      \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit,                     \
      LABEL("Standard error"), OPTIONAL)
#define COLUMN_AND_NEW_ERRORS(X, ID, name, words, unit, ...)                                       \
    X(ID, name, words, unit, BOTH_ERRORS(ID), __VA_ARGS__)                                         \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit,                     \
      LABEL("Standard error"), OPTIONAL)                                                           \
    X(ID##_NUMERICAL_ERROR, name "_numerical_error", "its numerical error", unit,                  \
      LABEL("Numerical error"), OPTIONAL)
#define INTERVAL_COLUMNS(X, ID, prefix, ...)                                                       \
    X(ID##_LOW, prefix "low", "lower end of its 95 % interval", LABEL("95 % interval from"),       \
      __VA_ARGS__)                                                                                 \
    X(ID##_HIGH, prefix "high", "upper end of its 95 % interval", LABEL("to"), __VA_ARGS__)
/* Number with its standard error and interval; empty if it is unknown. */
#define NUMBER_AND_INTERVAL(X, ID, name, words, unit, heading, ...)                                \
    X(ID, name, words, unit, LABEL(heading), STANDARD_ERROR(ID), INTERVAL(ID##_LOW, ID##_HIGH),    \
      SPARSE, __VA_ARGS__)                                                                         \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit,                     \
      LABEL("Standard error"), SPARSE)                                                             \
    INTERVAL_COLUMNS(X, ID, name "_", unit, SPARSE)

/* Columns: name in C, name of its lists, name of the table, title, subcommand that writes it. Two
 * tables share a name: the computed counter surface and a measured spectrum. */
#define TABLES(X)                                                                                  \
    X(answer, ANSWER, "answer", "The answer", "run")                                               \
    X(limits, LIMITS, "limits", "Limits of the result", "run")                                     \
    X(inputs, INPUTS, "inputs", "Files that were read", "run")                                     \
    X(notes, NOTES, "notes", "Notes and warnings", "run")                                          \
    X(data_quality, DATA_QUALITY, "data_quality", "What was done to the data", "run")              \
    X(methods, METHODS, "methods", "Methods and where they are described", "run")                  \
    X(failures, FAILURES, "failures", "What could not be used", "run")                             \
    X(cost, COST, "cost", "Stages, their time and their numerical error", "run")                   \
    X(plan, PLAN, "plan", "Stages of this case", "run")                                            \
    X(indentation, INDENTATION, "indentation/", "Indentation of every curve", "indent")            \
    X(force_displacement, FORCE_DISPLACEMENT, "force_displacement",                                \
      "Force against piezo displacement", "indent")                                                \
    X(force_indentation, FORCE_INDENTATION, "force_indentation", "Force against indentation",      \
      "indent")                                                                                    \
    X(curves, CURVES, "curves", "Curves to look at", "indent")                                     \
    X(overrides, OVERRIDES, "overrides", "What was chosen by hand", "indent")                      \
    X(modulus_depth, MODULUS_DEPTH, "modulus_depth", "Modulus against depth", "indent")            \
    X(sensitivity, SENSITIVITY, "sensitivity", "Deflection sensitivity", "sensitivity")            \
    X(sensitivity_curves, SENSITIVITY_CURVES, "sensitivity_curves",                                \
      "Deflection sensitivity of every curve", "sensitivity")                                      \
    X(spot, SPOT, "spot", "Roughness of a spot", "spot")                                           \
    X(modulus_groups, MODULUS_GROUPS, "modulus_groups", "Modulus of the groups", "compare")        \
    X(modulus_budget, MODULUS_BUDGET, "modulus_budget",                                            \
      "Error budget of the moduli of the groups", "compare")                                       \
    X(modulus_rate, MODULUS_RATE, "modulus_rate", "Modulus against indentation rate", "compare")   \
    X(comparison, COMPARISON, "comparison", "Wear track against bulk", "compare")                  \
    X(track_layer, TRACK_LAYER, "track_layer", "Thickness of the layer by the curves", "compare")  \
    X(dma_comparison, DMA_COMPARISON, "dma_comparison", "Indentation against DMA", "compare")      \
    X(collection, COLLECTION, "collection", "Cases side by side", "collect")                       \
    X(collected_modulus, COLLECTED_MODULUS, "collected_modulus",                                   \
      "Modulus against indentation rate, of all cases", "collect")                                 \
    X(collected_friction, COLLECTED_FRICTION, "collected_friction",                                \
      "Friction against velocity, of all cases", "collect")                                        \
    X(collected_ramp, COLLECTED_RAMP, "collected_ramp",                                            \
      "Moduli against temperature, of all samples", "collect")                                     \
    X(collected_force, COLLECTED_FORCE, "collected_force",                                         \
      "Force against indentation, of all cases", "collect")                                        \
    X(ratio_pairs, RATIO_PAIRS, "ratio_pairs", "Modulus ratios of cases against one another",      \
      "collect")                                                                                   \
    X(shift_factors, SHIFT_FACTORS, "shift_factors", "Shift factors", "master")                    \
    X(master_curve, MASTER_CURVE, "master_curve", "Master curve", "master")                        \
    X(prony, PRONY, "prony", "Prony series", "master")                                             \
    X(relaxation_spectrum, RELAXATION_SPECTRUM, "relaxation_spectrum", "Relaxation spectrum",      \
      "master")                                                                                    \
    X(influences, INFLUENCES, "influences", "Influence of each isotherm", "master")                \
    X(prony_reduced, PRONY_REDUCED, "prony_reduced", "Prony series with few terms", "master")      \
    X(material_draws, MATERIAL_DRAWS, "material_draws", "Draws of the material, law and vertical", \
      "master")                                                                                    \
    X(series_draws, SERIES_DRAWS, "series_draws", "Draws of the Prony series", "master")           \
    X(ramp, RAMP, "ramp", "Moduli against temperature", "ramp")                                    \
    X(glass_transition, GLASS_TRANSITION, "glass_transition", "Glass transition", "ramp")          \
    X(moduli_at, MODULI_AT, "moduli_at", "Moduli at temperatures", "ramp")                         \
    X(payne_sweep, PAYNE_SWEEP, "payne_sweep", "Moduli against strain amplitude", "payne")         \
    X(payne, PAYNE, "payne", "Softening with strain (Payne effect)", "payne")                      \
    X(record, RECORD, "record", "Friction as measured", "record")                                  \
    X(record_cycles, RECORD_CYCLES, "record_cycles", "Friction of every cycle", "record")          \
    X(wear, WEAR, "wear", "Wear as measured", "record")                                            \
    X(power_spectrum, POWER_SPECTRUM, "power_spectrum", "Power spectrum of a measured surface",    \
      "psd")                                                                                       \
    X(place_errors, PLACE_ERRORS, "place_errors", "Errors of a power spectrum by its places",      \
      "psd")                                                                                       \
    X(angular_spectrum, ANGULAR_SPECTRUM, "angular_spectrum",                                      \
      "Angular spectrum of a measured surface", "psd")                                             \
    X(surfaces, SURFACES, "surfaces", "Scans of a surface", "psd")                                 \
    X(height_map, HEIGHT_MAP, "height_map", "Heights of a surface", "psd")                         \
    X(height_profile, HEIGHT_PROFILE, "height_profile", "Heights along a line of a surface",       \
      "psd")                                                                                       \
    X(roughness, ROUGHNESS, "roughness", "Power spectrum of the counter surface", "run")           \
    X(friction, FRICTION, "friction", "Friction against velocity", "friction")                     \
    X(contact_area, CONTACT_AREA, "contact_area", "Contact area against magnification",            \
      "friction")                                                                                  \
    X(transverse_isotropy, TRANSVERSE_ISOTROPY, "transverse_isotropy",                             \
      "What the directions of the material do", "friction")                                        \
    X(softening, SOFTENING, "softening", "What softening with strain does", "friction")            \
    X(friction_decades, FRICTION_DECADES, "friction_decades",                                      \
      "Friction by decades of the wavenumber", "friction")                                         \
    X(flash, FLASH, "flash_temperature", "What the flash temperature does", "friction")            \
    X(layer, LAYER, "layer", "Thickness of the modified layer", "layer")                           \
    X(energy_density, ENERGY_DENSITY, "energy_density", "Energy density with depth", "layer")      \
    X(identification, IDENTIFICATION, "identification",                                            \
      "Critical energy and wear rate of a layer", "identify")                                      \
    X(what_if, WHAT_IF, "what_if", "What if a choice of the model were another", "friction")       \
    X(validation, VALIDATION, "validation", "Measured friction against predicted friction",        \
      "validate")                                                                                  \
    X(validation_running_in, VALIDATION_RUNNING_IN, "validation_running_in",                       \
      "Running-in with the layer against records", "validate")                                     \
    X(validation_course, VALIDATION_COURSE, "validation_course",                                   \
      "Friction in running-in, measured and predicted", "validate")                                \
    X(validation_sources, VALIDATION_SOURCES, "validation_sources",                                \
      "Where the error of measured over predicted comes from", "validate")                         \
    X(error_budget, ERROR_BUDGET, "error_budget", "Error budget", "accuracy")                      \
    X(work_precision, WORK_PRECISION, "work_precision", "Error against run time", "accuracy")      \
    X(force_curve, FORCE_CURVE, "force_curve/", "force curve", "convert")                          \
    X(sweep, SWEEP, "sweep", "DMA frequency sweeps", "convert")                                    \
    X(spectrum, SPECTRUM, "roughness", "power spectrum", "convert")                                \
    X(image, IMAGE, "image/", "name of the image", "convert")                                      \
    X(contents, CONTENTS, "contents", "Tables of a result", "table")                               \
    X(keys, KEYS, "keys", "Values of a table", "table")                                            \
    X(facts, FACTS, "facts", "What the file is", "info")                                           \
    X(description, DESCRIPTION, "description", "Columns that the description understands",         \
      "formats")

/* Verdicts of several tables. */
#define STATED_VERDICTS(X)                                                                         \
    X(VERDICT_INCONCLUSIVE, "inconclusive")                                                        \
    X(VERDICT_YES, "yes")                                                                          \
    X(VERDICT_NO, "no")                                                                            \
    X(VERDICT_NOT_TESTED, "not tested")                                                            \
    X(VERDICT_NOT_ASKED, "not asked")

/* Closed lists of texts whose enum is public: name of the list, enum, rows. */
#define PUBLIC_TEXT_LISTS(X)                                                                       \
    X(input_role, wt_input_role, WT_INPUT_ROLE_LIST)                                               \
    X(severity, wt_severity, WT_SEVERITY_LIST)                                                     \
    X(action, wt_action, WT_ACTION_LIST)                                                           \
    X(deformation, wt_deformation, WT_DEFORMATION_LIST)                                            \
    X(segment_kind, wt_segment_kind, WT_SEGMENT_KIND_LIST)                                         \
    X(curve_verdict, wt_curve_verdict, WT_CURVE_VERDICT_LIST)                                      \
    X(superposition, wt_superposition, WT_SUPERPOSITION_LIST)                                      \
    X(vertical_shift, wt_vertical_shift, WT_VERTICAL_SHIFT_LIST)                                   \
    X(shift_origin, wt_shift_origin, WT_SHIFT_ORIGIN_LIST)                                         \
    X(shift_law_kind, wt_law_kind, WT_LAW_KIND_LIST)                                               \
    X(layer_regime, wt_layer_regime, WT_LAYER_REGIME_LIST)
/* Closed lists of texts whose enum is defined here: name of the list and of the enum, rows, value
 * of an unknown text. */
#define TABLE_TEXT_LISTS(X)                                                                        \
    X(stated_verdict, STATED_VERDICTS, VERDICT_UNKNOWN)                                            \
    X(finding_verdict, FINDING_VERDICTS, FINDING_VERDICT_UNKNOWN)                                  \
    X(finding_basis, FINDING_BASES, FINDING_BASIS_UNKNOWN)                                         \
    X(limit_subject, LIMIT_SUBJECTS, LIMIT_SUBJECT_UNKNOWN)                                        \
    X(fact_item, FACT_ITEMS, FACT_ITEM_UNKNOWN)                                                    \
    X(tip_form, TIP_FORMS, TIP_FORM_UNKNOWN)                                                       \
    X(tip_shape, TIP_SHAPES, TIP_SHAPE_UNKNOWN)                                                    \
    X(error_source, ERROR_SOURCES, ERROR_SOURCE_UNKNOWN)                                           \
    X(spot_naming, SPOT_NAMINGS, SPOT_NAMING_UNKNOWN)                                              \
    X(slope_direction, SLOPE_DIRECTIONS, SLOPE_DIRECTION_UNKNOWN)                                  \
    X(slope_verdict, SLOPE_VERDICTS, SLOPE_VERDICT_UNKNOWN)                                        \
    X(analysis_unit, ANALYSIS_UNITS, ANALYSIS_UNIT_UNKNOWN)                                        \
    X(rate_match, RATE_MATCHES, RATE_MATCH_UNKNOWN)                                                \
    X(cantilever_count, CANTILEVER_COUNTS, CANTILEVER_COUNT_UNKNOWN)                               \
    X(error_kind, ERROR_KINDS, ERROR_KIND_UNKNOWN)                                                 \
    X(what_if_choice, WHAT_IF_CHOICES, CHOICE_UNKNOWN)                                             \
    X(precision_method, PRECISION_METHODS, PRECISION_METHOD_UNKNOWN)                               \
    X(validation_outcome, VALIDATION_OUTCOMES, VALIDATION_OUTCOME_UNKNOWN)                         \
    X(validation_source, VALIDATION_SOURCE_LIST, VALIDATION_SOURCE_UNKNOWN)                        \
    X(friction_part, FRICTION_PARTS, FRICTION_PART_UNKNOWN)                                        \
    X(identification_method, IDENTIFICATION_METHODS, IDENTIFICATION_METHOD_UNKNOWN)                \
    X(critical_energy_origin, CRITICAL_ENERGY_ORIGINS, CRITICAL_ENERGY_ORIGIN_UNKNOWN)

#define TEXT_LIST_ACCESS(list, type)                                                               \
    extern const closed_list list##_list;                                                          \
    static inline const char *list##_text(type value)                                              \
    {                                                                                              \
        return closed_list_get(&list##_list, (int)value);                                          \
    }
#define PUBLIC_TEXT_LIST(list, type, ROWS) TEXT_LIST_ACCESS(list, type)
#define TEXT_VALUE(value, ...) value,
#define TABLE_TEXT_LIST(list, ROWS, unknown)                                                       \
    typedef enum list { ROWS(TEXT_VALUE) unknown } list;                                           \
    TEXT_LIST_ACCESS(list, list)
PUBLIC_TEXT_LISTS(PUBLIC_TEXT_LIST)
TABLE_TEXT_LISTS(TABLE_TEXT_LIST)

#define TABLE_ID(id, ...) id,
#define TABLE_TYPES(table, TABLE, ...)                                                             \
    typedef enum table##_column{TABLE##_COLUMNS(TABLE_ID) TABLE##_N_COLUMNS} table##_column;       \
    typedef enum table##_key{TABLE##_KEYS(TABLE_ID) TABLE##_N_KEYS} table##_key;                   \
    extern const table_schema table##_schema;                                                      \
    /* sets a cell of the last row */                                                              \
    static inline void table##_put(table_writer *w, table##_column c, double value)                \
    {                                                                                              \
        writer_number(w, &table##_schema, (unsigned)c, value);                                     \
    }                                                                                              \
    static inline void table##_put_text(table_writer *w, table##_column c, const char *text)       \
    {                                                                                              \
        writer_text(w, &table##_schema, (unsigned)c, text);                                        \
    }                                                                                              \
    /* set keys; the schema defines the unit of an estimate */                                     \
    static inline void table##_set(table_writer *w, table##_key k, wt_estimate estimate)           \
    {                                                                                              \
        writer_key(w, &table##_schema, (unsigned)k, estimate);                                     \
    }                                                                                              \
    static inline void table##_set_value(table_writer *w, table##_key k, double value,             \
                                         double standard_error, double numerical_error)            \
    {                                                                                              \
        table##_set(w, k, (wt_estimate){value, standard_error, numerical_error, NULL});            \
    }                                                                                              \
    static inline void table##_set_text(table_writer *w, table##_key k, const char *text)          \
    {                                                                                              \
        writer_key_text(w, &table##_schema, (unsigned)k, text);                                    \
    }                                                                                              \
    static inline void table##_set_print(table_writer *, table##_key, const char *, ...)           \
        WT_PRINTF(3, 4);                                                                           \
    static inline void table##_set_print(table_writer *w, table##_key k, const char *format, ...)  \
    {                                                                                              \
        va_list list;                                                                              \
        va_start(list, format);                                                                    \
        writer_key_print(w, &table##_schema, (unsigned)k, format, list);                           \
        va_end(list);                                                                              \
    }                                                                                              \
    /* read a bound table */                                                                       \
    static inline bool table##_has(const table_view *v, table##_column c)                          \
    {                                                                                              \
        return view_has_column(v, &table##_schema, (unsigned)c);                                   \
    }                                                                                              \
    static inline double table##_get(const table_view *v, size_t row, table##_column c)            \
    {                                                                                              \
        return view_number(v, &table##_schema, row, (unsigned)c);                                  \
    }                                                                                              \
    static inline const char *table##_text(const table_view *v, size_t row, table##_column c)      \
    {                                                                                              \
        return view_text(v, &table##_schema, row, (unsigned)c);                                    \
    }                                                                                              \
    static inline int table##_enum(const table_view *v, size_t row, table##_column c)              \
    {                                                                                              \
        return view_listed(v, &table##_schema, row, (unsigned)c).value;                            \
    }                                                                                              \
    static inline listed_text table##_key_listed(const table_view *v, table##_key k)               \
    {                                                                                              \
        return view_key_listed(v, &table##_schema, (unsigned)k);                                   \
    }                                                                                              \
    static inline int table##_key_enum(const table_view *v, table##_key k)                         \
    {                                                                                              \
        return table##_key_listed(v, k).value;                                                     \
    }                                                                                              \
    static inline uint64_t table##_key_items(const table_view *v, table##_key k)                   \
    {                                                                                              \
        return view_key_items(v, &table##_schema, (unsigned)k);                                    \
    }                                                                                              \
    static inline wt_estimate table##_value(const table_view *v, table##_key k)                    \
    {                                                                                              \
        return view_key(v, &table##_schema, (unsigned)k);                                          \
    }                                                                                              \
    static inline const char *table##_key_text(const table_view *v, table##_key k)                 \
    {                                                                                              \
        return view_key_text(v, &table##_schema, (unsigned)k);                                     \
    }
TABLES(TABLE_TYPES)

/* All schemas in the order of the list. */
extern const table_schema *const table_schemas[];
extern const size_t table_n_schemas;

#endif
