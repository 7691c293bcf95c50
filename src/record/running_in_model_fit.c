/* Fits of the running-in of one record and of several records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/running_in_validation.h"

#include "core/base/array.h"
#include "core/math/students_t.h"

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

static double settling_time(const growth *g, size_t k)
{
    const running_in_curve c = growth_curve(g, k);
    return running_in_curve_settling_time(&c, RUNNING_IN_REMAINDER);
}

static double log_settling_time(const growth *g, size_t k, double time)
{
    (void)time;
    return log(settling_time(g, k));
}

/* Standard deviation of the logarithm of the predicted time. */
static double expected_error(const growth *g)
{
    return fmax(growth_standard_deviation(g, log_settling_time, (double)NAN), least_expected);
}

static wt_status fit_until(run_fit *run, double until, double expected, wt_error *err)
{
    running_in_series s = recorded_read_series(run->rec, until);
    const running_in_curve c = growth_curve(run->growth, 0);
    const wt_status status = running_in_curve_fit_compute(
        &(running_in_curve_pair){&s, &c}, 1, RUNNING_IN_REMAINDER, expected, &run->fit, err);
    run->until = until;
    running_in_series_clear(&s);
    return status;
}

/* Fits the whole record, then only its beginning if that contains the change. */
static wt_status fit_values(run_fit *run, wt_error *err)
{
    const double settled = settling_time(run->growth, 0), expected = expected_error(run->growth);
    double until = run->rec->end[run->rec->n - 1];
    wt_status status = fit_until(run, until, expected, err);
    for (int look = 1; status == WT_OK && look < LOOKS; look++) {
        const double factor = run->fit.seen ? exp(run->fit.log_factor) : 1,
                     shorter = lengths_kept * factor * settled;
        if (!(shorter < 0.5 * until) || !recorded_is_averaged(run->rec, until) ||
            recorded_mean_count(run->rec, shorter) <
                RUNNING_IN_CURVE_MIN_MEANS) /* the previous fit remains */
            break;
        until = shorter;
        status = fit_until(run, until, expected, err);
    }
    return status;
}

static void set_run_values(const run_fit *run, size_t k, double margin, double log_ratio,
                           double ratio, double *out)
{
    const growth *const g = run->growth;
    const running_in_curve c = growth_curve(g, k);
    const double height = running_in_curve_height(&c), most = 1 + margin;
    out[RUN_TIME_RATIO] = run->fit.seen ? log_ratio : (double)NAN;
    out[RUN_ABOVE_LOWER] = height * (ratio - 1 / most);
    out[RUN_BELOW_UPPER] = height * (most - ratio);
    out[RUN_RATIO] = ratio;
    out[RUN_PREDICTED] = log(settling_time(g, k));
    /* of the growth, and of what is before it */
    out[RUN_MEASURED] = out[RUN_TIME_RATIO] + out[RUN_PREDICTED];
    out[RUN_MEASURED] += log1p(fmax(run->fit.shift / exp(out[RUN_MEASURED]), -0.5));
    /* formation and wear scale with time together, at the same thickness */
    out[RUN_WEAR] = log(growth_quantity_value(g, k, GROWTH_WEAR)) - out[RUN_TIME_RATIO];
    out[RUN_ENERGY] = log(growth_quantity_value(g, k, GROWTH_ENERGY)) + out[RUN_TIME_RATIO];
}

/* Fits the curve of each draw with one law of the scatter, relative to the nominal curve. The
 * uncertainty over all laws is the error of the record. */
static void fit_draws(run_fit *run, double margin)
{
    const growth *const g = run->growth;
    const running_in_curve_fit *const fit = &run->fit;
    const running_in_curve nominal = growth_curve(g, 0);
    running_in_series s = recorded_read_series(run->rec, run->until);
    s.shift = fit->shift;
    const double within = fit->seen ? fmax(errors_around * fit->error, least_around) : 0,
                 centre = fit->seen ? fit->log_factor : 0, settled = log(settling_time(g, 0));
    const running_in_optimum base = running_in_optimum_find(&s, &nominal, fit->law, centre, within);
    set_run_values(run, 0, margin, fit->log_factor, fit->ratio, run->value);
    for (size_t k = 1; k <= g->n_draws; k++) {
        const running_in_curve c = growth_curve(g, k);
        /* without a visible change, the factor is fixed at the time that the draw predicts */
        const double around = fit->seen ? centre + settled - log(settling_time(g, k)) : 0;
        const running_in_optimum place = running_in_optimum_find(&s, &c, fit->law, around, within);
        set_run_values(run, k, margin, fit->log_factor + place.log_factor - base.log_factor,
                       fit->ratio + place.ratio - base.ratio, run->value + k * RUN_QUANTITIES);
    }
    running_in_series_clear(&s);
}

