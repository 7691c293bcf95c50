/* Reading a case file and what a case gives to others.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/case/case.h"
#include "flow/case_schema.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A case is written by hand; anything larger is something else. */
#define MAX_CASE_BYTES ((size_t)4 << 20)

const char *wt_case_schema(void)
{
    return case_schema[0].text;
}

void *case_alloc(wt_case *c, size_t size)
{
    if (c->n_blocks == c->blocks_capacity) {
        size_t grown = c->blocks_capacity == 0 ? 64 : c->blocks_capacity * 2;
        void **blocks = realloc(c->blocks, grown * sizeof *blocks);
        if (blocks == NULL)
            return NULL;
        c->blocks = blocks;
        c->blocks_capacity = grown;
    }
    void *block = calloc(1, size > 0 ? size : 1);
    if (block != NULL)
        c->blocks[c->n_blocks++] = block;
    return block;
}

char *case_text(wt_case *c, const char *text, size_t length)
{
    char *copy = case_alloc(c, length + 1);
    if (copy != NULL)
        memcpy(copy, text, length);
    return copy;
}

void wt_case_free(wt_case *c)
{
    if (c == NULL)
        return;
    for (size_t i = 0; i < c->n_blocks; i++)
        free(c->blocks[i]);
    free(c->blocks);
    free(c);
}

static void set_defaults(wt_case *c)
{
    c->title = "";
    c->indent = wt_indent_defaults();
    c->indentation_temperature = (double)NAN;
    c->bulk.spring_constant = c->track.spring_constant = (wt_estimate){(double)NAN, 0, 0, "N/m"};
    c->shift = wt_shift_defaults();
    c->shift.reference_temperature = (double)NAN;
    c->prony_options = wt_prony_defaults();
    c->poisson_ratio = 0.5;
    c->spectrum_q0 = c->spectrum_q1 = (double)NAN;
    c->sliding = wt_sliding_defaults();
    c->layer = wt_layer_job_defaults();
    c->layer_velocity = (double)NAN;
    c->modulus_ratio = (wt_estimate){(double)NAN, 0, 0, "1"};
}

wt_status case_from_bytes(const void *bytes, size_t length, const char *path, wt_case **out,
                          wt_error *err)
{
    if (length == 0 || length > MAX_CASE_BYTES) {
        wt_fail(err, WT_E_SCHEMA, "this is no case file");
        wt_error_expected(err, "XML of 1 byte to 4 MiB");
        wt_error_found(err, "%zu bytes", length);
        wt_error_file(err, path);
        return WT_E_SCHEMA;
    }
    wt_status status = WT_OK;
    wt_case *c = calloc(1, sizeof *c);
    char *folder = wt_path_folder(path);
    if (c == NULL || folder == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    set_defaults(c);
    c->xml_length = length;
    c->path = case_text(c, path, strlen(path));
    c->folder = case_text(c, folder, strlen(folder));
    c->xml = case_text(c, bytes, length);
    status = c->path == NULL || c->folder == NULL || c->xml == NULL
                 ? wt_fail(err, WT_E_MEMORY, "out of memory")
                 : case_parse(c, err);
done:
    free(folder);
    if (status != WT_OK) {
        wt_error_file(err, path);
        wt_case_free(c);
        return status;
    }
    *out = c;
    return WT_OK;
}

wt_status wt_case_read(const char *path, wt_case **out, wt_error *err)
{
    if (path == NULL || out == NULL)
        return wt_fail(err, WT_E_ARG, "no case file");
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK)
        status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = case_from_bytes(bytes, length, path, out, err);
    else
        wt_error_file(err, path);
    wt_input_close(input);
    return status;
}

const char *wt_case_title(const wt_case *c)
{
    return c->title;
}

const char *wt_case_style(const wt_case *c)
{
    return c->style;
}
