/* Resource errors of libraries. A library without memory or file descriptors may return a plain
 * negative result, such as "unknown unit" or "no match". The code that calls the library need not
 * distinguish these cases. The code that starts the work checks for a resource error at its end.
 * The state belongs to the calling thread. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_RESOURCE_ERROR_H
#define WT_CORE_BASE_RESOURCE_ERROR_H

#include "weartrack/core.h"

/* Advice for a file that cannot be opened because of a lack of descriptors (EMFILE, ENFILE). */
#define MORE_FILES_ADVICE                                                                          \
    "more files must be open at once than the system lets: allow more, as by ulimit -n 256"

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
