/* Maps of force curves in the store; see weartrack-hdf5(5). Curves, segments and channels are
 * tables. For each quantity an array next to them has the samples of all segments in order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_FORCE_MAP_H
#define WT_CORE_STORE_FORCE_MAP_H

#include "core/store/hdf5_sandbox.h"
#include "weartrack/core.h"

#define MAP_SAMPLES_GROUP "force_map/samples"

/* Number of samples of an array that are written, read and transmitted together. */
enum { MAP_BLOCK = 1 << 12 };

bool map_channel_has_samples(const double *values, size_t n);

typedef struct map_reader map_reader;

typedef struct map_channel {
    wt_quantity quantity;
    const char *name, *unit; /* as exported; the reader owns the texts */
} map_channel;

typedef struct map_segment {
    wt_segment_kind kind;
    size_t index, n_points;
    double duration, velocity, setpoint; /* [s], [m/s], [N]; NaN if unknown */
    const double *values;                /* [n_channels][n_points]; NaN without a value */
} map_segment;

/* Opens the map in a store and starts the sandbox process that reads the samples. All data from the
 * process are validated. WT_E_EMPTY if there is no map. Frees `result` with the reader, also on
 * failure. */
wt_status map_open(const hdf5_bytes *from, wt_result *result, map_reader **reader,
                   wt_error *err) WT_NODISCARD;
void map_close(map_reader *reader);
size_t map_n_curves(const map_reader *reader);
size_t map_channels(const map_reader *reader, const map_channel **channels);
/* Reads the next curve without its segments, and returns the segments separately. They belong to
 * the reader until the next call. WT_E_CORRUPT for a curve with a wrong checksum; the next call
 * continues after it. If the stream ends early, each remaining curve has the error of the
 * stream. */
wt_status map_next_curve(map_reader *reader, wt_force_curve *curve, const map_segment **segments,
                         size_t *n, wt_error *err) WT_NODISCARD;

#endif
