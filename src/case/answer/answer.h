/* Answers of a run. Internal to case. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_H
#define WT_CASE_ANSWER_ANSWER_H

#include "case/plan/plan.h"

/* Creates the table "answer" with a row for each finding, none if the case asks none of the
 * questions, and the table of the limits. The caller owns *table and *limits; *limits is NULL
 * without limits. */
wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_table *failures, wt_table **table, wt_table **limits,
                      wt_error *err) WT_NODISCARD;

#endif
