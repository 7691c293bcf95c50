/* A command that was stored and is read again. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_BASE_PROVENANCE_H
#define WT_BASE_PROVENANCE_H

#include "weartrack/base.h"

/* As wt_provenance_command gave it. */
wt_status provenance_restore_command(wt_provenance *p, const char *command) WT_NODISCARD;

#endif
