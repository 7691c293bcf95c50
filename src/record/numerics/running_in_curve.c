/* Fit of a predicted running-in curve to a series of cycles.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/running_in_curve.h"

#include "core/base/array.h"
#include "core/math/root.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>

/* ---- one time factor ------------------------------------------------------------------------- */

/* Integral of a curve from the start. Means computed from it are exact in the first cycles, too, in
 * which most of a curve may pass. */
typedef struct curve_integral {
    const running_in_curve *c;
    double *time, *sum; /* [n] times [s], and the integral up to them */
} curve_integral;

/* Integral within interval i, in which the curve is linear in the logarithm of time. */
static double integrate_interval(const running_in_curve *c, size_t i, double from, double to,
                                 double log_ratio)
{
    const double rise = (c->value[i + 1] - c->value[i]) / c->log_step;
    return (c->value[i] - rise) * (to - from) + rise * to * log_ratio;
}

static curve_integral curve_integral_compute(const running_in_curve *c, arena *memory)
{
    const curve_integral m = {c, arena_numbers(memory, c->n), arena_numbers(memory, c->n)};
    for (size_t i = 0; i < c->n; i++) {
        m.time[i] = exp(c->log_first + (double)i * c->log_step);
        m.sum[i] = i == 0 ? c->value[0] * m.time[0]
                          : m.sum[i - 1] +
                                integrate_interval(c, i - 1, m.time[i - 1], m.time[i], c->log_step);
    }
    return m;
}

static double curve_integral_at(const curve_integral *m, double time)
{
    const running_in_curve *const c = m->c;
    const double place = (log(time) - c->log_first) / c->log_step;
    if (!(place > 0))
        return c->value[0] * time;
    if (place >= (double)(c->n - 1))
        return m->sum[c->n - 1];
    const size_t i = (size_t)place;
    return m->sum[i] +
           integrate_interval(c, i, m->time[i], time, (place - (double)i) * c->log_step);
}

/* Mean of the curve over its height in each interval of the series. column: [n]. */
static void fill_column(const running_in_series *s, const curve_integral *m, double height,
                        double log_factor, double *column)
{
    const double faster = exp(-log_factor);
    double begin = faster * (s->begin - s->shift), before = curve_integral_at(m, begin);
    for (size_t i = 0; i < s->n; i++) {
        const double end = faster * (s->end[i] - s->shift), sum = curve_integral_at(m, end);
        column[i] = (sum - before) / ((end - begin) * height);
        begin = end;
        before = sum;
    }
}

static scatter_sums curve_scatter_sums(const running_in_series *s, const double *column,
                                       scatter_law law)
{
    scatter_sums sums = scatter_begin(law);
    for (size_t i = 0; i < s->n; i++)
        scatter_add_column(&sums, column[i], s->friction[i]);
    return sums;
}

/* Golden sections of a search: they leave 2e-4 of the range. */
enum { SECTIONS = 18 };

typedef struct factor_search {
    running_in_series *s;
    curve_integral sums;
    double height, *column;
    scatter_law law;
    double log_factor; /* held in a search of the shift */
    double margin;     /* of factor and ratio about 1, a factor */
} factor_search;

/* A search in a series that the caller keeps; memory receives its arrays. */
static factor_search search_new(running_in_series *s, const running_in_curve *c, scatter_law law,
                                arena *memory)
{
    return (factor_search){.s = s,
                           .sums = curve_integral_compute(c, memory),
                           .height = running_in_curve_height(c),
                           .column = arena_numbers(memory, s->n),
                           .law = law};
}

static double profile_likelihood(double log_factor, void *user)
{
    const factor_search *const p = user;
    fill_column(p->s, &p->sums, p->height, log_factor, p->column);
    const scatter_sums sums = curve_scatter_sums(p->s, p->column, p->law);
    const double squares = scatter_solve(&sums, true).squares;
    return squares > 0 ? -log(squares) : -(double)INFINITY; /* NaN without a change */
}

