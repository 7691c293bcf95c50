/* Likelihood of the record for each model choice of the table "what_if", and the required largest
 * wavenumber, all else as used. That wavenumber maximises the likelihood: a level alone may be met
 * by two values.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "record/validation.h"
#include "study/case_override.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Scan in steps of 0.1 decade over two decades on either side, twice the range of the model
 * choices. Friction is a smooth function of ln q1. */
enum { EACH_WAY = 20, TRIED = 2 * EACH_WAY + 1 };
static const double tenth = 0.1;

typedef struct cutoff_scan {
    size_t n;
    double log_q1[TRIED], likelihood[TRIED];
} cutoff_scan;

/* ln of the likelihood of the record for another q1, with the same covariance. value: [n]
 * scratch. */
static wt_status cutoff_likelihood(const validation *v, double q1, double *value,
                                   double *likelihood, wt_error *err)
{
    const model_variant *const used = &v->ratio[v->layered];
    case_variant s = v->used;
    prediction p = {.part = NULL};
    s.surface.q1 = q1;
    case_variant_bind(&s);
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
    const wt_surface *const surface = &v->used.surface;
    const double used = log10(surface->q1),
                 low = log10(fmax(2 * surface->q0, surface->self_affine ? surface->qr : 0)),
                 high = log10(case_variant_highest_wavenumber(&v->used));
    double *const value = wt_alloc(v->steps.n, sizeof *value);
    wt_status status = WT_OK;
    s->n = 0;
    for (int i = -EACH_WAY; status == WT_OK && i <= EACH_WAY; i++) {
        const double at = used + tenth * i;
        if (i != 0 && (at < low || at > high))
            continue;
        /* rounding may place the logarithm of the used value beyond the last density */
        const double q1 = i == 0 ? v->used.surface.q1
                                 : fmin(pow(10, at), case_variant_highest_wavenumber(&v->used));
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

/* Share of the weight, with the same level as a 95 % interval. */
static const double most_of_it = 0.95;

typedef struct choice_row {
    const char *choice, *tried, *verdict;
    double ratio, trend, log_likelihood, weight;
    bool kept;
    agreement_verdict agreement; /* AGREEMENT_INCONCLUSIVE without a prediction */
    char note[256];
} choice_row;
TABLE_ROW_OF(validation_choices, VALIDATION_CHOICES, choice_row)

/* ---- one row --------------------------------------------------------------------------------- */

/* Predicts friction at the steps for a model choice, with the thickness that the table has for
 * it. */
static wt_status predict_setting(const validation *v, case_variant *s, double thickness,
                                 prediction *p, wt_error *err)
{
    wt_rubber refitted = {0};
    wt_layer_observation observation =
        v->layered ? *v->layer_observation
                   : (wt_layer_observation){.modulus_ratio = {1, 0, 0, NULL}};
    wt_status status = WT_OK;
    observation.bulk_shear = s->layer_observation.bulk_shear;
    if (!isnan(thickness))
        observation.thickness.value = thickness;
    if (s->vertical != v->used.vertical) {
        status = wt_rubber_refit(&s->rubber, s->vertical, &refitted, err);
        s->rubber = refitted;
        s->given = NULL;
    }
    case_variant_bind(s);
    if (status == WT_OK)
        status = predict_friction(&s->sliding, v->layered ? &observation : NULL, &v->steps, v->work,
                                  false, p, err);
    wt_rubber_clear(&refitted);
    return status;
}

/* Assesses the ratio with the covariance of the values used: the draws affect a choice in the same
 * way. */
static wt_status assess_row(const validation *v, const prediction *p, choice_row *r, wt_error *err)
{
    const model_variant *const used = &v->ratio[v->layered];
    const ratio_inputs of = {p, &v->steps, p->shear, v->layered};
    agreement fit = {.n = 0};
    agreement_data data = model_variant_agreement_data(used);
    double *const value = wt_alloc(data.n, sizeof *value);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < data.n; i++) {
        value[i] = ratio_log_value(&of, 0, i);
        if (!isfinite(value[i]))
            status = wt_fail(err, WT_E_RANGE, "friction is not predicted at every step");
    }
    data.value = value;
    data.allowed = validation_discrepancy_variance(v);
    if (status == WT_OK) {
        r->log_likelihood = agreement_likelihood(&data, used->fit.scatter);
        status = agreement_fit(&data, 0, &fit, err);
    }
    if (status == WT_OK) {
        double mean = 0;
        agreement_assess(&fit, validation_margin(v));
        for (size_t i = 0; i < data.n; i++)
            mean += v->mean.row[i] * value[i];
        r->ratio = exp(mean);
        r->trend = fit.terms > 1 ? expm1(fit.coefficient[1] / fit.span) : (double)NAN;
        r->agreement = fit.verdict;
        r->verdict = validation_verdict(fit.verdict);
    }
    agreement_clear(&fit);
    free(value);
    return status;
}

static wt_status compute_row(const validation *v, const table_view *what_if, size_t i,
                             case_variant *s, choice_row *r, wt_error *err)
{
    wt_error why = WT_ERROR_INIT;
    prediction p = {.part = NULL};
    const double unknown = (double)NAN;
    *r = (choice_row){.choice = what_if_text(what_if, i, WHAT_IF_CHOICE),
                      .tried = what_if_text(what_if, i, WHAT_IF_TRIED),
                      .verdict = "",
                      .ratio = unknown,
                      .trend = unknown,
                      .log_likelihood = unknown};
    const double thickness = what_if_get(what_if, i, WHAT_IF_THICKNESS);
    wt_status status = WT_OK;
    if (isinf(thickness) && v->layered)
        status = wt_fail(&why, WT_E_RANGE, "the layer grows without end");
    if (status == WT_OK)
        status = predict_setting(v, s, thickness, &p, &why);
    if (status == WT_OK)
        status = assess_row(v, &p, r, &why);
    prediction_clear(&p);
    if (status == WT_E_MEMORY || status == WT_E_INTERNAL)
        return wt_fail(err, status, "a choice of the model could not be tried");
    if (status != WT_OK)
        snprintf(r->note, sizeof r->note, "%s", why.message);
    return WT_OK;
}

/* ---- weights --------------------------------------------------------------------------------- */

/* Selects the fewest rows that hold most of the weight, the largest weight first. */
static void select_rows(choice_row *rows, size_t n)
{
    double sum = 0;
    while (sum < most_of_it) {
        choice_row *heaviest = NULL;
        for (size_t i = 0; i < n; i++)
            if (!rows[i].kept && (heaviest == NULL || rows[i].weight > heaviest->weight))
                heaviest = &rows[i];
        if (heaviest == NULL || !(heaviest->weight > 0))
            return;
        heaviest->kept = true;
        sum += heaviest->weight;
    }
}

static void find_row_weights(choice_row *rows, size_t n)
{
    double largest = -(double)INFINITY, sum = 0;
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, rows[i].log_likelihood); /* fmax skips NaN */
    for (size_t i = 0; i < n; i++) {
        const double l = rows[i].log_likelihood;
        rows[i].weight = isnan(l) ? 0 : exp(l - largest);
        sum += rows[i].weight;
    }
    for (size_t i = 0; i < n && sum > 0; i++)
        rows[i].weight /= sum;
}

