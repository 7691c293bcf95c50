/* Required largest wavenumber of a record, all else as used. It maximises the likelihood: a level
 * alone may be met by two values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/validation.h"

#include "core/base/clocale.h"
#include "core/math/normal_quantile.h"

#include <math.h>
#include <stdlib.h>

/* Scan in steps of 0.1 decade over two decades on either side, twice the range of the model
 * choices. Friction is a smooth function of ln q1. */
enum { EACH_WAY = 20, TRIED = 2 * EACH_WAY + 1 };
static const double tenth = 0.1;
/* [m] no surface has waves below the size of a molecule */
static const double shortest_wave = 1e-9;

typedef struct cutoff_scan {
    size_t n;
    double log_q1[TRIED], likelihood[TRIED];
} cutoff_scan;

static double lowest_cutoff(const case_variant *s)
{
    const double roll_off = s->surface.self_affine ? s->surface.qr : 0;
    return fmax(2 * s->surface.q0, roll_off);
}

static double highest_cutoff(const case_variant *s)
{
    const wt_power_spectrum *const p = &s->surface.spectrum;
    const double known = s->surface.self_affine ? (double)INFINITY : p->wavenumber[p->n - 1];
    return fmin(2 * M_PI / shortest_wave, known);
}

/* ln of the likelihood of the record for another q1, with the same covariance. value: [n]
 * scratch. */
static wt_status cutoff_likelihood(const validation *v, double q1, double *value,
                                   double *likelihood, wt_error *err)
{
    const model_variant *const used = &v->ratio[v->layered];
    case_variant s = v->used;
    prediction p = {.part = NULL};
    s.surface.q1 = q1;
    s.sliding.rubber = s.given;
    s.sliding.surface = &s.surface;
    s.sliding.strain_softening = s.has_softness ? &s.strain_softening : NULL;
    wt_status status = predict_friction(&s.sliding, v->layered ? v->layer_observation : NULL,
                                        &v->steps, v->work, false, &p, err);
    const ratio_inputs of = {&p, &v->steps, p.shear, v->layered};
    for (size_t i = 0; status == WT_OK && i < v->steps.n; i++)
        value[i] = ratio_log_value(&of, 0, i);
    agreement_data data = model_variant_agreement_data(used);
    data.value = value;
    data.allowed = validation_discrepancy_variance(v);
    if (status == WT_OK)
        *likelihood = agreement_likelihood(&data, used->fit.scatter);
    prediction_clear(&p);
    return status;
}

static wt_status scan_cutoffs(const validation *v, cutoff_scan *s, wt_error *err)
{
    const double used = log10(v->used.surface.q1), low = log10(lowest_cutoff(&v->used)),
                 high = log10(highest_cutoff(&v->used));
    double *const value = wt_alloc(v->steps.n, sizeof *value);
    wt_status status = WT_OK;
    s->n = 0;
    for (int i = -EACH_WAY; status == WT_OK && i <= EACH_WAY; i++) {
        const double at = used + tenth * i;
        if (i != 0 && (at < low || at > high))
            continue;
        /* rounding may place the logarithm of the used value beyond the last density */
        const double q1 = i == 0 ? v->used.surface.q1 : fmin(pow(10, at), highest_cutoff(&v->used));
        status = cutoff_likelihood(v, q1, value, &s->likelihood[s->n], err);
        s->log_q1[s->n++] = at;
    }
    free(value);
    return status;
}

/* Maximum of the parabola through the best point and its neighbours. NaN if the best point is at a
 * limit of the scan. */
static double refine_maximum(const cutoff_scan *s, size_t best)
{
    if (best == 0 || best + 1 == s->n)
        return (double)NAN;
    const double a = s->likelihood[best - 1], b = s->likelihood[best], c = s->likelihood[best + 1];
    return s->log_q1[best] + tenth * 0.5 * (a - c) / (a - 2 * b + c);
}

/* Limit of the 95 % profile likelihood interval on one side. NaN if the scan does not reach it. */
static double interval_bound(const cutoff_scan *s, size_t best, int side)
{
    const double level = s->likelihood[best] - 0.5 * NORMAL_95 * NORMAL_95;
    for (size_t i = best; side < 0 ? i > 0 : i + 1 < s->n; i += side < 0 ? SIZE_MAX : 1) {
        const size_t next = side < 0 ? i - 1 : i + 1;
        const double a = s->likelihood[i] - level, b = s->likelihood[next] - level;
        if (b < 0)
            return s->log_q1[i] + (s->log_q1[next] - s->log_q1[i]) * a / (a - b);
    }
    return (double)NAN;
}

static void set_cutoff_value(table_writer *t, validation_key key, double log_q1, double error)
{
    if (!isnan(log_q1))
        validation_set_value(t, key, pow(10, log_q1), error, error);
}

wt_status required_cutoff_set_keys(const validation *v, table_writer *t, wt_error *err)
{
    cutoff_scan s;
    size_t best = 0;
    char text[256];
    const wt_status status = scan_cutoffs(v, &s, err);
    if (status == WT_E_RANGE || status == WT_E_CONVERGENCE) { /* the other results remain valid */
        validation_set_text(t, VALIDATION_KEY_CUTOFF_NOTE,
                            "not known: friction is not predicted at every wavenumber tried");
        return WT_OK;
    }
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < s.n; i++)
        if (s.likelihood[i] > s.likelihood[best] || isnan(s.likelihood[best]))
            best = i;
    const double at = refine_maximum(&s, best), first = pow(10, s.log_q1[0]),
                 last = pow(10, s.log_q1[s.n - 1]);
    if (isnan(at)) {
        clocale_print(text, sizeof text,
                      "not within %.3g rad/m to %.3g rad/m: the likelihood still rises at that end "
                      "which is nearer to %.3g rad/m",
                      first, last, pow(10, s.log_q1[best]));
        validation_set_text(t, VALIDATION_KEY_CUTOFF_NOTE, text);
        return WT_OK;
    }
    set_cutoff_value(t, VALIDATION_KEY_CUTOFF, at, (double)NAN);
    set_cutoff_value(t, VALIDATION_KEY_CUTOFF_LOW, interval_bound(&s, best, -1), 0);
    set_cutoff_value(t, VALIDATION_KEY_CUTOFF_HIGH, interval_bound(&s, best, 1), 0);
    clocale_print(
        text, sizeof text,
        "%.3g times that used; the thickness of the layer is held, and an end that is not "
        "told lies beyond %.3g rad/m to %.3g rad/m",
        pow(10, at) / v->used.surface.q1, first, last);
    validation_set_text(t, VALIDATION_KEY_CUTOFF_NOTE, text);
    return WT_OK;
}
