/* What the fuzz targets of the readers have in common: everything that can be read is read, and
 * every number that comes out is looked at.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_FUZZ_READ_ALL_H
#define TESTS_FUZZ_READ_ALL_H

#include "read/formats.h"

#include <math.h>
#include <stdlib.h>

/* Never infinite: a sample is a number or missing. */
static inline void look_at(const wt_force_curve *curve)
{
    for (size_t s = 0; s < curve->n_segments; s++) {
        const wt_segment *segment = &curve->segments[s];
        for (size_t c = 0; c < segment->n_channels; c++)
            for (size_t i = 0; i < segment->n_points; i++)
                if (isinf(segment->channels[c].values[i]))
                    abort();
    }
}

static inline void read_curves(const file_reader *reader, const uint8_t *data, size_t size,
                               const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_parselog *log = wt_parselog_new();
    wt_error err = WT_ERROR_INIT;
    if (wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (reader->open_force(reader, input, options, log, &source, &err) == WT_OK) {
        /* Every call moves on, also after a curve that cannot be read. */
        for (size_t i = 0; wt_force_next(source, &curve, &err) != WT_END; i++) {
            if (i > wt_force_count(source))
                abort();
            look_at(&curve);
        }
    }
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    wt_parselog_free(log);
    wt_input_close(input);
}

static inline void describe(const file_reader *reader, const uint8_t *data, size_t size,
                            const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_table *facts = wt_table_new("facts", "facts");
    static const char *const names[] = {"item", "value", "unit", "source"};
    if (facts == NULL || wt_input_open_memory(data, size, "fuzz", &input, NULL) != WT_OK)
        abort();
    for (size_t i = 0; i < 4; i++)
        if (wt_table_add_text_column(facts, names[i], "", NULL) != WT_OK)
            abort();
    wt_status status = reader->describe(reader, input, options, NULL, facts, NULL);
    wt_table_free(facts);
    wt_input_close(input);
    (void)status;
}

static inline void detect(const file_reader *reader, const uint8_t *data, size_t size)
{
    file_peek peek = {data, size, true, "fuzz"};
    detector_match match = reader->detect(reader, &peek);
    if (match.answer == ANSWER_YES && (match.score < 1 || match.score > 100))
        abort();
}

#endif
