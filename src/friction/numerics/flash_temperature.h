/* Internal to the kernel room: flash temperature over the length scales of the roughness.
 *
 *   T(q) = T0 + int g(q, q') f(q') dq'
 *   f(q) = v / (rho c) q^4 C S r(q) J1(q v a_T(T(q))),    r = P(q) / P_m
 *   g = 1/pi int_0^inf dk m(k) 4q'/(k^2 + 4q'^2) 4q^2/(k^2 + 4q^2),
 *   m = (1 - exp(-D k^2 R/v)) / (D k^2)
 *
 * Persson, J. Phys.: Condens. Matter 18 (2006) 7789. The integral over k is kept: a trapezoidal
 * rule in ln k converges exponentially, and what it sums separates into factors of q and of q'.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FLASH_TEMPERATURE_H
#define WT_FRICTION_NUMERICS_FLASH_TEMPERATURE_H

#include "core/base/arena.h"
#include "core/math/gauss_legendre.h"
#include "weartrack/kernel.h"

/* T(q) = T0 + constant + sum of amount[j] 4 q^2 / (k^2 + 4 q^2) over the k of a lattice. */
typedef struct heat_profile {
    const struct flash_law *law;
    const double *square; /* k^2 */
    double *amount;       /* [n] */
    size_t n;
    double constant; /* of waves so long that they see no difference between the scales */
} heat_profile;

/* Above T0, at n wavenumbers, and ln(a_T / a_T0) there. */
void heat_rise(const heat_profile *heat, const double *q, size_t n, double *rise);
void heat_log_shift(const heat_profile *heat, const double *q, size_t n, double *log_shift);
/* The same of flash_log_layer. */
void heat_log_layer(const heat_profile *heat, const double *q, size_t n, double *log_further);

/* Two grids: on the coarse one a solution is looked for, on the fine one it is found. */
enum { FLASH_COARSE, FLASH_FINE, FLASH_GRIDS };
/* So many rows of a matrix are added up at a time. */
enum { FLASH_ROWS = 4 };
static inline size_t flash_whole_rows(size_t n)
{
    return (n + FLASH_ROWS - 1) / FLASH_ROWS * FLASH_ROWS;
}

/* Gauss nodes on panels of ln q, and a lattice of ln k. Beyond its end both factors of the kernel
 * are those of k = 0, so that the waves there are one number of each velocity. */
typedef struct flash_grid {
    const gauss_rule *rule;
    size_t n, n_panels;         /* n nodes in all */
    double *q, *log_q, *weight; /* the weights of the rule, over and over */
    /* as in scale_grid, times the half width; f and g NULL without a softening */
    double *factor1, *factor2, *f, *g;
    double step, below; /* of ln k; how far below 1/tau^(1/2) or q0 it counts */
    double first;       /* the largest ln k */
    size_t n_k;     /* a multiple of FLASH_ROWS, as the rows of `in` are, of which the last are 0 */
    double *square; /* [n_k] k^2, falling */
    double *in, *out; /* 4 q / (k^2 + 4 q^2) by node and k; by k and node, times q */
} flash_grid;

typedef struct flash_law {
    wt_flash options;
    wt_shift_law shift;
    double temperature, log_a; /* T0 and ln a_T there */
    wt_shift_law layer_shift;  /* of a layer's own material; none: it is shifted as the bulk */
    double layer_log_a;        /* ln a_T of that at T0 */
    double hottest;            /* above T0 [K] */
    double tolerance;
    double q0;
    flash_grid grid[FLASH_GRIDS];
    double *refine; /* [nodes of a fine panel * of a coarse one] values at the fine nodes */
} flash_law;

typedef struct flash_scratch flash_scratch;
struct wt_friction_workspace;
struct friction_load;

/* ln(a_T / a_T0) at n rises; NaN where the law has none. */
void flash_log_shift(const flash_law *law, const double *rise, size_t n, double *log_shift);
/* Whether a layer's own material is shifted by another law, and ln of how much further than the
 * bulk at n rises. */
bool flash_has_layer(const flash_law *law);
void flash_log_layer(const flash_law *law, const double *rise, size_t n, double *log_further);
/* Of the workspace, whose material, roughness and tolerance are known. */
wt_status flash_new(struct wt_friction_workspace *ws, wt_error *err) WT_NODISCARD;

/* NULL or a failed pool when out of memory. */
flash_scratch *flash_scratch_new(const struct wt_friction_workspace *ws, arena *memory);

/* A solution. */
typedef struct flash_solution {
    bool found;
    double rise;                 /* at q1 [K] */
    double gain;                 /* an error of the heat makes so many times as much of T */
    double off;                  /* [K] what T may be wrong by but for the rules */
    double variance, hysteresis; /* by the nodes here: better ones tell how good they are */
    double steepest;             /* |d ln a_T / dT|, the largest */
    size_t maps;                 /* of temperatures to those that they make */
    heat_profile heat;
} flash_solution;

/* From the temperature of the surroundings, and (hot) from far above it; a hot one that is the same
 * as a cold one is not found. */
flash_solution flash_solve(const struct wt_friction_workspace *ws, flash_scratch *scratch,
                           const struct friction_load *at);
flash_solution flash_solve_hot(const struct wt_friction_workspace *ws, flash_scratch *scratch,
                               const struct friction_load *at, const flash_solution *cold);
/* J1 and J2 were evaluated at so many nodes since the last call. */
size_t flash_nodes(flash_scratch *scratch);

#endif
