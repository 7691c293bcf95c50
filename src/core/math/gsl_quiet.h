/* Switching off GSL's aborting error handler (internal to the library).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_GSL_QUIET_H
#define WT_CORE_MATH_GSL_QUIET_H

/* GSL's default handler aborts the program; a library must not. Once per process, thread-safe;
 * every entry into GSL that can fail comes after it and checks the status it gets. */
void gsl_quiet(void);

#endif
