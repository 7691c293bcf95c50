/* Damages HDF5 files where it hurts: in the structures of the file, with checksums that agree, so
 * that a library which trusts them is led astray. Knows the outlines of the File Format
 * Specification (versions 2 and 3) and nothing of HDF5 itself.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_WRITERS_HDF5_DAMAGE_H
#define TESTS_WRITERS_HDF5_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What is done with a damaged file; `what` says where and how. */
typedef void hdf5_use(void *user, const char *what, const uint8_t *bytes, size_t size);

/* Makes n damaged copies, or as many as there are, spread over all structures, values and widths;
 * the same ones every time. Returns how many. */
size_t hdf5_damage(const uint8_t *bytes, size_t size, size_t n, hdf5_use *use, void *user);

/* The structures of a file: their bytes, behind which a checksum stands if there is one. */
enum { HDF5_BLOCKS = 512 };
typedef struct hdf5_map {
    size_t n;
    struct {
        size_t start, length;
        bool checked;
    } blocks[HDF5_BLOCKS];
} hdf5_map;
void hdf5_find(const uint8_t *bytes, size_t size, hdf5_map *map);
/* Makes all checksums agree with what they are of. */
void hdf5_check(uint8_t *bytes, const hdf5_map *map);

#endif