running_in_optimum running_in_optimum_find(const running_in_series *s, const running_in_curve *c,
                                           scatter_law law, double around, double within)
{
    const double none = (double)NAN;
    running_in_optimum place = {none, none};
    arena memory = {0};
    running_in_series own = *s;
    factor_search p = search_new(&own, c, law, &memory);
    if (p.height > 0 && isfinite(p.height) && isfinite(around)) {
        place.log_factor = within > 0 ? root_maximum(profile_likelihood, &p, around - within,
                                                     around + within, SECTIONS)
                                      : around;
        fill_column(s, &p.sums, p.height, place.log_factor, p.column);
        const scatter_sums sums = curve_scatter_sums(s, p.column, law);
        place.ratio = scatter_solve(&sums, true).coefficient / p.height;
    }
    arena_free(&memory);
    return place;
}

/* ln of a likelihood, without what curves of one law share. */
static double squares_likelihood(double squares, size_t n)
{
    return squares > 0 ? -0.5 * (double)n * log(squares) : -(double)INFINITY;
}

/* With a ratio within the margin. */
static double margin_likelihood(double log_factor, void *user)
{
    const factor_search *const p = user;
    fill_column(p->s, &p->sums, p->height, log_factor, p->column);
    const scatter_sums sums = curve_scatter_sums(p->s, p->column, p->law);
    const scatter_fit f = scatter_solve(&sums, true);
    const double most = p->margin * p->height, least = p->height / p->margin,
                 off = fmax(fmin(f.coefficient, most), least) - f.coefficient;
    return squares_likelihood(f.squares + off * off / f.variance, p->s->n);
}

running_in_likelihoods running_in_likelihoods_find(const running_in_series *s,
                                                   const running_in_curve *c, scatter_law law,
                                                   double log_factor, double margin)
{
    arena memory = {0};
    running_in_series own = *s;
    factor_search p = search_new(&own, c, law, &memory);
    p.margin = margin;
    running_in_likelihoods l = {-(double)INFINITY, -(double)INFINITY};
    if (p.height > 0 && isfinite(p.height)) {
        l.any = squares_likelihood(exp(-profile_likelihood(log_factor, &p)), s->n);
        for (int held = 0; held < 2; held++) { /* with the shift of the series, and without */
            own.shift = held != 0 ? s->shift : 0;
            const double at =
                root_maximum(margin_likelihood, &p, -log(margin), log(margin), SECTIONS);
            l.within = fmax(l.within, margin_likelihood(at, &p));
        }
    }
    arena_free(&memory);
    return l;
}

/* ---- all time factors ------------------------------------------------------------------------ */

/* Step of the coarse scan (in ln), and number of factors of the fine scan. */
static const double coarse = 0.2;
enum { FINE = 40, COARSE_MOST = 200 };
/* ln of the ratio to the largest likelihood at which a factor is skipped: about 1e-5. */
static const double deep = 12;
/* A curve that settles within two means is not resolved. The scan goes from 1/8 of that to a
 * multiple of the length of the series. */
static const double fewest_means = 2, least_part = 0.125, most_lengths = 5;
static const double tail = 0.025; /* on each side of a 95 % interval */

/* One series with its curve. */
typedef struct member {
    running_in_series s; /* borrows the arrays; with the shift of the latest factor */
    curve_integral sums;
    double height, variance, least, settled;
    double incubation;               /* before the curve changes [s] */
    double *column;                  /* [n] */
    bool kept[SCATTER_LAWS];         /* laws that are not excluded */
    double null[SCATTER_LAWS];       /* ln of their likelihoods about a constant */
    double likelihood[SCATTER_LAWS]; /* largest likelihood with the curve */
    double best, best_scatter, best_shift;
    scatter_law best_law;
} member;

/* Mean and mean square. */
typedef struct moment_sum {
    double mean, square;
} moment_sum;

typedef struct law_sum {
    double weight;           /* as a logarithm */
    moment_sum ratio, level; /* weighted */
} law_sum;

