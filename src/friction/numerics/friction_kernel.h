/* The prepared friction integral and one pass of it. Internal to friction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FRICTION_KERNEL_H
#define WT_FRICTION_NUMERICS_FRICTION_KERNEL_H

#include "friction/numerics/angular.h"
#include "friction/numerics/flash_temperature.h"
#include "friction/numerics/layered_moduli.h"
#include "friction/numerics/wavenumber_grid.h"
#include <float.h>

/* Rule for all subintervals, and rule that checks those where the first may be too coarse. */
enum { RULE_FIRST, RULE_CHECK, FRICTION_RULES };

/* Working memory of one thread. */
typedef struct friction_scratch {
    subinterval_plan plan;            /* plan of this velocity, if knots move with it */
    scale_grid grids[FRICTION_RULES]; /* nodes of this plan, or of the common plan */
    size_t capacity;                  /* capacity: number of subintervals */
    double *knots;                    /* [n_knots] t */
    double *bounds;                   /* [room + 1] t */
    /* [(room + 2) * max nodes] all subintervals, then one recomputed, then the core */
    double *omega, *log_omega, *j1, *j2;
    double *rise, *full;                    /* rise of G, and hysteresis at full contact */
    double *loss_j1, *loss_j2;              /* integrals of the loss modulus, with softening */
    double *subinterval_mu, *subinterval_g; /* [room + 1] parts of the last pass */
    double *error_mu, *error_g;             /* errors of the rules in these parts */
    /* [room + 1] for each subinterval: G and the hysteresis at full contact by the first rule, and
     * the effect of an error of G on the hysteresis */
    double *estimated_g, *estimated_mu, *variance_effect;
    double own_error;     /* largest relative error of J1 and J2 of a layer with its own moduli */
    size_t nodes;         /* number of nodes at which J1 and J2 were evaluated */
    flash_scratch *flash; /* NULL without flash temperature */
    flash_solution heat;  /* result of friction_solve_heat */
} friction_scratch;

struct wt_friction_workspace {
    arena memory; /* memory of the objects below */
    const wt_material *material;
    const wt_roughness *roughness;
    wt_friction_options options;
    angular_law *angular;
    strain_law *softening; /* NULL if none */
    angular_law *loss;     /* law of the loss modulus, with softening */
    layer_moduli *layer;   /* layer's own moduli; NULL if none */
    flash_law *flash;      /* NULL if the rubber has the temperature of its surroundings */
    double stiffness;      /* 1 / (1 - nu^2) */
    double rounding;       /* relative rounding error of the integrals, without that of J1 and J2 */
    const double *knots;
    size_t n_knots;    /* knots of the materials [rad/s] */
    double *log_knots; /* [n_knots] */
    double *slopes;    /* [n_knots + 1] slopes of the material between the knots */
    const gauss_rule *rules[FRICTION_RULES];
    subinterval_plan plan; /* common plan of all velocities, for materials without knots */
    unsigned threads;
    friction_scratch *scratch; /* [threads] */
};

/* Pressure and speed of a point. */
typedef struct friction_load {
    double pressure, speed;     /* speed >= 0 */
    double log_lowest;          /* ln(q0 speed) */
    const flash_solution *heat; /* NULL if all scales have the temperature of the surroundings */
} friction_load;

/* Creates a load without heat. */
friction_load friction_load_create(const wt_friction_workspace *ws, double pressure,
                                   double velocity);

/* Start and extent of the refinement of a pass. */
typedef struct friction_effort {
    size_t level;             /* lowest level of the core */
    size_t halves;            /* number of halvings of every subinterval */
    bool accurate_everywhere; /* G up to each subinterval is as accurate as the total, and no core
                       that can be resolved uses the closed form */
} friction_effort;

/* Share of the tolerance for the rules; the rest is for J1 and J2. */
#define FRICTION_RULE_SHARE 0.5

/* Result of one pass. Part 0 is the core; the subintervals follow from the innermost cell in use.
 */
typedef struct friction_pass {
    double variance, hysteresis;
    double variance_error, hysteresis_error; /* errors of the rules and of the closed form in the
                                                core */
    double outside; /* part of the hysteresis from extrapolated frequencies */
    double variance_input_error, hysteresis_input_error; /* errors propagated from J1 and J2 */
    size_t level;                                        /* level of the core */
    size_t nodes;
    size_t parts;             /* number of parts of the plan */
    size_t piece, loss_piece; /* start of the search for errors of J1 and J2 */
} friction_pass;

