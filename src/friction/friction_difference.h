/* Friction with something and without it, at the velocities of a list and at the reference
 * velocity. Internal to friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_FRICTION_DIFFERENCE_H
#define WT_FRICTION_FRICTION_DIFFERENCE_H

#include "friction/sliding_contact.h"

typedef struct friction_difference {
    const wt_sliding *sliding;         /* with it; borrowed */
    double *velocity;                  /* [n] the reference last */
    wt_friction_point *with, *without; /* [n] */
    size_t n;
    double temperature; /* of the rubber, or of its surroundings [K] */
} friction_difference;

/* Looks further at the contact with it. */
typedef wt_status friction_difference_extend(void *user, const friction_difference *c,
                                             const sliding_contact *contact, wt_error *err);

/* Of the values themselves; `more` may be NULL. Says what it cost. To be cleared, also on failure.
 */
wt_status friction_difference_make(const wt_sliding *with, const wt_sliding *without,
                                   const wt_job *work, friction_difference_extend *more, void *user,
                                   friction_difference *c, wt_error *err) WT_NODISCARD;
void friction_difference_clear(friction_difference *c);
/* Of one velocity: "at 300 mm/s hysteresis friction +1.0 %, contact area -2.0 % against AGAINST".
 */
void friction_difference_describe(const wt_friction_point *with, const wt_friction_point *without,
                                  const char *against, char *text, size_t size);

#endif
