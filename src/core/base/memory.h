/* Memory: which allocations may fail. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_MEMORY_H
#define WT_CORE_BASE_MEMORY_H

#include "weartrack/core.h"
#include <stdlib.h>

/* Advice for a file that cannot be opened because of a lack of descriptors (EMFILE, ENFILE). */
#define MORE_FILES_ADVICE                                                                          \
    "more files must be open at once than the system lets: allow more, as by ulimit -n 256"

/* Allocates n zeroed items of `size` bytes for data whose number is stated by a file or an option.
 * NULL when out of memory or when the product overflows. Free with free(). */
void *try_alloc(size_t n, size_t size) WT_NODISCARD;
/* Calls the handler for an allocation of `size` bytes that failed in a library, and does not
 * return. */
_Noreturn void out_of_memory(size_t size);
/* Formats a text as asprintf does. Never NULL. Free with free(). */
char *format_text(const char *format, ...) WT_PRINTF(1, 2);
/* Opens a stream as open_memstream does. Never NULL. */
FILE *text_stream_open(char **text, size_t *length);
void text_stream_close(FILE *stream); /* completes the text, which the caller frees */
void resource_error_clear(void);
/* Records an errno: ENOMEM, or the reason why the units database of UDUNITS-2 or a character
 * converter cannot be read; -1 if the reason is unknown. */
void resource_error_note(int number);
/* Records the number and creates the error. */
wt_status resource_error_fail(int number, wt_error *err);
/* Returns the status, or the resource error recorded since the last call of
 * resource_error_clear. */
wt_status resource_error_finish(wt_status status, wt_error *err) WT_NODISCARD;

#endif
