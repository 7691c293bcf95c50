/* A run as its answer sees it: the tables it gave, bound once, and the sentences so far. Internal
 * to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_ANSWER_CONTEXT_H
#define WT_CASE_ANSWER_ANSWER_CONTEXT_H

#include "case/answer/format_number.h"
#include "case/plan/plan.h"

/* What a caveat changes, in the order in which they are told. */
typedef enum caveat_of {
    CAVEAT_WHOLE, /* files or stages that failed */
    CAVEAT_DATA,  /* whether the data mean what they are taken for */
    CAVEAT_VERDICT,
    CAVEAT_THICKNESS,
    CAVEAT_FRICTION,
    CAVEAT_MODULI,
    CAVEAT_CONDITIONS, /* what was taken for granted */
    CAVEATS_OF
} caveat_of;

enum { CAVEATS_OPEN = 5 }; /* the others are folded */

typedef struct caveat {
    caveat_of of;
    char *text;
} caveat;

typedef struct answer_context {
    const wt_case *c;
    const flow_plan *plan;
    const wt_log *log;
    result_value_tables found;
    table_view failures;
    table_view indentation[2]; /* bulk, track */
    table_view modulus_depth, dma_comparison, shift_factors, prony, roughness;
    table_view power_spectrum, surfaces; /* of a measured counter surface */
    table_view record, wear;
    table_view validation, validation_sources, validation_running_in;
    table_view layer_bands, layer_feedback, existence, running_in, track_layer, identification;
    table_writer *answer;
    caveat *caveats;
    size_t n_caveats;
    wt_status status; /* of remembering a caveat */
} answer_context;

/* A row of the answer; the sentence is a format. */
void answer_add_sentence(const answer_context *story, const char *question, const char *kind,
                         const char *format, ...) WT_PRINTF(4, 5);
/* Kept until all are known. */
void answer_caveat(answer_context *story, caveat_of of, const char *format, ...) WT_PRINTF(3, 4);
/* The rows of kind "caveat", those that change most first, then the others of kind "folded". */
void answer_put_caveats(answer_context *story);
/* What the rubber is like, only where no later stage uses it: there it is an answer, else a step.
 */
void answer_rubber(const answer_context *story);
/* How thick the curves alone allow the layer to be, and whether the theory agrees. */
void answer_track_layer(const answer_context *story);
/* Whose specific wear rate the layer has, where a record measured one. */
void answer_wear_of_layer(const answer_context *story, const char *question);
/* The layer under loads in turn, acting back and where it exists; its friction in running-in. */
void answer_layer_models(const answer_context *story);
void answer_running_in(const answer_context *story);
/* What a measured counter surface is like. */
void answer_surface(const answer_context *story);
/* Critical energy and wear rate by what is seen of the layer. */
void answer_identification(const answer_context *story);
/* Friction and wear as measured. */
void answer_record(const answer_context *story);
/* Whether the theory explains the friction that was measured. */
void answer_validation(const answer_context *story);
void answer_context_clear(answer_context *story);

#endif
