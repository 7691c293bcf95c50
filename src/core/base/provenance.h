/* Restores the command of a stored provenance. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_PROVENANCE_H
#define WT_CORE_BASE_PROVENANCE_H

#include "weartrack/core.h"

/* Sets version and command from the texts of wt_provenance_version and wt_provenance_command,
 * separated by a line feed. */
void provenance_restore(wt_provenance *p, const char *version_and_command);

#endif
