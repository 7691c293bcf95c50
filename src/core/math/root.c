/* Bracketed roots by Brent's method and by bisection; maxima by golden section search.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/root.h"
#include "core/base/memory.h"
#include "core/math/special.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

void root_bisect(root_predicate below, void *user, double *low, double *high, double close,
                 int most)
{
    for (int i = 0; i<most && * high - *low> close * fmax(fabs(*low), fabs(*high)); i++) {
        const double middle = 0.5 * (*low + *high);
        if (middle <= *low || middle >= *high)
            break;
        *(below(middle, user) ? low : high) = middle;
    }
}

double root_maximum(root_fn f, void *user, double low, double high, int sections)
{
    const double golden = 0.6180339887498949; /* (sqrt 5 - 1)/2 */
    for (int i = 0; i < sections; i++) {
        /* Both points are recomputed, because a stored one drifts from its share of the range. */
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        if (f(left, user) > f(right, user))
            high = right;
        else
            low = left;
    }
    return 0.5 * (low + high);
}

double root_displacement(root_fn f, void *user, double root, double error, double reach,
                         double least)
{
    for (int i = 0; i < 1100; i++) {
        const bool above = f(root + reach, user) < -error;
        const bool below = root - reach <= 0 || f(root - reach, user) > error;
        if (above && below)
            break;
        reach = fmax(2 * reach, least);
    }
    return reach;
}

/* Function with known values at both limits of the bracket. */
typedef struct bracketed_function {
    root_fn f;
    void *user;
    double low, high, at_low, at_high;
} bracketed_function;

static double bracketed_value(double x, void *user)
{
    const bracketed_function *e = user;
    return x <= e->low ? e->at_low : x >= e->high ? e->at_high : e->f(x, e->user);
}

wt_status root_find(root_fn f, void *user, double low, double high, double close, double *root,
                    wt_error *err)
{
    const double at_low = f(low, user);
    const double at_high = f(high, user);
    bracketed_function bracket = {f, user, low, high, at_low, at_high};
    if (at_low == 0 || at_high == 0) {
        *root = at_low == 0 ? low : high;
        return WT_OK;
    }
    gsl_quiet();
    wt_status status = WT_OK;
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (solver == NULL)
        out_of_memory(sizeof *solver);
    gsl_function function = {.function = bracketed_value, .params = &bracket};
    const int limit = 300;
    int code = gsl_root_fsolver_set(solver, &function, low, high);
    for (int i = 0; code == GSL_SUCCESS; i++) {
        if (i == limit) {
            code = GSL_EMAXITER;
            break;
        }
        const double width = gsl_root_fsolver_x_upper(solver) - gsl_root_fsolver_x_lower(solver);
        if (width <= fmax(close, 2 * DBL_EPSILON * fabs(gsl_root_fsolver_root(solver))))
            break;
        code = gsl_root_fsolver_iterate(solver);
    }
    if (code == GSL_SUCCESS)
        *root = gsl_root_fsolver_root(solver);
    else
        status = wt_fail(err, WT_E_CONVERGENCE, "no root between %g and %g: %s", low, high,
                         gsl_strerror(code));
    gsl_root_fsolver_free(solver);
    return status;
}
