/* Copies Prony series. Internal to the library. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_DATA_PRONY_SERIES_H
#define WT_CORE_DATA_PRONY_SERIES_H

#include "weartrack/core.h"

wt_status prony_copy(const wt_prony *from, wt_prony *to, wt_error *err) WT_NODISCARD;

#endif
