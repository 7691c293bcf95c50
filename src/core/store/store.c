/* Reads results from the HDF5 store. The data from the sandbox must be
 * complete and agree with their digests. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/registry.h"
#include "core/table/table.h"

#include <endian.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

wt_status wt_provenance_table(const wt_provenance *provenance, const char *name, wt_table **table,
                              wt_error *err)
{
    table_writer t = table_begin_variant(&inputs_schema, (table_variant){.name = name}, err);
    for (size_t i = 0; i < wt_provenance_n_inputs(provenance); i++) {
        const wt_provenance_input *const input = wt_provenance_get_input(provenance, i);
        table_row(&t);
        inputs_put_text(&t, INPUTS_PATH, input->path);
        inputs_put_text(&t, INPUTS_ROLE, wt_provenance_input_role(input));
        inputs_put_text(&t, INPUTS_FORMAT, input->format);
        inputs_put_text(&t, INPUTS_INSTRUMENT, input->instrument);
        inputs_put(&t, INPUTS_BYTES, (double)input->bytes);
        inputs_put_text(&t, INPUTS_SHA256, input->sha256);
    }
    return table_end(&t, table);
}

/* Converts a table of wt_provenance_table back to the inputs of a provenance. */
static wt_status store_inputs_read(const wt_table *table, wt_provenance *provenance, wt_error *err)
{
    table_view t;
    if (table_bind(table, &inputs_schema, "", &t, err) != WT_OK) {
        if (err != NULL)
            err->status = WT_E_CORRUPT;
        return WT_E_CORRUPT;
    }
    for (size_t row = 0; row < t.n_rows; row++) {
        wt_provenance_input input = {.path = inputs_text(&t, row, INPUTS_PATH),
                                     .role = (wt_input_role)inputs_enum(&t, row, INPUTS_ROLE),
                                     .format = inputs_text(&t, row, INPUTS_FORMAT),
                                     .instrument = inputs_text(&t, row, INPUTS_INSTRUMENT)};
        if (input.role == WT_ROLE_GROUP)
            input.group = inputs_text(&t, row, INPUTS_ROLE);
        const double bytes = inputs_get(&t, row, INPUTS_BYTES);
        const char *const sha256 = inputs_text(&t, row, INPUTS_SHA256);
        /* 2^63 is exact; a larger, negative or NaN size is invalid. */
        if (!(bytes >= 0.0 && bytes < ldexp(1.0, 63)) || strlen(sha256) >= sizeof input.sha256)
            return wt_fail(err, WT_E_CORRUPT, "size or digest of an input is not one");
        input.bytes = (uint64_t)bytes;
        memcpy(input.sha256, sha256, strlen(sha256) + 1);
        wt_provenance_add_input(provenance, &input);
    }
    return WT_OK;
}

/* Creates the error WT_E_CORRUPT for a damaged file of this program, with advice. */
static wt_status store_corrupt_error(wt_error *err, const char *place, const char *message)
{
    (void)wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "%s", place);
    wt_error_advice(err, "make the file again");
    return WT_E_CORRUPT;
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
    if (status == WT_OK && p.tail.has_origin) {
        char *const origin = wt_strndup(p.origin, p.tail.origin_length);
        provenance_restore(wt_result_provenance(result), origin);
        free(origin);
    }
    if (status == WT_OK)
        wt_result_set_case(result, p.case_file, p.tail.case_length);
    return status;
}

static wt_status store_read_bytes(const hdf5_bytes *from, hdf5_read_function *extract,
                                  const char *name, wt_result **result, wt_error *err)
{
    const sandbox_limits limits = sandbox_limits_for(from->size);
    size_t n = 0;
    char *answer = NULL;
    wt_result *const read = wt_result_new();
    wt_status status = hdf5_sandbox_read(from, &limits, extract, &answer, &n, err);
    if (status == WT_OK)
        status = store_decode(answer, n, read, err);
    if (status == WT_OK) {
        *result = read;
    } else {
        wt_error_file(err, name);
        wt_result_free(read);
    }
    free(answer);
    return status;
}

wt_status wt_store_read_memory(const void *bytes, size_t length, const char *name,
                               wt_result **result, wt_error *err)
{
    /* A file without bytes must not be mistaken for a descriptor. */
    const hdf5_bytes from = {.bytes = length > 0 ? bytes : (const void *)"", .size = length};
    return store_read_bytes(&from, store_extract, name, result, err);
}

wt_status store_read(const char *path, hdf5_read_function *extract, wt_result **result,
                     wt_error *err)
{
    struct stat info;
    wt_status status;
    /* Opening a pipe without O_NONBLOCK would wait for a writer. */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 || fstat(file, &info) != 0) {
        status = wt_fail(err, errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "%s", strerror(errno));
    } else if (!S_ISREG(info.st_mode)) {
        status = wt_fail(err, WT_E_IO, "not a regular file");
        wt_error_expected(err, "an HDF5 file, which cannot come through a pipe");
    } else if (info.st_size == 0) {
        status = wt_fail(err, WT_E_FORMAT, "an empty file");
    } else {
        const hdf5_bytes from = {.file = file, .size = (size_t)info.st_size};
        status = store_read_bytes(&from, extract, path, result, err);
    }
    if (status != WT_OK)
        wt_error_file(err, path);
    if (file >= 0)
        (void)close(file);
    return status;
}

wt_status wt_store_read(const char *path, wt_result **result, wt_error *err)
{
    return store_read(path, store_extract, result, err);
}
