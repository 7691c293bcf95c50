/* The own layer in time against closed forms of one wave, and against the own friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "layer_physics.h"

#include <math.h>
#include <stdlib.h>

static contact nominal(void)
{
    return (contact){.q0 = 2e3,
                     .qr = 4e3,
                     .q1 = 1e6,
                     .hurst = 0.8,
                     .c0 = 2e-17,
                     .pressure = 0.4e6,
                     .shear_stress = 5e6,
                     .poisson = 0.5,
                     .velocities = 1,
                     .velocity = {0.3},
                     .wear_rate = 1e-12,
                     .critical_energy = 2e10};
}

static void check_slide(slide *s, heat *h)
{
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    const contact c = nominal();
    const contact_truth truth = contact_solve(&c, &state, 100);
    double hysteresis, area, soft, whole;
    slide_make(&c, &state, c.velocity[0], s);
    heat_make(s, c.pressure, 0, h);
    slide_friction(s, c.pressure, 0, 1, &hysteresis, &area);
    check_near("hysteresis in a slide", hysteresis, truth.hysteresis[0], 1e-4);
    check_near("contact area in a slide", area, truth.area[0], 1e-4);
    check_near("balance in a slide", heat_balance(h), truth.thickness, 1e-3);
    /* a layer that holds all waves is that rubber, and one that none feels is none */
    slide_friction(s, c.pressure, 1e-13, 0.5, &soft, &area);
    check_near("a layer too thin", soft, hysteresis, 1e-4);
    slide_friction(s, 2 * c.pressure, 1, 2, &soft, &area);
    slide_friction(s, c.pressure, 0, 1, &whole, &area);
    check_near("a layer that is all", soft, whole, 1e-6);
    const own_ratio one = {0.3, 1e-12, 1, 1e-3, 1e9}, wide = {1, 0.1, 1, 1e-9, 1e9};
    slide_friction(s, c.pressure, 1e-6, 0.3, &soft, &area);
    check_near("a layer of one ratio", slide_on_own(s, &state, c.pressure, 1e-6, &one),
               soft + 0.3 * c.shear_stress * area / c.pressure, 1e-4);
    check_near("the phase of a power", own_phase(&wide, 1), 0.05 * acos(-1), 5e-3);
    check_near("a soft layer on a stiff one", layer_seen(1, 0.1), 0.308, 2e-3);
}

/* kappa = 2 q: thickness and first appearance are logarithms, and a load in parts is that load. */
static void check_history(slide *s, heat *h)
{
    static const rubber plain = {
        .equilibrium = 5e6, .n = 1, .strength = {1e8}, .tau = {1e-5}, .alpha = {1}, .gamma = {1}};
    const rubber_state state = {.rubber = &plain, .a = {1, 1}, .factor = 1};
    contact c = nominal();
    c.q0 = 1e5;
    c.q1 = c.qr = 1.0001e5;
    c.c0 = 1e-20;
    c.critical_energy = 1e9;
    c.wear_rate = 1e-15;
    slide_make(&c, &state, c.velocity[0], s);
    heat_make(s, c.pressure, 0, h);
    const double ratio = h->surface / (c.critical_energy * h->wear), kappa = 2.0001e5,
                 rate = kappa * h->wear, time = 0.5 / rate;
    const history whole = {.n = 1, .load = {h}},
                  parts = {.n = 3, .load = {h, h, h}, .lasts = {0.2 * time, 0.3 * time, time}};
    check_true("formation above wear", ratio > 2);
    const double thickness = log(ratio * (1 - exp(-rate * time))) / kappa,
                 first = -log(1 - 1 / ratio) / rate;
    check_near("thickness in time", history_thickness(&whole, time), thickness, 1e-4);
    check_near("first appearance", history_first(&whole, 10 * time), first, 1e-4);
    check_near("thickness by parts", history_thickness(&parts, time), thickness, 1e-4);
    check_near("first appearance by parts", history_first(&parts, 10 * time), first, 1e-4);
}

void check_layer_physics(void)
{
    slide *s = malloc(sizeof *s);
    heat *h = malloc(sizeof *h);
    if (s == NULL || h == NULL)
        abort();
    check_slide(s, h);
    check_history(s, h);
    free(s);
    free(h);
}
