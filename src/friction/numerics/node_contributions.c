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
        const size_t capacity = 2 * list->capacity + 8 * GAUSS_NODES_MAX;
        double *grown_q = realloc(list->q, capacity * sizeof *grown_q);
        list->q = grown_q != NULL ? grown_q : list->q;
        double *grown_mu = realloc(list->mu, capacity * sizeof *grown_mu);
        list->mu = grown_mu != NULL ? grown_mu : list->mu;
        list->failed |= grown_q == NULL || grown_mu == NULL;
        if (list->failed)
            return;
        list->capacity = capacity;
    }
    memcpy(list->q + list->n, q, n * sizeof *q);
    memcpy(list->mu + list->n, mu, n * sizeof *mu);
    list->n += n;
}
