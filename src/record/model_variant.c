/* Comparison of one prediction with the record, and its verdict; contributions to the error of
 * measured over predicted friction, with remedies.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"

#include "core/base/array.h"
#include "core/math/cholesky.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "record/numerics/agreement.h"
#include "record/validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- verdict --------------------------------------------------------------------------------- */

double validation_margin(const validation *v)
{
    return log1p(v->job->margin);
}

static stated_verdict validation_verdict(agreement_verdict verdict)
{
    static const stated_verdict stated[] = {[AGREEMENT_INCONCLUSIVE] = VERDICT_INCONCLUSIVE,
                                            [AGREEMENT_YES] = VERDICT_YES,
                                            [AGREEMENT_NO] = VERDICT_NO};
    return stated[verdict];
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
                      "yes: measured over predicted is within %.3g %%%s: at %.3g m/s%s %.3g "
                      "(95 %%: %s)",
                      100 * v->job->margin, all, v->steps.step[at].velocity,
                      t->n > 1 ? ", where it is farthest," : "", exp(fit->fitted_value[at]),
                      format_range(exp(ends[0]), exp(ends[1]), 3).text);
    else
        clocale_print(
            result.text, sizeof result.text,
            "%s: at %.3g m/s measured over predicted is %.3g (95 %%%s: %s); the margin is "
            "%s",
            stated_verdict_text(validation_verdict(fit->verdict)), v->steps.step[at].velocity,
            exp(fit->fitted_value[at]), fit->verdict == AGREEMENT_NO ? " at all steps at once" : "",
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

/* Draws per slope. The scatter of the slopes is then small, as for the standard errors of
 * replicates. */
enum { FOR_EACH = 5, MOST_COLUMNS = REPLICATES_MAX_DRAWS + 1 };

/* ---- error sources --------------------------------------------------------------------------- */

typedef struct draw_regression {
    const prediction *p;
    model_variant *t;
    double *z;     /* [n_draws * columns] 1, then the drawn numbers */
    double *value; /* [n_draws * n] */
    size_t columns, n_good;
} draw_regression;

/* Collects the draws that have a solution, with their standard normal numbers. */
static void collect_draws(draw_regression *s, model_variant_value *of, const void *user,
                          uint64_t seed)
{
    const size_t n = s->t->n;
    for (size_t k = 0; k < s->p->n_draws; k++) {
        double *const value = s->value + s->n_good * n, *const z = s->z + s->n_good * s->columns;
        bool good = true;
        for (size_t i = 0; i < n; i++) {
            value[i] = of(user, 1 + k, i);
            good = good && isfinite(value[i]);
        }
        z[0] = 1;
        for (size_t u = 1; u < s->columns; u++)
            z[u] = flow_draw_normal(seed, k, s->p->line[u - 1]);
        s->n_good += good;
    }
}

/* Subtracts the linear regression on the drawn numbers from the values and stores the slopes. */
static bool subtract_regression(draw_regression *s)
{
    const size_t p = s->columns, n = s->t->n;
    double normal[MOST_COLUMNS * MOST_COLUMNS] = {0};
    for (size_t k = 0; k < s->n_good; k++)
        for (size_t u = 0; u < p; u++)
            for (size_t v = 0; v <= u; v++)
                normal[u * p + v] += s->z[k * p + u] * s->z[k * p + v];
    for (size_t i = 0; i < n; i++) {
        double factor[MOST_COLUMNS * MOST_COLUMNS], b[MOST_COLUMNS] = {0};
        memcpy(factor, normal, sizeof normal);
        for (size_t k = 0; k < s->n_good; k++)
            for (size_t u = 0; u < p; u++)
                b[u] += s->z[k * p + u] * s->value[k * n + i];
        if (!cholesky_solve(factor, p, p, 0, b))
            return false;
        for (size_t u = 1; u < p; u++)
            s->t->slope[(u - 1) * n + i] = b[u];
        for (size_t k = 0; k < s->n_good; k++)
            for (size_t u = 0; u < p; u++)
                s->value[k * n + i] -= b[u] * s->z[k * p + u];
    }
    return true;
}

static void subtract_mean(draw_regression *s)
{
    const size_t n = s->t->n;
    for (size_t i = 0; i < n; i++) {
        double mean = 0;
        for (size_t k = 0; k < s->n_good; k++)
            mean += s->value[k * n + i] / (double)s->n_good;
        for (size_t k = 0; k < s->n_good; k++)
            s->value[k * n + i] -= mean;
    }
}

/* Drawn numbers are standard normal. Their part of the covariance follows from the slopes without
 * sampling error. The sample covariance gives the remainder. */
static wt_status find_variant_covariance(draw_regression *s, wt_error *err)
{
    model_variant *const t = s->t;
    const bool lines = s->n_good >= FOR_EACH * s->columns && subtract_regression(s);
    t->split = lines;
    if (!lines) {
        s->columns = 1;
        subtract_mean(s);
    }
    if (s->p->n_draws == 0) /* no errors are requested */
        return WT_OK;
    if (s->n_good <= s->columns)
        return wt_fail(err, WT_E_RANGE,
                       "of %zu replicates %zu have a friction: too few for the errors of the "
                       "prediction",
                       s->p->n_draws, s->n_good);
    for (size_t i = 0; i < t->n; i++)
        for (size_t j = 0; j < t->n; j++) {
            double sum = 0;
            for (size_t k = 0; k < s->n_good; k++)
                sum += s->value[k * t->n + i] * s->value[k * t->n + j];
            t->rest[i * t->n + j] = sum / (double)(s->n_good - s->columns);
            t->prediction_covariance[i * t->n + j] = t->rest[i * t->n + j];
            for (size_t u = 0; lines && u < t->n_lines; u++)
                t->prediction_covariance[i * t->n + j] +=
                    t->slope[u * t->n + i] * t->slope[u * t->n + j];
        }
    return WT_OK;
}

static wt_status find_draw_covariance(const prediction *p, model_variant_value *of,
                                      const void *user, uint64_t seed, model_variant *t,
                                      wt_error *err)
{
    draw_regression s = {.p = p, .t = t, .columns = p->n_lines + 1};
    s.z = arena_numbers(&t->memory, (p->n_draws + 1) * s.columns);
    s.value = arena_numbers(&t->memory, (p->n_draws + 1) * t->n);
    collect_draws(&s, of, user, seed);
    return find_variant_covariance(&s, err);
}

/* ---- model variant --------------------------------------------------------------------------- */

static agreement_data model_variant_agreement_data(const model_variant *t)
{
    return (agreement_data){t->n, t->log_velocity, t->value, t->measurement_variance,
                            t->prediction_covariance};
}

wt_status model_variant_fit(const prediction *p, const measured *steps, model_variant_value *of,
                            const void *user, const double *measurement_variance, uint64_t seed,
                            size_t most_terms, model_variant *t, wt_error *err)
{
    const size_t n = steps->n;
    arena memory = {0};
    wt_status status = WT_OK;
    *t = (model_variant){.n = n,
                         .n_lines = p->n_lines,
                         .log_velocity = arena_numbers(&memory, n),
                         .value = arena_numbers(&memory, n),
                         .measurement_variance = arena_numbers(&memory, n),
                         .prediction_covariance = arena_numbers(&memory, n * n),
                         .rest = arena_numbers(&memory, n * n),
                         .slope = arena_numbers(&memory, n * (p->n_lines + 1))};
    t->memory = memory;
    for (size_t i = 0; status == WT_OK && i < t->n; i++) {
        t->log_velocity[i] = log10(steps->step[i].velocity);
        t->value[i] = of(user, 0, i);
        t->measurement_variance[i] = measurement_variance[i];
        if (!isfinite(t->value[i]))
            status = wt_fail(err, WT_E_RANGE, "the friction at %g m/s is not predicted",
                             steps->step[i].velocity);
    }
    if (status == WT_OK)
        status = find_draw_covariance(p, of, user, seed, t, err);
    const agreement_data data = model_variant_agreement_data(t);
    return status == WT_OK ? agreement_fit(&data, most_terms, &t->fit, err) : status;
}

void model_variant_clear(model_variant *t)
{
    arena_free(&t->memory);
    agreement_clear(&t->fit);
    *t = (model_variant){.n = 0};
}

/* ---- compared quantities --------------------------------------------------------------------- */

static double ratio_log_value(const void *user, size_t k, size_t step)
{
    const ratio_inputs *r = user;
    return log(r->steps->step[step].friction /
               prediction_total(r->p, k, r->layered, step, r->shear[k]));
}

wt_status model_variant_fit_ratio(const ratio_inputs *of, uint64_t seed, model_variant *t,
                                  wt_error *err)
{
    double *const measurement_variance = wt_alloc(of->steps->n, sizeof *measurement_variance);
    *t = (model_variant){.n = 0};
    for (size_t i = 0; i < of->steps->n; i++) {
        const measured_step *const s = &of->steps->step[i];
        measurement_variance[i] = (s->error / s->friction) * (s->error / s->friction);
    }
    const wt_status status = model_variant_fit(of->p, of->steps, ratio_log_value, of,
                                               measurement_variance, seed, 0, t, err);
    free(measurement_variance);
    return status;
}

static double friction_per_shear(const ratio_inputs *r, size_t k, size_t step)
{
    return prediction_part_value(r->p, k, r->layered ? PART_BY_SHEAR_LAYER : PART_BY_SHEAR, step);
}

static double shear_value(const void *user, size_t k, size_t step)
{
    const ratio_inputs *r = user;
    return (r->steps->step[step].friction - prediction_total(r->p, k, r->layered, step, 0)) /
           friction_per_shear(r, k, step);
}

wt_status model_variant_fit_shear(const prediction *p, const measured *steps, bool layered,
                                  uint64_t seed, model_variant *t, wt_error *err)
{
    const ratio_inputs of = {p, steps, NULL, layered};
    double *const measurement_variance = wt_alloc(steps->n, sizeof *measurement_variance);
    *t = (model_variant){.n = 0};
    for (size_t i = 0; i < steps->n; i++) {
        const double error = steps->step[i].error / friction_per_shear(&of, 0, i);
        measurement_variance[i] = error * error;
    }
    const wt_status status =
        model_variant_fit(p, steps, shear_value, &of, measurement_variance, seed, 1, t, err);
    free(measurement_variance);
    return status;
}

/* ---- components of the variance -------------------------------------------------------------- */

variance_components model_variant_components(const model_variant *t, const double *row)
{
    variance_components parts = {.all = 0};
    for (size_t u = 0; u < t->n_lines; u++) {
        double sum = 0;
        for (size_t i = 0; i < t->n; i++)
            sum += row[i] * t->slope[u * t->n + i];
        parts.line[u] = sum * sum;
        parts.all += parts.line[u];
    }
    for (size_t i = 0; i < t->n; i++) {
        parts.record += row[i] * row[i] * t->measurement_variance[i];
        parts.scatter += row[i] * row[i] * t->fit.scatter;
        for (size_t j = 0; j < t->n; j++)
            parts.material += row[i] * t->rest[i * t->n + j] * row[j];
    }
    parts.all += parts.record + parts.scatter + parts.material;
    return parts;
}

/* ---- contributions to the error -------------------------------------------------------------- */

TABLE_ROW(validation_sources, VALIDATION_SOURCES, validation_source source; const char *remedy;
          double error, share, needed_share;)

/* Sources of the random draws. Draws with the same source have one row. */
static const struct {
    flow_draw draw;
    validation_source source;
    const char *remedy;
} drawn[] = {
    {FLOW_DRAW_SHIFT_LAW, VALIDATION_SOURCE_SHIFT_LAW,
     "a DMA sweep at the temperature of the record"},
    {FLOW_DRAW_PRESSURE, VALIDATION_SOURCE_PRESSURE, "the load and the nominal area known better"},
    {FLOW_DRAW_TEMPERATURE, VALIDATION_SOURCE_TEMPERATURE, "the temperature in sliding measured"},
    {FLOW_DRAW_SHEAR_STRESS, VALIDATION_SOURCE_SHEAR_STRESS,
     "the shear stress measured on a smooth counter surface"},
    {FLOW_DRAW_DENSITY, VALIDATION_SOURCE_ROUGHNESS, "more scans of the counter surface"},
    {FLOW_DRAW_SOFT_STORAGE, VALIDATION_SOURCE_SOFTENING, "more strain sweeps"},
    {FLOW_DRAW_SOFT_LOSS, VALIDATION_SOURCE_SOFTENING, "more strain sweeps"},
    {FLOW_DRAW_THICKNESS, VALIDATION_SOURCE_THICKNESS, "the layer measured at more places"},
    {FLOW_DRAW_RATIO, VALIDATION_SOURCE_RATIO,
     "more spots indented, one cantilever for bulk and track"},
    {FLOW_DRAW_RATIO_SLOPE, VALIDATION_SOURCE_RATIO_SLOPE,
     "bulk and track indented at rates further apart"},
    {FLOW_DRAW_WEAR, VALIDATION_SOURCE_WEAR, "the track profiled or the sample weighed"},
    {FLOW_DRAW_CRITICAL_ENERGY, VALIDATION_SOURCE_CRITICAL_ENERGY,
     "the layer measured at more places"},
    {FLOW_DRAW_OBSERVED, VALIDATION_SOURCE_OBSERVED, "the layer measured at more places"},
};

static size_t find_drawn(flow_draw draw)
{
    size_t i = 0;
    while (i + 1 < COUNT_OF(drawn) && drawn[i].draw != draw)
        i++;
    return i;
}

typedef struct source {
    validation_source kind;
    const char *remedy;
    double variance, needed; /* variances of ln(measured/predicted) and of the required shear
                                stress */
} source;

typedef struct source_list {
    source of[VALIDATION_SOURCE_UNKNOWN];
    size_t n;
    double all, all_needed;
} source_list;

static source *find_source(source_list *list, validation_source kind, const char *remedy)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->of[i].kind == kind)
            return &list->of[i];
    source *const s = &list->of[list->n++];
    *s = (source){.kind = kind, .remedy = remedy};
    return s;
}

