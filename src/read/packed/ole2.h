/* Declares compound files (OLE2), the container of streams in old Office files: [MS-CFB], versions
 * 3 and 4.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_PACKED_OLE2_H
#define WT_READ_PACKED_OLE2_H

#include "weartrack/core.h"

bool compound_is_file(const unsigned char *bytes, size_t length);

/* Reads the first stream of the root folder that has one of the names, in their order, without
 * regard to the case of ASCII letters. The caller frees *stream. Returns WT_E_NOT_FOUND without a
 * message if there is none, WT_E_CORRUPT if the file is damaged or truncated. */
wt_status compound_read_stream(const unsigned char *bytes, size_t length, const char *const *names,
                               size_t n_names, unsigned char **stream, size_t *n,
                               wt_error *err) WT_NODISCARD;

#endif
