/* ln Qf(d) under a layer of thickness d as Chebyshev series on subintervals of the thickness. The
 * first is as long as the shortest wave, below which the layer affects no wave. Each further one is
 * as long as all before it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_feedback_rate.h"
#include "core/base/memory.h"

#include <gsl/gsl_chebyshev.h>
#include <math.h>

/* Order for a function that is smooth over a factor of two: the last coefficients are rounding. */
enum { ORDER = 24 };

void feedback_rate_clear(feedback_rate *feedback)
{
    for (size_t i = 0; i < feedback->n; i++) {
        gsl_cheb_free(feedback->subinterval[i].value);
        gsl_cheb_free(feedback->subinterval[i].slope);
    }
    feedback->n = 0;
}

wt_status feedback_rate_create(feedback_formation_fn f, void *user, double first, double target,
                               feedback_rate *feedback, wt_error *err)
{
    gsl_function function = {f, user};
    *feedback = (feedback_rate){.target = target};
    for (double low = 0, high = fmin(first, target); low < target; high *= 2) {
        if (feedback->n == FEEDBACK_SUBINTERVALS)
            return wt_fail(err, WT_E_RANGE, "a layer is too thick beside the shortest wave");
        feedback_subinterval *p = &feedback->subinterval[feedback->n];
        *p = (feedback_subinterval){low, 2 * high > target ? target : high, gsl_cheb_alloc(ORDER),
                                    gsl_cheb_alloc(ORDER)};
        feedback->n++;
        if (p->value == NULL || p->slope == NULL)
            out_of_memory(sizeof(gsl_cheb_series));
        gsl_cheb_init(p->value, &function, p->low, p->high);
        gsl_cheb_calc_deriv(p->slope, p->value);
        low = p->high;
    }
    return WT_OK;
}

static const feedback_subinterval *find_subinterval(const feedback_rate *feedback, double thickness)
{
    size_t i = 0;
    while (i + 1 < feedback->n && thickness > feedback->subinterval[i].high)
        i++;
    return &feedback->subinterval[i];
}

double feedback_rate_log(const feedback_rate *feedback, double thickness)
{
    return gsl_cheb_eval(find_subinterval(feedback, thickness)->value, thickness);
}

double feedback_rate_slope(const feedback_rate *feedback, double thickness)
{
    return gsl_cheb_eval(find_subinterval(feedback, thickness)->slope, thickness);
}
