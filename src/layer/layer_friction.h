/* Friction on a layer against its thickness. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_FRICTION_H
#define WT_LAYER_LAYER_FRICTION_H

#include "core/math/cubic_interpolation.h"
#include "layer/layer_energy.h"

/* What is interpolated; the shear stress of the layer, which may jump, is a law of these. */
enum { OF_HYSTERESIS, OF_AREA, OF_BULK_STRESS, OF_RATIO, OF_CURVES };

typedef struct layer_friction_model {
    const layer_context *scene; /* borrowed */
    size_t n;                   /* nodes; 0: it is computed at every thickness */
    double *log_thickness;      /* [n] rising */
    double pressure;
    double *value[OF_CURVES]; /* [n] each */
    curve *curve[OF_CURVES];
} layer_friction_model;

/* n nodes from the thinnest to the thickest layer, in equal ratios; fewer than five, or layers of
 * one thickness: none. */
wt_status layer_friction_model_make(const layer_context *scene, double thinnest, double thickest,
                                    size_t n, layer_friction_model *friction,
                                    wt_error *err) WT_NODISCARD;
/* Not known of a thickness that is not finite. */
wt_status layer_friction_model_at(const layer_friction_model *of, double thickness,
                                  layer_friction *f, wt_error *err) WT_NODISCARD;
void layer_friction_model_clear(layer_friction_model *friction);

#endif
