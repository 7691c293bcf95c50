/* What modifies the rubber in one sliding contact, and the parameters of its layer. Internal to
 * flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_LAYER_LAYER_ENERGY_H
#define WEARTRACK_FLOW_LAYER_LAYER_ENERGY_H

#include "flow/sliding/sliding_contact.h"

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

/* ---- at other loads and under a layer -------------------------------------------------------- */

/* Where a layer is looked at, by the values themselves. */
typedef struct layer_spot {
    double pressure, velocity, temperature; /* NaN: those of the sliding */
    wt_layer_state layer;                   /* what lies on the bulk already */
} layer_spot;
layer_spot layer_here(void);

/* Energy, friction and the parameters of the layer there. */
wt_status layer_at(const wt_sliding *sliding, const wt_layer_job *job, const wt_job *work,
                   layer_spot spot, layer_energy *energy, wt_layer_parameters *parameters,
                   wt_error *err) WT_NODISCARD;
/* Friction there, by the shear stress of a layer if there is one; of hysteresis alone if no shear
 * stress is known. */
typedef struct layer_friction {
    double hysteresis, area_ratio, shear_stress, total;
} layer_friction;
wt_status layer_friction_at(const wt_sliding *sliding, const wt_layer_job *job, const wt_job *work,
                            layer_spot spot, layer_friction *friction, wt_error *err) WT_NODISCARD;
/* A number whose errors are not known. */
wt_estimate layer_alone(double value);
/* The job with its critical energy calibrated, if it has an observed thickness. */
wt_status layer_job_calibrated(const wt_sliding *sliding, const wt_layer_job *job,
                               const wt_job *work, wt_layer_job *calibrated,
                               wt_error *err) WT_NODISCARD;

#endif
