/* Returns the version of the library. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/base.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *wt_version(void)
{
    return TEXT(WT_VERSION_MAJOR) "." TEXT(WT_VERSION_MINOR) "." TEXT(WT_VERSION_PATCH);
}
