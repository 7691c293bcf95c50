/* Friction predicted at the steps of records, for the nominal values and for their draws. Internal
 * to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_PREDICTED_FRICTION_H
#define WT_RECORD_PREDICTED_FRICTION_H

#include "friction/replicates.h"
#include "record/measured_friction.h"

/* Friction is hysteresis + tau_f x friction_per_shear. */
typedef enum prediction_part {
    PART_HYSTERESIS,
    PART_BY_SHEAR, /* [1/Pa] */
    PART_HYSTERESIS_LAYER,
    PART_BY_SHEAR_LAYER,
    PARTS
} prediction_part;

typedef struct prediction {
    size_t n, n_draws; /* steps; draws, of which the first n_lines numbers are drawn */
    bool layered;
    double *part;  /* [(1 + n_draws) * PARTS * n] nominal values first */
    double *shear; /* [1 + n_draws] tau_f [Pa]; NaN if not stated */
    flow_draw line[REPLICATES_MAX_DRAWS];
    size_t n_lines;
    double zero_loss_range[2]; /* range where the loss modulus of the layer is set to 0; NaN if
                             nowhere */
} prediction;

/* Predicts friction. A NULL observation means no layer. Without `draws` only nominal values are
 * computed. The caller clears `p`, also after a failure. */
wt_status predict_friction(const wt_sliding *sliding, const wt_layer_observation *observation,
                           const measured *steps, const wt_job *work, bool draws, prediction *p,
                           wt_error *err) WT_NODISCARD;
void prediction_clear(prediction *p);

/* Returns a component of the nominal values (k = 0) or of draw k - 1. */
double prediction_part_value(const prediction *p, size_t k, prediction_part part, size_t step);
/* hysteresis + shear x friction_per_shear. */
double prediction_total(const prediction *p, size_t k, bool layered, size_t step, double shear);

#endif