/* ---- variance by source ---------------------------------------------------------------------- */

/* Returns the source of the variance that is not attributed to a single draw. */
static validation_source other_sources(const wt_sliding *sliding, bool split)
{
    if (!split)
        return VALIDATION_SOURCE_ALL_DRAWN;
    return sliding->surface->modes_error != NULL ? VALIDATION_SOURCE_MATERIAL_AND_SURFACE
                                                 : VALIDATION_SOURCE_MATERIAL;
}

static void add_other_sources(source_list *list, const wt_sliding *sliding, bool split,
                              const variance_components *parts, const variance_components *needed)
{
    const struct {
        validation_source kind;
        const char *remedy;
        double variance, needed;
    } rest[] = {{other_sources(sliding, split),
                 !split ? "more replicates, which separate the errors"
                 : sliding->surface->modes_error != NULL
                     ? "a second DMA run; more scans of the counter surface"
                     : "a second DMA run; temperatures known better",
                 parts->material, needed->material},
                {VALIDATION_SOURCE_RECORD, "longer records, or more of them", parts->record,
                 needed->record},
                {VALIDATION_SOURCE_SCATTER,
                 "more records at each velocity: the steps scatter by more than their errors",
                 parts->scatter, needed->scatter}};
    for (size_t i = 0; i < COUNT_OF(rest); i++)
        if (rest[i].variance > 0 || rest[i].needed > 0) {
            source *const s = find_source(list, rest[i].kind, rest[i].remedy);
            s->variance = rest[i].variance;
            s->needed = rest[i].needed;
        }
}

