/* Reads HDF5 files in the sandbox. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/hdf5_sandbox.h"
#include "core/store/hdf5_scope.h"

#include <string.h>

/* ---- in the sandbox -------------------------------------------------------------------------- */

/* The HDF5 signature is at 0, 512, 1024, 2048, ... */
static bool has_signature(const hdf5_bytes *file)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1A, '\n'};
    unsigned char found[sizeof signature];
    for (size_t at = 0; at + sizeof signature <= file->size; at = at > 0 ? 2 * at : 512) {
        if (hdf5_bytes_read(file, at, found, sizeof found) &&
            memcmp(found, signature, sizeof signature) == 0)
            return true;
    }
    return false;
}

/* The process has one thread and reads one file. */
static hid_t open_hdf5_bytes(hdf5_bytes *file)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access < 0 || H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) < 0 ||
        !hdf5_bytes_set_driver(access, file))
        return -1;
    return H5Fopen("weartrack.h5", H5F_ACC_RDONLY, access);
}

static wt_status read_hdf5_file(const sandbox_call *request, FILE *answer, wt_error *err)
{
    static hdf5_bytes from; /* the process ends with the file open */
    hdf5_read_function *const *reading = request->with;
    from = (hdf5_bytes){.bytes = request->bytes, .file = SANDBOX_FILE_FD, .size = request->size};
    if (!has_signature(&from))
        return wt_fail(err, WT_E_FORMAT, "not an HDF5 file, or its first bytes are damaged");
    const hid_t file = open_hdf5_bytes(&from);
    if (file >= 0)
        return (*reading)(file, request->size, answer, err);
    wt_fail(err, WT_E_CORRUPT, "the HDF5 file is damaged or cut off");
    wt_error_advice(err, "make the file again");
    return WT_E_CORRUPT;
}

/* ---- in the calling process ------------------------------------------------------------------ */

static void enter_hdf5(void *scope)
{
    hdf5_enter(scope);
}

static void leave_hdf5(void *scope)
{
    hdf5_leave(scope);
}

static sandbox_call hdf5_sandbox_call(const hdf5_bytes *from, hdf5_read_function *const *reading,
                                      hdf5_scope *scope)
{
    return (sandbox_call){.what = "HDF5",
                          .reading = read_hdf5_file,
                          .bytes = from->bytes,
                          .size = from->size,
                          .with = reading,
                          .file = from->bytes != NULL ? -1 : from->file,
                          .enter = enter_hdf5,
                          .leave = leave_hdf5,
                          .hold = scope};
}

wt_status hdf5_sandbox_read(const hdf5_bytes *from, const sandbox_limits *limits,
                            hdf5_read_function *reading, char **answer, size_t *length,
                            wt_error *err)
{
    hdf5_scope scope;
    const sandbox_call request = hdf5_sandbox_call(from, &reading, &scope);
    return sandbox_read(&request, limits, answer, length, err);
}

wt_status hdf5_sandbox_start(const hdf5_bytes *from, const sandbox_limits *limits,
                             hdf5_read_function *reading, sandbox_stream **stream, wt_error *err)
{
    hdf5_scope scope;
    const sandbox_call request = hdf5_sandbox_call(from, &reading, &scope);
    return sandbox_start(&request, limits, stream, err);
}
