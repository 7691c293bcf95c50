/* Material, roughness and load of one replicate of a sliding contact, ready for the kernel.
 * Internal to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SLIDING_SLIDING_CONTACT_H
#define WEARTRACK_FLOW_SLIDING_SLIDING_CONTACT_H

#include "flow/sliding/drawn_materials.h"

typedef struct sliding_contact {
    double pressure, shear_stress;
    double temperature; /* of the rubber, or of its surroundings [K] */
    wt_material *material;
    bool shared; /* it is that of `drawn` */
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
                               wt_drawn *drawn, wt_layer_state layer, sliding_contact *contact,
                               wt_error *err) WT_NODISCARD;
/* What must be said of numbers whose relative error is not below the tolerance. */
#define TOLERANCE_STATEMENT "the tolerance %.2g is not reached, the numerical error is up to %.2g"
/* Shear stress of the contact at a point, by the temperature there. */
double sliding_shear(const wt_sliding *sliding, const sliding_contact *contact,
                     const wt_friction_point *point);
/* The layer of a replicate, a bare one where its thickness is drawn below 0; `known` NULL: none. */
wt_layer_state sliding_layer(const wt_layer_known *known, uint64_t seed, size_t replicate);
/* Shear stress with a layer, of that of the bulk: tau_s = tau_bulk x modulus ratio (L3), or as the
 * layer says; cracks are opened without one, too. `known` NULL: that of the bulk. */
/* Its law: that of the bulk has no power of the modulus ratio. */
wt_layer_shear sliding_layer_shear_of(const wt_layer_known *known);
double sliding_layer_shear(const wt_layer_known *known, double bulk, wt_layer_state layer,
                           double area_ratio);
/* The modulus ratio at once and no cracks, which need no words; the law in words. */
bool sliding_layer_shear_is_plain(const wt_layer_shear *shear);
void sliding_layer_shear_describe(const wt_layer_shear *shear, char *text, size_t size);
void sliding_contact_clear(sliding_contact *contact);

#endif
