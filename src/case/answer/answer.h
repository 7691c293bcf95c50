/* Answers of a run, with the context that they are made from and the limits of the result. Internal
 * to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_H
#define WT_CASE_ANSWER_ANSWER_H

#include "case/answer/format_number.h"
#include "case/plan/plan.h"

/* Context of an answer: the case, views of the result tables, and the log of the run. */
typedef struct answer_context {
    const wt_case *c; /* NULL for the result of a single command */
    result_value_tables values;
    table_view failures;
    table_view indentation[2]; /* bulk, track */
    table_view modulus_depth, dma_comparison, shift_factors, master_curve, roughness, softening,
        flash, wear;
} answer_context;

/* ---- limits.c: what the numbers of a result leave out, assume, or make doubtful. */
/* Binds the views of the tables of a result. */
wt_status answer_context_bind(answer_context *context, const wt_result *result,
                              wt_error *err) WT_NODISCARD;
/* Creates the table "limits", the most serious limits first. *table is NULL without limits. */
wt_status limits_table(const answer_context *context, wt_table **table, wt_error *err) WT_NODISCARD;

/* Creates the table "answer" with a row for each finding, none if the case asks none of the
 * questions, and the table of the limits. The caller owns *table and *limits; *limits is NULL
 * without limits. */
wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_table *failures, wt_table **table, wt_table **limits,
                      wt_error *err) WT_NODISCARD;

#endif
