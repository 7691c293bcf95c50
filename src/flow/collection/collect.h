/* Cases side by side. Internal to flow/collection. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_COLLECTION_COLLECT_H
#define WEARTRACK_FLOW_COLLECTION_COLLECT_H

#include "data/findings.h"
#include "weartrack/flow.h"

/* What is taken of one case; the texts are borrowed from its result. */
typedef struct collected_case {
    const char *sample, *condition, *file;
    const wt_result *result;
    finding_tables tables;
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

/* A value of a constant in a case; `group`: of the moduli, or NULL. */
typedef struct case_value {
    shared_constant constant;
    const collected_case *of;
    const char *group;
    wt_log_ratio log; /* of its logarithm */
    double material;  /* variance of it by the DMA and the scans of the surface */
} case_value;

typedef struct case_values {
    case_value *of;
    size_t n;
    char
        left_out[400]; /* values without an error that can be used, in words; "" if there is none */
    size_t unnamed;    /* of them that it has no room for */
} case_values;

/* "specific wear rate", and the case of a value: "HC, mild, bulk". */
extern const char *const shared_words[SHARED_N];
void shared_name(const case_value *v, char *text, size_t size);

/* All that the cases tell, the constants one after the other; to be freed with free(to->of), also
 * after a failure. */
wt_status shared_values_of(const collected_case *cases, size_t n, case_values *to,
                           wt_error *err) WT_NODISCARD;
/* Covariance of two values of one constant by files that both cases have: what is certain (sure),
 * or what is possible. */
double shared_covariance(const case_value *a, const case_value *b, bool sure);

/* Tables "shared_constants" and "shared_members"; NULL if no two cases tell one constant. */
wt_status collect_constants(const collected_case *cases, size_t n, double margin,
                            wt_collection_tables *tables, wt_error *err) WT_NODISCARD;

#endif
