/* A library that this one calls had no memory, or no file of its own, and its answer was taken for
 * a plain no: a unit that is not known, a line that does not match. Who asked need not tell these
 * apart; who began the work asks at its end. Of each thread. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_BASE_RESOURCE_ERROR_H
#define WT_CORE_BASE_RESOURCE_ERROR_H

#include "weartrack/base.h"

/* What to do where a file cannot be opened for want of descriptors (EMFILE, ENFILE). */
#define MORE_FILES_ADVICE                                                                          \
    "more files must be open at once than the system lets: allow more, as by ulimit -n 256"

void resource_error_clear(void);
/* ENOMEM, or why the units database of UDUNITS-2 or, for want of descriptors, what converts letters
 * cannot be read, as errno has it; -1: not known. */
void resource_error_note(int number);
/* Notes it and says so. */
wt_status resource_error_fail(int number, wt_error *err);
/* The status, or the failure by what was noted since the last call of resource_error_clear. */
wt_status resource_error_finish(wt_status status, wt_error *err) WT_NODISCARD;

#endif
