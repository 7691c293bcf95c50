/* Text file that is embedded in the library. src/embed.cmake writes the arrays.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_EMBED_H
#define WT_CORE_SYSTEM_EMBED_H

#include <stddef.h>

typedef struct embedded_text {
    const char *name; /* file name without its folder; NULL ends the list */
    const char *text; /* followed by a terminating zero that `length` does not count */
    size_t length;
} embedded_text;

#endif
