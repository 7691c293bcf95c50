/* Friction on a layer against its thickness, computed directly or by interpolation between nodes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_friction.h"

#include <math.h>
#include <stdlib.h>

/* Smallest ratio of the thickest to the thinnest layer for interpolation: nodes must be distinct.
 */
static const double least_ratio = 1 + 1e-6;

static wt_status take_nodes(layer_friction_model *f, double thinnest, double thickest, size_t n,
                            wt_error *err)
{
    const double low = log(thinnest), high = log(thickest);
    for (size_t i = 0; i < n; i++) {
        layer_friction at;
        f->log_thickness[i] = low + (high - low) * (double)i / (double)(n - 1);
        const wt_status status =
            layer_friction_at(f->scene, layer_under(f->scene, exp(f->log_thickness[i])), &at, err);
        if (status != WT_OK)
            return status;
        f->value[OF_HYSTERESIS][i] = at.hysteresis;
        f->value[OF_AREA][i] = at.area_ratio;
        f->value[OF_BULK_STRESS][i] = at.bulk_stress;
        f->value[OF_RATIO][i] = at.ratio;
        f->pressure = at.pressure;
    }
    f->n = n;
    return WT_OK;
}

wt_status layer_friction_model_make(const layer_context *scene, double thinnest, double thickest,
                                    size_t n, layer_friction_model *friction, wt_error *err)
{
    *friction = (layer_friction_model){.scene = scene};
    if (n < CURVE_LEAST_POINTS || !(thickest > least_ratio * thinnest))
        return WT_OK;
    double *all = malloc((OF_CURVES + 1) * n * sizeof *all);
    if (all == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    friction->log_thickness = all;
    for (size_t k = 0; k < OF_CURVES; k++)
        friction->value[k] = all + (k + 1) * n;
    wt_status status = take_nodes(friction, thinnest, thickest, n, err);
    for (size_t k = 0; status == WT_OK && k < OF_CURVES; k++) {
        friction->curve[k] = curve_new(friction->log_thickness, friction->value[k], n);
        if (friction->curve[k] == NULL)
            status = wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    if (status != WT_OK)
        layer_friction_model_clear(friction);
    return status;
}

wt_status layer_friction_model_at(const layer_friction_model *of, double thickness,
                                  layer_friction *f, wt_error *err)
{
    const double unknown = (double)NAN;
    const operating_point spot = layer_under(of->scene, thickness);
    *f = (layer_friction){unknown, unknown, unknown, unknown, unknown,
                          unknown, unknown, unknown, unknown, unknown};
    if (!isfinite(thickness))
        return WT_OK;
    if (of->n == 0 || !(thickness > 0))
        return layer_friction_at(of->scene, spot, f, err);
    const double *const at = of->log_thickness;
    const double x = fmin(fmax(log(thickness), at[0]), at[of->n - 1]);
    f->hysteresis = curve_at(of->curve[OF_HYSTERESIS], x);
    f->area_ratio = curve_at(of->curve[OF_AREA], x);
    f->bulk_stress = curve_at(of->curve[OF_BULK_STRESS], x);
    f->pressure = of->pressure;
    const bool own = of->scene->sliding->layer_rubber != NULL || spot.layer.slope.exponent != 0;
    f->ratio = own ? curve_at(of->curve[OF_RATIO], x) : spot.layer.modulus_ratio;
    layer_friction_join(of->scene->job, spot.layer, f);
    return WT_OK;
}

void layer_friction_model_clear(layer_friction_model *friction)
{
    for (size_t k = 0; k < OF_CURVES; k++)
        curve_free(friction->curve[k]);
    free(friction->log_thickness);
    *friction = (layer_friction_model){.n = 0};
}
