/* Returns the version of the library. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#define STRINGIFY(x) #x
#define STRINGIFY_VALUE(x) STRINGIFY(x)

const char *wt_version(void)
{
    return STRINGIFY_VALUE(WT_VERSION_MAJOR) "." STRINGIFY_VALUE(
        WT_VERSION_MINOR) "." STRINGIFY_VALUE(WT_VERSION_PATCH);
}
