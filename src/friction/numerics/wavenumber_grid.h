/* Internal to the kernel room: where the integrals over the wavenumber are cut into panels, and the
 * nodes of a rule on them.
 *
 * t = ln(q / q0). The first panel [0, h] is graded towards t = 0, because P(G(t)) changes on the
 * scale where G passes 1, however close to q0 that is: cells [h/4, h], [h/16, h/4], ... and one
 * core [0, h/4^level], whose level is chosen at each velocity.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_WAVENUMBER_GRID_H
#define WT_FRICTION_NUMERICS_WAVENUMBER_GRID_H

#include "core/base/arena.h"
#include "core/math/gauss_legendre.h"
#include "friction/numerics/softening_contact.h"
#include "weartrack/kernel.h"

typedef enum panel_map {
    MAP_LINEAR,     /* t = s */
    MAP_LOGARITHM,  /* t = exp(s): the cells */
    MAP_SQUARE_ROOT /* t = anchor + s^2: right of a knot of the material */
} panel_map;

typedef struct grid_panel {
    double t_low, t_high;
    double anchor;
    double power; /* d ln(q^4 C) / d ln q */
    panel_map map;
} grid_panel;

/* Panels in rising t: cell[levels - 1] ... cell[0], then the others; cores apart. */
typedef struct panel_plan {
    double q0, q1;
    const strain_law *softening; /* borrowed, NULL = none */
    double width;                /* of panels in t, at most; the first one is no wider than usual */
    const double *slopes;        /* borrowed, [n_knots + 1]: see below */
    double *powers;              /* [breaks of the roughness + 1] d ln(q^4 C) / d ln q */
    size_t levels;
    grid_panel *core;   /* [levels + 1] */
    size_t n_panels;    /* levels cells and the others */
    grid_panel *panels; /* [capacity] */
    size_t capacity;
} panel_plan;

/* The usual width, of laws whose moduli may be steeper than those of a closed form (friction.c):
 * pi/2 of a pole over half of it is 2.6, and its ellipse takes 5 off an error with each degree. */
#define PANEL_WIDTH 1.2

/* How steeply |E|^2 rises at most with ln omega, into `slopes` [n_knots + 1]: below the first knot,
 * between two, and above the last. */
void grid_slopes(const wt_material *material, const double *knots, size_t n_knots, double *slopes);
/* Room for a plan with these knots (of any one unit of frequency), where the material is so steep
 * (borrowed; NULL without knots), and up to n_cuts cuts besides those of roughness and softening.
 * The pool tells whether there was memory. */
void panel_plan_init(panel_plan *plan, const wt_roughness *roughness, double width, size_t levels,
                     const double *knots, const double *slopes, size_t n_knots, size_t n_cuts,
                     const strain_law *softening, arena *memory);
/* Lays the panels: cut at the breaks of roughness and softening, at `cuts` (plain, t rising) and at
 * `knots` (of the material: square-root maps to their right; t rising, also outside the range).
 * `bounds` is scratch for capacity + 1 numbers. */
void panel_plan_lay(panel_plan *plan, const wt_roughness *roughness, const double *cuts,
                    size_t n_cuts, const double *knots, size_t n_knots, double *bounds);

/* The lower or the upper half of a panel. */
grid_panel grid_half(const grid_panel *panel, bool upper);

/* Nodes of one rule on a plan, each panel and core made when it is asked for. The factors hold
 * q^4 C(q) dt/ds and the scale of a layered modulus:
 * int k^3 C J1 s dk -> sum of half_width weight factor1 J1, with s^2 in factor2. */
typedef struct scale_grid {
    const gauss_rule *rule;
    /* [(capacity + 1) * n], the last one for a part of a panel */
    double *t, *q, *factor1, *factor2;
    double *half_width;                                    /* [capacity + 1] 0: not made yet */
    double *core_t, *core_q, *core_factor1, *core_factor2; /* [(levels + 1) * n] */
    double *core_half_width;                               /* [levels + 1] likewise */
    /* at the same nodes, NULL without a softening */
    double *f, *g, *core_f, *core_g;
} scale_grid;

/* Likewise, for any plan of this capacity. The rule is borrowed. */
void grid_init(scale_grid *grid, const panel_plan *plan, const gauss_rule *rule, arena *memory);
/* Begins it anew. */
void grid_begin(scale_grid *grid, const panel_plan *plan);
/* Makes the panels from the `first` up to the `last` ready, which is left out; and the core of a
 * level. */
void grid_fill_panels(scale_grid *grid, const panel_plan *plan, size_t first, size_t last,
                      const wt_roughness *roughness, const wt_layer_state *layer);
/* A panel that is not in the plan, in the last place. */
void grid_fill_part(scale_grid *grid, const panel_plan *plan, const grid_panel *part,
                    const wt_roughness *roughness, const wt_layer_state *layer);
void grid_fill_core(scale_grid *grid, const panel_plan *plan, size_t level,
                    const wt_roughness *roughness, const wt_layer_state *layer);

#endif
