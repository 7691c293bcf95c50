/* Friction with and without one effect, at the velocities of a list and at the reference velocity.
 * Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_FRICTION_DIFFERENCE_H
#define WT_FRICTION_FRICTION_DIFFERENCE_H

#include "friction/sliding_contact.h"

typedef struct friction_difference {
    const wt_sliding *sliding;         /* variant with the effect; borrowed */
    double *velocity;                  /* [n] the last is the reference */
    wt_friction_point *with, *without; /* [n] */
    size_t n;
    double temperature; /* temperature of the rubber or of its surroundings [K] */
} friction_difference;

/* Evaluates further quantities of the contact with the effect. */
typedef wt_status friction_difference_fn(void *user, const friction_difference *c,
                                         const sliding_contact *contact, wt_error *err);

/* Computes both variants for the stated values and reports the cost. The callback may be NULL. The
 * caller clears the result, also on failure. */
wt_status friction_difference_compute(const wt_sliding *with, const wt_sliding *without,
                                      const wt_job *work, friction_difference_fn *extend,
                                      void *user, friction_difference *c,
                                      wt_error *err) WT_NODISCARD;
void friction_difference_clear(friction_difference *c);
/* Writes the change at one velocity: "at 300 mm/s hysteresis friction +1.0 %, contact area -2.0 %
 * against AGAINST". */
void friction_difference_describe(const wt_friction_point *with, const wt_friction_point *without,
                                  const char *against, char *text, size_t size);

#endif
