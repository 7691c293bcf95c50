/* The choices of the model, each moved alone (internal to the flow room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_WHAT_IF_H
#define WT_STUDY_WHAT_IF_H

#include "study/case_override.h"

/* The settings behind the rows of the table what_if, in their order; the first is as used. One
 * whose `vertical` is another than that of the first is of isotherms that are to be fitted again.
 * *settings is freed with free(). */
wt_status what_if_settings(const setting *used, setting **settings, size_t *n,
                           wt_error *err) WT_NODISCARD;

#endif
