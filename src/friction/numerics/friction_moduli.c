/* J1 and J2 of a workspace: those of its material, or those of a layer with its own moduli. Errors
 * that they and rounding cause in a pass, and the contributions of its nodes.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void friction_moduli(const wt_friction_workspace *ws, const double *q, const double *omega,
                     const double *x, size_t n, double *j1, double *j2, double *loss_j1,
                     double *loss_j2, double *error)
{
    if (ws->layer != NULL) {
        layer_moduli_eval(ws->layer, q, omega, n, j1, j2, ws->loss != NULL ? loss_j2 : NULL, error);
        return;
    }
    angular_eval(ws->angular, omega, x, n, j1, j2);
    if (ws->loss != NULL)
        angular_eval(ws->loss, omega, x, n, loss_j1, loss_j2);
}

/* |d ln J| over n nodes. */
static double steepness(const double *j, size_t n)
{
    const double ratio = j[0] > 0 && j[n - 1] > 0 ? j[n - 1] / j[0] : 1;
    const double few = 8; /* below this ratio |sinh ln| is at most twice |ln| */
    return ratio < few && ratio > 1 / few ? 0.5 * fabs(ratio - 1 / ratio) : fabs(log(ratio));
}

static double series_error(const wt_friction_workspace *ws, double own_error, double low,
                           double high, friction_pass *pass)
{
    if (ws->layer != NULL)
        return own_error * (ws->softening != NULL ? 2 * ws->softening->cancellation : 1);
    if (ws->flash != NULL) /* frequencies need not rise from one subinterval to the next */
        pass->piece = pass->loss_piece = 0;
    const double error = angular_error(ws->angular, fmin(low, high), fmax(low, high), &pass->piece);
    return ws->softening == NULL ? error
                                 : ws->softening->cancellation *
                                       (error + angular_error(ws->loss, fmin(low, high),
                                                              fmax(low, high), &pass->loss_piece));
}

void friction_add_input_errors(const wt_friction_workspace *ws, double own_error,
                               const grid_subinterval *subinterval, const double *x,
                               const double *j1, const double *j2, size_t n, double log_lowest,
                               double variance, double hysteresis, double variance_so_far,
                               friction_pass *pass)
{
    const bool closed = ws->layer == NULL &&
                        angular_uses_closed_form(ws->angular, x[0], x[n - 1]) &&
                        (ws->loss == NULL || angular_uses_closed_form(ws->loss, x[0], x[n - 1]));
    /* ln omega is a sum of two terms */
    const double far = fmax(fabs(x[0]), fabs(x[n - 1])) + fabs(log_lowest);
    const double moved = closed ? 0 : 4 * DBL_EPSILON * (1 + far);
    const double series = closed ? 0 : series_error(ws, own_error, x[0], x[n - 1], pass);
    const double steepest_closed = 2; /* largest slope of a term of a Prony series */
    const double nodes =
        DBL_EPSILON * (1 + subinterval->t_high) * (fabs(subinterval->power) + steepest_closed + 1);
    pass->variance_input_error +=
        variance * (nodes + series + (closed ? 0 : moved * steepness(j2, n)));
    pass->hysteresis_input_error +=
        hysteresis * (nodes + series + (closed ? 0 : moved * steepness(j1, n)));
    if (variance_so_far > 0)
        pass->hysteresis_input_error +=
            hysteresis * FRICTION_AREA_POWER * (pass->variance_input_error / variance_so_far);
}

void node_contributions_add(node_contributions *list, const double *q, const double *mu, size_t n)
{
    if (list->n + n > list->capacity) {
        list->capacity = 2 * list->capacity + 8 * GAUSS_NODES_MAX;
        list->q = wt_realloc(list->q, list->capacity, sizeof *list->q);
        list->mu = wt_realloc(list->mu, list->capacity, sizeof *list->mu);
    }
    memcpy(list->q + list->n, q, n * sizeof *q);
    memcpy(list->mu + list->n, mu, n * sizeof *mu);
    list->n += n;
}
