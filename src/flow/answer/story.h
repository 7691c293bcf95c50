/* A run as its answer sees it: the tables it gave, bound once, and the sentences so far. Internal
 * to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_STORY_H
#define WEARTRACK_FLOW_STORY_H

#include "flow/answer/words.h"
#include "flow/plan/plan.h"

#include "data/tables/tables.h"

typedef struct answer_story {
    const wt_case *c;
    const flow_plan *plan;
    const wt_parselog *log;
    table_view failures;
    table_view indentation[2]; /* bulk, track */
    table_view modulus_groups, modulus_budget, modulus_depth, comparison, dma_comparison;
    table_view shift_factors, prony, roughness;
    table_view friction, layer, what_if;
    table_writer *answer;
} answer_story;

/* A row of the answer; the sentence is a format. */
void answer_say(const answer_story *story, const char *question, const char *kind,
                const char *format, ...) WT_PRINTF(4, 5);

#endif
