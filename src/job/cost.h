/* Records the cost of each stage, for the table "cost". A job without a cost object counts nothing.
 * Internal to job. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_COST_H
#define WT_JOB_COST_H

#include "weartrack/job.h"

/* Report of a job at its end; 0 for unknown numbers. Jobs within a job do not report. */
typedef struct cost_summary {
    double items;
    double tolerance_asked, error_estimated; /* relative numerical errors */
    wt_estimate number;                      /* main result with its standard error */
} cost_summary;
void cost_report(const wt_job *work, cost_summary summary);

/* Add to the counters of the current stage; thread-safe. */
void cost_add_nodes(wt_cost *cost, size_t nodes);
void cost_add_file(wt_cost *cost, size_t bytes);

/* Kind of a stage whose cost a later stage requests. */
typedef enum cost_stage_kind { COST_OTHER, COST_INDENTATION } cost_stage_kind;
/* Begins a stage and ends the one before. The reason why it runs is copied. */
void cost_begin(wt_cost *cost, const char *stage, cost_stage_kind kind, const char *because);
void cost_end(wt_cost *cost);
/* Replaces the reason of the last stage. */
void cost_set_reason(wt_cost *cost, const char *because);
/* Adds a stage that does not run. */
void cost_skip_stage(wt_cost *cost, const char *stage, const char *because);

/* Elapsed time [s] of a part of the work, which a later stage requests by its number. NaN if it is
 * unknown. */
double cost_clock(const wt_cost *cost); /* NaN without times */
void cost_set_part(wt_cost *cost, size_t part, double seconds);
double cost_part_seconds(const wt_cost *cost, size_t part);

/* Sum over the finished stages of a kind: elapsed time [s] and largest relative numerical error;
 * NaN if unknown. */
typedef struct stage_cost_sum {
    double seconds, error;
} stage_cost_sum;
stage_cost_sum cost_sum_stages(const wt_cost *cost, cost_stage_kind kind);

#endif
