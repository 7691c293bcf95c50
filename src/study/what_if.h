/* One-at-a-time sensitivity to the model choices. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_WHAT_IF_H
#define WT_STUDY_WHAT_IF_H

#include "study/case_override.h"

/* Returns the case variants behind the rows of the table "what_if" in the same order; the first is
 * the case as used. A variant with another `vertical` than the first needs a new fit of the
 * isotherms. The caller frees them with free(). */
case_variant *what_if_list_variants(const case_variant *used, size_t *n);

#endif
