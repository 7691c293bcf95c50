/* Special functions from GSL, and the nodes of a quadrature rule. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/math/special.h"
#include "core/base/memory.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_psi.h>
#include <gsl/gsl_spline.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

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
