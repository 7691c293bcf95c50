/* Context of an answer: views of the result tables, and the log of the run. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_CONTEXT_H
#define WT_CASE_ANSWER_ANSWER_CONTEXT_H

#include "case/answer/format_number.h"
#include "case/plan/plan.h"

typedef struct answer_context {
    const wt_case *c; /* NULL for the result of a single command */
    result_value_tables values;
    table_view failures;
    table_view indentation[2]; /* bulk, track */
    table_view modulus_depth, dma_comparison, shift_factors, roughness, softening, flash, wear;
} answer_context;

/* Binds the views of the tables of a result. */
wt_status answer_context_bind(answer_context *context, const wt_result *result,
                              wt_error *err) WT_NODISCARD;

#endif
