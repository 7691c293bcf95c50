/* Verdict on the running-in and its text.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"
#include "record/validation.h"

#include "core/base/clocale.h"
#include "job/random_draws.h"

#include <math.h>

/* ---- tests ----------------------------------------------------------------------------------- */

static bool contradicts_at_bound(const run_fit *run, double margin)
{
    if (run->value == NULL || run->ambiguous || !run->fit.seen || run_fit_is_closed(run))
        return false;
    const double end = run_fit_bound(run, RUN_TIME_RATIO);
    return isnan(run->fit.high) ? end > log1p(margin) : end < -log1p(margin);
}

/* Returns the first run that contradicts with its only determined limit, or NULL. */
static const run_fit *first_contradicting_run(const run_set *all)
{
    for (size_t i = 0; i < all->n; i++)
        if (contradicts_at_bound(&all->runs[i], all->margin))
            return &all->runs[i];
    return NULL;
}

/* Returns the first compared run without both limits of the time, or NULL. */
static const run_fit *first_inconclusive_run(const run_set *all)
{
    for (size_t i = 0; i < all->n; i++)
        if (all->runs[i].value != NULL && !run_fit_is_closed(&all->runs[i]))
            return &all->runs[i];
    return NULL;
}

/* Returns the first run that determines a number, or NULL. */
static const run_fit *first_determined_run(const run_set *all, run_quantity number)
{
    for (size_t i = 0; i < all->n; i++)
        if (run_fit_determines(&all->runs[i], number))
            return &all->runs[i];
    return NULL;
}

/* An undetermined run prevents a yes: no other run determines its time. */
static agreement_verdict assess_time(const run_set *all)
{
    agreement judged = all->level[RUN_TIME_RATIO].fit;
    if (first_contradicting_run(all) != NULL)
        return AGREEMENT_NO;
    if (judged.n == 0)
        return AGREEMENT_INCONCLUSIVE;
    agreement_assess(&judged, log1p(all->margin));
    return judged.verdict == AGREEMENT_YES && first_inconclusive_run(all) != NULL
               ? AGREEMENT_INCONCLUSIVE
               : judged.verdict;
}

/* Both limits of the margin are separate tests, because the predicted change may be near zero. */
static agreement_verdict assess_change(const run_set *all)
{
    const wt_interval more = run_level_interval(&all->level[RUN_ABOVE_LOWER]),
                      less = run_level_interval(&all->level[RUN_BELOW_UPPER]);
    if (more.high < 0 || less.high < 0)
        return AGREEMENT_NO;
    return more.low > 0 && less.low > 0 ? AGREEMENT_YES : AGREEMENT_INCONCLUSIVE;
}

/* ---- text ------------------------------------------------------------------------------------ */

static void describe_inconclusive_run(const run_fit *run, char *text, size_t size)
{
    const running_in_curve_fit *const fit = &run->fit;
    const double with_prediction = run_fit_bound(run, RUN_TIME_RATIO);
    const char *const by = isnan(with_prediction) ? ", by the record alone" : "";
    if (!fit->seen)
        clocale_print(
            text, size,
            "no change of friction like that by the layer exceeds the scatter of the cycles");
    else if (run->ambiguous)
        clocale_print(text, size,
                      "a prediction within its errors fits the record as well as another time or "
                      "change does");
    else if (isnan(fit->low) && isnan(fit->high))
        clocale_print(text, size,
                      "friction changes, and the record gives neither a lower nor an upper "
                      "limit of the time");
    else if (isnan(fit->high))
        clocale_print(text, size,
                      "a change like that by the layer is not complete at the end of the "
                      "record, after %.3g times the time predicted at least%s",
                      exp(isnan(with_prediction) ? fit->low : with_prediction), by);
    else
        clocale_print(text, size,
                      "a change like that by the layer is complete within the first cycles, "
                      "after %.3g times the time predicted at most%s",
                      exp(isnan(with_prediction) ? fit->high : with_prediction), by);
    if (fit->seen && run->rec->running_in > 0) /* this is a different question with an answer of
                                                  its own */
        clocale_append(text, size, " (by its scatter alone friction is steady after %.0f cycles)",
                       run->rec->running_in);
    else if (fit->seen && run->rec->running_in == 0)
        clocale_append(text, size,
                       " (by its scatter alone friction is steady from the first cycle)");
}

