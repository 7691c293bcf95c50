/* Encodes tables as bytes, for their digests in a store (weartrack-hdf5(5)) and for the output of
 * the sandbox. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_BYTES_H
#define WT_CORE_TABLE_TABLE_BYTES_H

#include "weartrack/core.h"

/* Writes a table. WT_E_ARG for a table without columns or with an invalid name. */
wt_status table_bytes_write(FILE *out, const wt_table *table, wt_error *err) WT_NODISCARD;
/* Decodes a table at *at with validation, and moves *at to its end. */
wt_status table_bytes_read(const char **at, const char *end, wt_table **table,
                           wt_error *err) WT_NODISCARD;
/* Computes the SHA-256 of the encoded table. */
wt_status table_bytes_digest(const wt_table *table, char hex[65], wt_error *err) WT_NODISCARD;

#endif
