/* Moments, quantiles and errors with degrees of freedom for Student's t. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_MATH_STUDENTS_T_H
#define WT_CORE_MATH_STUDENTS_T_H

#include <stddef.h>

typedef struct moments {
    double n, mean, variance; /* variance with n - 1; NaN for n < 2 */
} moments;

/* Standard error with its degrees of freedom. */
typedef struct t_error {
    double error, df;
} t_error;

moments sample_moments(const double *x, size_t n);
/* Value of Student's t with the tail probability of z, and the quantile 0.975. */
double students_t_from_normal(double z, double df);
double students_t_quantile(double df);
/* Adds independent errors by the Welch-Satterthwaite equation. */
t_error t_error_sum(const t_error *parts, size_t n);
/* Adds a normal variance without uncertainty. */
t_error t_error_add_normal(t_error part, double known);

/* Half width of the central 95 % interval, in standard deviations. */
#define NORMAL_95 1.959963984540054

#endif
