/* HDF5 files that are made in memory. The image that H5Fget_file_image gives of an open file has a
 * wrong checksum in HDF5 1.10, so the memory is taken over when the file is closed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/hdf5_image.h"

#include <stdlib.h>

enum { INCREMENT = 1 << 20 };

static void *resize(void *bytes, size_t size, H5FD_file_image_op_t operation, void *user)
{
    (void)operation;
    (void)user;
    return realloc(bytes, size);
}

static herr_t release(void *bytes, H5FD_file_image_op_t operation, void *user)
{
    hdf5_image *const image = user;
    if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE && image->bytes == NULL)
        image->bytes = bytes;
    else
        free(bytes);
    return 0;
}

static void *share_user(void *user)
{
    return user;
}

static herr_t leave_user(void *user)
{
    (void)user; /* the caller's */
    return 0;
}

bool hdf5_image_access(hid_t access, hdf5_image *image)
{
    H5FD_file_image_callbacks_t callbacks = {.image_realloc = resize,
                                             .image_free = release,
                                             .udata_copy = share_user,
                                             .udata_free = leave_user,
                                             .udata = image};
    *image = (hdf5_image){NULL, 0};
    return H5Pset_fapl_core(access, INCREMENT, false) >= 0 &&
           H5Pset_file_image_callbacks(access, &callbacks) >= 0;
}

bool hdf5_image_close(hid_t file, hdf5_image *image)
{
    /* What was flushed is all there will be: closing only marks the file as closed. */
    const bool flushed = H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
    const ssize_t size = flushed ? H5Fget_file_image(file, NULL, 0) : -1;
    if (H5Fclose(file) < 0 || size <= 0 || image->bytes == NULL) {
        free(image->bytes);
        *image = (hdf5_image){NULL, 0};
        return false;
    }
    image->size = (size_t)size;
    return true;
}