/* Describes what decides: a run that contradicts, the common interval, or an undetermined run. */
static void describe_time(const run_set *all, char *text, size_t size)
{
    const wt_interval i = run_level_interval(&all->level[RUN_TIME_RATIO]);
    const run_fit *const against = first_contradicting_run(all), *const open =
                                                                     first_inconclusive_run(all);
    if (against != NULL || isnan(i.value)) {
        if (against == NULL && first_determined_run(all, RUN_TIME_RATIO) != NULL)
            snprintf(text, size,
                     "one record determines a time of running-in, all together do "
                     "not");
        else
            describe_inconclusive_run(against != NULL ? against : open, text, size);
        return;
    }
    clocale_print(text, size,
                  "a change like that by the layer is complete after %.3g times the time "
                  "predicted (95 %%: %s)%s",
                  exp(i.value), format_range(exp(i.low), exp(i.high), 3).text,
                  open != NULL ? ", which not every record determines" : "");
}

static void describe_change(const run_set *all, char *text, size_t size)
{
    const wt_interval ratio = run_level_interval(&all->level[RUN_RATIO]);
    if (isnan(ratio.low) || isnan(ratio.high))
        snprintf(text, size, "the change of friction is not determined");
    else
        clocale_print(text, size, "the change of friction is %.3g times that predicted (95 %%: %s)",
                      ratio.value, format_range(ratio.low, ratio.high, 3).text);
}

static void write_run_verdict(const run_set *all, stated_verdict verdict, char *text, size_t size)
{
    char time[240], change[120];
    /* the deciding part comes first */
    const bool by_change = assess_time(all) != AGREEMENT_NO && assess_change(all) == AGREEMENT_NO;
    describe_time(all, time, sizeof time);
    describe_change(all, change, sizeof change);
    snprintf(text, size, "%s: %s; %s; the margin is %s", stated_verdict_text(verdict),
             by_change ? change : time, by_change ? time : change,
             validation_requested_range(all->margin).text);
}

/* ---- remedies -------------------------------------------------------------------------------- */

/* Finds the draw that correlates most with a number of a run and returns its share of the variance;
 * 0 if unknown. */
static double largest_line(const run_fit *run, uint64_t seed, run_quantity number, size_t *line)
{
    double most = 0;
    const double all = run_fit_prediction_deviation(run, number);
    for (size_t u = 0; u < run->growth->n_lines; u++) {
        double slope = 0, n = 0;
        for (size_t k = 1; k <= run->growth->n_draws; k++) {
            const double off = run_fit_value(run, k, number) - run_fit_value(run, 0, number);
            if (!isfinite(off))
                continue;
            slope += off * flow_draw_normal(seed, k - 1, run->growth->line[u]);
            n++;
        }
        slope = n > 0 ? slope / n : 0;
        if (slope * slope > most) {
            most = slope * slope;
            *line = u;
        }
    }
    return all > 0 ? most / (all * all) : 0;
}

static const run_fit *first_compared_run(const run_set *all)
{
    for (size_t i = 0; i < all->n; i++)
        if (all->runs[i].value != NULL)
            return &all->runs[i];
    return NULL;
}

static const char *remedy_for_time(const running_in_curve_fit *fit)
{
    if (fit->seen && isnan(fit->high))
        return "a record that continues until the change of friction is complete";
    return fit->seen && isnan(fit->low) ? "shorter cycles at the start, or a slower record"
                                        : "a longer record, or more of them, of a fresh surface";
}

