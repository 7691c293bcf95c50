/* Compressed files of Digital Surf for tests. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_SURF_H
#define TESTS_WRITERS_SURF_H

#include <stddef.h>

/* Writes `n` heights of 32 bits, packed in so many pieces of zlib (of stored blocks, so below 64
 * KiB each), behind a comment of 5 bytes: at most 512 + 5 + 4 + pieces * 19 + 4 n bytes to `to`.
 * Their number. */
size_t surf_write(unsigned char *to, const int *heights, size_t n, size_t pieces);
/* The same, not compressed. */
size_t surf_write_plain(unsigned char *to, const int *heights, size_t n);

#endif
