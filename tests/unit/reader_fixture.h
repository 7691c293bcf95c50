/* A file of a writer and its reading, for the tests of the readers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_READER_FIXTURE_H
#define TESTS_READER_FIXTURE_H

#include "assert_near.h"

#include "weartrack/read.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* One set serves all tests of a program, because its creation parses every description. */
static wt_formats *formats;
static char path[] = "/tmp/weartrack-made-XXXXXX";

static inline int set_up(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    return fd < 0 || close(fd) != 0 || wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK ? -1 : 0;
}

static inline int clean(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return unlink(path);
}

typedef struct reading {
    wt_input *input;
    wt_force_source *source;
    wt_log *log;
    wt_force_curve curve;
    wt_error err;
} reading;

static inline void open_input(reading *r, const char *name)
{
    *r = (reading){.log = wt_log_new()};
    assert_int_equal(wt_input_open(name, &r->input, &r->err), WT_OK);
}

static inline wt_status open_force(reading *r, const char *name, const wt_read_options *options)
{
    open_input(r, name);
    return wt_force_open(formats, r->input, options, r->log, &r->source, &r->err);
}

static inline wt_status read_images_of(const void *bytes, size_t length, const char *name,
                                       wt_log *log, wt_image **images, size_t *n, wt_error *err)
{
    wt_input *input = NULL;
    *images = NULL;
    *n = 0;
    assert_int_equal(wt_input_open_memory(bytes, length, name, &input, NULL), WT_OK);
    const wt_status status = wt_images_read(formats, input, NULL, log, images, n, err);
    wt_input_close(input);
    return status;
}

static inline void clear_images(wt_image *images, size_t n)
{
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
}

static inline void close_all(reading *r)
{
    wt_force_close(r->source);
    wt_input_close(r->input);
    wt_log_free(r->log);
    wt_force_curve_clear(&r->curve);
}

static inline bool has_logged(const reading *r, const char *words)
{
    for (size_t i = 0; i < wt_log_count(r->log); i++)
        if (strstr(wt_log_get(r->log, i).text, words) != NULL)
            return true;
    return false;
}

static inline void next_curve(reading *r)
{
    if (wt_force_next(r->source, &r->curve, &r->err) != WT_OK)
        fail_msg("%s; %s", r->err.message, r->err.found);
}

static inline const double *channel(const wt_segment *segment, wt_quantity quantity)
{
    const wt_channel *c = wt_segment_channel(segment, quantity);
    if (c == NULL)
        fail_msg("no %s", wt_quantity_id(quantity));
    return c != NULL ? c->values : NULL;
}

/* Tests that the file cannot be read and that message, expectation or value contain the words. */
static inline void assert_refused(wt_status expected, const char *words)
{
    reading r;
    char all[1000];
    wt_status status = open_force(&r, path, NULL);
    while (status == WT_OK)
        status = wt_force_next(r.source, &r.curve, &r.err);
    snprintf(all, sizeof all, "%s; %s; %s", r.err.message, r.err.expected, r.err.found);
    if (status != expected || strstr(all, words) == NULL)
        fail_msg("%d: %s", (int)status, all);
    close_all(&r);
}

static inline size_t read_bytes(unsigned char *bytes, size_t size)
{
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t n = fread(bytes, 1, size, in);
    (void)fclose(in);
    return n;
}

static inline wt_status open_bytes(const unsigned char *bytes, size_t n)
{
    reading r = {.log = wt_log_new()};
    assert_int_equal(wt_input_open_memory(bytes, n, "made", &r.input, NULL), WT_OK);
    wt_status status = wt_force_open(formats, r.input, NULL, r.log, &r.source, &r.err);
    while (status == WT_OK && wt_force_next(r.source, &r.curve, NULL) != WT_END)
        ;
    close_all(&r);
    return status;
}

#endif
