/* The one door through which bytes of HDF5 come in. A file that was made for it crashes the HDF5
 * library (1.10 by many ways, and there is no end of them), so the library opens it in a process of
 * its own (core/system/sandbox.h), which can open no other file: nothing leads out of this one.
 *
 * HDF5's lock is held while the process is made (hdf5_scope.h). A program that calls HDF5 itself
 * from another thread may leave it locked: then reading ends at the limit of time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_SANDBOX_H
#define WT_CORE_STORE_HDF5_SANDBOX_H

#include "core/store/hdf5_bytes.h"
#include "core/system/sandbox.h"

/* Runs behind the door: reads of the file, of so many bytes, what is wanted and prints it, tables
 * say. Only memory and HDF5 may be used. */
typedef wt_status hdf5_reading(hid_t file, size_t size, FILE *answer, wt_error *err);

/* Gives what `reading` printed, as sandbox_read does. */
wt_status hdf5_sandbox_read(const hdf5_bytes *from, const sandbox_limits *limits,
                            hdf5_reading *reading, char **answer, size_t *length,
                            wt_error *err) WT_NODISCARD;
/* The same as it comes (core/system/sandbox.h). The bytes or the descriptor need not outlive the
 * call. */
wt_status hdf5_sandbox_start(const hdf5_bytes *from, const sandbox_limits *limits,
                             hdf5_reading *reading, sandbox_stream **flow,
                             wt_error *err) WT_NODISCARD;

#endif
