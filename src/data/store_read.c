/* The HDF5 store to results: what comes through the door must be whole and agree with its digest.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/store.h"

#include "base/provenance.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static wt_status corrupt(wt_error *err, const char *place, const char *message)
{
    (void)wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "%s", place);
    wt_error_advice(err, "make the file again");
    return WT_E_CORRUPT;
}

static wt_status take_command(const char *text, size_t length, wt_provenance *provenance)
{
    char *const command = strndup(text, length);
    const wt_status status =
        command != NULL ? provenance_restore_command(provenance, command) : WT_E_MEMORY;
    free(command);
    return status;
}

/* The tables of the stream; the list of inputs belongs to the provenance. */
static wt_status take_tables(const char *text, size_t length, bool has_origin, wt_result *result,
                             wt_error *err)
{
    wt_status status = WT_OK;
    FILE *const in = fmemopen((void *)(uintptr_t)text, length, "r");
    if (in == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    while (status == WT_OK) {
        wt_table *table = NULL;
        status = wt_stream_read(in, "", &table, err);
        if (status == WT_OK && has_origin && strcmp(table->name, STORE_INPUTS_TABLE) == 0) {
            status = store_inputs_read(table, wt_result_provenance(result), err);
            wt_table_free(table);
        } else if (status == WT_OK) {
            status = wt_result_add(result, table, err);
        }
    }
    (void)fclose(in);
    if (status == WT_E_ARG)
        status = corrupt(err, STORE_TABLES_ATTRIBUTE, "not names of tables");
    return status == WT_END ? WT_OK : status;
}

wt_status store_take(const char *bytes, size_t length, wt_result *result, wt_error *err)
{
    store_tail tail;
    char digest[65];
    if (length < sizeof tail)
        return corrupt(err, "", "the content is not whole");
    length -= sizeof tail;
    memcpy(&tail, bytes + length, sizeof tail);
    if (tail.command_length > length || tail.case_length > length - tail.command_length)
        return corrupt(err, "", "the content is not whole");
    length -= tail.command_length;
    wt_digest(bytes, length, digest);
    if (memcmp(digest, tail.digest, sizeof digest) != 0)
        return corrupt(err, STORE_DIGEST_ATTRIBUTE, "the content does not agree with its digest");
    wt_status status = tail.has_origin ? take_command(bytes + length, tail.command_length,
                                                      wt_result_provenance(result))
                                       : WT_OK;
    length -= tail.case_length;
    if (status == WT_OK)
        status = wt_result_set_case(result, bytes + length, tail.case_length, err);
    if (status == WT_OK)
        status = take_tables(bytes, length, tail.has_origin, result, err);
    return status == WT_E_MEMORY ? wt_fail(err, WT_E_MEMORY, "out of memory") : status;
}

wt_status store_read_bytes(const hdf5_bytes *from, const char *name, wt_result **result,
                           wt_error *err)
{
    const door_limits limits = door_limits_of(from->size);
    size_t n = 0;
    char *answer = NULL;
    wt_result *const read = wt_result_new();
    wt_status status = read != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = hdf5_door_read(from, &limits, store_pass, &answer, &n, err);
    if (status == WT_OK)
        status = store_take(answer, n, read, err);
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
    /* No bytes are bytes in memory, too. */
    const hdf5_bytes from = {.bytes = length > 0 ? bytes : (const void *)"", .size = length};
    return store_read_bytes(&from, name, result, err);
}

wt_status wt_store_read(const char *path, wt_result **result, wt_error *err)
{
    struct stat info;
    wt_status status = WT_OK;
    /* Opening a pipe would wait for somebody who writes. */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const bool opened = file >= 0 && fstat(file, &info) == 0;
    if (!opened) {
        status = wt_fail(err, errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "%s", strerror(errno));
    } else if (!S_ISREG(info.st_mode)) {
        status = wt_fail(err, WT_E_IO, "not a regular file");
        wt_error_expected(err, "an HDF5 file, which cannot come through a pipe");
    } else if (info.st_size == 0) {
        status = wt_fail(err, WT_E_FORMAT, "an empty file");
    } else {
        const hdf5_bytes from = {.file = file, .size = (size_t)info.st_size};
        status = store_read_bytes(&from, path, result, err);
    }
    if (status != WT_OK)
        wt_error_file(err, path);
    if (file >= 0)
        (void)close(file);
    return status;
}
