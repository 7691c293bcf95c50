/* What each stage of the work costs, for the table "cost". A job whose work has no cost counts
 * nothing. Internal to job. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_COST_H
#define WT_JOB_COST_H

#include "weartrack/flow.h"

/* What a job says of itself at its end; 0: nothing to say. Jobs within a job say nothing. */
typedef struct cost_summary {
    double items;
    double tolerance_asked, error_estimated; /* relative, numerical */
    wt_estimate number;                      /* the main one, with its standard error */
} cost_summary;
void cost_report(const wt_job *work, cost_summary summary);

/* Adds to the stage; from any thread. */
void cost_add_nodes(wt_cost *cost, size_t nodes);
void cost_add_file(wt_cost *cost, size_t bytes);

/* A stage with the reason why it runs, of which a copy is kept; it ends with the next one. */
void cost_begin(wt_cost *cost, const char *stage, const char *because);
void cost_end(wt_cost *cost);
/* Another reason for the last stage. */
void cost_explain(wt_cost *cost, const char *because);
/* A stage that does not run. */
void cost_leave_out(wt_cost *cost, const char *stage, const char *because);

/* Elapsed time of a part of the work that a later stage asks for by its words, which are borrowed;
 * NaN if it is not known. */
double cost_clock(const wt_cost *cost); /* NaN: without times */
void cost_set_part(wt_cost *cost, const char *words, double seconds);
double cost_part(const wt_cost *cost, const char *words);

/* Of the stages that ran so far and whose names begin so: elapsed time, and the largest numerical
 * error, relative; NaN if not known. */
typedef struct cost_of_stages {
    double seconds, error;
} cost_of_stages;
cost_of_stages cost_stages(const wt_cost *cost, const char *beginning);

#endif