static bool is_outside(const run_fit *run, run_quantity number, double low, double high)
{
    const double at = run_fit_value(run, 0, number),
                 half = NORMAL_95 * hypot(sqrt(run_fit_record_variance(run, number)),
                                          run_fit_prediction_deviation(run, number));
    return at - half > high || at + half < low;
}

/* True if time or change are outside of the margin. */
static bool contradicts(const run_fit *run, double margin)
{
    const double most = log1p(margin), none = (double)INFINITY;
    const double end = run->fit.seen ? run_fit_bound(run, RUN_TIME_RATIO) : (double)NAN;
    const bool time = run_fit_is_closed(run) ? is_outside(run, RUN_TIME_RATIO, -most, most)
                      : isnan(run->fit.high) ? end > most
                                             : end < -most;
    return time || is_outside(run, RUN_ABOVE_LOWER, 0, none) ||
           is_outside(run, RUN_BELOW_UPPER, 0, none);
}

/* ln of a ratio of likelihoods for two numbers, 95 %. */
static const double as_well = 3;

/* The errors of a prediction can change its shape, so that another time fits the record with the
 * nominal one. Whether more draws than by chance fit it as well, at a time and a change within the
 * margin. */
static bool fits_within_margin(const run_fit *run, double margin)
{
    const growth *const g = run->growth;
    size_t n = 0;
    running_in_series s = recorded_read_series(run->rec, run->until);
    s.shift = run->fit.shift;
    const running_in_curve nominal = growth_curve(g, 0);
    const double best =
        running_in_likelihoods_find(&s, &nominal, run->fit.law,
                                    run->fit.seen ? run->fit.log_factor : 0, 1 + margin)
            .any;
    for (size_t k = 1; k <= g->n_draws; k++) {
        const running_in_curve c = growth_curve(g, k);
        n += running_in_likelihoods_find(&s, &c, run->fit.law, 0, 1 + margin).within >
             best - as_well;
    }
    running_in_series_clear(&s);
    return (double)n > RUN_LEAST_DOUBT * (double)g->n_draws;
}

void run_fit_compute(run_fit *run, double margin)
{
    wt_error why = WT_ERROR_INIT;
    if (fit_values(run, &why) != WT_OK) {
        snprintf(run->note, sizeof run->note, "%s", why.message);
        return;
    }
    run->value = wt_alloc((1 + run->growth->n_draws) * RUN_QUANTITIES, sizeof *run->value);
    if (!run->fit.seen)
        snprintf(run->note, sizeof run->note,
                 "no change like that by the layer exceeds the scatter of the cycles");
    else if (isnan(run->fit.high))
        snprintf(run->note, sizeof run->note,
                 "a change like that by the layer is not complete at the end of the record");
    else if (isnan(run->fit.low))
        snprintf(run->note, sizeof run->note,
                 "a change like that by the layer is complete within the first cycles");
    fit_draws(run, margin);
    run->ambiguous = contradicts(run, margin) && fits_within_margin(run, margin);
    if (run->ambiguous)
        snprintf(run->note, sizeof run->note,
                 "a prediction within its errors fits the record as well as another time or change "
                 "does");
}

void run_fit_clear(run_fit *run)
{
    free(run->value);
    run->value = NULL;
}

bool run_fit_is_closed(const run_fit *run)
{
    return run->value != NULL && !run->ambiguous && run->fit.seen && !isnan(run->fit.low) &&
           !isnan(run->fit.high);
}

double run_fit_value(const run_fit *run, size_t k, run_quantity number)
{
    return run->value[k * RUN_QUANTITIES + (size_t)number];
}

double run_fit_record_variance(const run_fit *run, run_quantity number)
{
    const running_in_curve c = growth_curve(run->growth, 0);
    const double height = running_in_curve_height(&c), ratio = run->fit.ratio_error,
                 time = (run->fit.high - run->fit.low) / (2 * NORMAL_95);
    switch (number) {
    case RUN_RATIO:
        return ratio * ratio;
    case RUN_ABOVE_LOWER:
    case RUN_BELOW_UPPER:
        return height * height * ratio * ratio;
    case RUN_PREDICTED:
        return 0;
    default:
        return isnan(time) ? run->fit.error * run->fit.error : time * time;
    }
}

