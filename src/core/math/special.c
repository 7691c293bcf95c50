/* Special functions from GSL, the nodes of a quadrature rule, quantiles of Student's t, and sums of
 * errors with different degrees of freedom.
 *
 * Source: Satterthwaite, Biometrics Bull. 2 (1946) 110.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/special.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/math/simd.h"
#include "core/math/students_t.h"
#include "weartrack/core.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_psi.h>
#include <gsl/gsl_spline.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct akima_curve {
    gsl_spline *spline;
};

akima_curve *akima_curve_new(const double *x, const double *y, size_t n)
{
    akima_curve *c = wt_alloc(1, sizeof *c);
    gsl_quiet();
    c->spline = gsl_spline_alloc(gsl_interp_akima, n);
    if (c->spline == NULL || gsl_spline_init(c->spline, x, y, n) != 0)
        out_of_memory(n * sizeof *x); /* points that increase have no other failure */
    return c;
}

double akima_curve_value(const akima_curve *c, double x)
{
    return gsl_spline_eval(c->spline, x, NULL);
}

void akima_curve_free(akima_curve *c)
{
    if (c != NULL)
        gsl_spline_free(c->spline);
    free(c);
}

static void disable_gsl_handler(void)
{
    gsl_set_error_handler_off();
}

void gsl_quiet(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, disable_gsl_handler);
}

double digamma(double x)
{
    gsl_sf_result result;
    if (!(x > 0.0) || isinf(x) || gsl_sf_psi_e(x, &result) != GSL_SUCCESS)
        return (double)NAN;
    return result.val;
}

const double gauss_8_node[4] = {0.1834346424956498049, 0.5255324099163289858, 0.7966664774136267396,
                                0.9602898564975362317};
const double gauss_8_weight[4] = {0.3626837833783619830, 0.3137066458778872873,
                                  0.2223810344533744706, 0.1012285362903762592};

/* ---- Chebyshev polynomials ------------------------------------------------------------------- */

WIDE_REGISTERS
void chebyshev_fit(const double *restrict value, size_t degree, const double *restrict fit,
                   double *restrict coefficient)
{
    const size_t step = CHEBYSHEV_DEGREE_MAX / degree;
    double sum[CHEBYSHEV_FIT_STRIDE] = {0};
    for (size_t k = 0; k <= degree; k++)
        for (size_t j = 0; j < CHEBYSHEV_FIT_STRIDE; j++)
            sum[j] += value[k * step] * fit[k * CHEBYSHEV_FIT_STRIDE + j];
    memcpy(coefficient, sum, (CHEBYSHEV_DEGREE_MAX + 1) * sizeof *coefficient);
}

double chebyshev_tail(const double *coefficient, const double *value, size_t degree)
{
    double least = (double)INFINITY, most = 0;
    for (size_t k = 0; k <= CHEBYSHEV_DEGREE_MAX; k += CHEBYSHEV_DEGREE_MAX / degree) {
        least = fmin(least, value[k]);
        most = fmax(most, value[k]);
    }
    const double last = fmax(fabs(coefficient[degree]), fabs(coefficient[degree - 1]));
    const double tail = 2 * fmax(last, 0.1 * fabs(coefficient[degree - 2]));
    return most > 0 ? tail / (least > 0 ? least : most) : 0;
}

double chebyshev_to_monomials(double *coefficient, size_t *degree, double allowed)
{
    double t[CHEBYSHEV_DEGREE_MAX + 1] = {0}, last[CHEBYSHEV_DEGREE_MAX + 1] = {1},
                                    now[CHEBYSHEV_DEGREE_MAX + 1] = {0, 1};
    double cut = 0, sum = 0;
    size_t kept = *degree;
    while (kept > 2 && cut + fabs(coefficient[kept]) <= allowed)
        cut += fabs(coefficient[kept--]);
    t[0] = coefficient[0];
    for (size_t n = 1; n <= kept; n++) {
        double next[CHEBYSHEV_DEGREE_MAX + 1] = {0};
        for (size_t k = 0; k <= n; k++) {
            t[k] += coefficient[n] * now[k];
            next[k] -= last[k];
        }
        for (size_t k = 0; k <= n && k < CHEBYSHEV_DEGREE_MAX; k++)
            next[k + 1] += 2 * now[k];
        memcpy(last, now, sizeof last);
        memcpy(now, next, sizeof now);
    }
    for (size_t k = 0; k <= CHEBYSHEV_DEGREE_MAX; k++) {
        coefficient[k] = t[k];
        sum += fabs(t[k]);
    }
    *degree = kept;
    return cut + 2 * DBL_EPSILON * sum;
}

/* ---- Student's t ----------------------------------------------------------------------------- */

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
