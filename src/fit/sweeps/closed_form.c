/* The closed form of ISO 18437-6 (Gergesova, Zupancic, Saprunov and Emri, J. Rheol. 55 (2011) 1):
 * the area between two neighbouring isotherms of the storage modulus, over the height they share.
 * No vertical shift, no error. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/closed_form.h"

#include <math.h>

/* Ordinates that neighbours share at least [decade], and points of each that lie there: the area
 * between two curves needs a stretch of each, and one that is less than some times the noise of a
 * modulus (1 % is 0.004 decade) tells no shift.
 * Chosen; these shifts are told beside those of the fit, which they do not move. */
static const double least_height = 0.05;
enum { LEAST_POINTS = 2 };

/* The integral of x over the ordinates from low to high along the running maximum of a curve, and
 * how many points lie there. */
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

/* Where curve s goes on curve p; NaN if they share too little. */
static double step_to(const shift_curve *p, const shift_curve *s)
{
    if (p->n < LEAST_POINTS || s->n < LEAST_POINTS)
        return (double)NAN;
    const double low = fmax(p->y[STORAGE][0], s->y[STORAGE][0]),
                 high = fmin(highest_ordinate(p), highest_ordinate(s));
    size_t points[2];
    const double between = area_along_ordinates(p, low, high, &points[0]) -
                           area_along_ordinates(s, low, high, &points[1]);
    const bool enough =
        high - low > least_height && points[0] >= LEAST_POINTS && points[1] >= LEAST_POINTS;
    return enough ? between / (high - low) : (double)NAN;
}

void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a)
{
    for (size_t i = 0; !set->used[STORAGE] && i < set->n; i++)
        log_a[i] = (double)NAN;
    if (!set->used[STORAGE])
        return;
    log_a[anchor] = 0.0;
    for (size_t i = anchor + 1; i < set->n; i++)
        log_a[i] = log_a[i - 1] + step_to(&set->curves[i - 1], &set->curves[i]);
    for (size_t i = anchor; i-- > 0;)
        log_a[i] = log_a[i + 1] + step_to(&set->curves[i + 1], &set->curves[i]);
}
