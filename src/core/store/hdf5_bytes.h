/* Where HDF5 finds and leaves the bytes of a file: in memory, or behind a descriptor that is open
 * already. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_BYTES_H
#define WT_CORE_STORE_HDF5_BYTES_H

#include <hdf5.h>
#include <stdbool.h>

typedef struct hdf5_bytes {
    const unsigned char *bytes; /* only read; NULL: the file */
    int file;                   /* its descriptor, for reading and, where it is made, for writing */
    size_t size;                /* of what there is to read */
    int failed; /* the number of the first error of writing: nothing is written after it. HDF5,
                   which does not survive a full disk, is not told */
} hdf5_bytes;

/* Has a file that is opened or created with this access list, under any name, be these bytes, which
 * must outlive it. */
bool hdf5_bytes_access(hid_t access, hdf5_bytes *bytes);
/* Copies so many bytes from there; what is not there is zero. False if they cannot be read. */
bool hdf5_bytes_at(const hdf5_bytes *bytes, size_t from, void *to, size_t n);

#endif
