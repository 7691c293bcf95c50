/* Error against run time of the numerical parts. Each part has a problem with a known answer and
 * methods whose setting is swept.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_PRECISION_H
#define WT_TESTS_PRECISION_H

#include "weartrack/weartrack.h"

#include <math.h>

/* Largest relative error of a method, and the error that it states; NaN if none. */
typedef struct precision_errors {
    double true_error, stated_error;
} precision_errors;

/* Solves the problem at a value of the setting; this call is timed. The solution stays in
 * `problem`. */
typedef wt_status precision_solve(void *problem, double value, wt_error *err);

/* Capacity of the lists below. */
enum { PRECISION_METHODS = 3, PRECISION_VALUES = 8, PRECISION_KNOWN = 3 };

typedef struct measured_method {
    const char *name, *setting;
    double values[PRECISION_VALUES]; /* in order of rising work; ends with 0 */
    precision_solve *solve;
} measured_method;

typedef struct precision_part {
    const char *name, *words; /* words: the problem and its reference */
    size_t size;              /* of the problem, which starts as zeros */
    /* Creates the problem and its reference. *reference_error: relative error of the reference. */
    wt_status (*begin)(void *problem, double *reference_error, wt_error *err);
    precision_errors (*errors_of_solution)(const void *problem); /* error of the last solution */
    void (*end)(void *problem);                                  /* frees the problem */
    measured_method methods[PRECISION_METHODS + 1];              /* ends with a NULL name */
    bool is_bound; /* the stated error is a bound of the true one, not a standard error */
    /* known errors of the textbook method from another source, by the value of its setting */
    struct {
        double value, error;
    } known[PRECISION_KNOWN];
} precision_part;

/* Each list ends with a NULL name. */
extern const precision_part precision_contact[], precision_spectrum[], precision_angular[],
    precision_friction[], precision_layer[];

/* Prints the table "work_precision" of all parts, or of the named one, as a stream. Returns the
 * number of broken checks, which standard error lists. */
int bench_precision(const char *part);

/* Bisects for the argument at which `below` becomes false, with a number of halvings of the
 * range. */
static inline long double precision_bisect(bool (*below)(const void *user, long double x),
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
static inline double precision_relative(double value, double truth)
{
    const double difference = fabs(value - truth);
    return difference > 0 ? difference / fabs(truth) : difference;
}

#endif
