/* Maps of force curves in the store: weartrack-hdf5(5). Curves, segments and channels are tables;
 * the samples of all segments, one behind the other, are one array for each quantity beside them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_FORCE_MAP_H
#define WT_CORE_STORE_FORCE_MAP_H

#include "core/store/hdf5_bytes.h"
#include "weartrack/data.h"

#define MAP_SAMPLES_GROUP "force_map/samples"
/* Samples of an array that are written, read and handed on together. */
enum { MAP_BLOCK = 1 << 12 };

/* CRC-32 of a curve's samples: of the values, 8 bytes each with the low one first, of the first
 * channel of the first segment, of its second channel and so on. A channel without a number in the
 * segment does not count, as if the segment were without it. */
uint32_t map_checksum(uint32_t before, const double *values, size_t n);
bool map_channel_counts(const double *values, size_t n);

typedef struct map_reader map_reader;

typedef struct map_channel {
    wt_quantity quantity;
    const char *name, *unit; /* as exported; borrowed from the reader */
} map_channel;

typedef struct map_segment {
    wt_segment_kind kind;
    size_t index, n_points;
    double duration, velocity, setpoint; /* [s], [m/s], [N]; NaN if unknown */
    const double *values;                /* [n_channels][n_points]; NaN where it has none */
} map_segment;

/* What stands beside the tables behind the door; not a byte of it is trusted. WT_E_EMPTY if there
 * is no map. Takes the result, also on failure. */
wt_status map_open(const hdf5_bytes *from, wt_result *result, map_reader **reader,
                   wt_error *err) WT_NODISCARD;
void map_close(map_reader *reader);
size_t map_n_curves(const map_reader *reader);
size_t map_channels(const map_reader *reader, const map_channel **channels);
/* Sets everything but the segments of the curve, which are of `reader` until the next call. A curve
 * that does not agree with its checksum is WT_E_CORRUPT, and the next call goes on behind it. Where
 * no more comes, that is the error of every curve that is left. */
wt_status map_next(map_reader *reader, wt_force_curve *curve, const map_segment **segments,
                   size_t *n, wt_error *err) WT_NODISCARD;

#endif
