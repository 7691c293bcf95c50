/* Material, roughness and load of one replicate of a sliding contact, ready for the kernel.
 * Internal to friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_SLIDING_CONTACT_H
#define WT_FRICTION_SLIDING_CONTACT_H

#include "friction/layer_observation.h"
#include "friction/material_cache.h"

typedef struct sliding_contact {
    double pressure, shear_stress;
    double temperature; /* of the rubber, or of its surroundings [K] */
    wt_material *material;
    bool shared;        /* it is that of `drawn` */
    wt_material *layer; /* of a layer that has one of its own; NULL: none */
    wt_roughness *roughness;
    wt_friction_workspace *workspace;
    wt_cost *cost;       /* of its nodes */
    char statement[512]; /* what must be said of the material, "" if nothing */
} sliding_contact;

/* Checks the numbers of a sliding contact and of the job. */
wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work,
                             wt_error *err) WT_NODISCARD;
/* The velocity of the answer: as given, or the middle of the list. */
double flow_reference_velocity(const wt_sliding *sliding);
/* The velocity at which the track was worn. */
double flow_layer_velocity(const wt_sliding *sliding, const wt_layer_job *layer);
/* Draws replicate `replicate` (WT_NO_REPLICATE = the values themselves, with drawn NULL) and
 * prepares the kernel. A replicate takes one thread and asks for a small numerical error, as many
 * are made at a time. */
wt_status sliding_contact_make(const wt_sliding *sliding, const wt_job *work, size_t replicate,
                               wt_material_cache *drawn, wt_layer_state layer,
                               sliding_contact *contact, wt_error *err) WT_NODISCARD;
/* What must be said of numbers whose relative error is not below the tolerance. */
#define TOLERANCE_STATEMENT "the tolerance %.2g is not reached, the numerical error is up to %.2g"
/* Shear stress of the contact at a point, by the temperature there. */
double sliding_shear(const wt_sliding *sliding, const sliding_contact *contact,
                     const wt_friction_point *point);
/* The layer of a contact, whose modulus ratio is that at which it is sheared: at the frequency
 * velocity / thickness, which is the rate of its shear and that of a wave as long as it is thick.
 */
wt_layer_state sliding_layer_sheared(const sliding_contact *contact, wt_layer_state layer,
                                     double velocity);
void sliding_contact_clear(sliding_contact *contact);

#endif
