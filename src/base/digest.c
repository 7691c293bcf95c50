/* SHA-256 by libmd. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/base.h"

#include <sha2.h>

void wt_digest(const void *bytes, size_t length, char hex[65])
{
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, bytes, length);
    (void)SHA256End(&context, hex);
}
