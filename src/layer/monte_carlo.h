/* Monte Carlo draws of a layer, with the stated values and the replicates. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_MONTE_CARLO_H
#define WT_LAYER_MONTE_CARLO_H

#include "friction/replicates.h"
#include "layer/layer_energy.h"

/* Adds the error sources of a layer: wear; critical energy or observed thickness; shear
 * stress if it modifies the rubber. Returns the standard error of the second. */
double layer_replicates_add(replicates *r, const wt_sliding *sliding, const wt_layer_job *job);

/* The structure contains pointers to itself and must not be copied. */
typedef struct layer_draws {
    layer_context values;
    wt_layer_job stated, calibrated;
    const wt_layer_observation *observation; /* stated properties of the layer; NULL if none */
    replicates replicates;
    char moduli[512]; /* text about the moduli of the layer; "" if the ratio is constant or
                         unknown */
} layer_draws;

/* Initialises the draws; the caller clears them. The shear law is that of `observation`; NULL means
 * that the modulus of the layer is unknown. With `friction`, shear stress and modulus of the layer
 * are drawn, too. */
wt_status layer_draws_init(layer_draws *draws, const wt_sliding *sliding, const wt_layer_job *job,
                           const wt_layer_observation *observation, const wt_job *work,
                           const char *what, bool friction, wt_error *err) WT_NODISCARD;
/* Context of a replicate. The caller owns its job. */
wt_status layer_draws_replicate_context(const layer_draws *draws, size_t replicate,
                                        wt_layer_job *job, layer_context *context,
                                        wt_error *err) WT_NODISCARD;
/* Writes the error sources: "pressure, roughness; no error is known of: temperature". */
void layer_draws_describe(const layer_draws *draws, char *text, size_t size);
/* Modulus ratio of a layer without its own material; else NaN. */
wt_estimate layer_draws_modulus_ratio(const layer_draws *draws);
void layer_draws_clear(layer_draws *draws);

/* Number of replicates for each row of tables whose rows are hundreds of contacts or sections. It
 * suffices for the slopes of the at most ten draws. The keys use all replicates. */
enum { LAYER_ROW_REPLICATES = 64 };

/* 95 % interval of a positive quantity whose logarithm is quantity k of the replicates. The limits
 * are quantiles of the replicates (replicate_interval), because the dependence on the draws may be
 * nonlinear. With few replicates the logarithm is taken as normal. There is no interval if too many
 * replicates have no value. */
wt_interval layer_draws_interval(const layer_draws *draws, size_t k, double value);
/* Writes "yes: ...", or "cannot say: in 12 % of the replicates OTHER". OTHER is `without` if the
 * stated value is finite, else `with`. */
void layer_draws_assess(const layer_draws *draws, size_t k, double value, const char *without,
                        const char *with, char *text, size_t size);

#endif
