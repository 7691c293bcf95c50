/* Lateral force on anisotropic roughness.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

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
