/* Functions that all material laws share: construction, checks and release.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law/material.h"

#include <math.h>
#include <stdlib.h>

wt_status material_check_poisson(double poisson_ratio, wt_error *err)
{
    static const wt_param row = POISSON_RATIO(wt_material);
    return param_check_number(&row, poisson_ratio, err);
}

wt_status material_check_value(const char *name, double value, const char *expected, bool good,
                               wt_error *err)
{
    char full[128];
    if (good && isfinite(value))
        return WT_OK;
    snprintf(full, sizeof full, "%s of a material", name);
    return range_error(full, value, expected, err);
}

wt_material *material_create(const wt_material_law *law, void *data, double poisson_ratio,
                             double frequency_min, double frequency_max)
{
    wt_material *made = wt_alloc(1, sizeof *made);
    *made = (wt_material){.law = law,
                          .poisson_ratio = poisson_ratio,
                          .frequency_min = frequency_min,
                          .frequency_max = frequency_max,
                          .data = data};
    return made;
}

void material_free_data(wt_material *material)
{
    free(material->data);
}

void wt_material_free(wt_material *material)
{
    if (material == NULL)
        return;
    if (material->law->free != NULL)
        material->law->free(material);
    free(material);
}
