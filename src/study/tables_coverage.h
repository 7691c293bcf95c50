/* Columns and keys of the table "coverage": share of stated intervals that contain the true value.
 * Only the table registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_COVERAGE_H
#define WT_STUDY_TABLES_COVERAGE_H

#define COVERAGE_COLUMNS(X)                                                                        \
    X(COVERAGE_NUMBER, AS(number), "whose interval it is", TEXT, LABEL("Number"))                  \
    X(COVERAGE_TRIALS, "trials", "how often it was stated", NUMBER, SHOWS(found.n),                \
      LABEL("Trials"))                                                                             \
    X(COVERAGE_ONE, "within_one",                                                                  \
      "share of the trials in which the truth lies within one "                                    \
      "standard error; stated: 0.683",                                                             \
      NUMBER, SHOWS(found.one), LABEL("Within one standard error"))                                \
    X(COVERAGE_BOTH, "covered_95", "share in which it lies in the 95 % interval; stated: 0.95",    \
      NUMBER, SHOWS(found.both), LABEL("In the 95 % interval"))                                    \
    X(COVERAGE_LOW, IN(found.known, low),                                                          \
      "lower end of the 95 % interval of that share by the number of trials", NUMBER,              \
      LABEL("Share known from"))                                                                   \
    X(COVERAGE_HIGH, IN(found.known, high), "upper end", NUMBER, LABEL("to"))                      \
    X(COVERAGE_SCATTER, IN(found, scatter),                                                        \
      "scatter of the number over the trials, over the standard error stated (root of the mean "   \
      "squares)",                                                                                  \
      NUMBER, LABEL("Scatter over stated"))                                                        \
    X(COVERAGE_VERDICT, IN(found.known, verdict),                                                  \
      "holds: the share is known to be 0.9 or more; too narrow or too wide: it is outside 0.92 "   \
      "to 0.98, and chance alone would do that once in 400; cannot say",                           \
      TEXT, LABEL("Verdict"))                                                                      \
    X(COVERAGE_SETTLED_BY, "settled_by",                                                           \
      "where the verdict cannot say: how many trials would tell if the share stays what it is",    \
      NUMBER, SHOWS(found.known.trials), LABEL("Trials that would tell"), SPARSE)

#define COVERAGE_KEYS(X)                                                                           \
    X(COVERAGE_KEY_ANSWER, "answer", TEXT, LABEL("How often the intervals hold"))                  \
    X(COVERAGE_KEY_CAUTION, "limitations", TEXT, LABEL("What this cannot tell"))                   \
    X(COVERAGE_KEY_REGENERATED, "regenerated", TEXT, LABEL("What was drawn anew"))                 \
    X(COVERAGE_KEY_TRIALS, "trials", NUMBER, LABEL("Trials"))                                      \
    X(COVERAGE_KEY_LOST, "trials_lost", NUMBER, LABEL("Trials without an answer"))

#endif
