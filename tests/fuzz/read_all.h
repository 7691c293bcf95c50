/* Common functions of the fuzz targets of readers. They read all data of a file and check every
 * number.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_FUZZ_READ_ALL_H
#define TESTS_FUZZ_READ_ALL_H

#include "core/table/registry.h"
#include "read/force_assembler.h"
#include "read/formats.h"

#include <math.h>
#include <stdlib.h>

/* A sample is finite or missing (NaN), never infinite. */
static inline void never_infinite(const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (isinf(values[i]))
            abort();
}

static inline void look_at(const wt_force_curve *curve)
{
    for (size_t s = 0; s < curve->n_segments; s++) {
        const wt_segment *segment = &curve->segments[s];
        for (size_t c = 0; c < segment->n_channels; c++)
            never_infinite(segment->channels[c].values, segment->n_points);
    }
}

static inline void read_curves(const file_reader *reader, const uint8_t *data, size_t size,
                               const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_log *log = wt_log_new();
    wt_error err = WT_ERROR_INIT;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (force_open(reader->force, reader, input, options, log, &source, &err) == WT_OK) {
        /* Every call advances, also after a curve with an error. */
        for (size_t i = 0; wt_force_next(source, &curve, &err) != WT_END; i++) {
            if (i > wt_force_count(source))
                abort();
            look_at(&curve);
        }
    }
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    wt_log_free(log);
    wt_input_close(input);
}

static inline void describe(const file_reader *reader, const uint8_t *data, size_t size,
                            const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_table *table = NULL;
    table_writer facts = table_begin(&facts_schema, NULL);
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    (void)reader->describe(reader, input, options, NULL, &facts);
    if (table_end(&facts, &table) != WT_OK)
        abort();
    wt_table_free(table);
    wt_input_close(input);
}

static inline void detect(const file_reader *reader, const uint8_t *data, size_t size)
{
    wt_input *input = NULL;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    file_peek peek = {.bytes = data, .length = size, .whole = true, .name = "fuzz", .input = input};
    const recognition r = reader->detect(reader, &peek);
    wt_input_close(input);
    if (r.answer == ANSWER_YES && (r.score < 1 || r.score > 100))
        abort();
}

static inline void read_images(const file_reader *reader, const uint8_t *data, size_t size,
                               const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (reader->read_images(reader, input, options, NULL, &images, &n, NULL) == WT_OK)
        for (size_t i = 0; i < n; i++) {
            const double sides[] = {images[i].width, images[i].height, images[i].x_min,
                                    images[i].y_min};
            never_infinite(images[i].values, images[i].n_columns * images[i].n_rows);
            never_infinite(sides, sizeof sides / sizeof *sides);
            wt_image_clear(&images[i]);
        }
    free(images);
    wt_input_close(input);
}

/* Reads twice: with the calibration of the file, and with all values that a user may state. */
static inline void read_all(const file_reader *reader, const uint8_t *data, size_t size)
{
    wt_read_options options = wt_read_defaults();
    detect(reader, data, size);
    for (int given = 0; given < 2; given++) {
        if (reader->read_images != NULL)
            read_images(reader, data, size, &options);
        if (reader->force != NULL)
            read_curves(reader, data, size, &options);
        options.want = WT_Q_BIT(WT_Q_FORCE);
        options.spring_constant = 0.3;
        options.sensitivity = 1e-7;
    }
    describe(reader, data, size, &options);
}

#endif
