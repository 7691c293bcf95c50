/* A layer in one sliding contact: energy that modifies the rubber, parameters, operating point and
 * friction. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_ENERGY_H
#define WT_LAYER_LAYER_ENERGY_H

#include "core/math/special.h"
#include "friction/replicates.h"
#include "friction/sliding_contact.h"
#include "weartrack/layer.h"

typedef struct layer_energy {
    wt_energy_source source;
    double hysteresis_power, shear_power; /* total powers of the contact [W/m^2]; the second is
                                             NaN if not requested */
    wt_friction_point point;              /* friction, if requested */
} layer_energy;

/* Velocity at which the track was worn. */
double layer_sliding_velocity(const wt_sliding *sliding, const wt_layer_job *layer);
/* Computes the energy; the caller clears it. Returns WT_E_MISSING if shearing contributes and its
 * stress is not stated. */
wt_status layer_energy_compute(const wt_sliding *sliding, const wt_layer_job *job,
                               const sliding_contact *contact, double velocity,
                               layer_energy *energy, wt_error *err) WT_NODISCARD;
void layer_energy_clear(layer_energy *energy);
/* Parameters of a replicate. The critical energy may still have to be calibrated. */
wt_layer_parameters layer_parameters_create(const wt_layer_job *job, const sliding_contact *contact,
                                            double velocity, uint64_t seed, size_t replicate);

/* Times of a job, by default from well before the first change of the layer to well after the last:
 * [n], which the caller frees. */
double *layer_times_choose(const wt_layer_job *job, const wt_layer_steady_state *balance,
                           size_t *n);

/* Adds the error sources of a layer: wear; critical energy or observed thickness; shear stress if
 * it modifies the rubber. Returns the standard error of the second. */
double layer_replicates_add(replicates *r, const wt_sliding *sliding, const wt_layer_job *job);

/* ---- context --------------------------------------------------------------------------------- */

/* Values for a computation: the stated ones, or those that a replicate draws from the stated
 * errors. */
typedef struct layer_context {
    const wt_sliding *sliding;
    const wt_layer_job *job; /* job with calibrated critical energy */
    const wt_job *work;
    size_t replicate;         /* WT_NO_REPLICATE for the stated values */
    wt_material_cache *drawn; /* cache of the materials of the replicates; NULL if none */
    double modulus_ratio;     /* modulus ratio of the layer; NaN if unknown */
    wt_ratio_slope slope;     /* frequency dependence of the modulus ratio */
    bool bulk_shear;          /* shear stress of the bulk for the layer, not times the ratio */
} layer_context;

/* Computes energy and layer parameters on bare rubber. */
wt_status layer_compute_energy(const layer_context *context, layer_energy *energy,
                               wt_layer_parameters *parameters, wt_error *err) WT_NODISCARD;
/* Friction under a layer, with its shear stress. The total is NaN if no shear stress is stated. */
typedef struct layer_friction {
    double hysteresis, area_ratio, total;
    double bulk_stress, pressure; /* inputs of the total */
    double ratio;                 /* modulus ratio at the shear frequency; input of the total */
} layer_friction;
/* Computes friction under a layer of a thickness [m] that has the modulus of the context; 0 gives
 * bare rubber. */
wt_status layer_compute_friction(const layer_context *context, double thickness,
                                 layer_friction *friction, wt_error *err) WT_NODISCARD;
/* Copies the job of a context and calibrates its critical energy if it has an observed thickness.
 */
wt_status layer_job_calibrate(const layer_context *context, wt_layer_job *calibrated,
                              wt_error *err) WT_NODISCARD;

/* ---- friction against thickness ----------------------------------------------------------------
 */

/* Interpolated quantities. The shear stress of the layer can be discontinuous and is computed from
 * these. */
enum { NODE_HYSTERESIS, NODE_AREA, NODE_BULK_STRESS, NODE_MODULUS_RATIO, N_NODE_QUANTITIES };

typedef struct layer_friction_model {
    const layer_context *context; /* borrowed */
    size_t n;                     /* number of nodes; 0 for direct computation */
    double *log_thickness;        /* [n] rising */
    double pressure;
    double *value[N_NODE_QUANTITIES]; /* [n] each */
    akima_curve *curve[N_NODE_QUANTITIES];
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
