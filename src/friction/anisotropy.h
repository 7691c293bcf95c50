/* Text that describes the anisotropy of a counter surface. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_ANISOTROPY_H
#define WT_FRICTION_ANISOTROPY_H

#include "weartrack/surface.h"

/* Writes the terms of the anisotropy, with phi measured from the velocity. The text is "" without
 * an anisotropy. */
void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size);

#endif
