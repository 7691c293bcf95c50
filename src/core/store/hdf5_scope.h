/* Turns at the HDF5 library, which is not thread-safe as it is commonly built and prints its errors
 * unless told not to. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_HDF5_SCOPE_H
#define WT_CORE_STORE_HDF5_SCOPE_H

#include <hdf5.h>

typedef struct hdf5_scope {
    H5E_auto2_t function;
    void *user;
} hdf5_scope;

/* Every use of HDF5 in this library stands between these two, in whatever room it is. They lock
 * (do not nest them) and silence the error messages of this thread. A program that itself calls
 * HDF5 from other threads needs a thread-safe build of it. */
void hdf5_enter(hdf5_scope *scope);
void hdf5_leave(const hdf5_scope *scope);

/* Closes a type, space, attribute, data set, group or list of properties; nothing if negative. */
static inline void hdf5_close(hid_t id)
{
    if (id >= 0)
        (void)H5Idec_ref(id);
}

#endif
