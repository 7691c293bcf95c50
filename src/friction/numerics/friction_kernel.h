/* Internal to the kernel room: the prepared friction integral and one pass of it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FRICTION_KERNEL_H
#define WT_FRICTION_NUMERICS_FRICTION_KERNEL_H

#include "friction/numerics/angular.h"
#include "friction/numerics/area_law.h"
#include "friction/numerics/flash_temperature.h"
#include "friction/numerics/layered_moduli.h"
#include "friction/numerics/wavenumber_grid.h"

#include <float.h>

/* The rule for all panels, and the one that checks those for which it may not suffice. */
enum { RULE_FIRST, RULE_CHECK, FRICTION_RULES };

/* What one thread needs. */
typedef struct friction_scratch {
    panel_plan plan;                  /* of this velocity, where knots move with it */
    scale_grid grids[FRICTION_RULES]; /* of that, or of the plan of all velocities */
    size_t room;                      /* panels that there may be */
    double *knots;                    /* [n_knots] t */
    double *bounds;                   /* [room + 1] t */
    /* [(room + 2) * max nodes]: all panels, then one made anew, then the core */
    double *omega, *log_omega, *j1, *j2;
    double *rise, *full;        /* of G, and of the hysteresis at full contact */
    double *further;            /* ln of how much further a layer is shifted; NULL: as the bulk */
    double *loss_j1, *loss_j2;  /* likewise, of the loss modulus, with a softening */
    double *panel_mu, *panel_g; /* [room + 1]: parts of the last pass, */
    double *error_mu, *error_g; /* and the errors of its rules in them */
    /* [room + 1], by panel: G and the hysteresis at full contact by the first rule, and what an
     * error of G makes of the hysteresis */
    double *rough_g, *rough_mu, *of_variance;
    double own_error;     /* relative, of J1 and J2 of a layer with moduli of its own, at most */
    size_t nodes;         /* at which J1 and J2 were evaluated so far */
    flash_scratch *flash; /* NULL: no flash temperature */
    flash_solution heat;  /* of friction_heat */
} friction_scratch;

struct wt_friction_workspace {
    arena memory; /* of all that is pointed to below */
    const wt_material *material;
    const wt_roughness *roughness;
    wt_friction_options options;
    angular_law *angular;
    strain_law *softening; /* NULL: none */
    angular_law *loss;     /* of its loss modulus */
    angular_weight along;  /* of anisotropic roughness */
    bool anisotropic;
    struct friction_side *side; /* of its force to the side; NULL: none */
    layer_moduli *own;          /* of a layer that has some; NULL: none */
    wt_shift_law layer_law;     /* of its own material; none: that of the bulk */
    const area_law *area;       /* NULL: that of Persson */
    flash_law *flash;           /* NULL: the rubber is as warm as its surroundings */
    double stiffness;           /* 1 / (1 - nu^2) */
    double rounding; /* relative error of the integrals from rounding, but for that of J1, J2 */
    const double *knots;
    size_t n_knots;    /* of the material, rad/s */
    double *log_knots; /* [n_knots] */
    double *slopes;    /* [n_knots + 1] of the material between them */
    const gauss_rule *rules[FRICTION_RULES];
    panel_plan plan; /* of every velocity, for materials without knots */
    unsigned threads;
    friction_scratch *scratch; /* [threads] */
};

/* How hard and how fast. */
typedef struct friction_load {
    double pressure, speed;     /* speed >= 0 */
    double log_lowest;          /* ln(q0 speed) */
    double modulus, density;    /* factors of the moduli and of the spectrum, 1 */
    const flash_solution *heat; /* NULL: as warm as the surroundings at all scales */
} friction_load;

/* Without heat. */
friction_load friction_load_at(const wt_friction_workspace *ws, double pressure, double velocity);

/* What a pass begins with and how far it goes. */
typedef struct friction_effort {
    size_t level;   /* of the core, at least */
    size_t halves;  /* every panel is halved so many times */
    bool all_along; /* G up to each panel is to be as good as all of it, and no core taken in closed
                       form that could be resolved */
} friction_effort;

/* Of the tolerance, for the rules; the rest is for J1 and J2. */
#define FRICTION_SHARE 0.5

