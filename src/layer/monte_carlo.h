/* A table of the layer by the values themselves and by replicates. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_MONTE_CARLO_H
#define WT_LAYER_MONTE_CARLO_H

#include "friction/replicates.h"
#include "layer/layer_energy.h"

/* What is drawn of a layer: wear, and critical energy, observed thickness or barrier; the shear
 * stress where it modifies the rubber. Returns the standard error of the second. */
double layer_replicates_add(replicates *r, const wt_sliding *sliding, const wt_layer_job *job);

/* Points into itself: not to be copied. */
typedef struct layer_draws {
    layer_context values;
    wt_layer_job stated, calibrated;
    const wt_layer_observation *known; /* of the layer; NULL: none */
    replicates replicates;
    char moduli[512]; /* of the layer, in words; "": one ratio, or nothing is known */
} layer_draws;

/* With the shear stress of the layer as `known` has it (NULL: nothing is known of its modulus).
 * friction: shear stress and modulus of the layer are drawn, too. */
wt_status layer_draws_open(layer_draws *draws, const wt_sliding *sliding, const wt_layer_job *job,
                           const wt_layer_observation *known, const wt_job *work, const char *what,
                           bool friction, wt_error *err) WT_NODISCARD;
/* The scene of a replicate, whose job the caller keeps. */
wt_status layer_draws_context(const layer_draws *draws, size_t replicate, wt_layer_job *job,
                              layer_context *scene, wt_error *err) WT_NODISCARD;
/* "pressure, roughness; no error is known of: temperature". */
void layer_draws_describe(const layer_draws *draws, char *text, size_t size);
/* The ratio of a layer without a material of its own. */
wt_estimate layer_draws_ratio(const layer_draws *draws);
void layer_draws_clear(layer_draws *draws);

/* Rows of tables that are hundreds of contacts or sections are looked at by so many replicates,
 * enough for slopes of the ten numbers that are drawn at most; their keys by all. */
enum { LAYER_ROW_REPLICATES = 64 };

/* A number above 0 with its interval of 95 %, of which the replicates have the logarithm as their
 * number k: the ends are those of the replicates (replicate_interval), for what is asked for need
 * not be straight in what is drawn; of a few, as if the logarithm were normal. Where too many
 * replicates are without a number there is none. */
wt_interval layer_interval(const layer_draws *draws, size_t k, double value);
/* "yes: ...", or "cannot say: in 12 % of the replicates OTHER": `without` where the value is a
 * number and they have none, `with` where it is none. */
void layer_say_known(const layer_draws *draws, size_t k, double value, const char *without,
                     const char *with, char *text, size_t size);

#endif