typedef struct factor_scan {
    member *of; /* [n_of] */
    size_t n_of;
    law_sum *each;               /* [n_of] for one factor */
    size_t n;                    /* number of factors so far */
    double *log_factor, *weight; /* [n] ln of the likelihood over all laws */
    law_sum *sum;                /* [n] over the laws */
} factor_scan;

static moment_sum add_moments(moment_sum sum, double old, double now, double value, double variance)
{
    return (moment_sum){old * sum.mean + now * value,
                        old * sum.square + now * (value * value + variance)};
}

/* Places of the shift from which it is searched on. */
enum { SHIFTS = 9 };

static double shift_likelihood(double shift, void *user)
{
    factor_search *const p = user;
    p->s->shift = shift;
    return profile_likelihood(p->log_factor, p);
}

static double shift_limit(const member *t, double log_factor)
{
    return t->s.unsure + t->incubation * exp(log_factor);
}

/* Most probable shift for the most probable law so far. */
static void find_shift(member *t, double log_factor)
{
    const double most = shift_limit(t, log_factor), step = 2 * most / (SHIFTS - 1);
    factor_search p = {&t->s, t->sums, t->height, t->column, t->best_law, log_factor, 0};
    double best = -(double)INFINITY, centre = 0;
    for (int i = 0; step > 0 && i < SHIFTS; i++) {
        const double at = (i - SHIFTS / 2) * step, l = shift_likelihood(at, &p);
        if (l > best) {
            best = l;
            centre = at;
        }
    }
    t->s.shift = step > 0 ? root_maximum(shift_likelihood, &p, fmax(centre - step, -most),
                                         fmin(centre + step, most), SECTIONS)
                          : 0;
}

/* `first`: stores the likelihood of each law. */
static law_sum evaluate_member(member *t, double log_factor, bool first)
{
    law_sum sum = {.weight = -(double)INFINITY};
    const double df = (double)t->s.n - 2;
    find_shift(t, log_factor);
    fill_column(&t->s, &t->sums, t->height, log_factor, t->column);
    for (size_t i = 0; i < SCATTER_LAWS; i++) {
        if (!t->kept[i])
            continue;
        const scatter_sums s =
            curve_scatter_sums(&t->s, t->column, scatter_law_at(SCATTER_FOR_CHANGE, i, t->s.n));
        const scatter_fit f = scatter_solve(&s, true);
        const double scatter = fmax(f.squares / df, t->least);
        /* The prior admits changes of the order of the total scatter. Without it, a curve outside
         * the series would be as probable as it is unconstrained. */
        const double l = scatter_prior(SCATTER_FOR_CHANGE, i) +
                         scatter_profile_likelihood(&s, t->least) -
                         0.5 * log1p(f.variance * scatter / t->variance);
        if (!isfinite(l)) /* the curve does not pass within the series */
            continue;
        const double variance = scatter * f.variance * df / (df - 2); /* of Student's t */
        const double all = log_add(sum.weight, l), old = exp(sum.weight - all), now = exp(l - all),
                     slope = s.product[1] / s.product[0];
        sum.ratio = add_moments(sum.ratio, old, now, f.coefficient / t->height,
                                variance / (t->height * t->height));
        sum.level =
            add_moments(sum.level, old, now, s.product[3] / s.product[0] - f.coefficient * slope,
                        scatter * df / (df - 2) / s.product[0] + slope * slope * variance);
        sum.weight = all;
        if (first)
            t->likelihood[i] = fmax(t->likelihood[i], l);
        if (l > t->best) {
            t->best = l;
            t->best_law = s.law;
            t->best_scatter = scatter;
            t->best_shift = t->s.shift;
        }
    }
    return sum;
}

/* Prior variance of the change, in the unit of the first series. It is that of the series with the
 * least scatter. */
static double change_prior_variance(const factor_scan *t)
{
    double least = (double)INFINITY;
    for (size_t i = 0; i < t->n_of; i++) {
        const double unit = t->of[0].height / t->of[i].height;
        least = fmin(least, t->of[i].variance * unit * unit);
    }
    return least;
}

