/* Internal to the kernel room: the angular integrals of a half-space under a bonded layer whose
 * moduli go with the frequency in another way than those of the bulk. Its stiffness is that of no
 * material, but of one for each wavenumber: J1 and J2 are integrated anew at each.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_LAYERED_MODULI_H
#define WT_FRICTION_NUMERICS_LAYERED_MODULI_H

#include "friction/numerics/angular_weight.h"
#include "weartrack/kernel.h"

/* Of the quadrature over the angle. */
enum { ANGLE_NODES = 144, ANGLE_LEVELS = 2 }; /* all nodes, every second */
/* Ends of what was measured of a ratio, and of where its loss modulus is taken as 0: a series of
 * many times has several such stretches. Those beyond are not looked for. */
enum { LAYER_MOST_EDGES = 16 };

typedef struct layer_moduli {
    const wt_material *bulk; /* borrowed, as the material of the layer */
    wt_layer_state layer;
    const angular_weight *weight;   /* of anisotropic roughness, borrowed; NULL: none */
    double edges[LAYER_MOST_EDGES]; /* where the layer's moduli are not smooth, rising [rad/s] */
    size_t n_edges;
    double limit[2]; /* of what the layer's moduli are known for [rad/s]; NaN: not limited */
    bool knots;      /* inside of its parts a material has some */
    size_t n;        /* nodes of one smooth part of a quarter turn, */
    double fraction[ANGLE_NODES], share[ANGLE_NODES]; /* of it, and their weights */
    double below[ANGLE_LEVELS];                       /* weight of what lies below the first */
} layer_moduli;

/* Whether a layer has moduli of its own. */
bool layer_has_moduli(const wt_layer_state *layer);
/* The frequencies of a slope from its temperature to another one, by the law of the bulk. */
wt_status layer_slope_shift(const wt_shift_law *law, double to, wt_ratio_slope *slope,
                            wt_error *err) WT_NODISCARD;
layer_moduli layer_moduli_of(const wt_material *bulk, wt_layer_state layer, double tolerance);
/* |E_layer / E_bulk| at a frequency > 0. */
double layer_moduli_ratio(const layer_moduli *moduli, double omega);
/* Between two frequencies, where a ratio that falls with the frequency would make a loss modulus
 * below 0, which is taken as 0: the first and the last of such; false: nowhere. */
bool layer_moduli_gain(const layer_moduli *moduli, double low, double high, double range[2]);
/* At n wavenumbers, each with the frequency q v of its own, and its layer with one that is exp of
 * `further` times that (NULL: the same): J1 and J2, and with loss_j2 that of the
 * loss modulus alone. `*error` is raised to the largest relative error. */
void layer_moduli_eval(const layer_moduli *moduli, const double *q, const double *omega,
                       const double *further, size_t n, double *j1, double *j2, double *loss_j2,
                       double *error);

#endif
