/* Material, roughness and load of one replicate of a sliding contact, prepared for the kernel.
 * Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_SLIDING_CONTACT_H
#define WT_FRICTION_SLIDING_CONTACT_H

#include "friction/material_cache.h"

typedef struct sliding_contact {
    double pressure, shear_stress;
    double temperature; /* temperature of the rubber or of its surroundings [K] */
    wt_material *material;
    bool shared; /* the material belongs to the cache */
    wt_roughness *roughness;
    wt_friction_workspace *workspace;
    wt_cost *cost;       /* receives the number of nodes */
    char statement[512]; /* statement about the validity of the material; "" if none */
} sliding_contact;

/* Checks the parameters of a sliding contact and of the job. */
wt_status flow_sliding_check(const wt_sliding *sliding, const wt_job *work,
                             wt_error *err) WT_NODISCARD;
/* Reference velocity: as stated, else the middle of the list. */
double flow_reference_velocity(const wt_sliding *sliding);
/* Draws replicate `replicate` and prepares the kernel. WT_NO_REPLICATE, with a NULL cache, gives
 * the stated values. A replicate uses one thread and the tolerance of replicates, because many run
 * in parallel. */
wt_status sliding_contact_create(const wt_sliding *sliding, const wt_job *work, size_t replicate,
                                 wt_material_cache *drawn, wt_layer_state layer,
                                 sliding_contact *contact, wt_error *err) WT_NODISCARD;
/* Variant for the stated values without a layer and without what work.left_out can omit. */
wt_status sliding_contact_create_stated(const wt_sliding *sliding, const wt_job *work,
                                        sliding_contact *contact, wt_error *err) WT_NODISCARD;
/* Statement about results whose relative error exceeds the tolerance. */
#define TOLERANCE_STATEMENT "the tolerance %.2g is not reached, the numerical error is up to %.2g"
/* State of the layer with the modulus ratio at its shear frequency, velocity / thickness. This is
 * the shear rate of the layer and the frequency of a wave as long as its thickness. */
wt_layer_state sliding_layer_at_shear_rate(const sliding_contact *contact, wt_layer_state layer,
                                           double velocity);
void sliding_contact_clear(sliding_contact *contact);

/* Writes the model, and the velocities without a solution. The text is "" without a flash
 * temperature. */
void flash_describe(const wt_sliding *sliding, const wt_friction_point *points, size_t n,
                    char text[256]);

/* ---- stated layer ---------------------------------------------------------------------------- */

/* Checks the parameters and their combination. NULL stands for no stated layer. */
wt_status sliding_layer_check(const wt_layer_observation *observation, wt_error *err) WT_NODISCARD;
/* State of the layer in a replicate. A thickness drawn below 0 gives a bare surface; a NULL
 * observation gives no layer. */
wt_layer_state sliding_layer_state(const wt_layer_observation *observation, uint64_t seed,
                                   size_t replicate);
/* Shear stress with a layer from that of the bulk: tau_s = tau_bulk x modulus ratio (L3), or that
 * of the bulk. A NULL observation returns the stress of the bulk. */
double sliding_layer_shear_stress(const wt_layer_observation *observation, double bulk,
                                  wt_layer_state layer);
/* Frequency dependence of the modulus ratio in a replicate. The exponent is 0 for a NULL
 * observation. */
wt_ratio_slope sliding_layer_ratio_slope(const wt_layer_observation *observation, uint64_t seed,
                                         size_t replicate);
/* Widens `range` [rad/s], initially NaN, by the frequencies at which a falling modulus ratio would
 * give the layer a negative loss modulus in these contacts. The loss modulus is set to 0 there. */
wt_status sliding_layer_zero_loss_range(const wt_sliding *sliding,
                                        const wt_layer_observation *observation, const wt_job *work,
                                        double range[2], wt_error *err) WT_NODISCARD;
/* Writes the moduli of the layer as text, "" for one constant ratio. A range with zero loss modulus
 * also gives a warning in the log. */
void sliding_layer_describe(const wt_layer_observation *observation, const double range[2],
                            wt_log *log, char *text, size_t size);

#endif
