/* Reads HDF5 files in the sandbox. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/hdf5_sandbox.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

/* State of an open file in HDF5. */
typedef struct open_file {
    H5FD_t base; /* required by HDF5 */
    hdf5_bytes *source;
    haddr_t eoa, eof; /* end of the allocated space, end of the file */
} open_file;

/* Private data of the driver in an access list. */
typedef struct driver_info {
    hdf5_bytes *source;
} driver_info;

/* Copies n bytes from the position `from`; bytes after the end are zero. False if reading fails. */
static bool hdf5_bytes_read(const hdf5_bytes *bytes, size_t from, void *to, size_t n)
{
    size_t got = 0;
    if (bytes->bytes != NULL && from < bytes->size) {
        got = n < bytes->size - from ? n : bytes->size - from;
        memcpy(to, bytes->bytes + from, got);
    }
    while (bytes->bytes == NULL && got < n) {
        const ssize_t more =
            pread(bytes->file, (unsigned char *)to + got, n - got, (off_t)(from + got));
        if (more < 0 && errno == EINTR)
            continue;
        if (more < 0)
            return false;
        if (more == 0)
            break;
        got += (size_t)more;
    }
    memset((unsigned char *)to + got, 0, n - got);
    return true;
}

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    const driver_info *const info = H5Pget_driver_info(access);
    (void)name;
    (void)flags;
    (void)most;
    if (info == NULL)
        return NULL;
    open_file *const f = wt_alloc(1, sizeof *f);
    f->source = info->source;
    f->eof = info->source->size;
    return &f->base;
}

static herr_t driver_close(H5FD_t *file)
{
    free(file);
    return 0;
}

static herr_t driver_query(const H5FD_t *file, unsigned long *flags)
{
    (void)file;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

static haddr_t get_eoa(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const open_file *)(const void *)file)->eoa;
}

static herr_t set_eoa(H5FD_t *file, H5FD_mem_t type, haddr_t end)
{
    (void)type;
    ((open_file *)(void *)file)->eoa = end;
    return 0;
}

static haddr_t get_eof(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const open_file *)(const void *)file)->eof;
}

static herr_t driver_read(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t from, size_t n,
                          void *to)
{
    (void)type;
    (void)transfer;
    return hdf5_bytes_read(((open_file *)(void *)file)->source, from, to, n) ? 0 : -1;
}

static herr_t driver_write(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t n,
                           const void *from)
{
    open_file *const f = (open_file *)(void *)file;
    size_t put = 0;
    (void)type;
    (void)transfer;
    while (f->source->failed == 0 && put < n) {
        const ssize_t more =
            pwrite(f->source->file, (const unsigned char *)from + put, n - put, (off_t)(at + put));
        if (more < 0 && errno != EINTR)
            f->source->failed = errno;
        put += more > 0 ? (size_t)more : 0;
    }
    f->eof = at + n > f->eof ? at + n : f->eof;
    return 0;
}

static herr_t driver_truncate(H5FD_t *file, hid_t transfer, hbool_t closing)
{
    open_file *const f = (open_file *)(void *)file;
    (void)transfer;
    (void)closing;
    if (f->source->failed == 0 && f->eof != f->eoa &&
        ftruncate(f->source->file, (off_t)f->eoa) != 0)
        f->source->failed = errno;
    f->eof = f->eoa;
    return 0;
}

static const H5FD_class_t driver = {
#if H5_VERSION_GE(1, 13, 0)
    .version = H5FD_CLASS_VERSION,
    .value = 300,
#endif
    .name = "weartrack",
    .maxaddr = INT64_MAX,
    .fc_degree = H5F_CLOSE_STRONG,
    .fapl_size = sizeof(driver_info),
    .open = driver_open,
    .close = driver_close,
    .query = driver_query,
    .get_eoa = get_eoa,
    .set_eoa = set_eoa,
    .get_eof = get_eof,
    .read = driver_read,
    .write = driver_write,
    .truncate = driver_truncate,
    .fl_map = H5FD_FLMAP_DICHOTOMY};

bool hdf5_bytes_set_driver(hid_t access, hdf5_bytes *bytes)
{
    /* Called within hdf5_enter and hdf5_leave. The library frees the driver at the end of the
     * program. */
    static hid_t registered = -1;
    const driver_info info = {bytes};
    if (registered < 0 || H5Iis_valid(registered) <= 0)
        registered = H5FDregister(&driver);
    return registered >= 0 && H5Pset_driver(access, registered, &info) >= 0;
}

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
