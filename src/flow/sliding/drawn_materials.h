/* The materials of the replicates with their angular integrals, made once for all contacts of a job
 * and, in a run, of the jobs one after another. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SLIDING_DRAWN_MATERIALS_H
#define WEARTRACK_FLOW_SLIDING_DRAWN_MATERIALS_H

#include "kernel/angular.h"
#include "weartrack/flow.h"

/* Relative numerical error asked of replicates: far below the scatter between them, which is some
 * per cent. */
#define REPLICATE_TOLERANCE 1e-5

wt_drawn *drawn_new(void); /* NULL when out of memory */
void drawn_free(wt_drawn *drawn);
/* Before the replicates of this contact at these velocities. What is there of another one goes. Not
 * while replicates are at work. */
wt_status drawn_begin(wt_drawn *drawn, const wt_sliding *sliding, const wt_job *work,
                      double slowest, double fastest, wt_error *err) WT_NODISCARD;

typedef struct drawn_material {
    wt_material *material;
    angular_law *series;
} drawn_material;
/* Of one replicate, borrowed; NULLs: none is kept for it. A replicate is asked for by one thread at
 * a time. */
wt_status drawn_get(wt_drawn *drawn, size_t replicate, drawn_material *material,
                    wt_error *err) WT_NODISCARD;

#endif
