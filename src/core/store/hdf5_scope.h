/* Lock and error handler of the HDF5 library. Its common build is not thread-safe and prints its
 * errors. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_SCOPE_H
#define WT_CORE_STORE_HDF5_SCOPE_H

#include <hdf5.h>

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

#endif
