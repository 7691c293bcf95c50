/* Cases side by side. Internal to study. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COLLECT_H
#define WT_STUDY_COLLECT_H

#include "core/table/result_value.h"
#include "weartrack/flow.h"

/* What is taken of one case; the texts are borrowed from its result. */
typedef struct collected_case {
    const char *sample, *condition, *file;
    const wt_result *result;
    result_value_tables tables;
    wt_log_ratio ratio; /* of its moduli; NaN: not known */
} collected_case;

/* What a group is called: "bulk", or by the condition. */
const char *collected_place(const collected_case *c, const char *group);

/* Table "collected_force"; NULL if there is no curve. `beside`: results with groups of no case. */
wt_status collect_force(const collected_case *cases, size_t n, const wt_collected *beside,
                        size_t n_beside, wt_table **table, wt_error *err) WT_NODISCARD;

/* Table "ratio_pairs"; NULL if no two cases have a sample or a condition in common. */
wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err) WT_NODISCARD;

/* ---- constants that cases have in common ----------------------------------------------------- */

typedef enum shared_constant { SHARED_WEAR, SHARED_SHEAR, SHARED_RATE, SHARED_N } shared_constant;

/* What an error is of that files bring in, which cases may share. */
typedef enum shared_files {
    SHARED_MATERIAL, /* the DMA, and scatter of the scans */
    SHARED_LAW,
    SHARED_ROUGHNESS,
    SHARED_SOFTENING,
    SHARED_SPECTRUM, /* of curves that are fitted with it */
    SHARED_FILES_N
} shared_files;

/* A value of a constant in a case; `group`: of the moduli, or NULL. */
typedef struct case_value {
    shared_constant constant;
    const collected_case *of;
    const char *group;
    wt_log_ratio log;                /* of its logarithm */
    double by_files[SHARED_FILES_N]; /* variance of it by these */
    const char *lacks;               /* what its error does not hold, or NULL */
} case_value;

typedef struct case_values {
    case_value *of;
    size_t n;
    char left_out[1000]; /* values that cannot be used and why, in words; "" if there is none */
    size_t unnamed;      /* of them that it has no room for */
} case_values;

/* "specific wear rate", and the case of a value: "HC, mild, bulk". */
extern const char *const shared_words[SHARED_N];
void shared_name(const case_value *v, char *text, size_t size);

/* All that the cases tell, the constants one after the other; to be freed with free(to->of), also
 * after a failure. */
wt_status shared_values_of(const collected_case *cases, size_t n, case_values *to,
                           wt_error *err) WT_NODISCARD;

/* Have two cases a file of some roles in common? */
typedef enum files_common {
    FILES_APART,
    FILES_OF_ONE_SIZE, /* no digest tells them apart */
    FILES_OF_ONE_NAME, /* nor does the path */
    FILES_COMMON
} files_common;
files_common files_in_common(const collected_case *a, const collected_case *b,
                             const char *const *roles, size_t n_roles);
/* The part of the source of an error of a record that files bring in; SHARED_FILES_N: none. */
shared_files shared_files_of(const char *source);
/* The most that two values of one constant have in common by files that both cases have. */
double shared_covariance(const case_value *a, const case_value *b);

/* May two cases have errors of material, surface and conditions in common? Numbers that a case
 * gives itself may be those of another. */
bool inputs_may_be_common(const collected_case *a, const collected_case *b);

/* Tables "collected_constants" and "shared_pairs": critical energy and wear rate together, by what
 * each case saw of its layer. NULL: no case, or no two cases, tell them. */
wt_status collect_layer_constants(const collected_case *cases, size_t n, double margin,
                                  wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

/* Tables "shared_constants" and "shared_members"; NULL if no two cases tell one constant, the first
 * only if no value was left out either. */
wt_status collect_constants(const collected_case *cases, size_t n, double margin,
                            wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

#endif
