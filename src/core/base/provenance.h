/* A command that was stored and is read again. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_PROVENANCE_H
#define WT_CORE_BASE_PROVENANCE_H

#include "weartrack/base.h"

/* As wt_provenance_version and wt_provenance_command gave them, with a line end between. */
wt_status provenance_restore(wt_provenance *p, const char *version_and_command) WT_NODISCARD;

#endif
