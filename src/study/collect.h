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

/* Creates the table "ratio_pairs"; NULL if no two cases share a sample or a condition. */
wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err) WT_NODISCARD;

#endif
