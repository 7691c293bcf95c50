/* Maps of force curves for big_map.c, in the folder where it is. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef TESTS_CLI_BIG_MAP_FILES_H
#define TESTS_CLI_BIG_MAP_FILES_H

#include <stddef.h>

#define MAP_MODULUS 4e6 /* [Pa], about which the curves of a tip of 1 um scatter */
enum { MOST_SAMPLES = 200 };

/* Before any map: the curves, of so many samples in each of two segments. */
void make_kinds(size_t samples);

void write_map(size_t n, size_t samples);      /* map.jpk-force-map */
void write_blocks(size_t n, size_t samples);   /* map.spm, and map.nid of version 2 */
void write_lines(size_t n, size_t samples);    /* map.nid of version 3 */
void write_studio_1(size_t n, size_t samples); /* map.nhf */
void write_studio_2(size_t n, size_t samples);
void write_park(size_t n, size_t samples);  /* map.tiff */
void write_waves(size_t n, size_t samples); /* map.waves/, map.zip */

#endif
