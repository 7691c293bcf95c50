/* Effect of a worn tip on the modulus: the force curve of the worn tip is fitted by the law of the
 * stated tip with modulus and contact point.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/study.h"

#include <math.h>

/* Depths of the curve, and steps of the search for the contact point: to 1e-6 of the depth. */
enum { NODES = 64, STEPS = 30 };

/* Weights of the residuals. Noise of the force also moves the tip, so that a residual counts less
 * by 1 + contact stiffness over spring constant. Samples are equidistant along the piezo, which
 * travels further than the tip by this factor. */
typedef struct worn_curve {
    const wt_contact_table *stated;
    double depth;                       /* largest depth of the equidistant nodes [m] */
    double force[NODES], travel[NODES]; /* 1 + contact stiffness over spring constant */
} worn_curve;

/* Returns the residual sum of squares with the contact point late by `shift`, and the modulus. */
static double wear_residual_squares(const worn_curve *c, double shift, double *modulus)
{
    double at[NODES], g[NODES], gg = 0, gf = 0, ff = 0;
    for (int i = 0; i < NODES; i++)
        at[i] = c->depth * (i + 1) / NODES - shift;
    wt_contact_table_eval(c->stated, at, NODES, g, NULL);
    for (int i = 0; i < NODES; i++) {
        const double weight = 1 / c->travel[i];
        gg += weight * g[i] * g[i];
        gf += weight * g[i] * c->force[i];
        ff += weight * c->force[i] * c->force[i];
    }
    *modulus = gf / gg;
    return fmax(0, ff - gf * gf / gg);
}

wt_status wt_tip_wear_fit(const wt_tip *tip, double radius, double depth, double bending,
                          wt_tip_wear *fit, wt_error *err)
{
    const double section = 0.5 * (3 - sqrt(5)); /* ratio of the golden section search */
    wt_contact_table *table = NULL;
    wt_tip worn = *tip;
    worn.radius = radius;
    worn.transition_radius = wt_tip_tangent_transition(radius, tip->half_angle);
    wt_status status = wt_contact_table_new(tip, 1e-3 * depth, 2 * depth, &table, err);
    if (status != WT_OK)
        return status;
    worn_curve c = {.stated = table, .depth = depth};
    double samples = 0, slope, largest;
    wt_contact_function(&worn, depth, &largest, &slope);
    for (int i = 0; i < NODES; i++) {
        wt_contact_function(&worn, depth * (i + 1) / NODES, &c.force[i], &slope);
        c.travel[i] = 1 + bending * slope / largest;
        samples += c.travel[i];
    }
    double low = -depth / 2, high = depth / 2, modulus;
    double a = low + section * (high - low), b = high - section * (high - low);
    double of_a = wear_residual_squares(&c, a, &modulus),
           of_b = wear_residual_squares(&c, b, &modulus);
    for (int step = 0; step < STEPS; step++) {
        if (of_a < of_b) {
            high = b;
            b = a;
            of_b = of_a;
            a = low + section * (high - low);
            of_a = wear_residual_squares(&c, a, &modulus);
        } else {
            low = a;
            a = b;
            of_a = of_b;
            b = high - section * (high - low);
            of_b = wear_residual_squares(&c, b, &modulus);
        }
    }
    const double left = wear_residual_squares(&c, 0.5 * (low + high), &modulus);
    *fit = (wt_tip_wear){log(modulus), sqrt(left / samples) / largest};
    wt_contact_table_free(table);
    return WT_OK;
}
