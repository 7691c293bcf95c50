/* Spool: collects the bytes of an input that arrives piece by piece, in memory or, above
 * SCRATCH_THRESHOLD, in a temporary file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/spool.h"

#include "read/bytes/input.h"
#include "read/bytes/scratch.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static wt_status reserve_spool(spool *to, size_t n, const char *name, wt_error *err)
{
    size_t capacity = to->capacity > 0 ? to->capacity : 1 << 16;
    while (capacity - to->length < n) {
        if (capacity > SIZE_MAX / 2) {
            wt_fail(err, WT_E_MEMORY, "input too large");
            wt_error_file(err, name);
            return WT_E_MEMORY;
        }
        capacity *= 2;
    }
    unsigned char *const bytes = capacity > to->capacity ? realloc(to->bytes, capacity) : to->bytes;
    if (bytes == NULL) {
        wt_fail(err, WT_E_MEMORY, "no memory for %zu bytes of input", capacity);
        wt_error_file(err, name);
        return WT_E_MEMORY;
    }
    to->bytes = bytes;
    to->capacity = capacity;
    return WT_OK;
}

wt_status spool_add(spool *to, const void *bytes, size_t n, const char *name, wt_error *err)
{
    wt_status status = WT_OK;
    if (!to->has_tried_file && n > SCRATCH_THRESHOLD - to->length) {
        to->has_tried_file = true;
        to->file = scratch_open();
        to->has_file = to->file >= 0;
        if (to->has_file)
            status = scratch_write(to->file, to->bytes, to->length, name, err);
        if (to->has_file) {
            free(to->bytes);
            to->bytes = NULL;
            to->capacity = 0;
        }
    }
    if (status == WT_OK && to->has_file)
        status = scratch_write(to->file, bytes, n, name, err);
    else if (status == WT_OK && (status = reserve_spool(to, n, name, err)) == WT_OK && n > 0)
        memcpy(to->bytes + to->length, bytes, n);
    to->length += status == WT_OK ? n : 0;
    return status;
}

wt_status spool_to_input(spool *from, const char *name, wt_input **input, wt_error *err)
{
    const wt_status status =
        from->has_file ? input_from_file(from->file, from->length, name, input, err)
                       : input_from_bytes((char *)from->bytes, from->length, name, input, err);
    *from = (spool){0};
    return status;
}

void spool_discard(spool *from)
{
    if (from->has_file)
        (void)close(from->file);
    free(from->bytes);
    *from = (spool){0};
}
