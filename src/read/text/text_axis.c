/* Finds axes of equal steps from positions that an export may have rounded.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_axis.h"

#include <math.h>

/* Tolerance relative to a step; it changes no slope or spectrum noticeably. */
static const double slight = 1e-3;
/* Maximum number of grid positions for each point. */
enum { PLACES_PER_POINT = 4 };

/* Maximum number of decimals of a position in its unit. With more decimals, rounding does not
 * matter. */
enum { DECIMALS_MAX = 9 };
/* Tolerance of a decimal after a conversion of units. */
static const double left_of_decimal = 1e-4;
/* Maximum rounding relative to a step. Above it, rounded positions give no evidence of equal
 * steps. */
static const double coarsest = 0.65;

/* Returns the value of the last written decimal; 0 if there are too many. */
static double quantum_of(const double *places, size_t n, double factor)
{
    double scale = 1;
    for (int k = 0; k <= DECIMALS_MAX; k++, scale *= 10) {
        size_t i = 0;
        while (i < n) {
            const double x = scale * places[i] / factor;
            if (!(fabs(x - round(x)) <= left_of_decimal))
                break;
            i++;
        }
        if (i == n)
            return factor / scale;
    }
    return 0;
}

/* Returns the largest distance of the positions from those of the axis. */
static double deviation_from(const text_axis *axis, const double *places, size_t n, size_t *worst)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const double at = (places[i] - axis->first) / axis->step;
        const double to = axis->n == n ? (double)i : round(at);
        const double deviation = fabs(at - to) * axis->step;
        if (deviation > most) {
            most = deviation;
            *worst = i;
        }
    }
    return most;
}

/* Finds an axis with gaps, whose step is close to the smallest difference. */
static bool axis_with_holes(const double *places, size_t n, text_axis *axis)
{
    const double length = places[n - 1] - places[0];
    double least = length;
    size_t worst = 0;
    for (size_t i = 1; i < n; i++)
        least = fmin(least, places[i] - places[i - 1]);
    const double steps = round(length / least);
    if (!(steps < (double)(PLACES_PER_POINT * n)))
        return false;
    *axis = (text_axis){places[0], length / steps, (size_t)steps + 1, 0};
    return axis->n > n && deviation_from(axis, places, n, &worst) <= slight * axis->step;
}

bool axis_find(const double *places, size_t n, double factor, bool holes, text_axis *axis,
               size_t *worst)
{
    *worst = 0;
    if (n < 2)
        return false;
    const text_axis equal = {places[0], (places[n - 1] - places[0]) / (double)(n - 1), n, 0};
    const double deviation = deviation_from(&equal, places, n, worst);
    *axis = equal;
    if (deviation <= slight * equal.step)
        return true;
    if (holes && axis_with_holes(places, n, axis))
        return true;
    const double quantum = quantum_of(places, n, fabs(factor));
    *axis = equal;
    axis->rounded = quantum;
    /* each end and the position itself are rounded by half of the quantum */
    return quantum > 0 && quantum <= coarsest * equal.step && deviation <= (1 + slight) * quantum;
}

size_t axis_index(const text_axis *axis, double place)
{
    return (size_t)fmax(0, round((place - axis->first) / axis->step));
}
