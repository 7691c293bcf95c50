/* A layer in one sliding contact: energy that modifies the rubber, parameters, operating point and
 * friction. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_ENERGY_H
#define WT_LAYER_LAYER_ENERGY_H

#include "core/math/special.h"
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
                               wt_layer_state layer, layer_energy *energy,
                               wt_error *err) WT_NODISCARD;
void layer_energy_clear(layer_energy *energy);
/* Parameters of a replicate. The critical energy may still have to be calibrated. */
wt_layer_parameters layer_parameters_create(const wt_layer_job *job, const sliding_contact *contact,
                                            double velocity, uint64_t seed, size_t replicate);

/* Times of a job, by default from well before the first change of the layer to well after the last:
 * [n], which the caller frees. */
double *layer_times_choose(const wt_layer_job *job, const wt_layer_steady_state *balance,
                           size_t *n);

/* ---- context and operating point ------------------------------------------------------------- */

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
} layer_context;

/* Operating point of a layer. A stated pressure has the relative error of that of the sliding, and
 * a stated temperature the same error. Both use the same draw, because one instrument measured
 * both. */
typedef struct operating_point {
    double pressure, velocity, temperature; /* NaN for those of the sliding */
    wt_layer_state layer;                   /* layer that is already on the bulk */
} operating_point;
operating_point operating_point_default(void);
/* Operating point under a layer with the modulus of the context; thickness 0 gives the bare bulk.
 */
operating_point operating_point_under_layer(const layer_context *context, double thickness);

/* Computes energy and layer parameters at an operating point. */
wt_status layer_compute_energy(const layer_context *context, operating_point conditions,
                               layer_energy *energy, wt_layer_parameters *parameters,
                               wt_error *err) WT_NODISCARD;
/* Friction at an operating point, with the shear stress of a layer if present. The total is NaN if
 * no shear stress is stated. Errors are numerical. */
typedef struct layer_friction {
    double hysteresis, area_ratio, shear_stress, total;
    double hysteresis_error, area_error, total_error;
    double bulk_stress, pressure; /* inputs of the total */
    double ratio;                 /* modulus ratio at the shear frequency; input of the total */
} layer_friction;
wt_status layer_compute_friction(const layer_context *context, operating_point conditions,
                                 layer_friction *friction, wt_error *err) WT_NODISCARD;
/* Computes energy and friction in one contact; NULL arguments are not computed. */
wt_status layer_compute_contact(const layer_context *context, operating_point conditions,
                                layer_energy *energy, wt_layer_parameters *parameters,
                                layer_friction *friction, wt_error *err) WT_NODISCARD;
/* Computes shear stress and total friction from hysteresis, contact area and shear stress of the
 * bulk. */
void layer_friction_set_total(const wt_layer_job *job, wt_layer_state layer,
                              layer_friction *friction);
/* Total friction, or hysteresis friction if no shear stress is stated. */
double layer_friction_coefficient(const layer_friction *friction);
/* Estimate without errors. */
wt_estimate estimate_without_error(double value);
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

/* ---- feedback and loads -----------------------------------------------------------------------
 */

/* A wt_layer_energy_fn whose `user` is a layer_context. */
wt_status feedback_energy(double thickness, void *user, wt_energy_source *source,
                          wt_layer_parameters *parameters, wt_error *err) WT_NODISCARD;
/* Finds all balances with thicknesses from the shortest wave to the longest. */
wt_status feedback_find_balances(layer_context *context, wt_layer_feedback *loop,
                                 wt_error *err) WT_NODISCARD;

/* NaN for the value of the sliding; an unset time of the last load means that it does not end. */
typedef struct layer_load {
    double time, pressure, velocity, temperature, specific_wear_rate;
} layer_load;

/* Parses load i of a job. Errors name the load and the invalid value. */
wt_status layer_load_parse(const wt_layer_job *job, size_t i, layer_load *load,
                           wt_error *err) WT_NODISCARD;

#endif