/* ln of the likelihoods of a series about a constant, over its laws. */
static double constant_log_likelihood(const member *m)
{
    double none = -(double)INFINITY;
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        none = log_add(none, m->null[i]);
    return none;
}

/* Combines the series, which share the ratio and have a scatter each. The ratio of each series is
 * treated as normal. The prior of the change counts once. A series that does not contain the curve
 * contributes like a constant, unless it is the only one. */
static law_sum combine_members(const factor_scan *t)
{
    double precision = 0, mean = 0, squares = 0, weight = 0;
    if (t->n_of == 1)
        return t->each[0];
    for (size_t i = 0; i < t->n_of; i++) {
        const member *const m = &t->of[i];
        const law_sum *const each = &t->each[i];
        const double variance = each->ratio.square - each->ratio.mean * each->ratio.mean,
                     changes = variance * m->height * m->height, unit = t->of[0].height;
        if (!isfinite(each->weight) || !(variance > 0)) {
            weight += constant_log_likelihood(m);
            continue;
        }
        weight += each->weight + 0.5 * log1p(changes / m->variance) - log(m->height / unit) -
                  0.5 * log(2 * M_PI * variance * unit * unit);
        const double all = precision + 1 / variance, off = each->ratio.mean - mean;
        squares += off * off * precision / (variance * all); /* about the mean so far */
        mean += off / (variance * all);
        precision = all;
    }
    if (!(precision > 0))
        return (law_sum){.weight = -(double)INFINITY};
    const double variance = 1 / precision, changes = variance * t->of[0].height * t->of[0].height;
    weight += 0.5 * (log(2 * M_PI * changes) - squares - log1p(changes / change_prior_variance(t)));
    return (law_sum){weight, {mean, mean * mean + variance}, t->each[0].level};
}

/* Evaluates factors in equal steps from low to high. */
static void evaluate_factors(factor_scan *t, double low, double high, size_t n, bool first)
{
    t->n = n;
    for (size_t i = 0; i < n; i++) {
        const double at = low + (high - low) * (double)i / (double)(n - 1);
        for (size_t k = 0; k < t->n_of; k++)
            t->each[k] = evaluate_member(&t->of[k], at, first);
        t->sum[i] = combine_members(t);
        t->log_factor[i] = at;
        t->weight[i] = t->sum[i].weight;
    }
}

/* Limits of the factor: from the smallest to the largest one that any of the series can show. */
static void factor_limits(const factor_scan *t, double limit[2])
{
    limit[0] = (double)INFINITY;
    limit[1] = -(double)INFINITY;
    for (size_t i = 0; i < t->n_of; i++) {
        const running_in_series *const s = &t->of[i].s;
        const double length = s->end[s->n - 1], mean = length / (double)s->n,
                     settled = t->of[i].settled;
        limit[0] = fmin(limit[0], log(least_part * fewest_means * mean / settled));
        limit[1] = fmax(limit[1], log(most_lengths * length / settled));
    }
}

/* Excludes laws that are less likely than the best by a factor of e^-deep. */
static void scan_coarsely(factor_scan *t, const double limit[2])
{
    const size_t n = (size_t)fmin(fmax(ceil((limit[1] - limit[0]) / coarse), 2), COARSE_MOST);
    evaluate_factors(t, limit[0], limit[1], n, true);
    for (size_t i = 0; i < t->n_of; i++)
        for (size_t k = 0; k < SCATTER_LAWS; k++)
            t->of[i].kept[k] = t->of[i].likelihood[k] > t->of[i].best - deep;
}

/* ln of the odds of the curve, with any factor, over constants. The prior of the shift is uniform
 * over its range, in which it is known to one mean. */
static double log_odds(const factor_scan *t)
{
    double any = -(double)INFINITY, none = 0;
    for (size_t i = 0; i < t->n; i++)
        any = log_add(any, t->weight[i]);
    for (size_t i = 0; i < t->n_of; i++) {
        none += constant_log_likelihood(&t->of[i]);
        none += log1p(shift_limit(&t->of[i], 0) / (t->of[i].s.end[0] - t->of[i].s.begin));
    }
    return any - log((double)t->n) - none - 0.5 * log(2 * M_PI * change_prior_variance(t));
}

