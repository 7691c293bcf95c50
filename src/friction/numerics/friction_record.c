/* Contributions of the nodes of a pass, stored for the energy source.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/friction_kernel.h"

#include <stdlib.h>
#include <string.h>

void friction_record_add(friction_record *record, const double *q, const double *mu, size_t n)
{
    if (record->n + n > record->room) {
        const size_t room = 2 * record->room + 8 * GAUSS_NODES_MAX;
        double *more_q = realloc(record->q, room * sizeof *more_q);
        record->q = more_q != NULL ? more_q : record->q;
        double *more_mu = realloc(record->mu, room * sizeof *more_mu);
        record->mu = more_mu != NULL ? more_mu : record->mu;
        record->failed |= more_q == NULL || more_mu == NULL;
        if (record->failed)
            return;
        record->room = room;
    }
    memcpy(record->q + record->n, q, n * sizeof *q);
    memcpy(record->mu + record->n, mu, n * sizeof *mu);
    record->n += n;
}
