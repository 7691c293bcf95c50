/* HDF5 files that are made in memory. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_HDF5_IMAGE_H
#define WT_DATA_HDF5_IMAGE_H

#include <hdf5.h>
#include <stdbool.h>

/* The bytes of a file, to be released with free(). */
typedef struct hdf5_image {
    void *bytes;
    size_t size;
} hdf5_image;

/* Makes a file that is created with this access list live in memory: nothing is written under its
 * name, so HDF5 meets no full disk, which it does not survive. `image` must outlive the file. */
bool hdf5_image_access(hid_t access, hdf5_image *image);
/* Closes the file; then the image holds it. False if HDF5 failed, and there is no image. */
bool hdf5_image_close(hid_t file, hdf5_image *image);

#endif
