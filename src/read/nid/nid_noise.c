/* Reads the thermal tune of a .nid file: the noise spectrum of the cantilever and the results of
 * the instrument. Dim0 runs from its minimum over its range, with a point at both ends.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/samples.h"
#include "read/nid/nid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char info[] = "DataSet-Info";

/* Reads a value such as "179.8kHz", "27.13 N/m" or a plain number, with optional blanks, in the SI
 * unit of the quantity; NaN otherwise. */
static double read_info_value(const nid_header *header, const char *key, wt_quantity quantity)
{
    const char *text = nid_get(header, info, key);
    double value = (double)NAN;
    if (text == NULL || wt_quantity_parse(text, quantity, &value, NULL) == WT_OK)
        return value;
    size_t n = strlen(text);
    while (n > 0 && text[n - 1] == ' ')
        n--;
    return wt_number_parse(text, n, '.', &value) ? value : (double)NAN;
}

/* Reads the temperature, such as "40 °C" [K]; a plain number is in degrees Celsius. */
static double read_tune_temperature(const nid_header *header)
{
    static const char key[] = "Cantilever temperature";
    const char *text = nid_get(header, info, key);
    double kelvin = (double)NAN;
    if (text != NULL && wt_quantity_parse(text, WT_Q_TEMPERATURE, &kelvin, NULL) == WT_OK)
        return kelvin;
    return read_info_value(header, key, WT_Q_NONE) + WT_ZERO_CELSIUS;
}

static bool is_tune_channel(const nid_channel *c)
{
    double factor;
    return strcmp(c->group_name, "Spectrum FFT") == 0 && c->lines == 1 && c->points > 1 &&
           strcmp(nid_si_unit(c->unit, &factor), wt_quantity_unit(WT_Q_SPECTRAL_DENSITY)) == 0;
}

const nid_channel *nid_find_tune(const nid_file *file)
{
    for (size_t i = 0; i < file->n; i++)
        if (is_tune_channel(&file->channels[i]))
            return &file->channels[i];
    return NULL;
}

/* Fills the spectrum; the caller frees its memory also after a failure. */
static wt_status fill_tune_spectrum(const nid_file *file, const nid_channel *c, wt_log *log,
                                    wt_noise_spectrum *spectrum, wt_error *err)
{
    const nid_header *const h = &file->header;
    const double range = nid_number(h, c->section, "Dim0Range"),
                 first = nid_number(h, c->section, "Dim0Min");
    const char *unit = nid_get(h, c->section, "Dim0Unit");
    if (!(range > 0) || !(first >= 0) || !isfinite(first + range * (double)c->points) ||
        unit == NULL || strcmp(unit, "Hz") != 0) {
        wt_fail(err, WT_E_CORRUPT, "the frequencies of the spectrum are not known");
        wt_error_place(err, "[%s]", c->section);
        wt_error_expected(err, "Dim0Range above 0, Dim0Min and Dim0Unit=Hz");
        return WT_E_CORRUPT;
    }
    wt_noise_spectrum made = {.n = c->points, .amplitudes = true};
    made.frequency = malloc(c->points * sizeof *made.frequency);
    made.density = malloc(c->points * sizeof *made.density);
    *spectrum = made;
    if (made.frequency == NULL || made.density == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the spectrum");
    const wt_status status = nid_decode(file, c, 0, c->points, 1, made.density, err);
    for (size_t i = 0; status == WT_OK && i < c->points; i++) {
        made.frequency[i] = first + range * (double)i / (double)(c->points - 1);
        made.density[i] *= made.density[i];
    }
    if (status == WT_OK && samples_mark_missing(made.density, made.n) > 0)
        wt_log_add(log, WT_WARNING, file->name, c->section,
                   "densities that are no finite numbers are missing");
    spectrum->averages = read_info_value(h, "Averages", WT_Q_NONE);
    spectrum->temperature = read_tune_temperature(h);
    spectrum->spring_constant = read_info_value(h, "Spring Constant:", WT_Q_SPRING_CONSTANT);
    spectrum->resonance = read_info_value(h, "Frequency:", WT_Q_FREQUENCY);
    spectrum->quality = read_info_value(h, "Q Factor:", WT_Q_NONE);
    spectrum->sensitivity = (double)NAN;
    return status;
}

wt_status nid_read_noise(const file_reader *self, wt_input *input, const wt_read_options *options,
                         wt_log *log, wt_noise_spectrum *spectrum, wt_error *err)
{
    (void)self;
    (void)options;
    nid_file file = {0};
    wt_status status = nid_file_open(input, &file, err);
    const nid_channel *const c = status == WT_OK ? nid_find_tune(&file) : NULL;
    if (c != NULL) {
        status = fill_tune_spectrum(&file, c, log, spectrum, err);
    } else if (status == WT_OK) {
        status = wt_fail(err, WT_E_EMPTY, "the file holds no thermal tune");
        wt_error_expected(err, "a group Spectrum FFT with an amplitude spectral density in "
                               "m/sqrt(Hz)");
    }
    nid_file_close(&file);
    return status;
}