/* Repeats the scan where the likelihood is large, until it covers many factors. A precise series
 * determines the factor to less than a step. */
enum { MANY = FINE / 2, SCANS = 5 };

static size_t scan_finely(factor_scan *t, const double limit[2])
{
    const double step = t->log_factor[1] - t->log_factor[0];
    double largest = -(double)INFINITY, low = limit[1], high = limit[0];
    size_t n = 0;
    for (size_t i = 0; i < t->n; i++)
        largest = fmax(largest, t->weight[i]);
    for (size_t i = 0; i < t->n; i++)
        if (t->weight[i] > largest - deep) {
            low = fmin(low, t->log_factor[i] - step);
            high = fmax(high, t->log_factor[i] + step);
        }
    evaluate_factors(t, fmax(low, limit[0]), fmin(high, limit[1]), FINE, false);
    for (size_t i = 0; i < t->n; i++)
        n += t->weight[i] > largest - deep;
    return n;
}

/* ---- results --------------------------------------------------------------------------------- */

/* Normalises the weights. `expected` > 0: standard deviation of the normal prior of the factor;
 * else the prior is uniform. */
static void normalise_weights(factor_scan *t, double expected)
{
    double all = -(double)INFINITY;
    for (size_t i = 0; i < t->n; i++) {
        const double off = t->log_factor[i] / expected;
        t->weight[i] -= expected > 0 ? 0.5 * off * off : 0;
        all = log_add(all, t->weight[i]);
    }
    for (size_t i = 0; i < t->n; i++)
        t->weight[i] = exp(t->weight[i] - all);
}

static void set_means(const factor_scan *t, running_in_curve_fit *fit)
{
    moment_sum ratio = {0, 0}, level = {0, 0};
    for (size_t i = 0; i < t->n; i++) {
        const law_sum *const sum = &t->sum[i];
        ratio.mean += t->weight[i] * sum->ratio.mean;
        ratio.square += t->weight[i] * sum->ratio.square;
        level.mean += t->weight[i] * sum->level.mean;
        level.square += t->weight[i] * sum->level.square;
    }
    fit->ratio = ratio.mean;
    fit->ratio_error = sqrt(fmax(ratio.square - ratio.mean * ratio.mean, 0));
    fit->level = level.mean;
    fit->level_error = sqrt(fmax(level.square - level.mean * level.mean, 0));
}

/* Quantile of the weights. */
static double factor_quantile(const factor_scan *t, double share)
{
    double below = 0;
    for (size_t i = 0; i < t->n; i++) {
        if (below + t->weight[i] >= share) {
            const double step = t->log_factor[1] - t->log_factor[0];
            return t->log_factor[i] + ((share - below) / t->weight[i] - 0.5) * step;
        }
        below += t->weight[i];
    }
    return t->log_factor[t->n - 1];
}

/* True if no series lasts until the curve settles. */
static bool is_after_end(const factor_scan *t, double log_factor)
{
    for (size_t i = 0; i < t->n_of; i++)
        if (exp(log_factor) * t->of[i].settled <= t->of[i].s.end[t->of[i].s.n - 1])
            return false;
    return true;
}

static bool is_within_first_means(const factor_scan *t, double log_factor)
{
    for (size_t i = 0; i < t->n_of; i++)
        if (exp(log_factor) * t->of[i].settled >= fewest_means * t->of[i].s.end[0])
            return false;
    return true;
}

static void set_factor(const factor_scan *t, running_in_curve_fit *fit)
{
    double beyond = 0, within = 0, mean = 0, square = 0;
    for (size_t i = 0; i < t->n; i++) {
        beyond += is_after_end(t, t->log_factor[i]) ? t->weight[i] : 0;
        within += is_within_first_means(t, t->log_factor[i]) ? t->weight[i] : 0;
        mean += t->weight[i] * t->log_factor[i];
        square += t->weight[i] * t->log_factor[i] * t->log_factor[i];
    }
    fit->log_factor = mean;
    fit->error = sqrt(fmax(square - mean * mean, 0));
    fit->low = within > tail ? (double)NAN : factor_quantile(t, tail);
    fit->high = beyond > tail ? (double)NAN : factor_quantile(t, 1 - tail);
}

