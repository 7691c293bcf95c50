/* Closed-form shifts of ISO 18437-6 (Gergesova, Zupancic, Saprunov and Emri, J. Rheol. 55 (2011)
 * 1). The shift is the area between two neighbouring isotherms of E' divided by their shared
 * height. There is no vertical shift and no error.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/closed_form.h"

#include <math.h>

/* Minimum shared height [decade], or this share of the height of the flatter curve, because a
 * glass has no more. 1 % of noise is 0.004 decade. The values are chosen; the overlap chain,
 * which starts from these shifts, has separate errors. */
static const double least_height = 0.05, least_share = 0.25;
/* Minimum number of points of each curve in the shared range. Two isotherms towards the anchor
 * are tried, so that one bad isotherm leaves a gap only. */
enum { LEAST_POINTS = 2, NEIGHBOURS = 2 };

/* Integrates x over the ordinates from low to high along the running maximum of a curve. *n:
 * number of points in that range. */
static double area_along_ordinates(const shift_curve *c, double low, double high, size_t *n)
{
    double sum = 0.0, before = c->y[STORAGE][0];
    *n = before >= low && before <= high;
    for (size_t k = 1; k < c->n; k++) {
        const double y = c->y[STORAGE][k], from = fmax(before, low), to = fmin(y, high);
        *n += y >= low && y <= high;
        if (!(y > before))
            continue;
        if (to > from) {
            const double slope = (c->x[k] - c->x[k - 1]) / (y - before);
            sum += (to - from) * (c->x[k - 1] + slope * (0.5 * (from + to) - before));
        }
        before = y;
    }
    return sum;
}

static double highest_ordinate(const shift_curve *c)
{
    double most = -HUGE_VAL;
    for (size_t k = 0; k < c->n; k++)
        most = fmax(most, c->y[STORAGE][k]);
    return most;
}

double closed_form_step(const shift_set *set, size_t onto, size_t from, double b)
{
    const shift_curve *p = &set->curves[onto], *s = &set->curves[from];
    if (!set->used[STORAGE] || p->n < LEAST_POINTS || s->n < LEAST_POINTS)
        return (double)NAN;
    const double first[2] = {p->y[STORAGE][0], s->y[STORAGE][0] + b},
                 last[2] = {highest_ordinate(p), highest_ordinate(s) + b};
    const double low = fmax(first[0], first[1]), high = fmin(last[0], last[1]);
    const double flatter = fmin(last[0] - first[0], last[1] - first[1]);
    size_t points[2];
    const double between = area_along_ordinates(p, low, high, &points[0]) -
                           area_along_ordinates(s, low - b, high - b, &points[1]);
    const bool enough = high > low && high - low >= fmin(least_height, least_share * flatter) &&
                        points[0] >= LEAST_POINTS && points[1] >= LEAST_POINTS;
    return enough ? between / (high - low) : (double)NAN;
}

void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a)
{
    for (size_t i = 0; i < set->n; i++)
        log_a[i] = (double)NAN;
    if (!set->used[STORAGE])
        return;
    log_a[anchor] = 0.0;
    for (size_t i = anchor + 1; i < set->n; i++)
        for (size_t k = 1; isnan(log_a[i]) && k <= NEIGHBOURS && anchor + k <= i; k++)
            log_a[i] = log_a[i - k] + closed_form_step(set, i - k, i, 0.0);
    for (size_t i = anchor; i-- > 0;)
        for (size_t k = 1; isnan(log_a[i]) && k <= NEIGHBOURS && i + k <= anchor; k++)
            log_a[i] = log_a[i + k] + closed_form_step(set, i + k, i, 0.0);
}