/* Contributions of the nodes of a pass, for the energy source. The arrays grow. The caller frees
 * them. */
typedef struct node_contributions {
    double *q, *mu;
    size_t n, capacity;
} node_contributions;
void node_contributions_add(node_contributions *record, const double *q, const double *mu,
                            size_t n);

/* Initialises the memory for plans with up to `n_cuts` cuts in addition to those of roughness and
 * material. */
void friction_scratch_init(friction_scratch *scratch, const wt_friction_workspace *ws,
                           size_t n_cuts, arena *memory);

/* J1 and J2 at n wavenumbers and their frequencies omega, x = ln omega. With softening, the
 * integrals of the loss modulus are computed, too. The own moduli of a layer are included, and
 * `*error` is raised to their largest relative error. */
void friction_moduli(const wt_friction_workspace *ws, const double *q, const double *omega,
                     const double *x, size_t n, double *j1, double *j2, double *loss_j1,
                     double *loss_j2, double *error);
/* Adds the errors of a part from J1, J2 and rounding; its n nodes have ln omega = `x`, and G so far
 * includes the part. The series have errors. Steep integrands also amplify the rounding of ln(q /
 * q0), ln omega and the logarithms of the knots. */
void friction_add_input_errors(const wt_friction_workspace *ws, double own_error,
                               const grid_subinterval *subinterval, const double *x,
                               const double *j1, const double *j2, size_t n, double log_lowest,
                               double variance, double hysteresis, double variance_so_far,
                               friction_pass *pass);
/* Total number of nodes of all threads and calls. */
size_t friction_node_count(const wt_friction_workspace *ws);

/* Returns WT_E_RANGE unless pressure > 0 and the velocities are valid; then prepares J1 and J2. */
wt_status friction_prepare(wt_friction_workspace *ws, double pressure, const double *velocity,
                           size_t n, wt_error *err) WT_NODISCARD;
/* Creates the plan of this load with these additional cuts, or returns the common one. */
const subinterval_plan *friction_plan(const wt_friction_workspace *ws, friction_scratch *scratch,
                                      const friction_load *at, const double *cuts, size_t n_cuts);
/* Evaluates all subintervals with the first rule, repeats those that need it with the rule of the
 * check, and halves those that still need it. The record may be NULL. */
void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const subinterval_plan *plan, friction_effort effort, friction_load at,
                       bool with_outside, node_contributions *record, friction_pass *pass);

/* Finds the temperatures of a load, by which its moduli are then shifted. Without flash temperature
 * it does nothing. Returns WT_E_CONVERGENCE if there is no solution. */
wt_status friction_solve_heat(const wt_friction_workspace *ws, friction_scratch *scratch,
                              friction_load *at, wt_error *err) WT_NODISCARD;

/* Computes a point by `compute` at its self-consistent temperatures, and its second solution. */
void friction_heated_point(const wt_friction_workspace *ws, friction_scratch *scratch,
                           friction_load at,
                           void (*compute)(const wt_friction_workspace *ws,
                                           friction_scratch *scratch, const friction_load *at,
                                           wt_friction_point *point),
                           wt_friction_point *point);
/* Error of the temperatures [K], from a pass at them. */
double friction_heat_error(const flash_solution *solution, const friction_pass *pass);
/* Shifts the frequencies at n <= GAUSS_NODES_MAX wavenumbers by the temperatures there. */
void friction_shift_nodes(const flash_solution *solution, const double *q, size_t n, double *omega,
                          double *log_omega);
/* Moves the knots t of the material according to the temperatures. */
void friction_shift_knots(const wt_friction_workspace *ws, const heat_profile *heat, double *knots);

/* Relative errors of G and of the hysteresis of a pass from J1, J2 and rounding. */
typedef struct friction_relative {
    double variance, hysteresis;
} friction_relative;
friction_relative friction_relative_error(const wt_friction_workspace *ws,
                                          const friction_pass *pass, friction_load at);

/* S P falls no faster than G to this negative power: P = erf(1/(2 sqrt G)) as G^(-1/2), and S =
 * gamma + (1 - gamma) P^2 at most as 1/G. */
#define FRICTION_AREA_POWER 1.5

/* Relative rounding error of a sum of positive terms with some ulps each; the workspace holds the
 * additional error of steep integrands. */
#define FRICTION_ROUNDING (32 * DBL_EPSILON)

#endif
