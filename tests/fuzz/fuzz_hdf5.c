/* Fuzz target: bytes of an HDF5 file and of the stream from its sandbox. Data that is read can
 * be written.
 *
 * After a 'p', they change a valid result file: two bytes state the position, one the number, and
 * up to eight the values. The checksums are then corrected.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/table.h"
#include "writers/hdf5_damage.h"

#include <stdlib.h>
#include <string.h>
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
    } else if (size > 0 && data[0] == 0x89) {
        status = wt_store_read_memory(data, size, "bytes", &result, &err);
    } else {
        result = wt_result_new();
        status = store_decode((const char *)data, size, result, &err);
    }
    char digest[STORE_DIGEST_SIZE];
    if (status != WT_OK && err.message[0] == '\0')
        abort();
    for (size_t i = 0; status == WT_OK && i < wt_result_n_tables(result); i++)
        if (table_bytes_digest(wt_result_table(result, i), digest, NULL) != WT_OK)
            abort();
    wt_result_free(result);
    return 0;
}
