/* Flash temperature over the length scales of the roughness. Internal to friction.
 *
 *   T(q) = T0 + int g(q, q') f(q') dq'
 *   f(q) = v / (rho c) q^4 C S r(q) J1(q v a_T(T(q))),    r = P(q) / P_m
 *   g = 1/pi int_0^inf dk m(k) 4q'/(k^2 + 4q'^2) 4q^2/(k^2 + 4q^2),
 *   m = (1 - exp(-D k^2 R/v)) / (D k^2)
 *
 * Persson, J. Phys.: Condens. Matter 18 (2006) 7789. The integral over k is evaluated numerically:
 * a trapezoidal rule in ln k converges exponentially, and its terms separate into factors of q and
 * of q'.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FLASH_TEMPERATURE_H
#define WT_FRICTION_NUMERICS_FLASH_TEMPERATURE_H

#include "core/base/array.h"
#include "core/math/gauss_legendre.h"
#include "weartrack/friction.h"

/* T(q) = T0 + constant + sum of amount[j] 4 q^2 / (k^2 + 4 q^2) over the k of a lattice. */
typedef struct heat_profile {
    const struct flash_law *law;
    const double *square; /* k^2 */
    double *amount;       /* [n] */
    size_t n;
    double constant; /* rise due to waves much longer than all length scales [K] */
} heat_profile;

/* Rise above T0 at n wavenumbers [K], and ln(a_T / a_T0) there. */
void heat_rise(const heat_profile *heat, const double *q, size_t n, double *rise);
void heat_log_shift(const heat_profile *heat, const double *q, size_t n, double *log_shift);

/* Number of matrix rows that are summed at a time. */
enum { FLASH_ROWS = 4 };
static inline size_t flash_padded_rows(size_t n)
{
    return (n + FLASH_ROWS - 1) / FLASH_ROWS * FLASH_ROWS;
}

/* Gauss nodes on subintervals of ln q, and a lattice of ln k. Beyond the end of the lattice both
 * factors of the kernel equal those of k = 0, so that these waves contribute one number for each
 * velocity. */
typedef struct flash_grid {
    const gauss_rule *rule;
    size_t n, n_subintervals;   /* n is the total number of nodes */
    double *q, *log_q, *weight; /* weight repeats the weights of the rule */
    /* as in scale_grid, times the half width; f and g are NULL without softening */
    double *factor1, *factor2, *f, *g;
    double step, below; /* step of ln k; extension of the lattice below 1/tau^(1/2) or q0 */
    double first;       /* the largest ln k */
    size_t n_k;         /* a multiple of FLASH_ROWS; `in` has a multiple of rows, too, of which the
                           last are 0 */
    double *square;     /* [n_k] k^2, falling */
    double *in, *out;   /* 4 q / (k^2 + 4 q^2) by node and k; the same times q, by k and node */
} flash_grid;

typedef struct flash_law {
    wt_flash options;
    wt_shift_law shift;
    double temperature, log_a; /* T0 and ln a_T there */
    double hottest;            /* largest rise above T0 [K] */
    double tolerance;
    double q0;
    flash_grid grid;
} flash_law;

typedef struct flash_scratch flash_scratch;
struct wt_friction_workspace;
struct friction_load;

/* ln(a_T / a_T0) at n rises; NaN where the law has no value. */
void flash_log_shift(const flash_law *law, const double *rise, size_t n, double *log_shift);
/* Creates the law of a workspace whose material, roughness and tolerance are set. */
wt_status flash_new(struct wt_friction_workspace *ws, wt_error *err) WT_NODISCARD;

/* Returns NULL, or leaves a failed arena, if out of memory. */
flash_scratch *flash_scratch_new(const struct wt_friction_workspace *ws, arena *memory);

/* Self-consistent temperature of one load. */
typedef struct flash_solution {
    bool found;
    double rise;                 /* rise at q1 [K] */
    double gain;                 /* factor from an error of the heat to that of T */
    double rise_error;           /* error of T without that of the rules [K] */
    double variance, hysteresis; /* from the nodes of this grid; the comparison with a pass gives
                                    the error of the rules */
    double steepest;             /* largest |d ln a_T / dT| [1/K] */
    size_t maps;                 /* number of evaluations of the map */
    heat_profile heat;
} flash_solution;

/* Solution from the temperature of the surroundings on; if there is none, from far above it. */
flash_solution flash_solve(const struct wt_friction_workspace *ws, flash_scratch *scratch,
                           const struct friction_load *at);
/* Returns the number of nodes at which J1 and J2 were evaluated, and resets the count. */
size_t flash_reset_node_count(flash_scratch *scratch);

#endif
