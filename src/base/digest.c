/* SHA-256 by libmd. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/digest.h"

#include "base/mix.h"

#include <sha2.h>

void wt_digest(const void *bytes, size_t length, char hex[65])
{
    SHA2_CTX context;
    SHA256Init(&context);
    SHA256Update(&context, bytes, length);
    (void)SHA256End(&context, hex);
}

wt_status digest_pieces(digest_source *source, void *user, size_t length, char hex[65],
                        uint64_t *fingerprint, wt_error *err)
{
    unsigned char piece[1 << 16];
    SHA2_CTX context;
    wt_status status = WT_OK;
    *fingerprint = mix64(length);
    SHA256Init(&context);
    for (size_t at = 0; status == WT_OK && at < length;) {
        const size_t n = length - at < sizeof piece ? length - at : sizeof piece;
        status = source(user, at, piece, n, err);
        if (status != WT_OK)
            break;
        *fingerprint = mix_bytes(*fingerprint, piece, n);
        if (hex != NULL)
            SHA256Update(&context, piece, n);
        at += n;
    }
    if (status == WT_OK && hex != NULL)
        (void)SHA256End(&context, hex);
    return status;
}
