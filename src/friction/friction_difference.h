/* Friction with something and without it, at the velocities of a list and at the reference
 * velocity. Internal to friction. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_FRICTION_DIFFERENCE_H
#define WT_FRICTION_FRICTION_DIFFERENCE_H

#include "friction/sliding_contact.h"

typedef struct contrast {
    const wt_sliding *sliding;         /* with it; borrowed */
    double *velocity;                  /* [n] the reference last */
    wt_friction_point *with, *without; /* [n] */
    size_t n;
    double temperature; /* of the rubber, or of its surroundings [K] */
} contrast;

/* Looks further at the contact with it. */
typedef wt_status contrast_more(void *user, const contrast *c, const sliding_contact *contact,
                                wt_error *err);

/* Of the values themselves; `more` may be NULL. Says what it cost. To be cleared, also on failure.
 */
wt_status contrast_make(const wt_sliding *with, const wt_sliding *without, const wt_job *work,
                        contrast_more *more, void *user, contrast *c, wt_error *err) WT_NODISCARD;
void contrast_clear(contrast *c);
/* Of one velocity: "at 300 mm/s hysteresis friction +1.0 %, contact area -2.0 % against AGAINST".
 */
void contrast_words(const wt_friction_point *with, const wt_friction_point *without,
                    const char *against, char *text, size_t size);

#endif
