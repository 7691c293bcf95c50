/* Source and destination of HDF5 files: bytes in memory, or an open file descriptor.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_BYTES_H
#define WT_CORE_STORE_HDF5_BYTES_H

#include <hdf5.h>
#include <stdbool.h>

typedef struct hdf5_bytes {
    const unsigned char *bytes; /* read-only; NULL if `file` is used */
    int file;                   /* descriptor for reading, and for writing a new file */
    size_t size;                /* number of bytes to read */
    int failed; /* errno of the first write error, after which nothing is written. HDF5 is not
                   informed, because it does not survive a full disk */
} hdf5_bytes;

/* Sets an access list to use these bytes for any file name. The bytes must outlive the file. */
bool hdf5_bytes_set_driver(hid_t access, hdf5_bytes *bytes);
/* Copies n bytes from the position `from`; bytes after the end are zero. False if reading fails. */
bool hdf5_bytes_read(const hdf5_bytes *bytes, size_t from, void *to, size_t n);

#endif
