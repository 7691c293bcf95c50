/* Fits of the running-in of one record and of several records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"

#include "core/math/normal_quantile.h"

#include <math.h>
#include <stdlib.h>

/* A series of averaged cycles is fitted again up to this multiple of the settling time, with
 * shorter means. */
static const double lengths_kept = 20;
enum { LOOKS = 3 };
/* Smallest prior error of the logarithm of the time, if the prediction has no scatter. */
static const double least_expected = 0.05;
/* Search range for the factor of a draw: standard errors about the most probable factor, and a
 * lower bound. */
static const double errors_around = 4, least_around = 0.3;

/* ---- one run --------------------------------------------------------------------------------- */

static double settled_of(const growth *g, size_t k)
{
    const course c = growth_course(g, k);
    return running_in_curve_settled(&c, RUNNING_IN_LEFT);
}

static double log_settled(const growth *g, size_t k, double time)
{
    (void)time;
    return log(settled_of(g, k));
}

/* Standard deviation of the logarithm of the predicted time. */
static double expected_error(const growth *g)
{
    return fmax(growth_scatter(g, log_settled, (double)NAN), least_expected);
}

static wt_status fit_until(run_fit *run, double until, double expected, wt_error *err)
{
    running_in_series s;
    const course c = growth_course(run->growth, 0);
    wt_status status = recorded_series(run->rec, until, &s, err);
    if (status == WT_OK)
        status = running_in_curve_fit_make(&(running_in_curve_pair){&s, &c}, 1, RUNNING_IN_LEFT,
                                           expected, &run->fit, err);
    run->until = until;
    running_in_series_clear(&s);
    return status;
}

/* Fits the whole record, then only its beginning if that contains the change. */
static wt_status fit_values(run_fit *run, wt_error *err)
{
    const double settled = settled_of(run->growth, 0), expected = expected_error(run->growth);
    double until = run->rec->end[run->rec->n - 1];
    wt_status status = fit_until(run, until, expected, err);
    for (int look = 1; status == WT_OK && look < LOOKS; look++) {
        const double factor = run->fit.seen ? exp(run->fit.log_factor) : 1,
                     shorter = lengths_kept * factor * settled;
        if (!(shorter < 0.5 * until) || !recorded_is_joined(run->rec, until) ||
            recorded_means(run->rec, shorter) < COURSE_FEWEST) /* the previous fit remains */
            break;
        until = shorter;
        status = fit_until(run, until, expected, err);
    }
    return status;
}

static void put_numbers(const run_fit *run, size_t k, double margin, double log_ratio, double ratio,
                        double *out)
{
    const growth *const g = run->growth;
    const course c = growth_course(g, k);
    const double height = running_in_curve_height(&c), most = 1 + margin;
    out[RUN_TIME_RATIO] = run->fit.seen ? log_ratio : (double)NAN;
    out[RUN_MORE] = height * (ratio - 1 / most);
    out[RUN_LESS] = height * (most - ratio);
    out[RUN_RATIO] = ratio;
    out[RUN_PREDICTED] = log(settled_of(g, k));
    out[RUN_MEASURED] = out[RUN_TIME_RATIO] + out[RUN_PREDICTED];
    /* formation and wear scale with time together, at the same thickness */
    out[RUN_WEAR] = log(growth_number_of(g, k, GROWTH_WEAR)) - out[RUN_TIME_RATIO];
    out[RUN_ENERGY] = log(growth_number_of(g, k, GROWTH_ENERGY)) + out[RUN_TIME_RATIO];
}

/* Fits the curve of each draw with one law of the scatter, relative to the nominal curve. The
 * uncertainty over all laws is the error of the record. */
