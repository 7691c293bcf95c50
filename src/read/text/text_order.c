/* Separates the rows of temperature and strain sweeps, and orders the rows of isotherms that do not
 * stand together: rows in any order, or all temperatures of one frequency after another.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_sweep.h"

#include "core/base/array.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- temperature sweeps ---------------------------------------------------------------------- */

/* Minimum number of points and temperature range [K] of a temperature sweep. A reversal by more
 * than `ramp_turn` [K] ends it. */
enum { RAMP_POINTS_MIN = 5 };
static const double least_span = 5, ramp_turn = 2;
/* Minimum share of the temperature change that occurs within a cycle of frequencies. It is near 0
 * for isotherms and above one half in a ramp. */
static const double least_drift = 0.25;
/* Cycles of fewer frequencies in the mean are no isotherms, whose shifts need four points, but
 * steps of a temperature sweep. Single points may be missing. */
static const double isotherm_points_min = 3.5;

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
        const bool fell = sweep_temperature(b, rows[warmest]) - t > ramp_turn && warmest > coldest,
                   rose = t - sweep_temperature(b, rows[coldest]) > ramp_turn && coldest > warmest;
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
    return n >= RAMP_POINTS_MIN &&
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
        if (end - first >= RAMP_POINTS_MIN)
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

/* True if the cycles of frequencies are no isotherms: the temperature keeps changing during them,
 * or they have few frequencies. */
static bool cycles_are_sweeps(const sweep_builder *b, const size_t *rows, size_t n)
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
    const bool drifts = within > least_drift * between;
    return turns >= RAMP_POINTS_MIN && between >= least_span &&
           (drifts || (double)n < isotherm_points_min * (double)turns);
}

/* Extracts the sweeps of cycled frequencies, one for each frequency. `chosen` has space for n
 * rows. */
static void extract_interleaved(sweep_builder *b, size_t *rows, size_t *n, size_t *chosen)
{
    if (!cycles_are_sweeps(b, rows, *n))
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

/* ---- strain sweeps --------------------------------------------------------------------------- */

/* Minimum number of points of a strain sweep, and minimum ratio of its amplitudes. A sweep ends
 * where the amplitude reverses by more than the factor `strain_turn`. It must have moved before by
 * more than `scatter`, the scatter of the first points. */
enum { STRAIN_POINTS_MIN = 5 };
static const double least_ratio = 3, strain_turn = 1.5, scatter = 1.1;
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
                   fell = has_direction && largest > smallest && top > strain_turn * strain,
                   rose = has_direction && smallest > largest && strain > strain_turn * bottom;
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
    if (n < STRAIN_POINTS_MIN || !(row_strain(b, rows[0]) > 0))
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

/* ---- isotherms that do not stand together ---------------------------------------------------- */

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