static void write_run_advice(const run_set *all, run_quantity number, char *text, size_t size)
{
    const run_fit *const open = number == RUN_TIME_RATIO ? first_inconclusive_run(all) : NULL,
                         *const run = first_determined_run(all, number);
    const run_level *const level = &all->level[number];
    static const char smaller[] =
        "smaller errors of the prediction: material, roughness and layer together";
    size_t line = 0;
    if (open != NULL || run == NULL) {
        const run_fit *const of = open != NULL ? open : first_compared_run(all);
        snprintf(text, size, "%s", of->ambiguous ? smaller : remedy_for_time(&of->fit));
        return;
    }
    const double share = largest_line(run, all->seed, number, &line),
                 of_common = level->common / (level->record_variance + level->common);
    if (of_common < 0.5) {
        snprintf(text, size, "a longer record, or more of them, of a fresh surface: %s",
                 level->fit.scatter > 0 ? "they scatter by more than their errors"
                                        : "most of the error is that of the record");
        return;
    }
    if (share < 0.5 || run->growth->n_lines == 0) {
        snprintf(text, size, "%s", smaller);
        return;
    }
    const char *remedy, *words = draw_source_name(run->growth->line[line], &remedy);
    clocale_print(text, size, "%s known better: %s; %.0f %% of the variance is of it", words,
                  remedy, 100 * share * of_common);
}

/* True if the draws of a compared run leave the existence of a layer inconclusive. */
static bool may_have_no_layer(const run_set *all)
{
    for (size_t i = 0; i < all->n; i++) {
        const growth *const g = all->runs[i].growth;
        if (all->runs[i].value != NULL && (double)g->n_bare > RUN_LEAST_DOUBT * (double)g->n_draws)
            return true;
    }
    return false;
}

/* ---- verdict --------------------------------------------------------------------------------- */

/* Sets the verdict if the test is impossible. The last resort for the reason is the note of the
 * first run. */
static bool set_missing_input_verdict(const run_set *all, run_verdict *w)
{
    const run_fit *const run = first_compared_run(all);
    const char *why = NULL, *settles = "a record of a fresh surface from its first cycle on";
    if (!all->has_shear) {
        why = "no shear stress is given, and the total friction is not predicted without it";
        settles = "a shear stress of the real contact";
    } else if (all->n == 0) {
        why = "no record begins with its first step";
    } else if (run == NULL) {
        why = all->runs[0].note;
        settles = all->runs[0].growth == NULL && all->runs[0].rec->note[0] == '\0'
                      ? "a case that predicts a layer which changes friction at these conditions"
                      : settles;
    } else if (all->skip_numerical_errors != NULL) {
        why = all->skip_numerical_errors;
        settles = "errors of the prediction, by replicates";
    } else if (may_have_no_layer(all)) {
        why = "within the stated errors there may be no layer";
        settles = "specific wear rate and critical energy known better";
    }
    if (why == NULL)
        return false;
    snprintf(w->verdict, sizeof w->verdict, "%s: %s", stated_verdict_text(w->outcome), why);
    snprintf(w->settled_by, sizeof w->settled_by, "%s", settles);
    return true;
}

run_verdict run_set_assess(const run_set *all)
{
    run_verdict w = {.outcome = VERDICT_INCONCLUSIVE};
    if (set_missing_input_verdict(all, &w))
        return w;
    const agreement_verdict time = assess_time(all), change = assess_change(all);
    if (time == AGREEMENT_NO || change == AGREEMENT_NO)
        w.outcome = VERDICT_NO;
    else if (time == AGREEMENT_YES && change == AGREEMENT_YES)
        w.outcome = VERDICT_YES;
    write_run_verdict(all, w.outcome, w.verdict, sizeof w.verdict);
    if (w.outcome == VERDICT_INCONCLUSIVE)
        write_run_advice(all, time != AGREEMENT_YES ? RUN_TIME_RATIO : RUN_RATIO, w.settled_by,
                         sizeof w.settled_by);
    return w;
}
