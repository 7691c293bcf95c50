/* HDF5 file driver for bytes in memory or behind a descriptor. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/store/hdf5_bytes.h"

#include <errno.h>
#include <stdint.h>
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

bool hdf5_bytes_read(const hdf5_bytes *bytes, size_t from, void *to, size_t n)
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
    open_file *const f = info != NULL ? calloc(1, sizeof *f) : NULL;
    (void)name;
    (void)flags;
    (void)most;
    if (f == NULL)
        return NULL;
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
    /* Called within hdf5_scope.h. The library frees the driver at the end of the program. */
    static hid_t registered = -1;
    const driver_info info = {bytes};
    if (registered < 0 || H5Iis_valid(registered) <= 0)
        registered = H5FDregister(&driver);
    return registered >= 0 && H5Pset_driver(access, registered, &info) >= 0;
}