/* ---- draws ----------------------------------------------------------------------------------- */

/* Covariance over the draws that both runs have. Returns their number. */
static size_t draw_covariance(const run_fit *a, const run_fit *b, run_quantity number,
                              double *draw_covariance)
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
    *draw_covariance = good > 1 ? (xy - x * y / (double)good) / (double)(good - 1) : 0;
    return good;
}

double run_fit_prediction_deviation(const run_fit *run, run_quantity number)
{
    double variance;
    return draw_covariance(run, run, number, &variance) > 1 ? sqrt(variance) : (double)NAN;
}

double run_fit_bound(const run_fit *run, run_quantity number)
{
    const bool least = isnan(run->fit.high);
    const double spread = NORMAL_95 * run_fit_prediction_deviation(run, number),
                 at = run_fit_value(run, 0, number),
                 move = hypot((least ? run->fit.low : run->fit.high) - run->fit.log_factor, spread);
    return least ? at - move : at + move;
}

/* ---- several runs ---------------------------------------------------------------------------- */

bool run_fit_determines(const run_fit *run, run_quantity number)
{
    if (number == RUN_PREDICTED) /* the record does not determine it */
        return false;
    const bool of_change =
        number == RUN_ABOVE_LOWER || number == RUN_BELOW_UPPER || number == RUN_RATIO;
    return (of_change ? run->value != NULL && !run->ambiguous : run_fit_is_closed(run)) &&
           isfinite(run_fit_value(run, 0, number)) &&
           isfinite(run_fit_record_variance(run, number)) &&
           /* of draws whose course hardly changes within the record, it is not finite */
           (run->growth->n_draws == 0 || isfinite(run_fit_prediction_deviation(run, number)));
}

typedef struct run_arrays {
    const run_fit **of; /* [n] */
    size_t n;
    double *place, *value, *record_variance, *common;
    arena memory;
} run_arrays;

static run_arrays run_arrays_collect(const run_fit *runs, size_t n, run_quantity number)
{
    run_arrays a = {.n = 0};
    a.of = arena_alloc(&a.memory, n, sizeof *a.of);
    a.place = arena_numbers(&a.memory, n);
    a.value = arena_numbers(&a.memory, n);
    a.record_variance = arena_numbers(&a.memory, n);
    a.common = arena_numbers(&a.memory, n * n);
    for (size_t i = 0; i < n; i++) {
        if (!run_fit_determines(&runs[i], number))
            continue;
        a.of[a.n] = &runs[i];
        a.place[a.n] = log10(runs[i].rec->at.velocity);
        a.value[a.n] = run_fit_value(&runs[i], 0, number);
        a.record_variance[a.n++] = run_fit_record_variance(&runs[i], number);
    }
    for (size_t i = 0; i < a.n; i++)
        for (size_t k = 0; k < a.n; k++)
            (void)draw_covariance(a.of[i], a.of[k], number, &a.common[i * a.n + k]);
    return a;
}

wt_status run_level_compute(const run_fit *runs, size_t n, run_quantity number, run_level *level,
                            wt_error *err)
{
    run_arrays a = run_arrays_collect(runs, n, number);
    wt_status status = WT_OK;
    *level = (run_level){.record_variance = 0};
    const agreement_data data = {a.n, a.place, a.value, a.record_variance, a.common, 0};
    if (a.n > 0)
        status = agreement_fit(&data, 1, &level->fit, err);
    for (size_t i = 0; status == WT_OK && i < a.n; i++) {
        const double w = level->fit.weight[i];
        level->record_variance += w * w * (a.record_variance[i] + level->fit.scatter);
        for (size_t k = 0; k < a.n; k++)
            level->common += w * a.common[i * a.n + k] * level->fit.weight[k];
    }
    arena_free(&a.memory);
    return status;
}

wt_interval run_level_interval(const run_level *level)
{
    const double none = (double)NAN;
    double ends[2];
    if (level->fit.n == 0)
        return (wt_interval){none, none, none, none};
    agreement_interval(&level->fit, 0, false, ends);
    return (wt_interval){level->fit.fitted_value[0], level->fit.error[0], ends[0], ends[1]};
}

void run_level_clear(run_level *level)
{
    agreement_clear(&level->fit);
}

/* ---- joint fit ------------------------------------------------------------------------------- */

typedef struct joint_fit {
    const run_fit **of; /* [n] compared runs */
    running_in_series *series;
    running_in_curve *running_in_curve;
    running_in_curve_pair *pair;
    size_t n;
    double log_odds; /* with a separate time and change for each run */
} joint_fit;

