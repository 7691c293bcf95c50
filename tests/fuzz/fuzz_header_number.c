/* Fuzz target: any text as a value of a header. The number is finite and lies in the text, and
 * the warning is terminated.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/header_values.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check(bool good)
{
    if (!good)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* The buffer has the exact size, so that a read beyond its end is an error. */
    char *const text = malloc(size > 0 ? size : 1);
    double value = 0, error = 0;
    size_t end = 0;
    check(text != NULL);
    if (size > 0)
        memcpy(text, data, size);
    wt_log *const log = wt_log_new();
    const header_number found = header_number_read(text, size, &value, &end);
    check(end <= size && (found == HEADER_NUMBER_ONE ? isfinite(value) : isnan(value)));
    const size_t behind = header_number_error(text + end, size - end, &error);
    check(behind <= size - end && (behind > 0 ? error >= 0 : isnan(error)));
    header_number_warn(found, text, size, "value", "--value", "file", "place", log);
    check(found == HEADER_NUMBER_ONE ||
          (wt_log_count(log) > 0) == (found >= HEADER_NUMBER_GOES_ON));
    wt_log_free(log);
    free(text);
    return 0;
}
