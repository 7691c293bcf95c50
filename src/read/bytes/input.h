/* An input of bytes that were made, not read. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_INPUT_H
#define WT_READ_INPUT_H

#include "weartrack/read.h"

/* Takes the bytes, from malloc, also on failure. */
wt_status input_own(char *bytes, size_t length, const char *name, wt_input **input,
                    wt_error *err) WT_NODISCARD;

#endif