static void list_sources(const validation *v, bool split, const variance_components *parts,
                         const variance_components *needed, source_list *list)
{
    *list = (source_list){.all = parts->all, .all_needed = needed->all};
    for (size_t u = 0; split && u < v->p.n_lines; u++) {
        const size_t k = find_drawn(v->p.line[u]);
        source *const s = find_source(list, drawn[k].source, drawn[k].remedy);
        s->variance += parts->line[u];
        s->needed += needed->line[u];
    }
    add_other_sources(list, v->job->sliding, split, parts, needed);
}

/* ---- advice ---------------------------------------------------------------------------------- */

static int compare_variances(const void *a, const void *b)
{
    const source *x = a, *y = b;
    return (x->variance < y->variance) - (x->variance > y->variance);
}

/* Number of sources, the largest first, that must vanish until the interval no longer contains the
 * bound of the margin. Returns the number of sources + 1 if all of them do not suffice. */
static size_t count_required_sources(const validation *v, const model_variant *t,
                                     const source_list *list)
{
    const agreement *const fit = &t->fit;
    const size_t at = fit->deciding_step;
    const double off = fabs(fabs(fit->fitted_value[at]) - validation_margin(v)),
                 wanted = off / agreement_quantile(fit->df[at]);
    double left = list->all;
    size_t n = 0;
    while (n < list->n && sqrt(fmax(left, 0)) > wanted)
        left -= list->of[n++].variance;
    return sqrt(fmax(left, 0)) > wanted ? list->n + 1 : n;
}

