/* Fuzz target: any text as the parameters of a self-affine surface. An accepted surface has a
 * spectrum of finite densities.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/friction.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[512];
    wt_surface surface = {0};
    wt_roughness *roughness = NULL;
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_job work = wt_job_defaults();
    /* Other text would be a file name. */
    snprintf(text, sizeof text, "self-affine:%.*s", size < 480 ? (int)size : 480,
             size > 0 ? (const char *)data : "");
    if (wt_surface_open(text, NULL, &work, &surface, &err) == WT_OK) {
        if (!isfinite(surface.c0.value) || !(surface.q1 > surface.q0) || !(surface.q0 > 0))
            abort();
        if (wt_surface_roughness(&surface, 1, &roughness, &err) != WT_OK && err.message[0] == '\0')
            abort();
        if (wt_surface_table(&surface, &table, &err) != WT_OK && err.message[0] == '\0')
            abort();
    } else if (err.message[0] == '\0') {
        abort();
    }
    wt_table_free(table);
    wt_roughness_free(roughness);
    wt_surface_clear(&surface);
    return 0;
}
