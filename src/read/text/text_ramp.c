/* Extracts temperature sweeps from the rows of a table: rows of one frequency with a changing
 * temperature, or cycles of frequencies during a temperature ramp.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_sweep.h"

#include <math.h>
#include <string.h>

/* Minimum number of points and temperature range [K] of a temperature sweep. A reversal by more
 * than `turn` [K] ends it. */
enum { POINTS_MIN = 5 };
static const double least_span = 5, turn = 2;
/* Minimum share of the temperature change that occurs within a cycle of frequencies. It is near 0
 * for isotherms and above one half in a ramp. */
static const double least_drift = 0.25;

/* Adds a temperature sweep. With `turns` there was heating and cooling, and the source states the
 * direction. */
static void add_temperature_sweep(sweep_builder *b, const size_t *rows, size_t n, bool turns)
{
    static const char *const way[] = {" (heated)", " (cooled)"};
    wt_ramp *ramp = wt_sweep_add_ramp(b->sweep, n, sweep_optional_arrays(&b->c));
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        ramp->temperature[i] = sweep_temperature(b, rows[i]);
        ramp->storage_modulus[i] = sweep_storage_modulus(b, rows[i]);
        ramp->loss_modulus[i] = sweep_loss_modulus(b, rows[i]);
        if (ramp->strain != NULL)
            ramp->strain[i] = text_table_value(b->table, rows[i], b->c.strain);
        if (ramp->loss_factor != NULL)
            ramp->loss_factor[i] = sweep_loss_factor(b, rows[i]);
        sum += sweep_angular_frequency(b, rows[i]);
    }
    ramp->angular_frequency = sum / (double)n;
    sweep_format_source(b, ramp->source, sizeof ramp->source - sizeof " (heated)");
    if (turns)
        strcat(ramp->source, way[ramp->temperature[0] > ramp->temperature[n - 1]]);
}

/* Returns the first row after which the temperature reverses, or n. */
static size_t find_turning_point(const sweep_builder *b, const size_t *rows, size_t first, size_t n)
{
    size_t warmest = first, coldest = first;
    for (size_t i = first + 1; i < n; i++) {
        const double t = sweep_temperature(b, rows[i]);
        const bool fell = sweep_temperature(b, rows[warmest]) - t > turn && warmest > coldest,
                   rose = t - sweep_temperature(b, rows[coldest]) > turn && coldest > warmest;
        if (fell || rose)
            return (fell ? warmest : coldest) + 1;
        if (t >= sweep_temperature(b, rows[warmest]))
            warmest = i;
        if (t <= sweep_temperature(b, rows[coldest]))
            coldest = i;
    }
    return n;
}

static bool is_temperature_sweep(const sweep_builder *b, const size_t *rows, size_t n)
{
    return n >= POINTS_MIN &&
           fabs(sweep_temperature(b, rows[n - 1]) - sweep_temperature(b, rows[0])) >= least_span;
}

/* Adds the sweeps of rows of one frequency, split where the temperature reverses. True if there was
 * a sweep. */
static bool add_temperature_sweeps(sweep_builder *b, const size_t *all, size_t n_all)
{
    size_t *const rows = b->rows; /* `all` may be the same array */
    size_t used = 0, n = 0;
    for (size_t i = 0; i < n_all; i++)
        if (sweep_temperature(b, all[i]) > 0)
            rows[n++] = all[i];
    for (size_t first = 0, end; first < n; first = end) {
        end = find_turning_point(b, rows, first, n);
        if (!is_temperature_sweep(b, rows + first, end - first))
            continue;
        add_temperature_sweep(b, rows + first, end - first, first > 0 || end < n);
        used += end - first;
    }
    if (used > 0 && n < n_all)
        wt_log_action(b->log, WT_WARNING, WT_LEFT_OUT, n_all - n, "--columns", b->file->name,
                      format_line_position(b->table->names_line).text,
                      "%zu points at %g rad/s without a temperature above absolute zero left out",
                      n_all - n, sweep_angular_frequency(b, rows[0]));
    if (used > 0 && used < n)
        wt_log_add(b->log, WT_NOTE, b->file->name, format_line_position(b->table->names_line).text,
                   "%zu points beside the temperature sweeps at %g rad/s left out", n - used,
                   sweep_angular_frequency(b, rows[0]));
    return used > 0;
}

/* Extracts the sweeps of consecutive rows with the same frequency. */
static void extract_runs(sweep_builder *b, size_t *rows, size_t *n)
{
    size_t kept = 0;
    for (size_t first = 0, end; first < *n; first = end) {
        bool is_sweep = false;
        for (end = first + 1; end < *n && sweep_direction(b, rows[first], rows[end]) == 0;)
            end++;
        if (end - first >= POINTS_MIN)
            is_sweep = add_temperature_sweeps(b, rows + first, end - first);
        for (size_t i = first; i < end && !is_sweep; i++)
            rows[kept++] = rows[i];
    }
    *n = kept;
}

/* Returns the temperature difference of two rows [K]; 0 if it is unknown. */
static double temperature_step(const sweep_builder *b, size_t row, size_t other)
{
    const double kelvin = fabs(sweep_temperature(b, row) - sweep_temperature(b, other));
    return isnan(kelvin) ? 0 : kelvin;
}

/* True if the temperature keeps changing during the cycles of frequencies. */
static bool temperature_drifts(const sweep_builder *b, const size_t *rows, size_t n)
{
    double within = 0, between = 0;
    size_t first = 0, turns = 1;
    int direction = 0;
    for (size_t i = 1; i < n; i++) {
        const int way = sweep_direction(b, rows[i - 1], rows[i]);
        if (way * direction >= 0) {
            direction = way != 0 ? way : direction;
            continue;
        }
        within += temperature_step(b, rows[i - 1], rows[first]);
        between += temperature_step(b, rows[i], rows[first]);
        first = i;
        direction = 0;
        turns++;
    }
    return turns >= POINTS_MIN && between >= least_span && within > least_drift * between;
}

/* Extracts the sweeps of cycled frequencies, one for each frequency. `chosen` has space for n
 * rows. */
static void extract_interleaved(sweep_builder *b, size_t *rows, size_t *n, size_t *chosen)
{
    if (!temperature_drifts(b, rows, *n))
        return;
    while (*n > 0) {
        const size_t like = rows[0];
        size_t kept = 0, n_chosen = 0;
        for (size_t i = 0; i < *n; i++) {
            if (sweep_direction(b, like, rows[i]) == 0)
                chosen[n_chosen++] = rows[i];
            else
                rows[kept++] = rows[i];
        }
        *n = kept;
        if (!add_temperature_sweeps(b, chosen, n_chosen))
            wt_log_add(b->log, WT_WARNING, b->file->name,
                       format_line_position(b->table->names_line).text,
                       "%zu points at %g rad/s make no temperature sweep and are left out",
                       n_chosen, sweep_angular_frequency(b, like));
    }
}

void extract_ramps(sweep_builder *b, size_t *rows, size_t *n)
{
    if (b->c.temperature == NULL)
        return;
    extract_runs(b, rows, n);
    extract_interleaved(b, rows, n, b->rows);
}