/* Advice that names more sources at once is not useful. */
enum { MOST_NAMED = 2 };

static void write_advice(const validation *v, const model_variant *t, const source_list *list,
                         source_advice *advice)
{
    const source *const first = &list->of[0];
    const double share = first->variance / list->all;
    clocale_print(advice->narrows, sizeof advice->narrows, "%s: %.0f %% of the variance is the %s",
                  first->remedy, 100 * share, validation_source_text(first->kind));
    if (t->fit.verdict != AGREEMENT_INCONCLUSIVE)
        return;
    const size_t n = count_required_sources(v, t, list);
    char words[200] = "";
    for (size_t i = 0, used = 0; i < n && i < list->n && used < sizeof words; i++)
        used += (size_t)snprintf(words + used, sizeof words - used, "%s%s", i > 0 ? ", " : "",
                                 validation_source_text(list->of[i].kind));
    if (n > MOST_NAMED)
        clocale_print(advice->settles, sizeof advice->settles,
                      "hardly anything, because the ratio is near the end of the margin; the "
                      "largest gain is from %s",
                      first->remedy);
    else
        clocale_print(advice->settles, sizeof advice->settles, "%s known better%s%s", words,
                      n == 1 ? ": " : "", n == 1 ? first->remedy : "");
}

/* ---- table ----------------------------------------------------------------------------------- */

