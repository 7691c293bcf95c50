/* All numbers of a file of any kind, for programs that damage files and compare the result.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_FORMATS_READ_NUMBERS_H
#define TESTS_FORMATS_READ_NUMBERS_H

#include "weartrack/read.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct numbers {
    double *values;
    size_t n, room;
    size_t n_failed; /* number of curves with an error */
} numbers;

/* A missing value is not counted. */
static inline void keep(numbers *all, const double *values, size_t n)
{
    for (size_t i = 0; values != NULL && i < n; i++) {
        if (isnan(values[i]))
            continue;
        if (all->n == all->room) {
            all->room = 2 * all->room + 1024;
            all->values = realloc(all->values, all->room * sizeof *all->values);
            if (all->values == NULL)
                abort();
        }
        all->values[all->n++] = values[i];
    }
}

static inline wt_status read_curves(const wt_formats *formats, wt_input *input, wt_log *log,
                                    numbers *all)
{
    const wt_read_options options = wt_read_defaults();
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_status status = wt_force_open(formats, input, &options, log, &source, NULL);
    for (wt_status next = status; status == WT_OK && next != WT_END;) {
        next = wt_force_next(source, &curve, NULL);
        all->n_failed += next != WT_OK && next != WT_END;
        for (size_t s = 0; next == WT_OK && s < curve.n_segments; s++)
            for (size_t c = 0; c < curve.segments[s].n_channels; c++)
                keep(all, curve.segments[s].channels[c].values, curve.segments[s].n_points);
    }
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    return status;
}

static inline wt_status read_sweep(const wt_formats *formats, wt_input *input, wt_log *log,
                                   numbers *all)
{
    wt_read_options options = wt_read_defaults();
    options.allow_missing_temperature = true;
    wt_sweep sweep = {.n_isotherms = 0};
    const wt_status status = wt_sweep_read(formats, input, &options, log, &sweep, NULL);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        const wt_isotherm *const t = &sweep.isotherms[i];
        keep(all, t->angular_frequency, t->n);
        keep(all, t->storage_modulus, t->n);
        keep(all, t->loss_modulus, t->n);
    }
    wt_sweep_clear(&sweep);
    return status;
}

static inline wt_status read_rest(const wt_formats *formats, wt_input *input, unsigned kind,
                                  wt_log *log, numbers *all)
{
    const wt_read_options options = wt_read_defaults();
    wt_power_spectrum spectrum = {.n = 0};
    wt_record record = {.n = 0};
    wt_image *images = NULL;
    size_t n_images = 0;
    wt_status status = WT_OK;
    if (kind == WT_KIND_RECORD)
        status = wt_record_read(formats, input, &options, log, &record, NULL);
    else if (kind == WT_KIND_IMAGE)
        status = wt_images_read(formats, input, &options, log, &images, &n_images, NULL);
    else
        status = wt_power_spectrum_read(formats, input, &options, log, &spectrum, NULL);
    keep(all, spectrum.wavenumber, spectrum.n);
    for (size_t i = 0; status == WT_OK && i < n_images; i++) {
        keep(all, images[i].values, images[i].n_columns * images[i].n_rows);
        wt_image_clear(&images[i]);
    }
    free(images);
    for (int c = 0; c < WT_RECORD_CHANNELS; c++)
        keep(all, record.channel[c], record.n);
    wt_record_clear(&record);
    wt_power_spectrum_clear(&spectrum);
    return status;
}

/* Reads the bytes as every kind that matches; WT_E_FORMAT if none does. */
static inline wt_status read_any(const wt_formats *formats, const void *bytes, size_t n,
                                 wt_log *log, numbers *all)
{
    static const unsigned kinds[] = {WT_KIND_FORCE, WT_KIND_SWEEP, WT_KIND_IMAGE, WT_KIND_SPECTRUM,
                                     WT_KIND_RECORD};
    wt_status status = WT_E_FORMAT;
    all->n = all->n_failed = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        wt_input *input = NULL;
        wt_status read = WT_OK;
        if (wt_input_open_memory(bytes, n, "file", &input, NULL) != WT_OK)
            abort();
        if (kinds[k] == WT_KIND_FORCE)
            read = read_curves(formats, input, log, all);
        else if (kinds[k] == WT_KIND_SWEEP)
            read = read_sweep(formats, input, log, all);
        else
            read = read_rest(formats, input, kinds[k], log, all);
        status = read == WT_OK ? WT_OK : status;
        wt_input_close(input);
    }
    return status;
}

/* Returns the bytes of a file with a zero at the end, or NULL. */
static inline unsigned char *load_bytes(const char *path, size_t *n)
{
    FILE *const in = fopen(path, "rb");
    if (in == NULL)
        return NULL;
    (void)fseek(in, 0, SEEK_END);
    *n = (size_t)ftell(in);
    rewind(in);
    unsigned char *const bytes = calloc(*n + 1, 1);
    if (bytes == NULL || fread(bytes, 1, *n, in) != *n)
        abort();
    (void)fclose(in);
    return bytes;
}

/* xorshift64* */
static inline size_t draw(uint64_t *state, size_t n)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (size_t)((*state * 2685821657736338717u) >> 11) % (n > 0 ? n : 1);
}

#endif
