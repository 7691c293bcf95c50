/* Friction on a layer against its thickness, computed directly or by interpolation between nodes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_friction.h"

#include <math.h>
#include <stdlib.h>

/* Smallest ratio of the thickest to the thinnest layer for interpolation: nodes must be distinct.
 */
static const double min_thickness_ratio = 1 + 1e-6;

static wt_status compute_nodes(layer_friction_model *f, double thinnest, double thickest, size_t n,
                               wt_error *err)
{
    const double low = log(thinnest), high = log(thickest);
    for (size_t i = 0; i < n; i++) {
        layer_friction at;
        f->log_thickness[i] = low + (high - low) * (double)i / (double)(n - 1);
        const wt_status status = layer_compute_friction(
            f->context, operating_point_under_layer(f->context, exp(f->log_thickness[i])), &at,
            err);
        if (status != WT_OK)
            return status;
        f->value[NODE_HYSTERESIS][i] = at.hysteresis;
        f->value[NODE_AREA][i] = at.area_ratio;
        f->value[NODE_BULK_STRESS][i] = at.bulk_stress;
        f->value[NODE_MODULUS_RATIO][i] = at.ratio;
        f->pressure = at.pressure;
    }
    f->n = n;
    return WT_OK;
}

wt_status layer_friction_model_create(const layer_context *context, double thinnest,
                                      double thickest, size_t n, layer_friction_model *friction,
                                      wt_error *err)
{
    *friction = (layer_friction_model){.context = context};
    if (n < AKIMA_POINTS_MIN || !(thickest > min_thickness_ratio * thinnest))
        return WT_OK;
    double *all = wt_alloc((N_NODE_QUANTITIES + 1) * n, sizeof *all);
    friction->log_thickness = all;
    for (size_t k = 0; k < N_NODE_QUANTITIES; k++)
        friction->value[k] = all + (k + 1) * n;
    wt_status status = compute_nodes(friction, thinnest, thickest, n, err);
    for (size_t k = 0; status == WT_OK && k < N_NODE_QUANTITIES; k++) {
        friction->curve[k] = akima_curve_new(friction->log_thickness, friction->value[k], n);
        if (friction->curve[k] == NULL)
            status = wt_fail(err, WT_E_MEMORY, "out of memory");
    }

    if (status != WT_OK)
        layer_friction_model_clear(friction);
    return status;
}

wt_status layer_friction_model_evaluate(const layer_friction_model *model, double thickness,
                                        layer_friction *f, wt_error *err)
{
    const double unknown = (double)NAN;
    const operating_point conditions = operating_point_under_layer(model->context, thickness);
    *f = (layer_friction){unknown, unknown, unknown, unknown, unknown,
                          unknown, unknown, unknown, unknown, unknown};
    if (!isfinite(thickness))
        return WT_OK;
    if (model->n == 0 || !(thickness > 0))
        return layer_compute_friction(model->context, conditions, f, err);
    const double *const at = model->log_thickness;
    const double x = fmin(fmax(log(thickness), at[0]), at[model->n - 1]);
    f->hysteresis = akima_curve_value(model->curve[NODE_HYSTERESIS], x);
    f->area_ratio = akima_curve_value(model->curve[NODE_AREA], x);
    f->bulk_stress = akima_curve_value(model->curve[NODE_BULK_STRESS], x);
    f->pressure = model->pressure;
    const bool own =
        model->context->sliding->layer_rubber != NULL || conditions.layer.slope.exponent != 0;
    f->ratio = own ? akima_curve_value(model->curve[NODE_MODULUS_RATIO], x)
                   : conditions.layer.modulus_ratio;
    layer_friction_set_total(model->context->job, conditions.layer, f);
    return WT_OK;
}

void layer_friction_model_clear(layer_friction_model *friction)
{
    for (size_t k = 0; k < N_NODE_QUANTITIES; k++)
        akima_curve_free(friction->curve[k]);
    free(friction->log_thickness);
    *friction = (layer_friction_model){.n = 0};
}
