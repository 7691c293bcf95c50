/* Extracts strain sweeps from the rows of a table: rows of one frequency and temperature with
 * increasing or decreasing amplitude.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_sweep.h"

#include <math.h>
#include <string.h>

/* Minimum number of points of a strain sweep, and minimum ratio of its amplitudes. A sweep ends
 * where the amplitude reverses by more than the factor `turn`. It must have moved before by more
 * than `scatter`, the scatter of the first points. */
enum { POINTS_MIN = 5 };
static const double least_ratio = 3, turn = 1.5, scatter = 1.1;
/* Maximum temperature drift [K], less than the range of a temperature sweep. */
static const double drift_max = 4;

static double row_strain(const sweep_builder *b, size_t row)
{
    return text_table_value(b->table, row, b->c.strain);
}

/* True if the row continues the sweep. An unknown temperature counts as equal. */
static bool is_same_sweep(const sweep_builder *b, size_t first, size_t last, size_t row)
{
    const double drift = fabs(sweep_temperature(b, row) - sweep_temperature(b, first)),
                 jump = fabs(sweep_temperature(b, row) - sweep_temperature(b, last));
    return b->table->blocks[row] == b->table->blocks[first] &&
           sweep_direction(b, first, row) == 0 && row_strain(b, row) > 0 && !(drift > drift_max) &&
           !(jump > b->file->description->temperature_jump);
}

/* Returns the end of the rows from `first` whose amplitude has one direction. */
static size_t find_sweep_end(const sweep_builder *b, const size_t *rows, size_t first, size_t n)
{
    size_t largest = first, smallest = first, i = first + 1;
    for (; i < n && is_same_sweep(b, rows[first], rows[i - 1], rows[i]); i++) {
        const double strain = row_strain(b, rows[i]);
        const double top = row_strain(b, rows[largest]), bottom = row_strain(b, rows[smallest]);
        const bool has_direction = top > scatter * bottom,
                   fell = has_direction && largest > smallest && top > turn * strain,
                   rose = has_direction && smallest > largest && strain > turn * bottom;
        if (fell || rose)
            return (fell ? largest : smallest) + 1;
        if (strain >= top)
            largest = i;
        if (strain <= bottom)
            smallest = i;
    }
    return i;
}

static bool is_strain_sweep(const sweep_builder *b, const size_t *rows, size_t n)
{
    if (n < POINTS_MIN || !(row_strain(b, rows[0]) > 0))
        return false;
    const double ratio = row_strain(b, rows[n - 1]) / row_strain(b, rows[0]);
    return fmax(ratio, 1 / ratio) >= least_ratio;
}

/* Sets the temperature of a strain sweep. It may be unknown, unless the table has a temperature
 * column that cannot be read. */
static wt_status set_sweep_temperature(const sweep_builder *b, double *temperature)
{
    double spread;
    sweep_builder any = *b;
    wt_read_options options = *b->options;
    any.options = &options;
    options.allow_missing_temperature =
        options.allow_missing_temperature ||
        text_table_problem(b->table, WT_Q_BIT(WT_Q_TEMPERATURE), NULL) == WT_OK;
    return sweep_set_temperature(&any, temperature, &spread);
}

/* Adds a strain sweep. With `turns` adjacent rows have the same frequency and temperature, and the
 * source states the direction. */
static wt_status add_strain_sweep(sweep_builder *b, const size_t *rows, size_t n, bool turns)
{
    static const char *const direction_suffix[] = {" (rising strain)", " (falling strain)"};
    wt_strain_sweep *s = wt_sweep_add_strain_sweep(b->sweep, n);
    double sum = 0;
    b->n = 0;
    for (size_t i = 0; i < n; i++) {
        s->strain[i] = row_strain(b, rows[i]);
        s->storage_modulus[i] = sweep_storage_modulus(b, rows[i]);
        s->loss_modulus[i] = sweep_loss_modulus(b, rows[i]);
        sum += sweep_angular_frequency(b, rows[i]);
        b->rows[b->n++] = rows[i];
    }
    s->angular_frequency = sum / (double)n;
    sweep_format_source(b, s->source, sizeof s->source - sizeof " (falling strain)");
    if (turns)
        strcat(s->source, direction_suffix[s->strain[0] > s->strain[n - 1]]);
    const wt_status status = set_sweep_temperature(b, &s->temperature);
    b->n = 0;
    return status;
}

static bool is_same_condition(const sweep_builder *b, const size_t *rows, size_t i, size_t k,
                              size_t n)
{
    return i < n && k < n && is_same_sweep(b, rows[i], rows[i], rows[k]);
}

wt_status extract_strain_sweeps(sweep_builder *b, size_t *rows, size_t *n)
{
    size_t kept = 0;
    wt_status status = WT_OK;
    if (b->c.strain == NULL || !(b->c.has_storage || b->c.has_loss))
        return WT_OK;
    for (size_t first = 0, end; first < *n && status == WT_OK; first = end) {
        end = find_sweep_end(b, rows, first, *n);
        if (is_strain_sweep(b, rows + first, end - first)) {
            const bool turns = (first > 0 && is_same_condition(b, rows, first - 1, first, *n)) ||
                               is_same_condition(b, rows, end - 1, end, *n);
            status = add_strain_sweep(b, rows + first, end - first, turns);
            continue;
        }
        for (size_t i = first; i < end; i++)
            rows[kept++] = rows[i];
    }
    *n = kept;
    return status;
}
