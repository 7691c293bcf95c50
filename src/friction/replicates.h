/* Standard errors from Monte Carlo replicates: choice of the errors, drawing, standard deviation.
 * Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_REPLICATES_H
#define WT_FRICTION_REPLICATES_H

#include "friction/material_cache.h"
#include "job/random_draws.h"

/* Capacity above the eleven stated errors of a contact and its layer. */
enum { REPLICATES_MAX_DRAWS = 12 };

typedef struct replicates {
    const wt_sliding *sliding;
    const wt_job *work;
    double velocity;          /* the only velocity [m/s]; 0 for those of the list and the
                                 reference */
    wt_material_cache *drawn; /* cache; set while replicates are drawn */
    const char *quantity;     /* "friction", for messages */
    flow_draw draw[REPLICATES_MAX_DRAWS]; /* [n_draws] identifiers of the normal deviates */
    size_t n_draws;
    bool varies;                    /* at least one error is stated or measured */
    char includes[256], lacks[256]; /* text: error sources that are drawn, and inputs without a
                                       stated error */
    double *error;                  /* [stride] standard errors; NaN without replicates */
    double *value;                  /* [n * stride] */
    size_t n, stride;
} replicates;

/* Collects the errors of a sliding contact. The error of the shear stress is not included, because
 * only the total friction depends on it. */
replicates replicates_create(const wt_sliding *sliding, const wt_job *work, const char *what);
/* Adds an error source. It is drawn by `draw` if its standard error is > 0, and listed as missing
 * otherwise. */
void replicates_add(replicates *r, double standard_error, flow_draw draw, const char *words);
/* Adds the errors of the modulus of a layer. `ratio` is the text for the modulus ratio. */
void replicates_add_layer(replicates *r, const wt_layer_observation *observation,
                          const char *ratio);
/* Returns the text of the error sources that are drawn, for a table. */
const char *replicates_included_errors(const replicates *r);

/* Computes one replicate: `stride` numbers, the first of which is not NaN. */
typedef wt_status (*replicate_fn)(const void *user, size_t replicate, double *out, wt_error *err);
/* Draws all replicates and computes `error`. The effect of each draw is approximated as linear. A
 * draw is standard normal, so that its variance is exact; the replicates give its slope and the
 * residual, which holds the material and nonlinear effects. Replicates without a solution are
 * excluded and counted. */
wt_status replicates_draw(replicates *r, size_t stride, replicate_fn one, const void *user,
                          wt_error *err) WT_NODISCARD;
void replicates_clear(replicates *r);

#endif
