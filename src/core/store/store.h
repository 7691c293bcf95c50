/* Common definitions of the writer and the reader of the HDF5 store; see weartrack-hdf5(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_STORE_H
#define WT_CORE_STORE_STORE_H

#include "core/store/hdf5_sandbox.h"
#include "core/system/temporary.h"
#include "core/table/table.h"

/* Version of the layout, in the root attribute "weartrack_format". Layout 3 differs from 5 by names
 * of tables and columns alone; 4 and 6 had a layout of force maps. */
enum { STORE_FORMAT_OLDEST = 3, STORE_FORMAT = 5 };

#define STORE_VERSION_ATTRIBUTE "weartrack_version"
#define STORE_COMMAND_ATTRIBUTE "command"
#define STORE_CREATED_ATTRIBUTE "created"
#define STORE_DIGESTS_ATTRIBUTE "table_sha256"
#define STORE_TABLES_ATTRIBUTE "table_order"
#define STORE_TITLE_ATTRIBUTE "title"
#define STORE_COLUMNS_ATTRIBUTE "column_order"
#define STORE_KEYS_ATTRIBUTE "key_order"
#define STORE_UNITS_ATTRIBUTE "units"
#define STORE_LONG_NAME_ATTRIBUTE "long_name"
#define STORE_BLOCK_DATASET "block"
#define STORE_CASE_DATASET "case"
#define STORE_INPUTS_TABLE "provenance/inputs"

/* Format of the data from the sandbox: tables as bytes (table_bytes.h), then with has_origin the
 * table of inputs; the case file; version and command; a digest for each table and for the case
 * file; this tail. The HDF5 layout has no checksum of the values. Without digests a flipped bit
 * would change a number undetected. */
enum { STORE_DIGEST_SIZE = 65 };

typedef struct store_tail {
    uint64_t has_origin; /* the inputs, the version and the command are present */
    uint64_t n_tables, case_length, origin_length;
} store_tail;

/* An hdf5_read_function, and the variant that writes the tables of result_values_use alone. */
wt_status store_extract(hid_t file, size_t size, FILE *out, wt_error *err);
wt_status store_extract_main_values(hid_t file, size_t size, FILE *out, wt_error *err);
/* wt_store_read with one of these functions. */
wt_status store_read(const char *path, hdf5_read_function *extract, wt_result **result,
                     wt_error *err) WT_NODISCARD;
/* Decodes the data from the sandbox into a result. All bytes are validated. */
wt_status store_decode(const char *bytes, size_t length, wt_result *result, wt_error *err);

#endif
