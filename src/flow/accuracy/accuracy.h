/* Error against run time of the numerical parts: each a problem whose answer is known otherwise,
 * and the methods that solve it, with a setting that is swept. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_ACCURACY_H
#define WEARTRACK_FLOW_ACCURACY_H

#include "weartrack/flow.h"

#include <math.h>

/* What a method gives: its largest relative error, and what it states that to be; NaN: nothing. */
typedef struct accuracy_errors {
    double true_error, stated_error;
} accuracy_errors;

enum { ACCURACY_METHODS = 3, ACCURACY_VALUES = 8 }; /* room in the lists below */

typedef struct accuracy_method {
    const char *name, *setting;
    double values[ACCURACY_VALUES]; /* rising work; ends with 0 */
    /* The timed work; what it gives stays in `problem`. */
    wt_status (*solve)(void *problem, double value, wt_error *err);
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
