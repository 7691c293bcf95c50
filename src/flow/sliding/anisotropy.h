/* The anisotropy of a counter surface in words. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_SLIDING_ANISOTROPY_H
#define WEARTRACK_FLOW_SLIDING_ANISOTROPY_H

#include "weartrack/kernel.h"

/* Its terms, phi from the velocity; "" if there is none. */
void anisotropy_describe(const wt_anisotropy *anisotropy, char *text, size_t size);

#endif
