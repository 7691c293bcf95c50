/* The answer of a run in plain sentences. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_ANSWER_H
#define WEARTRACK_FLOW_ANSWER_H

#include "flow/run/steps.h"

/* What became of a stage. */
typedef enum flow_outcome { FLOW_LEFT_OUT, FLOW_DONE, FLOW_FAILED, FLOW_BLOCKED } flow_outcome;

/* A run as its answer sees it. */
typedef struct flow_story {
    const wt_case *c;
    const flow_plan *plan;
    const flow_outcome *outcome; /* [flow_n_stages] */
    const wt_result *result;
    const wt_parselog *log;
    const wt_table *failures;
} flow_story;

/* Table "answer". */
wt_status flow_answer(const flow_story *story, wt_table **table, wt_error *err) WT_NODISCARD;

/* Adds one row; the text is a format. */
wt_status flow_answer_add(wt_table *table, wt_error *err, const char *question, const char *kind,
                          const char *format, ...) WT_PRINTF(5, 6) WT_NODISCARD;
/* Rows of kind "caveat". */
wt_status flow_caveats(const flow_story *story, wt_table *table, wt_error *err) WT_NODISCARD;

/* "1.15 um" in a buffer of its own, for use in a format; +- the standard error where one is known.
 */
typedef struct flow_words {
    char text[96];
} flow_words;
flow_words flow_say(double value, const char *unit);
flow_words flow_say_estimate(wt_estimate estimate);
flow_words flow_say_celsius(double kelvin);
/* Reads an estimate key of a table (NULL allowed); all NaN if absent. */
wt_estimate flow_key(const wt_table *table, const char *key);

#endif
