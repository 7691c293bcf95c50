/* Friction at self-consistent flash temperatures.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/root.h"
#include "core/math/simd.h"
#include "friction/numerics/friction_kernel.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* The rules of a pass adapt, those of the temperatures do not; their difference measures the error
 * of the heat. The factor allows for cancellation in the difference. */
static const double difference_factor = 3;

double friction_heat_error(const flash_solution *solution, const friction_pass *pass)
{
    const double mu = fabs(solution->hysteresis - pass->hysteresis);
    const double g = fabs(solution->variance - pass->variance);
    const double relative = fmax(pass->hysteresis > 0 ? mu / pass->hysteresis : 0,
                                 pass->variance > 0 ? g / pass->variance : 0);
    return solution->rise_error + difference_factor * solution->gain * relative * solution->rise;
}

void friction_shift_nodes(const flash_solution *solution, const double *q, size_t n, double *omega,
                          double *log_omega)
{
    double shift[GAUSS_NODES_MAX], factor[GAUSS_NODES_MAX];
    heat_log_shift(&solution->heat, q, n, shift);
    vector_exp(shift, n, factor);
    for (size_t i = 0; i < n; i++) {
        omega[i] *= factor[i];
        log_omega[i] += shift[i];
    }
}

/* Sets all results of a load without a solution to NaN. */
static void set_unsolved_point(wt_friction_point *point)
{
    const wt_estimate unknown = {(double)NAN, (double)NAN, (double)NAN, "1"};
    *point = (wt_friction_point){.stress_variance = unknown,
                                 .area_ratio = unknown,
                                 .one_minus_area = unknown,
                                 .hysteresis = unknown,
                                 .lateral = unknown,
                                 .extrapolated_share = (double)NAN,
                                 .has_no_solution = true,
                                 .temperature = {(double)NAN, (double)NAN, (double)NAN, "K"},
                                 .hot_branch = {(double)NAN, (double)NAN, (double)NAN}};
}

void friction_heated_point(const wt_friction_workspace *ws, friction_scratch *scratch,
                           friction_load at,
                           void (*compute)(const wt_friction_workspace *ws,
                                           friction_scratch *scratch, const friction_load *at,
                                           wt_friction_point *point),
                           wt_friction_point *point)
{
    const flash_solution cold = flash_solve(ws, scratch->flash, &at);
    set_unsolved_point(point);
    if (cold.found) {
        at.heat = &cold;
        point->has_no_solution = false;
        compute(ws, scratch, &at, point);
        const flash_solution hot = flash_solve_hot(ws, scratch->flash, &at, &cold);
        if (hot.found) {
            wt_friction_point other;
            at.heat = &hot;
            compute(ws, scratch, &at, &other);
            point->hot_branch = (wt_friction_branch){other.hysteresis.value, other.area_ratio.value,
                                                     other.temperature.value};
        }
    }
    scratch->nodes += flash_reset_node_count(scratch->flash);
}

wt_status friction_solve_heat(const wt_friction_workspace *ws, friction_scratch *scratch,
                              friction_load *at, wt_error *err)
{
    if (ws->flash == NULL || !(at->speed > 0))
        return WT_OK;
    scratch->heat = flash_solve(ws, scratch->flash, at);
    scratch->nodes += flash_reset_node_count(scratch->flash);
    if (!scratch->heat.found) {
        wt_fail(err, WT_E_CONVERGENCE, "no flash temperature was found");
        wt_error_found(err, "none at %g m/s and %g Pa", at->speed, at->pressure);
        wt_error_advice(err, "the rubber there would get hotter than 573 K, or its temperature "
                             "does not settle: compute without a flash temperature");
        return WT_E_CONVERGENCE;
    }
    at->heat = &scratch->heat;
    return WT_OK;
}

/* ---- knots ----------------------------------------------------------------------------------- */

typedef struct knot_crossing {
    const wt_roughness *roughness;
    const heat_profile *heat;
    double knot;
} knot_crossing;

static double knot_distance(double t, void *user)
{
    const knot_crossing *c = user;
    const double q = fmin(c->roughness->q0 + c->roughness->q0 * expm1(t), c->roughness->q1);
    double shift;
    heat_log_shift(c->heat, &q, 1, &shift);
    return t + shift - c->knot;
}

/* Moves each knot to the scale where the shifted frequency crosses it. A knot without a crossing is
 * left outside the range. */
void friction_shift_knots(const wt_friction_workspace *ws, const heat_profile *heat, double *knots)
{
    const wt_roughness *r = ws->roughness;
    const double length = log1p((r->q1 - r->q0) / r->q0);
    const double at_low = knot_distance(0, &(knot_crossing){r, heat, 0});
    const double at_high = knot_distance(length, &(knot_crossing){r, heat, length});
    for (size_t k = 0; k < ws->n_knots; k++) {
        knot_crossing c = {r, heat, knots[k]};
        const bool inside = at_low < knots[k] && length + at_high > knots[k];
        double t = knots[k] - (knots[k] <= at_low ? at_low : at_high);
        if (inside && root_find(knot_distance, &c, 0, length, 0, &t, NULL) != WT_OK)
            t = 2 * length;
        knots[k] = t;
    }
    numbers_sort(knots, ws->n_knots);
}

