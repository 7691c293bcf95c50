/* Collection of cases. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COLLECT_H
#define WT_STUDY_COLLECT_H

#include "core/table/result_value.h"
#include "weartrack/study.h"

/* Results of one case; the texts are borrowed from its result. */
typedef struct collected_case {
    const char *sample, *condition, *file;
    const wt_result *result;
    result_value_tables tables;
    wt_log_ratio ratio; /* of the moduli; NaN if unknown */
} collected_case;

/* Binds a table of a case. The error names its file. */
wt_status collected_bind(const collected_case *c, const table_schema *schema, const char *suffix,
                         table_view *view, wt_error *err) WT_NODISCARD;
/* Returns the name that a case shares with others at this level; NULL if it is not stated. */
const char *collected_shared_name(const collected_case *c, sharing_level common);

/* ---- shared constants ------------------------------------------------------------------------ */

typedef enum shared_constant {
    SHARED_WEAR,
    SHARED_SHEAR,
    SHARED_RATE,
    N_SHARED_CONSTANTS
} shared_constant;

/* Categories of input files whose errors cases may share. */
typedef enum input_category {
    SHARED_MATERIAL, /* the DMA, and scatter of the scans */
    SHARED_LAW,
    SHARED_ROUGHNESS,
    SHARED_SOFTENING,
    SHARED_SPECTRUM, /* of curves that are fitted with the spectrum */
    INPUT_CATEGORIES
} input_category;

/* Value of a constant in a case. `group`: group of the moduli, or NULL. */
typedef struct case_value {
    shared_constant constant;
    const collected_case *of;
    const char *group;
    wt_log_ratio log;                  /* logarithm of the value with its error */
    double by_files[INPUT_CATEGORIES]; /* components of its variance by category of input files */
    const char *lacks;                 /* errors that are missing in it, or NULL */
} case_value;

typedef struct case_value_list {
    case_value *of;
    size_t n;
    char left_out[1000]; /* excluded values with reasons; "" if none */
    size_t unnamed;      /* number of excluded values without space in the text */
} case_value_list;

/* Names of the constants, and the name of a value such as "HC, mild, bulk". */
extern const char *const shared_constant_names[N_SHARED_CONSTANTS];
void shared_value_name(const case_value *v, char *text, size_t size);

/* Reads all values of the cases, sorted by constant. The caller frees to->of with free(), also
 * after a failure. */
wt_status shared_values_read(const collected_case *cases, size_t n, case_value_list *to,
                             wt_error *err) WT_NODISCARD;

/* Agreement of the input files of two cases, in ascending order of certainty. */
typedef enum file_match {
    FILES_DIFFERENT,
    FILES_SAME_SIZE, /* equal sizes without digests */
    FILES_SAME_NAME, /* equal sizes and paths without digests */
    FILES_IDENTICAL
} file_match;
/* Returns the largest possible covariance of two values of one constant due to shared files. */
double shared_covariance(const case_value *a, const case_value *b);

/* True if two cases may share errors of material, surface and conditions. Numbers stated in a case
 * may be those of another case. */
bool inputs_may_be_shared(const collected_case *a, const collected_case *b);

/* Creates the tables "collected_constants" and "shared_pairs": critical energy and wear rate
 * together, from the observed layer of each case. NULL if no case, or no two cases, determine
 * them. */
wt_status collect_layer_constants(const collected_case *cases, size_t n, double margin,
                                  wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

/* Creates the table "ratio_pairs"; NULL if no two cases share a sample or a condition. */
wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err) WT_NODISCARD;

/* Creates the tables "shared_constants" and "shared_members". NULL if no two cases determine one
 * constant. The first one also exists if values were excluded. */
wt_status collect_constants(const collected_case *cases, size_t n, double margin,
                            wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

#endif
