/* A compound file (OLE2), the folder within a file in which old Office files keep their streams:
 * [MS-CFB], versions 3 and 4.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PACKED_OLE2_H
#define WT_READ_PACKED_OLE2_H

#include "weartrack/read.h"

bool compound_is(const unsigned char *bytes, size_t length);

/* The bytes of the first stream of the root folder whose name is one of those, in their order,
 * without regard to the case of ASCII letters. *stream is to be freed. WT_E_NOT_FOUND without a
 * message: there is none; WT_E_CORRUPT: damaged or cut off. */
wt_status compound_stream(const unsigned char *bytes, size_t length, const char *const *names,
                          size_t n_names, unsigned char **stream, size_t *n,
                          wt_error *err) WT_NODISCARD;

#endif
