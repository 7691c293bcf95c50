/* A library that this one calls had no memory, and its answer was taken for a plain no: a unit that
 * is not known, a line that does not match. Who asked need not tell these apart; who began the work
 * asks at its end. Of each thread. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_BASE_SHORTAGE_H
#define WT_BASE_SHORTAGE_H

#include "weartrack/base.h"

void shortage_forget(void);
void shortage_note(void);
/* The status, or WT_E_MEMORY if there was a shortage since the last call of shortage_forget. */
wt_status shortage_end(wt_status status, wt_error *err) WT_NODISCARD;

#endif
