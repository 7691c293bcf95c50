/* Internal to the kernel room: the prepared friction integral and one pass of it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_KERNEL_FRICTION_H
#define WT_KERNEL_FRICTION_H

#include "kernel/angular.h"
#include "kernel/grid.h"

/* Rules of rising order; neighbours give a value and its error. */
enum { WT_FRICTION_RULES = 6, WT_FRICTION_MAX_NODES = 32 };

/* Differences of the rules, per panel [capacity + 1]: the last ones, and the next ones to come. */
typedef struct wt_friction_trend {
    double *last, *foretold;
} wt_friction_trend;

/* What one thread needs. */
typedef struct wt_friction_scratch {
    wt_plan plan;                       /* of this velocity, where knots move with it */
    wt_grid grid;                       /* likewise */
    double *knots;                      /* [n_knots] t */
    double *bounds;                     /* [capacity + 1] t */
    double *omega, *j1, *j2, *variance; /* [capacity * max nodes] */
    double *panel_mu[2], *panel_g[2];   /* [capacity + 1]; of two passes */
    wt_friction_trend trend_mu, trend_g;
} wt_friction_scratch;

struct wt_friction_workspace {
    const wt_material *material;
    const wt_roughness *roughness;
    wt_friction_options options;
    wt_angular *angular;
    double stiffness; /* 1 / (1 - nu^2) */
    const double *knots;
    size_t n_knots; /* of the material, rad/s */
    wt_rule *rules[WT_FRICTION_RULES];
    /* Materials without knots: one plan and its grids for every velocity. */
    wt_plan plan;
    wt_grid grids[WT_FRICTION_RULES];
    unsigned threads;
    wt_friction_scratch *scratch; /* [threads] */
};

/* The sliding conditions of a pass. */
typedef struct wt_friction_conditions {
    double pressure, speed; /* speed >= 0 */
} wt_friction_conditions;

/* One pass over a grid. Parts: 0 is the core, then the panels from the innermost cell used. */
typedef struct wt_friction_pass {
    double variance, hysteresis;
    double core_error; /* of the hysteresis, from the closed form in the core */
    double outside;    /* part of the hysteresis from frequencies outside the data */
    size_t nodes;
    size_t parts;
} wt_friction_pass;

/* Contributions of the nodes of a pass, for the energy source; arrays with room for all nodes. */
typedef struct wt_friction_record {
    double *q, *mu;
    size_t n;
} wt_friction_record;

/* Room for `n_cuts` more cuts than roughness and material make themselves. */
wt_status wt_friction_scratch_init(wt_friction_scratch *scratch, const wt_friction_workspace *ws,
                                   size_t n_cuts, wt_error *err) WT_NODISCARD;
void wt_friction_scratch_clear(wt_friction_scratch *scratch);

/* WT_E_RANGE unless pressure > 0 and the velocities are usable; then prepares J1 and J2. */
wt_status wt_friction_prepare(wt_friction_workspace *ws, double pressure, const double *velocity,
                              size_t n, wt_error *err) WT_NODISCARD;
/* The grid of a rule at a speed, after its plan was laid. */
const wt_grid *wt_friction_grid(const wt_friction_workspace *ws, wt_friction_scratch *scratch,
                                const wt_plan *plan, size_t rule);
/* Lays the plan of this speed with these extra cuts, or returns the common one. */
const wt_plan *wt_friction_plan(const wt_friction_workspace *ws, wt_friction_scratch *scratch,
                                double speed, const double *cuts, size_t n_cuts);
/* How deep the first panel must be graded. */
size_t wt_friction_level(const wt_friction_workspace *ws, wt_friction_scratch *scratch,
                         const wt_grid *grid, wt_friction_conditions at);
/* slot: which of the two panel arrays receives the parts. record may be NULL. */
void wt_friction_evaluate(const wt_friction_workspace *ws, wt_friction_scratch *scratch,
                          const wt_grid *grid, size_t level, wt_friction_conditions at,
                          unsigned slot, bool with_outside, wt_friction_record *record,
                          wt_friction_pass *pass);

/* Half the change of P when G moves by its error, and the same of 1 - P. */
double wt_friction_area_error(double variance, double variance_error);
double wt_friction_gap_error(double variance, double variance_error);
/* Relative rounding error of a sum of positive terms that are each good to some ulps. */
double wt_friction_rounding(void);

#endif
