/* Lock and error handler of the HDF5 library. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/hdf5_scope.h"

#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

void hdf5_enter(hdf5_scope *scope)
{
    (void)pthread_mutex_lock(&lock);
    *scope = (hdf5_scope){NULL, NULL};
    (void)H5Eget_auto2(H5E_DEFAULT, &scope->function, &scope->user);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

void hdf5_leave(const hdf5_scope *scope)
{
    (void)H5Eclear2(H5E_DEFAULT);
    (void)H5Eset_auto2(H5E_DEFAULT, scope->function, scope->user);
    (void)pthread_mutex_unlock(&lock);
}
