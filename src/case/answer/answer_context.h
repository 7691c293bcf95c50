/* Context of an answer: views of the result tables, and the log of the run. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_CONTEXT_H
#define WT_CASE_ANSWER_ANSWER_CONTEXT_H

#include "case/answer/format_number.h"
#include "case/plan/plan.h"

typedef struct answer_context {
    const wt_case *c; /* NULL for the result of a single command */
    const flow_plan *plan;
    const wt_log *log;
    result_value_tables values;
    table_view failures;
    table_view indentation[2]; /* bulk, track */
    table_view modulus_depth, dma_comparison, shift_factors, prony, roughness;
    table_view softening, flash;
    table_view power_spectrum, surfaces; /* of a measured counter surface */
    table_view record, wear;
    table_view validation, validation_sources, validation_running_in;
    table_view track_layer, identification;
    table_writer *answer;
} answer_context;

/* Adds a row to the answer. The sentence is a printf format. */
void answer_add_sentence(const answer_context *context, const char *question, answer_kind kind,
                         const char *format, ...) WT_PRINTF(4, 5);
/* Binds the views of the tables of a result. */
wt_status answer_context_bind(answer_context *context, const wt_result *result,
                              wt_error *err) WT_NODISCARD;
/* Describes the rubber, only if no later stage uses it: then the rubber is a result, not a step. */
void answer_rubber(const answer_context *context);
/* States the thickness of the layer that the curves allow, and compares it with the theory. */
void answer_track_layer(const answer_context *context);
/* Names the source of the specific wear rate of the layer, if a record measured one. */
void answer_layer_wear_rate(const answer_context *context, const char *question);
/* Describes a measured counter surface. */
void answer_surface(const answer_context *context);
/* States the critical energy and the wear rate identified from observations of the layer. */
void answer_identification(const answer_context *context);
/* States the measured friction and wear. */
void answer_record(const answer_context *context);
/* States whether the theory explains the measured friction. */
void answer_validation(const answer_context *context);

#endif
