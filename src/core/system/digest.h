/* Digests of what is read piece by piece. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_DIGEST_H
#define WT_CORE_SYSTEM_DIGEST_H

#include "weartrack/base.h"

/* Copies bytes [from, from + n) of what is to be digested. */
typedef wt_status digest_source(void *user, size_t from, void *to, size_t n, wt_error *err);

/* SHA-256 (hex NULL: left out), and a hash of 64 bits that tells copies: of that, or where it is
 * left out of the bytes, in a fifth of the time. */
wt_status digest_pieces(digest_source *source, void *user, size_t length, char hex[65],
                        uint64_t *fingerprint, wt_error *err) WT_NODISCARD;
/* MD5, by which files say that their bytes are those that were written. */
void digest_md5(const void *bytes, size_t length, char hex[33]);

#endif
