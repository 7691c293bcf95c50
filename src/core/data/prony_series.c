/* Memory of Prony series. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/data/prony_series.h"

#include <math.h>
#include <stdlib.h>

void wt_prony_clear(wt_prony *prony)
{
    if (prony == NULL)
        return;
    free(prony->relaxation_time);
    free(prony->modulus);
    *prony = (wt_prony){0};
}

wt_status wt_prony_alloc(wt_prony *prony, size_t n, wt_error *err)
{
    double *const relaxation_time = wt_alloc(n, sizeof *relaxation_time);
    double *const modulus = wt_alloc(n, sizeof *modulus);
    (void)err;
    *prony = (wt_prony){.deformation = WT_TENSION,
                        .reference_temperature = (double)NAN,
                        .n = n,
                        .relaxation_time = relaxation_time,
                        .modulus = modulus,
                        .frequency_min = (double)NAN,
                        .frequency_max = (double)NAN};
    return WT_OK;
}

wt_status prony_copy(const wt_prony *from, wt_prony *to, wt_error *err)
{
    wt_status status = wt_prony_alloc(to, from->n, err);
    if (status != WT_OK)
        return status;
    double *const relaxation_time = to->relaxation_time, *const modulus = to->modulus;
    for (size_t i = 0; i < from->n; i++) {
        relaxation_time[i] = from->relaxation_time[i];
        modulus[i] = from->modulus[i];
    }
    *to = *from;
    to->relaxation_time = relaxation_time;
    to->modulus = modulus;
    return WT_OK;
}
