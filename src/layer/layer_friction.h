/* Friction on a layer against its thickness. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_FRICTION_H
#define WT_LAYER_LAYER_FRICTION_H

#include "core/math/cubic_interpolation.h"
#include "layer/layer_energy.h"

/* What is interpolated; the shear stress of the layer, which may jump, is a law of these. */
enum { OF_HYSTERESIS, OF_AREA, OF_BULK_STRESS, OF_RATIO, OF_CURVES };

typedef struct friction_of_layer {
    const layer_scene *scene; /* borrowed */
    size_t n;                 /* nodes; 0: it is computed at every thickness */
    double *log_thickness;    /* [n] rising */
    double pressure;
    double *value[OF_CURVES]; /* [n] each */
    curve *curve[OF_CURVES];
} friction_of_layer;

/* n nodes from the thinnest to the thickest layer, in equal ratios; fewer than five, or layers of
 * one thickness: none. */
wt_status friction_of_layer_make(const layer_scene *scene, double thinnest, double thickest,
                                 size_t n, friction_of_layer *friction, wt_error *err) WT_NODISCARD;
/* Not known of a thickness that is not finite. */
wt_status friction_of_layer_at(const friction_of_layer *of, double thickness, layer_friction *f,
                               wt_error *err) WT_NODISCARD;
void friction_of_layer_clear(friction_of_layer *friction);

#endif
