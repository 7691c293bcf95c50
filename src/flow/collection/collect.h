/* Cases side by side. Internal to flow/collection. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_COLLECTION_COLLECT_H
#define WEARTRACK_FLOW_COLLECTION_COLLECT_H

#include "data/findings.h"
#include "weartrack/flow.h"

/* What is taken of one case; the texts are borrowed from its result. */
typedef struct collected_case {
    const char *sample, *condition, *file;
    finding_tables tables;
    wt_log_ratio ratio; /* of its moduli; NaN: not known */
} collected_case;

/* Table "ratio_pairs"; NULL if no two cases have a sample or a condition in common. */
wt_status collect_pairs(const collected_case *cases, size_t n, double margin, wt_table **table,
                        wt_error *err) WT_NODISCARD;

#endif
