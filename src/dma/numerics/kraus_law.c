/* Strain softening of a filled rubber: measured characteristics, and the law of Kraus with its
 * confidence region.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/dma.h"

#include "core/base/array.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

typedef struct payne_points {
    size_t n;
    const double *log_strain, *storage, *loss;
} payne_points;

/* Box in the plane of u = ln strain_c and v = ln exponent. The moduli follow in closed form. */
typedef struct payne_box {
    double low[2], high[2];
} payne_box;

/* Levels of a modulus: value = a + (b - a) shape. The errors refer to a standard deviation of 1
 * for each point. */
typedef struct payne_levels {
    double a, b, a_error, b_error, rss;
} payne_levels;

/* ---- confidence region ----------------------------------------------------------------------- */

/* Grid cells of strain and exponent. A coarse grid around the best cell is refined 18 times,
 * each time in half the box, to 2e-7 of the range. A box grows by half in each of at most 20
 * rounds; 1.5^20 exceeds the whole range. */
enum { SIDE = 48, CELLS = SIDE * SIDE, FINE_SIDE = 9, REFINEMENTS = 18, ROUNDS = 20 };

/* Search range of ln strain outside the measured amplitudes: a decade below, where the fall is
 * complete, and two above, where it has hardly begun. Exponents of rubber are about 0.6 (Kraus
 * 1984); the range covers a factor of six to eight. */
static const double margin_below = 2.5, margin_above = 4.7, exponent_min = 0.1, exponent_max = 5;

/* ---- levels ---------------------------------------------------------------------------------- */

static double storage_shape(double log_x)
{
    return 1 / (1 + exp(2 * log_x));
}

static double loss_shape(double log_x)
{
    return 1 / cosh(log_x);
}

static double payne_total_squares(const payne_points *p)
{
    double mean = 0, rss = 0;
    for (size_t i = 0; i < p->n; i++)
        mean += p->storage[i] / (double)p->n;
    for (size_t i = 0; i < p->n; i++)
        rss += (p->storage[i] - mean) * (p->storage[i] - mean);
    return rss;
}

/* Fits value = a + (b - a) shape. A negative level is fixed at zero. */
static payne_levels fit_levels(const payne_points *p, const double *y, double (*shape)(double),
                               double u, double v)
{
    const double n = (double)p->n, m = exp(v);
    double s = 0, sy = 0, ss = 0, ssy = 0;
    for (size_t i = 0; i < p->n; i++) {
        s += shape(m * (p->log_strain[i] - u));
        sy += y[i];
    }
    const double mean = s / n, mean_y = sy / n;
    for (size_t i = 0; i < p->n; i++) {
        const double h = shape(m * (p->log_strain[i] - u)) - mean;
        ss += h * h;
        ssy += h * (y[i] - mean_y);
    }
    double slope = ss > 1e-14 * n ? ssy / ss : 0;
    payne_levels l = {.a = mean_y - slope * mean};
    if (l.a < 0) {
        l.a = 0;
        slope = (ssy + n * mean * mean_y) / (ss + n * mean * mean);
    }
    l.b = l.a + slope;
    l.a_error = ss > 0 ? sqrt(1 / n + mean * mean / ss) : (double)INFINITY;
    l.b_error = ss > 0 ? sqrt(1 / n + (1 - mean) * (1 - mean) / ss) : (double)INFINITY;
    for (size_t i = 0; i < p->n; i++) {
        const double off = y[i] - l.a - slope * shape(m * (p->log_strain[i] - u));
        l.rss += off * off;
    }
    return l;
}

static payne_levels payne_storage_levels(const payne_points *p, double u, double v)
{
    payne_levels l = fit_levels(p, p->storage, storage_shape, u, v);
    if (l.b < l.a) /* the modulus would rise with strain */
        l.rss = payne_total_squares(p);
    return l;
}

static payne_levels payne_loss_levels(const payne_points *p, double u, double v)
{
    return fit_levels(p, p->loss, loss_shape, u, v);
}

/* ---- the grid -------------------------------------------------------------------------------- */

static payne_box search_box(const payne_points *p)
{
    return (payne_box){{p->log_strain[0] - margin_below, log(exponent_min)},
                       {p->log_strain[p->n - 1] + margin_above, log(exponent_max)}};
}

