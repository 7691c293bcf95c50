/* Cache of the materials of the replicates with their angular integrals, for all contacts of a job
 * and, in a run, for all jobs. It also stores the material for the stated values if its integrals
 * have no closed form. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_MATERIAL_CACHE_H
#define WT_FRICTION_MATERIAL_CACHE_H

#include "friction/numerics/angular.h"
#include "weartrack/friction.h"

/* Relative numerical tolerance of replicates: far below their scatter, which is some per cent. */
#define REPLICATE_TOLERANCE 1e-5

wt_material_cache *material_cache_new(void);
void material_cache_free(wt_material_cache *drawn);
/* Prepares the cache for the replicates of this contact at these velocities, and frees the
 * materials of another contact. Replicates must not run meanwhile. */
wt_status material_cache_prepare(wt_material_cache *drawn, const wt_sliding *sliding,
                                 const wt_job *work, double slowest, double fastest,
                                 wt_error *err) WT_NODISCARD;

typedef struct replicate_material {
    wt_material *material;
    angular_law *series;
} replicate_material;
/* Returns the material of one replicate, borrowed; the members are NULL if it is not stored. Only
 * one thread at a time may request a replicate. */
wt_status material_cache_get(wt_material_cache *drawn, size_t replicate,
                             replicate_material *material, wt_error *err) WT_NODISCARD;

/* Material for the stated values with a statement about its validity, borrowed. The series covers
 * the wavenumbers of the surface at these velocities; a law with a closed form has none. With NULL
 * members the contact creates its own material. The cache identifies a rubber by its address, so
 * that a changed rubber needs another address. Other threads may read it only while it is pinned; a
 * pinned cache creates nothing. */
typedef struct shared_material {
    replicate_material content;
    const char *statement;
} shared_material;
wt_status material_cache_get_stated(wt_material_cache *drawn, const wt_sliding *sliding,
                                    double tolerance, double slowest, double fastest,
                                    shared_material *values, wt_error *err) WT_NODISCARD;
void material_cache_pin(wt_material_cache *drawn, bool pinned); /* no effect on NULL */

#endif