static wt_status fit_draws(run_fit *run, double margin, wt_error *err)
{
    const growth *const g = run->growth;
    const running_in_curve_fit *const fit = &run->fit;
    const course nominal = growth_course(g, 0);
    running_in_series s;
    const wt_status status = recorded_series(run->rec, run->until, &s, err);
    const double within = fit->seen ? fmax(errors_around * fit->error, least_around) : 0,
                 centre = fit->seen ? fit->log_factor : 0, settled = log(settled_of(g, 0));
    running_in_optimum base = {0};
    if (status == WT_OK)
        base = running_in_optimum_find(&s, &nominal, fit->law, centre, within);
    put_numbers(run, 0, margin, fit->log_factor, fit->ratio, run->value);
    for (size_t k = 1; status == WT_OK && k <= g->n_draws; k++) {
        const course c = growth_course(g, k);
        /* without a visible change, the factor is fixed at the time that the draw predicts */
        const double around = fit->seen ? centre + settled - log(settled_of(g, k)) : 0;
        const running_in_optimum place = running_in_optimum_find(&s, &c, fit->law, around, within);
        put_numbers(run, k, margin, fit->log_factor + place.log_factor - base.log_factor,
                    fit->ratio + place.ratio - base.ratio, run->value + k * RUN_NUMBERS);
    }
    running_in_series_clear(&s);
    return status;
}

