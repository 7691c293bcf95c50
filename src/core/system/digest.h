/* Digests of data that are read piece by piece. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_SYSTEM_DIGEST_H
#define WT_CORE_SYSTEM_DIGEST_H

#include "weartrack/core.h"

/* Copies the bytes [from, from + n) of the data. */
typedef wt_status digest_source(void *user, size_t from, void *to, size_t n, wt_error *err);

/* Computes the SHA-256 (omitted if hex is NULL) and a 64-bit fingerprint that identifies copies.
 * The fingerprint is a hash of the SHA-256. Without SHA-256 it is a hash of the data, in a fifth of
 * the time. */
wt_status digest_stream(digest_source *source, void *user, size_t length, char hex[65],
                        uint64_t *fingerprint, wt_error *err) WT_NODISCARD;
/* Computes the MD5, which some file formats store to detect changes. */
void digest_md5(const void *bytes, size_t length, char hex[33]);

#endif
