/* Error against run time of the numerical parts. Each part has a problem with a known answer and
 * methods whose setting is swept. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_ACCURACY_H
#define WT_STUDY_ACCURACY_H

#include "core/table/table_rows.h"
#include "weartrack/study.h"

#include <math.h>

/* Largest relative error of a method, and the error that it states; NaN if none. */
typedef struct accuracy_errors {
    double true_error, stated_error;
} accuracy_errors;

/* Solves the problem at a value of the setting; this call is timed. The solution stays in
 * `problem`. */
typedef wt_status accuracy_solve(void *problem, double value, wt_error *err);

enum { ACCURACY_METHODS = 3, ACCURACY_VALUES = 8 }; /* capacity of the lists below */

typedef struct accuracy_method {
    const char *name, *setting;
    double values[ACCURACY_VALUES]; /* in order of rising work; ends with 0 */
    accuracy_solve *solve;
} accuracy_method;

typedef struct accuracy_part {
    const char *name, *words; /* words: the problem and its reference */
    size_t size;              /* of the problem, which starts as zeros */
    /* Creates the problem and its reference. *reference_error: relative error of the reference. */
    wt_status (*begin)(void *problem, double *reference_error, wt_error *err);
    accuracy_errors (*errors_of_solution)(const void *problem); /* error of the last solution */
    void (*end)(void *problem);                    /* frees the problem, also after a failure of
                                                      begin */
    accuracy_method methods[ACCURACY_METHODS + 1]; /* ends with a NULL name */
} accuracy_part;

/* Each list ends with a NULL name. */
extern const accuracy_part accuracy_contact[], accuracy_spectrum[], accuracy_angular[],
    accuracy_friction[], accuracy_layer[];

typedef struct accuracy_timing {
    double median, spread; /* [s] */
    size_t repeats;
} accuracy_timing;
wt_status accuracy_time(accuracy_solve *solve, void *problem, double value, size_t repeats,
                        accuracy_timing *t, wt_error *err) WT_NODISCARD;

/* Adds a row to the table "work_precision". A true error below that of the reference is replaced by
 * the latter. */
typedef struct accuracy_row {
    const char *part, *method, *setting, *words;
    double value, reference_error;
    accuracy_errors errors;
    accuracy_timing time;
} accuracy_row;
void accuracy_add_row(table_writer *t, accuracy_row row);
/* Adds the rows of all built-in parts, or of the requested part. The writer stores the status. */
void accuracy_add_parts(const wt_accuracy_job *job, const wt_job *work, table_writer *t,
                        wt_error *err);

/* Bisects for the argument at which `below` becomes false, with a number of halvings of the
 * range. */
static inline long double accuracy_bisect(bool (*below)(const void *user, long double x),
                                          const void *user, long double low, long double high,
                                          int steps)
{
    for (int i = 0; i < steps; i++) {
        const long double middle = (low + high) / 2;
        *(below(user, middle) ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

/* Returns |value / truth - 1|; 0 for two zeros. */
static inline double accuracy_relative(double value, double truth)
{
    const double difference = fabs(value - truth);
    return difference > 0 ? difference / fabs(truth) : difference;
}

#endif
