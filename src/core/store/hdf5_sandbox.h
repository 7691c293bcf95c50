/* Reads HDF5 files in the sandbox. A malicious file can crash the HDF5 library (1.10 in many ways).
 * Therefore a separate process opens the file (core/system/sandbox.h). It cannot open any other
 * file, so that external links have no effect.
 *
 * The HDF5 lock is held while the process is created (hdf5_scope.h). A program that itself calls
 * HDF5 in another thread may leave the lock locked. Reading then ends at the time limit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_SANDBOX_H
#define WT_CORE_STORE_HDF5_SANDBOX_H

#include "core/store/hdf5_bytes.h"
#include "core/system/sandbox.h"

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

#endif
