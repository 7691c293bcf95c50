/* Damages the internal structures of HDF5 files and corrects the checksums, so that a library which
 * trusts them fails. It uses the outlines of the File Format Specification (versions 2 and 3), not
 * the HDF5 library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_HDF5_DAMAGE_H
#define TESTS_WRITERS_HDF5_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Receives a damaged file; `what` describes the position and the change. */
typedef void hdf5_use(void *user, const char *what, const uint8_t *bytes, size_t size);

/* Creates up to n damaged copies over all structures, values and widths; the same ones every time.
 * Returns their number. */
size_t hdf5_damage(const uint8_t *bytes, size_t size, size_t n, hdf5_use *use, void *user);

/* The structures of a file: their bytes, followed by a checksum if there is one. */
enum { HDF5_BLOCKS = 512 };
typedef struct hdf5_map {
    size_t n;
    struct {
        size_t start, length;
        bool checked;
    } blocks[HDF5_BLOCKS];
} hdf5_map;
void hdf5_find(const uint8_t *bytes, size_t size, hdf5_map *map);
/* Corrects all checksums. */
void hdf5_check(uint8_t *bytes, const hdf5_map *map);

#endif