wt_status error_sources_tabulate(const validation *v, source_advice *advice, wt_table **table,
                                 wt_error *err)
{
    const model_variant *const t = v->has_shear ? &v->ratio[v->layered] : &v->shear;
    double *const row = wt_alloc(t->n, sizeof *row);
    source_list list;
    *advice = (source_advice){.narrows = ""};
    agreement_weights(&t->fit, t->fit.deciding_step, row);
    const variance_components parts = model_variant_components(t, row);
    agreement_weights(&v->shear.fit, 0, row);
    const variance_components needed = model_variant_components(&v->shear, row);
    free(row);
    const bool split = t->split || v->p.n_draws == 0; /* without draws there is nothing to
                                                         attribute */
    list_sources(v, split, &parts, &needed, &list);
    qsort(list.of, list.n, sizeof *list.of, compare_variances);
    write_advice(v, t, &list, advice);
    table_writer w = table_begin(&validation_sources_schema, err);
    for (size_t i = 0; i < list.n; i++) {
        const source *const s = &list.of[i];
        TABLE_ADD(validation_sources, &w, s->kind, s->remedy, sqrt(s->variance),
                  s->variance / list.all,
                  list.all_needed > 0 ? s->needed / list.all_needed : (double)NAN);
    }
    validation_sources_set_text(&w, VALIDATION_SOURCES_KEY_ADVICE, advice->narrows);
    return table_end(&w, table);
}
