/* Columns and keys of the table "work_precision": error and time of each method as its setting is
 * swept. Only the table registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_ACCURACY_H
#define WT_STUDY_TABLES_ACCURACY_H

#define PRECISION_METHODS(X)                                                                       \
    X(METHOD_OF_PROGRAM, "weartrack")                                                              \
    X(METHOD_OF_TEXTBOOK, "textbook")

#define WORK_PRECISION_COLUMNS(X)                                                                  \
    X(WORK_PRECISION_PART, AS(part), "numerical part", TEXT, LABEL("Part"))                        \
    X(WORK_PRECISION_METHOD, AS(method), "weartrack or the textbook", ENUM(precision_method),      \
      LABEL("Method"))                                                                             \
    X(WORK_PRECISION_SETTING, AS(setting), "what is swept", TEXT, LABEL("Setting"))                \
    X(WORK_PRECISION_VALUE, AS(value), "its value", NUMBER, LABEL("Value"))                        \
    X(WORK_PRECISION_TRUE_ERROR, IN(errors, true_error),                                           \
      "largest relative error against the reference; that of the reference where it is smaller, "  \
      "for no less can be told",                                                                   \
      NUMBER, LABEL("True error"))                                                                 \
    X(WORK_PRECISION_STATED_ERROR, IN(errors, stated_error), "the same as stated by the method",   \
      NUMBER, LABEL("Stated error"))                                                               \
    X(WORK_PRECISION_REFERENCE_ERROR, AS(reference_error),                                         \
      "what the reference is good to, by a second computation of it", NUMBER,                      \
      LABEL("Error of the reference"))                                                             \
    X(WORK_PRECISION_SECONDS, "seconds", "processor time, median of the repeats", SI(TIME),        \
      SHOWS(time.median), LABEL("Time"))                                                           \
    X(WORK_PRECISION_SPREAD, IN(time, spread), "half the range of the middle half of them",        \
      SI(TIME), LABEL("Spread"), LIKE(WORK_PRECISION_SECONDS))                                     \
    X(WORK_PRECISION_REPEATS, IN(time, repeats), "how often it was timed", NUMBER,                 \
      LABEL("Repeats"))                                                                            \
    X(WORK_PRECISION_WORDS, AS(words), "the problem and its reference", TEXT, LABEL("Problem"))

#define WORK_PRECISION_KEYS(X)                                                                     \
    X(WORK_PRECISION_KEY_ANSWER, "answer", TEXT, LABEL("What more work buys"), OPTIONAL)

#endif
