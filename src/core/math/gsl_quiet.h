/* Disables the GSL error handler, which aborts the program. Internal to the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_GSL_QUIET_H
#define WT_CORE_MATH_GSL_QUIET_H

/* The call acts once for the process and is thread-safe. It must precede every GSL function that
 * can fail, and the caller must check the status of that function. */
void gsl_quiet(void);

#endif