static double cell_position(const payne_box *box, int axis, size_t i, size_t side)
{
    return box->low[axis] + (box->high[axis] - box->low[axis]) * (double)i / (double)(side - 1);
}

/* Returns a box of two cells around a point, limited to another box. */
static payne_box box_around(const payne_box *in, const payne_box *box, const double at[2],
                            size_t side)
{
    payne_box made;
    for (int k = 0; k < 2; k++) {
        const double cell = (box->high[k] - box->low[k]) / (double)(side - 1);
        made.low[k] = fmax(in->low[k], at[k] - 2 * cell);
        made.high[k] = fmin(in->high[k], at[k] + 2 * cell);
    }
    return made;
}

/* Finds the global minimum of the sum of squares. */
static void payne_best_fit(const payne_points *p, double *u, double *v)
{
    const payne_box all = search_box(p);
    payne_box box = all;
    double at[2] = {0, 0};
    size_t side = SIDE;
    for (int round = 0; round < REFINEMENTS; round++) {
        double least = HUGE_VAL;
        for (size_t i = 0; i < side; i++)
            for (size_t k = 0; k < side; k++) {
                const double x = cell_position(&box, 0, i, side),
                             y = cell_position(&box, 1, k, side);
                const double rss = payne_storage_levels(p, x, y).rss;
                if (rss < least) {
                    least = rss;
                    at[0] = x;
                    at[1] = y;
                }
            }
        box = box_around(&all, &box, at, side);
        side = FINE_SIDE;
    }
    *u = at[0];
    *v = at[1];
}

static bool is_within_region(const payne_points *p, const double at[2], double most)
{
    return payne_storage_levels(p, at[0], at[1]).rss <= most;
}

/* Returns a box that contains the best point and the one-parameter limits from it. */
static payne_box initial_box(const payne_points *p, const payne_box *all, const double best[2],
                             double most)
{
    payne_box box;
    for (int k = 0; k < 2; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double step = 1e-6, at[2] = {best[0], best[1]};
            double *const end = sign < 0 ? &box.low[k] : &box.high[k];
            do {
                at[k] = fmin(fmax(best[k] + sign * step, all->low[k]), all->high[k]);
                step *= 2;
            } while (is_within_region(p, at, most) && at[k] > all->low[k] && at[k] < all->high[k]);
            *end = at[k];
        }
    return box;
}

/* Returns the box that contains the allowed points plus one cell. It grows where they reach its
 * border. */
static payne_box allowed_box(const payne_points *p, const payne_box *all, const payne_box *box,
                             double most, bool *grown)
{
    payne_box made = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (size_t i = 0; i < CELLS; i++) {
        const double at[2] = {cell_position(box, 0, i / SIDE, SIDE),
                              cell_position(box, 1, i % SIDE, SIDE)};
        for (int k = 0; k < 2 && is_within_region(p, at, most); k++) {
            made.low[k] = fmin(made.low[k], at[k]);
            made.high[k] = fmax(made.high[k], at[k]);
        }
    }
    *grown = false;
    if (made.low[0] > made.high[0])
        return *box;
    for (int k = 0; k < 2; k++) {
        const double width = box->high[k] - box->low[k], cell = width / (SIDE - 1);
        const bool low = made.low[k] <= box->low[k], high = made.high[k] >= box->high[k];
        *grown =
            *grown || (low && box->low[k] > all->low[k]) || (high && box->high[k] < all->high[k]);
        made.low[k] = fmax(all->low[k], made.low[k] - (low ? 0.5 * width : cell));
        made.high[k] = fmin(all->high[k], made.high[k] + (high ? 0.5 * width : cell));
    }
    return made;
}

/* ---- intervals ------------------------------------------------------------------------------- */

/* Extremes of a parameter so far. open: an extreme lies at the border of the plane. */
typedef struct extent {
    double low, high;
    bool low_open, high_open;
} extent;

static void extend_extent(extent *e, double low, double high, bool border)
{
    if (low < e->low) {
        e->low = low;
        e->low_open = border;
    }
    if (high > e->high) {
        e->high = high;
        e->high_open = border;
    }
}

enum { STRAIN, EXPONENT, STORAGE_0, STORAGE_INF, LOSS_M, LOSS_INF, N_PARAMETERS };

