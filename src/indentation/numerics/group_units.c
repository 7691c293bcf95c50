/* Units of two groups of moduli at one rate.
 *
 * A cell is the set of curves of one spot at one rate. The value of a unit is the mean of its
 * cells, each shifted to the middle rate x0 by the slope beta of ln E against ln rate: m = mean(y
 * - beta (x - x0)). If both groups have the same rates, beta cancels. Otherwise its variance adds
 * in proportion to the square of the remaining difference in x. beta is the slope within the spots
 * if they have several rates, because the scatter of the spots does not affect it; otherwise it is
 * the slope between them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/group_statistics.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

/* Largest difference of rates of one class [ln]. It is half a decade, because steps of the rate are
 * one or half a decade and a soft group indents slightly faster. A modulus that rises by 6 % per
 * e-fold of rate, as rubber on its plateau, changes by 3 to 4 % from the middle to a limit. Without
 * a slope this difference remains. */
static const double same_rate = 0.5 * M_LN10;

/* Curves of one spot at one rate. */
typedef struct cell {
    int group; /* 0 = bulk, 1 = track */
    size_t unit;
    long rate;   /* class */
    double x, y; /* mean ln rate of the group in this class, mean ln E */
    size_t curves;
} cell;

typedef struct cells {
    cell *cell;
    size_t n;
    size_t units[2];
} cells;

typedef struct rate_curve {
    long spot, rate;
    double x, y;
} rate_curve;

static int compare_curves(const void *a, const void *b)
{
    const rate_curve *p = a, *q = b;
    if (p->spot != q->spot)
        return p->spot < q->spot ? -1 : 1;
    if (p->rate != q->rate)
        return p->rate < q->rate ? -1 : 1;
    if (p->y < q->y || p->y > q->y)
        return p->y < q->y ? -1 : 1;
    return (p->x > q->x) - (p->x < q->x);
}

/* Adds the cells in an order that does not depend on that of the curves, so that sums are
 * reproducible. */
static void add_cells(const wt_group *group, int g, bool by_spot, rate_curve *curves, cells *to)
{
    for (size_t i = 0; i < group->n; i++)
        curves[i] = (rate_curve){.spot = by_spot ? group->spot[i] : 0,
                                 .rate = group->rate != NULL ? group->rate_class[i] : 0,
                                 .x = group->rate != NULL ? log(group->rate[i]) : 0,
                                 .y = log(group->modulus[i])};
    qsort(curves, group->n, sizeof *curves, compare_curves);
    for (size_t i = 0; i < group->n;) {
        const rate_curve first = curves[i];
        to->units[g] += !by_spot || i == 0 || curves[i - 1].spot != first.spot ? 1 : 0;
        cell *c = &to->cell[to->n++];
        *c = (cell){.group = g, .unit = to->units[g] - 1, .rate = first.rate};
        do {
            c->x += curves[i].x;
            c->y += curves[i].y;
            c->curves++;
            i++;
        } while (by_spot && i < group->n && curves[i].spot == first.spot &&
                 curves[i].rate == first.rate);
        c->x /= (double)c->curves;
        c->y /= (double)c->curves;
    }
}

/* Sums over the cells of a class, by group: curves and ln rate. */
typedef struct rate {
    double curves[2], x[2];
} rate;

static size_t count_rates(const cells *all)
{
    long last = 0;
    for (size_t i = 0; i < all->n; i++)
        last = all->cell[i].rate > last ? all->cell[i].rate : last;
    return (size_t)last + 1;
}

/* Assigns one rate to each class, and only keeps common rates if there are any. The rates of the
 * curves scatter with their moduli, and the softer group indents slightly faster, which is not the
 * slope. */
static void equalise_rates(cells *all, rate *rates, bool *apart)
{
    const size_t n_rates = count_rates(all);
    for (size_t i = 0; i < all->n; i++) {
        const cell *c = &all->cell[i];
        rate *r = &rates[c->rate];
        r->curves[c->group] += (double)c->curves;
        r->x[c->group] += (double)c->curves * c->x;
    }
    *apart = true;
    for (size_t i = 0; i < n_rates; i++)
        *apart = *apart && !(rates[i].curves[0] > 0 && rates[i].curves[1] > 0);
    size_t n_kept = 0;
    for (size_t i = 0; i < all->n; i++) {
        cell c = all->cell[i];
        const rate *r = &rates[c.rate];
        if (!*apart && !(r->curves[1 - c.group] > 0))
            continue;
        c.x = (r->x[0] + r->x[1]) / (r->curves[0] + r->curves[1]);
        all->cell[n_kept++] = c;
    }
    all->n = n_kept;
}

/* ---- sums over the cells --------------------------------------------------------------------- */

/* Sums of one unit. Its cells are adjacent. */
typedef struct spot {
    int group;
    size_t cells, curves;
    double x, y; /* means */
    double xx, xy, yy;
} spot;

static size_t sum_spots(const cells *all, spot *spots)
{
    size_t n = 0;
    for (size_t i = 0, end; i < all->n; i = end) {
        const cell *first = &all->cell[i];
        spot s = {.group = first->group};
        for (end = i; end < all->n && all->cell[end].group == first->group &&
                      all->cell[end].unit == first->unit;
             end++) {
            s.cells++;
            s.curves += all->cell[end].curves;
            s.x += all->cell[end].x;
            s.y += all->cell[end].y;
        }
        s.x /= (double)s.cells;
        s.y /= (double)s.cells;
        for (size_t k = i; k < end; k++) {
            const double dx = all->cell[k].x - s.x, dy = all->cell[k].y - s.y;
            s.xx += dx * dx;
            s.xy += dx * dy;
            s.yy += dy * dy;
        }
        spots[n++] = s;
    }
    return n;
}

