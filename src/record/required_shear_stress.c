/* Required shear stress of a record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/validation.h"

#include "core/base/clocale.h"

#include <math.h>
#include <stdlib.h>

/* A value far above 0 has a log-normal interval, because its inputs (pressure, area, modulus ratio)
 * are factors. A smaller one has a normal interval that may include 0. */
static const double well_above = 3; /* standard errors */

wt_interval required_shear_interval(double value, double error, double df)
{
    const double half = agreement_quantile(df) * error, factor = exp(half / value);
    if (value > well_above * error)
        return (wt_interval){value, error, value / factor, value * factor};
    return (wt_interval){value, error, value - half, value + half};
}

/* Weighted mean of the required shear stress of the steps, for the nominal values and for each
 * draw. */
static void find_required_shear(validation *v)
{
    const model_variant *const t = &v->shear;
    v->needed = required_shear_interval(t->fit.coefficient[0], t->fit.error[0], t->fit.df[0]);
    v->needed_shear = wt_alloc(1 + v->p.n_draws, sizeof *v->needed_shear);
    for (size_t k = 0; k <= v->p.n_draws; k++)
        for (size_t i = 0; i < v->steps.n; i++) {
            const double rest = v->steps.step[i].friction -
                                prediction_total(&v->p, k, v->layered, i, 0),
                         slope = prediction_total(&v->p, k, v->layered, i, 1) -
                                 prediction_total(&v->p, k, v->layered, i, 0);
            v->needed_shear[k] += t->fit.weight[i] * rest / slope;
        }
}

wt_status required_shear_compute(validation *v, wt_error *err)
{
    wt_status status =
        model_variant_fit_shear(&v->p, &v->steps, v->layered, v->work->seed, &v->shear, err);
    if (status == WT_OK)
        find_required_shear(v);
    if (status != WT_OK || !(v->needed.value > 0) || v->ratio[0].fit.terms < 2)
        return status; /* one velocity determines one number, the shear stress */
    const ratio_inputs of = {&v->p, &v->steps, v->needed_shear, v->layered};
    status = model_variant_fit_ratio(&of, v->work->seed, &v->shape, err);
    if (status == WT_OK)
        agreement_assess(&v->shape.fit, validation_margin(v));
    return status;
}

/* Source of the range, so that a reader can disagree. */
static const char literature[] = "the range of the literature for rubber on rough counter surfaces";

static void set_plausibility(const validation *v, table_writer *t)
{
    const double low = v->job->plausible_low, high = v->job->plausible_high;
    const wt_interval *const n = &v->needed;
    const char *const words = n->high < 0
                                  ? "no: the hysteresis part alone is more than was measured"
                              : n->low > low && n->high < high ? "yes: all of its interval is in"
                              : n->high < low                  ? "no: it is below"
                              : n->low > high                  ? "no: it is above"
                                              : "cannot say: it may be in or out of";
    char text[320];
    if (n->high < 0)
        clocale_print(text, sizeof text, "%s", words);
    else
        clocale_print(text, sizeof text, "%s %.3g MPa to %.3g MPa, %s", words, 1e-6 * low,
                      1e-6 * high, literature);
    validation_set_text(t, VALIDATION_KEY_PLAUSIBLE, text);
}

void required_shear_set_keys(const validation *v, table_writer *t)
{
    if (v->shear.n == 0)
        return;
    validation_set_value(t, VALIDATION_KEY_NEEDED, v->needed.value, v->needed.standard_error,
                         (double)NAN);
    validation_set_value(t, VALIDATION_KEY_NEEDED_LOW, v->needed.low, 0, 0);
    validation_set_value(t, VALIDATION_KEY_NEEDED_HIGH, v->needed.high, 0, 0);
    set_plausibility(v, t);
    if (v->shape.n > 0)
        validation_set_text(t, VALIDATION_KEY_SHAPE, model_variant_verdict(v, &v->shape).text);
    else
        validation_set_text(t, VALIDATION_KEY_SHAPE,
                            v->needed.value > 0
                                ? "cannot say: with so few velocities the shear stress takes up "
                                  "whatever was measured"
                                : "does not: the hysteresis part alone is more than was measured");
}
