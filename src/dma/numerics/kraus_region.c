/* Confidence region of the law of Kraus. A grid over two parameters contracts around the allowed
 * region, so that no start value is needed and curved valleys are handled.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/kraus_region.h"

#include "core/base/array.h"

#include <math.h>

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

payne_levels payne_storage_levels(const payne_points *p, double u, double v)
{
    payne_levels l = fit_levels(p, p->storage, storage_shape, u, v);
    if (l.b < l.a) /* the modulus would rise with strain */
        l.rss = payne_total_squares(p);
    return l;
}

payne_levels payne_loss_levels(const payne_points *p, double u, double v)
{
    return fit_levels(p, p->loss, loss_shape, u, v);
}

double payne_total_squares(const payne_points *p)
{
    double mean = 0, rss = 0;
    for (size_t i = 0; i < p->n; i++)
        mean += p->storage[i] / (double)p->n;
    for (size_t i = 0; i < p->n; i++)
        rss += (p->storage[i] - mean) * (p->storage[i] - mean);
    return rss;
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

void payne_best_fit(const payne_points *p, double *u, double *v)
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

void payne_intervals(const payne_points *p, double t, wt_payne *payne)
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
