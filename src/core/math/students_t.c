/* Quantiles of Student's t, and sums of errors with different degrees of freedom.
 *
 * Source: Satterthwaite, Biometrics Bull. 2 (1946) 110. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/math/students_t.h"
#include "core/base/array.h"
#include "weartrack/core.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* Level of all intervals. */
static const double confidence = 0.95;

moments sample_moments(const double *x, size_t n)
{
    moments m = {(double)n, 0.0, 0.0};
    for (size_t i = 0; i < n; i++)
        m.mean += x[i];
    m.mean /= m.n;
    for (size_t i = 0; i < n; i++)
        m.variance += (x[i] - m.mean) * (x[i] - m.mean);
    m.variance = n > 1 ? m.variance / (m.n - 1.0) : (double)NAN;
    return m;
}

double students_t_quantile(double df)
{
    const double p = 0.5 + 0.5 * confidence;
    return isinf(df) ? gsl_cdf_ugaussian_Pinv(p) : gsl_cdf_tdist_Pinv(p, df);
}

double wt_student_quantile(double freedom)
{
    return students_t_quantile(freedom);
}

/* From the side of the tail, which keeps its digits. */
double students_t_from_normal(double z, double df)
{
    return copysign(gsl_cdf_tdist_Qinv(gsl_cdf_ugaussian_Q(fabs(z)), df), z);
}

t_error t_error_sum(const t_error *parts, size_t n)
{
    double v = 0, square = 0;
    for (size_t i = 0; i < n; i++) {
        const double part = parts[i].error * parts[i].error;
        v += part;
        square += isinf(parts[i].df) || part == 0 ? 0 : part * part / parts[i].df;
    }
    return (t_error){sqrt(v), square > 0 ? v * v / square : (double)INFINITY};
}

t_error t_error_add_normal(t_error part, double known)
{
    const t_error parts[] = {part, {sqrt(known), (double)INFINITY}};
    return t_error_sum(parts, COUNT_OF(parts));
}
