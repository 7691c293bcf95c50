/* Result file during writing. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_STORE_FILE_H
#define WT_CORE_STORE_STORE_FILE_H

#include "core/store/hdf5_bytes.h"
#include "core/store/store.h"

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