static joint_fit joint_make(const run_fit *runs, size_t n, arena *memory)
{
    joint_fit j = {.of = arena_alloc(memory, n, sizeof *j.of),
                   .series = arena_alloc(memory, n, sizeof *j.series),
                   .running_in_curve = arena_alloc(memory, n, sizeof *j.running_in_curve),
                   .pair = arena_alloc(memory, n, sizeof *j.pair)};
    for (size_t i = 0; i < n; i++) {
        if (runs[i].value == NULL)
            continue;
        const size_t k = j.n++;
        j.of[k] = &runs[i];
        j.running_in_curve[k] = growth_curve(runs[i].growth, 0);
        j.pair[k] = (running_in_curve_pair){&j.series[k], &j.running_in_curve[k]};
        j.log_odds += runs[i].fit.log_odds;
        j.series[k] = recorded_read_series(runs[i].rec, runs[i].until);
    }
    return j;
}

/* Change of the logarithm of the time due to draw k: the mean over the runs that it affects. If no
 * run shows a change, it is that of the predicted time. */
static double joint_time_change(const joint_fit *j, size_t k)
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
    return n > 0
               ? sum / n
               : log(settling_time(j->of[0]->growth, 0)) - log(settling_time(j->of[0]->growth, k));
}

static void joint_set_values(const joint_fit *j, double margin, run_fit *joined)
{
    const size_t draws = joined->growth->n_draws;
    joined->value = wt_alloc((1 + draws) * RUN_QUANTITIES, sizeof *joined->value);
    for (size_t k = 0; k <= draws; k++)
        set_run_values(joined, k, margin,
                       joined->fit.log_factor + (k > 0 ? joint_time_change(j, k) : 0),
                       joined->fit.ratio, joined->value + k * RUN_QUANTITIES);
}

/* Fits all compared records jointly. The value is NULL if they do not have one time. */
static wt_status fit_joint_run(const run_fit *runs, size_t n, double margin, run_fit *joined,
                               wt_error *err)
{
    arena memory = {0};
    const joint_fit j = joint_make(runs, n, &memory);
    wt_status status = WT_OK;
    *joined = (run_fit){.value = NULL};
    if (j.n > 1) {
        *joined = *j.of[0];
        joined->value = NULL;
        status = running_in_curve_fit_compute(j.pair, j.n, RUNNING_IN_REMAINDER,
                                              expected_error(joined->growth), &joined->fit, err);
        if (status == WT_OK && joined->fit.log_odds > j.log_odds - log(RUNNING_IN_CURVE_MIN_ODDS))
            joint_set_values(&j, margin, joined);
    }
    for (size_t i = 0; i < j.n; i++)
        running_in_series_clear(&j.series[i]);
    arena_free(&memory);
    return status;
}

/* Numbers of the time, which a record may not determine. */
static const run_quantity time_quantities[] = {RUN_TIME_RATIO, RUN_MEASURED, RUN_WEAR, RUN_ENERGY};

static wt_status fit_joint_levels(run_set *all, wt_error *err)
{
    run_fit joined;
    wt_status status = fit_joint_run(all->runs, all->n, all->margin, &joined, err);
    for (size_t k = 0; status == WT_OK && k < COUNT_OF(time_quantities); k++) {
        run_level *const level = &all->level[time_quantities[k]];
        run_level_clear(level);
        status = run_level_compute(&joined, joined.value != NULL, time_quantities[k], level, err);
    }
    run_fit_clear(&joined);
    return status;
}

wt_status run_set_compute_levels(run_set *all, wt_error *err)
{
    size_t compared = 0, closed = 0;
    wt_status status = WT_OK;
    for (size_t k = 0; status == WT_OK && k < RUN_QUANTITIES; k++)
        status = run_level_compute(all->runs, all->n, (run_quantity)k, &all->level[k], err);
    for (size_t i = 0; i < all->n; i++) {
        compared += all->runs[i].value != NULL;
        closed += run_fit_is_closed(&all->runs[i]);
    }
    /* runs that scatter by more than their errors have no common time */
    if (status == WT_OK && compared > 1 && closed < compared &&
        !(all->level[RUN_TIME_RATIO].fit.scatter > 0))
        status = fit_joint_levels(all, err);
    return status;
}

void run_set_clear(run_set *all)
{
    for (size_t k = 0; k < RUN_QUANTITIES; k++)
        run_level_clear(&all->level[k]);
}