/* ---- lateral force --------------------------------------------------------------------------- */

/* K changes its sign where J1 does not, and the accuracy of a series is relative to its values. K
 * is therefore the difference of two integrals without zeros. */
struct lateral_force {
    angular_weight weight;
    double shift;         /* K = J1 of `shifted` - shift * J1 of `plain` */
    angular_law *shifted; /* with the weight */
    angular_law *plain;   /* for isotropic roughness */
    layer_moduli own[2];  /* both for a layer with its own moduli */
};

lateral_force *lateral_force_new(const wt_material *material, const wt_friction_options *options,
                                 const layer_moduli *own, arena *memory)
{
    lateral_force *made = arena_alloc(memory, 1, sizeof *made);
    made->weight = weight_lateral(&options->anisotropy, &made->shift);
    made->plain = angular_new(material, options->tolerance, memory);
    made->shifted = angular_new(material, options->tolerance, memory);
    angular_set_weight(made->shifted, &made->weight);
    if (own != NULL) {
        made->own[0] = made->own[1] = *own;
        made->own[0].weight = &made->weight;
        made->own[1].weight = NULL;
    }
    return made;
}

void lateral_force_clear(lateral_force *side)
{
    if (side == NULL)
        return;
    angular_clear(side->shifted);
    angular_clear(side->plain);
}

void lateral_force_extend(lateral_force *side, double lowest, double highest)
{
    angular_extend(side->plain, lowest, highest);
    angular_extend(side->shifted, lowest, highest);
}

/* Values at the nodes of a record. */
typedef struct lateral_nodes {
    double *omega, *log_omega, *j1, *j2, *shifted, *plain;
    double *numbers; /* memory of these arrays */
} lateral_nodes;

static lateral_nodes lateral_nodes_create(const node_contributions *record, friction_load at)
{
    const size_t n = record->n;
    double *numbers = wt_alloc(6 * n, sizeof *numbers);
    const lateral_nodes nodes = {numbers,         numbers + n,     numbers + 2 * n, numbers + 3 * n,
                                 numbers + 4 * n, numbers + 5 * n, numbers};
    for (size_t i = 0; i < n; i++) {
        nodes.omega[i] = record->q[i] * at.speed;
        nodes.log_omega[i] = log(record->q[i]) + log(at.speed);
    }
    for (size_t i = 0; at.heat != NULL && i < n; i += GAUSS_NODES_MAX)
        friction_shift_nodes(at.heat, record->q + i,
                             n - i < GAUSS_NODES_MAX ? n - i : GAUSS_NODES_MAX, nodes.omega + i,
                             nodes.log_omega + i);
    return nodes;
}

/* Relative error of J1 from a closed form, which has no series: a few roundings. */
static const double closed_error = 16 * DBL_EPSILON;
/* Factor on the error of the rules and of the variance in the hysteresis: the dependence of K / J1
 * on the moduli at most doubles it. */
static const double rule_error_factor = 2;

wt_estimate lateral_force_compute(const wt_friction_workspace *ws, friction_load at,
                                  const node_contributions *record, double hysteresis_error)
{
    const lateral_force *s = ws->lateral;
    const size_t n = record->n;
    wt_estimate side = {.unit = "1"};
    if (n == 0)
        return side;
    const lateral_nodes k = lateral_nodes_create(record, at);
    size_t piece[2] = {0, 0};
    double own_error = 0;
    if (ws->layer != NULL) {
        layer_moduli_eval(ws->layer, record->q, k.omega, n, k.j1, k.j2, NULL, &own_error);
        layer_moduli_eval(&s->own[0], record->q, k.omega, n, k.shifted, k.j2, NULL, &own_error);
        layer_moduli_eval(&s->own[1], record->q, k.omega, n, k.plain, k.j2, NULL, &own_error);
    } else {
        angular_eval(ws->angular, k.omega, k.log_omega, n, k.j1, k.j2);
        angular_eval(s->shifted, k.omega, k.log_omega, n, k.shifted, k.j2);
        angular_eval(s->plain, k.omega, k.log_omega, n, k.plain, k.j2);
    }
    double first = k.log_omega[0],
           last = first; /* a finer scale may have a lower reduced frequency if it is warmer */
    for (size_t i = 1; i < n; i++) {
        first = fmin(first, k.log_omega[i]);
        last = fmax(last, k.log_omega[i]);
    }
    const bool own = ws->layer != NULL;
    const double error_shifted =
        (own ? own_error : angular_error(s->shifted, first, last, &piece[0])) + closed_error;
    const double error_plain =
        (own ? own_error : angular_error(s->plain, first, last, &piece[1])) + closed_error;
    double largest = 0, error = 0;
    for (size_t i = 0; i < n; i++) {
        if (!(k.j1[i] > 0))
            continue;
        const double ratio = (k.shifted[i] - s->shift * k.plain[i]) / k.j1[i];
        side.value += record->mu[i] * ratio;
        largest = fmax(largest, fabs(ratio));
        error += record->mu[i] *
                 (error_shifted * k.shifted[i] + s->shift * error_plain * k.plain[i]) / k.j1[i];
    }
    side.numerical_error = error + rule_error_factor * largest * hysteresis_error;
    free(k.numbers);
    return side;
}
