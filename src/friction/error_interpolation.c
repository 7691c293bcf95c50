/* Interpolation of standard errors over the velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/error_interpolation.h"

#include <math.h>
#include <stdlib.h>

double *error_nodes_create(const double *v, size_t n, size_t *m)
{
    const size_t last = n - 1;
    *m = n;
    if (n <= ERROR_NODES + 1)
        return NULL;
    double *const made = wt_alloc(ERROR_NODES + 1, sizeof *made);
    const double from = log(v[0]), to = log(v[last - 1]);
    for (size_t i = 0; i < ERROR_NODES; i++)
        made[i] = exp(from + (to - from) * (double)i / (ERROR_NODES - 1));
    made[0] = v[0];
    made[ERROR_NODES - 1] = v[last - 1];
    made[ERROR_NODES] = v[last];
    *m = ERROR_NODES + 1;
    return made;
}

void error_nodes_interpolate(const double *nodes, size_t m, const double *at_nodes, const double *v,
                             size_t n, double *error)
{
    size_t k = 0; /* v[i] lies between the nodes k and k + 1 */
    for (size_t i = 0; i + 1 < n; i++) {
        while (k + 3 < m && v[i] > nodes[k + 1])
            k++;
        const double width = log(nodes[k + 1] / nodes[k]);
        const double share = width > 0 ? log(v[i] / nodes[k]) / width : 0;
        error[i] = at_nodes[k] + share * (at_nodes[k + 1] - at_nodes[k]);
    }
    error[n - 1] = at_nodes[m - 1];
}
