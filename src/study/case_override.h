/* Inputs of friction and layer of a case, which can be recomputed with one change. Internal to
 * study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_CASE_OVERRIDE_H
#define WT_STUDY_CASE_OVERRIDE_H

#include "weartrack/layer.h"

typedef struct case_variant {
    wt_sliding sliding; /* refers to the velocity, rubber and surface below */
    double velocity;
    wt_rubber rubber;       /* borrowed, or a modified copy */
    const wt_rubber *given; /* original of `rubber`; NULL once the copy is modified */
    wt_surface surface;     /* borrowed; its cut-offs are numbers [rad/m] */
    bool has_softness;
    wt_strain_softening strain_softening; /* borrowed */
    bool has_layer, has_known;
    wt_layer_job layer;
    wt_layer_observation layer_observation;
    wt_vertical_shift vertical;
    /* Results of the computation: statement on the material, and share of the hysteresis from
     * frequencies outside its range (NaN if not requested). */
    char statement[512];
    double extrapolated_share;
} case_variant;

/* Results at the reference velocity. */
typedef enum case_quantity {
    CASE_QUANTITY_HYSTERESIS,
    CASE_QUANTITY_AREA_RATIO,
    CASE_QUANTITY_FRICTION,
    CASE_QUANTITY_THICKNESS,
    CASE_QUANTITY_WITH_LAYER,
    CASE_QUANTITIES
} case_quantity;
extern const char *const case_quantity_names[CASE_QUANTITIES];

/* Creates a variant of the case as used. A NULL `layer` means no thickness; a NULL `observation`
 * means no friction with a layer. With both, the thickness is that of `layer`. */
wt_status case_variant_create(const wt_sliding *sliding, const wt_layer_job *layer,
                              const wt_layer_observation *observation, const wt_job *work,
                              case_variant *s, wt_error *err) WT_NODISCARD;
/* Returns the largest wavenumber to which the counter surface is known, or that a surface has. */
double case_variant_highest_wavenumber(const case_variant *s);
/* Computes the results. number: [CASE_QUANTITIES]; results that do not apply stay unchanged. */
wt_status case_variant_compute(case_variant *s, const wt_job *work, wt_estimate *number,
                               wt_error *err) WT_NODISCARD;

#endif
