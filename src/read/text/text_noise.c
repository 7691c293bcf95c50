/* Converts a table of a text export to the noise spectrum of a cantilever.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct noise_point {
    double frequency, density;
} noise_point;

/* The possible densities of a table; the first that exists is used. */
static const struct {
    wt_quantity quantity;
    bool volts, amplitude;
} densities[] = {{WT_Q_DEFLECTION_NOISE, false, false},
                 {WT_Q_SPECTRAL_DENSITY, false, true},
                 {WT_Q_VOLTAGE_NOISE, true, false},
                 {WT_Q_VOLTAGE_DENSITY, true, true}};

/* Collects the points; rows without a valid frequency are skipped with a warning. */
static wt_status collect_noise_points(const text_file *file, wt_log *log, noise_point *points,
                                      wt_noise_spectrum *spectrum, wt_error *err)
{
    const text_table *const t = &file->tables[0];
    size_t n_skipped = 0, first_line = 0;
    wt_status status = text_table_require(t, WT_KIND_NOISE, err);
    if (status != WT_OK)
        return status;
    const text_column *frequency = text_table_column(t, WT_Q_FREQUENCY, -1), *density = NULL;
    size_t d = 0;
    while ((density = text_table_column(t, densities[d].quantity, -1)) == NULL)
        d++;
    spectrum->volts = densities[d].volts;
    spectrum->amplitudes = densities[d].amplitude;
    for (size_t r = 0; r < t->n_rows; r++) {
        noise_point p = {text_table_value(t, r, frequency), text_table_value(t, r, density)};
        if (p.density < 0) {
            wt_fail(err, WT_E_CORRUPT, "a density below 0");
            wt_error_place(err, "line %zu", t->row_lines[r]);
            wt_error_expected(err, "densities of 0 and more, which are no logarithms");
            wt_error_found(err, "%g", p.density);
            return WT_E_CORRUPT;
        }
        if (spectrum->amplitudes)
            p.density *= p.density;
        if (p.frequency >= 0 && isfinite(p.frequency) && !isinf(p.density)) {
            points[spectrum->n++] = p;
            continue;
        }
        first_line = n_skipped++ == 0 ? t->row_lines[r] : first_line;
    }
    if (n_skipped > 0)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(first_line).text,
                   "%zu row%s without a frequency of 0 or more left out, this the first", n_skipped,
                   n_skipped == 1 ? "" : "s");
    spectrum->temperature = t->header.value[HEADER_TEMPERATURE];
    spectrum->spring_constant = t->header.value[HEADER_SPRING_CONSTANT];
    spectrum->sensitivity = t->header.value[HEADER_SENSITIVITY];
    spectrum->averages = spectrum->resonance = spectrum->quality = (double)NAN;
    return WT_OK;
}

static wt_status fill_sorted_spectrum(noise_point *points, wt_noise_spectrum *spectrum,
                                      wt_error *err)
{
    const size_t n = spectrum->n;
    qsort(points, n, sizeof *points, numbers_compare);
    spectrum->frequency = malloc(n * sizeof *spectrum->frequency);
    spectrum->density = malloc(n * sizeof *spectrum->density);
    if (spectrum->frequency == NULL || spectrum->density == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the spectrum");
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && !(points[i].frequency > points[i - 1].frequency)) {
            const wt_status status = wt_fail(err, WT_E_CORRUPT, "a frequency stands twice");
            wt_error_expected(err, "one density for each frequency");
            wt_error_found(err, "two for %g Hz", points[i].frequency);
            return status;
        }
        spectrum->frequency[i] = points[i].frequency;
        spectrum->density[i] = points[i].density;
    }
    return WT_OK;
}

wt_status text_read_noise(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_noise_spectrum *spectrum, wt_error *err)
{
    text_file file;
    wt_status status = text_scan(self, input, WT_KIND_NOISE, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    if (file.n_tables > 1) {
        status = wt_fail(err, WT_E_AMBIGUOUS, "several spectra in one file");
        wt_error_advice(err, "part the file");
    }
    noise_point *points =
        file.n_tables == 1 ? malloc((file.tables[0].n_rows + 1) * sizeof *points) : NULL;
    if (status == WT_OK && file.n_tables == 1 && points == NULL)
        status = wt_fail(err, WT_E_MEMORY, "no memory for the spectrum");
    if (status == WT_OK && points != NULL)
        status = collect_noise_points(&file, log, points, spectrum, err);
    if (status == WT_OK && spectrum->n < 2)
        status = text_fail_empty(&file, "spectrum of thermal noise", err);
    if (status == WT_OK)
        status = fill_sorted_spectrum(points, spectrum, err);
    free(points);
    text_file_free(&file);
    return status;
}
