/* The anisotropy of a counter surface in words. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_ANISOTROPY_H
#define WT_FRICTION_ANISOTROPY_H

#include "weartrack/kernel.h"

/* Its terms, phi from the velocity; "" if there is none. */
void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size);

#endif
