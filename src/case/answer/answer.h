/* Answer of a run in plain sentences. Internal to case. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_H
#define WT_CASE_ANSWER_ANSWER_H

#include "case/plan/plan.h"

/* Creates the table "answer" from the tables of the result, the log and the failures. The caller
 * owns *table and *limits; *limits is NULL without limits. */
wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_log *log, const wt_table *failures, wt_table **table,
                      wt_table **limits, wt_error *err) WT_NODISCARD;

#endif
