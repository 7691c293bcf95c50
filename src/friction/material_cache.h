/* The materials of the replicates with their angular integrals, made once for all contacts of a job
 * and, in a run, of the jobs one after another; likewise that of the values themselves, where its
 * integrals have no closed form. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_MATERIAL_CACHE_H
#define WT_FRICTION_MATERIAL_CACHE_H

#include "friction/numerics/angular.h"
#include "weartrack/flow.h"

/* Relative numerical error asked of replicates: far below the scatter between them, which is some
 * per cent. */
#define REPLICATE_TOLERANCE 1e-5

wt_material_cache *material_cache_new(void); /* NULL when out of memory */
void material_cache_free(wt_material_cache *drawn);
/* Before the replicates of this contact at these velocities. What is there of another one goes. Not
 * while replicates are at work. */
wt_status material_cache_begin(wt_material_cache *drawn, const wt_sliding *sliding,
                               const wt_job *work, double slowest, double fastest,
                               wt_error *err) WT_NODISCARD;

typedef struct drawn_material {
    wt_material *material;
    angular_law *series;
} drawn_material;
/* Of one replicate, borrowed; NULLs: none is kept for it. A replicate is asked for by one thread at
 * a time. */
wt_status material_cache_get(wt_material_cache *drawn, size_t replicate, drawn_material *material,
                             wt_error *err) WT_NODISCARD;

/* Of the values themselves, with what must be said of it, borrowed; its series, if its law has no
 * closed form, over the wavenumbers of the surface at these velocities. NULLs: there is none, and a
 * contact makes its own. A rubber is known by its place, so one that changes in it must not be
 * asked for twice. Not while others read it, unless it is held: then nothing is made. */
typedef struct drawn_values {
    drawn_material of;
    const char *statement;
} drawn_values;
wt_status drawn_values_get(wt_material_cache *drawn, const wt_sliding *sliding, double tolerance,
                           double slowest, double fastest, drawn_values *values,
                           wt_error *err) WT_NODISCARD;
void material_cache_pin(wt_material_cache *drawn, bool held); /* NULL: nothing */

#endif
