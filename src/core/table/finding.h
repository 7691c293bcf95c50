/* Findings: the answers of a result to the questions of the user. One list is computed here from
 * the result values. Templates format its members and compute nothing. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_FINDING_H
#define WT_CORE_TABLE_FINDING_H

#include "core/table/result_value.h"

typedef enum finding_question {
    FINDING_TRACK_DIFFERS,
    FINDING_LAYER_THICKNESS,
    FINDING_FRICTION_CHANGE,
    FINDING_QUESTIONS
} finding_question;

typedef struct finding {
    finding_question question;
    finding_verdict verdict;
    finding_basis basis;
    sign_verdict sign;  /* side of the reference; SIGN_UNDECIDED unless the verdict is yes */
    bool as_if_layer;   /* true if the track is not shown to differ, so that a layer is assumed */
    result_value value; /* number, interval, range over model choices */
    double rest;        /* share of the range over model choices without the widest; NaN: unknown */
    char sentence[400]; /* explains the verdict */
    char remedy[1000];  /* what to measure next, and what that is worth; "" if unknown */
} finding;

/* Computes the findings in the order of the questions; those without a number are "not computed".
 * Returns true if the result compares moduli or has a layer. */
bool findings_compute(const result_value_tables *tables, finding findings[FINDING_QUESTIONS]);

const char *finding_question_text(finding_question question); /* "Is the track different?" */
const char *finding_subject_text(finding_question question);  /* "Layer thickness" */

/* True if the table "answer" has the findings: that of version 0.9.0 has other rows. */
bool findings_are_stated(const table_view *answer);
/* Side of the reference behind the verdict: ", softer"; "" where no side is shown. */
const char *finding_side_text(const finding *f);

#endif
