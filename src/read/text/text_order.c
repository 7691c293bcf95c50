/* Orders the rows of a table whose isotherms do not stand together: rows in any order, or all
 * temperatures of one frequency after another.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_sweep.h"

#include "core/base/array.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Minimum number of rows, and minimum number of rows of an isotherm on average. */
enum { ROWS_MIN = 9, POINTS_MIN = 3 };
/* Minimum number of frequencies that make rows ordered by frequency isotherms, not temperature
 * sweeps; a sweep of temperature has few of them. */
enum { FREQUENCIES_MIN = 5 };
/* Maximum number of temperatures for each frequency, for the same distinction. */
static const double temperatures_most = 4;
/* Change of temperature that counts as a reversal [K], and the share of the rows that reverse. */
static const double turn = 1.5, share_turns = 0.25;
/* Maximum number of rows for each frequency of an isotherm, above which it was swept repeatedly. */
static const double repeats_most = 1.5;
/* Minimum ratio of the distance of two temperatures to the scatter within each of them. */
static const double least_separation = 4;
/* Scatter of a set temperature that is always allowed [K]. */
static const double least_scatter = 0.05;

/* A row with the indices of its temperature and its frequency. */
typedef struct ordered_row {
    size_t row, temperature, frequency;
    double kelvin, rate;
} ordered_row;

static int compare_kelvin(const void *a, const void *b)
{
    const ordered_row *const p = a, *const q = b;
    return (p->kelvin > q->kelvin) - (p->kelvin < q->kelvin);
}

static int compare_rate(const void *a, const void *b)
{
    const ordered_row *const p = a, *const q = b;
    return (p->rate > q->rate) - (p->rate < q->rate);
}

static int compare_index(size_t a, size_t b)
{
    return (a > b) - (a < b);
}

/* Isotherms: by temperature, then frequency, then position in the file. */
static int compare_isotherms(const void *a, const void *b)
{
    const ordered_row *const p = a, *const q = b;
    int order = compare_index(p->temperature, q->temperature);
    order = order != 0 ? order : compare_index(p->frequency, q->frequency);
    return order != 0 ? order : compare_index(p->row, q->row);
}

/* Temperature sweeps: by frequency, then temperature. */
static int compare_sweeps(const void *a, const void *b)
{
    const ordered_row *const p = a, *const q = b;
    int order = compare_index(p->frequency, q->frequency);
    order = order != 0 ? order : compare_kelvin(p, q);
    return order != 0 ? order : compare_index(p->row, q->row);
}

static int compare_falling(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p < q) - (p > q);
}

/* Numbers the frequencies and returns their number. */
static size_t number_frequencies(ordered_row *rows, size_t n)
{
    size_t index = 0;
    qsort(rows, n, sizeof *rows, compare_rate);
    for (size_t i = 1, first = 0; i < n; i++) {
        if (rows[i].rate > rows[first].rate * (1 + SAME_FREQUENCY)) {
            first = i;
            index++;
        }
        rows[i].frequency = index;
    }
    return index + 1;
}

/* Numbers the temperatures, which are separated by much more than they scatter. Returns their
 * number; 0 if there are no such groups. `gaps` has space for n numbers. */
static size_t number_temperatures(ordered_row *rows, size_t n, double *gaps)
{
    size_t best = 0, index = 0;
    double ratio = least_separation;
    qsort(rows, n, sizeof *rows, compare_kelvin);
    for (size_t i = 1; i < n; i++)
        gaps[i - 1] = rows[i].kelvin - rows[i - 1].kelvin;
    qsort(gaps, n - 1, sizeof *gaps, compare_falling);
    for (size_t k = 1; k + 1 < n && (k + 1) * POINTS_MIN <= n; k++) {
        const double here = gaps[k - 1] / fmax(gaps[k], least_scatter);
        if (here > ratio) {
            ratio = here;
            best = k;
        }
    }
    if (best == 0)
        return 0;
    const double limit = gaps[best - 1];
    for (size_t i = 1; i < n; i++) {
        index += rows[i].kelvin - rows[i - 1].kelvin >= limit;
        rows[i].temperature = index;
    }
    return index + 1;
}

/* True if the temperature jumps up and down from row to row. */
static bool is_shuffled(const sweep_builder *b, const size_t *rows, size_t n)
{
    size_t turns = 0;
    for (size_t i = 2; i < n; i++) {
        const double before = sweep_temperature(b, rows[i - 1]) - sweep_temperature(b, rows[i - 2]),
                     after = sweep_temperature(b, rows[i]) - sweep_temperature(b, rows[i - 1]);
        turns += before * after < 0 && fmin(fabs(before), fabs(after)) > turn;
    }
    return (double)turns > share_turns * (double)n;
}

/* True if the frequency goes up and down from row to row at one temperature. */
static bool is_shuffled_within(const sweep_builder *b, const size_t *rows, size_t n)
{
    size_t turns = 0;
    for (size_t i = 2; i < n; i++) {
        const double kelvin = sweep_temperature(b, rows[i - 1]);
        turns += sweep_direction(b, rows[i - 2], rows[i - 1]) *
                         sweep_direction(b, rows[i - 1], rows[i]) <
                     0 &&
                 fabs(sweep_temperature(b, rows[i - 2]) - kelvin) < turn &&
                 fabs(sweep_temperature(b, rows[i]) - kelvin) < turn;
    }
    return (double)turns > share_turns * (double)n;
}

