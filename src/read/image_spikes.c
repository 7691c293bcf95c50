/* Warns of isolated spikes in a height image. A damaged file has some, and they dominate every
 * slope statistic.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/images.h"

#include <math.h>

/* Minimum height of a spike above all its neighbours, in rms steps between points. Noise and edges
 * stay below it. */
static const double spike_steps = 4.0;
/* Minimum share of the spikes in the mean square step. Below it they do not dominate the slopes. */
static const double spike_fraction_min = 0.5;
/* Minimum number of points for a meaningful rms step. */
enum { MIN_POINTS = 64 };

typedef struct neighbour_range {
    double low, high;
    size_t n; /* number of valid neighbours */
} neighbour_range;

static void add_neighbour(neighbour_range *all, double height)
{
    if (isnan(height))
        return;
    all->low = fmin(all->low, height);
    all->high = fmax(all->high, height);
    all->n++;
}

static neighbour_range find_neighbours(const wt_image *image, size_t column, size_t row)
{
    const double *const at = image->values + row * image->n_columns + column;
    neighbour_range all = {HUGE_VAL, -HUGE_VAL, 0};
    if (column > 0)
        add_neighbour(&all, at[-1]);
    if (column + 1 < image->n_columns)
        add_neighbour(&all, at[1]);
    if (row > 0)
        add_neighbour(&all, *(at - image->n_columns));
    if (row + 1 < image->n_rows)
        add_neighbour(&all, at[image->n_columns]);
    return all;
}

/* Returns the distance of a height beyond the range of its neighbours. It is 0 within the range or
 * with less than two neighbours. */
static double height_excess(double height, const neighbour_range *all)
{
    return all->n < 2 || isnan(height) ? 0 : fmax(0, fmax(height - all->high, all->low - height));
}

/* Returns the sum of the squared steps between adjacent points, in units of `scale`, which prevents
 * overflow. *n is the number of steps. */
static double sum_squared_steps(const wt_image *image, double scale, size_t *n)
{
    double sum = 0;
    *n = 0;
    for (size_t row = 0; row < image->n_rows; row++)
        for (size_t column = 0; column < image->n_columns; column++) {
            const double *const at = image->values + row * image->n_columns + column;
            const double right = column + 1 < image->n_columns ? at[1] : (double)NAN;
            const double above = row + 1 < image->n_rows ? at[image->n_columns] : (double)NAN;
            const double steps[] = {right / scale - *at / scale, above / scale - *at / scale};
            for (size_t i = 0; i < 2; i++) {
                sum += isnan(steps[i]) ? 0 : steps[i] * steps[i];
                *n += isnan(steps[i]) ? 0 : 1;
            }
        }
    return sum;
}

static double largest_height(const wt_image *image)
{
    double largest = 0;
    for (size_t i = 0; i < image->n_columns * image->n_rows; i++)
        largest = fmax(largest, fabs(image->values[i])); /* fmax ignores a NaN */
    return largest;
}

void images_check_spikes(const wt_image *image, const char *file, wt_log *log)
{
    const size_t n = image->n_columns * image->n_rows;
    const double scale = largest_height(image);
    size_t n_steps = 0, n_spikes = 0, at = 0;
    double spike_sum = 0, largest = 0;
    if (n < MIN_POINTS || !(scale > 0))
        return;
    const double sum = sum_squared_steps(image, scale, &n_steps);
    const double least = spike_steps * scale * sqrt(sum / (double)n_steps);
    for (size_t i = 0; i < n; i++) {
        const neighbour_range all =
            find_neighbours(image, i % image->n_columns, i / image->n_columns);
        const double excess = height_excess(image->values[i], &all);
        if (!(excess > least))
            continue;
        n_spikes++;
        spike_sum += (double)all.n * (excess / scale) * (excess / scale);
        at = excess > largest ? i : at;
        largest = fmax(largest, excess);
    }
    if (n_spikes == 0 || !(spike_sum > spike_fraction_min * sum))
        return;
    char excess_text[32];
    wt_format_si(largest, "m", 3, excess_text, sizeof excess_text);
    wt_log_add(log, WT_WARNING, file, image->name,
               "%zu of %zu heights stand out alone, the farthest, in column %zu and row %zu from "
               "below, by %s, and make most of the slopes: spikes, or a damaged file; take them "
               "out before",
               n_spikes, n, at % image->n_columns, at / image->n_columns, excess_text);
}
