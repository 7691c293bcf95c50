/* Materials: what every law shares - construction around a law, its checks and its release.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "model/material.h"

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
    if (good && isfinite(value))
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "%s of a material is outside its range", name);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "%g", value);
    return WT_E_RANGE;
}

wt_status material_wrap(const wt_material_law *law, void *data, double poisson_ratio,
                        wt_material **material, wt_error *err)
{
    wt_material *made = malloc(sizeof *made);
    if (made == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for a material");
    made->law = law;
    made->poisson_ratio = poisson_ratio;
    made->frequency_min = (double)NAN;
    made->frequency_max = (double)NAN;
    made->data = data;
    *material = made;
    return WT_OK;
}

void wt_material_free(wt_material *material)
{
    if (material == NULL)
        return;
    if (material->law->free != NULL)
        material->law->free(material);
    free(material);
}
