/* Angular integrals of a half-space with a bonded layer whose moduli have another frequency
 * dependence than the bulk. The effective stiffness differs for each wavenumber, so that J1 and J2
 * are integrated at each. Internal to friction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_LAYERED_MODULI_H
#define WT_FRICTION_NUMERICS_LAYERED_MODULI_H

#include "friction/numerics/angular.h"
#include "weartrack/friction.h"

/* Size of the quadrature over the angle. */
enum { ANGLE_NODES = 144, ANGLE_LEVELS = 2 }; /* levels: all nodes, every second node */
/* Capacity for the limits of the measured range of a ratio and of the ranges with zero loss
 * modulus. A series with many relaxation times has several such ranges; further ones are ignored.
 */
enum { LAYER_MAX_EDGES = 16 };

typedef struct layer_moduli {
    const wt_material *bulk; /* borrowed */
    wt_layer_state layer;
    double edges[LAYER_MAX_EDGES]; /* frequencies at which the layer's moduli are not smooth,
                                       rising [rad/s] */
    size_t n_edges;
    bool knots; /* the bulk has knots inside the smooth parts */
    size_t n;   /* number of nodes of one smooth part of a quarter turn */
    double fraction[ANGLE_NODES], share[ANGLE_NODES]; /* positions in the part, and weights */
    double below[ANGLE_LEVELS];                       /* weight of the range below the first node */
} layer_moduli;

/* Computes ln |ratio| relative to the reference, and the phase of the causal minimum-phase ratio
 * with this magnitude (Bode 1940, Kramers-Kronig relations). The phase is exponent pi/2 well inside
 * `low` and `high` and 0 far outside. omega > 0. */
void ratio_slope_eval(const wt_ratio_slope *slope, double omega, double *log_ratio, double *phase);
/* True if a layer has its own moduli. */
bool layer_has_moduli(const wt_layer_state *layer);
/* Shifts the frequencies of a slope from its temperature to another one by the law of the bulk. */
wt_status layer_slope_shift(const wt_shift_law *law, double to, wt_ratio_slope *slope,
                            wt_error *err) WT_NODISCARD;
layer_moduli layer_moduli_create(const wt_material *bulk, wt_layer_state layer, double tolerance);
/* |E_layer / E_bulk| at a frequency > 0. */
double layer_moduli_ratio(const layer_moduli *moduli, double omega);
/* Range of frequencies between `low` and `high` in which a falling ratio would give a negative loss
 * modulus, which is set to 0. False if there is none. */
bool layer_moduli_zero_loss_range(const layer_moduli *moduli, double low, double high,
                                  double range[2]);
/* J1 and J2 at n wavenumbers with their frequencies q v. loss_j2 receives the integral of the
 * squared loss modulus. `*error` is raised to the largest relative error. */
void layer_moduli_eval(const layer_moduli *moduli, const double *q, const double *omega, size_t n,
                       double *j1, double *j2, double *loss_j2, double *error);

#endif
