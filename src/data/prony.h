/* Prony series inside the library. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_PRONY_H
#define WT_DATA_PRONY_H

#include "weartrack/data.h"

wt_status prony_copy(const wt_prony *from, wt_prony *to, wt_error *err) WT_NODISCARD;

#endif