/* ---- ranges ---------------------------------------------------------------------------------- */

static void extend_by_value(double range[2], double value)
{
    if (!isfinite(value))
        return;
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static void find_choice_ranges(const table_view *what_if, const choice_row *rows, size_t n,
                               choice_ranges *ranges)
{
    static const what_if_column columns[CASE_QUANTITIES] = {
        [CASE_QUANTITY_HYSTERESIS] = WHAT_IF_HYSTERESIS,
        [CASE_QUANTITY_AREA_RATIO] = WHAT_IF_AREA_RATIO,
        [CASE_QUANTITY_FRICTION] = WHAT_IF_FRICTION,
        [CASE_QUANTITY_THICKNESS] = WHAT_IF_THICKNESS,
        [CASE_QUANTITY_WITH_LAYER] = WHAT_IF_WITH_LAYER};
    for (size_t k = 0; k < CASE_QUANTITIES; k++) {
        double *const all = ranges->all[k], *const kept = ranges->kept[k];
        all[0] = all[1] = kept[0] = kept[1] = (double)NAN;
        for (size_t i = 0; i < n; i++) {
            const double value = what_if_get(what_if, i, columns[k]);
            extend_by_value(all, value);
            if (rows[i].kept)
                extend_by_value(kept, value);
        }
    }
}

/* If no likely row agrees with the record, the text says so: the relative likelihood is then of
 * little use. */
static void write_narrowed_range(const choice_row *rows, size_t n, choice_ranges *ranges)
{
    size_t kept = 0, explained = 0, best = 0;
    for (size_t i = 0; i < n; i++) {
        kept += rows[i].kept;
        explained += rows[i].kept && rows[i].agreement != AGREEMENT_NO;
        best = rows[i].weight > rows[best].weight ? i : best;
    }
    clocale_print(ranges->narrows, sizeof ranges->narrows,
                  "%zu of %zu choices hold 95 %% of the weight; the likeliest is %s%s%s (%.2g)%s",
                  kept, n, best == 0 ? "as used" : rows[best].choice, best == 0 ? "" : ": ",
                  best == 0 ? "" : rows[best].tried, rows[best].weight,
                  explained > 0 ? "" : "; but none of them agrees with the record");
}

wt_status model_choices_tabulate(const validation *v, const table_view *what_if,
                                 choice_ranges *ranges, wt_table **table, wt_error *err)
{
    size_t n = 0;
    wt_status status = WT_OK;
    case_variant *const settings = what_if_list_variants(&v->used, &n);
    if (n != what_if->n_rows) { /* the table was computed with a layer, and this comparison is
                                   without one */
        free(settings);
        return WT_OK;
    }
    choice_row *const rows = wt_alloc(n, sizeof *rows);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = compute_row(v, what_if, i, &settings[i], &rows[i], err);
    if (status == WT_OK) {
        find_row_weights(rows, n);
        select_rows(rows, n);
        find_choice_ranges(what_if, rows, n, ranges);
        write_narrowed_range(rows, n, ranges);
        table_writer t = table_begin(&validation_choices_schema, err);
        for (size_t i = 0; i < n; i++)
            validation_choices_add_row(&t, &rows[i]);
        validation_choices_set_text(&t, VALIDATION_CHOICES_KEY_JUDGED,
                                    v->layered ? "friction with the layer"
                                               : "friction without a layer");
        validation_choices_set_text(&t, VALIDATION_CHOICES_KEY_NARROWS, ranges->narrows);
        status = table_end(&t, table);
    }
    free(settings);
    free(rows);
    return status;
}
