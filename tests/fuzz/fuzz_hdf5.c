/* Fuzz target: bytes of an HDF5 file and of the stream from its sandbox. Data that is read can
 * be written.
 *
 * After an 'a', the bytes are the summary at the end of a file; its length, mark and set of
 * tables are corrected. After a 'p', they change a valid result file: two bytes state the
 * position, one the number, and up to eight the values. The checksums are then corrected.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/table.h"
#include "writers/hdf5_damage.h"

#include <endian.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/uio.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static uint8_t sound[1 << 16], copy[sizeof sound];
static size_t sound_size;
static hdf5_map map;

static void make_sound(void)
{
    char path[] = "/tmp/weartrack-fuzz-XXXXXX";
    const int fd = mkstemp(path);
    wt_result *const result = wt_result_new();
    wt_table *const t = wt_table_new("sweep", "DMA sweep");
    if (fd < 0 || result == NULL || t == NULL ||
        wt_table_add_text_column(t, "file", "name", NULL) != WT_OK ||
        wt_table_add_column(t, "modulus", "Pa", "modulus", NULL) != WT_OK ||
        wt_table_set_key(t, "tip", "sphere", NULL) != WT_OK || wt_table_add_row(t, NULL) != WT_OK)
        abort();
    wt_table_set_text(t, 0, "a");
    if (wt_result_add(result, t, NULL) != WT_OK ||
        wt_store_write(path, result, true, NULL) != WT_OK)
        abort();
    (void)close(fd);
    FILE *const in = fopen(path, "rb");
    sound_size = in != NULL ? fread(sound, 1, sizeof sound, in) : 0;
    if (in == NULL || fclose(in) != 0 || unlink(path) != 0)
        abort();
    hdf5_find(sound, sound_size, &map);
    wt_result_free(result);
}

static void change(const uint8_t *data, size_t size)
{
    memcpy(copy, sound, sound_size);
    while (size > 3) {
        const size_t at = ((size_t)data[0] << 8 | data[1]) % (sound_size - 8);
        size_t n = data[2] % 8 + 1u;
        n = n < size - 3 ? n : size - 3;
        memcpy(copy + at, data + 3, n);
        data += 3 + n;
        size -= 3 + n;
    }
    hdf5_check(copy, &map);
}

/* A file without tables returns WT_END, which has no message. */
static wt_status read_abstract(const uint8_t *data, size_t size, wt_result **result, wt_error *err)
{
    static int file = -1;
    char set[STORE_DIGEST_SIZE];
    if (file < 0)
        file = memfd_create("weartrack-fuzz", MFD_CLOEXEC);
    store_headlines_digest(set);
    const uint64_t length = htole64(size + sizeof set);
    const struct iovec parts[] = {{(void *)(uintptr_t)data, size},
                                  {set, sizeof set},
                                  {(void *)(uintptr_t)&length, sizeof length},
                                  {(void *)(uintptr_t) "WTABST2\n", 8}};
    const size_t all = size + sizeof set + sizeof length + 8;
    if (file < 0 || ftruncate(file, 0) != 0 || pwritev(file, parts, 4, 0) != (ssize_t)all)
        abort();
    const wt_status status = store_abstract_read(file, all, "bytes", result, err);
    if (status == WT_END && size < ((size_t)2 << 20) - sizeof set)
        abort();
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_error err = WT_ERROR_INIT;
    wt_result *result = NULL;
    wt_status status;
    if (sound_size == 0)
        make_sound();
    if (size > 0 && data[0] == 'p') {
        change(data + 1, size - 1);
        status = wt_store_read_memory(copy, sound_size, "made", &result, &err);
    } else if (size > 0 && data[0] == 'a') {
        status = read_abstract(data + 1, size - 1, &result, &err);
    } else if (size > 0 && data[0] == 0x89) {
        status = wt_store_read_memory(data, size, "bytes", &result, &err);
    } else {
        result = wt_result_new();
        status = store_decode((const char *)data, size, result, &err);
    }
    char digest[STORE_DIGEST_SIZE];
    if (status != WT_OK && status != WT_END && err.message[0] == '\0')
        abort();
    for (size_t i = 0; status == WT_OK && i < wt_result_n_tables(result); i++)
        if (table_bytes_digest(wt_result_table(result, i), digest, NULL) != WT_OK)
            abort();
    wt_result_free(result);
    return 0;
}
