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
enum { FEWEST = 5 };
static const double least_ratio = 3, turn = 1.5, scatter = 1.1;
/* Maximum temperature drift [K], less than the range of a temperature sweep. */
static const double most_drift = 4;

static double strain_of(const sweep_builder *b, size_t row)
{
    return text_table_value(b->table, row, b->c.strain);
}

/* True if the row continues the sweep. An unknown temperature counts as equal. */
static bool goes_on(const sweep_builder *b, size_t first, size_t last, size_t row)
{
    const double drift = fabs(sweep_temperature(b, row) - sweep_temperature(b, first)),
                 jump = fabs(sweep_temperature(b, row) - sweep_temperature(b, last));
    return b->table->blocks[row] == b->table->blocks[first] && sweep_way(b, first, row) == 0 &&
           strain_of(b, row) > 0 && !(drift > most_drift) &&
           !(jump > b->file->description->temperature_jump);
}

/* Returns the end of the rows from `first` whose amplitude has one direction. */
static size_t end_of(const sweep_builder *b, const size_t *rows, size_t first, size_t n)
{
    size_t largest = first, smallest = first, i = first + 1;
    for (; i < n && goes_on(b, rows[first], rows[i - 1], rows[i]); i++) {
        const double strain = strain_of(b, rows[i]);
        const double top = strain_of(b, rows[largest]), bottom = strain_of(b, rows[smallest]);
        const bool went = top > scatter * bottom,
                   fell = went && largest > smallest && top > turn * strain,
                   rose = went && smallest > largest && strain > turn * bottom;
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
    if (n < FEWEST || !(strain_of(b, rows[0]) > 0))
        return false;
    const double ratio = strain_of(b, rows[n - 1]) / strain_of(b, rows[0]);
    return fmax(ratio, 1 / ratio) >= least_ratio;
}

/* Sets the temperature of a strain sweep. It may be unknown, unless the table has a temperature
 * column that cannot be read. */
static wt_status set_temperature(const sweep_builder *b, double *temperature)
{
    double spread;
    sweep_builder any = *b;
    wt_read_options options = *b->options;
    any.options = &options;
    options.any_temperature =
        options.any_temperature ||
        text_table_problem(b->table, WT_Q_BIT(WT_Q_TEMPERATURE), NULL) == WT_OK;
    return sweep_set_temperature(&any, temperature, &spread);
}

/* Adds a strain sweep. With `turns` adjacent rows have the same frequency and temperature, and the
 * source states the direction. */
static wt_status add_strain_sweep(sweep_builder *b, const size_t *rows, size_t n, bool turns)
{
    static const char *const way[] = {" (rising strain)", " (falling strain)"};
    wt_strain_sweep *s = wt_sweep_add_strain_sweep(b->sweep, n);
    if (s == NULL)
        return wt_fail(b->err, WT_E_MEMORY, "no memory for a strain sweep");
    double sum = 0;
    b->n = 0;
    for (size_t i = 0; i < n; i++) {
        s->strain[i] = strain_of(b, rows[i]);
        s->storage_modulus[i] = sweep_storage(b, rows[i]);
        s->loss_modulus[i] = sweep_loss(b, rows[i]);
        sum += sweep_angular(b, rows[i]);
        b->rows[b->n++] = rows[i];
    }
    s->angular_frequency = sum / (double)n;
    sweep_source(b, s->source, sizeof s->source - sizeof " (falling strain)");
    if (turns)
        strcat(s->source, way[s->strain[0] > s->strain[n - 1]]);
    const wt_status status = set_temperature(b, &s->temperature);
    b->n = 0;
    return status;
}

static bool same_place(const sweep_builder *b, const size_t *rows, size_t i, size_t k, size_t n)
{
    return i < n && k < n && goes_on(b, rows[i], rows[i], rows[k]);
}

wt_status strain_sweeps_take(sweep_builder *b, size_t *rows, size_t *n)
{
    size_t kept = 0;
    wt_status status = WT_OK;
    if (b->c.strain == NULL || !(b->c.has_storage || b->c.has_loss))
        return WT_OK;
    for (size_t first = 0, end; first < *n && status == WT_OK; first = end) {
        end = end_of(b, rows, first, *n);
        if (is_strain_sweep(b, rows + first, end - first)) {
            const bool turns = (first > 0 && same_place(b, rows, first - 1, first, *n)) ||
                               same_place(b, rows, end - 1, end, *n);
            status = add_strain_sweep(b, rows + first, end - first, turns);
            continue;
        }
        for (size_t i = first; i < end; i++)
            rows[kept++] = rows[i];
    }
    *n = kept;
    return status;
}