/* True if the rows are runs of one frequency, each over several temperatures, and the temperatures
 * make isotherms. */
static bool is_by_frequency(const sweep_builder *b, const size_t *rows, size_t n,
                            size_t n_frequencies, size_t n_temperatures)
{
    size_t runs = 1;
    for (size_t i = 1; i < n; i++)
        runs += sweep_direction(b, rows[i - 1], rows[i]) != 0;
    return n_frequencies >= FREQUENCIES_MIN && runs == n_frequencies && n_temperatures > 1 &&
           n >= POINTS_MIN * runs;
}

/* Orders the rows, and joins the blocks that they were in. */
static void apply_order(const sweep_builder *b, const ordered_row *ordered, size_t *rows, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        rows[i] = ordered[i].row;
        b->table->blocks[rows[i]] = b->table->blocks[ordered[0].row];
    }
}

static void order_rows(const sweep_builder *b, size_t *rows, size_t n, ordered_row *ordered,
                       double *gaps)
{
    for (size_t i = 0; i < n; i++)
        ordered[i] = (ordered_row){.row = rows[i],
                                   .kelvin = sweep_temperature(b, rows[i]),
                                   .rate = sweep_angular_frequency(b, rows[i])};
    const size_t n_frequencies = number_frequencies(ordered, n);
    const size_t n_temperatures = number_temperatures(ordered, n, gaps);
    const bool isotherms = n_temperatures > 0 && n_frequencies >= POINTS_MIN &&
                           (double)n_temperatures <= temperatures_most * (double)n_frequencies;
    const bool once = (double)n <= repeats_most * (double)(n_temperatures * n_frequencies);
    if (!is_shuffled(b, rows, n) && !(isotherms && once && is_shuffled_within(b, rows, n)) &&
        !(isotherms && is_by_frequency(b, rows, n, n_frequencies, n_temperatures)))
        return;
    qsort(ordered, n, sizeof *ordered, isotherms ? compare_isotherms : compare_sweeps);
    apply_order(b, ordered, rows, n);
    wt_log_add(b->log, WT_NOTE, b->file->name, format_line_position(b->table->names_line).text,
               "the rows of one %s do not stand together: they are collected by their values",
               isotherms ? "temperature" : "frequency");
}

void collect_scattered_rows(sweep_builder *b, size_t *rows, size_t n)
{
    if (b->c.temperature == NULL || b->c.step != NULL || n < ROWS_MIN)
        return;
    for (size_t i = 0; i < n; i++)
        if (isnan(sweep_temperature(b, rows[i])))
            return;
    ordered_row *const ordered = wt_alloc(n, sizeof *ordered);
    double *const gaps = wt_alloc(n, sizeof *gaps);
    order_rows(b, rows, n, ordered, gaps);
    free(ordered);
    free(gaps);
}

/* A row with its sample and the steps of temperature, frequency and strain in which it lies. */
typedef struct grid_row {
    int temperature, frequency, strain;
    size_t sample;
} grid_row;

static int compare_grid_rows(const void *a, const void *b)
{
    const grid_row *const p = a, *const q = b;
    int order = (p->temperature > q->temperature) - (p->temperature < q->temperature);
    order = order != 0 ? order : (p->frequency > q->frequency) - (p->frequency < q->frequency);
    order = order != 0 ? order : (p->strain > q->strain) - (p->strain < q->strain);
    return order != 0 ? order : compare_index(p->sample, q->sample);
}

static bool is_same_place(const grid_row *a, const grid_row *b)
{
    return a->temperature == b->temperature && a->frequency == b->frequency &&
           a->strain == b->strain;
}

/* Returns the row of a table; sample NO_SAMPLE without a frequency or a sample. */
static grid_row find_grid_row(const sweep_builder *b, size_t row)
{
    static const double kelvin = 2, ratio = 1.05; /* size of the steps */
    const double temperature = sweep_temperature(b, row), rate = sweep_angular_frequency(b, row),
                 strain = b->c.strain != NULL ? text_table_value(b->table, row, b->c.strain)
                                              : (double)NAN;
    grid_row found = {.sample = NO_SAMPLE};
    if (!(rate > 0) || !isfinite(rate))
        return found;
    found.temperature = isfinite(temperature) ? (int)lround(temperature / kelvin) : 0;
    found.frequency = (int)lround(log(rate) / log(ratio));
    found.strain = strain > 0 && isfinite(strain) ? (int)lround(log(strain) / M_LN2) : 0;
    found.sample = b->table->samples[row];
    return found;
}

bool samples_repeat_grid(const sweep_builder *b)
{
    const text_table *const t = b->table;
    grid_row *const rows = wt_alloc(t->n_rows, sizeof *rows);
    size_t n = 0, n_repeated = 0, n_frequencies = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        rows[n] = find_grid_row(b, row);
        n += rows[n].sample != NO_SAMPLE;
    }
    if (n > 0)
        qsort(rows, n, sizeof *rows, compare_grid_rows);
    for (size_t first = 0, end; first < n; first = end) {
        for (end = first + 1; end < n && is_same_place(&rows[first], &rows[end]);)
            end++;
        n_repeated += rows[first].sample != rows[end - 1].sample ? end - first : 0;
        n_frequencies += first == 0 || rows[first].temperature == rows[0].temperature;
    }
    free(rows);
    /* heating and cooling repeat temperatures as well, at few frequencies */
    return 2 * n_repeated > n && n_frequencies >= FREQUENCIES_MIN;
}