wt_status run_fit_compute(run_fit *run, double margin, wt_error *err)
{
    wt_error why = WT_ERROR_INIT;
    const wt_status status = fit_values(run, &why);
    if (status == WT_E_MEMORY)
        return wt_fail(err, status, "out of memory");
    if (status != WT_OK) {
        snprintf(run->note, sizeof run->note, "%s", why.message);
        return WT_OK;
    }
    run->value = calloc((1 + run->growth->n_draws) * RUN_NUMBERS, sizeof *run->value);
    if (run->value == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (!run->fit.seen)
        snprintf(run->note, sizeof run->note,
                 "no change as the layer makes it stands out of the "
                 "scatter of the cycles");
    else if (isnan(run->fit.high))
        snprintf(run->note, sizeof run->note,
                 "a change as the layer makes it is not over at the end of the record");
    else if (isnan(run->fit.low))
        snprintf(run->note, sizeof run->note,
                 "a change as the layer makes it is over within the first cycles");
    return fit_draws(run, margin, err);
}

void run_fit_clear(run_fit *run)
{
    free(run->value);
    run->value = NULL;
}

bool run_fit_is_closed(const run_fit *run)
{
    return run->value != NULL && run->fit.seen && !isnan(run->fit.low) && !isnan(run->fit.high);
}

double run_fit_value(const run_fit *run, size_t k, run_number number)
{
    return run->value[k * RUN_NUMBERS + (size_t)number];
}

double run_fit_own(const run_fit *run, run_number number)
{
    const course c = growth_course(run->growth, 0);
    const double height = running_in_curve_height(&c), ratio = run->fit.ratio_error,
                 time = (run->fit.high - run->fit.low) / (2 * NORMAL_95);
    switch (number) {
    case RUN_RATIO:
        return ratio * ratio;
    case RUN_MORE:
    case RUN_LESS:
        return height * height * ratio * ratio;
    case RUN_PREDICTED:
        return 0;
    default:
        return isnan(time) ? run->fit.error * run->fit.error : time * time;
    }
}

/* ---- draws ----------------------------------------------------------------------------------- */

/* Covariance over the draws that both runs have. Returns their number. */
static size_t covariance(const run_fit *a, const run_fit *b, run_number number, double *covariance)
{
    const size_t n =
        a->growth->n_draws < b->growth->n_draws ? a->growth->n_draws : b->growth->n_draws;
    double x = 0, y = 0, xy = 0;
    size_t good = 0;
    for (size_t k = 1; k <= n; k++) {
        const double u = run_fit_value(a, k, number) - run_fit_value(a, 0, number),
                     v = run_fit_value(b, k, number) - run_fit_value(b, 0, number);
        if (!isfinite(u) || !isfinite(v))
            continue;
        x += u;
        y += v;
        xy += u * v;
        good++;
    }
    *covariance = good > 1 ? (xy - x * y / (double)good) / (double)(good - 1) : 0;
    return good;
}

double run_fit_spread(const run_fit *run, run_number number)
{
    double variance;
    return covariance(run, run, number, &variance) > 1 ? sqrt(variance) : (double)NAN;
}

double run_fit_end(const run_fit *run, run_number number)
{
    const bool least = isnan(run->fit.high);
    const double spread = NORMAL_95 * run_fit_spread(run, number),
                 at = run_fit_value(run, 0, number),
                 move = hypot((least ? run->fit.low : run->fit.high) - run->fit.log_factor, spread);
    return least ? at - move : at + move;
}

/* ---- several runs ---------------------------------------------------------------------------- */

bool run_fit_determines(const run_fit *run, run_number number)
{
    if (number == RUN_PREDICTED) /* the record does not determine it */
        return false;
    const bool of_change = number == RUN_MORE || number == RUN_LESS || number == RUN_RATIO;
    return (of_change ? run->value != NULL : run_fit_is_closed(run)) &&
           isfinite(run_fit_value(run, 0, number)) && isfinite(run_fit_own(run, number));
}

typedef struct run_arrays {
    const run_fit **of; /* [n] */
    size_t n;
    double *place, *value, *own, *common;
} run_arrays;

static wt_status arrays_make(const run_fit *runs, size_t n, run_number number, run_arrays *a,
                             wt_error *err)
{
    *a = (run_arrays){.of = calloc(n + 1, sizeof *a->of),
                      .place = calloc(n + 1, sizeof *a->place),
                      .value = calloc(n + 1, sizeof *a->value),
                      .own = calloc(n + 1, sizeof *a->own),
                      .common = calloc(n * n + 1, sizeof *a->common)};
    if (a->of == NULL || a->place == NULL || a->value == NULL || a->own == NULL ||
        a->common == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) {
        if (!run_fit_determines(&runs[i], number))
            continue;
        a->of[a->n] = &runs[i];
        a->place[a->n] = log10(runs[i].rec->at.velocity);
        a->value[a->n] = run_fit_value(&runs[i], 0, number);
        a->own[a->n++] = run_fit_own(&runs[i], number);
    }
    for (size_t i = 0; i < a->n; i++)
        for (size_t k = 0; k < a->n; k++)
            (void)covariance(a->of[i], a->of[k], number, &a->common[i * a->n + k]);
    return WT_OK;
}

static void arrays_clear(run_arrays *a)
{
    free((void *)a->of);
    free(a->place);
    free(a->value);
    free(a->own);
    free(a->common);
}

wt_status run_level_make(const run_fit *runs, size_t n, run_number number, run_level *level,
                         wt_error *err)
{
    run_arrays a;
    *level = (run_level){.own = 0};
    wt_status status = arrays_make(runs, n, number, &a, err);
    const agreement_data data = {a.n, a.place, a.value, a.own, a.common, 0};
    if (status == WT_OK && a.n > 0)
        status = agreement_fit(&data, 1, &level->fit, err);
    for (size_t i = 0; status == WT_OK && i < a.n; i++) {
        const double w = level->fit.weight[i];
        level->own += w * w * (a.own[i] + level->fit.scatter);
        for (size_t k = 0; k < a.n; k++)
            level->common += w * a.common[i * a.n + k] * level->fit.weight[k];
    }
    arrays_clear(&a);
    return status;
}

wt_interval run_level_interval(const run_level *level)
{
    const double none = (double)NAN;
    double ends[2];
    if (level->fit.n == 0)
        return (wt_interval){none, none, none, none};
    agreement_ends(&level->fit, 0, false, ends);
    return (wt_interval){level->fit.smooth[0], level->fit.error[0], ends[0], ends[1]};
}

void run_level_clear(run_level *level)
{
    agreement_clear(&level->fit);
}

/* ---- joint fit ------------------------------------------------------------------------------- */

typedef struct joint {
    const run_fit **of; /* [n] compared runs */
    running_in_series *series;
    course *course;
    running_in_curve_pair *pair;
    size_t n;
    double log_odds; /* with a separate time and change for each run */
} joint;

static void joint_clear(joint *j)
{
    for (size_t i = 0; j->series != NULL && i < j->n; i++)
        running_in_series_clear(&j->series[i]);
    free((void *)j->of);
    free(j->series);
    free(j->course);
    free(j->pair);
}

static wt_status joint_make(const run_fit *runs, size_t n, joint *j, wt_error *err)
{
    *j = (joint){.of = calloc(n + 1, sizeof *j->of),
                 .series = calloc(n + 1, sizeof *j->series),
                 .course = calloc(n + 1, sizeof *j->course),
                 .pair = calloc(n + 1, sizeof *j->pair)};
    wt_status status = WT_OK;
    if (j->of == NULL || j->series == NULL || j->course == NULL || j->pair == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        if (runs[i].value == NULL)
            continue;
        const size_t k = j->n++;
        j->of[k] = &runs[i];
        j->course[k] = growth_course(runs[i].growth, 0);
        j->pair[k] = (running_in_curve_pair){&j->series[k], &j->course[k]};
        j->log_odds += runs[i].fit.log_odds;
        status = recorded_series(runs[i].rec, runs[i].until, &j->series[k], err);
    }
    return status;
}

/* Change of the logarithm of the time due to draw k: the mean over the runs that it affects. If no
 * run shows a change, it is that of the predicted time. */
static double moved(const joint *j, size_t k)
{
    double sum = 0, n = 0;
    for (size_t i = 0; i < j->n; i++) {
        const run_fit *const run = j->of[i];
        const double off = k <= run->growth->n_draws ? run_fit_value(run, k, RUN_TIME_RATIO) -
                                                           run_fit_value(run, 0, RUN_TIME_RATIO)
                                                     : (double)NAN;
        sum += isfinite(off) ? off : 0;
        n += isfinite(off);
    }
    return n > 0 ? sum / n
                 : log(settled_of(j->of[0]->growth, 0)) - log(settled_of(j->of[0]->growth, k));
}

static wt_status joint_tell(const joint *j, double margin, run_fit *joined, wt_error *err)
{
    const size_t draws = joined->growth->n_draws;
    joined->value = calloc((1 + draws) * RUN_NUMBERS, sizeof *joined->value);
    if (joined->value == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t k = 0; k <= draws; k++)
        put_numbers(joined, k, margin, joined->fit.log_factor + (k > 0 ? moved(j, k) : 0),
                    joined->fit.ratio, joined->value + k * RUN_NUMBERS);
    return WT_OK;
}

/* Fits all compared records jointly. The value is NULL if they do not have one time. */
static wt_status join_runs(const run_fit *runs, size_t n, double margin, run_fit *joined,
                           wt_error *err)
{
    joint j;
    *joined = (run_fit){.value = NULL};
    wt_status status = joint_make(runs, n, &j, err);
    if (status == WT_OK && j.n > 1) {
        *joined = *j.of[0];
        joined->value = NULL;
        status = running_in_curve_fit_make(j.pair, j.n, RUNNING_IN_LEFT,
                                           expected_error(joined->growth), &joined->fit, err);
        if (status == WT_OK && joined->fit.log_odds > j.log_odds - log(COURSE_ODDS))
            status = joint_tell(&j, margin, joined, err);
    }
    joint_clear(&j);
    return status;
}

/* Numbers of the time, which a record may not determine. */
static const run_number of_time[] = {RUN_TIME_RATIO, RUN_MEASURED, RUN_WEAR, RUN_ENERGY};

static wt_status level_together(run_set *all, wt_error *err)
{
    run_fit joined;
    wt_status status = join_runs(all->runs, all->n, all->margin, &joined, err);
    for (size_t k = 0; status == WT_OK && k < sizeof of_time / sizeof *of_time; k++) {
        run_level *const level = &all->level[of_time[k]];
        run_level_clear(level);
        status = run_level_make(&joined, joined.value != NULL, of_time[k], level, err);
    }
    run_fit_clear(&joined);
    return status;
}

wt_status run_set_levels(run_set *all, wt_error *err)
{
    size_t compared = 0, closed = 0;
    wt_status status = WT_OK;
    for (size_t k = 0; status == WT_OK && k < RUN_NUMBERS; k++)
        status = run_level_make(all->runs, all->n, (run_number)k, &all->level[k], err);
    for (size_t i = 0; i < all->n; i++) {
        compared += all->runs[i].value != NULL;
        closed += run_fit_is_closed(&all->runs[i]);
    }
    /* runs that scatter by more than their errors have no common time */
    if (status == WT_OK && compared > 1 && closed < compared &&
        !(all->level[RUN_TIME_RATIO].fit.scatter > 0))
        status = level_together(all, err);
    return status;
}

void run_set_clear(run_set *all)
{
    for (size_t k = 0; k < RUN_NUMBERS; k++)
        run_level_clear(&all->level[k]);
}
