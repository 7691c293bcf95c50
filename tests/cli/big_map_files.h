/* Maps of force curves for big_map.c, written into the current folder.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_CLI_BIG_MAP_FILES_H
#define TESTS_CLI_BIG_MAP_FILES_H

#include <stddef.h>

#define MAP_MODULUS 4e6 /* mean modulus [Pa] of the curves; the tip radius is 1 um */
enum { MOST_SAMPLES = 200 };

/* Creates the curves, with this number of samples in each of two segments. Call it before the
 * writers. */
void make_kinds(size_t samples);

void write_map(size_t n, size_t samples);      /* map.jpk-force-map */
void write_blocks(size_t n, size_t samples);   /* map.spm, and map.nid of version 2 */
void write_lines(size_t n, size_t samples);    /* map.nid of version 3 */
void write_studio_1(size_t n, size_t samples); /* map.nhf */
void write_studio_2(size_t n, size_t samples);
void write_park(size_t n, size_t samples);  /* map.tiff */
void write_waves(size_t n, size_t samples); /* map.waves/ */

#endif
