/* Returns the name of a status, such as "WT_E_UNIT", for messages and expectations of tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_STATUS_NAME_H
#define WT_TESTS_STATUS_NAME_H

#include "weartrack/core.h"

static inline const char *status_name(wt_status status)
{
    static const char *const names[] = {
#define STATUS_NAME(name, text) #name,
        WT_STATUS_LIST(STATUS_NAME)
#undef STATUS_NAME
    };
    const size_t i = (size_t)status;
    return i < sizeof names / sizeof *names ? names[i] : "unknown";
}

#endif
