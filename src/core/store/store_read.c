/* Reads results from the HDF5 store. The data from the sandbox must be complete and agree with
 * their digests. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/former_names.h"
#include "core/table/table_bytes.h"

#include "core/base/provenance.h"

#include <endian.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

wt_status store_corrupt_error(wt_error *err, const char *place, const char *message)
{
    (void)wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "%s", place);
    wt_error_advice(err, "make the file again");
    return WT_E_CORRUPT;
}

static void decode_origin(const char *text, size_t length, wt_provenance *provenance)
{
    char *const origin = wt_strndup(text, length);
    provenance_restore(provenance, origin);
    free(origin);
}

static wt_status check_digest(const char *bytes, const char *end, const char *expected,
                              const char *place, wt_error *err)
{
    char digest[STORE_DIGEST_SIZE];
    wt_sha256(bytes, (size_t)(end - bytes), digest);
    return memcmp(digest, expected, sizeof digest) == 0
               ? WT_OK
               : store_corrupt_error(err, place, "the content does not agree with its digest");
}

/* Parts of the data from the sandbox. */
typedef struct store_parts {
    const char *tables, *case_file, *origin, *digests; /* each ends where the next begins */
    store_tail tail;
} store_parts;

static bool split_store_bytes(const char *bytes, size_t length, store_parts *p)
{
    store_tail *const t = &p->tail;
    if (length < sizeof *t)
        return false;
    length -= sizeof *t;
    uint64_t words[sizeof *t / sizeof(uint64_t)];
    memcpy(words, bytes + length, sizeof words);
    *t = (store_tail){.has_origin = le64toh(words[0]) != 0,
                      .n_tables = le64toh(words[1]),
                      .case_length = le64toh(words[2]),
                      .origin_length = le64toh(words[3])};
    const size_t n = t->n_tables + t->has_origin + (t->case_length > 0);
    const size_t digests = n * STORE_DIGEST_SIZE;
    if (t->n_tables > RESULT_TABLES_MAX || digests > length ||
        t->origin_length > length - digests || t->case_length > length - digests - t->origin_length)
        return false;
    p->tables = bytes;
    p->digests = bytes + length - digests;
    p->origin = p->digests - t->origin_length;
    p->case_file = p->origin - t->case_length;
    return true;
}

/* Decodes the tables. The table of inputs goes to the provenance. */
static wt_status decode_tables(const store_parts *p, wt_result *result, wt_error *err)
{
    const char *at = p->tables, *digest = p->digests;
    wt_status status = WT_OK;
    for (uint64_t i = 0; status == WT_OK && i < p->tail.n_tables + p->tail.has_origin; i++) {
        const char *const from = at;
        wt_table *table = NULL;
        status = table_bytes_read(&at, p->case_file, &table, err);
        if (status == WT_OK)
            status = check_digest(from, at, digest, table->name, err);
        digest += STORE_DIGEST_SIZE;
        if (status == WT_OK && i < p->tail.n_tables) {
            table_use_current_names(table);
            status = wt_result_add(result, table, err);
            continue;
        }
        if (status == WT_OK)
            status = store_inputs_read(table, wt_result_provenance(result), err);
        wt_table_free(table);
    }
    if (status == WT_E_ARG)
        status = store_corrupt_error(err, STORE_TABLES_ATTRIBUTE, "not names of tables");
    if (status == WT_OK && at != p->case_file)
        status = store_corrupt_error(err, "", "the content is more than it says");
    if (status == WT_OK && p->tail.case_length > 0)
        status = check_digest(p->case_file, p->origin, digest, STORE_CASE_DATASET, err);
    return status;
}

wt_status store_decode(const char *bytes, size_t length, wt_result *result, wt_error *err)
{
    store_parts p;
    if (!split_store_bytes(bytes, length, &p))
        return store_corrupt_error(err, "", "the content is not whole");
    wt_status status = decode_tables(&p, result, err);
    if (status == WT_OK && p.tail.has_origin)
        decode_origin(p.origin, p.tail.origin_length, wt_result_provenance(result));
    if (status == WT_OK)
        status = wt_result_set_case(result, p.case_file, p.tail.case_length, err);
    return status;
}

wt_status store_read_bytes(const hdf5_bytes *from, hdf5_read_function *pass, const char *name,
                           wt_result **result, wt_error *err)
{
    const sandbox_limits limits = sandbox_limits_for(from->size);
    size_t n = 0;
    char *answer = NULL;
    wt_result *const read = wt_result_new();
    wt_status status = hdf5_sandbox_read(from, &limits, pass, &answer, &n, err);
    if (status == WT_OK)
        status = store_decode(answer, n, read, err);
    free(answer);
    if (status == WT_OK) {
        *result = read;
    } else {
        wt_error_file(err, name);
        wt_result_free(read);
    }
    return status;
}

wt_status wt_store_read_memory(const void *bytes, size_t length, const char *name,
                               wt_result **result, wt_error *err)
{
    /* A file without bytes must not be mistaken for a descriptor. */
    const hdf5_bytes from = {.bytes = length > 0 ? bytes : (const void *)"", .size = length};
    return store_read_bytes(&from, store_extract, name, result, err);
}

/* Opening a pipe without O_NONBLOCK would wait for a writer. */
wt_status store_open_regular(const char *path, int *file, struct stat *info, wt_error *err)
{
    *file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const bool opened = *file >= 0 && fstat(*file, info) == 0;
    wt_status status = WT_OK;
    if (!opened) {
        status = wt_fail(err, errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "%s", strerror(errno));
    } else if (!S_ISREG(info->st_mode)) {
        status = wt_fail(err, WT_E_IO, "not a regular file");
        wt_error_expected(err, "an HDF5 file, which cannot come through a pipe");
    } else if (info->st_size == 0) {
        status = wt_fail(err, WT_E_FORMAT, "an empty file");
    }
    if (status != WT_OK)
        wt_error_file(err, path);
    return status;
}

wt_status wt_store_read(const char *path, wt_result **result, wt_error *err)
{
    struct stat info;
    int file = -1;
    wt_status status = store_open_regular(path, &file, &info, err);
    if (status == WT_OK) {
        const hdf5_bytes from = {.file = file, .size = (size_t)info.st_size};
        status = store_read_bytes(&from, store_extract, path, result, err);
    }
    if (file >= 0)
        (void)close(file);
    return status;
}
