/* Switching off GSL's aborting error handler (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_GSL_QUIET_H
#define WT_FIT_GSL_QUIET_H

/* GSL's default handler aborts the program; a library must not. Once per process, thread-safe;
 * every entry into GSL from this room comes after it and checks the status it gets. */
void wt_fit_gsl_quiet(void);

#endif
