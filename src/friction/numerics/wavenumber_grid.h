/* Division of the wavenumber integrals into subintervals, and the nodes of a rule on them. Internal
 * to friction.
 *
 * t = ln(q / q0). The first subinterval [0, h] is graded towards t = 0, because P(G(t)) changes on
 * the scale where G passes 1, which may be close to q0. It has the cells [h/4, h], [h/16, h/4], ...
 * and one core [0, h/4^level], whose level is chosen at each velocity.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_WAVENUMBER_GRID_H
#define WT_FRICTION_NUMERICS_WAVENUMBER_GRID_H

#include "core/base/array.h"
#include "core/math/gauss_legendre.h"
#include "friction/numerics/softening_contact.h"
#include "weartrack/friction.h"

typedef enum subinterval_map {
    MAP_LINEAR,     /* t = s */
    MAP_LOGARITHM,  /* t = exp(s): the cells */
    MAP_SQUARE_ROOT /* t = anchor + s^2: right of a knot of the material */
} subinterval_map;

typedef struct grid_subinterval {
    double t_low, t_high;
    double anchor;
    double power; /* d ln(q^4 C) / d ln q */
    subinterval_map map;
} grid_subinterval;

/* Subintervals in rising t: cell[levels - 1] ... cell[0], then the others; the cores are separate.
 */
typedef struct subinterval_plan {
    double q0, q1;
    const strain_law *softening; /* borrowed; NULL if none */
    double width;                /* largest width in t; the first subinterval has at most the
                                    default width */
    const double *slopes;        /* borrowed, [n_knots + 1]; see material_slopes */
    double *powers;              /* [breaks of the roughness + 1] d ln(q^4 C) / d ln q */
    size_t levels;
    grid_subinterval *core;         /* [levels + 1] */
    size_t n_subintervals;          /* cells and other subintervals */
    grid_subinterval *subintervals; /* [capacity] */
    size_t capacity;
} subinterval_plan;

/* Default width for laws that may be steeper than a closed form. The distance pi/2 of a pole is 2.6
 * half widths; its ellipse reduces the error by a factor of 5 with each degree. */
#define SUBINTERVAL_WIDTH 1.2

/* Largest slope of |E|^2 with ln omega, into `slopes` [n_knots + 1]: below the first knot, between
 * two, and above the last. */
void material_slopes(const wt_material *material, const double *knots, size_t n_knots,
                     double *slopes);
/* Initialises a plan for these knots (in any unit of frequency) with the slopes of the material
 * (borrowed; NULL without knots) and up to n_cuts additional cuts. */
void subinterval_plan_init(subinterval_plan *plan, const wt_roughness *roughness, double width,
                           size_t levels, const double *knots, const double *slopes, size_t n_knots,
                           size_t n_cuts, const strain_law *softening, arena *memory);
/* Fills the plan. Subintervals end at the breaks of roughness and softening, at `cuts` (rising t)
 * and at `knots`. Knots have square-root maps to their right; they rise in t and may lie outside
 * the range. `bounds` is scratch memory for capacity + 1 numbers. */
void subinterval_plan_fill(subinterval_plan *plan, const wt_roughness *roughness,
                           const double *cuts, size_t n_cuts, const double *knots, size_t n_knots,
                           double *bounds);

/* Returns the lower or the upper half of a subinterval. */
grid_subinterval grid_half(const grid_subinterval *subinterval, bool upper);

/* Nodes of one rule on a plan; each subinterval and core is computed on request. The factors
 * contain q^4 C(q) dt/ds and the scale of a layered modulus:
 * int k^3 C J1 s dk -> sum of half_width weight factor1 J1, with s^2 in factor2. */
typedef struct scale_grid {
    const gauss_rule *rule;
    /* [(capacity + 1) * n] the last one is for part of a subinterval */
    double *t, *q, *factor1, *factor2;
    double *half_width; /* [capacity + 1] 0 if not yet computed */
    double *core_t, *core_q, *core_factor1, *core_factor2; /* [(levels + 1) * n] */
    double *core_half_width;                               /* [levels + 1] 0 if not yet computed */
    /* values at the same nodes; NULL without softening */
    double *f, *g, *core_f, *core_g;
} scale_grid;

/* Allocates the nodes for any plan of this capacity. The rule is borrowed. */
void grid_init(scale_grid *grid, const subinterval_plan *plan, const gauss_rule *rule,
               arena *memory);
/* Discards the computed nodes. */
void grid_reset(scale_grid *grid, const subinterval_plan *plan);
/* Computes the subintervals from `first` up to, but not including, `last`. */
void grid_fill_subintervals(scale_grid *grid, const subinterval_plan *plan, size_t first,
                            size_t last, const wt_roughness *roughness,
                            const wt_layer_state *layer);
/* Computes part of a subinterval, stored in the last position. */
void grid_fill_partial_subinterval(scale_grid *grid, const subinterval_plan *plan,
                                   const grid_subinterval *part, const wt_roughness *roughness,
                                   const wt_layer_state *layer);
void grid_fill_core(scale_grid *grid, const subinterval_plan *plan, size_t level,
                    const wt_roughness *roughness, const wt_layer_state *layer);

#endif
