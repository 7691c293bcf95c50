/* The answer of a run in plain sentences. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_ANSWER_H
#define WEARTRACK_FLOW_ANSWER_H

#include "flow/plan/plan.h"

/* Table "answer", from what is in the result so far. */
wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_parselog *log, const wt_table *failures, wt_table **table,
                      wt_error *err) WT_NODISCARD;

#endif
