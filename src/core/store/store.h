/* Common definitions of the writer and the reader of the HDF5 store; see weartrack-hdf5(5).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_STORE_H
#define WT_CORE_STORE_STORE_H

#include "core/store/hdf5_sandbox.h"
#include "core/system/file_signatures.h"
#include "core/table/table.h"

/* Version of the layout, in the root attribute "weartrack_format". A file with a map of force
 * curves has one of its own, so that a program that knows none does not lose the curves. Layouts 3
 * and 4 differ from 5 and 6 by names of tables and columns alone. */
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

/* Format of the data from the sandbox: tables as bytes (table_bytes.h), then with has_origin the
 * table of inputs; the case file; version and command; a digest for each table and for the case
 * file; this tail. The HDF5 layout has no checksum of the values. Without digests a flipped bit
 * would change a number undetected. */
enum { STORE_DIGEST_SIZE = 65 };

typedef struct store_tail {
    uint64_t has_origin; /* the inputs, the version and the command are present */
    uint64_t n_tables, case_length, origin_length;
} store_tail;

void store_tail_write(FILE *out,
                      const store_tail *tail); /* writes 8 bytes for each member, little-endian */
wt_status store_extract(hid_t file, size_t size, FILE *out,
                        wt_error *err); /* an hdf5_read_function */
/* Variant for the tables with headlines. */
wt_status store_extract_headlines(hid_t file, size_t size, FILE *out, wt_error *err);
bool store_has_headlines(const char *table);
bool store_has_headline_rows(
    const char *table); /* False if only the keys of the table have headlines */
void store_headlines_digest(char hex[STORE_DIGEST_SIZE]); /* digest of the names of these tables */
/* Appends the tables with headlines to a result file that HDF5 has closed. */
wt_status store_abstract_write(FILE *out, const wt_result *result, wt_error *err) WT_NODISCARD;
/* Reads the tables with headlines. WT_END without an abstract or with another set of tables. */
wt_status store_abstract_read(int file, size_t size, const char *name, wt_result **result,
                              wt_error *err) WT_NODISCARD;
/* Prints the samples of a map in blocks of all channels (core/store/force_map.h). Also an
 * hdf5_read_function. */
wt_status store_extract_samples(hid_t file, size_t size, FILE *out, wt_error *err);
/* Reads a result from memory or from a descriptor, with store_extract or store_extract_headlines.
 */
wt_status store_read_bytes(const hdf5_bytes *from, hdf5_read_function *pass, const char *name,
                           wt_result **result, wt_error *err);

struct stat;

/* Creates the error WT_E_CORRUPT for a damaged file of this program, with advice. */
wt_status store_corrupt_error(wt_error *err, const char *place, const char *message);
/* Decodes the data from the sandbox into a result. All bytes are validated. */
wt_status store_decode(const char *bytes, size_t length, wt_result *result, wt_error *err);

typedef struct store_file {
    const char *path; /* borrowed */
    wt_atomic_file *out;
    hdf5_bytes to;
    hid_t file;
    hid_t scalar;         /* scalar dataspace */
    hid_t group_creation; /* without times, with all links and attributes in the header */
    hid_t dataset_creation;
} store_file;

/* The path is borrowed until the end. WT_E_IO if it is not a regular file. */
wt_status store_begin(const char *path, store_file **file, wt_error *err) WT_NODISCARD;
/* Writes the result and gives the file its name. Frees `file`. */
wt_status store_end(store_file *file, const wt_result *result, bool with_provenance,
                    wt_error *err) WT_NODISCARD;
void store_discard(store_file *file); /* removes the incomplete file */
/* Creates the error of HDF5 or of the disk. */
wt_status store_write_error(const store_file *file, wt_error *err);
/* The following functions must be called within hdf5_enter and hdf5_leave. */
hid_t store_create_group(const store_file *file,
                         const char *path); /* creates missing parent groups */
bool store_write_text_attribute(const store_file *file, hid_t object, const char *name,
                                const char *text);
bool store_write_text_list(hid_t object, const char *name, const char *const *words, size_t n);

#endif
