/* Means with errors of few degrees of freedom, as Student's t has them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_STUDENTS_T_H
#define WT_CORE_MATH_STUDENTS_T_H

#include <stddef.h>

typedef struct moments {
    double n, mean, variance; /* ddof 1; NaN for n < 2 */
} moments;

/* A standard error and its degrees of freedom, as Student's t has them. */
typedef struct t_error {
    double error, df;
} t_error;

moments moments_of(const double *x, size_t n);
double students_t_of_normal(double z, double df); /* beyond it lies as much of the law */
double normal_quantile(double part);              /* below it lies so large a part */
double students_t_quantile(double df);            /* 97.5 % of Student's t */
/* By Satterthwaite. */
t_error t_error_sum(const t_error *parts, size_t n);
/* The same of one with a normal variance that is known. */
t_error t_error_with(t_error part, double known);

#endif