/* Includes one cell: the ranges of the moduli at its strain and exponent. left: remaining square
 * of t. */
static void include_cell(const payne_points *p, const double at[2], double left, double scatter,
                         double loss_scatter, bool border, extent e[N_PARAMETERS])
{
    const payne_levels s = payne_storage_levels(p, at[0], at[1]),
                       l = payne_loss_levels(p, at[0], at[1]);
    const double t = sqrt(left), value[] = {s.b, s.a, l.b, l.a},
                 error[] = {s.b_error * scatter, s.a_error * scatter, l.b_error * loss_scatter,
                            l.a_error * loss_scatter};
    extend_extent(&e[STRAIN], at[0], at[0], border);
    extend_extent(&e[EXPONENT], at[1], at[1], border);
    for (size_t i = 0; i < COUNT_OF(value); i++)
        extend_extent(&e[STORAGE_0 + i], value[i] - t * error[i], value[i] + t * error[i], border);
}

/* Finds the parameter ranges in which the sum of squares exceeds the minimum by at most t^2
 * times the variance. */
static void find_extents(const payne_points *p, const wt_kraus *law, double t,
                         extent e[N_PARAMETERS])
{
    const double best[2] = {log(law->strain_c), log(law->exponent)};
    const double freedom = (double)(p->n - 4);
    const double least = payne_storage_levels(p, best[0], best[1]).rss, square = least / freedom;
    const payne_box all = search_box(p);
    payne_box box = initial_box(p, &all, best, least + t * t * square);
    bool grown = true;
    for (int round = 0; round < ROUNDS && grown; round++)
        box = allowed_box(p, &all, &box, least + t * t * square, &grown);
    /* At the best point of the storage moduli the loss moduli also deviate by its error. Their
     * variance is therefore the minimum over the allowed region. */
    double loss_least = payne_loss_levels(p, best[0], best[1]).rss;
    for (size_t i = 0; i < CELLS; i++) {
        const double at[2] = {cell_position(&box, 0, i / SIDE, SIDE),
                              cell_position(&box, 1, i % SIDE, SIDE)};
        if (is_within_region(p, at, least + t * t * square))
            loss_least = fmin(loss_least, payne_loss_levels(p, at[0], at[1]).rss);
    }
    const double loss_square = loss_least / freedom;
    for (int k = 0; k < N_PARAMETERS; k++)
        e[k] = (extent){HUGE_VAL, -HUGE_VAL, false, false};
    include_cell(p, best, t * t, sqrt(square), sqrt(loss_square), false, e);
    for (size_t i = 0; i < CELLS; i++) {
        const double at[2] = {cell_position(&box, 0, i / SIDE, SIDE),
                              cell_position(&box, 1, i % SIDE, SIDE)};
        const double left = t * t - (payne_storage_levels(p, at[0], at[1]).rss - least) / square;
        const bool border = at[0] <= all.low[0] || at[0] >= all.high[0] || at[1] <= all.low[1] ||
                            at[1] >= all.high[1];
        if (left >= 0)
            include_cell(p, at, left, sqrt(square), sqrt(loss_square), border, e);
    }
}

static wt_interval parameter_interval(double value, const extent *wide, const extent *narrow,
                                      bool logarithm)
{
    const bool open = narrow->low_open || narrow->high_open;
    const double low = logarithm ? exp(wide->low) : wide->low,
                 high = logarithm ? exp(wide->high) : wide->high,
                 error = 0.5 * (logarithm ? exp(narrow->high) - exp(narrow->low)
                                          : narrow->high - narrow->low);
    return (wt_interval){.value = value,
                         .standard_error = open ? (double)NAN : error,
                         .low = wide->low_open ? (double)NAN : low,
                         .high = wide->high_open ? (double)NAN : high};
}

/* Fills the intervals and standard errors of payne. The sum of squares exceeds its minimum by at
 * most t^2 (interval) or 1 (standard error) times the variance. */
