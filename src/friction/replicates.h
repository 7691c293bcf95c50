/* Standard errors from replicates: which errors are drawn, drawing them, the scatter. Internal to
 * flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_REPLICATES_H
#define WT_FRICTION_REPLICATES_H

#include "friction/material_cache.h"
#include "job/random_draws.h"

/* More than the stated errors of a contact and its layer, which are eleven. */
enum { REPLICATES_MOST = 12 };

typedef struct replicates {
    const wt_sliding *sliding;
    const wt_job *work;
    double velocity;          /* the only one [m/s]; 0: those of the list and the reference */
    wt_material_cache *drawn; /* while they are drawn */
    const char *what;         /* "friction", for messages */
    flow_draw draw[REPLICATES_MOST]; /* [n_draws] the normal numbers that are drawn */
    size_t n_draws;
    bool varies;                    /* an error is stated or measured: there are replicates */
    char includes[256], lacks[256]; /* in words: what is drawn, what has no stated error */
    double *error;                  /* [stride] standard errors, NaN without replicates */
    double *value;                  /* [n * stride] */
    size_t n, stride;
} replicates;

/* With the errors of a sliding contact but for that of the shear stress, which only the total
 * friction knows. */
replicates replicates_of(const wt_sliding *sliding, const wt_job *work, const char *what);
/* Something else that is drawn by `draw` (standard_error > 0), or would be if its error were
 * stated. */
void replicates_add(replicates *r, double standard_error, flow_draw draw, const char *words);
/* What the modulus of a layer has errors of. `ratio`: in words. */
void replicates_add_layer(replicates *r, const wt_sliding *sliding,
                          const wt_layer_observation *known, const char *ratio);
/* What is drawn, as said in a table. */
const char *replicates_include(const replicates *r);

/* One replicate: `stride` numbers, the first of them not NaN. */
typedef wt_status (*replicate_fn)(const void *user, size_t replicate, double *out, wt_error *err);
/* Draws all and finds `error`: what each number that is drawn does is a line, whose share is known
 * without scatter, for the number is standard normal; the draws give its slope and the rest, the
 * material and what is not straight. A replicate that has no solution is left out and counted. */
wt_status replicates_draw(replicates *r, size_t stride, replicate_fn one, const void *user,
                          wt_error *err) WT_NODISCARD;
/* Where each replicate lies along the line of number k, in standard deviations of the line: a
 * standard normal number, of which the replicates have but a sample. at [n]; not known: too few for
 * a line, or nothing that is drawn does anything. */
wt_status replicates_along_line(const replicates *r, size_t k, double *at,
                                bool *known) WT_NODISCARD;
void replicates_clear(replicates *r);

#endif
