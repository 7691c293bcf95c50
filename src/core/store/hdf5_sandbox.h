/* Reads HDF5 files in the sandbox. A malicious file can crash the HDF5 library (1.10 in many ways).
 * Therefore a separate process opens the file (core/system/sandbox.h). It cannot open any other
 * file, so that external links have no effect.
 *
 * The HDF5 lock is held while the process is created (hdf5_enter). A program that itself calls
 * HDF5 in another thread may leave the lock locked. Reading then ends at the time limit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_SANDBOX_H
#define WT_CORE_STORE_HDF5_SANDBOX_H

#include "core/system/sandbox.h"

#include <hdf5.h>

/* Source and destination of HDF5 files. */
typedef struct hdf5_bytes {
    const unsigned char *bytes; /* read-only; NULL if `file` is used */
    int file;                   /* descriptor for reading, and for writing a new file */
    size_t size;                /* number of bytes to read */
    int failed; /* errno of the first write error, after which nothing is written. HDF5 is not
                   informed, because it does not survive a full disk */
} hdf5_bytes;

/* Lock and error handler of the HDF5 library, whose common build is not thread-safe. */
typedef struct hdf5_scope {
    H5E_auto2_t function;
    void *user;
} hdf5_scope;

/* Every use of HDF5 in this library is between these two calls. They lock HDF5 (do not nest them)
 * and disable the error messages of this thread. A program that itself calls HDF5 in other threads
 * needs a thread-safe build of HDF5. */
void hdf5_enter(hdf5_scope *scope);
void hdf5_leave(const hdf5_scope *scope);

/* Closes a type, space, attribute, data set, group or property list; negative identifiers are
 * ignored. */
static inline void hdf5_close(hid_t id)
{
    if (id >= 0)
        (void)H5Idec_ref(id);
}

/* Function that runs in the sandbox. It reads the required data of the file of `size` bytes and
 * prints them. It may use memory and HDF5 only. */
typedef wt_status hdf5_read_function(hid_t file, size_t size, FILE *answer, wt_error *err);

/* Returns the output of `reading`, like sandbox_read. */
wt_status hdf5_sandbox_read(const hdf5_bytes *from, const sandbox_limits *limits,
                            hdf5_read_function *reading, char **answer, size_t *length,
                            wt_error *err) WT_NODISCARD;
/* Variant that returns the output as a stream (core/system/sandbox.h). The bytes or the descriptor
 * may be closed after the call. */
wt_status hdf5_sandbox_start(const hdf5_bytes *from, const sandbox_limits *limits,
                             hdf5_read_function *reading, sandbox_stream **stream,
                             wt_error *err) WT_NODISCARD;
/* Sets an access list to use these bytes for any file name. The bytes must outlive the file. */
bool hdf5_bytes_set_driver(hid_t access, hdf5_bytes *bytes);

#endif