static void payne_intervals(const payne_points *p, double t, wt_payne *payne)
{
    const wt_kraus *law = &payne->law;
    extent wide[N_PARAMETERS], narrow[N_PARAMETERS];
    find_extents(p, law, t, wide);
    find_extents(p, law, 1, narrow);
    const double value[N_PARAMETERS] = {law->strain_c,    law->exponent, law->storage_0,
                                        law->storage_inf, law->loss_m,   law->loss_inf};
    wt_interval *const of[N_PARAMETERS] = {&payne->strain_c,    &payne->exponent, &payne->storage_0,
                                           &payne->storage_inf, &payne->loss_m,   &payne->loss_inf};
    for (size_t k = 0; k < N_PARAMETERS; k++)
        *of[k] = parameter_interval(value[k], &wide[k], &narrow[k], k <= EXPONENT);
}

/* END points are averaged at each end. A fit of four constants needs seven points, so that three
 * degrees of freedom remain. A largest value among the outer two points is no maximum. */
enum { END = 3, FEWEST_FIT = 7, FROM_END = 2 };
/* Strain range of the points that are averaged at the start: half a decade. The law of Kraus
 * falls there by (start_ratio gamma / gamma_c)^(2 m), less for a smaller first amplitude. */
static const double start_ratio = 3;
/* Fractions of the initial modulus whose strains are reported: onset of softening and half. */
static const double tenth_lost = 0.9, half_lost = 0.5;
/* Quantile of the 95 % intervals, and the significance level of the fall. */
static const double confidence = 0.975, significance = 0.05;

double wt_kraus_storage(const wt_kraus *law, double strain)
{
    const double x = pow(strain / law->strain_c, law->exponent);
    return law->storage_inf + (law->storage_0 - law->storage_inf) / (1 + x * x);
}

double wt_kraus_loss(const wt_kraus *law, double strain)
{
    const double x = pow(strain / law->strain_c, law->exponent);
    return law->loss_inf + (law->loss_m - law->loss_inf) * 2 / (x + 1 / x);
}

/* ---- as measured ----------------------------------------------------------------------------- */

static double crossing_strain(const payne_points *p, double to)
{
    const double *x = p->log_strain, *y = p->storage;
    for (size_t i = 1; i < p->n; i++)
        if (y[i] < to && y[i - 1] >= to)
            return exp(x[i - 1] + (x[i] - x[i - 1]) * (y[i - 1] - to) / (y[i - 1] - y[i]));
    return (double)NAN;
}

static void measure_softening(const payne_points *p, wt_payne *payne)
{
    size_t first = 1, top = 0;
    while (first < END && first < p->n &&
           p->log_strain[first] - p->log_strain[0] <= log(start_ratio))
        first++;
    const size_t last = p->n < END ? p->n : END;
    payne->storage_start = numbers_mean(p->storage, first);
    payne->loss_start = numbers_mean(p->loss, first);
    payne->storage_end = numbers_mean(p->storage + p->n - last, last);
    payne->strain_tenth = crossing_strain(p, tenth_lost * payne->storage_start);
    payne->strain_half = crossing_strain(p, half_lost * payne->storage_start);
    for (size_t i = 1; i < p->n; i++)
        if (p->loss[i] > p->loss[top])
            top = i;
    payne->loss_max = p->loss[top];
    if (top >= FROM_END && top + FROM_END < p->n)
        payne->strain_loss_max = exp(p->log_strain[top]);
    else
        payne->loss_note = top < FROM_END
                               ? "largest at the smallest amplitudes: no maximum in range"
                               : "largest at the largest amplitudes: no maximum in range";
}

/* ---- the law --------------------------------------------------------------------------------- */

/* Returns the root mean square of the residuals. The flag is true if neighbouring residuals have
 * the same sign more often than independent noise. */
static double law_misfit(const payne_points *p, const double *y, const wt_kraus *law,
                         double (*law_function)(const wt_kraus *, double), bool *residuals_drift)
{
    double squares = 0, steps = 0, before = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double off = y[i] - law_function(law, exp(p->log_strain[i]));
        squares += off * off;
        steps += i > 0 ? (off - before) * (off - before) : 0;
        before = off;
    }
    *residuals_drift = steps < (2 - 4 / sqrt((double)p->n)) * squares;
    return sqrt(squares / (double)p->n);
}

