/* What the writer and the reader of the HDF5 store share; see weartrack-hdf5(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_STORE_H
#define WT_DATA_STORE_H

#include "base/own_files.h"
#include "data/hdf5_door.h"
#include "data/table.h"

/* Version of the layout, in the root attribute "weartrack_format": a file with a map of force
 * curves has the second, so that a program that knows only the first does not lose the curves. */
enum { STORE_FORMAT = 1, STORE_FORMAT_MAP = 2 };

#define STORE_VERSION_ATTRIBUTE "weartrack_version"
#define STORE_COMMAND_ATTRIBUTE "command"
#define STORE_CREATED_ATTRIBUTE "created"
#define STORE_DIGEST_ATTRIBUTE "content_sha256"
#define STORE_TABLES_ATTRIBUTE "table_order"
#define STORE_TITLE_ATTRIBUTE "title"
#define STORE_COLUMNS_ATTRIBUTE "column_order"
#define STORE_KEYS_ATTRIBUTE "key_order"
#define STORE_UNITS_ATTRIBUTE "units"
#define STORE_LONG_NAME_ATTRIBUTE "long_name"
#define STORE_BLOCK_DATASET "block"
#define STORE_CASE_DATASET "case"
#define STORE_INPUTS_TABLE "provenance/inputs"

/* Digest of what a store holds: its tables as text streams in their order, the list of inputs the
 * same way (NULL if there is none), and the case file. The layout of HDF5 keeps no checksum over
 * the values, so a flipped bit would otherwise be a wrong number. */
wt_status store_digest(const wt_result *result, const wt_table *inputs, char hex[65],
                       wt_error *err);

/* What comes through the door: the bytes that the digest is of, the command, and at the end this.
 */
typedef struct store_tail {
    char digest[65];    /* that the file says */
    uint8_t has_origin; /* the last table is the list of inputs, and there is a command */
    uint64_t case_length, command_length;
} store_tail;
wt_status store_pass(hid_t file, size_t size, FILE *out, wt_error *err); /* a hdf5_reading */
/* The samples of a map, data/map.h: blocks of all channels. A hdf5_reading, too. */
wt_status store_pass_samples(hid_t file, size_t size, FILE *out, wt_error *err);
/* As wt_store_read_memory, also from a descriptor. */
wt_status store_read_bytes(const hdf5_bytes *from, const char *name, wt_result **result,
                           wt_error *err);
/* Makes a result of that; not a byte of it is trusted. */
wt_status store_take(const char *bytes, size_t length, wt_result *result, wt_error *err);

/* A table of wt_provenance_table back to the inputs of a provenance. */
wt_status store_inputs_read(const wt_table *table, wt_provenance *provenance, wt_error *err);

#endif
