/* Verdict on a model variant and its text.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/validation.h"

#include "core/base/clocale.h"
#include "core/math/normal_quantile.h"

#include <math.h>
#include <stdlib.h>

double validation_margin(const validation *v)
{
    return log1p(v->job->margin);
}

double validation_discrepancy_variance(const validation *v)
{
    const double off = validation_margin(v) / NORMAL_95;
    return off * off;
}

const char *validation_verdict(agreement_verdict verdict)
{
    static const char *const words[] = {[AGREEMENT_INCONCLUSIVE] = "cannot say",
                                        [AGREEMENT_YES] = "explains",
                                        [AGREEMENT_NO] = "does not"};
    return words[verdict];
}

wt_interval validation_factor(double value, double error, double df)
{
    const double half = agreement_quantile(df) * error, factor = exp(value);
    return (wt_interval){factor, factor * error, exp(value - half), exp(value + half)};
}

range_text validation_requested_range(double margin)
{
    return format_range(1 / (1 + margin), 1 + margin, 3);
}

verdict_text model_variant_verdict(const validation *v, const model_variant *t)
{
    verdict_text result;
    double ends[2];
    const agreement *const fit = &t->fit;
    const size_t at = fit->deciding_step;
    agreement_interval(fit, at, fit->verdict == AGREEMENT_NO, ends);
    char all[48] = "";
    if (t->n > 1)
        snprintf(all, sizeof all, " at all %zu steps", t->n);
    if (fit->verdict == AGREEMENT_YES)
        clocale_print(result.text, sizeof result.text,
                      "explains: measured over predicted is within %.3g %%%s: at %.3g m/s%s %.3g "
                      "(95 %%: %s)",
                      100 * v->job->margin, all, v->steps.step[at].velocity,
                      t->n > 1 ? ", where it is farthest," : "", exp(fit->fitted_value[at]),
                      format_range(exp(ends[0]), exp(ends[1]), 3).text);
    else
        clocale_print(result.text, sizeof result.text,
                      "%s: at %.3g m/s measured over predicted is %.3g (95 %%%s: %s), and %s is "
                      "asked for",
                      validation_verdict(fit->verdict), v->steps.step[at].velocity,
                      exp(fit->fitted_value[at]),
                      fit->verdict == AGREEMENT_NO ? " at all steps at once" : "",
                      format_range(exp(ends[0]), exp(ends[1]), 3).text,
                      validation_requested_range(v->job->margin).text);
    return result;
}

mean_ratio mean_ratio_compute(const model_variant *t)
{
    double *const one = wt_alloc(t->n, sizeof *one);
    mean_ratio mean = {.row = wt_alloc(t->n, sizeof *mean.row)};
    for (size_t i = 0; i < t->n; i++) {
        agreement_weights(&t->fit, i, one);
        for (size_t k = 0; k < t->n; k++)
            mean.row[k] += one[k] / (double)t->n;
    }
    for (size_t i = 0; i < t->n; i++)
        mean.value += mean.row[i] * t->value[i];
    const variance_components parts = model_variant_components(t, mean.row);
    mean.error = sqrt(parts.all);
    mean.df = agreement_df(parts.all, parts.scatter, t->fit.scatter_df);
    free(one);
    return mean;
}
