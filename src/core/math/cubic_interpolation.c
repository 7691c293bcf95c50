/* Akima interpolation of points. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/cubic_interpolation.h"

#include "core/math/special.h"
#include "weartrack/core.h"

#include <gsl/gsl_spline.h>
#include <stdlib.h>

struct curve {
    gsl_spline *spline;
};

curve *akima_curve_new(const double *x, const double *y, size_t n)
{
    curve *c = wt_alloc(1, sizeof *c);
    gsl_quiet();
    c->spline = gsl_spline_alloc(gsl_interp_akima, n);
    if (c->spline == NULL || gsl_spline_init(c->spline, x, y, n) != 0) {
        akima_curve_free(c);
        return NULL;
    }
    return c;
}

double akima_curve_value(const curve *c, double x)
{
    return gsl_spline_eval(c->spline, x, NULL);
}

void akima_curve_free(curve *c)
{
    if (c != NULL)
        gsl_spline_free(c->spline);
    free(c);
}
