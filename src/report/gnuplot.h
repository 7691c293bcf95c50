/* Starting gnuplot: the one place of the library that runs another program.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_GNUPLOT_H
#define WT_REPORT_GNUPLOT_H

#include "weartrack/base.h"

/* Runs `program` (a name looked up in PATH, or a path) in `folder` on a script (a name in that
 * folder), without a shell, without standard input, without the user's gnuplot settings, in the C
 * locale. WT_E_TOOL if it cannot be started or fails; the error carries its words. One process for
 * each script: what one leaves behind would change the bytes of the next picture. */
wt_status gnuplot_run(const char *program, const char *folder, const char *script,
                      wt_error *err) WT_NODISCARD;

#endif
