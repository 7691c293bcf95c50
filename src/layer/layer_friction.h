/* Friction on a layer against its thickness. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_FRICTION_H
#define WT_LAYER_LAYER_FRICTION_H

#include "core/math/cubic_interpolation.h"
#include "layer/layer_energy.h"

/* Interpolated quantities. The shear stress of the layer can be discontinuous and is computed from
 * these. */
enum { NODE_HYSTERESIS, NODE_AREA, NODE_BULK_STRESS, NODE_MODULUS_RATIO, N_NODE_QUANTITIES };

typedef struct layer_friction_model {
    const layer_context *context; /* borrowed */
    size_t n;                     /* number of nodes; 0 for direct computation */
    double *log_thickness;        /* [n] rising */
    double pressure;
    double *value[N_NODE_QUANTITIES]; /* [n] each */
    curve *curve[N_NODE_QUANTITIES];
} layer_friction_model;

/* Creates n nodes from the thinnest to the thickest layer, in equal ratios. There are none if n <
 * AKIMA_POINTS_MIN or if the thicknesses are equal; friction is then computed directly. The
 * caller clears the model. */
wt_status layer_friction_model_create(const layer_context *context, double thinnest,
                                      double thickest, size_t n, layer_friction_model *friction,
                                      wt_error *err) WT_NODISCARD;
/* Friction at a thickness [m]; NaN for a thickness that is not finite. */
wt_status layer_friction_model_evaluate(const layer_friction_model *model, double thickness,
                                        layer_friction *f, wt_error *err) WT_NODISCARD;
void layer_friction_model_clear(layer_friction_model *friction);

#endif
