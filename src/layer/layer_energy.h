/* What modifies the rubber in one sliding contact, and the parameters of its layer. Internal to
 * flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_LAYER_ENERGY_H
#define WT_LAYER_LAYER_ENERGY_H

#include "friction/sliding_contact.h"

typedef struct layer_energy {
    wt_energy_source source;
    double hysteresis_power, shear_power; /* of the contact, whatever counts [W/m^2]; the second NaN
                                             where it is not asked for */
    wt_friction_point point;              /* of the friction, likewise */
} layer_energy;

/* Whether a job needs friction and contact area beside the energy. */
bool layer_needs_area(const wt_layer_job *job);
/* WT_E_MISSING if shearing counts and its stress is not known. */
wt_status layer_energy_make(const wt_sliding *sliding, const wt_layer_job *job,
                            const sliding_contact *contact, double velocity, wt_layer_state layer,
                            layer_energy *energy, wt_error *err) WT_NODISCARD;
void layer_energy_clear(layer_energy *energy);
/* The parameters of a replicate but for the critical energy, which may have to be calibrated. */
wt_layer_parameters layer_parameters_of(const wt_layer_job *job, const sliding_contact *contact,
                                        double velocity, const layer_energy *energy, uint64_t seed,
                                        size_t replicate);

/* The times of a job, or such as show a layer from well before its first change to well after the
 * last one: *time [n], to be freed. */
wt_status layer_times_choose(const wt_layer_job *job, const wt_layer_balance *balance,
                             double **time, size_t *n, wt_error *err) WT_NODISCARD;

/* ---- by which values, at which loads and under which layer ----------------------------------- */

/* The values themselves, or what a replicate draws of those that are stated with an error. */
typedef struct layer_context {
    const wt_sliding *sliding;
    const wt_layer_job *job; /* its critical energy calibrated */
    const wt_job *work;
    size_t replicate;         /* WT_NO_REPLICATE: the values themselves */
    wt_material_cache *drawn; /* materials of the replicates; NULL: none is kept */
    double modulus_ratio;     /* of the layer; NaN: not known */
    wt_ratio_slope slope;     /* of that */
} layer_context;

/* Where a layer is looked at. What is given has the relative error of that of the sliding, a
 * temperature the same error, and is drawn with it: one instrument measured both. */
typedef struct operating_point {
    double pressure, velocity, temperature; /* NaN: those of the sliding */
    wt_layer_state layer;                   /* what lies on the bulk already */
} operating_point;
operating_point operating_point_default(void);
/* Under a layer of the scene's modulus; 0: on the bulk. */
operating_point layer_under(const layer_context *scene, double thickness);

/* Energy, friction and the parameters of the layer there. */
wt_status layer_at(const layer_context *scene, operating_point spot, layer_energy *energy,
                   wt_layer_parameters *parameters, wt_error *err) WT_NODISCARD;
/* Friction there, by the shear stress of a layer if there is one; of hysteresis alone if no shear
 * stress is known. Errors are numerical. */
typedef struct layer_friction {
    double hysteresis, area_ratio, shear_stress, total;
    double hysteresis_error, area_error, total_error;
    double bulk_stress, pressure; /* of which the others are made */
    double ratio;                 /* of the moduli, where the layer is sheared; likewise */
} layer_friction;
wt_status layer_friction_at(const layer_context *scene, operating_point spot,
                            layer_friction *friction, wt_error *err) WT_NODISCARD;
/* Both in one contact; what is NULL is not looked for. */
wt_status layer_look(const layer_context *scene, operating_point spot, layer_energy *energy,
                     wt_layer_parameters *parameters, layer_friction *friction,
                     wt_error *err) WT_NODISCARD;
/* Shear stress and total of a hysteresis, contact area and bulk's shear stress on a layer. */
void layer_friction_join(const wt_layer_job *job, wt_layer_state layer, layer_friction *friction);
/* Total friction, or hysteresis where no shear stress is known. */
double layer_friction_known(const layer_friction *friction);
/* A number whose errors are not known. */
wt_estimate estimate_without_error(double value);
/* The job of a scene with its critical energy calibrated, if it has an observed thickness. */
wt_status layer_job_calibrated(const layer_context *scene, wt_layer_job *calibrated,
                               wt_error *err) WT_NODISCARD;

#endif