/* Fits the slope within the spots and tests if it is equal in both groups. */
static void fit_within_spot_slope(const spot *spots, size_t n, compare_units *u)
{
    double xx[2] = {0}, xy[2] = {0}, yy = 0, cells_used = 0;
    for (size_t i = 0; i < n; i++) {
        const spot *s = &spots[i];
        xx[s->group] += s->xx;
        xy[s->group] += s->xy;
        yy += s->yy;
        cells_used += (double)s->cells;
    }
    const double df = cells_used - (double)n - 1, all = xx[0] + xx[1];
    if (!(df >= 1) || !(all > 0))
        return;
    u->slope = (xy[0] + xy[1]) / all;
    u->slope_df = df;
    u->slope_error = sqrt(fmax(0, yy - u->slope * u->slope * all) / df / all);
    if (!(df >= 2) || !(xx[0] > 0) || !(xx[1] > 0))
        return;
    const double bulk = xy[0] / xx[0], track = xy[1] / xx[1];
    const double rest = fmax(0, yy - bulk * xy[0] - track * xy[1]) / (df - 1);
    const double t = fabs(track - bulk) / sqrt(rest * (1 / xx[0] + 1 / xx[1]));
    u->interaction_p = 2 * gsl_cdf_tdist_Q(t, df - 1);
}

/* Computes the means of x over the units of each group, and returns the sum of squares within the
 * groups. */
static double mean_rates(const spot *spots, size_t n, double x[2], double *xy)
{
    double y[2] = {0}, count[2] = {0}, xx = 0;
    x[0] = x[1] = *xy = 0;
    for (size_t i = 0; i < n; i++) {
        count[spots[i].group] += 1;
        x[spots[i].group] += spots[i].x;
        y[spots[i].group] += spots[i].y;
    }
    for (int g = 0; g < 2; g++) {
        x[g] /= count[g];
        y[g] /= count[g];
    }
    for (size_t i = 0; i < n; i++) {
        const double dx = spots[i].x - x[spots[i].group];
        xx += dx * dx;
        *xy += dx * (spots[i].y - y[spots[i].group]);
    }
    return xx;
}

/* Fits the means of the spots by group and ln rate, if each spot has one rate. */
static bool fit_between_spot_slope(const spot *spots, size_t n, double xx, double xy, double *slope,
                                   compare_units *u)
{
    const double df = (double)n - 3;
    if (!(df >= 1) || !(xx > same_rate * same_rate / 4))
        return false;
    *slope = xy / xx;
    double y[2] = {0}, count[2] = {0}, rest = 0, x[2] = {0};
    for (size_t i = 0; i < n; i++) {
        count[spots[i].group] += 1;
        y[spots[i].group] += spots[i].y - *slope * spots[i].x;
        x[spots[i].group] += spots[i].x;
    }
    for (size_t i = 0; i < n; i++) {
        const int g = spots[i].group;
        const double r = spots[i].y - *slope * spots[i].x - y[g] / count[g];
        rest += r * r / df;
    }
    const double dx = x[1] / count[1] - x[0] / count[0];
    u->between_error = sqrt(rest * (1 / count[0] + 1 / count[1] + dx * dx / xx));
    u->between_df = df;
    return true;
}

static void set_unit_values(const spot *spots, size_t n, compare_units *u)
{
    double x[2], xy, slope = 0;
    const double xx = mean_rates(spots, n, x, &xy), dx = x[1] - x[0];
    u->rate_matching = WT_RATES_COMMON;
    u->known = true;
    if (!isnan(u->slope)) {
        slope = u->slope;
        u->shift_variance = dx * dx * u->slope_error * u->slope_error;
        u->rate_matching = u->apart ? WT_RATES_WITHIN : WT_RATES_COMMON;
    } else if (u->apart || xx > same_rate * same_rate / 4) {
        u->rate_matching = WT_RATES_BETWEEN;
        u->known = fit_between_spot_slope(spots, n, xx, xy, &slope, u);
    }
    const double middle = (x[0] + x[1]) / 2;
    for (size_t i = 0; i < n; i++) {
        const int g = spots[i].group;
        u->value[g][u->n[g]++] = spots[i].y - slope * (spots[i].x - middle);
        u->curves[g] += spots[i].curves;
    }
}

void compare_units_create(const wt_group *const groups[2], bool by_spot, arena *memory,
                          compare_units *units)
{
    const size_t all = groups[0]->n + groups[1]->n;
    cells c = {.cell = arena_alloc(memory, all, sizeof *c.cell)};
    rate_curve *curves = arena_alloc(memory, all, sizeof *curves);
    spot *spots = arena_alloc(memory, all, sizeof *spots);
    compare_units u = {.slope = (double)NAN,
                       .slope_error = (double)NAN,
                       .slope_df = (double)NAN,
                       .interaction_p = (double)NAN};
    for (int g = 0; g < 2; g++)
        u.value[g] = arena_numbers(memory, groups[g]->n);
    for (int g = 0; g < 2; g++)
        add_cells(groups[g], g, by_spot, curves, &c);
    rate *rates = arena_alloc(memory, count_rates(&c), sizeof *rates);
    equalise_rates(&c, rates, &u.apart);
    const size_t n = sum_spots(&c, spots);
    fit_within_spot_slope(spots, n, &u);
    set_unit_values(spots, n, &u);
    *units = u;
}
