/* Finds axes of equal steps from positions that an export may have rounded.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_axis.h"

#include <math.h>

/* Tolerance relative to a step; it changes no slope or spectrum noticeably. */
static const double step_tolerance = 1e-3;
/* Maximum number of grid positions for each point. */
enum { POSITIONS_PER_POINT = 4 };

/* Maximum number of decimals of a position in its unit. With more decimals, rounding does not
 * matter. */
enum { DECIMALS_MAX = 9 };
/* Tolerance of a decimal after a conversion of units. */
static const double decimal_tolerance = 1e-4;
/* Maximum rounding relative to a step. Above it, rounded positions give no evidence of equal
 * steps. */
static const double rounding_max = 0.65;

/* Returns the value of the last written decimal; 0 if there are too many. */
static double find_rounding_quantum(const double *positions, size_t n, double factor)
{
    double scale = 1;
    for (int k = 0; k <= DECIMALS_MAX; k++, scale *= 10) {
        size_t i = 0;
        while (i < n) {
            const double x = scale * positions[i] / factor;
            if (!(fabs(x - round(x)) <= decimal_tolerance))
                break;
            i++;
        }
        if (i == n)
            return factor / scale;
    }
    return 0;
}

/* Returns the largest distance of the positions from those of the axis. */
static double largest_deviation(const text_axis *axis, const double *positions, size_t n,
                                size_t *worst)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const double at = (positions[i] - axis->first) / axis->step;
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
static bool find_axis_with_gaps(const double *positions, size_t n, text_axis *axis)
{
    const double length = positions[n - 1] - positions[0];
    double least = length;
    size_t worst = 0;
    for (size_t i = 1; i < n; i++)
        least = fmin(least, positions[i] - positions[i - 1]);
    const double steps = round(length / least);
    if (!(steps < (double)(POSITIONS_PER_POINT * n)))
        return false;
    *axis = (text_axis){positions[0], length / steps, (size_t)steps + 1, 0};
    return axis->n > n &&
           largest_deviation(axis, positions, n, &worst) <= step_tolerance * axis->step;
}

bool axis_find(const double *positions, size_t n, double factor, bool allows_gaps, text_axis *axis,
               size_t *worst)
{
    *worst = 0;
    if (n < 2)
        return false;
    const text_axis equal = {positions[0], (positions[n - 1] - positions[0]) / (double)(n - 1), n,
                             0};
    const double deviation = largest_deviation(&equal, positions, n, worst);
    *axis = equal;
    if (deviation <= step_tolerance * equal.step)
        return true;
    if (allows_gaps && find_axis_with_gaps(positions, n, axis))
        return true;
    const double quantum = find_rounding_quantum(positions, n, fabs(factor));
    *axis = equal;
    axis->rounded = quantum;
    /* each end and the position itself are rounded by half of the quantum */
    return quantum > 0 && quantum <= rounding_max * equal.step &&
           deviation <= (1 + step_tolerance) * quantum;
}

size_t axis_index(const text_axis *axis, double position)
{
    return (size_t)fmax(0, round((position - axis->first) / axis->step));
}
