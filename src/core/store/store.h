/* What the writer and the reader of the HDF5 store share; see weartrack-hdf5(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_STORE_H
#define WT_CORE_STORE_STORE_H

#include "core/store/hdf5_sandbox.h"
#include "core/system/file_signatures.h"
#include "core/table/table.h"

/* Version of the layout, in the root attribute "weartrack_format". A file with a map of force
 * curves has one of its own, so that a program that knows none does not lose the curves. Layouts 3
 * and 4 differ from 5 and 6 by names of tables and columns alone (former_names.h). */
enum { STORE_FORMAT_OLDEST = 3, STORE_FORMAT = 5, STORE_FORMAT_MAP };

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

/* What comes through the door: tables as bytes (table_bytes.h), with has_origin that of the inputs
 * behind them, the case file, version and command, a digest for each of these tables and for the
 * case file, and at the end this. The layout of HDF5 keeps no checksum over the values, so a
 * flipped bit would otherwise be a wrong number. */
enum { STORE_DIGEST_SIZE = 65 };
typedef struct store_tail {
    uint64_t has_origin; /* the inputs, and of which version by which command */
    uint64_t n_tables, case_length, origin_length;
} store_tail;
void store_tail_write(FILE *out, const store_tail *tail); /* 8 bytes each, the low one first */
wt_status store_pass(hid_t file, size_t size, FILE *out, wt_error *err); /* a hdf5_reading */
/* The same of the tables that headlines are made of. */
wt_status store_pass_headlines(hid_t file, size_t size, FILE *out, wt_error *err);
bool store_has_headlines(const char *table);
bool store_has_headline_rows(const char *table);          /* and not of its keys alone */
void store_headlines_digest(char hex[STORE_DIGEST_SIZE]); /* of the names of these tables */
/* Puts the tables that headlines are made of behind the end of a result file that HDF5 has closed
 * (store_abstract.c). */
wt_status store_abstract_write(FILE *out, const wt_result *result, wt_error *err) WT_NODISCARD;
/* Reads them from there; WT_END: there are none, or of another set of tables, or memory is short.
 */
wt_status store_abstract_read(int file, size_t size, const char *name, wt_result **result,
                              wt_error *err) WT_NODISCARD;
/* The samples of a map, core/store/force_map.h: blocks of all channels. A hdf5_reading, too. */
wt_status store_pass_samples(hid_t file, size_t size, FILE *out, wt_error *err);
/* As wt_store_read_memory, also from a descriptor; by store_pass or store_pass_headlines. */
wt_status store_read_bytes(const hdf5_bytes *from, hdf5_reading *pass, const char *name,
                           wt_result **result, wt_error *err);
struct stat;
/* Opens a file that can be read again and again; -1 or open, for the caller to close, on failure.
 */
wt_status store_open_regular(const char *path, int *file, struct stat *info,
                             wt_error *err) WT_NODISCARD;
/* A file of the program's own is damaged: WT_E_CORRUPT, with what to do. */
wt_status store_corrupt(wt_error *err, const char *place, const char *message);
/* Makes a result of that; not a byte of it is trusted. */
wt_status store_take(const char *bytes, size_t length, wt_result *result, wt_error *err);

/* A table of wt_provenance_table back to the inputs of a provenance. */
wt_status store_inputs_read(const wt_table *table, wt_provenance *provenance, wt_error *err);

#endif
