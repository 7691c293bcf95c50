/* Memory: which allocations may fail. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_MEMORY_H
#define WT_CORE_BASE_MEMORY_H

#include "weartrack/core.h"

#include <stdlib.h>

/* Allocates n zeroed items of `size` bytes for data whose number is stated by a file or an option.
 * NULL when out of memory or when the product overflows. Free with free(). */
void *try_alloc(size_t n, size_t size) WT_NODISCARD;
/* Calls the handler for an allocation of `size` bytes that failed in a library, and does not
 * return. */
_Noreturn void out_of_memory(size_t size);

#endif
