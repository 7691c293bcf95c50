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

/* Closed list; the text of each is the same in all outputs. */
typedef enum finding_verdict {
    FINDING_YES,             /* interval and model range are above or below the reference */
    FINDING_SAME,            /* interval within the margin of equivalence */
    FINDING_PREDICTED,       /* a theoretical value that no measurement of the result tests */
    FINDING_INCONCLUSIVE,    /* interval or model range includes the reference */
    FINDING_NOT_ENOUGH_DATA, /* a value without an interval */
    FINDING_NOT_COMPUTED,    /* an input is missing */
    FINDING_VERDICTS
} finding_verdict;

typedef enum finding_basis { FINDING_MEASURED, FINDING_FROM_THEORY, FINDING_GIVEN } finding_basis;

typedef struct finding {
    finding_question question;
    finding_verdict verdict;
    finding_basis basis;
    sign_verdict sign;  /* side of the reference; SIGN_UNDECIDED unless the verdict is yes */
    bool as_if_layer;   /* true if the track is not shown to differ, so that a layer is assumed */
    result_value value; /* number, interval, range over model choices, remedy */
} finding;

/* Computes the findings in the order of the questions. Returns their number: all questions if the
 * result compares moduli or has a layer, else 0. */
size_t findings_compute(const result_value_tables *tables, finding findings[FINDING_QUESTIONS]);

const char *finding_question_text(finding_question question); /* "Is the track different?" */
const char *finding_subject_text(finding_question question);  /* "Layer thickness" */
const char *finding_verdict_text(finding_verdict verdict);    /* "inconclusive" */
const char *finding_basis_text(finding_basis basis);          /* "measured" */
/* One sentence that explains the verdict. */
const char *finding_sentence(const finding *f);

#endif
