/* List of the contributions of the wavenumber nodes to friction, for the energy density in the
 * rubber.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include <stdlib.h>
#include <string.h>

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