static void find_curve_fit(factor_scan *t, double expected, running_in_curve_fit *fit)
{
    double limit[2];
    factor_limits(t, limit);
    scan_coarsely(t, limit);
    fit->log_odds = log_odds(t);
    fit->seen = fit->log_odds > log(RUNNING_IN_CURVE_MIN_ODDS);
    if (fit->seen) {
        for (int i = 0; i < SCANS && scan_finely(t, limit) < MANY; i++)
            continue;
        normalise_weights(t, 0);
        set_factor(t, fit);
    } else {
        const double wide = NORMAL_95 * expected;
        evaluate_factors(t, -wide, wide, FINE, false);
        normalise_weights(t, expected);
    }
    set_means(t, fit);
    fit->law = t->of[0].best_law;
    fit->scatter = t->of[0].best_scatter;
    fit->shift = t->of[0].best_shift;
}

/* Time before the curve changes by a thousandth of its height. */
static double incubation(const curve_integral *m, double height)
{
    const double *const value = m->c->value;
    size_t i = 0;
    while (i + 1 < m->c->n && fabs(value[i + 1] - value[0]) < 1e-3 * height)
        i++;
    return i > 0 ? m->time[i] : 0;
}

static wt_status begin(const running_in_curve_pair *of, double settled_share, arena *memory,
                       member *m, wt_error *err)
{
    const running_in_series *const s = of->series;
    *m = (member){
        .s = *s, .variance = scatter_total_variance(s->friction, s->n), .best = -(double)INFINITY};
    m->height = running_in_curve_height(of->running_in_curve);
    m->settled = running_in_curve_settling_time(of->running_in_curve, settled_share);
    m->least = SCATTER_RESOLUTION * SCATTER_RESOLUTION * m->variance;
    if (s->n < RUNNING_IN_CURVE_MIN_MEANS || !(m->variance > 0))
        return wt_fail(err, WT_E_RANGE, "too few cycles, or they do not scatter");
    if (!(m->height > 0) || !(m->settled > 0))
        return wt_fail(err, WT_E_RANGE, "friction is predicted not to change");
    m->sums = curve_integral_compute(of->running_in_curve, memory);
    m->incubation = incubation(&m->sums, m->height);
    m->column = arena_numbers(memory, s->n);
    for (size_t i = 0; i < SCATTER_LAWS; i++) {
        scatter_sums sums = scatter_begin(scatter_law_at(SCATTER_FOR_CHANGE, i, s->n));
        for (size_t k = 0; k < s->n; k++)
            scatter_add(&sums, s->friction[k]);
        m->null[i] =
            scatter_prior(SCATTER_FOR_CHANGE, i) + scatter_likelihood(&sums, false, m->least);
        m->likelihood[i] = -(double)INFINITY;
        m->kept[i] = true;
    }
    return WT_OK;
}

wt_status running_in_curve_fit_compute(const running_in_curve_pair *of, size_t n,
                                       double settled_share, double expected,
                                       running_in_curve_fit *fit, wt_error *err)
{
    const double none = (double)NAN;
    arena memory = {0};
    factor_scan t = {.of = arena_alloc(&memory, n, sizeof *t.of),
                     .n_of = n,
                     .each = arena_alloc(&memory, n, sizeof *t.each),
                     .log_factor = arena_numbers(&memory, COARSE_MOST),
                     .weight = arena_numbers(&memory, COARSE_MOST),
                     .sum = arena_alloc(&memory, COARSE_MOST, sizeof *t.sum)};
    *fit = (running_in_curve_fit){.log_factor = none, .error = none, .low = none, .high = none};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = begin(&of[i], settled_share, &memory, &t.of[i], err);
    if (status == WT_OK)
        find_curve_fit(&t, expected, fit);
    arena_free(&memory);
    return status;
}
