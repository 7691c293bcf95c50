/* The door to HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/hdf5_door.h"
#include "data/hdf5_scope.h"

#include <string.h>

#define MIB ((size_t)1 << 20)

/* ---- behind the door ------------------------------------------------------------------------- */

/* HDF5 asks for copies of the image in memory and gets the image itself: it only reads. The process
 * has one thread and reads one file. */
static const unsigned char *image;

static void *take_image(size_t size, H5FD_file_image_op_t operation, void *user)
{
    (void)size;
    (void)operation;
    (void)user;
    return (void *)(uintptr_t)image;
}

static void *copy_image(void *to, const void *from, size_t size, H5FD_file_image_op_t operation,
                        void *user)
{
    (void)from;
    (void)size;
    (void)operation;
    (void)user;
    return to;
}

static herr_t leave_image(void *bytes, H5FD_file_image_op_t operation, void *user)
{
    (void)bytes;
    (void)operation;
    (void)user;
    return 0;
}

/* HDF5 begins at 0, 512, 1024, 2048, ... */
static bool has_signature(size_t size)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1A, '\n'};
    for (size_t at = 0; at + sizeof signature <= size; at = at > 0 ? 2 * at : 512) {
        if (memcmp(image + at, signature, sizeof signature) == 0)
            return true;
    }
    return false;
}

static hid_t open_image(size_t size)
{
    H5FD_file_image_callbacks_t callbacks = {
        .image_malloc = take_image, .image_memcpy = copy_image, .image_free = leave_image};
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access < 0 || H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) < 0 ||
        H5Pset_fapl_core(access, MIB, false) < 0 ||
        H5Pset_file_image_callbacks(access, &callbacks) < 0 ||
        H5Pset_file_image(access, (void *)(uintptr_t)image, size) < 0)
        return -1;
    return H5Fopen("weartrack.h5", H5F_ACC_RDONLY, access);
}

static wt_status read_image(const door_call *door, FILE *answer, wt_error *err)
{
    hdf5_reading *const *reading = door->with;
    image = door->bytes;
    if (!has_signature(door->size))
        return wt_fail(err, WT_E_FORMAT, "not an HDF5 file, or its first bytes are damaged");
    const hid_t file = open_image(door->size);
    if (file >= 0)
        return (*reading)(file, door->size, answer, err);
    wt_fail(err, WT_E_CORRUPT, "the HDF5 file is damaged or cut off");
    wt_error_advice(err, "make the file again");
    return WT_E_CORRUPT;
}

/* ---- in front of it -------------------------------------------------------------------------- */

static void enter(void *scope)
{
    hdf5_enter(scope);
}

static void leave(void *scope)
{
    hdf5_leave(scope);
}

wt_status hdf5_door_read(const void *bytes, size_t size, const door_limits *limits,
                         hdf5_reading *reading, char **answer, size_t *length, wt_error *err)
{
    hdf5_scope scope;
    const door_call door = {.what = "HDF5",
                            .reading = read_image,
                            .bytes = bytes,
                            .size = size,
                            .with = &reading,
                            .file = -1,
                            .enter = enter,
                            .leave = leave,
                            .hold = &scope};
    return door_read(&door, limits, answer, length, err);
}