/* Sets parameters outside the measured amplitudes to NaN. */
static void withhold_unmeasured(const payne_points *p, wt_payne *payne)
{
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    const double at = log(payne->law.strain_c);
    const char *reason = NULL;
    if (at > p->log_strain[p->n - 1])
        reason = "half of the fall is not reached in range";
    else if (at < p->log_strain[0])
        reason = "more than half of the fall lies below the smallest amplitude";
    if (reason == NULL)
        return;
    payne->note = reason;
    payne->strain_c = payne->loss_m = payne->loss_inf = unknown;
    *(at > p->log_strain[0] ? &payne->storage_inf : &payne->storage_0) = unknown;
}

static void fit_kraus_law(const payne_points *p, wt_payne *payne)
{
    double u, v;
    bool residuals_drift, loss_residuals_drift;
    payne_best_fit(p, &u, &v);
    const payne_levels s = payne_storage_levels(p, u, v), l = payne_loss_levels(p, u, v);
    const double freedom = (double)(p->n - 4), flat = payne_total_squares(p);
    if (!(s.rss > 0) ||
        gsl_cdf_fdist_Q((flat - s.rss) / 3 / (s.rss / freedom), 3, freedom) > significance) {
        payne->note = s.rss > 0 ? "the storage modulus does not fall by more than its scatter"
                                : "the points have no scatter";
        return;
    }
    payne->fitted = true;
    payne->law = (wt_kraus){s.b, s.a, exp(u), exp(v), l.b, l.a};
    payne->storage_misfit =
        law_misfit(p, p->storage, &payne->law, wt_kraus_storage, &residuals_drift) /
        payne->law.storage_0;
    payne->loss_misfit =
        law_misfit(p, p->loss, &payne->law, wt_kraus_loss, &loss_residuals_drift) / payne->loss_max;
    payne_intervals(p, gsl_cdf_tdist_Pinv(confidence, freedom), payne);
    if (residuals_drift)
        payne->note = "the residuals of the law of Kraus are not random: the intervals are too "
                      "narrow";
    if (loss_residuals_drift && payne->loss_note[0] == '\0')
        payne->loss_note = "the residuals of the law of Kraus are not random: the intervals "
                           "are too narrow";
    withhold_unmeasured(p, payne);
}

wt_status wt_payne_fit(const double *strain, const double *storage, const double *loss, size_t n,
                       wt_payne *payne, wt_error *err)
{
    const double nan = (double)NAN;
    const wt_interval unknown = {nan, nan, nan, nan};
    const bool storage_only = loss == NULL;
    loss = storage_only ? storage : loss; /* placeholder; its results are set to NaN below */
    if (strain == NULL || storage == NULL || payne == NULL || n == 0)
        return wt_fail(err, WT_E_ARG, "no strain sweep");
    for (size_t i = 0; i < n; i++)
        if (!(strain[i] > 0 && storage[i] > 0 && loss[i] > 0 && isfinite(strain[i]) &&
              isfinite(storage[i]) && isfinite(loss[i]) && (i == 0 || strain[i] >= strain[i - 1])))
            return wt_fail(err, WT_E_ARG, "strain sweep: not rising, or not above zero");
    double *log_strain = wt_alloc(n, sizeof *log_strain);
    for (size_t i = 0; i < n; i++)
        log_strain[i] = log(strain[i]);
    const payne_points p = {n, log_strain, storage, loss};
    *payne = (wt_payne){.strain_loss_max = nan,
                        .law = {nan, nan, nan, nan, nan, nan},
                        .storage_0 = unknown,
                        .storage_inf = unknown,
                        .strain_c = unknown,
                        .exponent = unknown,
                        .loss_m = unknown,
                        .loss_inf = unknown,
                        .storage_misfit = nan,
                        .loss_misfit = nan,
                        .note = "",
                        .loss_note = ""};
    measure_softening(&p, payne);
    if (n < FEWEST_FIT)
        payne->note = "too few points for the law of Kraus";
    else
        fit_kraus_law(&p, payne);
    if (storage_only) {
        payne->loss_start = payne->loss_max = payne->strain_loss_max = nan;
        payne->law.loss_m = payne->law.loss_inf = payne->loss_misfit = nan;
        payne->loss_m = payne->loss_inf = unknown;
        payne->loss_note = "no loss modulus was measured";
    }
    free(log_strain);
    return WT_OK;
}
