/* Test of the contact law by the curves of a group: Hotelling's T^2 of the mean of the first
 * cosines of the residual over the contact. The scatter of the curves determines the test for any
 * noise.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve.h"

#include "core/math/special.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

/* T^2 requires more curves than cosines. Twice as many give as many degrees of freedom. */
enum { W = CURVE_WAVES, LEAST_CURVES = 2 * W };

wt_pooled_misfit wt_pooled_misfit_compute(const double (*misfit)[WT_MISFIT_TERMS], size_t n)
{
    double mean[W] = {0.0}, scatter[W * W] = {0.0}, solved[W], amplitude = 0.0, t = 0.0;
    wt_pooled_misfit pool = {.n = n, .misfit = (double)NAN, .p_value = (double)NAN};
    if (n < LEAST_CURVES)
        return pool;
    gsl_quiet();
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < W; a++)
            mean[a] += misfit[i][a] / (double)n;
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < W; a++)
            for (size_t b = 0; b < W; b++)
                scatter[a * W + b] +=
                    (misfit[i][a] - mean[a]) * (misfit[i][b] - mean[b]) / (double)(n - 1);
    gsl_matrix_view matrix = gsl_matrix_view_array(scatter, W, W);
    gsl_vector_view x = gsl_vector_view_array(solved, W);
    for (size_t a = 0; a < W; a++) {
        solved[a] = mean[a];
        amplitude += 0.5 * mean[a] * mean[a];
    }
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
        return pool;
    for (size_t a = 0; a < W; a++)
        t += mean[a] * solved[a];
    const double curves = (double)n;
    pool.misfit = sqrt(amplitude);
    pool.p_value = gsl_cdf_fdist_Q(curves * t * (curves - W) / (W * (curves - 1.0)), W, curves - W);
    return pool;
}
