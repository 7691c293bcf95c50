/* Fuzz target of one text description, READER_ID: detection, force curves, sweep, spectrum and
 * metadata of any bytes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"
#include "read_all.h"

/* Every sample has a friction value, and the time does not decrease within the record. */
static void read_record(const file_reader *reader, wt_input *input, const wt_read_options *options)
{
    wt_record record = {.n = 0};
    wt_error err = WT_ERROR_INIT;
    const bool read = reader->read_record(reader, input, options, NULL, &record, &err) == WT_OK;
    const double *const mu = record.channel[WT_RECORD_COEFFICIENT],
                        *const force = record.channel[WT_RECORD_FRICTION_FORCE],
                        *const time = record.channel[WT_RECORD_TIME];
    for (size_t i = 0; read && i < record.n; i++) {
        if (!(mu != NULL && isfinite(mu[i])) && !(force != NULL && isfinite(force[i])))
            abort();
        if (i > 0 &&
            ((time != NULL && time[i] < time[i - 1]) || record.step[i] < record.step[i - 1]))
            abort();
    }
    if (read && record.n == 0)
        abort();
    wt_record_clear(&record);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define TEXT_OF(id) #id
#define TEXT(id) TEXT_OF(id)

static const char *const units[] = {"f=Hz", "E'=MPa", "E''=MPa"};

static void all_finite(const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(values[i]))
            abort();
}

/* The values are numbers at all points or NaN at all points. Returns true for numbers. */
static bool finite_or_none(const double *values, size_t n)
{
    const bool none = values == NULL || n == 0 || isnan(values[0]);
    for (size_t i = 0; i < n && values != NULL; i++)
        if (none ? !isnan(values[i]) : !isfinite(values[i]))
            abort();
    return !none;
}

static void read_as(const file_reader *reader, wt_input *input, const wt_read_options *options)
{
    wt_error err = WT_ERROR_INIT;
    if (reader->read_sweep != NULL) {
        wt_sweep sweep = {.n_isotherms = 0};
        (void)reader->read_sweep(reader, input, options, NULL, &sweep, &err);
        for (size_t i = 0; i < sweep.n_isotherms; i++) {
            const wt_isotherm *s = &sweep.isotherms[i];
            all_finite(&s->temperature, 1);
            all_finite(s->angular_frequency, s->n);
            const bool storage = finite_or_none(s->storage_modulus, s->n),
                       loss = finite_or_none(s->loss_modulus, s->n),
                       factor = finite_or_none(s->loss_factor, s->n);
            if (!storage && !loss && !factor)
                abort();
        }
        wt_sweep_clear(&sweep);
    }
    if (reader->read_spectrum != NULL) {
        wt_power_spectrum spectrum = {.n = 0};
        (void)reader->read_spectrum(reader, input, options, NULL, &spectrum, &err);
        all_finite(spectrum.wavenumber, spectrum.n);
        all_finite(spectrum.density, spectrum.n);
        for (size_t i = 1; i < spectrum.n; i++)
            if (!(spectrum.wavenumber[i] > spectrum.wavenumber[i - 1]))
                abort();
        wt_power_spectrum_clear(&spectrum);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static wt_formats *formats;
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_read_options options = wt_read_defaults();
    if (formats == NULL && wt_formats_new(NULL, &formats, NULL, &err) != WT_OK)
        abort();
    if (wt_input_open_memory(data, size, "fuzz", &input, &err) != WT_OK)
        return 0;
    /* Even inputs state the values that the file lacks, so that more of the file is read. */
    if (size % 2 == 0) {
        options.units = units;
        options.n_units = sizeof units / sizeof *units;
        options.temperature = 300;
        options.sensitivity = 5e-8;
        options.spring_constant = 0.1;
    }
    const file_reader *reader = formats_find_reader(formats, TEXT(READER_ID));
    if (reader == NULL)
        abort();
    file_peek peek = {.bytes = data, .length = size, .whole = size % 3 > 0, .name = "fuzz"};
    (void)reader->detect(reader, &peek);
    read_as(reader, input, &options);
    if (reader->read_record != NULL)
        read_record(reader, input, &options);
    if (reader->force != NULL)
        read_curves(reader, data, size, &options);
    describe(reader, data, size, &options);
    text_peek_free(peek.text);
    wt_input_close(input);
    return 0;
}
