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
    bool has_point;
} layer_energy;

/* Whether a job needs friction and contact area beside the energy. */
bool layer_needs_area(const wt_layer_job *job);
/* WT_E_MISSING if shearing counts and its stress is not known. */
wt_status layer_energy_make(const wt_sliding *sliding, const wt_layer_job *job,
                            const sliding_contact *contact, double velocity, layer_energy *energy,
                            wt_error *err) WT_NODISCARD;
void layer_energy_clear(layer_energy *energy);
/* The parameters of a replicate but for the critical energy, which may have to be calibrated. */
wt_layer_parameters layer_parameters_of(const wt_layer_job *job, const sliding_contact *contact,
                                        double velocity, const layer_energy *energy, uint64_t seed,
                                        size_t replicate);

#endif