/* One pass. Parts: 0 is the core, then the panels from the innermost cell used. */
typedef struct friction_pass {
    double variance, hysteresis;
    double variance_error, hysteresis_error; /* from the rule and the closed form in the core */
    double outside; /* part of the hysteresis from frequencies outside the data */
    double variance_moved, hysteresis_moved; /* errors that come from those of J1 and J2 */
    size_t level;                            /* of the core */
    size_t nodes;
    size_t parts;             /* those of the plan */
    size_t piece, loss_piece; /* where to look for errors of J1 and J2 */
} friction_pass;

/* Contributions of the nodes of a pass, for the energy source; arrays that grow. */
typedef struct friction_record {
    double *q, *mu;
    size_t n, room;
    bool failed; /* for want of memory */
} friction_record;
void friction_record_add(friction_record *record, const double *q, const double *mu, size_t n);

/* Room for `n_cuts` more cuts than roughness and material make themselves. */
wt_status friction_scratch_init(friction_scratch *scratch, const wt_friction_workspace *ws,
                                size_t n_cuts, arena *memory, wt_error *err) WT_NODISCARD;

/* J1 and J2 at n wavenumbers and their frequencies, omega and x = ln omega, where a layer is
 * shifted `further` (ln, NULL: as the bulk), with a softening those of the loss modulus, too; under
 * a layer with moduli of its own those are in them, and its
 * `*error` is raised. */
void friction_moduli(const wt_friction_workspace *ws, const double *q, const double *omega,
                     const double *x, const double *further, size_t n, double *j1, double *j2,
                     double *loss_j1, double *loss_j2, double *error);
/* Of all threads and calls so far. */
size_t friction_nodes(const wt_friction_workspace *ws);

/* WT_E_RANGE unless pressure > 0 and the velocities are usable; then prepares J1 and J2. */
wt_status friction_prepare(wt_friction_workspace *ws, double pressure, const double *velocity,
                           size_t n, wt_error *err) WT_NODISCARD;
/* Lays the plan of this load with these extra cuts, or returns the common one. */
const panel_plan *friction_plan(const wt_friction_workspace *ws, friction_scratch *scratch,
                                const friction_load *at, const double *cuts, size_t n_cuts);
/* Evaluates all panels with the first rule, those again with the check for which it does not
 * suffice, and halves where that does not either. The record may be NULL. */
void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const panel_plan *plan, friction_effort effort, friction_load at,
                       bool with_outside, friction_record *record, friction_pass *pass);

/* Finds the temperatures of a load that the moduli then are shifted by; nothing without a flash
 * temperature. WT_E_CONVERGENCE if there are none to be found. */
wt_status friction_heat(const wt_friction_workspace *ws, friction_scratch *scratch,
                        friction_load *at, wt_error *err) WT_NODISCARD;

/* A point of a load by `compute`, at the temperatures that it makes, and its second solution. */
wt_status friction_heated_point(
    const wt_friction_workspace *ws, friction_scratch *scratch, friction_load at,
    wt_status (*compute)(const wt_friction_workspace *ws, friction_scratch *scratch,
                         const friction_load *at, wt_friction_point *point),
    wt_friction_point *point);
/* What the temperatures are wrong by [K], from a pass at them. */
double friction_heat_off(const flash_solution *solution, const friction_pass *pass);
/* Frequencies at n <= RULE_MOST wavenumbers, by the temperatures there, and ln of how much further
 * those of the layer go (NULL: not asked for). */
void friction_shift_nodes(const flash_solution *solution, const double *q, size_t n, double *omega,
                          double *log_omega, double *further);
/* Knots t of the material go to where the temperatures shift them. */
void friction_move_knots(const wt_friction_workspace *ws, const heat_profile *heat, double *knots);

/* Relative errors of G and of the hysteresis of a pass from J1 and J2 and from rounding. */
typedef struct friction_relative {
    double variance, hysteresis;
} friction_relative;
friction_relative friction_relative_error(const wt_friction_workspace *ws,
                                          const friction_pass *pass, friction_load at);

/* S P falls no faster than G to the power of minus this: P = erf(1/(2 sqrt G)) as G^(-1/2), and
 * S = gamma + (1 - gamma) P^2 as 1/G at most. */
#define FRICTION_AREA_POWER 1.5

/* Relative rounding error of a sum of positive terms that are each good to some ulps; what steep
 * integrands add stands in the workspace. */
#define FRICTION_ROUNDING (32 * DBL_EPSILON)

#endif
