/* ZIP archives through libzip, from memory, with every size checked before it is believed.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/archive.h"

#include <stdlib.h>
#include <string.h>
#include <zip.h>

/* Deflate cannot pack more tightly than 1032 : 1 (zlib, "Maximum compression factor"); the rest
 * allows for entries of a few bytes. */
#define MAX_RATIO 1032u
#define RATIO_SLACK 64u

static wt_status open_source(zip_source_t *source, zip_t **zip, zip_error_t *error)
{
    if (source == NULL)
        return WT_E_MEMORY;
    *zip = zip_open_from_source(source, ZIP_RDONLY, error);
    if (*zip != NULL)
        return WT_OK;
    zip_source_free(source);
    return WT_E_CORRUPT;
}

wt_status archive_open(wt_input *input, zip_archive **archive, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    zip_error_t error;
    zip_archive *a = NULL;
    zip_error_init(&error);
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        goto done;
    a = calloc(1, sizeof *a);
    if (a == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "no memory for the archive");
        goto done;
    }
    status = open_source(zip_source_buffer_create(bytes, length, 0, &error), &a->zip, &error);
    if (status == WT_E_CORRUPT) {
        size_t directory_length = 0, end = 0, n = 0;
        status = archive_rebuild(bytes, length, &a->directory, &directory_length, &end, &n, err);
        if (status != WT_OK)
            goto done;
        a->truncated = true;
        status = WT_E_CORRUPT;
        if (n > 0) {
            /* libzip only reads these; its fragments are not const because it may own them. */
            zip_buffer_fragment_t parts[2];
            memcpy(&parts[0].data, &bytes, sizeof bytes);
            parts[0].length = end;
            parts[1].data = a->directory;
            parts[1].length = directory_length;
            status = open_source(zip_source_buffer_fragment_create(parts, 2, 0, &error), &a->zip,
                                 &error);
        }
    }
    if (status != WT_OK) {
        wt_fail(err, status, "the ZIP archive cannot be opened");
        wt_error_found(err, "%s", zip_error_strerror(&error));
        wt_error_advice(err, "copy the file again from the instrument");
        goto done;
    }
    zip_int64_t n = zip_get_num_entries(a->zip, 0);
    if (n <= 0) {
        status = wt_fail(err, WT_E_CORRUPT, "the ZIP archive is empty");
        goto done;
    }
    a->n = (size_t)n;
    *archive = a;
    a = NULL;
done:
    zip_error_fini(&error);
    archive_close(a);
    return status;
}

void archive_close(zip_archive *archive)
{
    if (archive == NULL)
        return;
    if (archive->zip != NULL)
        zip_discard(archive->zip);
    free(archive->directory);
    free(archive);
}

const char *archive_name(const zip_archive *archive, size_t i)
{
    const char *name = zip_get_name(archive->zip, i, ZIP_FL_ENC_RAW);
    return name != NULL ? name : "";
}

bool archive_find(const zip_archive *archive, const char *name, size_t *i)
{
    zip_int64_t found = zip_name_locate(archive->zip, name, ZIP_FL_ENC_RAW);
    if (found < 0)
        return false;
    *i = (size_t)found;
    return true;
}

static wt_status entry_fail(const zip_archive *archive, size_t i, wt_error *err, wt_status status,
                            const char *message)
{
    wt_fail(err, status, "%s", message);
    wt_error_place(err, "%s", archive_name(archive, i));
    return status;
}

wt_status archive_size(const zip_archive *archive, size_t i, size_t *size, wt_error *err)
{
    static const zip_uint64_t needed =
        ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    zip_stat_t st;
    if (zip_stat_index(archive->zip, i, 0, &st) != 0 || (st.valid & needed) != needed)
        return entry_fail(archive, i, err, WT_E_CORRUPT, "archive entry has no size");
    if (st.encryption_method != ZIP_EM_NONE)
        return entry_fail(archive, i, err, WT_E_UNSUPPORTED, "archive entry is encrypted");
    if (st.comp_method != ZIP_CM_STORE && st.comp_method != ZIP_CM_DEFLATE)
        return entry_fail(archive, i, err, WT_E_UNSUPPORTED,
                          "archive entry is packed by another method than deflate");
    if (st.comp_size > SIZE_MAX / (2 * MAX_RATIO) ||
        st.size > st.comp_size * MAX_RATIO + RATIO_SLACK) {
        entry_fail(archive, i, err, WT_E_CORRUPT, "archive entry declares an impossible size");
        wt_error_found(err, "%llu bytes out of %llu", (unsigned long long)st.size,
                       (unsigned long long)st.comp_size);
        return WT_E_CORRUPT;
    }
    *size = (size_t)st.size;
    return WT_OK;
}

static wt_status read_all(const zip_archive *archive, size_t i, zip_file_t *file,
                          byte_buffer *buffer, size_t size, wt_error *err)
{
    size_t got = 0;
    /* One byte more than declared: reaching the end makes libzip compare the check sum, and an
     * entry that goes on is found out. */
    for (;;) {
        zip_int64_t n = zip_fread(file, buffer->data + got, size + 1 - got);
        if (n < 0) {
            entry_fail(archive, i, err, WT_E_CORRUPT, "archive entry cannot be unpacked");
            wt_error_found(err, "%s", zip_file_strerror(file));
            return WT_E_CORRUPT;
        }
        if (n == 0)
            break;
        got += (size_t)n;
        if (got > size)
            break;
    }
    if (got != size)
        return entry_fail(archive, i, err, WT_E_CORRUPT,
                          "archive entry is not of the size that it declares");
    buffer->length = size;
    return WT_OK;
}

wt_status archive_read(const zip_archive *archive, size_t i, size_t limit, byte_buffer *buffer,
                       wt_error *err)
{
    size_t size = 0;
    wt_status status = archive_size(archive, i, &size, err);
    if (status != WT_OK)
        return status;
    if (size > limit) {
        entry_fail(archive, i, err, WT_E_CORRUPT, "archive entry is too large for what it is");
        wt_error_expected(err, "at most %zu bytes", limit);
        wt_error_found(err, "%zu bytes", size);
        return WT_E_CORRUPT;
    }
    if (size >= buffer->capacity) {
        unsigned char *grown = realloc(buffer->data, size + 1);
        if (grown == NULL)
            return entry_fail(archive, i, err, WT_E_MEMORY, "no memory for an archive entry");
        buffer->data = grown;
        buffer->capacity = size + 1;
    }
    zip_file_t *file = zip_fopen_index(archive->zip, i, 0);
    if (file == NULL) {
        entry_fail(archive, i, err, WT_E_CORRUPT, "archive entry cannot be opened");
        wt_error_found(err, "%s", zip_strerror(archive->zip));
        return WT_E_CORRUPT;
    }
    status = read_all(archive, i, file, buffer, size, err);
    zip_fclose(file);
    return status;
}
