/* Error against run time of the numerical parts: each a problem whose answer is known otherwise,
 * and the methods that solve it, with a setting that is swept. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_ACCURACY_H
#define WT_STUDY_ACCURACY_H

#include "core/table/table_rows.h"
#include "weartrack/flow.h"

#include <math.h>

/* What a method gives: its largest relative error, and what it states that to be; NaN: nothing. */
typedef struct accuracy_errors {
    double true_error, stated_error;
} accuracy_errors;

/* The timed work at a value of its setting; what it gives stays in `problem`. */
typedef wt_status accuracy_solve(void *problem, double value, wt_error *err);

enum { ACCURACY_METHODS = 3, ACCURACY_VALUES = 8 }; /* room in the lists below */

typedef struct accuracy_method {
    const char *name, *setting;
    double values[ACCURACY_VALUES]; /* rising work; ends with 0 */
    accuracy_solve *solve;
} accuracy_method;

typedef struct accuracy_part {
    const char *name, *words; /* words: the problem, and how its answer is known */
    size_t size;              /* of the problem, which begins as zeros */
    /* Makes the problem and its reference; *reference_error: what that is good to. */
    wt_status (*begin)(void *problem, double *reference_error, wt_error *err);
    accuracy_errors (*judge)(const void *problem); /* of the last solution */
    void (*end)(void *problem);                    /* also after a failure of begin */
    accuracy_method methods[ACCURACY_METHODS + 1]; /* ends with a name that is NULL */
} accuracy_part;

/* Each ends with a name that is NULL. */
extern const accuracy_part accuracy_contact[], accuracy_spectrum[], accuracy_angular[],
    accuracy_friction[], accuracy_layer[];

typedef struct accuracy_timing {
    double median, spread; /* [s] */
    size_t repeats;
} accuracy_timing;
wt_status accuracy_time(accuracy_solve *solve, void *problem, double value, size_t repeats,
                        accuracy_timing *t, wt_error *err) WT_NODISCARD;

/* A row of the table "work_precision". A true error below that of the reference stands as that:
 * no less can be told. */
typedef struct accuracy_row {
    const char *part, *method, *setting, *words;
    double value, reference_error;
    accuracy_errors errors;
    accuracy_timing time;
} accuracy_row;
void accuracy_put(table_writer *t, accuracy_row row);
/* The rows of all parts that are built in, or of one. The writer keeps the status. */
void accuracy_add_parts(const wt_accuracy_job *job, const wt_job *work, table_writer *t,
                        wt_error *err);

/* Where `below` ceases to hold, by so many halves of the range. */
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

/* |value / truth - 1|, 0 for two zeros. */
static inline double accuracy_relative(double value, double truth)
{
    const double difference = fabs(value - truth);
    return difference > 0 ? difference / fabs(truth) : difference;
}

#endif
