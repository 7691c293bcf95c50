/* Options and case elements of earlier versions. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_REMOVED_NAMES_H
#define WT_CORE_BASE_REMOVED_NAMES_H

#include <stddef.h>

/* Returns what to do instead of an option or case element that left; NULL for any other name. */
const char *removed_name_advice(const char *name, size_t length);

#endif
