/* A table as bytes: what its digest in a store is of (weartrack-hdf5(5)), and how it comes through
 * the door to HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_BYTES_H
#define WT_CORE_TABLE_TABLE_BYTES_H

#include "weartrack/data.h"

/* WT_E_ARG of a table without columns or a valid name. */
wt_status table_bytes_write(FILE *out, const wt_table *table, wt_error *err) WT_NODISCARD;
/* Makes a table of the bytes at *at, not one of which is trusted, and moves *at behind it. */
wt_status table_bytes_read(const char **at, const char *end, wt_table **table,
                           wt_error *err) WT_NODISCARD;
/* Their SHA-256. */
wt_status table_bytes_digest(const wt_table *table, char hex[65], wt_error *err) WT_NODISCARD;

#endif
