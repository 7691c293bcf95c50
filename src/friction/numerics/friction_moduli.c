/* J1 and J2 of a workspace: those of its material, or those of a layer with its own moduli.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

void friction_moduli(const wt_friction_workspace *ws, const double *q, const double *omega,
                     const double *x, const double *extra_shift, size_t n, double *j1, double *j2,
                     double *loss_j1, double *loss_j2, double *error)
{
    if (ws->layer != NULL) {
        layer_moduli_eval(ws->layer, q, omega, extra_shift, n, j1, j2,
                          ws->loss != NULL ? loss_j2 : NULL, error);
        return;
    }
    angular_eval(ws->angular, omega, x, n, j1, j2);
    if (ws->loss != NULL)
        angular_eval(ws->loss, omega, x, n, loss_j1, loss_j2);
}
