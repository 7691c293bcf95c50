/* Abstract of a result file: a copy of the tables with headlines after the end of the HDF5 data,
 * encoded as in store.h. It is read without HDF5 and without a process, so that the headlines of
 * thousands of files are read fast. Its bytes are validated like the output of the sandbox. A
 * program that opens the file for writing truncates the abstract, so that it is never outdated.
 * Without an abstract, or with one for another set of tables, the file is read with HDF5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/table.h"
#include "core/table/table_bytes.h"

#include <endian.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The last bytes of the file: the length of the abstract before them, and a mark. A new layout gets
 * a new mark. */
typedef struct abstract_trailer {
    uint64_t length; /* little-endian */
    char mark[8];
} abstract_trailer;
static const char mark[8] = {'W', 'T', 'A', 'B', 'S', 'T', '2', '\n'};

/* ---- writing --------------------------------------------------------------------------------- */

static wt_status write_table_abstract(FILE *out, const wt_table *table, char *digest, wt_error *err)
{
    /* Most tables have headlines in their keys only, and some of these tables are long. */
    wt_table part = *table;
    if (!store_has_headline_rows(table->name)) {
        part.n_rows = 0;
        part.n_blocks = 0;
    }
    const wt_status status = table_bytes_digest(&part, digest, err);
    return status == WT_OK ? table_bytes_write(out, &part, err) : status;
}

wt_status store_abstract_write(FILE *out, const wt_result *result, wt_error *err)
{
    store_tail tail = {.n_tables = 0};
    const size_t n = wt_result_n_tables(result);
    char(*const digests)[STORE_DIGEST_SIZE] = calloc(n + 1, sizeof *digests);
    const long from = fseek(out, 0, SEEK_END) == 0 ? ftell(out) : -1;
    wt_status status = digests != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        const wt_table *const table = wt_result_table(result, i);
        if (store_has_headlines(table->name))
            status = write_table_abstract(out, table, digests[tail.n_tables++], err);
    }
    if (status == WT_OK) {
        (void)fwrite(digests, sizeof *digests, tail.n_tables, out);
        store_tail_write(out, &tail);
        char of[STORE_DIGEST_SIZE];
        store_headlines_digest(of);
        (void)fwrite(of, sizeof of, 1, out);
        const long to = ftell(out);
        abstract_trailer end = {.length = htole64((uint64_t)(to - from))};
        memcpy(end.mark, mark, sizeof mark);
        if (from < 0 || to < from || fwrite(&end, sizeof end, 1, out) != 1 || fflush(out) != 0)
            status = wt_fail(err, WT_E_IO, "cannot write the file: %s", strerror(errno));
    }
    free(digests);
    return status;
}

/* ---- reading --------------------------------------------------------------------------------- */

static bool read_exactly(int file, size_t at, void *to, size_t n)
{
    for (size_t got = 0; got < n;) {
        const ssize_t more = pread(file, (char *)to + got, n - got, (off_t)(at + got));
        if (more == 0 || (more < 0 && errno != EINTR))
            return false;
        got += more > 0 ? (size_t)more : 0;
    }
    return true;
}

/* Larger abstracts are ignored. A malicious abstract needs at most some twenty times this memory: a
 * text of two bytes needs a pointer and an allocation. The abstract of a whole case has about 40
 * kB. */
#define ABSTRACT_SIZE_MAX ((size_t)2 << 20)

/* True if the abstract has the current set of tables with headlines. */
static bool is_current_abstract(const char *bytes, size_t length)
{
    char of[STORE_DIGEST_SIZE];
    store_headlines_digest(of);
    return length >= sizeof of && memcmp(bytes + length - sizeof of, of, sizeof of) == 0;
}

/* Returns the bytes of the abstract, which the caller frees. NULL without a usable abstract or
 * without memory. */
static char *read_abstract_bytes(int file, size_t size, size_t *length)
{
    abstract_trailer end;
    if (size < sizeof end)
        return NULL;
    const size_t before = size - sizeof end;
    if (!read_exactly(file, before, &end, sizeof end) || memcmp(end.mark, mark, sizeof mark) != 0)
        return NULL;
    *length = (size_t)le64toh(end.length);
    const bool whole = *length > 0 && *length <= before && *length <= ABSTRACT_SIZE_MAX;
    char *const bytes = whole ? malloc(*length) : NULL;
    if (bytes != NULL && read_exactly(file, before - *length, bytes, *length) &&
        is_current_abstract(bytes, *length)) {
        *length -= STORE_DIGEST_SIZE;
        return bytes;
    }
    free(bytes);
    return NULL;
}

wt_status store_abstract_read(int file, size_t size, const char *name, wt_result **result,
                              wt_error *err)
{
    size_t length = 0;
    char *const bytes = read_abstract_bytes(file, size, &length);
    if (bytes == NULL)
        return WT_END;
    wt_result *const read = wt_result_new();
    const wt_status status = read != NULL ? store_decode(bytes, length, read, err)
                                          : wt_fail(err, WT_E_MEMORY, "out of memory");
    free(bytes);
    if (status == WT_OK) {
        *result = read;
    } else {
        wt_error_file(err, name);
        wt_result_free(read);
    }
    return status;
}

wt_status wt_store_read_main_values(const char *path, wt_result **result, wt_error *err)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char begin[sizeof signature];
    struct stat info;
    int file = -1;
    wt_status status = store_open_regular(path, &file, &info, err);
    if (status == WT_OK && (pread(file, begin, sizeof begin, 0) != (ssize_t)sizeof begin ||
                            memcmp(begin, signature, sizeof begin) != 0)) {
        status = wt_fail(err, WT_E_FORMAT, "not an HDF5 file");
        wt_error_file(err, path);
    }
    if (status == WT_OK)
        status = store_abstract_read(file, (size_t)info.st_size, path, result, err);
    if (status == WT_END) {
        const hdf5_bytes from = {.file = file, .size = (size_t)info.st_size};
        status = store_read_bytes(&from, store_extract_headlines, path, result, err);
    }
    if (file >= 0)
        (void)close(file);
    return status;
}
