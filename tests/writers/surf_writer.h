/* Compressed files of Digital Surf for tests. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_SURF_H
#define TESTS_WRITERS_SURF_H

#include <stddef.h>

/* Writes `n` heights of 32 bits after a comment of 5 bytes, packed in a number of zlib streams (of
 * stored blocks, below 64 KiB each). Needs at most 512 + 5 + 4 + pieces * 19 + 4 n bytes and
 * returns the number used. */
size_t surf_write(unsigned char *to, const int *heights, size_t n, size_t pieces);
/* The same without compression. */
size_t surf_write_plain(unsigned char *to, const int *heights, size_t n);

#endif
